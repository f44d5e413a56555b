//! The complementarity problem of a frame: u = u₀ + M⁻¹ Jᵀ Λ, 0 ≤ Λ ⊥ J u + c ≥ 0.
//!
//! Projected Gauss–Seidel, to and fro over all rows, from the impulses of the last frame (source: Moreau, Jean; Acary,
//! Brogliato, Numerical Methods for Nonsmooth Dynamical Systems, 12.4). It fails in silence where masses are unlike, so
//! that islands of unlike masses go to `support`'s direct solver at once, and those that sweeping has not solved in
//! time go there too, as long as they are small. Whatever is left is said in the outcome.

use glam::DVec3;

use super::super::support::{self, islands};
use super::super::{Kind, Model};
use super::meeting::Row;

/// Ratio of two masses in an island from which sweeping is not tried: it would need about as many sweeps.
const UNLIKE_MASSES: f64 = 100.0;

/// Rows up to which an island is solved directly at all: some milliseconds, and the cost grows with the cube.
const MOST_DIRECT_ROWS: usize = 400;

/// Rows solved in all until islands are solved directly that are small enough: about what the direct solver costs.
const PATIENCE: usize = 60_000;

/// Most sweeps over rows of which none may be solved directly.
const MOST_SWEEPS: usize = 3000;

/// No sphere: the second body of a wall's row, of infinite mass.
const WALL: u32 = u32::MAX;

/// A sphere while its rows are solved.
#[derive(Debug, Clone, Copy)]
struct Body {
    u: DVec3,
    inverse_mass: f64,
}

/// A row as the sweeps read it.
#[derive(Debug, Clone, Copy)]
struct Line {
    a: u32,
    b: u32,
    normal: DVec3,
    offset: f64,
    /// 1/A_jj, kg.
    weight: f64,
    slack: f64,
    impulse: f64,
}

/// What the solver does next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stage {
    /// Sweeps, the number made so far.
    Sweep(usize),
    /// Solved, or given up.
    Done,
}

/// The problem of one frame, solved in slices of a sweep.
#[derive(Debug, Clone)]
pub(super) struct Solver {
    bodies: Vec<Body>,
    lines: Vec<Line>,
    /// Whether a line's island has been solved directly.
    settled: Vec<bool>,
    /// Whether all masses are alike enough for sweeping.
    alike: bool,
    stage: Stage,
    /// Whether every row is complementary to its slack.
    pub(super) converged: bool,
    /// Rows solved so far, one at a time.
    pub(super) solved: u64,
}

impl Solver {
    pub(super) fn new(model: &Model) -> Solver {
        let least = model.masses.iter().copied().fold(f64::INFINITY, f64::min);
        let most = model.masses.iter().copied().fold(0.0, f64::max);
        Solver {
            bodies: Vec::new(),
            lines: Vec::new(),
            settled: Vec::new(),
            alike: model.is_empty() || most / least < UNLIKE_MASSES,
            stage: Stage::Done,
            converged: true,
            solved: 0,
        }
    }

    /// A new frame begins.
    pub(super) fn forget(&mut self) {
        self.solved = 0;
        self.converged = true;
    }

    /// Sets out from the free velocities u₀, m/s, and the rows' impulses.
    pub(super) fn begin(&mut self, model: &Model, free: &[DVec3], rows: &[Row]) {
        self.bodies.clear();
        self.bodies.extend(free.iter().zip(&model.inverse_masses).map(|(&u, &inverse_mass)| Body { u, inverse_mass }));
        self.lines.clear();
        self.lines.extend(rows.iter().map(|row| line(model, row)));
        self.settled.clear();
        self.settled.resize(rows.len(), false);
        for line in &self.lines {
            if line.impulse > 0.0 {
                push(&mut self.bodies, line, line.impulse);
            }
        }
        if !self.alike {
            self.solve_directly(model, free, |ratio| ratio >= UNLIKE_MASSES);
        }
        self.stage = if rows.is_empty() { Stage::Done } else { Stage::Sweep(0) };
    }

    /// Goes on: whether it is done, and the work that took.
    pub(super) fn go_on(&mut self, model: &Model, free: &[DVec3]) -> (bool, u64) {
        let Stage::Sweep(sweeps) = self.stage else { return (true, 0) };
        let calm = self.sweep(true) & self.sweep(false);
        self.stage = Stage::Sweep(sweeps + 2);
        let rows = self.lines.len();
        self.solved += 2 * rows as u64;
        if calm && self.is_solved() {
            self.stage = Stage::Done;
        } else if sweeps * rows >= PATIENCE && sweeps + 2 >= 20 {
            self.stage = self.give_up(model, free, sweeps);
        }
        (self.stage == Stage::Done, 2 * rows as u64)
    }

    /// Sweeping has taken long: small islands are solved directly, the others swept on for a while.
    fn give_up(&mut self, model: &Model, free: &[DVec3], sweeps: usize) -> Stage {
        if self.settled.iter().all(|&settled| !settled) {
            self.solve_directly(model, free, |_| true);
        }
        self.converged = self.is_solved();
        let more = sweeps < MOST_SWEEPS && self.settled.contains(&false);
        if self.converged || !more { Stage::Done } else { Stage::Sweep(sweeps) }
    }

    /// One sweep over all lines, forwards or backwards; whether no row moved by more than its slack.
    fn sweep(&mut self, forwards: bool) -> bool {
        let Solver { bodies, lines, settled, .. } = self;
        let mut calm = true;
        let mut relax = |(line, settled): (&mut Line, &bool)| {
            if !settled {
                calm &= relax(bodies, line);
            }
        };
        if forwards {
            lines.iter_mut().zip(settled.iter()).for_each(&mut relax);
        } else {
            lines.iter_mut().zip(settled.iter()).rev().for_each(&mut relax);
        }
        calm
    }

    /// Whether every row is complementary: |min(J u + c, Λ A_jj)| within its slack.
    fn is_solved(&self) -> bool {
        self.lines.iter().all(|line| {
            let residual = opening(&self.bodies, line).min(line.impulse / line.weight).abs();
            residual <= line.slack
        })
    }

    /// Solves those islands directly that are small enough and whose ratio of masses is `wanted`.
    fn solve_directly(&mut self, model: &Model, free: &[DVec3], wanted: impl Fn(f64) -> bool) {
        let other = |line: &Line| (line.b != WALL).then_some(line.b as usize);
        let links: Vec<_> = self.lines.iter().map(|line| (line.a as usize, other(line))).collect();
        for island in islands(&links) {
            let masses = island.bodies.iter().map(|&body| model.masses[body]);
            let (least, most) = masses.fold((f64::INFINITY, 0.0_f64), |(l, m), mass| (l.min(mass), m.max(mass)));
            if island.contacts.len() > MOST_DIRECT_ROWS || !wanted(most / least) {
                continue;
            }
            let row = |line: &Line| support::Row {
                a: line.a as usize,
                b: other(line),
                normal: line.normal,
                offset: line.offset,
            };
            let rows: Vec<_> = island.contacts.iter().map(|&index| row(&self.lines[index])).collect();
            let guess: Vec<f64> = island.contacts.iter().map(|&index| self.lines[index].impulse).collect();
            let solution = support::solve(&model.inverse_masses, free, &rows, &guess);
            for (&index, &impulse) in island.contacts.iter().zip(&solution.multipliers) {
                self.lines[index].impulse = impulse;
                self.settled[index] = true;
            }
            for (&body, &u) in solution.bodies.iter().zip(&solution.vectors) {
                self.bodies[body].u = u;
            }
            self.solved += solution.reports.iter().map(|report| (report.contacts * report.passes) as u64).sum::<u64>();
        }
    }

    /// u of a sphere, m/s.
    pub(super) fn velocity(&self, sphere: usize) -> DVec3 {
        self.bodies[sphere].u
    }

    /// Puts the impulses, N s, into the rows that the problem began with.
    pub(super) fn read_impulses(&self, rows: &mut [Row]) {
        rows.iter_mut().zip(&self.lines).for_each(|(row, line)| row.impulse = line.impulse);
    }
}

fn line(model: &Model, row: &Row) -> Line {
    let (kind, a, b) = row.key;
    let (b, inverse) = match kind {
        Kind::Wall => (WALL, 0.0),
        Kind::Pair => (b as u32, model.inverse_masses[b]),
    };
    let weight = 1.0 / (model.inverse_masses[a] + inverse);
    let Row { normal, offset, slack, impulse, .. } = *row;
    Line { a: a as u32, b, normal, offset, weight, slack, impulse }
}

/// J u + c of a row, m/s.
#[inline(always)]
fn opening(bodies: &[Body], line: &Line) -> f64 {
    let other = bodies.get(line.b as usize).map_or(DVec3::ZERO, |body| body.u);
    line.normal.dot(bodies[line.a as usize].u - other) + line.offset
}

/// Solves one row for its impulse, the others held: Λ ← max(0, Λ − (J u + c)/A_jj). Whether that moved it by no more
/// than its slack.
#[inline(always)]
fn relax(bodies: &mut [Body], line: &mut Line) -> bool {
    let new = (line.impulse - opening(bodies, line) * line.weight).max(0.0);
    let change = new - line.impulse;
    if change != 0.0 {
        line.impulse = new;
        push(bodies, line, change);
    }
    change.abs() <= line.slack * line.weight
}

/// Moves the bodies of a row by an impulse along its normal, N s.
#[inline(always)]
fn push(bodies: &mut [Body], line: &Line, impulse: f64) {
    let along = line.normal * impulse;
    let a = &mut bodies[line.a as usize];
    a.u += along * a.inverse_mass;
    if let Some(b) = bodies.get_mut(line.b as usize) {
        b.u -= along * b.inverse_mass;
    }
}
