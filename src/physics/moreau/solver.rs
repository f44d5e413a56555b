//! The complementarity problem of a frame: u = u₀ + M⁻¹ Jᵀ Λ, 0 ≤ Λ ⊥ J u + c ≥ 0.
//!
//! Projected Gauss–Seidel, to and fro over all rows, from the impulses of the last frame (source: Moreau, Jean; Acary,
//! Brogliato, Numerical Methods for Nonsmooth Dynamical Systems, 12.4). It fails in silence where masses are unlike, so
//! that islands of unlike masses go to `support`'s direct solver at once, and those that sweeping has not solved in
//! time go there too, as long as they are small. Whatever is left is said in the outcome.
//!
//! Newton's law in several contacts at once can create energy. An island that would is solved once more without
//! rebounds, which never creates any, and takes the mean of both, u = (1 − s) u_without + s u_with, with the largest s
//! that keeps its kinetic energy: every condition that both fulfil the mean fulfils too.

use glam::DVec3;

use super::contact_row::Row;
use crate::physics::contact::Kind;
use crate::physics::model::Model;
use crate::physics::support::{self, Island, islands};

/// Ratio of two masses in an island from which sweeping is not tried: it would need about as many sweeps.
const UNLIKE_MASSES: f64 = 100.0;

/// Rows up to which an island is solved directly at all: some milliseconds, and the cost grows with the cube.
const MOST_DIRECT_ROWS: usize = 400;

/// Rows up to which an island goes to the direct solver as soon as sweeping takes long: about a millisecond.
const DIRECT_ROWS: usize = 160;

/// Rows solved in all until islands are solved directly that are small enough: about what the direct solver costs.
const PATIENCE: usize = 60_000;

/// Most sweeps over rows of which none may be solved directly.
const MOST_SWEEPS: usize = 3000;

/// Fewest sweeps before that, however many rows there are.
const LEAST_SWEEPS: usize = 20;

/// Sweeps after which the residual is looked at even though rows still move: with tolerance 0 they always do.
const SWEEPS_PER_LOOK: usize = 16;

/// Relative size of what rounding leaves of a body's velocity after many pushes, about 1e-13.
const ROUNDING: f64 = 512.0 * f64::EPSILON;

/// Share by which an island's kinetic energy may grow before it counts as a gain: rounding.
const GAIN: f64 = 1e-12;

/// The second body of a wall's row: no sphere, of infinite mass.
const WALL: u32 = u32::MAX;

/// A sphere while its rows are solved.
#[derive(Debug, Clone, Copy)]
struct Body {
    /// Velocity, m/s.
    u: DVec3,
    /// Inverse mass, 1/kg.
    inverse_mass: f64,
}

/// A row as the sweeps read it.
#[derive(Debug, Clone, Copy)]
struct Line {
    /// Index of the first body.
    a: u32,
    /// Index of the second body; [`WALL`] for a wall.
    b: u32,
    /// Unit normal, from the second body to the first.
    normal: DVec3,
    /// Offset c of the problem, m/s.
    offset: f64,
    /// Inverse diagonal 1/A_jj of the problem, kg.
    weight: f64,
    /// Largest change that counts as none, m/s.
    slack: f64,
    /// Impulse Λ, N s.
    impulse: f64,
    /// Whether the row's island needs no sweeps: it has been solved directly, or another one is solved without rebounds.
    settled: bool,
}

/// An island that would gain energy, and its solution with rebounds.
#[derive(Debug, Clone)]
struct Gain {
    island: Island,
    /// Velocities by body, m/s; empty if rebounds contradict each other.
    u: Vec<DVec3>,
    /// Impulses by contact, N s; empty if rebounds contradict each other.
    impulses: Vec<f64>,
    /// Σ m u² that the island may have, J.
    allowed: f64,
}

/// What the solver does next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SolverStage {
    /// Sweeps again, after this many sweeps.
    Sweep(usize),
    /// Nothing: the problem is solved, or given up.
    Done,
}

/// The problem of one frame, solved in slices of a sweep.
#[derive(Debug, Clone)]
pub(super) struct Solver {
    bodies: Vec<Body>,
    lines: Vec<Line>,
    /// Number of rows up to which islands have been solved directly already.
    resorted: usize,
    /// Islands being solved without rebounds.
    gains: Vec<Gain>,
    /// Whether all masses are alike enough for sweeping.
    alike: bool,
    stage: SolverStage,
    /// Whether every row is complementary to its slack.
    pub(super) converged: bool,
    /// Rows solved so far, one at a time.
    pub(super) solved: u64,
}

impl Solver {
    pub(super) fn new(model: &Model) -> Solver {
        let least = model.masses.iter().copied().fold(f64::INFINITY, f64::min);
        let most = model.masses.iter().copied().fold(0.0, f64::max);
        Solver::idle(model.is_empty() || most / least < UNLIKE_MASSES)
    }

    /// A solver without a problem, of masses that are alike enough for sweeping or not.
    fn idle(alike: bool) -> Solver {
        Solver {
            bodies: Vec::new(),
            lines: Vec::new(),
            resorted: 0,
            gains: Vec::new(),
            alike,
            stage: SolverStage::Done,
            converged: true,
            solved: 0,
        }
    }

    /// A copy without a problem.
    pub(super) fn kept(&self) -> Solver {
        Solver::idle(self.alike)
    }

    /// Forgets the problem of the last frame: a new one begins.
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
        self.gains.clear();
        self.converged = true;
        for line in &self.lines {
            if line.impulse > 0.0 {
                push(&mut self.bodies, line, line.impulse);
            }
        }
        self.set_out(model, free);
    }

    /// Begins to sweep; islands of unlike masses are solved at once, and so are spheres with nothing but walls about them:
    /// what sweeping leaves undone would make a sphere feel seams.
    fn set_out(&mut self, model: &Model, free: &[DVec3]) {
        self.resorted = 0;
        self.stage = SolverStage::Sweep(0);
        if self.any_alone() {
            self.solve_directly(model, free, MOST_DIRECT_ROWS, |island, _| island.bodies.len() == 1);
        }
        if !self.alike {
            self.solve_directly(model, free, MOST_DIRECT_ROWS, |_, ratio| ratio >= UNLIKE_MASSES);
        }
    }

    /// Whether some sphere has several rows, all with walls.
    fn any_alone(&self) -> bool {
        let walls = self.lines.iter().take_while(|line| line.b == WALL).count();
        let (walls, pairs) = self.lines.split_at(walls);
        let mut several = walls.windows(2).filter(|two| two[0].a == two[1].a).map(|two| two[0].a).peekable();
        if several.peek().is_none() {
            return false;
        }
        let mut paired = vec![false; self.bodies.len()];
        pairs.iter().for_each(|line| (paired[line.a as usize], paired[line.b as usize]) = (true, true));
        several.any(|a| !paired[a as usize])
    }

    /// Goes on, with the free velocities and those of the frame's start (m/s): whether it is done, and the work that took.
    pub(super) fn go_on(&mut self, model: &Model, free: &[DVec3], v: &[DVec3], rows: &[Row]) -> (bool, u64) {
        let SolverStage::Sweep(sweeps) = self.stage else { return (true, 0) };
        let calm = self.sweep(true) & self.sweep(false);
        self.stage = SolverStage::Sweep(sweeps + 2);
        let count = self.lines.len();
        self.solved += 2 * count as u64;
        if (calm || sweeps % SWEEPS_PER_LOOK == 0) && self.is_solved() {
            self.stage = SolverStage::Done;
        } else if sweeps * count >= PATIENCE && sweeps >= LEAST_SWEEPS {
            self.give_up(model, free, sweeps);
        }
        if self.stage == SolverStage::Done {
            self.finish(model, free, v, rows);
        }
        (self.stage == SolverStage::Done, 2 * count as u64)
    }

    /// Gives up sweeping alone, which has taken long: small islands are solved directly, the others swept on for a while.
    fn give_up(&mut self, model: &Model, free: &[DVec3], sweeps: usize) {
        let rows = if sweeps >= MOST_SWEEPS { MOST_DIRECT_ROWS } else { DIRECT_ROWS };
        if self.resorted < rows {
            self.resorted = rows;
            self.solve_directly(model, free, rows, |_, _| true);
        }
        if self.is_solved() || sweeps >= MOST_SWEEPS || self.lines.iter().all(|line| line.settled) {
            self.stage = SolverStage::Done;
        }
    }

    /// Sweeps over all rows once, forwards or backwards; whether no row moved by more than its slack.
    fn sweep(&mut self, forwards: bool) -> bool {
        let Solver { bodies, lines, .. } = self;
        let mut calm = true;
        // Two loops: one over a boxed or chained iterator costs a call a row.
        if forwards {
            for line in lines.iter_mut().filter(|line| !line.settled) {
                calm &= relax(bodies, line);
            }
        } else {
            for line in lines.iter_mut().rev().filter(|line| !line.settled) {
                calm &= relax(bodies, line);
            }
        }
        calm
    }

    /// Whether every row is complementary.
    fn is_solved(&self) -> bool {
        self.lines.iter().all(|line| self.residual(line) <= line.slack) || self.unsolved().is_none()
    }

    /// |min(J u + c, Λ A_jj)| of a row, m/s.
    fn residual(&self, line: &Line) -> f64 {
        opening(&self.bodies, line).min(line.impulse / line.weight).abs()
    }

    /// The rows, by index, that are not complementary within their slack or within the rounding of what their bodies
    /// carry; none if all are.
    fn unsolved(&self) -> Option<Vec<bool>> {
        // All that is pushed into and out of a body's velocity, m/s.
        let mut load = vec![0.0; self.bodies.len()];
        for line in &self.lines {
            load[line.a as usize] += line.impulse * self.bodies[line.a as usize].inverse_mass;
            if let Some(b) = other(line) {
                load[b] += line.impulse * self.bodies[b].inverse_mass;
            }
        }
        let carried = |line: &Line| load[line.a as usize] + other(line).map_or(0.0, |b| load[b]);
        let missed = |line: &Line| {
            let residual = self.residual(line);
            residual.is_nan() || residual > line.slack.max(ROUNDING * carried(line))
        };
        let missed: Vec<bool> = self.lines.iter().map(missed).collect();
        missed.contains(&true).then_some(missed)
    }

    /// Ends the solution of the rows. Sets out without rebounds for islands that would gain energy, or whose rebounds
    /// contradict each other (a sphere between two walls cannot leave both); if that is done already, takes the means.
    fn finish(&mut self, model: &Model, free: &[DVec3], v: &[DVec3], rows: &[Row]) {
        let unsolved = self.unsolved();
        let rebounds = self.gains.is_empty() && rows.iter().any(|row| row.offset < row.reached);
        if rebounds {
            self.gains = self.find_gains(model, free, v, rows, unsolved.as_deref());
            if !self.gains.is_empty() {
                self.drop_rebounds(free, rows);
                self.set_out(model, free);
                return;
            }
        }
        self.converged = unsolved.is_none();
        self.take_means(model);
    }

    fn find_gains(
        &self,
        model: &Model,
        free: &[DVec3],
        v: &[DVec3],
        rows: &[Row],
        unsolved: Option<&[bool]>,
    ) -> Vec<Gain> {
        let mut gains = Vec::new();
        for island in islands(&self.links()) {
            let energy = |u: &dyn Fn(usize) -> DVec3| -> f64 {
                island.bodies.iter().map(|&body| model.masses[body] * u(body).length_squared()).sum()
            };
            let allowed = energy(&|body| free[body]).max(energy(&|body| v[body]));
            let rebounds = island.contacts.iter().any(|&index| rows[index].offset < rows[index].reached);
            let missed = |missed: &[bool]| island.contacts.iter().any(|&index| missed[index]);
            let contradictory = rebounds && unsolved.is_some_and(missed);
            if contradictory || energy(&|body| self.bodies[body].u) > allowed * (1.0 + GAIN) {
                let (u, impulses) = if contradictory {
                    (Vec::new(), Vec::new())
                } else {
                    let impulses = island.contacts.iter().map(|&index| self.lines[index].impulse).collect();
                    (island.bodies.iter().map(|&body| self.bodies[body].u).collect(), impulses)
                };
                gains.push(Gain { island, u, impulses, allowed });
            }
        }
        gains
    }

    /// Sets the islands of `gains` back to the start, without rebounds; all others stay as they are.
    fn drop_rebounds(&mut self, free: &[DVec3], rows: &[Row]) {
        self.lines.iter_mut().for_each(|line| line.settled = true);
        for gain in &self.gains {
            gain.island.bodies.iter().for_each(|&body| self.bodies[body].u = free[body]);
            for &index in &gain.island.contacts {
                let line = &mut self.lines[index];
                line.settled = false;
                line.offset = rows[index].reached;
                if gain.u.is_empty() {
                    line.impulse = rows[index].impulse;
                }
                push(&mut self.bodies, line, line.impulse);
            }
        }
    }

    /// Mixes the solutions of an island that would gain energy: u = u_without + s (u_with − u_without), with Σ m u² = what
    /// is allowed; impulses by that share s too.
    fn take_means(&mut self, model: &Model) {
        for gain in self.gains.iter().filter(|gain| !gain.u.is_empty()) {
            let (mut without, mut mixed, mut change) = (0.0, 0.0, 0.0);
            for (&body, &with) in gain.island.bodies.iter().zip(&gain.u) {
                let (m, u) = (model.masses[body], self.bodies[body].u);
                without += m * u.length_squared();
                mixed += m * u.dot(with - u);
                change += m * (with - u).length_squared();
            }
            let room = (gain.allowed - without).max(0.0);
            let share = (((mixed * mixed + change * room).sqrt() - mixed) / change).clamp(0.0, 1.0);
            // 0 / 0 where both are the same.
            let share = if share.is_nan() { 0.0 } else { share };
            for (&body, &with) in gain.island.bodies.iter().zip(&gain.u) {
                let u = &mut self.bodies[body].u;
                *u += (with - *u) * share;
            }
            for (&index, &with) in gain.island.contacts.iter().zip(&gain.impulses) {
                let impulse = &mut self.lines[index].impulse;
                *impulse += (with - *impulse) * share;
            }
        }
    }

    /// The bodies that each row connects.
    fn links(&self) -> Vec<(usize, Option<usize>)> {
        self.lines.iter().map(|line| (line.a as usize, other(line))).collect()
    }

    /// Solves those unsettled islands directly that are small enough and `wanted`, by themselves and their ratio of masses.
    fn solve_directly(
        &mut self,
        model: &Model,
        free: &[DVec3],
        most_rows: usize,
        wanted: impl Fn(&Island, f64) -> bool,
    ) {
        for island in islands(&self.links()) {
            let masses = island.bodies.iter().map(|&body| model.masses[body]);
            let (least, most) = masses.fold((f64::INFINITY, 0.0_f64), |(l, m), mass| (l.min(mass), m.max(mass)));
            let settled = self.lines[island.contacts[0]].settled;
            if settled || island.contacts.len() > most_rows || !wanted(&island, most / least) {
                continue;
            }
            let rows: Vec<_> = island.contacts.iter().map(|&index| row(&self.lines[index])).collect();
            let guess: Vec<f64> = island.contacts.iter().map(|&index| self.lines[index].impulse).collect();
            let solution = support::solve(&model.inverse_masses, free, &rows, &guess);
            for (&index, &impulse) in island.contacts.iter().zip(&solution.multipliers) {
                self.lines[index].impulse = impulse;
                self.lines[index].settled = true;
            }
            for (&body, &u) in solution.bodies.iter().zip(&solution.vectors) {
                self.bodies[body].u = u;
            }
            self.solved += solution.reports.iter().map(|report| (report.contacts * report.passes) as u64).sum::<u64>();
        }
    }

    /// Velocity u of a sphere, m/s.
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
    Line { a: a as u32, b, normal, offset, weight, slack, impulse, settled: false }
}

fn other(line: &Line) -> Option<usize> {
    (line.b != WALL).then_some(line.b as usize)
}

/// A row as the direct solver takes it.
fn row(line: &Line) -> support::Row {
    support::Row { a: line.a as usize, b: other(line), normal: line.normal, offset: line.offset }
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
