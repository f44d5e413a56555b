//! Moments of a run that are kept, so that any frame is a short replay away: bounded memory, the oldest thinned first.
//!
//! Where they lie depends on how fast the machine is; what a replay from them leads to does not.

use crate::{
    physics::{Keyframe, Simulation},
    snapshot::{EventLog, shows_trials},
};

/// Memory that the history of a run may take, bytes: keyframes and the list of events.
const HISTORY: usize = 64 << 20;

/// Memory that all keyframes may take, bytes.
pub(super) const BUDGET: usize = HISTORY - EventLog::MOST_BYTES;

/// What is left of the budget after a thinning, so that it need not be done again at once.
const THINNED: usize = BUDGET / 8 * 7;

/// Memory that a single keyframe may take, bytes: of a run that needs more none is kept.
const LARGEST: usize = HISTORY / 4;

/// Work from one keyframe to the next, s, unless copying costs more than a share of it: a replay that is not noticed.
const SPACING: f64 = 1e-3;

/// How many times what a copy costs lies between two: three hundredths are not noticed.
const SHARE: f64 = 32.0;

/// Work between two at most, s, whatever a copy costs, and after thinning: what a replay may take.
const FARTHEST: f64 = 0.05;

/// Frames between two at most: where frames are nearly free, a replay still looks at each.
pub(super) const MOST_FRAMES: u64 = 1 << 14;

/// The last frames, which one goes back to most: their keyframes are not thinned as long as others are left.
pub(super) const RECENT: u64 = 100;

/// Work from one keyframe to the next, s, that is too much where one goes back frame by frame.
pub(super) const NOTICED: f64 = 3e-3;

/// A keyframe and where it belongs.
#[derive(Debug)]
pub(super) struct Kept {
    /// Frames completed then.
    pub(super) frame: u64,
    /// Time then, s.
    pub(super) time: f64,
    /// Impacts until then.
    pub(super) impacts: u64,
    /// Recorded changes that it includes.
    pub(super) changes: usize,
    /// Whether the frame that ended then is shown with its inside, which a keyframe does not hold.
    has_inside: bool,
    /// Work from the keyframe before, s.
    gap: f64,
    keyframe: Keyframe,
}

impl Kept {
    /// A run between two frames, with the number of recorded changes it includes; none if it is too large.
    fn of(run: &Simulation, changes: usize) -> Option<Kept> {
        if run.model().len() * size_of::<[f64; 6]>() > LARGEST {
            return None; // it need not be tried
        }
        let keyframe = run.keyframe();
        let tallies = run.tallies();
        let (frame, impacts) = (tallies.frames, tallies.impacts);
        let has_inside = frame > 0 && shows_trials(run);
        let kept = Kept { frame, time: run.time(), impacts, changes, has_inside, gap: 0.0, keyframe };
        (kept.keyframe.bytes() <= LARGEST).then_some(kept)
    }

    /// The run as it was.
    pub(super) fn run(&self) -> Simulation {
        self.keyframe.run()
    }
}

/// The keyframes of a run, in the order of their frames.
#[derive(Debug, Default)]
pub(super) struct Keyframes {
    list: Vec<Kept>,
    bytes: usize,
    /// Work since the last one, s.
    since: f64,
    /// What copying cost last time, s.
    copying: f64,
    /// How far the list has been thinned: work between two, s.
    thinned: f64,
    /// The first frame after the last one that was dropped, and its time, s; none as long as all are a short way off.
    front: Option<(u64, f64)>,
    /// Whether the run's keyframes are too large to keep any.
    too_large: bool,
}

impl Keyframes {
    /// The first of all.
    pub(super) fn first(&self) -> Option<&Kept> {
        self.list.first()
    }

    /// The keyframe nearest before `frame`, or at it, if all that is shown of it is there; else the first of all.
    pub(super) fn before(&self, frame: u64) -> Option<&Kept> {
        let near = self.last_where(|kept| kept.frame < frame || kept.frame == frame && !kept.has_inside);
        near.or(self.first().filter(|first| first.frame == frame))
    }

    /// The last keyframe of a beginning of the list in which all are `so`.
    pub(super) fn last_where(&self, so: impl Fn(&Kept) -> bool) -> Option<&Kept> {
        let count = self.list.partition_point(so);
        count.checked_sub(1).map(|last| &self.list[last])
    }

    /// The first frame from which on every frame is a short way off, and its time, s; none if all are.
    pub(super) fn front(&self) -> Option<(u64, f64)> {
        self.front
    }

    /// Takes note of work that the run has done, s.
    pub(super) fn note_work(&mut self, seconds: f64) {
        self.since += seconds;
    }

    /// Whether it is time to keep `frame`.
    pub(super) fn is_due(&self, frame: u64) -> bool {
        let last = self.list.last().map_or(0, |kept| kept.frame);
        let far = self.since >= (SHARE * self.copying).clamp(SPACING, FARTHEST) || frame - last >= MOST_FRAMES;
        !self.too_large && (far || self.list.is_empty()) && (frame > last || self.list.is_empty())
    }

    /// Keeps a run between two frames, behind all others, with the number of recorded changes it includes; `clock`
    /// tells the time, s.
    pub(super) fn keep(&mut self, run: &Simulation, changes: usize, clock: impl Fn() -> f64) {
        let start = clock();
        let Some(mut kept) = Kept::of(run, changes) else {
            self.too_large = true;
            return;
        };
        // a copy that was interrupted tells nothing
        let took = clock() - start;
        self.copying = if self.copying > 0.0 { took.min(1.25 * self.copying) } else { took };
        kept.gap = std::mem::take(&mut self.since);
        self.bytes += kept.keyframe.bytes();
        self.list.push(kept);
        if self.bytes > BUDGET {
            self.thin();
        }
    }

    /// Keeps a run at its place among the others, so much work (s) after the one before, unless that frame is kept.
    pub(super) fn insert(&mut self, run: &Simulation, changes: usize, work: f64) {
        let frame = run.tallies().frames;
        let place = self.list.partition_point(|other| other.frame < frame);
        if self.list.get(place).is_some_and(|other| other.frame == frame) {
            return;
        }
        let Some(mut kept) = Kept::of(run, changes) else { return };
        kept.gap = work;
        let after = self.list.get_mut(place).map_or(&mut self.since, |after| &mut after.gap);
        *after = (*after - work).max(0.0);
        self.bytes += kept.keyframe.bytes();
        self.list.insert(place, kept);
        if self.bytes > BUDGET {
            self.thin();
        }
    }

    /// A keyframe from which a run should be done again up to the last frame that is [`RECENT`] before `frame`, to be kept
    /// there: between it and the next lies so much work that going back frame by frame from `frame` would be slow.
    pub(super) fn lacking_before(&self, frame: u64) -> Option<&Kept> {
        let target = frame.checked_sub(RECENT)?;
        let count = self.list.partition_point(|kept| kept.frame <= target);
        let before = &self.list[count.checked_sub(1)?];
        let work = self.list.get(count).map_or(self.since, |after| after.gap);
        (before.frame + RECENT < target && work > NOTICED).then_some(before)
    }

    /// Drops what came after `frame`, at which the run is, at `time` (s); the next frame is worth a keyframe.
    pub(super) fn cut(&mut self, frame: u64, time: f64) {
        let count = self.list.partition_point(|kept| kept.frame <= frame);
        self.bytes -= self.list[count..].iter().map(|kept| kept.keyframe.bytes()).sum::<usize>();
        self.list.truncate(count);
        self.since = FARTHEST;
        self.front = self.front.map(|front| if front.0 > frame { (frame, time) } else { front });
    }

    /// Every second one of the oldest goes, as long as what is left is a short way apart; then the oldest go for good.
    fn thin(&mut self) {
        let newest = self.list.last().map_or(0, |kept| kept.frame);
        let recent = self.list.partition_point(|kept| kept.frame + RECENT < newest);
        self.thinned = self.thinned.max(SPACING);
        loop {
            self.merge(recent);
            if self.bytes <= THINNED {
                return;
            }
            if self.thinned >= FARTHEST {
                break;
            }
            self.thinned = (2.0 * self.thinned).min(FARTHEST);
        }
        let mut dropped = 1;
        while self.bytes > THINNED && dropped + 1 < self.list.len() {
            self.bytes -= self.list[dropped].keyframe.bytes();
            dropped += 1;
        }
        self.list.drain(1..dropped);
        self.front = self.list.get(1).map(|kept| (kept.frame, kept.time));
    }

    /// Drops every keyframe between whose neighbours no more work lies than thinning allows now, from the oldest on and
    /// up to the one at `recent`, until there is room. The first stays.
    fn merge(&mut self, recent: usize) {
        let (mut bytes, mut gone, thinned) = (self.bytes, 0.0, self.thinned);
        let gaps: Vec<f64> = self.list.iter().map(|kept| kept.gap).collect();
        let mut i = 0;
        self.list.retain_mut(|kept| {
            let next = gaps.get(i + 1).copied().unwrap_or(f64::INFINITY);
            let goes = bytes > THINNED && i > 0 && i < recent && gone + kept.gap + next <= thinned;
            i += 1;
            if goes {
                bytes -= kept.keyframe.bytes();
                gone += kept.gap;
            } else {
                kept.gap += std::mem::take(&mut gone);
            }
            !goes
        });
        self.bytes = bytes;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::{Progress, Until};
    use crate::scene::{self, Method, Settings};

    /// A run of a thousand spheres, one keyframe a frame, each `gap` (s) of work from the last; what the clock tells.
    fn filled(frames: usize, gap: f64) -> (Keyframes, Simulation) {
        let scene = scene::open("box-gas").expect("built in").scene;
        let mut run = Simulation::new(&scene, Settings { method: Method::Exact, ..scene.solver });
        let mut keyframes = Keyframes::default();
        keyframes.keep(&run, 0, || 0.0);
        for _ in 0..frames {
            assert_eq!(run.advance(Until::Frame, 1 << 30), Progress::Reached);
            keyframes.note_work(gap);
            keyframes.keep(&run, 0, || 0.0);
            assert!(keyframes.bytes <= BUDGET);
        }
        (keyframes, run)
    }

    #[test]
    fn the_oldest_are_thinned_first_and_the_last_hundred_frames_stay() {
        let (keyframes, run) = filled(2000, 1e-3);
        let kept: Vec<u64> = keyframes.list.iter().map(|kept| kept.frame).collect();
        let newest = run.tallies().frames;
        assert_eq!((kept[0], kept.last()), (0, Some(&newest)));
        assert!((newest - RECENT..=newest).all(|frame| kept.contains(&frame)), "{kept:?}");
        assert!(kept.len() < 2000, "{} are kept", kept.len());
        assert!(keyframes.list.iter().all(|kept| kept.gap <= FARTHEST), "each is a short way from the one before");
        assert_eq!(keyframes.front(), None);
        let sum: f64 = keyframes.list.iter().map(|kept| kept.gap).sum();
        assert!((sum - 2.0).abs() < 1e-9, "no work is lost: {sum} s; rounding of 2000 sums only");
    }

    #[test]
    fn what_would_be_a_long_way_apart_is_dropped_for_good_but_for_the_start() {
        let (keyframes, run) = filled(2000, 0.04);
        let (front, _) = keyframes.front().expect("they were too many");
        assert!(front > 0 && front < run.tallies().frames - RECENT, "{front}");
        assert_eq!((keyframes.list[0].frame, keyframes.list[1].frame), (0, front));
        assert!(keyframes.list[2..].iter().all(|kept| kept.gap <= FARTHEST));
    }

    #[test]
    fn what_comes_after_a_frame_is_cut_off() {
        let (mut keyframes, _) = filled(50, 1e-3);
        keyframes.cut(20, 0.1);
        assert_eq!(keyframes.list.last().map(|kept| kept.frame), Some(20));
        assert_eq!(keyframes.bytes, keyframes.list.iter().map(|kept| kept.keyframe.bytes()).sum::<usize>());
        assert_eq!(keyframes.before(7).map(|kept| kept.frame), Some(7));
    }

    #[test]
    fn a_keyframe_is_due_after_work_or_many_frames_and_never_twice_in_a_frame() {
        let (mut keyframes, run) = filled(0, 0.0);
        let frame = run.tallies().frames;
        assert!(!keyframes.is_due(frame));
        assert!(!keyframes.is_due(frame + 1));
        assert!(keyframes.is_due(frame + MOST_FRAMES));
        keyframes.note_work(SPACING);
        assert!(keyframes.is_due(frame + 1) && !keyframes.is_due(frame));
        keyframes.copying = SPACING;
        assert!(!keyframes.is_due(frame + 1), "it would cost too much");
        keyframes.note_work((SHARE - 1.0) * SPACING);
        assert!(keyframes.is_due(frame + 1));
    }
}
