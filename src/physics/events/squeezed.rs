//! Spheres that just fit between walls: parallel ones, or three and more around them, as close as rounding can tell.
//!
//! Off such a wall leads no way that does not lead into another: the impact law would send the sphere to and fro for
//! ever, at one place and one time, whatever the restitution. What there is of its velocity across those walls has no
//! flight to bounce in: the contacts rest, pressed or not, and the sphere slides between them.

use super::contact_state::ContactState;
use super::islands::covered::leave_out_covered;
use super::mechanics::Mechanics;
use super::record::Record;
use super::rest_reason::RestReason;
use super::rounding::WEDGE;
use super::trajectories::Trajectories;
use crate::physics::contact::{Key, Kind};
use crate::physics::model::Model;
use crate::physics::overlap::touching;
use crate::physics::support::{Row, solve};
use crate::physics::wall::{Face, touch};

/// Events without the clock advancing from which on it is asked whether a sphere is squeezed, at powers of two.
pub(super) const DOUBTFUL: u64 = 4;

impl Mechanics {
    /// Whether a contact can never be left: then all contacts that hold the sphere so rest from now on. The bodies have
    /// moved as they do now since `since`, s.
    #[inline]
    pub(super) fn is_squeezed(&mut self, model: &Model, contact: &ContactState, since: f64) -> bool {
        let events = self.impacts.instant.events;
        let again = events >= DOUBTFUL && events.is_power_of_two();
        // across a gap that coordinates hardly tell from none the clock may go on all the same
        let to_and_fro = || -contact.v_n * (self.trajectories.now - since) <= touching(contact.reach, contact.size());
        if contact.key.0 == Kind::Pair || !again && !to_and_fro() {
            return false;
        }
        self.squeezes(model, contact)
    }

    #[cold]
    #[inline(never)]
    fn squeezes(&mut self, model: &Model, contact: &ContactState) -> bool {
        let i = contact.key.1;
        let record = &self.trajectories.records[self.trajectories.slot(i)];
        let keys = walls_touched(model, &self.trajectories, record, 0..model.faces.len());
        let squeezing = squeezing(model, &self.trajectories, &keys);
        if !squeezing.contains(&contact.key) {
            return false;
        }
        for key in squeezing {
            if self.rests.holds(key) {
                continue;
            }
            let contact = self.advanced_contact(model, key);
            self.rests.add(model, &self.trajectories, &contact, RestReason::Squeezed, self.trajectories.now);
        }
        true
    }
}

/// The contacts of a sphere with those of some walls that it touches now, to rounding; edges that a face covers are none.
pub(super) fn walls_touched(
    model: &Model,
    trajectories: &Trajectories,
    record: &Record,
    walls: impl Iterator<Item = usize>,
) -> Vec<Key> {
    let (r, i) = (record.trajectory.r, record.sphere as usize);
    let x = trajectories.path(i, trajectories.now).x;
    let slack = touching(r, x.abs().max_element());
    let touches = |face: &Face| !face.is_farther(x, r + slack) && touch(face, x, r).gap <= slack;
    let touched = walls.filter(|&wall| touches(&model.faces[wall]));
    let mut touched = touched.map(|wall| (Kind::Wall, i, wall)).collect();
    leave_out_covered(model, (x, r), &mut touched);
    touched
}

/// The contacts among those of one sphere with walls that cannot open: the nearest way to straight off the wall that none
/// of the others forbids does not leave it.
pub(super) fn squeezing(model: &Model, trajectories: &Trajectories, keys: &[Key]) -> Vec<Key> {
    if keys.len() < 2 {
        return Vec::new();
    }
    let normal = |key: &Key| {
        let path = trajectories.path(key.1, trajectories.now);
        touch(&model.faces[key.2], path.x, trajectories.trajectory(key.1).r).normal
    };
    let rows: Vec<Row> = keys.iter().map(|key| Row { a: 0, b: None, normal: normal(key), offset: 0.0 }).collect();
    let stays = |row: &Row| {
        // straight off the wall is forbidden by none of the others
        if rows.iter().all(|other| other.normal.dot(row.normal) >= 0.0) {
            return false;
        }
        let way = solve(&[1.0], &[row.normal], &rows, &[]).vectors[0];
        way.dot(row.normal) <= WEDGE
    };
    keys.iter().zip(&rows).filter(|(_, row)| stays(row)).map(|(&key, _)| key).collect()
}
