//! One frame, stage by stage: open, search, meet, solve, look again, close.

use std::ops::Range;

use glam::DVec3;

use super::contact_row::{Allowance, FramePath, Meeting, Row, Speeds, TOUCHING, Terms};
use super::run::{Carried, FrameStage, Moreau};
use crate::physics::contact::{Class, Contact, Key, Kind};
use crate::physics::frame_contact::FrameContact;
use crate::physics::free_flight::{Flight, with_flight};
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::state::Stall;
use crate::physics::wall::Face;
use crate::physics::{impact_law, wall};

/// Times that new rows are looked for in a frame. Each round, some sphere reaches one more that it did not before: a
/// wave through as many spheres. Then the frame closes as it is, and counts as not converged.
const MOST_ROUNDS: usize = 64;

/// Rows made or looked for again between two looks at the budget.
const CHUNK: usize = 4096;

impl Moreau {
    /// Goes on with the frame in progress, or opens one; the work that took.
    ///
    /// # Errors
    /// Why there can be no such frame.
    pub(super) fn go_on(&mut self, model: &Model, log: &mut Log) -> Result<u64, Stall> {
        match self.stage {
            FrameStage::Between => self.open(model),
            FrameStage::Search { round } => {
                let (done, work) = self.search.go_on(model, &self.end.x);
                log.tallies.evaluations += work;
                if self.search.overflows() {
                    self.stage = FrameStage::Between;
                    return Err(self.crowded(model));
                }
                if done {
                    self.stage = FrameStage::Meet { round, from: 0, known: self.rows.len() };
                }
                Ok(work)
            }
            FrameStage::Meet { round, from, known } => {
                let to = self.search.found.len().min(from + CHUNK);
                self.meet(model, round, from..to, known);
                log.tallies.evaluations += (to - from) as u64;
                self.stage = FrameStage::Meet { round, from: to, known };
                if to == self.search.found.len() {
                    self.end_round(model, log, round, known)?;
                }
                Ok(2 * (to - from) as u64)
            }
            FrameStage::Solve { round } => {
                let (done, work) = self.solver.go_on(model, &self.free, &self.end.v, &self.rows);
                if done {
                    self.solver.read_impulses(&mut self.rows);
                    if self.give_back_rubbed() {
                        self.solver.begin(model, &self.free, &self.rows);
                    } else {
                        self.look_again(model, round + 1);
                    }
                }
                Ok(work)
            }
        }
    }

    /// Sets out for the next frame: free velocities u₀ = v + h a, and how far each sphere may go.
    fn open(&mut self, model: &Model) -> Result<u64, Stall> {
        let h = self.settings.dt;
        if self.end.t + h == self.end.t {
            return Err(Stall::step_too_small(self.end.t, self.settings.dt));
        }
        with_flight!(model, flight => self.fall(flight, h));
        self.solution.clone_from(&self.free);
        self.rows.clear();
        self.sunk.fill(0.0);
        self.solver.forget();
        let (free, v) = (&self.free, &self.end.v);
        let speed = |i: usize| free[i].length_squared().max(v[i].length_squared()).sqrt();
        self.search.begin((0..model.len()).map(|i| reach(model, i, speed(i), h)));
        self.stage = FrameStage::Search { round: 0 };
        Ok(model.len() as u64)
    }

    fn fall(&mut self, flight: impl Flight, h: f64) {
        for (i, (free, v)) in self.free.iter_mut().zip(&self.end.v).enumerate() {
            *free = flight.velocity(*v, i, h);
        }
    }

    /// Makes rows of those candidates that meet on the paths known so far and are no rows yet.
    fn meet(&mut self, model: &Model, round: usize, range: Range<usize>, known: usize) {
        let Some(&first) = self.search.found.get(range.start) else { return };
        let terms = Terms::of(model, &self.settings);
        let mut held = self.carried.partition_point(|held| held.0 < first);
        let mut row = self.rows[..known].partition_point(|row| row.key < first);
        for k in range {
            let key = self.search.found[k];
            held += self.carried[held..].iter().take_while(|held| held.0 < key).count();
            row += self.rows[row..known].iter().take_while(|row| row.key < key).count();
            if row == known || self.rows[row].key != key {
                let carried = self.carried.get(held).filter(|held| held.0 == key).map_or(0.0, |held| held.1);
                self.propose(model, key, round, carried, &terms);
            }
        }
    }

    /// Makes a row of two bodies if they meet.
    fn propose(&mut self, model: &Model, key: Key, round: usize, carried: f64, terms: &Terms) {
        let path = FramePath::of(model, key, &self.end.x, &self.solution, terms.h);
        let near = terms.near(model, key);
        let at_once = (round == 0).then_some(near);
        let found = match key.0 {
            Kind::Pair => path.meeting(at_once.unwrap_or(0.0)),
            Kind::Wall => {
                let still = terms.still(model, key);
                let (left, more) = (self.depth(model, key.1).min(still), self.sunk[key.1].min(still));
                path.wall_meeting(at_once, Allowance { left, more })
            }
        };
        let Some(meeting) = found else { return };
        let closing = -meeting.normal.dot(path.velocity);
        let meets = meeting.time < f64::INFINITY && closing * terms.h >= meeting.way;
        // What is reached only because something was struck in this frame collides at the speed it has by then; not what
        // it is pulled into by what accelerates it, before all that holds it is known.
        let before = -meeting.normal.dot(FramePath::of(model, key, &self.end.x, &self.end.v, terms.h).velocity);
        let pulled = terms.pulled(model, key) + model.law.rest_speed;
        let approach = if round == 0 || closing <= pulled { before } else { before.max(closing) };
        // What has parted since, by more than others may push it together again, is held no longer.
        let held = (carried > 0.0 && meeting.way <= near) || self.was_held_level_with(&path, &meeting, near);
        let struck = meets && !held && approach > model.law.rest_speed;
        self.rows.push(Row::new(&path, meeting, Speeds { approach, closing, struck }, carried, terms));
    }

    /// Whether what held a sphere in the last frame, and is no farther than `near` (m) from it still, is a wall in the
    /// plane in which it meets this one: a sphere that goes on from tile to tile strikes the next one no more than the
    /// first one over again.
    fn was_held_level_with(&self, path: &FramePath, meeting: &Meeting, near: f64) -> bool {
        let (kind, a, _) = path.key;
        let holds = |face: &Face| wall::touch(face, path.from, path.size()).gap <= near;
        let mut walls = self.walls_that_held(a).map(|wall| &path.model.faces[wall]);
        kind == Kind::Wall && walls.any(|face| path.meets_in_plane_of(face, meeting) && holds(face))
    }

    /// The walls that held a sphere in the last frame.
    fn walls_that_held(&self, sphere: usize) -> impl Iterator<Item = usize> {
        let first = self.carried.partition_point(|held| held.0 < (Kind::Wall, sphere, 0));
        let of_sphere = move |held: &&Carried| held.0.0 == Kind::Wall && held.0.1 == sphere;
        self.carried[first..].iter().take_while(of_sphere).map(|held| held.0.2)
    }

    /// How deep a sphere is in the walls that held it in the last frame, m: what the solver has left.
    fn depth(&self, model: &Model, sphere: usize) -> f64 {
        let (x, r) = (self.end.x[sphere], model.radii[sphere]);
        let gap = |wall: usize| wall::touch(&model.faces[wall], x, r).gap;
        self.walls_that_held(sphere).map(|wall| -gap(wall)).fold(0.0, f64::max)
    }

    /// Keeps, of the walls that a sphere has been found to meet in this round, those that hold it already and the first
    /// that it strikes, unless one holds it: whether it strikes the others too is seen on the path that these leave it.
    /// So walls that share a point (seams, doubled walls) strike once. What strikes takes its share of the tangential
    /// velocity.
    fn keep_first_strikes(&mut self, model: &Model, known: usize) {
        let mut keep = Vec::with_capacity(self.rows.len() - known);
        for group in
            self.rows[known..].chunk_by(|a, b| a.key.0 == Kind::Wall && b.key.0 == Kind::Wall && a.key.1 == b.key.1)
        {
            let earliest =
                group.iter().reduce(|best, row| if row.comes_before(best) { row } else { best }).map(|row| row.key);
            let kept = |row: &Row| {
                let stood_for = || group.iter().any(|other| other.holds() && other.stands_for(row));
                row.key.0 == Kind::Pair || ((row.holds() || earliest == Some(row.key)) && !stood_for())
            };
            keep.extend(group.iter().map(kept));
        }
        self.bridge_cracks(known, &keep);
        let mut keep = keep.into_iter();
        let mut index = 0;
        self.rows.retain(|_| {
            index += 1;
            index <= known || keep.next() == Some(true)
        });
        for row in &mut self.rows[known..] {
            if row.class == Class::Collide && row.key.0 == Kind::Wall {
                let (free, n) = (&mut self.free[row.key.1], row.normal);
                row.rubbed = (*free - n * n.dot(*free)) * (model.law.tangential - 1.0);
                *free += row.rubbed;
            }
        }
    }

    /// Gives back what walls have taken that would have been struck, had others not kept the sphere from it: no impulse, no
    /// loss along the wall. Whether there was any; the rows are to be solved again then.
    fn give_back_rubbed(&mut self) -> bool {
        let mut any = false;
        for row in self.rows.iter_mut().filter(|row| row.impulse == 0.0 && row.rubbed != DVec3::ZERO) {
            self.free[row.key.1] -= std::mem::take(&mut row.rubbed);
            any = true;
        }
        any
    }

    /// Edges that a sphere touches at one point carry it, or are struck, together: over the middle of a crack it feels no
    /// side. The row that is kept of them takes the mean of their normals, which differs from each by less than shows in
    /// a gap.
    fn bridge_cracks(&mut self, known: usize, keep: &[bool]) {
        for k in (known..self.rows.len()).filter(|k| keep[k - known]) {
            let row = self.rows[k];
            if row.key.0 == Kind::Pair || row.face {
                continue;
            }
            let (rows, a) = (&self.rows[known..], row.key.1);
            let at = |sphere: usize| rows.partition_point(|other| other.key < (Kind::Wall, sphere, 0));
            let others = rows[at(a)..at(a + 1)].iter().filter(|other| row.shares_crack_with(other));
            let (sum, count) = others.fold((DVec3::ZERO, 0), |(sum, count), other| (sum + other.normal, count + 1));
            if count > 1 {
                self.rows[k].normal = sum / sum.length();
            }
        }
    }

    /// Ends a round in which all candidates have been looked at: new rows are solved, with the others; without any the
    /// frame is complete.
    fn end_round(&mut self, model: &Model, log: &mut Log, round: usize, known: usize) -> Result<(), Stall> {
        let complete = self.rows.len() == known;
        if complete || round >= MOST_ROUNDS {
            return self.close(model, log, complete && self.solver.converged);
        }
        self.keep_first_strikes(model, known);
        self.rows.sort_unstable_by_key(|row| row.key);
        self.solver.begin(model, &self.free, &self.rows);
        self.stage = FrameStage::Solve { round };
        Ok(())
    }

    /// Sets out to search again, once the rows are solved, for the spheres that move farther than was looked for.
    fn look_again(&mut self, model: &Model, round: usize) {
        let h = self.settings.dt;
        let mut farther = false;
        for (i, solution) in self.solution.iter_mut().enumerate() {
            *solution = self.solver.velocity(i);
            let needed = reach(model, i, solution.length(), h);
            if needed > self.search.reach(i) {
                // Some more, or a growing wave would be searched for again and again.
                self.search.widen(i, reach(model, i, 1.5 * solution.length(), h));
                farther = true;
            }
        }
        if farther {
            self.search.restart();
        }
        self.note_sunk();
        let known = self.rows.len();
        self.stage = if farther { FrameStage::Search { round } } else { FrameStage::Meet { round, from: 0, known } };
    }

    /// Notes how far the solver leaves each sphere short of the planes of the walls that hold it, m.
    fn note_sunk(&mut self) {
        self.sunk.fill(0.0);
        for row in self.rows.iter().take_while(|row| row.key.0 == Kind::Wall) {
            let short = -(row.normal.dot(self.solution[row.key.1]) + row.offset);
            if row.impulse > 0.0 && short <= row.slack {
                let sunk = &mut self.sunk[row.key.1];
                *sunk = sunk.max(short * self.settings.dt);
            }
        }
    }

    /// Closes the frame: v⁺ = u, x⁺ = x + h u.
    fn close(&mut self, model: &Model, log: &mut Log, converged: bool) -> Result<(), Stall> {
        self.stage = FrameStage::Between;
        let h = self.settings.dt;
        if !converged {
            self.hold_back(model);
        }
        if let Some(stall) = self.runaway(&self.solution) {
            return Err(stall);
        }
        std::mem::swap(&mut self.start, &mut self.end);
        self.end.t = self.start.t + h;
        self.end.v.clone_from(&self.solution);
        self.end.x.clear();
        self.end.x.extend(self.start.x.iter().zip(&self.solution).map(|(x, u)| *x + *u * h));
        self.step = h;
        self.carried.clear();
        self.carried.extend(self.rows.iter().filter(|row| row.impulse > 0.0).map(|row| (row.key, row.impulse)));
        log.tallies.frames += 1;
        log.tallies.relaxations += self.solver.solved;
        log.tallies.unconverged += u64::from(!converged);
        self.tell(model, log);
        Ok(())
    }

    /// Stops spheres that would pass into walls deeper than the tolerance allows, for this frame.
    fn hold_back(&mut self, model: &Model) {
        let terms = Terms::of(model, &self.settings);
        for &key in self.search.found.iter().take_while(|key| key.0 == Kind::Wall) {
            let path = FramePath::of(model, key, &self.end.x, &self.solution, terms.h);
            let left = terms.still(model, key);
            let entered = path.wall_meeting(None, Allowance { left, more: left });
            if entered.is_some() {
                self.solution[key.1] = DVec3::ZERO;
            }
        }
    }

    /// Tells the contacts and events of the frame that has just ended: what collided, what rests, what does not rest any
    /// more.
    fn tell(&mut self, model: &Model, log: &mut Log) {
        log.contacts.clear();
        log.probes.clear();
        for row in &self.rows {
            let resting = row.impulse == 0.0 && log.resting.binary_search(&row.key).is_ok();
            if row.impulse == 0.0 && !resting {
                continue;
            }
            let contact = self.contact(model, row);
            log.tallies.deepest_degree = log.tallies.deepest_degree.max(contact.degree);
            // A contact that carries nothing rests on as long as it touches: others may carry its load for a while.
            let apart = -contact.degree * FramePath::of(model, row.key, &self.end.x, &self.end.v, self.step).size();
            if row.impulse > 0.0 || apart <= TOUCHING * model.radii[row.key.1] + row.slack * self.step {
                log.contacts.push(contact);
            }
            if contact.class == Class::Collide {
                log.event(contact);
            }
        }
        log.follow_rests(|key| self.release(model, key));
    }

    fn contact(&self, model: &Model, row: &Row) -> Contact {
        let (kind, a, b) = row.key;
        let FrameContact { contact, .. } = FrameContact::new(model, &self.start.x, &self.end, row.key);
        // an impulse acts where they meet within the frame; what rests is looked at where it is now
        let normal = if row.class == Class::Collide { row.normal } else { contact.normal };
        let other = |v: &[DVec3]| if kind == Kind::Pair { v[b] } else { DVec3::ZERO };
        Contact {
            normal,
            velocity: self.start.v[a] - other(&self.start.v),
            approach_speed: row.approach,
            separation_speed: impact_law::normal_velocity(self.end.v[a], other(&self.end.v), row.normal),
            impulse: row.impulse,
            class: row.class,
            ..contact
        }
    }
}

/// How far around its centre a sphere is looked, m: its radius, its way in a frame of length `h` (s) at `speed` (m/s),
/// and what near rows need.
fn reach(model: &Model, i: usize, speed: f64, h: f64) -> f64 {
    let near = h * (model.acceleration(i).length() * h + model.law.rest_speed);
    model.radii[i] * (1.0 + 1e-9) + speed * h + near
}
