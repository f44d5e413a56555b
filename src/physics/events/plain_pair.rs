//! Two spheres strike the way nearly all do in a gas: nothing rests, the same accelerates both, they approach faster than
//! what may rest. It is what the general way (`impact`) makes of such a pair, bit for bit, with each record read once.

use super::detector::Detector;
use super::engine::EventDriven;
use super::impact::{ContactState, note};
use super::instant::LONG_CHAIN;
use super::schedule::prediction::Plan;
use super::trajectories::{Trajectories, Trajectory};
use crate::physics::contact::{Class, Kind};
use crate::physics::impact_law::{pair_normal_velocity, pair_push, separation_speed};
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::state::Stall;

/// Two spheres that touch now, the one of the lower index first.
struct Pair {
    seats: [usize; 2],
    /// At the present.
    lines: [Trajectory; 2],
    /// When the motion of either last changed, s.
    since: f64,
    meeting: ContactState,
}

impl Pair {
    /// The pair that the sphere at a seat planned to meet, as [`EventDriven::contact_state`] sees it at `now` (s); none if what
    /// accelerates them differs.
    #[inline(always)]
    fn new(flight: &Trajectories, seat: usize, plan: &Plan, now: f64) -> Option<Pair> {
        let (a, other) = (flight.common()?, plan.other as usize);
        let swap = usize::from(flight.sphere(seat) > flight.sphere(other));
        let seats = [[seat, other][swap], [other, seat][swap]];
        let [one, two] = [&flight.records[seats[0]], &flight.records[seats[1]]];
        let since = one.line.t.max(two.line.t);
        let lines = [one.line.brought(a, now), two.line.brought(a, now)];
        let key = (Kind::Pair, one.sphere as usize, two.sphere as usize);
        let [one, two] = [lines[0].path(a, now), lines[1].path(a, now)];
        let (x, reach) = (one.x - two.x, lines[0].r + lines[1].r);
        let distance = x.length();
        let (normal, gap) = (x / distance, distance - reach);
        let meeting = ContactState {
            key,
            point: two.x + normal * (lines[1].r + 0.5 * gap),
            normal,
            gap,
            reach,
            v_n: pair_normal_velocity(x, one.v - two.v),
            // nothing presses them together: that is all that would be asked
            a_n: 0.0,
            flat: false,
        };
        Some(Pair { seats, lines, since, meeting })
    }
}

impl<D: Detector> EventDriven<D> {
    /// Lets the impact law act on the pair that the sphere at a seat planned to meet, if it is as simple as that; says
    /// whether it was.
    #[inline]
    pub(super) fn collide_plain_pair(
        &mut self,
        model: &Model,
        log: &mut Log,
        seat: usize,
        plan: &Plan,
    ) -> Result<bool, Stall> {
        if plan.kind != Kind::Pair || !self.rests.is_empty() {
            return Ok(false);
        }
        let Some(pair) = Pair::new(&self.flight, seat, plan, self.now) else { return Ok(false) };
        if !self.is_plain(model, &pair.meeting) || self.may_chatter(&pair.meeting, pair.since) {
            return Ok(false);
        }
        let target = separation_speed(pair.meeting.v_n, Class::Collide, Kind::Pair, &model.law);
        let share = self.exchange(model, &pair);
        let impulse = (target - pair.meeting.v_n) / share;
        note(log, pair.meeting.row(self.now, Class::Collide, impulse, target));
        for seat in pair.seats {
            self.finite_at(seat)?;
        }
        // the due one last: then it is known what comes next
        self.predict_at(model, plan.other as usize);
        self.predict_due(model, seat);
        Ok(true)
    }

    /// Whether a pair that nothing presses together collides without any of what the general way watches for.
    #[inline(always)]
    fn is_plain(&self, model: &Model, meeting: &ContactState) -> bool {
        let v_n = meeting.v_n;
        let watched = model.law.restitution < 1.0 && v_n * v_n == 0.0;
        v_n < -model.law.rest_speed && !watched && self.instant.events <= LONG_CHAIN
    }

    /// Both get their impulse; returns 1/m₁ + 1/m₂, 1/kg.
    #[inline(always)]
    fn exchange(&mut self, model: &Model, pair: &Pair) -> f64 {
        let (seats, [one, two]) = (pair.seats, pair.lines);
        let [share_a, share_b] =
            [self.flight.records[seats[0]].inverse_mass, self.flight.records[seats[1]].inverse_mass];
        let (arm, w, share) = (one.x - two.x, one.v - two.v, share_a + share_b);
        let push = pair_push(arm, w, share, model.law.restitution);
        let (one, two) =
            (Trajectory { v: one.v + push * share_a, ..one }, Trajectory { v: two.v + push * -share_b, ..two });
        self.flight.turn(seats[0], one);
        self.flight.turn(seats[1], two);
        if pair_normal_velocity(arm, one.v - two.v) < 0.0 {
            self.ensure_separating(model, pair.meeting.key, 0.0);
        }
        share
    }
}
