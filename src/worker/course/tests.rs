//! Is going back the same as having stopped there? Bit for bit, through changes of settings, stalls and branches.

use std::{collections::BTreeMap, sync::Arc};

use super::*;
use crate::worker::keyframes::{BUDGET, FARTHEST};
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
        let told = Snapshot::of(&self.course.job().stage, self.course.simulation(), self.course.stall());
        Snapshot { acting: self.course.acting().to_vec(), ..told }
    }

    fn look(&mut self) {
        let told = self.told();
        self.seen.insert(self.course.frame(), told);
    }

    /// One frame on, keyframes some thirty frames apart; false if the run cannot go on.
    fn frame(&mut self) -> bool {
        let progress = self.course.advance(Until::Frame, WHOLE);
        self.keep_now_and_then();
        self.look();
        progress == Progress::Reached
    }

    /// Keyframes some thirty frames apart, beside those that the work asks for.
    fn keep_now_and_then(&mut self) {
        if self.below(30) == 0 && self.course.whole && !self.course.is_past() {
            let told = (self.course.changed, &self.course.acting);
            self.course.keyframes.keep_now(&self.course.simulation, told, 0);
        }
    }

    /// Goes to a frame that was seen, in slices, and finds it as it was.
    fn visit(&mut self, frame: u64, name: &str) {
        let newest = self.course.newest();
        self.course.set_out(frame);
        while !self.course.is_at(frame) {
            let work = 1 + self.below(200);
            let progress = self.course.advance(Until::Frame, work);
            if self.below(50) == 0 && self.course.whole && self.course.is_past() {
                let told = (self.course.changed, &self.course.acting);
                self.course.keyframes.insert(&self.course.simulation, told, 0);
            }
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
        walk.keep_now_and_then();
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
    // all of them, as far as is known, are too much to be done again for a frame
    walk.course.keyframes.keep_now(&walk.course.simulation, (walk.course.changed, &walk.course.acting), CLOSE + 1);
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

/// The frames that a run keeps which goes on to `time`, s, in calls of so much work, to goals so far from each other, s.
fn kept_by(name: &str, method: Method, time: f64, (work, goal): (u64, f64)) -> Vec<u64> {
    let mut course = Course::new(job(name, method));
    while course.time() < time && course.stall().is_none() {
        let until = if goal > 0.0 { Until::Time((course.time() + goal).min(time)) } else { Until::Frame };
        course.advance(until, work);
    }
    course.keyframes.frames()
}

#[test]
fn the_same_frames_are_kept_however_a_run_is_cut_into_calls() {
    for (name, time) in [("paper-2", 9.0), ("bouncing-49", 5.0), ("galton", 1.5), ("box-gas", 0.5), ("cannon", 10.0)] {
        for &method in Method::ALL {
            let whole = kept_by(name, method, time, (WHOLE, f64::INFINITY));
            for cut in [(50, f64::INFINITY), (1000, 0.037), (WHOLE, 0.0)] {
                let kept = kept_by(name, method, time, cut);
                assert_eq!(kept, whole, "{name} by {method:?} in calls of {cut:?}");
            }
        }
    }
}

/// Runs so many frames within so many bytes of history; then the most work, ns, that lies between a frame that is a short
/// way off and the keyframe that it is done again from, for the last hundred and for all; and the longest frame's.
fn longest_replays(name: &str, method: Method, frames: usize, room: usize) -> ([u64; 2], u64) {
    let mut course = Course::new(job(name, method));
    course.keyframes.shrink(room);
    let (mut meter, mut work) = (Meter::of(&course.simulation), vec![0]);
    for _ in 0..frames {
        if course.advance(Until::Frame, WHOLE) != Progress::Reached {
            break;
        }
        work.push(work.last().copied().unwrap_or(0) + meter.read(&course.simulation));
    }
    let front = course.kept().oldest as usize;
    let replay = |frame: usize| {
        let kept = course.keyframes.before(frame as u64).map_or(0, |kept| kept.frame as usize);
        work[frame] - work[kept]
    };
    let newest = work.len() - 1;
    let most = |from: usize| (from..=newest).map(replay).max().unwrap_or(0);
    let frame = work.windows(2).map(|ends| ends[1] - ends[0]).max().unwrap_or(0);
    ([most(front.max(newest.saturating_sub(RECENT as usize))), most(front)], frame)
}

#[test]
fn no_kept_frame_is_farther_off_than_the_work_that_is_allowed() {
    let scenes = [("paper-2", 2500), ("elastic-666", 400), ("inelastic-666", 300), ("galton", 600), ("box-gas", 300)];
    for (name, frames) in scenes {
        for &method in Method::ALL {
            let ([_, all], frame) = longest_replays(name, method, frames, BUDGET);
            // a frame that asks for its inside is done again as well
            assert!(all <= CLOSE + 2 * frame, "{name} by {method:?}: {all} ns, a frame takes {frame} ns");
            let room = if name == "paper-2" { 60_000 } else { 2_000_000 };
            let ([last, all], frame) = longest_replays(name, method, frames, room);
            assert!(all <= FARTHEST + 2 * frame, "{name} by {method:?} in {room} bytes: {all} ns, a frame {frame} ns");
            assert!(last <= FARTHEST + 2 * frame, "{name} by {method:?}: {last} ns, a frame {frame} ns");
        }
    }
}
