//! Walls that share the point of a resting contact, and edges and corners that another wall covers there: the border of the
//! tile beside the one that carries a sphere.
//!
//! Near a seam the closest point of the next tile belongs to both. A sphere that does not overlap the face of the one does
//! not overlap any of its points, so that the edge of the other says nothing more; its distance differs by half a square of
//! the way to the seam, less than rounding within 1e-8 r, but its normal by all of it: a sphere at rest would roll off, one
//! that lands there would be turned aside. So the face alone is struck and carries.

use glam::DVec3;

use crate::physics::contact::{Key, Kind};
use crate::physics::events::changed::Changed;
use crate::physics::events::mechanics::Mechanics;
use crate::physics::events::rest_reason::RestReason;
use crate::physics::events::rounding::{COVERED_GAP, SHARED_GAP, SHARED_POINT, SUM};
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::state::Stall;
use crate::physics::support::Short;
use crate::physics::wall::{Face, Part, Touch, touch, touch_part};
use crate::physics::wall_parts::part_end;

/// Whether the point of an edge or a corner that a sphere touches is one of a face, to rounding.
fn contains(face: &Face, at: &Touch) -> bool {
    !face.is_farther(at.point, 0.0)
}

/// Whether the point of an edge or a corner that a sphere touches is one of a face above which the sphere is.
fn covers(face: &Face, at: &Touch, x: DVec3) -> bool {
    face.shades(x) && contains(face, at)
}

/// Leaves out the contacts of a sphere at `x` (m), of radius `r` (m), with edges and corners that another of these walls
/// covers.
pub(crate) fn leave_out_covered(model: &Model, (x, r): (DVec3, f64), walls: &mut Vec<Key>) {
    if walls.len() < 2 {
        return;
    }
    let faces: Short<usize> = walls.iter().map(|key| key.2).filter(|&wall| model.faces[wall].shades(x)).collect();
    let is_covered = |key: &Key| {
        let at = touch(&model.faces[key.2], x, r);
        at.part != Part::Face && faces.iter().any(|&other| covers(&model.faces[other], &at, x))
    };
    walls.retain(|key| !is_covered(key));
}

impl Mechanics {
    /// Handles a contact with an edge or a corner that a face covers: the face is struck in its place, or carries the sphere.
    /// Returns the spheres whose motion that has changed; none if nothing covers it.
    #[inline]
    pub(crate) fn meet_covered(&mut self, model: &Model, log: &mut Log, key: Key) -> Option<Result<Changed, Stall>> {
        let (kind, i, wall) = key;
        if kind == Kind::Pair || model.faces[wall].shades(self.trajectories.path(i, self.trajectories.now).x) {
            return None;
        }
        self.meet_border(model, log, key)
    }

    /// Handles a contact with a wall beside its face, if another face covers it. Out of the way of contacts with the face.
    #[cold]
    #[inline(never)]
    fn meet_border(&mut self, model: &Model, log: &mut Log, key: Key) -> Option<Result<Changed, Stall>> {
        let (_, i, wall) = key;
        let x = self.trajectories.path(i, self.trajectories.now).x;
        let at = touch(&model.faces[wall], x, model.radii[i]);
        let other = (0..model.faces.len()).find(|&other| other != wall && covers(&model.faces[other], &at, x))?;
        let face = (Kind::Wall, i, other);
        if self.rests.holds(face) {
            if self.rests.kept(face).part != Part::Face {
                return None; // the sphere is about to leave it, and would leave this one to nothing
            }
            // held without carrying: else it would be met again and again
            let contact = self.advanced_contact(model, key);
            self.rests.add(model, &self.trajectories, &contact, RestReason::Covered, self.trajectories.now);
            return Some(Ok(Changed::Nothing));
        }
        let approaches = self.trajectories.contact_state(model, face).v_n < 0.0;
        approaches.then(|| self.meet(model, log, face))
    }

    /// The resting contacts of these spheres with edges and corners that the face of another resting contact covers: they stay,
    /// lest their prediction find them, and carry nothing.
    pub(super) fn covered(&mut self, model: &Model, log: &mut Log, spheres: &[usize]) -> Vec<Key> {
        let mut covered = Vec::new();
        for &i in spheres {
            let walls = self.rests.of[i].iter().copied().filter(|key| key.0 == Kind::Wall);
            let (faces, outlines): (Short<Key>, Short<Key>) =
                walls.partition(|&key| self.rests.kept(key).part == Part::Face);
            for &key in &faces {
                // what the closest point has moved on to carries by itself
                if self.is_covered(key) {
                    self.rests.kept_mut(key).reason = RestReason::SharedPoint;
                }
            }
            let (x, r) = (self.trajectories.path(i, self.trajectories.now).x, model.radii[i]);
            for key in outlines {
                let at = touch_part(&model.faces[key.2], self.rests.kept(key).part, x, r);
                let is_covered = faces.iter().any(|face| contains(&model.faces[face.2], &at));
                if self.cover(model, log, (key, at.gap), is_covered) {
                    covered.push(key);
                }
            }
        }
        covered.sort_unstable();
        covered
    }

    /// Has a contact with this gap (m) carry nothing from now on if a face covers it: what it was is over, and told so. If
    /// none covers it any longer it may carry again, or is dropped where it does not touch. Whether it stays covered.
    fn cover(&mut self, model: &Model, log: &mut Log, (key, gap): (Key, f64), is_covered: bool) -> bool {
        let held = *self.rests.kept(key);
        let (now, was_covered) = (self.trajectories.now, self.is_covered(key));
        if held.rub.is_some() || held.settles_at > now || !is_covered && !was_covered {
            return false;
        }
        let contact = self.trajectories.contact_state(model, key);
        let size = contact.size();
        let near = if is_covered { COVERED_GAP * size.max(model.faces[key.2].size()) } else { SHARED_GAP * size };
        if is_covered && was_covered && gap <= near {
            return true;
        }
        self.release(model, log, key);
        if gap <= near {
            let reason = if is_covered { RestReason::Covered } else { RestReason::SharedPoint };
            self.rests.add(model, &self.trajectories, &contact, reason, now);
        }
        is_covered && gap <= near
    }
}

impl Mechanics {
    /// Adds the walls that share a resting contact's point with its wall: the tile beyond a seam, the slope beyond a
    /// ridge. Their gap and its rate of change are 0 then, so that no approach announces them; unless they belong to the
    /// island when the closest point moves on to them, the sphere would sink in.
    pub(super) fn add_walls_at_point(&mut self, model: &Model, i: usize) {
        if !self.rests.of[i].iter().any(|key| key.0 == Kind::Wall) {
            return;
        }
        let path = self.trajectories.path(i, self.trajectories.now);
        let r = model.radii[i];
        let shared = |wall: usize, part: Part| touch_part(&model.faces[wall], part, path.x, r);
        let touches = |key: &&Key| key.0 == Kind::Wall && !self.is_covered(**key);
        let held: Vec<(usize, Touch)> = (self.rests.of[i].iter().filter(touches))
            .map(|&key| (key.2, shared(key.2, self.rests.kept(key).part)))
            .collect();
        let size = path.x.abs().max_element().max(r);
        let open = held.iter().map(|(_, at)| at.gap).fold(0.0, f64::max);
        let most = open + SHARED_GAP * size;
        for wall in 0..model.faces.len() {
            if self.rests.holds((Kind::Wall, i, wall)) {
                continue;
            }
            // the plane is never farther than the wall
            if model.faces[wall].height(path.x).abs() - r > most {
                continue;
            }
            let at = touch(&model.faces[wall], path.x, r);
            let near = |(_, held): &(usize, Touch)| {
                held.point.distance_squared(at.point) <= (SHARED_POINT * r) * (SHARED_POINT * r)
            };
            if at.gap > most || !held.iter().any(near) {
                continue;
            }
            let meeting = self.trajectories.contact_state(model, (Kind::Wall, i, wall));
            let pull = model.acceleration(i).length();
            if meeting.v_n.abs() <= SUM * path.v.length() || meeting.hops_within_rounding(pull) {
                self.rests.add(model, &self.trajectories, &meeting, RestReason::SharedPoint, self.trajectories.now);
            }
        }
    }

    /// Lets go of those of these contacts whose face has let go: the sphere may come to them by another way.
    pub(super) fn uncover(&mut self, model: &Model, log: &mut Log, covered: &[Key]) {
        for &key in covered {
            if !self.rests.holds(key) || !self.is_covered(key) {
                continue; // it has been solved with the others
            }
            let (x, part) = (self.trajectories.path(key.1, self.trajectories.now).x, self.rests.kept(key).part);
            let at = touch_part(&model.faces[key.2], part, x, model.radii[key.1]);
            let carries = |other: &Key| {
                let is_face = other.0 == Kind::Wall && self.rests.kept(*other).part == Part::Face;
                // it may be over its own face by now
                is_face && !self.is_covered(*other) && contains(&model.faces[other.2], &at)
            };
            if !self.rests.of[key.1].iter().any(carries) {
                self.release(model, log, key);
            }
        }
    }

    /// Whether a contact rests only because a face covers it.
    fn is_covered(&self, key: Key) -> bool {
        self.rests.kept(key).reason == RestReason::Covered
    }

    /// The resting contacts of these spheres that are covered.
    fn covered_of<'a>(&'a self, spheres: &'a [usize]) -> impl Iterator<Item = Key> + 'a {
        spheres.iter().flat_map(|&i| self.rests.of[i].iter().copied()).filter(|&key| self.is_covered(key))
    }

    /// The contacts of an island that moves on a curve, and those of its spheres that are covered, which nothing would look
    /// at on the way: they are solved with the others again. None if there are no such.
    pub(super) fn carry_covered(&mut self, keys: &[Key], spheres: &[usize]) -> Option<Short<Key>> {
        let covered: Short<Key> = self.covered_of(spheres).collect();
        if covered.is_empty() {
            return None;
        }
        for &key in &covered {
            self.rests.kept_mut(key).reason = RestReason::SharedPoint;
        }
        let mut all: Short<Key> = keys.iter().copied().chain(covered).collect();
        all.sort_unstable();
        Some(all)
    }

    /// Time at which the closest point of a covered wall first comes to another part of it, s: it may carry from there on.
    pub(super) fn covered_end(&self, model: &Model, spheres: &[usize]) -> f64 {
        let now = self.trajectories.now;
        let end = |(_, i, wall): Key| {
            let (path, part) = (self.trajectories.path(i, now), self.rests.kept((Kind::Wall, i, wall)).part);
            part_end(&model.faces[wall], part, &path, model.radii[i], f64::INFINITY)
        };
        self.covered_of(spheres).filter_map(end).fold(f64::INFINITY, f64::min) + now
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Parallelogram;

    /// A wall of 2 m by 4 m along z, its middle at (x, y), m, that rises by so much along its 2 m of x.
    fn wall(x: f64, y: f64, rise: f64) -> Face {
        let (s1, s2) = (DVec3::new(2.0, rise, 0.0), DVec3::Z * 4.0);
        Face::new(Parallelogram { center: DVec3::new(x, y, 0.0), s1, s2 })
    }

    /// Whether the floor from x = −2 to 0 covers the point of another wall that a sphere of 1 m touches, or nearly, that lies
    /// on it at `x`, m.
    fn floor_covers(other: &Face, x: f64) -> bool {
        let center = DVec3::new(x, 1.0, 0.0);
        let at = touch(other, center, 1.0);
        assert_ne!(at.part, Part::Face);
        covers(&wall(-1.0, 0.0, 0.0), &at, center)
    }

    #[test]
    fn a_floor_covers_the_border_of_what_goes_on_level_or_down_from_its_own() {
        for other in [wall(1.0, 0.0, 0.0), wall(1.0, -0.5, -1.0), wall(1.0, -1e-9, -2e-9)] {
            assert!(floor_covers(&other, -1e-8));
            // beyond its border it says nothing
            assert!(!covers(&wall(-1.0, 0.0, 0.0), &touch(&other, DVec3::ZERO, 1.0), DVec3::new(1e-8, 1.0, 0.0)));
        }
        // a corner in the middle of its border
        let half =
            Face::new(Parallelogram { center: DVec3::new(1.0, 0.0, 1.0), s1: DVec3::X * 2.0, s2: DVec3::Z * 2.0 });
        assert!(floor_covers(&half, -1e-8));
    }

    #[test]
    fn a_floor_does_not_cover_what_stands_above_it_or_beyond_a_crack() {
        for other in [wall(1.0, 1e-12, 0.0), wall(1.0 + 1e-9, 0.0, 0.0), wall(1.0 + 1e-12, -1e-12, 0.0)] {
            assert!(!floor_covers(&other, -1e-8));
        }
    }
}
