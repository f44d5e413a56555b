//! `carom measure` as a user runs it: files, parts, signals, refusals.

use std::fs;

use rustix::process::Signal;

use crate::program::{carom, folder, in_folder, names_in};
use crate::pty;

const COLUMNS: &str = "scene,method,dt,tolerance,until,horizon,certified,floor,position_error,impact_time_error,common_events,\
                       energy_error,deepest_degree,impacts,evaluations,events,frames,cpu_per_s,cpu_median,cpu_spread,\
                       note";

/// Few and quick settings, two of which stall in paper-2.
const QUICK: [&str; 5] = ["measure", "paper-0", "paper-2", "--dt=1e-1,1e-2", "--tolerances=1e-3,1e-5"];

/// What the clock has to say in a note.
const OF_THE_CLOCK: [&str; 4] = ["timer too coarse", "timed once", "timings spread widely", "machine busy"];

/// The rows without what the clock says: the three cells before the last, and phrases of the last.
fn timeless(csv: &str) -> Vec<String> {
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some(COLUMNS));
    lines.map(without_times).collect()
}

fn without_times(line: &str) -> String {
    let cells: Vec<&str> = line.split(',').collect();
    assert_eq!(cells.len(), 21, "{line}");
    let note: Vec<&str> = cells[20].split("; ").filter(|phrase| !OF_THE_CLOCK.contains(phrase)).collect();
    format!("{},{}", cells[..17].join(","), note.join("; "))
}

#[test]
fn the_rows_are_the_stored_ones_and_repeat_to_the_bit_whatever_the_number_of_jobs() {
    let run = |jobs: &str| carom(&[&QUICK[..], &["--csv", "-", "--jobs", jobs]].concat()).succeeds();
    let (one, many) = (run("1"), run("3"));
    let of_paper = timeless(&one.out).into_iter().filter(|row| row.contains(",paper,"));
    insta::assert_snapshot!("rows", of_paper.map(|row| rounded(&row)).collect::<Vec<_>>().join("\n"));
    assert_eq!(timeless(&one.out), timeless(&many.out));
    assert!(one.err.contains("The yardstick, exact, takes"), "the report has to go somewhere: {}", one.err);
}

/// The row with its errors to three digits: what stands there is their size, their bits are held by the golden hashes.
fn rounded(row: &str) -> String {
    let short = |cell: &str| cell.parse::<f64>().map_or(cell.to_string(), |value| format!("{value:.2e}"));
    let cells = row.split(',').enumerate();
    let cells = cells.map(|(index, cell)| if (4..13).contains(&index) { short(cell) } else { cell.to_string() });
    cells.collect::<Vec<_>>().join(",")
}

#[test]
fn parts_in_any_order_merge_to_the_whole() {
    let folder = folder();
    let whole = timeless(&carom(&[&QUICK[..], &["--csv", "-"]].concat()).succeeds().out);
    let parts: Vec<String> = (1..=3).map(|part| in_folder(&folder, &format!("{part}.csv"))).collect();
    for (index, path) in parts.iter().enumerate() {
        let shard = format!("{}/3", index + 1);
        carom(&[&QUICK[..], &["--shard", &shard, "--csv", path]].concat()).succeeds();
    }
    let merged = carom(&["measure", "--merge", &parts[2], &parts[0], &parts[1], "--csv", "-"]).succeeds();
    assert_eq!(timeless(&merged.out), whole);
    let mut cells: Vec<String> = parts.iter().flat_map(|part| lines_of(part)).collect();
    let mut joined: Vec<String> = merged.out.lines().skip(1).map(String::from).collect();
    cells.sort();
    joined.sort();
    assert_eq!(joined, cells, "not a digit is lost, times included");
}

fn lines_of(path: &str) -> Vec<String> {
    fs::read_to_string(path).expect("a part").lines().skip(1).map(String::from).collect()
}

#[test]
fn the_report_has_a_table_a_chart_and_the_cheapest_settings_within_80_columns() {
    let folder = folder();
    let svg = in_folder(&folder, "trade.svg");
    let methods = "--methods=paper,exact,moreau,swept";
    let grid = ["measure", "paper-0", "--dt=1e-2,1e-3", "--tolerances=1e-3", methods, "--svg", &svg];
    let report = carom(&grid).succeeds().out;
    let cheapest = "Cheapest for errors of 1e0 down to 1e-16 m: exact";
    for words in ["paper-0: 20 s; horizon none", "* exact", "position error, m", cheapest, "s swept"] {
        assert!(report.contains(words), "{words:?} is not in\n{report}");
    }
    assert!(report.lines().all(|line| line.chars().count() <= 80), "{report}");
    assert!(fs::read_to_string(&svg).expect("the figure").starts_with("<svg "));
    assert_eq!(names_in(&folder), ["trade.svg"]);
}

#[test]
fn exact_competes_only_if_it_is_listed() {
    let grid = ["measure", "paper-0", "--dt", "1e-2", "--tolerances", "1e-3"];
    let usual = carom(&grid).succeeds().out;
    assert!(usual.contains("\n  exact") && usual.contains("\n* swept"), "{usual}");
    let listed = carom(&[&grid[..], &["--methods", "exact,paper"]].concat()).succeeds().out;
    assert!(listed.contains("\n* exact"), "{listed}");
    let alone = carom(&[&grid[..], &["--methods", "paper"]].concat()).succeeds().out;
    assert!(!alone.contains("\n  exact") && alone.contains("The yardstick, exact, takes"), "{alone}");
}

#[test]
fn an_interrupt_keeps_what_is_done_and_says_so() {
    let folder = folder();
    let csv = in_folder(&folder, "rows.csv");
    // The second setting takes 2e9 frames, more than a test waits for.
    let arguments = [
        "measure",
        "paper-0",
        "--methods",
        "paper",
        "--dt",
        "1e-2,1e-8",
        "--tolerances",
        "1e-3",
        "--jobs",
        "1",
        "--csv",
        &csv,
    ];
    let mut pty = pty::carom(&arguments).run();
    pty.until_text("1 of 2 settings");
    assert!(!fs::exists(&csv).expect("a folder to look into"), "no half of a file before the end");
    pty.signal(Signal::INT);
    assert_eq!(pty.exit(), 130);
    assert!(pty.text().contains("interrupted: 1 of 2 settings are done and kept"), "{}", pty.text());
    let text = fs::read_to_string(&csv).expect("what is done");
    let rows = timeless(&text);
    assert!(rows.len() == 1 && rows[0].starts_with("paper-0,paper,0.01,0.001,20.0,"), "{text}");
    assert_eq!(names_in(&folder), ["rows.csv"]);
}

#[test]
fn an_interrupt_before_anything_is_done_keeps_the_old_results() {
    let folder = folder();
    let (csv, svg) = (in_folder(&folder, "rows.csv"), in_folder(&folder, "trade.svg"));
    fs::write(&csv, "precious").expect("a file");
    fs::write(&svg, "dear").expect("a file");
    // It takes 2e9 frames, more than a test waits for.
    let setting =
        ["measure", "paper-0", "--methods=paper", "--dt=1e-8", "--tolerances=1e-3", "--csv", &csv, "--svg", &svg];
    let mut pty = pty::carom(&setting).run();
    pty.until_text("0 of 1 settings");
    pty.signal(Signal::TERM);
    assert_eq!(pty.exit(), 143);
    assert!(pty.text().contains("interrupted: none of 1 settings is done; nothing is written"), "{}", pty.text());
    assert_eq!(fs::read_to_string(&csv).expect("the old rows"), "precious");
    assert_eq!(fs::read_to_string(&svg).expect("the old figure"), "dear");
    assert_eq!(names_in(&folder), ["rows.csv", "trade.svg"]);
}

#[test]
fn an_interrupt_of_a_crowd_keeps_the_runs_that_are_done_and_says_how_many() {
    let folder = folder();
    let (csv, svg) = (in_folder(&folder, "crowd.csv"), in_folder(&folder, "crowd.svg"));
    // A run of the second setting has 2e9 frames, more than a test waits for.
    let ask = |arguments: &[&str]| {
        let setting = ["measure", "paper-0", "--crowd", "2", "--methods=paper", "--tolerances=1e-3", "--jobs=1"];
        pty::carom(&[&setting[..], &["--csv", &csv, "--svg", &svg], arguments].concat()).run()
    };
    let mut pty = ask(&["--dt=1e-8"]);
    pty.until_text("0 of 2 runs");
    pty.signal(Signal::INT);
    assert_eq!(pty.exit(), 130);
    assert!(pty.text().contains("interrupted: none of 2 runs is done; nothing is written"), "{}", pty.text());
    assert_eq!(names_in(&folder), [""; 0]);
    let mut pty = ask(&["--dt=1e-2,1e-8"]);
    pty.until_text("2 of 4 runs");
    pty.signal(Signal::INT);
    assert_eq!(pty.exit(), 130);
    assert!(pty.text().contains("interrupted: 2 of 4 runs are done and kept"), "{}", pty.text());
    let text = fs::read_to_string(&csv).expect("what is done");
    let row = text.lines().find(|line| line.contains("energy at the end")).expect("a figure");
    assert!(row.starts_with("paper-0,paper,0.01,0.001,2,20.0,") && !text.contains("1e-8"), "{text}");
    let drawn = fs::read_to_string(&svg).expect("a figure of what is done");
    assert!(drawn.contains("means over 2 seeds") && drawn.ends_with("</svg>\n"), "{drawn}");
}

#[test]
fn a_broken_part_is_refused_with_file_and_line() {
    let folder = folder();
    let path = in_folder(&folder, "part.csv");
    let row = "paper-0,paper,0.1,0.001,20.0,,20.0,1e-14,1.0,,0,0.5,0.0,0,1206,0,200,1e-6,1e-6,0.1,";
    for (text, line, words) in [
        (String::new(), 1, "empty"),
        ("a,b\n1,2\n".into(), 1, "columns"),
        (format!("{COLUMNS}\n{row}\n{}\n", row.replace("1206", "many")), 3, "evaluations is \"many\""),
        (format!("{COLUMNS}\n{row}\npaper-0,paper\n"), 3, "2 cells"),
        (format!("{COLUMNS}\n{}\n", row.replace("paper,0.1", "paper,inf")), 2, "dt is inf"),
        (format!("{COLUMNS}\n{}\n", row.replace("paper,0.1", "paper,-0.1")), 2, "dt is -0.1"),
        (format!("{COLUMNS}\n{row}\n{}\n", row.replace("20.0", "NaN")), 3, "until is NaN"),
        (format!("{COLUMNS}\n{}\n", row.replace("paper,", "magic,")), 2, "\"magic\""),
        (format!("{COLUMNS}\n{row}\n{row}\n"), 3, "already"),
        (format!("{COLUMNS}\n{row}\n{}\n", row.replace("0.1,0.001,20.0,,", "0.2,0.001,20.0,7.5,")), 3, "horizon"),
    ] {
        fs::write(&path, text).expect("a file");
        let ran = carom(&["measure", "--merge", &path]).fails_with(1);
        assert!(ran.err.contains(&format!("part.csv:{line}:")) && ran.err.contains(words), "{}", ran.err);
        assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    }
    let missing = carom(&["measure", "--merge", &in_folder(&folder, "none.csv")]).fails_with(1);
    assert!(missing.err.contains("none.csv"), "{}", missing.err);
}

#[test]
fn wrong_usage_is_told() {
    for arguments in [
        &["measure"][..],
        &["measure", "paper-0", "--shard", "0/2"],
        &["measure", "paper-0", "--shard", "3/2"],
        &["measure", "paper-0", "--merge", "a.csv"],
        &["measure", "paper-0", "--methods", "magic"],
        &["measure", "paper-0", "--dt", "0"],
        &["measure", "paper-0", "--tolerances", "1e-3,-1"],
        &["measure", "paper-0", "--jobs", "0"],
        &["measure", "paper-0", "--csv", "-", "--svg", "-"],
        &["run", "paper-0", "--accuracy", "0"],
        &["run", "paper-0", "--accuracy", "1e-3", "--dt", "0.1"],
    ] {
        carom(arguments).fails_with(2);
    }
    let twice = carom(&["measure", "paper-0", "paper-0"]).fails_with(1);
    assert!(twice.err.contains("two scenes are called paper-0"), "{}", twice.err);
    carom(&["measure", "nowhere"]).fails_with(1);
}

#[test]
fn a_run_with_an_accuracy_says_what_it_chose_and_meets_it() {
    let ran = carom(&["run", "paper-0", "--until", "1", "--states", "-", "--accuracy", "0.06", "--method", "paper"]);
    let ran = ran.succeeds();
    assert!(ran.err.starts_with("carom: chose paper, dt "), "{}", ran.err);
    let y: f64 = ran.out.lines().last().and_then(|row| row.split(',').nth(3)?.parse().ok()).expect("y at 1 s");
    // Scene 0 falls freely for 1 s, from 9.5 m.
    assert!((y - (9.5 - 4.9)).abs() <= 0.06, "{y}");
    // Balls on a table are chaotic: exact is known to 1e-7 m for some ten seconds of these three thousand, so nothing can be told.
    let chaotic = carom(&["run", "billiard", "--until", "3000", "--accuracy", "1e-6"]).fails_with(1);
    assert!(chaotic.err.contains("positions mean something only up to"), "{}", chaotic.err);
    let refused = carom(&["run", "paper-0", "--until", "1", "--accuracy", "1e-9", "--method", "paper"]).fails_with(1);
    assert!(refused.err.contains("no setting of paper"), "{}", refused.err);
    let frame = carom(&["render", "paper-0", "--accuracy", "1"]).succeeds();
    assert!(frame.err.starts_with("carom: chose "), "{}", frame.err);
}

#[test]
fn the_screen_begins_with_what_was_chosen() {
    let mut pty = pty::carom(&["paper-0", "--paused", "--accuracy", "1e-3", "--method", "exact"]).run();
    pty.until_text("chose exact: ");
    pty.send("q");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

#[test]
fn every_command_of_its_document_exists() {
    let text = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/measure.md")).expect("the document");
    let joined = text.replace("\\\n", " ");
    let commands: Vec<Vec<String>> = joined.lines().filter_map(words).collect();
    assert!(commands.len() >= 8, "{commands:?}");
    for words in commands {
        let parsed = carom::cli::command().try_get_matches_from(&words);
        assert!(parsed.is_ok(), "{words:?}: {}", parsed.expect_err("it was not parsed"));
    }
}

/// The words of a line that runs carom, by itself or under a scheduler, with what the shell would put in.
fn words(line: &str) -> Option<Vec<String>> {
    let command = line.split(" #").next()?.split(":::").next()?;
    let start = command.find("carom ").filter(|start| {
        let before = command[..*start].trim();
        ["", "parallel", "sbatch --wait trade.slurm &&"].contains(&before)
    })?;
    let filled = command[start..].replace("$SLURM_ARRAY_TASK_ID", "3").replace("$SLURM_ARRAY_TASK_COUNT", "64");
    let filled = filled.replace("{1}", "0").replace("{2}", "2").replace('"', "");
    Some(filled.split_whitespace().map(String::from).collect())
}

#[test]
fn other_axes_json_orders_and_failures_are_to_be_had() {
    let folder = folder();
    let (svg, json) = (in_folder(&folder, "trade.svg"), in_folder(&folder, "trade.jsonl"));
    let grid =
        ["measure", "paper-0", "paper-2", "--methods=paper,swept", "--dt=1e-1,1e-2", "--tolerances=1e-3,1e-5,1e-7"];
    let ran =
        carom(&[&grid[..], &["--x", "gaps", "--y", "energy", "--svg", &svg, "--json", &json]].concat()).succeeds();
    for words in [
        "energy error, relative",
        "gaps computed",
        "Order of the error",
        "swept",
        "Stopped: paper, dt",
        "very same run",
    ] {
        assert!(ran.out.contains(words), "{words:?} is not in\n{}", ran.out);
    }
    let svg = fs::read_to_string(&svg).expect("the figure");
    for words in ["Energy error over cost", ">gaps computed<", "carom measure paper-0 paper-2", "cores"] {
        assert!(svg.contains(words), "{words:?} is not in {svg}");
    }
    let json = fs::read_to_string(&json).expect("JSON");
    assert_eq!(json.lines().count(), 24);
    let line: serde_json::Value = serde_json::from_str(json.lines().next().expect("a row")).expect("an object");
    assert_eq!(line["command"], "carom measure paper-0 --methods paper --dt 1e-1 --tolerances 1e-3", "{line}");
    assert!(line["frames"].as_u64().is_some_and(|frames| frames > 0) && line["machine"].is_string(), "{line}");
    // What the table folds into one line says so here as well, and is one mark of the figure, as what stopped is another kind of mark.
    let first = "carom measure paper-2 --methods paper --dt 1e-1 --tolerances 1e-5";
    assert!(json.lines().all(|line| !line.contains("\"same_as\":\"") || line.contains("--methods")), "{json}");
    assert!(json.contains("\"same_as\":null") && json.contains("\"same_as\":\"carom measure paper-"), "{json}");
    assert!(json.contains(first) && svg.contains("the very same run as with") && svg.contains("stopped early"));
}

#[test]
fn a_setting_that_takes_too_long_is_given_up_and_listed() {
    let grid = ["measure", "paper-0", "--methods=paper", "--dt=1e-2,1e-8", "--tolerances=1e-3", "--timeout", "0.2"];
    let ran = carom(&grid).succeeds();
    assert!(ran.out.contains("Stopped: paper, dt 1e-8 s, tolerance 1e-3 at"), "{}", ran.out);
    assert!(ran.out.contains("time-out"), "{}", ran.out);
    // The command that repeats a setting has what changes its figures.
    let json = carom(&[&grid[..], &["--error", "1e-3", "--json", "-"]].concat()).succeeds().out;
    assert!(json.contains("--dt 1e-8 --tolerances 1e-3 --timeout 0.2 --error 1e-3\""), "{json}");
}
