//! Is going back the same as having stopped there? Bit for bit, through changes of settings, stalls and branches.

use std::{collections::BTreeMap, sync::Arc};

use super::*;
use crate::{
    random::SplitMix64,
    scene,
    snapshot::{Snapshot, Stage},
};

/// Units of work of one call where none may be cut short.
const WHOLE: u64 = 1 << 30;

/// Scenes of all kinds, how many of their frames are run, and how many of those are gone to: `CAROM_HISTORY=1000` goes to
/// so many in each.
const SCENES: [(&str, u64, u64); 9] = [
    ("paper-0", 2500, 1000),
    ("paper-1", 2500, 1000),
    ("paper-2", 2500, 1000),
    ("paper-4", 2500, 1000),
    ("zigzag", 1000, 1000),
    ("newtons-cradle", 1000, 1000),
    ("galton", 2000, 200),
    ("box-gas", 50, 20),
    ("inelastic-666", 40, 20),
];

fn job(name: &str, method: Method) -> Job {
    let opened = scene::open(name).expect("built in");
    let settings = Settings { method, ..opened.scene.solver };
    Job {
        stage: Arc::new(Stage::of(&opened.key, &opened.scene)),
        scene: Arc::new(opened.scene),
        settings,
        recording: None,
    }
}

/// A course, and what was seen at the end of each of its frames.
struct Walk {
    course: Course,
    seen: BTreeMap<u64, Snapshot>,
    random: SplitMix64,
}

impl Walk {
    fn new(name: &str, method: Method) -> Walk {
        let course = Course::new(job(name, method));
        let mut walk = Walk { course, seen: BTreeMap::new(), random: SplitMix64::new(7) };
        walk.look();
        walk
    }

    /// A number below `count`.
    fn below(&mut self, count: u64) -> u64 {
        (self.random.unit() * count as f64) as u64
    }

    /// All that is shown of the frame at which the run is.
    fn told(&self) -> Snapshot {
        Snapshot::of(&self.course.job().stage, self.course.simulation(), self.course.stall())
    }

    fn look(&mut self) {
        let told = self.told();
        self.seen.insert(self.course.frame(), told);
    }

    /// One frame on, keyframes some thirty frames apart; false if the run cannot go on.
    fn frame(&mut self) -> bool {
        let progress = self.course.advance(Until::Frame, WHOLE);
        let work = 3e-3 * f64::from(u8::from(self.below(30) == 0));
        self.course.note_work(work, || 0.0);
        self.look();
        progress == Progress::Reached
    }

    /// Goes to a frame that was seen, in slices, and finds it as it was.
    fn visit(&mut self, frame: u64, name: &str) {
        let newest = self.course.newest();
        self.course.set_out(frame);
        while !self.course.is_at(frame) {
            let work = 1 + self.below(200);
            let progress = self.course.advance(Until::Frame, work);
            let cost = 4e-3 * f64::from(u8::from(self.below(50) == 0));
            self.course.note_work(cost, || 0.0);
            assert!(!matches!(progress, Progress::Stalled(_)) && self.course.frame() <= frame, "{name}: {progress:?}");
        }
        let (told, seen) = (self.told(), &self.seen[&frame]);
        assert_eq!((told.hash(), told.tallies), (seen.hash(), seen.tallies), "{name}: frame {frame}");
        assert!(told == *seen, "{name}: frame {frame}: {told:?}, not {seen:?}");
        assert_eq!(self.course.newest(), newest, "{name}");
        assert_eq!(self.course.is_past(), frame < newest.0, "{name}");
    }

    fn visit_many(&mut self, times: u64, name: &str) {
        let newest = self.course.newest().0;
        for _ in 0..times {
            let frame = self.below(newest + 1);
            self.visit(frame, name);
        }
    }
}

#[test]
fn every_frame_is_found_again_as_it_was() {
    let wanted: Option<u64> = std::env::var("CAROM_HISTORY").ok().map(|count| count.parse().expect("a number"));
    for (name, frames, visits) in SCENES {
        for &method in Method::ALL {
            let mut walk = Walk::new(name, method);
            for _ in 0..frames {
                if !walk.frame() {
                    break;
                }
            }
            walk.visit_many(wanted.unwrap_or(visits), &format!("{name} by {method:?}"));
        }
    }
}

#[test]
fn one_frame_back_after_another_leads_through_the_same_frames() {
    for &method in Method::ALL {
        let mut walk = Walk::new("paper-3", method);
        (0..300).all(|_| walk.frame());
        for frame in (0..walk.course.frame()).rev() {
            walk.visit(frame, "paper-3");
        }
        for frame in [0, 5, 6, 7, 100, 17, walk.course.newest().0] {
            walk.visit(frame, "paper-3");
        }
    }
}

/// Settings that differ from the last ones in one knob.
fn turned(walk: &mut Walk) -> Settings {
    let now = walk.course.settings();
    match walk.below(4) {
        0 => Settings { dt: [0.01, 0.004, 0.03][walk.below(3) as usize], ..now },
        1 => Settings { tolerance: [1e-3, 1e-6, 1e-9][walk.below(3) as usize], ..now },
        _ => Settings { method: Method::ALL[walk.below(4) as usize], ..now },
    }
}

/// On for so many turns, knobs turned now and then, also within a frame and where a run cannot go on.
fn wander(walk: &mut Walk, turns: u64) {
    for _ in 0..turns {
        if walk.below(25) == 0 || walk.course.stall().is_some() {
            for _ in 0..=walk.below(2) {
                let settings = turned(walk);
                if !walk.course.set(settings) {
                    walk.look();
                }
            }
        }
        let work = if walk.below(2) == 0 { 1 + walk.below(20) } else { WHOLE };
        walk.course.advance(Until::Frame, work);
        let cost = 3e-3 * f64::from(u8::from(walk.below(30) == 0));
        walk.course.note_work(cost, || 0.0);
        if walk.course.whole || walk.course.stall().is_some() {
            walk.look(); // within a frame, its contacts are told one by one
        }
    }
}

#[test]
fn changes_of_settings_are_done_again_at_the_frames_where_they_were_made() {
    for name in ["paper-0", "paper-2", "paper-4", "zigzag", "newtons-cradle"] {
        for &method in Method::ALL {
            let mut walk = Walk::new(name, method);
            wander(&mut walk, 1500);
            assert!(walk.course.changes.len() > 20, "{name}");
            walk.visit_many(300, &format!("{name} from {method:?} on"));
        }
    }
}

#[test]
fn a_run_that_could_not_go_on_is_found_again_before_and_after_its_stall() {
    // resting in a wedge stalls the printed method near 10.3 s
    let mut walk = Walk::new("paper-2", Method::Paper);
    while walk.frame() {}
    let stalled = walk.course.frame();
    assert!(walk.course.stall().is_some());
    walk.visit(stalled - 3, "before");
    walk.visit(stalled, "at the stall");
    assert!(walk.course.stall().is_some(), "the newest frame is as it was");
    let other = Settings { tolerance: 1e-5, ..walk.course.settings() };
    walk.course.set(other); // tried again, in vain
    walk.look();
    while walk.frame() {}
    let other = Settings { method: Method::Exact, ..other };
    walk.course.set(other);
    walk.look();
    for _ in 0..100 {
        walk.frame();
    }
    assert!(walk.course.changes.iter().all(|change| change.stalled), "both were made where it could not go on");
    for frame in [stalled + 50, stalled, stalled - 1, stalled + 1, 0, stalled] {
        walk.visit(frame, "through the stall");
    }
}

#[test]
fn a_branch_drops_the_later_frames_and_has_a_history_of_its_own() {
    let mut walk = Walk::new("paper-4", Method::Exact);
    wander(&mut walk, 600);
    let newest = walk.course.frame();
    walk.visit(newest / 2, "there");
    assert_eq!(walk.course.branch(), newest - newest / 2);
    assert!(!walk.course.is_past());
    walk.seen.retain(|&frame, _| frame <= newest / 2);
    wander(&mut walk, 400);
    assert!(walk.course.frame() > newest / 2);
    walk.visit_many(300, "after the branch");
}

#[test]
fn times_and_impacts_are_found_where_they_were() {
    let mut walk = Walk::new("paper-3", Method::Swept);
    let mut frames = vec![(0.0, 0)];
    for _ in 0..800 {
        walk.frame();
        frames.push((walk.course.time(), walk.course.impacts()));
    }
    for _ in 0..200 {
        let t = frames[800].0 * walk.random.unit();
        walk.course.set_out_for(t);
        while walk.course.time() < t {
            walk.course.advance(Until::Time(t), 50);
        }
        let first = frames.iter().position(|(end, _)| *end >= t).expect("it was passed") as u64;
        assert_eq!(walk.course.frame(), first, "the first frame that ends at or after {t} s");
    }
    let impacts = frames[800].1;
    for count in 1..=impacts {
        assert!(walk.course.set_out_for_impact(count));
        while walk.course.impacts() < count {
            walk.course.advance(Until::Frame, 50);
        }
        let first = frames.iter().position(|(_, there)| *there >= count).expect("it was passed") as u64;
        assert_eq!(walk.course.frame(), first, "impact {count}");
    }
    assert!(!walk.course.set_out_for_impact(0), "there was none before the first");
}

#[test]
fn while_nothing_else_is_to_do_a_keyframe_is_put_before_the_last_frames() {
    let mut walk = Walk::new("paper-4", Method::Exact);
    for _ in 0..900 {
        walk.course.advance(Until::Frame, WHOLE);
        walk.look();
    }
    walk.course.note_work(5e-3, || 0.0); // all of them, as far as is known: too much to be done again for a frame
    let settings = Settings { tolerance: 1e-5, ..walk.course.settings() };
    walk.course.set(settings);
    walk.look();
    for _ in 0..50 {
        walk.course.advance(Until::Frame, WHOLE);
        walk.look();
    }
    let newest = walk.course.frame();
    assert_eq!(walk.course.keyframes.before(newest - 1).map(|kept| kept.frame), Some(900));
    walk.course.set_out(850);
    while !walk.course.is_at(850) {
        walk.course.advance(Until::Frame, WHOLE);
    }
    let mut turns = 0;
    while walk.course.scout(WHOLE, || 0.0) {
        turns += 1;
        assert!(turns < 10, "it ends");
    }
    assert_eq!(walk.course.keyframes.before(849).map(|kept| kept.frame), Some(750));
    assert!(!walk.course.scout(WHOLE, || 0.0), "and once is enough");
    for frame in [760, 751, 750, 749, 899, 900, 901] {
        walk.visit(frame, "from a scout's keyframe");
    }
}

#[test]
fn frames_that_are_too_many_to_count_are_not_kept() {
    let mut walk = Walk::new("paper-0", Method::Exact);
    (0..50).all(|_| walk.frame());
    let tiny = Settings { dt: 1e-13, ..walk.course.settings() };
    walk.course.set(tiny);
    walk.course.advance(Until::Time(5.0), WHOLE);
    assert_eq!(walk.course.oldest().0, walk.course.frame());
    walk.course.set_out(3);
    assert!(!walk.course.is_past(), "there is nothing to go back to");
}
