//! What ends a run that cannot go on: a state that is no longer finite, and time that stands still.

use super::run::Paper;
use super::watchdog::Watchdog;
use crate::physics::contact::{Class, Contact, Kind};
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::state::{Stall, StallKind, State, runaway};

/// Frames cut short, beside one per sphere, after which the watchdog compares.
const PATIENCE: u64 = 1000;

/// Contacts named in the sentence of a stall.
const NAMED: usize = 6;

impl Paper {
    /// Whether and why the run cannot go on.
    pub(super) fn guard(&mut self, model: &Model, log: &Log) -> Option<Stall> {
        if self.residue != 0.0 {
            return self.quarantine(model);
        }
        if self.watch.stuck {
            self.watch = Watchdog::at(self.end.t);
            return Some(Stall::step_too_small(self.end.t, self.settings.dt));
        }
        if self.trial.is_none() && self.watch.cut >= PATIENCE + model.len() as u64 {
            let stalled = self.end.t - self.watch.since < self.watch.owed;
            self.watch = Watchdog::at(self.end.t);
            return stalled.then(|| self.shrinking(log));
        }
        None
    }

    /// Gives up the frame in which a sphere leaves the range of numbers, before it is shown; the stall that this is.
    fn quarantine(&mut self, model: &Model) -> Option<Stall> {
        self.residue = 0.0;
        let State { x, v, .. } = &self.end;
        let cause = format!(
            "a frame of {} s from then on sends it there; begin with smaller speeds or take a smaller dt",
            self.settings.dt
        );
        let stall = (0..x.len()).find_map(|i| runaway(i, self.start.t, [x[i], v[i]], &cause))?;
        self.give_up(model);
        Some(stall)
    }

    /// The stall of frames that shrink without end: support that cannot hold, or bounces too low for the accepted overlap.
    fn shrinking(&self, log: &Log) -> Stall {
        let bounces = log.contacts.iter().any(|contact| contact.class == Class::Collide);
        let (kind, cause) = match bounces {
            true => {
                (StallKind::SlowBounce, "slow impacts come back before they have left the overlap that is accepted")
            }
            false => (StallKind::RestingContact, "support given contact by contact cannot hold a wedge or a stack"),
        };
        let mut bodies: Vec<String> = log.contacts.iter().take(NAMED).map(names).collect();
        if log.contacts.len() > NAMED {
            bodies.push(format!("{} more", log.contacts.len() - NAMED));
        }
        let (time, bodies) = (self.end.t, bodies.join(", "));
        let reason = format!(
            "From t = {time} s on the frames of method paper shrink without end, because {cause} (in contact: {bodies}); \
             change the method from here."
        );
        Stall { time, kind, reason }
    }
}

/// The bodies of a contact in words: "sphere 0 and wall 6".
fn names(contact: &Contact) -> String {
    match contact.kind {
        Kind::Wall => format!("sphere {} and wall {}", contact.a, contact.b),
        Kind::Pair => format!("spheres {} and {}", contact.a, contact.b),
    }
}
