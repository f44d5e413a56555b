//! The judge: asks every file of this room about a frame, and keeps what they find.

use std::collections::BTreeSet;

use crate::physics::contact::Key;
use crate::physics::{Class, Contact, Kind, Method, Model, Settings, Simulation, State};

use super::energy::Energy;
use super::finding::{Bodies, Fault, Findings};
use super::frame::Frame;
use super::overlap::Overlaps;
use super::promise::Promise;
use super::replay::{self, Replay};
use super::{law, rest};

/// The judge of one run.
#[derive(Debug, Clone)]
pub struct Judge {
    settings: Settings,
    before: State,
    /// Contacts that touched at the end of the frame before, and were no impact that leaves.
    held: BTreeSet<Key>,
    /// Contacts of the frame before: `paper` answers them in this one.
    answered: Vec<Contact>,
    overlaps: Overlaps,
    energy: Energy,
    replay: Replay,
    findings: Findings,
}

impl Judge {
    /// A judge of a run that is at `state` now; what overlaps there is allowed until it has parted.
    pub fn new(model: &Model, settings: Settings, state: &State) -> Judge {
        let mut judge = Judge {
            settings,
            before: state.clone(),
            held: BTreeSet::new(),
            answered: Vec::new(),
            overlaps: Overlaps::new(model),
            energy: Energy::new(model, state),
            replay: Replay::new(state),
            findings: Findings::default(),
        };
        judge.overlaps.begin(model, &state.x);
        judge.held = judge.overlaps.touching().collect();
        judge
    }

    /// A judge of a simulation that has just begun.
    pub fn of(simulation: &Simulation) -> Judge {
        Judge::new(simulation.model(), simulation.settings(), &simulation.state())
    }

    /// Judges the frame that a simulation has just completed; `events` are those told since the frame before.
    pub fn frame(&mut self, simulation: &Simulation, events: &[Contact]) {
        let (state, contacts) = (simulation.state(), simulation.contacts());
        let hidden = simulation.hidden_energy();
        self.look(simulation.model(), &Frame { state: &state, contacts, events, hidden });
    }

    /// Judges a frame.
    pub fn look(&mut self, model: &Model, frame: &Frame) {
        let Frame { state, contacts, events, hidden } = *frame;
        let found = &mut self.findings;
        if let Some(i) = (0..state.x.len()).find(|&i| !(state.x[i].is_finite() && state.v[i].is_finite())) {
            found.add(Fault::NotANumber, state.t, Bodies::Sphere(i), [f64::NAN, 0.0]);
            return;
        }
        let promise = Promise::of(&self.settings);
        self.overlaps.look(model, state, contacts, promise, found);
        self.overlaps.passages(model, &self.before, state, self.settings.method, found);
        let held = self.overlaps.held(model, &self.settings, contacts);
        events.iter().for_each(|row| law::judge(model, self.settings.method, row, found));
        for row in contacts {
            law::judge_place(
                model,
                promise,
                (state, moved(self.settings.method, [&self.before, state], row)),
                row,
                found,
            );
        }
        law::judge_friction(model, contacts, &held, state.t, found);
        rest::judge(model, &self.settings, frame, found);
        let free = replay::Freedom { before: &self.held, after: &held, answered: &self.answered };
        let explained = self.replay.judge(model, &self.settings, [&self.before, state], (contacts, free), found);
        let impacts = contacts.iter().filter(|row| row.class == Class::Collide).count();
        self.energy.bear(model, state, contacts, state.t - self.before.t);
        self.energy.look(model, (state, hidden), impacts as u64, explained, found);
        self.before.clone_from(state);
        self.held = held;
        self.answered.clear();
        self.answered.extend_from_slice(contacts);
    }

    /// Judges a state within the last frame, and what is hidden of its energy (J): only its overlaps and its energy.
    pub fn state(&mut self, model: &Model, (state, hidden): (&State, f64), contacts: &[Contact]) {
        let promise = Promise::of(&self.settings);
        self.overlaps.look(model, state, contacts, promise, &mut self.findings);
        self.energy.look(model, (state, hidden), 0, None, &mut self.findings);
    }

    /// What was found so far.
    pub fn findings(&self) -> &Findings {
        &self.findings
    }
}

/// How far the bodies of an impact may have moved, m, from where they met to where they are at the frame's end: `moreau`
/// meets within the frame what it strikes.
fn moved(method: Method, [before, after]: [&State; 2], row: &Contact) -> f64 {
    if method != Method::Moreau || row.class != Class::Collide {
        return 0.0;
    }
    let way = |i: usize| before.v[i].length().max(after.v[i].length()) * (after.t - before.t);
    way(row.a) + if row.kind == Kind::Pair { way(row.b) } else { 0.0 }
}
