//! Overlap of every body with every other, and passage of centres through walls between two frames.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use crate::physics::contact::Key;
use crate::physics::{Class, Contact, Kind, Method, Model, Settings, State};

use super::crowd::Crowd;
use super::distance::{Board, boards};
use super::finding::{Bodies, Fault, Findings};
use super::promise::{Promise, ULPS};

/// What the clock cannot tell, in multiples of machine epsilon times the time: 4 ulp.
const CLOCK: f64 = 4.0 * f64::EPSILON;

/// Bodies whose gap is below this share of their radii, or rounding, touch.
const TOUCHING: f64 = 1e-9;

/// Two bodies that touch or overlap.
#[derive(Debug, Clone, Copy)]
struct Touching {
    key: Key,
    /// Gap, m; negative: overlap.
    gap: f64,
    /// What rounding leaves of the gap, m.
    rounding: f64,
    /// Radius r, or sum of the radii r₁ + r₂, m.
    reach: f64,
}

/// What touches and overlaps in one state.
#[derive(Debug, Clone)]
pub(super) struct Overlaps {
    boards: Vec<Board>,
    crowd: Crowd,
    found: Vec<Touching>,
    /// Degrees with which the run began, or to which bodies came in what the clock cannot tell, until they have parted.
    allowed: BTreeMap<Key, f64>,
}

/// Height of a hop, in radii, up to which event-driven methods sum up the bounces that follow: they say 1e-12, of the hop
/// after the next.
const SUMMED: f64 = 1e-10;

/// Whether a bounce is so low that those after it may not be told one by one. Out of an overlap, which its tolerance allows,
/// `swept` also sums up bounces on a wall that rubs that are no higher than the overlap is deep.
pub(super) fn is_summed_up(model: &Model, settings: &Settings, row: &Contact) -> bool {
    let pull = |i: usize| model.acceleration(i).length();
    let (pull, reach) = match row.kind {
        Kind::Wall => (pull(row.a), model.radii[row.a]),
        Kind::Pair => (pull(row.a) + pull(row.b), model.radii[row.a] + model.radii[row.b]),
    };
    let law = &model.law;
    let rubs =
        row.kind == Kind::Wall && law.tangential < 1.0 && law.wall_restitution > 0.0 && law.wall_restitution < 1.0;
    let deep =
        if settings.method == Method::Swept && rubs { row.degree.min(Promise::of(settings).flight) } else { 0.0 };
    row.separation_speed * row.separation_speed <= 2.0 * pull * SUMMED.max(deep) * reach
}

impl Overlaps {
    pub(super) fn new(model: &Model) -> Overlaps {
        let crowd = Crowd::new(&model.radii);
        Overlaps { boards: boards(model), crowd, found: Vec::new(), allowed: BTreeMap::new() }
    }

    /// Allows the overlaps that there are at the start.
    pub(super) fn begin(&mut self, model: &Model, x: &[DVec3]) {
        self.find(model, x);
        let deep = self.found.iter().filter(|at| at.gap < 0.0);
        self.allowed = deep.map(|at| (at.key, -at.gap / at.reach)).collect();
    }

    /// How deep bodies overlap beyond what they began with and what rounding leaves, and which: the deepest.
    pub(super) fn worst(&mut self, model: &Model, x: &[DVec3]) -> Option<(f64, Key)> {
        self.find(model, x);
        self.move_on();
        let beyond = |at: &Touching| {
            let allowed = self.allowed.get(&at.key).copied().unwrap_or(0.0);
            let degree = (-at.gap - at.rounding) / at.reach;
            (if degree > allowed * (1.0 + 1e-9) { degree } else { 0.0 }, at.key)
        };
        let worst = self.found.iter().map(beyond).max_by(|one, other| one.0.total_cmp(&other.0));
        self.forget_parted();
        worst
    }

    /// Judges a state, whose resting contacts are among `contacts`.
    pub(super) fn look(
        &mut self,
        model: &Model,
        state: &State,
        contacts: &[Contact],
        promise: Promise,
        findings: &mut Findings,
    ) {
        self.find(model, &state.x);
        self.move_on();
        self.allow_for_the_clock(state.t, contacts);
        let curved = curved(model, &self.boards, state, contacts);
        for at in &self.found {
            let (_, a, b) = at.key;
            let bends = curved[a] || (at.key.0 == Kind::Pair && curved[b]);
            let degree = if bends { promise.curved } else { promise.flight };
            let begun = self.allowed.get(&at.key).copied().unwrap_or(0.0);
            let bound = degree.max(begun + promise.flight) + at.rounding / at.reach;
            findings.hold(Fault::Overlap, state.t, at.key.into(), [-at.gap / at.reach, bound]);
        }
        self.forget_parted();
    }

    /// Has what a sphere began with on one wall move on to another that it overlaps too: on a floor of tiles it is as deep as
    /// on one wall, and no deeper.
    fn move_on(&mut self) {
        if self.allowed.is_empty() {
            return;
        }
        let deep: Vec<Key> =
            self.found.iter().filter(|at| at.key.0 == Kind::Wall && at.gap < 0.0).map(|at| at.key).collect();
        for &key in &deep {
            let others = deep.iter().filter(|other| other.1 == key.1).filter_map(|other| self.allowed.get(other));
            let most = others.copied().fold(0.0, f64::max);
            if most > 0.0 {
                self.allowed.entry(key).or_insert(most);
            }
        }
    }

    /// Allows what the clock cannot tell of bodies that have just met: so far they came in some of its ulp.
    fn allow_for_the_clock(&mut self, t: f64, contacts: &[Contact]) {
        let mut came: BTreeMap<Key, f64> = BTreeMap::new();
        for row in contacts.iter().filter(|row| row.time == t) {
            let way = came.entry(row.key()).or_default();
            *way = way.max(CLOCK * t.abs() * row.velocity.length());
        }
        for at in &self.found {
            if let Some(way) = came.get(&at.key).filter(|way| **way > at.rounding) {
                let allowed = self.allowed.entry(at.key).or_default();
                *allowed = allowed.max(way / at.reach);
            }
        }
    }

    /// Allows no more what overlapped at the start, or by the clock's rounding, and has parted.
    fn forget_parted(&mut self) {
        if !self.allowed.is_empty() {
            let deep: BTreeSet<Key> = self.found.iter().filter(|at| at.gap < 0.0).map(|at| at.key).collect();
            self.allowed.retain(|key, _| deep.contains(key));
        }
    }

    /// Contacts that touch in the state looked at last.
    pub(super) fn touching(&self) -> impl Iterator<Item = Key> + '_ {
        self.found.iter().map(|at| at.key)
    }

    /// Contacts that touch without a bounce in this frame: something else may hold or stop their bodies. A
    /// bounce so low that the rest of its series may be summed up counts as held.
    pub(super) fn held(&self, model: &Model, settings: &Settings, contacts: &[Contact]) -> BTreeSet<Key> {
        // a contact may bounce on, lower and lower: its last impact tells
        let mut bounced = BTreeSet::new();
        for row in contacts.iter().filter(|row| row.class == Class::Collide) {
            if restitution(model, row.kind) > 0.0 && !is_summed_up(model, settings, row) {
                bounced.insert(row.key());
            } else {
                bounced.remove(&row.key());
            }
        }
        let rests = contacts.iter().filter(|row| row.class != Class::Collide).map(Contact::key);
        self.touching().filter(|key| !bounced.contains(key)).chain(rests).collect()
    }

    /// Finds the contacts that touch, walls and pairs.
    fn find(&mut self, model: &Model, x: &[DVec3]) {
        let Overlaps { boards, crowd, found, .. } = self;
        found.clear();
        for (a, (x, r)) in x.iter().zip(&model.radii).enumerate() {
            for (b, board) in boards.iter().enumerate() {
                let rounding = ULPS * board.size(*x);
                let far = r * (1.0 + TOUCHING) + rounding;
                if board.level(*x).abs() > far {
                    continue;
                }
                let gap = board.offset(*x).length() - r;
                if gap <= TOUCHING * r + rounding {
                    found.push(Touching { key: (Kind::Wall, a, b), gap, rounding, reach: *r });
                }
            }
        }
        crowd.pairs(x, &model.radii, 1e-6, |a, b| {
            let reach = model.radii[a] + model.radii[b];
            let arm = x[a] - x[b];
            if arm.abs().max_element() > 1.5 * reach {
                return;
            }
            let rounding = ULPS * x[a].abs().max(x[b].abs()).max_element();
            let gap = arm.length() - reach;
            if gap <= TOUCHING * reach + rounding {
                found.push(Touching { key: (Kind::Pair, a, b), gap, rounding, reach });
            }
        });
    }

    /// Whether a centre has gone through a wall on its way from one state to the next.
    pub(super) fn passages(
        &self,
        model: &Model,
        before: &State,
        after: &State,
        method: Method,
        findings: &mut Findings,
    ) {
        let h = after.t - before.t;
        for a in 0..model.len().min(before.x.len()) {
            let (from, to) = (before.x[a], after.x[a]);
            // event-driven frames are parabolas that leave with v; the others are straight
            let event_driven = matches!(method, Method::Exact | Method::Swept);
            let way = to - from;
            let first = if event_driven { before.v[a] * h } else { way };
            let most = first.length() + 2.0 * (way - first).length();
            for (b, board) in self.boards.iter().enumerate() {
                let (start, end) = (board.level(from), board.level(to));
                if start.abs() > most && start * end > 0.0 {
                    continue;
                }
                let [c1, c2] = [board.normal.dot(first), end - start - board.normal.dot(first)];
                for s in crossings(start, c1, c2) {
                    let at = from + first * s + (way - first) * (s * s);
                    let inside = board.shares(at).iter().all(|share| *share > 1e-9 && *share < 1.0 - 1e-9);
                    if inside && start.abs() > TOUCHING * model.radii[a] {
                        findings.add(Fault::Passage, after.t, Bodies::Wall(a, b), [end.abs(), 0.0]);
                    }
                }
            }
        }
    }
}

/// Where c0 + c1 s + c2 s² changes its sign for 0 < s < 1.
fn crossings(c0: f64, c1: f64, c2: f64) -> impl Iterator<Item = f64> {
    let square = c1 * c1 - 4.0 * c2 * c0;
    let q = -0.5 * (c1 + square.max(0.0).sqrt().copysign(c1));
    [q / c2, c0 / q].into_iter().filter(move |s| square > 0.0 && *s > 0.0 && *s < 1.0)
}

/// The restitution of a kind of contact.
pub(super) fn restitution(model: &Model, kind: Kind) -> f64 {
    if kind == Kind::Wall { model.law.wall_restitution } else { model.law.restitution }
}

/// By sphere, whether it belongs to an island of resting contacts of which some turn: pairs, edges, corners.
fn curved(model: &Model, boards: &[Board], state: &State, contacts: &[Contact]) -> Vec<bool> {
    let mut bends = vec![false; model.len()];
    let rests: Vec<&Contact> = contacts.iter().filter(|row| row.class == Class::Rest).collect();
    for row in &rests {
        let flat = row.kind == Kind::Wall && {
            let share = boards[row.b].shares(state.x[row.a]);
            share.iter().all(|share| *share > 1e-9 && *share < 1.0 - 1e-9)
        };
        bends[row.a] |= !flat;
        if row.kind == Kind::Pair {
            bends[row.b] = true;
        }
    }
    // what rests on what bends is in its island
    for _ in 0..rests.len() {
        let mut spread = false;
        for row in rests.iter().filter(|row| row.kind == Kind::Pair) {
            let either = bends[row.a] || bends[row.b];
            spread |= bends[row.a] != either || bends[row.b] != either;
            (bends[row.a], bends[row.b]) = (either, either);
        }
        if !spread {
            break;
        }
    }
    bends
}
