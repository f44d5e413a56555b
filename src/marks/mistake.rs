//! Mistakes that programs of the paper's method are known for, told by what they leave in a trajectory.

use std::fmt;

/// A known mistake.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mistake {
    /// Both balls of a pair get the force in each of two visits.
    PairTwice,
    /// Half the force is added in a loop that visits a pair once.
    PairHalf,
    /// A resting contact cancels the weight and leaves the approach speed.
    RestingSpeedKept,
    /// A sphere that overlaps a wall is put on its surface.
    Projected,
    /// The normal of a wall points to its front wherever the sphere is.
    NormalAtTheBack,
    /// A step is longer than the way through a wall.
    Tunnelling,
    /// The tangential factor acts in each frame of a contact, not once per impact.
    TangentialEveryFrame,
    /// What approaches is called leaving, and what leaves colliding.
    ThresholdsSwapped,
    /// Answers act a step too late.
    OneStepLate,
}

impl Mistake {
    /// Every known mistake.
    pub const ALL: [Mistake; 9] = [
        Mistake::PairTwice,
        Mistake::PairHalf,
        Mistake::RestingSpeedKept,
        Mistake::Projected,
        Mistake::NormalAtTheBack,
        Mistake::Tunnelling,
        Mistake::TangentialEveryFrame,
        Mistake::ThresholdsSwapped,
        Mistake::OneStepLate,
    ];

    /// The word in tables and JSON.
    pub fn name(self) -> &'static str {
        match self {
            Mistake::PairTwice => "pair-twice",
            Mistake::PairHalf => "pair-half",
            Mistake::RestingSpeedKept => "resting-speed-kept",
            Mistake::Projected => "projected",
            Mistake::NormalAtTheBack => "normal-at-the-back",
            Mistake::Tunnelling => "tunnelling",
            Mistake::TangentialEveryFrame => "tangential-every-frame",
            Mistake::ThresholdsSwapped => "thresholds-swapped",
            Mistake::OneStepLate => "one-step-late",
        }
    }

    /// The mistake as a clause.
    pub fn words(self) -> &'static str {
        match self {
            Mistake::PairTwice => "the impulse of a pair acts twice on each ball",
            Mistake::PairHalf => "only half the impulse of a pair acts (F/2 is added once)",
            Mistake::RestingSpeedKept => "a resting contact keeps its approach speed and sinks",
            Mistake::Projected => "a sphere that overlaps a wall is moved to its surface",
            Mistake::NormalAtTheBack => "at the back of a wall the normal has the wrong sign",
            Mistake::Tunnelling => "a step takes a sphere through a wall that it never touched",
            Mistake::TangentialEveryFrame => "the tangential factor acts in every frame of a contact",
            Mistake::ThresholdsSwapped => "approaching contacts are left unanswered: the thresholds are swapped",
            Mistake::OneStepLate => "impacts are answered one step too late",
        }
    }
}

/// What speaks for a mistake.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Suspicion {
    /// The mistake.
    pub mistake: Mistake,
    /// Number of cases in which it was seen.
    pub seen: u64,
    /// Number of cases in which it could have been seen.
    pub of: u64,
}

impl fmt::Display for Suspicion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({} of {})", self.mistake.words(), self.seen, self.of)
    }
}

/// What was counted in a trajectory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Evidence {
    /// Impacts of pairs by themselves.
    pub(super) pairs: u64,
    /// Impacts of pairs by themselves with twice the impulse of the law.
    pub(super) twice: u64,
    /// Impacts of pairs by themselves with half the impulse of the law.
    pub(super) half: u64,
    /// Impacts answered.
    pub(super) answered: u64,
    /// Impacts answered a whole step after the bodies overlapped.
    pub(super) late: u64,
    /// Contacts at a front or of a pair that ended without an answer though the bodies approached in overlap.
    pub(super) ignored: u64,
    /// Contacts at a back that ended without an answer though the bodies approached in overlap.
    pub(super) ignored_behind: u64,
    /// Impacts answered at a back.
    pub(super) answered_behind: u64,
    /// Intervals in which a sphere lay on a wall.
    pub(super) rests: u64,
    /// Intervals in which a sphere that lay on a wall kept sinking.
    pub(super) sinking: u64,
    /// Intervals in which a sphere slid on a wall.
    pub(super) slides: u64,
    /// Intervals in which a sphere that slid on a wall lost tangential speed.
    pub(super) slowed: u64,
    /// Intervals that end on a wall's surface to rounding, whither no velocity led.
    pub(super) projected: u64,
    /// Ways through walls that were not touched before.
    pub(super) passages: u64,
}

/// Seen fewer times than this, an effect of many frames is an accident.
const OFTEN: u64 = 3;

/// Part of the cases from which a habit is one.
const MOST: f64 = 0.6;

impl Evidence {
    /// The likeliest mistake, if anything speaks for one.
    pub(super) fn suspicion(&self) -> Option<Suspicion> {
        let suspect = |mistake, seen, of, holds: bool| holds.then_some(Suspicion { mistake, seen, of });
        let most = |seen: u64, of: u64, least: u64| seen >= least && seen as f64 >= MOST * of as f64;
        let ignored = self.ignored + self.ignored_behind;
        let blind = ignored > 0 && self.answered == 0 && (self.ignored > 0 || self.ignored_behind == 0);
        let behind = self.ignored_behind > 0 && self.answered_behind == 0;
        let seen = [
            suspect(Mistake::PairTwice, self.twice, self.pairs, most(self.twice, self.pairs, 1)),
            suspect(Mistake::PairHalf, self.half, self.pairs, most(self.half, self.pairs, 1)),
            suspect(Mistake::Projected, self.projected, self.projected, self.projected >= OFTEN),
            suspect(Mistake::ThresholdsSwapped, ignored, ignored, blind),
            suspect(Mistake::NormalAtTheBack, self.ignored_behind, self.ignored_behind, behind),
            suspect(Mistake::OneStepLate, self.late, self.answered, most(self.late, self.answered, 2)),
            suspect(Mistake::TangentialEveryFrame, self.slowed, self.slides, most(self.slowed, self.slides, OFTEN)),
            suspect(Mistake::RestingSpeedKept, self.sinking, self.rests, self.sinking >= OFTEN),
            suspect(Mistake::Tunnelling, self.passages, self.passages, self.passages > 0),
        ];
        seen.into_iter().flatten().next()
    }
}
