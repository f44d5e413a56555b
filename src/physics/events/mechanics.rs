//! All that events act on, apart from the schedule: what moves, what rests, and what impacts have led to.

use super::contact_state::ContactState;
use super::impacts::Impacts;
use super::islands::resting::Rests;
use super::trajectories::Trajectories;
use crate::physics::contact::{Key, Kind};
use crate::physics::model::Model;
use crate::physics::state::State;

/// The bodies and their contacts. Handlers of events change it, and say which spheres the loop must predict anew.
#[derive(Debug, Clone)]
pub(crate) struct Mechanics {
    /// Where every sphere is, and the clock.
    pub(crate) trajectories: Trajectories,
    /// What rests, island by island.
    pub(crate) rests: Rests,
    /// What impacts have led to.
    pub(crate) impacts: Impacts,
}

impl Mechanics {
    /// The mechanics of spheres at `state`, of which nothing rests yet.
    pub(crate) fn new(model: &Model, state: &State) -> Mechanics {
        Mechanics {
            trajectories: Trajectories::new(model, state),
            rests: Rests::new(state.t),
            impacts: Impacts::new(model),
        }
    }

    /// A copy of which states from `time` (s) on can be read, and none before.
    pub(crate) fn since(&self, time: f64) -> Mechanics {
        Mechanics {
            trajectories: self.trajectories.since(time),
            rests: self.rests.since(time),
            impacts: self.impacts.clone(),
        }
    }

    /// Memory that they take beside their own size, bytes, as near as their parts tell.
    pub(crate) fn bytes(&self) -> usize {
        self.trajectories.bytes() + self.rests.bytes() + self.impacts.bytes()
    }

    /// The state at `t` (s) within the last frame.
    pub(crate) fn state_at(&self, model: &Model, t: f64) -> State {
        let mut state = self.trajectories.state_at(t);
        self.rests.arcs_into(model, &mut state);
        self.trajectories.hopping.write_into(&mut state);
        state
    }

    /// Forgets the states of earlier frames, which can no longer be read then: a frame begins.
    #[inline(always)]
    pub(crate) fn forget_past(&mut self) {
        self.trajectories.forget_past();
        self.rests.forget();
    }

    /// Makes a contact that is over open at no less than `least` (m/s, a rounding): the prediction would find it again and
    /// again. Whether it had to; both bodies give way by their masses, or what lies between two others would be sent to and fro
    /// for ever.
    pub(crate) fn ensure_separating(&mut self, model: &Model, key: Key, least: f64) -> bool {
        let trajectories = &mut self.trajectories;
        let (kind, a, b) = key;
        let [one, other] = [a, if kind == Kind::Pair { b } else { a }].map(|i| trajectories.inverse_mass(i));
        let share = if kind == Kind::Pair { one / (one + other) } else { 1.0 };
        let mut nudge = f64::EPSILON * trajectories.speeds(key).max(f64::MIN_POSITIVE);
        for pushes in 0..64 {
            let v_n = trajectories.v_n(model, key);
            if v_n >= least || v_n.is_nan() {
                return pushes > 0;
            }
            let push = trajectories.contact_state(model, key).normal * nudge.max(least - v_n);
            trajectories.push(a, push * share);
            if kind == Kind::Pair {
                trajectories.push(b, push * (share - 1.0));
            }
            nudge *= 2.0;
        }
        true
    }

    /// The bodies of a contact now, their trajectories brought to the present.
    pub(crate) fn advanced_contact(&mut self, model: &Model, key: Key) -> ContactState {
        let (kind, a, b) = key;
        self.advance(model, a);
        if kind == Kind::Pair {
            self.advance(model, b);
        }
        self.trajectories.contact_state(model, key)
    }

    /// Brings the trajectory of sphere `i` to the present; if it moves on an arc, its whole island's, which must then be
    /// solved again.
    pub(crate) fn advance(&mut self, model: &Model, i: usize) {
        match self.rests.leave_chord(i, self.trajectories.now) {
            None => self.trajectories.advance(i),
            Some((spheres, followed)) => {
                let bodies = followed.real(model, self.trajectories.now - followed.from);
                for (body, &sphere) in bodies.iter().zip(&spheres) {
                    self.trajectories.rewrite(sphere, body.x, body.v);
                }
            }
        }
    }
}
