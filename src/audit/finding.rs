//! What the judge finds: plain data, one row per fault and bodies, however often it is seen.

use std::collections::BTreeMap;
use std::fmt;

use crate::physics::contact::Key;
use crate::physics::{Contact, Kind};

/// What is wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fault {
    /// A coordinate or a velocity is no finite number.
    NotANumber,
    /// Bodies overlap; the value is a degree.
    Overlap,
    /// A centre has gone through a wall between two frames; the value is how far it was on the other side, m.
    Passage,
    /// The normal of a contact is no unit vector, or does not point from the closest point to the centre.
    Normal,
    /// The point of a contact is not where the bodies touch; the value is a distance, m.
    Point,
    /// An impulse pulls, N s.
    Pull,
    /// An impulse is not what the impact law says; the value is the difference, N s.
    Impulse,
    /// A velocity after an impact is not what the impact law says; the value is the difference, m/s.
    Jump,
    /// An approach speed is not that of the bodies; the value is the difference, m/s.
    Approach,
    /// A velocity has changed by what no force and no impulse explains, m/s.
    Velocity,
    /// The momentum of bodies that touch no wall has changed by what no force explains, kg m/s.
    Momentum,
    /// Tangential speed was taken more than once at one point; the value is how often.
    Friction,
    /// Energy has risen, J.
    Energy,
    /// Energy has gone that no impact and no rest has taken, J.
    Loss,
    /// What is said to rest moves along its normal, m/s.
    RestSpeed,
    /// What is said to rest does not touch; the value is the gap, m.
    RestGap,
}

impl Fault {
    /// A sentence's beginning, and the unit of the value.
    fn words(self) -> (&'static str, &'static str) {
        match self {
            Fault::NotANumber => ("the state is no number", ""),
            Fault::Overlap => ("the bodies overlap by a degree of", ""),
            Fault::Passage => ("the centre has passed the wall by", " m"),
            Fault::Normal => ("the normal is wrong by", ""),
            Fault::Point => ("the contact point is wrong by", " m"),
            Fault::Pull => ("the impulse pulls with", " N s"),
            Fault::Impulse => ("the impulse differs from the impact law by", " N s"),
            Fault::Jump => ("the separation speed differs from the impact law by", " m/s"),
            Fault::Approach => ("the approach speed differs from the bodies' by", " m/s"),
            Fault::Velocity => ("no force and no impulse explains a change of velocity of", " m/s"),
            Fault::Momentum => ("no force explains a change of momentum of", " kg m/s"),
            Fault::Friction => ("tangential speed is taken at one point, times", ""),
            Fault::Energy => ("the energy rises by", " J"),
            Fault::Loss => ("no impact and no rest takes an energy of", " J"),
            Fault::RestSpeed => ("what rests moves along its normal with", " m/s"),
            Fault::RestGap => ("what rests is apart or too deep by", " m"),
        }
    }
}

/// Which bodies a finding is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Bodies {
    /// All bodies.
    All,
    /// A sphere.
    Sphere(usize),
    /// A sphere and a wall.
    Wall(usize, usize),
    /// Two spheres.
    Pair(usize, usize),
}

impl From<Key> for Bodies {
    fn from((kind, a, b): Key) -> Bodies {
        if kind == Kind::Wall { Bodies::Wall(a, b) } else { Bodies::Pair(a, b) }
    }
}

impl From<&Contact> for Bodies {
    fn from(row: &Contact) -> Bodies {
        row.key().into()
    }
}

impl fmt::Display for Bodies {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Bodies::All => write!(f, "all bodies"),
            Bodies::Sphere(a) => write!(f, "sphere {a}"),
            Bodies::Wall(a, b) => write!(f, "sphere {a} and wall {b}"),
            Bodies::Pair(a, b) => write!(f, "spheres {a} and {b}"),
        }
    }
}

/// One fault of some bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Finding {
    /// The kind of fault.
    pub fault: Fault,
    /// Time at which the fault was first seen, s.
    pub time: f64,
    /// The bodies that have the fault.
    pub bodies: Bodies,
    /// The worst value seen, in the unit of the fault.
    pub value: f64,
    /// What the value should not exceed, in the unit of the fault.
    pub bound: f64,
    /// How often the fault was seen.
    pub times: u64,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Finding { fault, time, bodies, value, bound, times } = *self;
        let (words, unit) = fault.words();
        write!(f, "from t = {time} s on, {bodies}: {words} {value:.3e}{unit}, allowed are {bound:.3e}")?;
        if times > 1 { write!(f, "; seen {times} times") } else { Ok(()) }
    }
}

/// Everything found, one row per fault and bodies.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Findings {
    rows: BTreeMap<(Fault, Bodies), Finding>,
    /// Faults seen beyond [`MOST`] different ones.
    more: u64,
}

/// Different findings that are kept.
const MOST: usize = 10_000;

impl Findings {
    /// Tells of a value and its bound.
    pub(super) fn add(&mut self, fault: Fault, time: f64, bodies: Bodies, [value, bound]: [f64; 2]) {
        if self.rows.len() >= MOST && !self.rows.contains_key(&(fault, bodies)) {
            self.more += 1;
            return;
        }
        let row = self.rows.entry((fault, bodies));
        let row = row.or_insert(Finding { fault, time, bodies, value, bound, times: 0 });
        row.times += 1;
        if value > row.value {
            (row.value, row.bound) = (value, bound);
        }
    }

    /// Adds a finding if the value exceeds its bound, or is no number.
    pub(super) fn hold(&mut self, fault: Fault, time: f64, bodies: Bodies, [value, bound]: [f64; 2]) {
        if value > bound || value.is_nan() {
            self.add(fault, time, bodies, [value, bound]);
        }
    }

    /// How many faults of different bodies there are.
    pub fn count(&self) -> u64 {
        self.rows.len() as u64 + self.more
    }

    /// Whether nothing is wrong.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The findings in the order in which they were first seen.
    pub fn rows(&self) -> Vec<Finding> {
        let mut rows: Vec<Finding> = self.rows.values().copied().collect();
        rows.sort_by(|one, other| one.time.total_cmp(&other.time));
        rows
    }
}
