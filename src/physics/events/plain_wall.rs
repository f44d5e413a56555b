//! Fast path of an impact on a wall: a free sphere that nothing accelerates strikes a face faster than what may rest, graze
//! or be sent to and fro, nothing being at rest or hopping in the scene, as nearly all impacts on the walls of a gas do. Same
//! bits as the general impact (`impact`).

use glam::DVec3;

use super::contact_state::ContactState;
use super::mechanics::Mechanics;
use super::record::{Plan, Trajectory};
use super::rounding::{HOP, SLOW, TOUCHED_GAP};
use super::squeezed::DOUBTFUL;
use super::trajectories::Trajectories;
use crate::physics::contact::{Class, Kind};
use crate::physics::impact_law::{along, normal_velocity, separation_speed};
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::overlap::touching;
use crate::physics::state::Stall;
use crate::physics::wall::{Touch, touch};

/// A sphere that touches the face of a wall now.
struct PlainWall {
    /// The trajectory of the sphere, at the present.
    line: Trajectory,
    /// When the motion of the sphere last changed, s.
    since: f64,
    /// How the two touch.
    contact: ContactState,
}

impl PlainWall {
    /// The wall that the sphere at a slot planned to meet, as [`Trajectories::contact_state`] sees it; none if the sphere
    /// is not over its face.
    #[inline(always)]
    fn new(trajectories: &Trajectories, model: &Model, slot: usize, plan: &Plan) -> Option<PlainWall> {
        let (now, record, wall) = (trajectories.now, &trajectories.records[slot], plan.other as usize);
        let line = record.trajectory.advanced_to(DVec3::ZERO, now);
        let path = line.path(DVec3::ZERO, now);
        if !model.faces[wall].shades(path.x) {
            return None;
        }
        let Touch { point, normal, gap, .. } = touch(&model.faces[wall], path.x, line.r);
        let v_n = normal_velocity(path.v, DVec3::ZERO, normal);
        let key = (Kind::Wall, record.sphere as usize, wall);
        let contact =
            ContactState { key, point, normal, gap, reach: line.r, velocity: path.v, v_n, a_n: 0.0, flat: true };
        Some(PlainWall { line, since: record.trajectory.t, contact })
    }
}

impl Mechanics {
    /// Lets the impact law act on the wall that the sphere at a slot planned to meet, if that is as plain as this; says
    /// whether it was, and the sphere has got a new velocity.
    #[inline(never)]
    pub(super) fn collide_plain_wall(
        &mut self,
        model: &Model,
        log: &mut Log,
        slot: usize,
        plan: &Plan,
    ) -> Result<bool, Stall> {
        let free = plan.kind == Kind::Wall && self.trajectories.common() == Some(DVec3::ZERO);
        if !free || !self.rests.is_empty() || !self.trajectories.hopping.is_empty() {
            return Ok(false);
        }
        let Some(PlainWall { line, since, contact }) = PlainWall::new(&self.trajectories, model, slot, plan) else {
            return Ok(false);
        };
        if !self.strikes(model, &contact, since) {
            return Ok(false);
        }
        let (now, law) = (self.trajectories.now, &model.law);
        let target = separation_speed(contact.v_n, Class::Collide, Kind::Wall, law);
        let change = target - contact.v_n;
        let slip = (line.v - contact.normal * contact.v_n) * (law.tangential - 1.0);
        let v = line.v + (along(contact.normal, change) + slip);
        self.trajectories.redirect(slot, Trajectory { v, ..line });
        if normal_velocity(v, DVec3::ZERO, contact.normal) < 0.0 {
            self.ensure_separating(model, contact.key, 0.0);
        }
        log.impact(contact.row(now, Class::Collide, change * model.masses[contact.key.1], target));
        self.impacts.last.note(contact.key, now);
        self.trajectories.to_and_fro = self.impacts.last.go_to_and_fro();
        self.trajectories.check_range_at(slot)?;
        Ok(true)
    }

    /// Whether a sphere that has moved as it does since `since` (s) strikes a face without any of what the general impact
    /// watches for.
    #[inline(always)]
    fn strikes(&self, model: &Model, contact: &ContactState, since: f64) -> bool {
        let (v_n, size, impacts) = (contact.v_n, contact.size(), &self.impacts);
        let slow = (SLOW + HOP * size / contact.reach) * contact.velocity.length();
        let near = touching(contact.reach, size).max(8.0 * TOUCHED_GAP * contact.reach);
        v_n < -model.law.rest_speed.max(slow)
            && v_n * v_n >= f64::MIN_POSITIVE
            && -v_n * (self.trajectories.now - since) > near
            && impacts.instant.events < DOUBTFUL
            && !impacts.last.will_be_many()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Parallelogram;
    use crate::physics::contact_time::sphere_wall;
    use crate::physics::events::plain_pair::tests::taken_alike;
    use crate::physics::path::Path;
    use crate::random::SplitMix64;
    use crate::scene::{ContactLaw, Draft, Sphere, Wall};

    /// A sphere that meets a wall of 4 m by 4 m, and when (s); of masses from 0.1 to 10 kg and radii from 0.1 to 1 m.
    fn meeting(draw: &mut SplitMix64) -> (Model, f64) {
        loop {
            let [s1, s2] = [DVec3::X * 4.0 + draw.unit_vector(), DVec3::Z * 4.0 + draw.unit_vector()];
            let wall = Wall { shape: Parallelogram { center: draw.unit_vector(), s1, s2 }, color: None };
            let sphere = Sphere {
                x: draw.unit_vector() * 4.0,
                v: draw.unit_vector() * 3.0,
                mass: 0.1 * 10_f64.powf(2.0 * draw.unit()),
                radius: 0.1 + 0.9 * draw.unit(),
                force: DVec3::ZERO,
                color: None,
                name: None,
            };
            let e = if draw.unit() < 0.5 { 1.0 } else { draw.unit() };
            let tangential = if draw.unit() < 0.5 { 1.0 } else { draw.unit() };
            let contact = ContactLaw { restitution: e, wall_restitution: e, tangential, rest_speed: 0.1 * draw.unit() };
            let draft = Draft { gravity: DVec3::ZERO, contact, ..Draft::new(vec![wall], vec![sphere]) };
            let Ok(scene) = draft.validated() else { continue };
            let model = Model::new(&scene);
            let path = Path { x: model.initial.x[0], v: model.initial.v[0], a: DVec3::ZERO };
            if let Some(t) = sphere_wall(&path, model.radii[0], &model.faces[0], 10.0) {
                return (model, t);
            }
        }
    }

    #[test]
    fn a_plain_impact_on_a_wall_gets_the_bits_that_the_general_one_gives() {
        let taken = taken_alike(meeting, (Kind::Wall, 0, 0), Mechanics::collide_plain_wall);
        // all but those at edges and corners, and that approach no faster than what may rest
        assert!(taken > 400, "{taken} of 1000");
    }
}
