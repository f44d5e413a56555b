//! Spheres that just fit between walls: parallel ones, or three and more around them, as close as rounding can tell.
//!
//! Off such a wall leads no way that does not lead into another: the impact law would send the sphere to and fro for
//! ever, at one place and one time, whatever the restitution. What there is of its velocity across those walls has no
//! flight to bounce in: the contacts rest, pressed or not, and the sphere slides between them.

use super::detector::Detector;
use super::engine::EventDriven;
use super::impact::ContactState;
use super::trajectories::Record;
use crate::physics::contact::{Key, Kind};
use crate::physics::model::Model;
use crate::physics::overlap::touching;
use crate::physics::support::{Row, solve};
use crate::physics::wall::touch;

/// A wall can be left if that does not take turning by nearly a right angle: u·n above 64 ulp is a wedge of 1e-7 rad, in
/// which a sphere bounces thirty million times and is out.
const LEAVES: f64 = 64.0 * f64::EPSILON;

/// From so many events on without the clock advancing it is asked whether a sphere is squeezed, at powers of two.
const DOUBTFUL: u64 = 4;

impl<D: Detector> EventDriven<D> {
    /// Whether what is met can't ever be left: then all contacts that hold the sphere so rest from now on.
    pub(super) fn is_squeezed(&mut self, model: &Model, meeting: &ContactState) -> bool {
        let events = self.instant.events;
        if meeting.key.0 == Kind::Pair || events < DOUBTFUL || !events.is_power_of_two() {
            return false;
        }
        let record = &self.flight.records[self.flight.seat(meeting.key.1)];
        let keys: Vec<Key> =
            (self.walls_touched(model, record).into_iter()).map(|wall| (Kind::Wall, meeting.key.1, wall)).collect();
        let squeezing = self.squeezing(model, &keys);
        if !squeezing.contains(&meeting.key) {
            return false;
        }
        for key in squeezing {
            if self.rests.holds(key) {
                continue;
            }
            let meeting = self.meeting(model, key);
            self.rests.add(model, &self.flight, self.now, &meeting, self.now);
        }
        true
    }

    /// The walls that a sphere touches now, to rounding.
    pub(super) fn walls_touched(&self, model: &Model, record: &Record) -> Vec<usize> {
        let Record { line, spot, .. } = record;
        let x = self.flight.path(record.sphere as usize, self.now).x;
        let slack = touching(line.r, x.abs().max_element());
        let touches = |wall: &usize| touch(&model.faces[*wall], x, line.r).gap <= slack;
        match &self.cells {
            Some(cells) if !spot.is_loose() => {
                cells.walls_near(*spot).iter().map(|&wall| wall as usize).filter(touches).collect()
            }
            _ => (0..model.faces.len()).filter(touches).collect(),
        }
    }

    /// Of the contacts of one sphere with walls those that can't open: the nearest way to straight off the wall that none
    /// of the others forbids does not leave it.
    pub(super) fn squeezing(&self, model: &Model, keys: &[Key]) -> Vec<Key> {
        if keys.len() < 2 {
            return Vec::new();
        }
        let normal = |key: &Key| {
            let path = self.flight.path(key.1, self.now);
            touch(&model.faces[key.2], path.x, self.flight.line(key.1).r).normal
        };
        let rows: Vec<Row> = keys.iter().map(|key| Row { a: 0, b: None, normal: normal(key), offset: 0.0 }).collect();
        let stays = |row: &Row| {
            let way = solve(&[1.0], &[row.normal], &rows, &[]).vectors[0];
            way.dot(row.normal) <= LEAVES
        };
        keys.iter().zip(&rows).filter(|(_, row)| stays(row)).map(|(&key, _)| key).collect()
    }
}
