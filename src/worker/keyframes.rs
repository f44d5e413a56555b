//! Moments of a run that are kept, so that any frame is a short replay away: bounded memory, the oldest thinned first.
//!
//! Where they lie follows from counted work, so that they are equal on every machine, however busy.

use super::{acting::Acting, replay_cost::Meter};
use crate::{
    physics::{Keyframe, Simulation},
    snapshot::{EventLog, shows_trials},
};

/// Memory that the history of a run may take, bytes: keyframes and the list of events.
const HISTORY: usize = 64 << 20;

/// Memory that all keyframes may take, bytes.
pub(super) const BUDGET: usize = HISTORY - EventLog::MOST_BYTES;

/// Memory that a single keyframe may take, bytes: of a run that needs more none is kept.
const LARGEST: usize = HISTORY / 4;

/// Least work from one keyframe to the next, in counted ns: a replay that is not noticed.
pub(super) const SPACING: u64 = 1_000_000;

/// Work from one keyframe to the next for each byte of it, in counted ns: a copy takes a few hundredths of that.
const SPACING_OF_A_BYTE: u64 = 6;

/// Most work between two keyframes, ns, until they are thinned: one frame back is on the screen at once, whatever a copy
/// costs.
pub(super) const CLOSE: u64 = 3_000_000;

/// Most work between two keyframes after thinning, ns: what a replay may take.
pub(super) const FARTHEST: u64 = 50_000_000;

/// Last frames, which are gone back to most: their keyframes are not thinned as long as others are left.
pub(super) const RECENT: u64 = 100;

/// A keyframe and where it belongs.
#[derive(Debug)]
pub(super) struct Kept {
    /// Number of frames completed at the keyframe.
    pub(super) frame: u64,
    /// Time of the keyframe, s.
    pub(super) time: f64,
    /// Impacts up to the keyframe.
    pub(super) impacts: u64,
    /// Number of recorded changes that the keyframe includes.
    pub(super) changes: usize,
    /// Whether the frame that ended at the keyframe is shown with its inside, which a keyframe does not hold.
    has_inside: bool,
    /// Work from the keyframe before, ns.
    gap: u64,
    keyframe: Keyframe,
    /// What acts over the frame that ended at the keyframe.
    pub(super) acting: Acting,
    /// Memory that the keyframe takes, bytes.
    bytes: usize,
}

impl Kept {
    /// A run between two frames, with the number of recorded changes it includes, and what acts over the frame that has
    /// ended; none if it is too large.
    fn of(run: &Simulation, (changes, acting): (usize, &Acting)) -> Option<Kept> {
        if run.model().len() * size_of::<[f64; 6]>() > LARGEST {
            return None; // it need not be tried
        }
        let (keyframe, acting) = (run.keyframe(), acting.clone());
        let tallies = run.tallies();
        let (frame, impacts) = (tallies.frames, tallies.impacts);
        let has_inside = frame > 0 && shows_trials(run);
        let bytes = keyframe.bytes() + acting.bytes();
        let kept = Kept { frame, time: run.time(), impacts, changes, has_inside, gap: 0, keyframe, acting, bytes };
        (bytes <= LARGEST).then_some(kept)
    }

    /// The run as it was.
    pub(super) fn run(&self) -> Simulation {
        self.keyframe.run()
    }
}

/// The keyframes of a run, in the order of their frames.
#[derive(Debug)]
pub(super) struct Keyframes {
    list: Vec<Kept>,
    /// Memory that the keyframes take, bytes.
    bytes: usize,
    /// Memory that the keyframes may take, bytes.
    room: usize,
    /// Counts the work of the run.
    meter: Meter,
    /// Work since the last keyframe, ns, up to the last look.
    since: u64,
    /// Frames completed at the last look.
    looked: u64,
    /// Work after which the next keyframe is kept, ns.
    spacing: u64,
    /// Work between two keyframes to which the list has been thinned, ns.
    thinned: u64,
    /// The first frame after the last one that was dropped, and its time, s; none as long as all are a short way off.
    front: Option<(u64, f64)>,
    /// Whether the run's keyframes are too large to keep any.
    too_large: bool,
}

impl Keyframes {
    /// The keyframes of a run that is between two frames: the present one, if it is not too large.
    pub(super) fn of(run: &Simulation) -> Keyframes {
        let mut keyframes = Keyframes::none(run);
        keyframes.keep(run, (0, &Acting::default()));
        keyframes
    }

    /// No keyframes yet: the first frame that ends from here on is kept.
    pub(super) fn none(run: &Simulation) -> Keyframes {
        Keyframes {
            list: Vec::new(),
            bytes: 0,
            room: BUDGET,
            meter: Meter::of(run),
            since: 0,
            looked: run.tallies().frames,
            spacing: SPACING,
            thinned: 0,
            front: None,
            too_large: false,
        }
    }

    /// The first keyframe.
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

    /// Keeps a run that is between two frames, its newest, if it is time to, with the number of recorded changes it
    /// includes, and what acts over the frame that has ended. Asked at every frame; what that has cost, ns of counted work.
    pub(super) fn look(&mut self, run: &Simulation, told: (usize, &Acting)) -> u64 {
        let frame = run.tallies().frames;
        if self.too_large || frame <= self.looked {
            return 0;
        }
        self.looked = frame;
        let work = self.meter.read(run);
        self.since = self.since.saturating_add(work);
        if self.since >= self.spacing || self.list.is_empty() {
            self.keep(run, told);
        }
        work
    }

    /// Keeps a run between two frames, behind all others.
    fn keep(&mut self, run: &Simulation, told: (usize, &Acting)) {
        let Some(mut kept) = Kept::of(run, told) else {
            self.too_large = true;
            return;
        };
        let bytes = kept.bytes;
        self.spacing = (bytes as u64).saturating_mul(SPACING_OF_A_BYTE).clamp(SPACING, CLOSE);
        kept.gap = std::mem::take(&mut self.since);
        self.bytes += bytes;
        self.list.push(kept);
        if self.bytes > self.room {
            self.thin();
        }
    }

    /// Keeps a run between two frames, its newest, as if it had done this much more `work` (ns).
    #[cfg(test)]
    pub(super) fn keep_now(&mut self, run: &Simulation, told: (usize, &Acting), work: u64) {
        if self.list.last().is_none_or(|last| last.frame < run.tallies().frames) {
            self.since += self.meter.read(run) + work;
            self.keep(run, told);
        }
    }

    /// Gives the keyframes less room, bytes.
    #[cfg(test)]
    pub(super) fn shrink(&mut self, room: usize) {
        self.room = room;
    }

    /// The frames that are kept.
    #[cfg(test)]
    pub(super) fn frames(&self) -> Vec<u64> {
        self.list.iter().map(|kept| kept.frame).collect()
    }

    /// Keeps a run at its place among the others, so much work (ns) after the one before, unless that frame is kept, or
    /// there is no room but that of frames that would be lost.
    pub(super) fn insert(&mut self, run: &Simulation, told: (usize, &Acting), work: u64) {
        let frame = run.tallies().frames;
        let is_kept = self.list.binary_search_by_key(&frame, |other| other.frame).is_ok();
        let Some(mut kept) = Kept::of(run, told).filter(|_| !is_kept) else { return };
        if self.bytes + kept.bytes > self.room && !self.thin_out() {
            return;
        }
        kept.gap = work;
        let place = self.list.partition_point(|other| other.frame < frame);
        let after = self.list.get_mut(place).map_or(&mut self.since, |after| &mut after.gap);
        *after = after.saturating_sub(work);
        self.bytes += kept.bytes;
        self.list.insert(place, kept);
    }

    /// A keyframe from which a run should be done again up to the last frame that is [`RECENT`] before `frame`, to be kept
    /// there: between it and the next lies so much work that going back frame by frame from `frame` would be slow.
    pub(super) fn lacking_before(&self, frame: u64) -> Option<&Kept> {
        let target = frame.checked_sub(RECENT)?;
        let count = self.list.partition_point(|kept| kept.frame <= target);
        let before = &self.list[count.checked_sub(1)?];
        let work = self.list.get(count).map_or(self.since, |after| after.gap);
        (before.frame + RECENT < target && work > CLOSE).then_some(before)
    }

    /// Drops what came after the frame at which the run is; the next one is worth a keyframe.
    pub(super) fn cut(&mut self, run: &Simulation) {
        let (frame, time) = (run.tallies().frames, run.time());
        self.meter = Meter::of(run);
        let count = self.list.partition_point(|kept| kept.frame <= frame);
        let gap = self.list.get(count).map_or(self.since, |after| after.gap);
        self.bytes -= self.list[count..].iter().map(|kept| kept.bytes).sum::<usize>();
        self.list.truncate(count);
        // the work up to here is not known, but no more than up to the first that was dropped
        (self.since, self.spacing, self.looked) = (gap, 0, frame);
        self.front = self.front.map(|front| if front.0 > frame { (frame, time) } else { front });
    }

    /// Drops every second one of the oldest keyframes, as long as what is left is a short way apart; then the oldest for
    /// good.
    fn thin(&mut self) {
        if self.thin_out() {
            return;
        }
        let (mut dropped, mut gone) = (1, 0_u64);
        while self.bytes > self.thin_to() && dropped + 1 < self.list.len() {
            self.bytes -= self.list[dropped].bytes;
            gone = gone.saturating_add(self.list[dropped].gap);
            dropped += 1;
        }
        self.list.drain(1..dropped);
        // so far it is from the start now: it is not to be merged
        if let Some(front) = self.list.get_mut(1) {
            front.gap = front.gap.saturating_add(gone);
        }
        // the inside of that frame itself would take the run from the start
        self.front = self.list.get(1).map(|kept| (kept.frame + u64::from(kept.has_inside), kept.time));
    }

    /// Drops every second one of the oldest keyframes, as long as what is left is a short way apart; whether there is room
    /// then.
    fn thin_out(&mut self) -> bool {
        let newest = self.list.last().map_or(0, |kept| kept.frame);
        let recent = self.list.partition_point(|kept| kept.frame + RECENT < newest);
        self.thinned = self.thinned.max(SPACING);
        loop {
            self.merge(recent);
            if self.bytes <= self.thin_to() || self.thinned >= FARTHEST {
                return self.bytes <= self.thin_to();
            }
            self.thinned = (2 * self.thinned).min(FARTHEST);
        }
    }

    /// What is left of the room after a thinning, bytes, so that it need not be done again at once.
    fn thin_to(&self) -> usize {
        self.room / 8 * 7
    }

    /// Drops every keyframe between whose neighbours no more work lies than thinning allows now, from the oldest on and
    /// up to the one at `recent`, until there is room. The first stays.
    fn merge(&mut self, recent: usize) {
        let (mut bytes, mut gone, thinned, left) = (self.bytes, 0_u64, self.thinned, self.thin_to());
        let gaps: Vec<u64> = self.list.iter().map(|kept| kept.gap).collect();
        let mut i = 0;
        self.list.retain_mut(|kept| {
            let next = gaps.get(i + 1).copied().unwrap_or(u64::MAX);
            let between = gone.saturating_add(kept.gap).saturating_add(next);
            let goes = bytes > left && i > 0 && i < recent && between <= thinned;
            i += 1;
            if goes {
                bytes -= kept.bytes;
                gone = gone.saturating_add(kept.gap);
            } else {
                kept.gap = kept.gap.saturating_add(std::mem::take(&mut gone));
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

    /// A run of a thousand spheres, one keyframe a frame, each `gap` (ns) of work from the last.
    fn filled(frames: usize, gap: u64) -> (Keyframes, Simulation) {
        let scene = scene::open("box-gas").expect("built in").scene;
        let mut run = Simulation::new(&scene, Settings { method: Method::Exact, ..scene.solver });
        let mut keyframes = Keyframes::of(&run);
        for _ in 0..frames {
            assert_eq!(run.advance(Until::Frame, 1 << 30), Progress::Reached);
            keyframes.since += gap;
            keyframes.keep(&run, (0, &Acting::default()));
            assert!(keyframes.bytes <= BUDGET);
        }
        (keyframes, run)
    }

    #[test]
    fn the_oldest_are_thinned_first_and_the_last_hundred_frames_stay() {
        let (keyframes, run) = filled(2000, SPACING);
        let kept: Vec<u64> = keyframes.list.iter().map(|kept| kept.frame).collect();
        let newest = run.tallies().frames;
        assert_eq!((kept[0], kept.last()), (0, Some(&newest)));
        assert!((newest - RECENT..=newest).all(|frame| kept.contains(&frame)), "{kept:?}");
        assert!(kept.len() < 2000, "{} are kept", kept.len());
        assert!(keyframes.list.iter().all(|kept| kept.gap <= FARTHEST), "each is a short way from the one before");
        assert_eq!(keyframes.front(), None);
        let sum: u64 = keyframes.list.iter().map(|kept| kept.gap).sum();
        assert_eq!(sum, 2000 * SPACING, "no work is lost");
    }

    #[test]
    fn what_would_be_a_long_way_apart_is_dropped_for_good_but_for_the_start() {
        let (keyframes, run) = filled(2000, FARTHEST / 5 * 4);
        let (front, _) = keyframes.front().expect("they were too many");
        assert!(front > 0 && front < run.tallies().frames - RECENT, "{front}");
        assert_eq!((keyframes.list[0].frame, keyframes.list[1].frame), (0, front));
        assert!(keyframes.list[1].gap > FARTHEST, "so far it is from the start");
        assert!(keyframes.list[2..].iter().all(|kept| kept.gap <= FARTHEST));
    }

    #[test]
    fn what_comes_after_a_frame_is_cut_off_and_the_next_is_kept() {
        let (mut keyframes, run) = filled(50, SPACING);
        let mut back = keyframes.before(20).expect("each is kept").run();
        keyframes.cut(&back);
        assert_eq!(keyframes.list.last().map(|kept| kept.frame), Some(20));
        assert_eq!(keyframes.bytes, keyframes.list.iter().map(|kept| kept.bytes).sum::<usize>());
        assert_eq!(keyframes.before(7).map(|kept| kept.frame), Some(7));
        back.advance(Until::Frame, 1 << 30);
        keyframes.look(&back, (0, &Acting::default()));
        assert_eq!(keyframes.list.last().map(|kept| kept.frame), Some(21));
        assert!(run.tallies().frames > 21);
    }

    #[test]
    fn a_frame_is_kept_after_counted_work_and_never_twice() {
        let (mut keyframes, mut run) = filled(0, 0);
        let (mut kept, mut since) = (1, 0);
        for _ in 0..3000 {
            assert_eq!(run.advance(Until::Frame, 1 << 30), Progress::Reached);
            since += keyframes.look(&run, (0, &Acting::default()));
            let is_due = since >= keyframes.spacing;
            assert_eq!(keyframes.look(&run, (0, &Acting::default())), 0, "a frame is looked at once");
            if keyframes.list.len() > kept {
                assert!(since >= SPACING, "too early: {since} ns");
                (kept, since) = (kept + 1, 0);
            } else {
                assert!(!is_due, "{since} ns are enough");
            }
        }
        assert!(kept > 3, "{kept}");
    }
}
