//! Fast path of an impact: two free spheres of equal acceleration that approach faster than what may rest, nothing being at
//! rest or hopping in the scene, as nearly all pairs of a gas do. Same bits as the general impact (`impact`), with each
//! record read once.

use super::contact_state::ContactState;
use super::mechanics::Mechanics;
use super::record::{Plan, Trajectory};
use super::rounding::LONG_CHAIN;
use super::trajectories::Trajectories;
use crate::physics::contact::{Class, Kind};
use crate::physics::impact_law::{pair_normal_velocity, pair_push, separation_speed};
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::state::Stall;

/// Two spheres that touch now, the one of the lower index first.
struct PlainPair {
    /// The slots of their records.
    slots: [usize; 2],
    /// Their trajectories, at the present.
    lines: [Trajectory; 2],
    /// When the motion of either last changed, s.
    since: f64,
    /// How the two touch.
    contact: ContactState,
}

impl PlainPair {
    /// The pair that the sphere at a slot planned to meet, as [`Trajectories::contact_state`] sees it; none if what
    /// accelerates them differs.
    #[inline(always)]
    fn new(trajectories: &Trajectories, slot: usize, plan: &Plan) -> Option<PlainPair> {
        let now = trajectories.now;
        let (a, other) = (trajectories.common()?, plan.other as usize);
        let swap = usize::from(trajectories.sphere(slot) > trajectories.sphere(other));
        let slots = [[slot, other][swap], [other, slot][swap]];
        let [one, two] = [&trajectories.records[slots[0]], &trajectories.records[slots[1]]];
        let since = one.trajectory.t.max(two.trajectory.t);
        let lines = [one.trajectory.advanced_to(a, now), two.trajectory.advanced_to(a, now)];
        let key = (Kind::Pair, one.sphere as usize, two.sphere as usize);
        let [one, two] = [lines[0].path(a, now), lines[1].path(a, now)];
        let (x, reach) = (one.x - two.x, lines[0].r + lines[1].r);
        let distance = x.length();
        let (normal, gap) = (x / distance, distance - reach);
        let contact = ContactState {
            key,
            point: two.x + normal * (lines[1].r + 0.5 * gap),
            normal,
            gap,
            reach,
            velocity: one.v - two.v,
            v_n: pair_normal_velocity(x, one.v - two.v),
            // nothing presses them together: that is all that would be asked
            a_n: 0.0,
            flat: false,
        };
        Some(PlainPair { slots, lines, since, contact })
    }
}

impl Mechanics {
    /// Lets the impact law act on the pair that the sphere at a slot planned to meet, if it is as plain as that; says
    /// whether it was, and both spheres have got new velocities.
    #[inline(always)]
    pub(super) fn collide_plain_pair(
        &mut self,
        model: &Model,
        log: &mut Log,
        slot: usize,
        plan: &Plan,
    ) -> Result<bool, Stall> {
        if plan.kind != Kind::Pair || !self.rests.is_empty() || !self.trajectories.hopping.is_empty() {
            return Ok(false);
        }
        let now = self.trajectories.now;
        let Some(pair) = PlainPair::new(&self.trajectories, slot, plan) else { return Ok(false) };
        if !self.is_plain(model, &pair) {
            return Ok(false);
        }
        let target = separation_speed(pair.contact.v_n, Class::Collide, Kind::Pair, &model.law);
        let share = self.exchange(model, &pair);
        let impulse = (target - pair.contact.v_n) / share;
        log.impact(pair.contact.row(now, Class::Collide, impulse, target));
        self.impacts.last.note(pair.contact.key, now);
        self.trajectories.to_and_fro = self.impacts.last.go_to_and_fro();
        for slot in pair.slots {
            self.trajectories.check_range_at(slot)?;
        }
        Ok(true)
    }

    /// Whether a pair that nothing presses together collides without any of what the general impact watches for.
    #[inline(always)]
    fn is_plain(&self, model: &Model, pair: &PlainPair) -> bool {
        let (v_n, impacts) = (pair.contact.v_n, &self.impacts);
        let watched = model.law.restitution < 1.0 && v_n * v_n == 0.0;
        v_n < -model.law.rest_speed
            && !watched
            && impacts.instant.events <= LONG_CHAIN
            && !impacts.last.are_many()
            && !impacts.chatter.may_be_endless(&self.trajectories, &pair.contact, pair.since)
    }

    /// Gives both spheres their impulse; returns 1/m₁ + 1/m₂, 1/kg.
    #[inline(always)]
    fn exchange(&mut self, model: &Model, pair: &PlainPair) -> f64 {
        let (slots, [one, two]) = (pair.slots, pair.lines);
        let [share_a, share_b] = slots.map(|slot| self.trajectories.records[slot].inverse_mass);
        let (arm, w, share) = (one.x - two.x, one.v - two.v, share_a + share_b);
        let push = pair_push(arm, w, share, model.law.restitution);
        let (one, two) =
            (Trajectory { v: one.v + push * share_a, ..one }, Trajectory { v: two.v + push * -share_b, ..two });
        self.trajectories.redirect(slots[0], one);
        self.trajectories.redirect(slots[1], two);
        if pair_normal_velocity(arm, one.v - two.v) < 0.0 {
            self.ensure_separating(model, pair.contact.key, 0.0);
        }
        share
    }
}

#[cfg(test)]
pub(super) mod tests {
    use glam::DVec3;

    use super::*;
    use crate::physics::contact::Key;
    use crate::physics::contact_time::sphere_sphere;
    use crate::physics::path::Path;
    use crate::random::SplitMix64;
    use crate::scene::{ContactLaw, Draft, Sphere};

    /// Two spheres that meet, and when (s): of masses from 0.1 to 10 kg and radii from 0.1 to 1 m, under gravity.
    fn meeting(draw: &mut SplitMix64) -> (Model, f64) {
        let decade = |low: f64, draw: &mut SplitMix64| low * 10_f64.powf(2.0 * draw.unit());
        loop {
            let spheres = [-1.0, 1.0].map(|side| Sphere {
                x: DVec3::X * (1.5 * side) + draw.unit_vector() * 0.3,
                v: DVec3::X * (-3.0 * side) + draw.unit_vector() * 2.0,
                mass: decade(0.1, draw),
                radius: 0.1 + 0.9 * draw.unit(),
                force: DVec3::ZERO,
                color: None,
                name: None,
            });
            let (e, gravity) = (draw.unit(), DVec3::NEG_Y * 9.8);
            let contact =
                ContactLaw { restitution: e, wall_restitution: e, tangential: 1.0, rest_speed: 0.1 * draw.unit() };
            let draft = Draft { gravity, contact, ..Draft::new(Vec::new(), spheres.to_vec()) };
            let Ok(scene) = draft.validated() else { continue };
            let model = Model::new(&scene);
            let path = |i: usize| Path { x: model.initial.x[i], v: model.initial.v[i], a: model.acceleration(i) };
            let relative = path(0).relative_to(&path(1));
            if let Some(t) = sphere_sphere(&relative, model.radii[0] + model.radii[1], 10.0) {
                return (model, t);
            }
        }
    }

    /// What lets the impact law act in a short way; whether it has.
    type ShortWay = fn(&mut Mechanics, &Model, &mut Log, usize, &Plan) -> Result<bool, Stall>;

    /// How many of a thousand meetings, each at its time (s), a short way takes: all with the bits of the general impact.
    pub(in crate::physics::events) fn taken_alike(
        meeting: fn(&mut SplitMix64) -> (Model, f64),
        key: Key,
        collide: ShortWay,
    ) -> u32 {
        let mut draw = SplitMix64::new(1);
        let mut taken = 0;
        for case in 0..1000 {
            let (model, t) = meeting(&mut draw);
            let mut quick = Mechanics::new(&model, &model.initial);
            quick.trajectories.now = t;
            let mut general = quick.clone();
            let (mut told, mut told_in_general) = (Log::default(), Log::default());
            let plan = Plan { contact: t, other: key.2 as u32, kind: key.0, is_contact: true, ..Plan::IDLE };
            if !collide(&mut quick, &model, &mut told, 0, &plan).expect("it goes on") {
                continue;
            }
            taken += 1;
            general.meet(&model, &mut told_in_general, key).expect("it goes on");
            let state = |of: &Mechanics| of.state_at(&model, t).hash();
            assert_eq!(state(&quick), state(&general), "case {case}");
            assert_eq!(told.contacts, told_in_general.contacts, "case {case}");
        }
        taken
    }

    #[test]
    fn a_plain_pair_gets_the_bits_that_the_general_impact_gives() {
        let taken = taken_alike(meeting, (Kind::Pair, 0, 1), Mechanics::collide_plain_pair);
        // all but those that approach no faster than what may rest
        assert!(taken > 900, "{taken} of 1000");
    }
}
