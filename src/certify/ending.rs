//! Why a certificate ends before the run does.

use std::fmt;

use crate::physics::Kind;

/// Where a certificate ends, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Ending {
    /// Time at which the certificate ends, s.
    pub time: f64,
    /// Sphere, and wall or second sphere, of the contact at which it ends; none if there is no such contact.
    pub bodies: Option<(Kind, usize, usize)>,
    /// Why it ends there.
    pub cause: Cause,
}

/// Why a certificate ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cause {
    /// `exact` tells a contact there, and the shadow finds none by itself.
    NoContact,
    /// The shadow's approach speed makes another class of the contact: it is at the border of two, or rests for a reason
    /// that is no law of the paper.
    OtherClass,
    /// `exact` lets a contact go that the shadow finds pressed.
    Pressed,
    /// Contacts of one sphere at one time: their order is no fact.
    Simultaneous,
    /// The shadow finds another contact, or another class, amid impacts of one instant: what comes of them depends on their order,
    /// which is no fact.
    AmidImpacts,
    /// The contacts of one sphere come in another order.
    OtherOrder,
    /// Rest on a sphere, an edge or a corner of which rounding decides what holds.
    CurvedRest,
    /// A sphere that slides on a wall comes to its edge, and rounding decides whether over it.
    RollsOver,
    /// Too many contacts hold spheres that lean on each other, or no forces are found that fit.
    Support,
    /// Nothing shows that these bodies do not touch.
    Touching,
    /// `exact` and the shadow are apart by more than a radius.
    Parted,
    /// `exact` went no further.
    Stalled,
    /// The work that a certificate may take is spent.
    Spent,
}

impl Cause {
    /// The cause as the end of "certified until … because …".
    pub fn words(self) -> &'static str {
        match self {
            Cause::NoContact => "the shadow run finds no such contact there",
            Cause::OtherClass => "at the shadow run's approach speed the contact is of another class",
            Cause::Pressed => "it lets go there, and the shadow run finds it pressed",
            Cause::Simultaneous => "it comes at the same time as another contact of the same sphere",
            Cause::AmidImpacts => "it comes amid impacts of one instant, whose order the law leaves open",
            Cause::OtherOrder => "in the shadow run contacts come in another order",
            Cause::CurvedRest => "what holds the sphere there, and for how long, is within rounding",
            Cause::RollsOver => "the sphere comes to an edge, and whether over it is within rounding",
            Cause::Support => "too many contacts hold the spheres that lean on each other",
            Cause::Touching => "they come so close that nothing shows whether they touch",
            Cause::Parted => "the run and its shadow are apart by more than a radius",
            Cause::Stalled => "the run went no further",
            Cause::Spent => "the certificate's work is spent",
        }
    }
}

impl fmt::Display for Ending {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "certified until {:?} s, no longer because ", self.time)?;
        match self.bodies {
            Some((Kind::Wall, sphere, wall)) => write!(f, "of sphere {sphere} and wall {wall}: ")?,
            Some((Kind::Pair, a, b)) => write!(f, "of spheres {a} and {b}: ")?,
            None => {}
        }
        f.write_str(self.cause.words())
    }
}
