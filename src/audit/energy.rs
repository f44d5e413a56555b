//! Energy never rises: all restitutions are at most 1, walls stand still, and forces are constant.

use glam::DVec3;

use crate::physics::{Class, Contact, Kind, Model, State};

use super::finding::{Bodies, Fault, Findings};

/// Ulps of the energy's terms that a run may gain at first; each impact may add one.
const ULPS: f64 = 4096.0;

/// Ulps of their places by which bodies pressed on each other may be off. In a line of spheres that just fits between walls,
/// loads of 1e11 N hold up a weight of 10 N; there an ulp of a place, 1e-16 m, is worth 1e-5 J.
const PRESSED_ULPS: f64 = 4.0;

/// Share of the energy's terms that the motion of one frame may lose: curved rest is integrated to some digits less.
const MOTION: f64 = 1e-11;

/// The energies of the states seen.
#[derive(Debug, Clone)]
pub(super) struct Energy {
    /// Least energy seen, J.
    least: f64,
    /// Energy of the last state, J.
    last: f64,
    /// Hidden energy of the last state, J.
    hidden: f64,
    /// Largest Σ of the energy's terms, each taken positive, J: what rounding is relative to.
    size: f64,
    /// Largest Σ of the loads of what rests, each times how far the coordinates of its bodies reach, J: what rounding of
    /// places is relative to.
    pressed: f64,
    /// Impacts so far.
    impacts: u64,
}

impl Energy {
    pub(super) fn new(model: &Model, state: &State) -> Energy {
        let (least, size) = energy(model, state);
        Energy { least, last: least, hidden: 0.0, size, pressed: 0.0, impacts: 0 }
    }

    /// Takes note of the loads of what rests at the end of a frame, `step` (s) long, by its contacts.
    pub(super) fn bear(&mut self, model: &Model, state: &State, contacts: &[Contact], step: f64) {
        let reach = |i: usize| state.x[i].abs().max_element() + model.radii[i];
        let both = |row: &Contact| reach(row.a) + if row.kind == Kind::Pair { reach(row.b) } else { 0.0 };
        // a rest that goes on, not one that begins by stopping an approach
        let goes_on = |row: &&Contact| row.class == Class::Rest && row.time == state.t && row.approach_speed == 0.0;
        let impulses: f64 = contacts.iter().filter(goes_on).map(|row| row.impulse * both(row)).sum();
        if step > 0.0 {
            self.pressed = self.pressed.max(impulses / step);
        }
    }

    /// By how much a state's energy, with what is `hidden` of it (J), is above the least seen, and what rounding allows, J;
    /// `impacts` since the last state.
    pub(super) fn rise(&mut self, model: &Model, (state, hidden): (&State, f64), impacts: u64) -> [f64; 2] {
        let (shown, size) = energy(model, state);
        let now = shown + hidden;
        self.size = self.size.max(size);
        self.impacts += impacts;
        let rise = now - self.least;
        self.last = now;
        self.least = self.least.min(now);
        let ulps = ULPS + self.impacts as f64 + model.len() as f64;
        [rise, f64::EPSILON * (ulps * self.size + PRESSED_ULPS * self.pressed)]
    }

    /// Judges a state; `explained` (J) is what impacts and rests may have taken since the last one, if that is known.
    pub(super) fn look(
        &mut self,
        model: &Model,
        (state, hidden): (&State, f64),
        impacts: u64,
        explained: Option<f64>,
        findings: &mut Findings,
    ) {
        // bounces that are summed up take what they take without being told
        let bounces = std::mem::replace(&mut self.hidden, hidden) != 0.0 || hidden != 0.0;
        let before = self.last;
        let rise = self.rise(model, (state, hidden), impacts);
        findings.hold(Fault::Energy, state.t, Bodies::All, rise);
        if let Some(explained) = explained.filter(|_| !bounces) {
            let lost = [before - self.last - explained, MOTION * self.size];
            findings.hold(Fault::Loss, state.t, Bodies::All, lost);
        }
    }
}

/// Σ ½ m v² − m a·x, J, and Σ of the magnitudes of its terms, J. Products of m a and x reach as far as x is rounded: m a
/// |x|.
fn energy(model: &Model, state: &State) -> (f64, f64) {
    let mut sum = (0.0, 0.0);
    for (i, (x, v)) in state.x.iter().zip(&state.v).enumerate() {
        let (m, a): (f64, DVec3) = (model.masses[i], model.acceleration(i));
        let (kinetic, potential) = (0.5 * m * v.dot(*v), m * a.dot(*x));
        sum.0 += kinetic - potential;
        sum.1 += kinetic + m * a.length() * (x.length() + model.radii[i]);
    }
    sum
}
