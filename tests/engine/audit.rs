//! Is the judge just? It finds nothing in runs that are right, and each thing that is made wrong on purpose.

use std::process::Command;

use crate::support::{ELASTIC, G, PAPER_LAW, changed, gas, paper, paper_scene, room, scene, sphere, wall};
use carom::audit::{Bodies, Fault, Frame, Judge, Watch};
use carom::physics::{Class, Contact, Kind, Method, Progress, Scene, Settings, Simulation, State, Until};
use carom::scene::ContactLaw;
use glam::{DVec3, dvec3};

const EXACT: Settings = Settings { method: Method::Exact, dt: 0.5, tolerance: 1e-3 };

/// What the judge finds in a run until `until` (s).
fn faults(scene: &Scene, settings: Settings, until: f64) -> Vec<String> {
    let mut run = Simulation::new(scene, settings);
    run.record_events(true);
    let mut judge = Judge::of(&run);
    while run.time() < until {
        if run.advance(Until::Frame, u64::MAX) != Progress::Reached {
            break; // what `paper` can't solve is no fault of what it has done
        }
        let events = run.take_events();
        judge.frame(&run, &events);
    }
    judge.findings().rows().iter().map(ToString::to_string).collect()
}

#[test]
fn in_the_middle_of_a_frame_the_energy_is_that_of_its_beginning() {
    // Bounces on a floor that rubs: each row of them is summed up at its end, in the frame that is still open.
    let law = ContactLaw { restitution: 0.5, wall_restitution: 0.5, tangential: 0.5, rest_speed: 0.0 };
    let floor = wall(DVec3::ZERO, DVec3::X * 40.0, DVec3::NEG_Z * 40.0);
    let ball = |x: f64, up: f64| sphere(dvec3(x, 0.5 + up, 0.0), DVec3::X, 0.5);
    let mut run = Simulation::new(&scene(G, law, vec![floor], vec![ball(-3.0, 0.1), ball(3.0, 0.17)]), EXACT);
    let energy = |run: &Simulation| run.state().energy(run.model()) + run.hidden_energy();
    let (mut before, mut summed, mut looks) = ((run.time(), energy(&run)), 0, 0);
    while run.time() < 2.0 {
        run.advance(Until::Time(2.0), 1);
        let now = (run.time(), energy(&run));
        let rounding = 64.0 * f64::EPSILON * run.initial_energy();
        assert!(now.1 <= before.1 + rounding, "{} J became {} J at {} s", before.1, now.1, now.0);
        assert!(now.0 > before.0 || now.1 == before.1, "{} J became {} J within a frame", before.1, now.1);
        (summed, looks) = (summed + u32::from(run.hidden_energy() != 0.0), looks + 1);
        before = now;
    }
    assert!(summed > 0 && looks > 20, "{summed} of {looks} looks saw bounces that are summed up");
}

#[test]
fn runs_that_are_right_have_no_findings() {
    for k in 0..4 {
        for method in [Method::Exact, Method::Swept] {
            let found = faults(&paper_scene(k), Settings { method, ..EXACT }, 20.0);
            assert!(found.is_empty(), "paper-{k} by {method:?}: {found:#?}");
        }
        if k < 3 {
            let found = faults(&paper_scene(k), paper(0.01, 1e-3), 20.0);
            assert!(found.is_empty(), "paper-{k}: {found:#?}");
        }
    }
    for method in [Method::Exact, Method::Swept] {
        let found = faults(&gas(125, 5, 1.0), Settings { method, tolerance: 1e-9, ..EXACT }, 1.0);
        assert!(found.is_empty(), "gas by {method:?}: {found:#?}");
    }
}

#[test]
fn bounces_that_do_not_leave_the_tolerance_may_be_summed_up_and_higher_ones_may_not() {
    // The second impact leaves 0.03 m/s, a hop of 5e-5 m, of a ball that was met 2.5e-4 m deep; meanwhile its way along the
    // floor is that of all the bounces to come. `exact` promises no such depth: bounces so high are told one by one.
    let law = ContactLaw { restitution: 0.1, wall_restitution: 0.1, tangential: 0.5, rest_speed: 0.0 };
    let floor = wall(DVec3::ZERO, DVec3::X * 40.0, DVec3::NEG_Z * 40.0);
    let scene = scene(G, law, vec![floor], vec![sphere(DVec3::Y, DVec3::X, 0.5)]);
    let swept = Settings { method: Method::Swept, dt: 1e-3, tolerance: 1e-3 };
    assert_eq!(faults(&scene, swept, 1.0), Vec::<String>::new());

    let mut run = Simulation::new(&scene, swept);
    let mut judge = Judge::new(run.model(), Settings { method: Method::Exact, ..swept }, &run.state());
    while run.time() < 1.0 {
        assert_eq!(run.advance(Until::Frame, u64::MAX), Progress::Reached);
        let (state, contacts) = (run.state(), run.contacts());
        judge.look(run.model(), &Frame { state: &state, contacts, events: &[], hidden: run.hidden_energy() });
    }
    assert!(judge.findings().rows().iter().any(|finding| finding.fault == Fault::Velocity), "{:#?}", judge.findings());
}

/// A ball that falls on a floor with some way along it, just before and just after it bounces.
struct Bounce {
    run: Simulation,
    before: State,
    after: State,
    row: Contact,
}

/// A floor, a ball above it, gravity, and the paper's law.
fn bounce(law: ContactLaw) -> Bounce {
    let floor = wall(DVec3::ZERO, DVec3::X * 20.0, DVec3::Z * -20.0);
    let mut run = Simulation::new(&scene(G, law, vec![floor], vec![sphere(DVec3::Y, DVec3::X, 0.5)]), EXACT);
    run.record_events(true);
    let before = run.state();
    assert_eq!(run.advance(Until::Frame, u64::MAX), Progress::Reached);
    let row = run.take_events()[0];
    assert_eq!(row.class, Class::Collide);
    Bounce { before, after: run.state(), row, run }
}

impl Bounce {
    /// What the judge finds if the frame has left this state and this contact.
    fn found(&self, state: &State, rows: &[Contact]) -> Vec<Fault> {
        let mut judge = Judge::new(self.run.model(), EXACT, &self.before);
        judge.look(self.run.model(), &Frame { state, contacts: rows, events: rows, hidden: 0.0 });
        judge.findings().rows().iter().map(|finding| finding.fault).collect()
    }

    /// The same with a changed state.
    fn with(&self, change: impl Fn(&mut State)) -> Vec<Fault> {
        let mut state = self.after.clone();
        change(&mut state);
        self.found(&state, &[self.row])
    }

    /// The same with a changed contact.
    fn told(&self, change: impl Fn(&mut Contact)) -> Vec<Fault> {
        let mut row = self.row;
        change(&mut row);
        self.found(&self.after, &[row])
    }
}

#[test]
fn what_is_made_wrong_is_found() {
    let bounce = bounce(PAPER_LAW);
    assert_eq!(bounce.found(&bounce.after, &[bounce.row]), []);
    // 1e-11 m is 2e-11 r: twenty times what a flight may overlap
    assert!(bounce.with(|state| state.x[0].y -= 1e-11).contains(&Fault::Overlap));
    assert!(bounce.with(|state| state.x[0].y -= 1.0).contains(&Fault::Passage));
    assert!(bounce.with(|state| state.x[0].x = f64::NAN).contains(&Fault::NotANumber));
    assert!(bounce.with(|state| state.v[0] *= 2.0).contains(&Fault::Energy));
    // a twin law without the rest speed below which the law stops things silently
    assert!(bounce.told(|row| row.impulse = -row.impulse).contains(&Fault::Pull));
    assert!(bounce.told(|row| row.impulse *= 1.001).contains(&Fault::Impulse));
    assert!(bounce.told(|row| row.separation_speed *= 1.001).contains(&Fault::Jump));
    assert!(bounce.told(|row| row.normal *= 1.001).contains(&Fault::Normal));
    assert!(bounce.told(|row| row.normal = -row.normal).contains(&Fault::Normal));
    assert!(bounce.told(|row| row.normal = dvec3(0.6, 0.8, 0.0)).contains(&Fault::Normal));
    assert!(bounce.told(|row| row.point.x += 1e-3).contains(&Fault::Point));
    assert!(bounce.told(|row| row.approach_speed *= -1.0).contains(&Fault::Approach));
}

#[test]
fn velocities_that_nothing_explains_are_found() {
    let bounce = bounce(ContactLaw { rest_speed: 0.0, ..PAPER_LAW });
    assert_eq!(bounce.found(&bounce.after, &[bounce.row]), []);
    // friction taken twice, told once; then told twice
    assert!(bounce.with(|state| state.v[0].x *= 0.99).contains(&Fault::Velocity));
    assert!(bounce.found(&bounce.after, &[bounce.row, bounce.row]).contains(&Fault::Friction));
    assert!(bounce.with(|state| state.v[0].z += 1e-6).contains(&Fault::Velocity));
    assert!(bounce.with(|state| state.v[0].y *= 0.999).contains(&Fault::Velocity));
    assert!(bounce.with(|state| state.v[0].y *= 0.999).contains(&Fault::Loss));
    assert!(bounce.found(&bounce.after, &[]).contains(&Fault::Loss), "an impact that is not told");
    let early = |row: &mut Contact| row.approach_speed *= 1.01;
    assert!(bounce.told(early).contains(&Fault::Approach));
}

#[test]
fn what_does_not_rest_is_found() {
    let bounce = bounce(PAPER_LAW);
    let rest = Contact { class: Class::Rest, approach_speed: 0.0, separation_speed: 0.0, impulse: 0.0, ..bounce.row };
    assert!(bounce.found(&bounce.after, &[rest]).contains(&Fault::RestSpeed));
    let mut state = bounce.after.clone();
    (state.x[0].y, state.v[0]) = (state.x[0].y + 1e-6, DVec3::ZERO);
    assert!(bounce.found(&state, &[rest]).contains(&Fault::RestGap));
}

#[test]
fn what_rests_may_close_its_gap_as_fast_as_it_falls_and_no_faster() {
    let bounce = bounce(PAPER_LAW);
    let rest = Contact { class: Class::Rest, approach_speed: 0.0, separation_speed: 0.0, impulse: 0.0, ..bounce.row };
    let closing = |gap: f64, v: f64| {
        let mut state = bounce.after.clone();
        (state.x[0].y, state.v[0]) = (0.5 + gap, DVec3::NEG_Y * v);
        bounce.found(&state, &[rest]).contains(&Fault::RestSpeed)
    };
    // a fall of 1e-12 m, less than the 1e-9 r that what rests may be apart
    let fallen = (2.0 * -G.y * 1e-12_f64).sqrt();
    assert!(!closing(1e-12, 0.9 * fallen) && closing(1e-12, 1.1 * fallen), "{fallen:e} m/s");
    assert!(closing(0.0, 0.9 * fallen) && closing(-1e-12, 0.9 * fallen), "what touches has nothing to fall");
}

#[test]
fn momentum_that_nothing_gives_is_found() {
    let pair = vec![sphere(DVec3::ZERO, DVec3::X, 0.5), sphere(DVec3::X * 1.5, DVec3::ZERO, 0.5)];
    let mut run = Simulation::new(&scene(DVec3::ZERO, ELASTIC, vec![], pair), EXACT);
    run.record_events(true);
    let mut judge = Judge::of(&run);
    while run.tallies().impacts == 0 {
        assert_eq!(run.advance(Until::Frame, u64::MAX), Progress::Reached);
        judge.frame(&run, &[]);
    }
    assert!(judge.findings().is_empty(), "{:?}", judge.findings());
    // both velocities lose a millionth: no force does that
    let mut state = run.state();
    state.t += 1.0;
    state.x.iter_mut().zip(&state.v).for_each(|(x, v)| *x += *v);
    state.v.iter_mut().for_each(|v| *v *= 1.0 - 1e-6);
    let row = Contact { class: Class::Rest, time: state.t - 0.5, ..run.contacts()[0] };
    judge.look(run.model(), &Frame { state: &state, contacts: &[row], events: &[], hidden: 0.0 });
    let faults: Vec<Fault> = judge.findings().rows().iter().map(|finding| finding.fault).collect();
    assert!(faults.contains(&Fault::Momentum), "{faults:?}");
}

#[test]
fn energy_may_rise_by_what_rounded_places_are_worth_under_a_load_and_no_more() {
    // A ball on a floor gains a microjoule. One ulp of the places of a contact that carries 1e10 N is worth more; one of its
    // weight is not, nor one of a rest that begins by stopping as hard a blow.
    let floor = wall(DVec3::ZERO, DVec3::X * 20.0, DVec3::Z * -20.0);
    let run = Simulation::new(&scene(G, PAPER_LAW, vec![floor], vec![sphere(DVec3::Y * 0.5, DVec3::X, 0.5)]), EXACT);
    let state = State { t: 0.5, x: vec![dvec3(0.5, 0.5, 0.0)], v: vec![DVec3::X * (1.0 + 1e-6)] };
    let rises = |force: f64, approach_speed: f64| {
        let impulse = force * state.t;
        let row = Contact { class: Class::Rest, time: state.t, impulse, approach_speed, ..touching(&run) };
        let mut judge = Judge::of(&run);
        judge.look(run.model(), &Frame { state: &state, contacts: &[row], events: &[], hidden: 0.0 });
        judge.findings().rows().iter().any(|finding| finding.fault == Fault::Energy)
    };
    assert!(!rises(1e10, 0.0) && rises(-G.y, 0.0) && rises(1e10, 1.0));
}

/// The contact of the only ball of a run with its floor.
fn touching(run: &Simulation) -> Contact {
    let mut run = run.clone();
    run.advance(Until::Frame, u64::MAX);
    *run.contacts().first().expect("the ball rests on the floor")
}

#[test]
fn the_watch_alarms_with_time_and_bodies() {
    let floor = wall(DVec3::ZERO, DVec3::X * 20.0, DVec3::Z * -20.0);
    let run = Simulation::new(&scene(G, PAPER_LAW, vec![floor], vec![sphere(DVec3::Y, DVec3::X, 0.5)]), EXACT);
    let mut watch = Watch::new(&run);
    let state = |t: f64, y: f64, v: DVec3| State { t, x: vec![dvec3(0.0, y, 0.0)], v: vec![v] };
    watch.state(run.model(), (&state(0.1, 0.6, DVec3::ZERO), 0.0), 0);
    assert!(watch.alarm().is_silent(), "{:?}", watch.alarm());
    watch.state(run.model(), (&state(0.2, 0.4, DVec3::ZERO), 0.0), 0);
    let overlap = watch.alarm().overlap.expect("a fifth of the radius is an overlap");
    assert_eq!((overlap.time, overlap.bodies), (0.2, Bodies::Wall(0, 0)));
    assert!((overlap.value - 0.2).abs() < 1e-12 && watch.alarm().energy.is_none());
    watch.state(run.model(), (&state(0.3, 0.5, DVec3::X * 9.0), 0.0), 0);
    assert_eq!(watch.alarm().energy.map(|energy| energy.time), Some(0.3));
    assert_eq!(watch.alarm().words(), "overlap,energy");
}

#[test]
fn spheres_that_overlap_far_from_the_first_are_found_among_many() {
    let crowd = changed(&gas(1000, 3, 0.0), |draft| draft.walls = room(DVec3::splat(-10.0), DVec3::splat(10.0)));
    let run = Simulation::new(&crowd, EXACT);
    let mut state = run.state();
    state.x[700] = state.x[999] + dvec3(0.19, 0.0, 0.0);
    let mut judge = Judge::new(run.model(), EXACT, &run.state());
    judge.state(run.model(), (&state, 0.0), &[]);
    let found = judge.findings().rows();
    assert!(found.iter().any(|row| row.fault == Fault::Overlap && row.bodies == Bodies::Pair(700, 999)), "{found:?}");
    assert!(run.contacts().iter().all(|row| row.kind == Kind::Wall), "nothing else touches");
}

/// Exit code, standard output and standard error of `carom run` with these words.
fn carom(words: &[&str]) -> (Option<i32>, String, String) {
    let done = Command::new(env!("CARGO_BIN_EXE_carom")).arg("run").args(words).output().expect("the built binary");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
    (done.status.code(), text(done.stdout), text(done.stderr))
}

#[test]
fn the_judge_changes_no_bit_and_says_that_all_is_well() {
    let (code, plain, _) = carom(&["paper-1", "--method", "exact", "--until", "5"]);
    let (checked_code, checked, told) = carom(&["paper-1", "--method", "exact", "--until", "5", "--check"]);
    assert_eq!((code, checked_code), (Some(0), Some(0)), "{told}");
    assert_eq!(checked.trim_end(), format!("{} check=ok", plain.trim_end()));
}

#[test]
fn a_method_that_gains_energy_is_told_and_condemned_if_asked() {
    // Euler frames let a bounce return from a place below the one that it has lost its energy for
    let (code, line, told) = carom(&["paper-3", "--until", "10"]);
    assert!(code == Some(0) && !line.contains("check="), "{line}{told}");
    let (code, line, told) = carom(&["paper-3", "--until", "10", "--check"]);
    assert!(code == Some(1) && line.contains(" check=1") && told.contains("the energy rises by"), "{line}{told}");
}
