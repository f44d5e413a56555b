//! Runs without a screen: rows, closing lines, and what may not change them.

use std::fs;

use crate::program::{self, carom, closing, column, folder, in_folder};

#[test]
fn a_run_ends_with_its_closing_line_and_the_same_one_each_time() {
    let ran = carom(&["run", "paper-1"]).succeeds();
    let line = closing(&ran.out);
    assert_eq!((ran.out.lines().count(), line.t, line.stall), (1, 20.0, None), "{}", ran.out);
    assert_eq!(ran.err, "");
    assert_eq!(carom(&["run", "paper-1"]).succeeds().out, ran.out);
}

#[test]
fn states_come_at_multiples_and_at_the_end_and_the_closing_line_says_the_same() {
    let ran = carom(&["run", "paper-3", "--until", "2", "--every", "0.3", "--states", "-"]).succeeds();
    assert_eq!(ran.out.lines().next(), Some("time,sphere,x,y,z,vx,vy,vz"));
    let rows: Vec<Vec<f64>> = ran.out.lines().skip(1).map(program::numbers).collect();
    let expected: Vec<f64> = (0..7).map(|k| f64::from(k) * 0.3).chain([2.0]).flat_map(|t| [t, t]).collect();
    assert_eq!(column(&rows, 0), expected);
    assert_eq!(column(&rows, 1), [0.0, 1.0].repeat(8));
    let (line, last) = (closing(&ran.err), &rows[rows.len() - 2..]);
    assert_eq!(line.t, 2.0);
    assert_eq!(line.hash, program::fnv(last), "FNV-1a of t, then x, then v, read back from the rows");
    let energy: f64 = last.iter().map(|row| program::energy(row)).sum();
    // Masses are 1 and the sum has eight terms of the size of the energy: a few ulp of it, 1e-14 relative.
    assert!((line.energy - energy).abs() <= 1e-14 * energy.abs(), "{} is not {energy}", line.energy);
}

#[test]
fn an_end_that_is_a_multiple_comes_once() {
    let ran = carom(&["run", "paper-0", "--until", "1", "--every", "0.25", "--states", "-"]).succeeds();
    let rows: Vec<Vec<f64>> = ran.out.lines().skip(1).map(program::numbers).collect();
    assert_eq!(column(&rows, 0), [0.0, 0.25, 0.5, 0.75, 1.0]);
    let ran = carom(&["run", "paper-0", "--until", "0", "--every", "0.25", "--states", "-"]).succeeds();
    assert_eq!(ran.out.lines().count(), 2, "a header and t = 0: {}", ran.out);
}

#[test]
fn impacts_are_the_collide_rows_up_to_the_end() {
    let ran = carom(&["run", "paper-1", "--until", "7.123", "--events", "-"]).succeeds();
    let header = "time,kind,a,b,px,py,pz,nx,ny,nz,approach_speed,impulse,degree,class";
    assert_eq!(ran.out.lines().next(), Some(header));
    let collisions = ran.out.lines().filter(|row| row.ends_with(",collide")).count();
    assert!(collisions > 0, "a sphere falls on a slope within 7 s");
    assert_eq!(closing(&ran.err).impacts, collisions as u64);
    let times: Vec<f64> = ran.out.lines().skip(1).map(|row| program::number(row.split(',').next())).collect();
    assert!(times.is_sorted() && times.iter().all(|time| *time <= 7.123), "{times:?}");
}

#[test]
fn reading_never_changes_a_run() {
    let folder = folder();
    let run = |name: &str, more: &[&str]| {
        let events = in_folder(&folder, name);
        let arguments = [&["run", "paper-3", "--until", "6.7", "--events", &events], more].concat();
        let closing_line = carom(&arguments).succeeds().out;
        (closing_line, fs::read(&events).expect("the events"))
    };
    let whole = run("whole", &[]);
    let states = in_folder(&folder, "states.csv");
    for every in ["5", "0.01", "0.00037"] {
        assert_eq!(run("read", &["--every", every, "--states", &states]), whole, "--every {every}");
    }
    let half = carom(&["run", "paper-3", "--until", "3.35", "--events", "-"]).succeeds().out;
    assert!(whole.1.starts_with(half.as_bytes()), "the first half of a run is the run to its half");
}

#[test]
fn json_lines_hold_the_same_numbers_as_csv() {
    let folder = folder();
    let (csv, jsonl) = (in_folder(&folder, "states.csv"), in_folder(&folder, "states.jsonl"));
    for path in [&csv, &jsonl] {
        carom(&["run", "paper-3", "--until", "3", "--every", "0.7", "--states", path]).succeeds();
    }
    let table = fs::read_to_string(csv).expect("the table");
    let columns: Vec<&str> = table.lines().next().expect("a header").split(',').collect();
    let lines = fs::read_to_string(jsonl).expect("the lines");
    let back: Vec<Vec<u64>> = lines.lines().map(|line| program::json_bits(line, &columns)).collect();
    let bits = |row: &str| program::numbers(row).iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    assert_eq!(back, table.lines().skip(1).map(bits).collect::<Vec<_>>());
}

#[test]
fn method_step_and_tolerance_of_the_command_line_win() {
    let hash =
        |more: &[&str]| closing(&carom(&[&["run", "paper-0", "--until", "3"], more].concat()).succeeds().out).hash;
    assert_eq!(hash(&[]), hash(&["--method", "paper", "--dt", "0.01", "--tolerance", "0.001"]));
    assert_ne!(hash(&[]), hash(&["--dt", "0.005"]));
    assert_ne!(hash(&[]), hash(&["--dt", "1e-3", "--tolerance", "1e-9"]));
}

#[test]
fn a_run_that_cannot_go_on_writes_what_it_has_and_says_why() {
    let folder = folder();
    let (states, events) = (in_folder(&folder, "states.csv"), in_folder(&folder, "events.csv"));
    let ran = carom(&["run", "paper-2", "--every", "1", "--states", &states, "--events", &events]).fails_with(1);
    let line = closing(&ran.out);
    // design: resting in the wedge stalls near 10.3 s, which the prototypes found as well
    assert!(line.stall.is_some() && (10.0..11.0).contains(&line.t), "{}", ran.out);
    assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    assert!(ran.err.starts_with("carom: "), "{}", ran.err);
    let rows: Vec<Vec<f64>> =
        fs::read_to_string(states).expect("the states").lines().skip(1).map(program::numbers).collect();
    let times: Vec<f64> = column(&rows, 0).into_iter().step_by(3).collect();
    assert_eq!(times[..11], (0..11).map(f64::from).collect::<Vec<_>>());
    assert_eq!(times[11..], [line.t], "the last rows are where the run stopped");
    let collisions = fs::read_to_string(events).expect("the events").matches(",collide\n").count();
    assert_eq!(line.impacts, collisions as u64);
}

#[test]
fn scenes_with_nobody_or_few_go_through_every_command_and_method() {
    let walls = "Room(min: (-5, -5, -5), max: (5, 5, 5))";
    let gas = |count: usize| {
        format!("Gas(min: (-4, -4, -4), max: (4, 4, 4), count: {count}, seed: 1, speed: 1, mass: 1, radius: 0.1)")
    };
    let one = "Sphere(x: (0, 0, 0), v: (1, 0, 0), mass: 1, radius: 0.5)";
    let cases = [("", String::new()), (walls, String::new()), ("", one.into()), (walls, gas(64)), (walls, gas(65))];
    let folder = folder();
    for (k, (walls, spheres)) in cases.iter().enumerate() {
        let path = folder.path().join(format!("few-{k}.ron"));
        let contact = "contact: (restitution: 1, tangential: 1, rest_speed: 0)";
        let text = format!("Scene(name: \"few\", duration: 1, {contact}, walls: [{walls}], spheres: [{spheres}])");
        fs::write(&path, text).expect("a scene file");
        let path = path.to_str().expect("a plain name");
        for method in ["paper", "exact", "swept", "moreau"] {
            let ran = carom(&["run", path, "--method", method, "--dt", "0.1", "--tolerance", "0.01"]).succeeds();
            let line = closing(&ran.out);
            assert_eq!((line.t, line.stall), (1.0, None), "{method}: {}", ran.out);
            carom(&["render", path, "--at", "1", "--method", method]).succeeds();
            carom(&["--text", path, "--method", method]).succeeds();
        }
        if walls.is_empty() || spheres.is_empty() {
            carom(&["run", path, "--accuracy", "1e-3"]).succeeds();
            carom(&["measure", path]).succeeds();
        }
    }
}
