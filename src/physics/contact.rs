//! Contacts as the solver met them: plain rows for events, the inspector and the tallies.

use glam::DVec3;

/// What a contact is between.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// A sphere and a wall.
    Wall,
    /// Two spheres.
    Pair,
}

/// What the impact law made of a contact (paper 2.4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Class {
    /// v_n > 0: nothing to do.
    Leave,
    /// A rest begins (in events), or goes on (in the contacts of a frame).
    Rest,
    /// An impact.
    Collide,
    /// A rest ends (events only).
    Release,
}

/// A contact's two bodies; ordered walls before pairs, then by `a`, then by `b`.
pub type Key = (Kind, usize, usize);

/// One contact at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Time of the contact, s.
    pub time: f64,
    /// Whether a sphere touches a wall or another sphere.
    pub kind: Kind,
    /// The sphere; of a pair the lower index.
    pub a: usize,
    /// The wall, or the pair's higher index.
    pub b: usize,
    /// Contact point, m.
    pub point: DVec3,
    /// Unit normal, from the contact point to the centre of `a` (pair: from `b` to `a`).
    pub normal: DVec3,
    /// Velocity of `a` relative to the wall or to `b` before the response, m/s.
    pub velocity: DVec3,
    /// Approach speed −v_n before the response, m/s.
    pub approach_speed: f64,
    /// Separation speed v_n after the response, m/s.
    pub separation_speed: f64,
    /// Normal impulse on `a` along `normal`, N s; at rest the support force's impulse of the frame.
    pub impulse: f64,
    /// Intersection degree −gap / r (pair: / (r₁ + r₂)), dimensionless.
    pub degree: f64,
    /// What the impact law made of the contact.
    pub class: Class,
    /// How many impacts the row stands for: 1, or those of a long chain at one place, or of equal hops on a face up to its
    /// time, which are followed together. The speeds and the impulse are then the sums of theirs.
    pub impacts: u64,
}

impl Contact {
    /// The two bodies of the contact.
    pub fn key(&self) -> Key {
        (self.kind, self.a, self.b)
    }

    /// Number of impacts that the row tells: 0 if it tells of something else.
    pub fn impact_count(&self) -> u64 {
        if self.class == Class::Collide { self.impacts } else { 0 }
    }
}

/// One probe of the search for the collision time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Probe {
    /// Length of the trial step from the frame's start, s.
    pub step: f64,
    /// Largest intersection degree at the end of the step, dimensionless (negative: apart).
    pub degree: f64,
}
