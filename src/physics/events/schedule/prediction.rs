//! What happens next to one sphere: its earliest contact, its way out of its cell, the end of its island's parabola.

use super::candidates::Candidates;
use super::cells::Cells;
use super::entry::{event_order, event_time};
use super::parts::Schedule;
use super::search::Search;
use super::simd::Simd;
use crate::physics::contact::Kind;
use crate::physics::events::detector::Detector;
use crate::physics::events::islands::resting::Rests;
use crate::physics::events::record::{CellRef, Exit, Plan};
use crate::physics::events::trajectories::Trajectories;
use crate::physics::model::Model;

impl<D: Detector> Schedule<D> {
    /// Predicts the sphere at a slot afresh from the present on.
    #[inline(always)]
    pub(crate) fn predict(&mut self, model: &Model, trajectories: &mut Trajectories, rests: &Rests, slot: usize) {
        self.predict_after(model, trajectories, rests, (slot, &[]));
    }

    /// Predicts the sphere at a slot afresh, after other spheres (ascending) whose motion has changed with its own.
    #[inline(always)]
    pub(crate) fn predict_after(
        &mut self,
        model: &Model,
        trajectories: &mut Trajectories,
        rests: &Rests,
        (slot, done): (usize, &[usize]),
    ) {
        self.make_plan(model, trajectories, rests, (slot, done));
        self.enter(trajectories, rests, slot);
    }

    /// Predicts the sphere whose event is being handled, at this slot; call last, everything else being predicted: then it
    /// is known what comes next.
    #[inline(always)]
    pub(crate) fn predict_due(&mut self, model: &Model, trajectories: &mut Trajectories, rests: &Rests, slot: usize) {
        self.make_plan(model, trajectories, rests, (slot, &[]));
        self.enter_due(trajectories, rests, slot);
    }

    /// Predicts all spheres afresh, by index.
    pub(crate) fn predict_all(&mut self, model: &Model, trajectories: &mut Trajectories, rests: &Rests) {
        for i in 0..model.len() {
            self.predict(model, trajectories, rests, trajectories.slot(i));
        }
    }

    fn make_plan(
        &mut self,
        model: &Model,
        trajectories: &mut Trajectories,
        rests: &Rests,
        (slot, done): (usize, &[usize]),
    ) {
        self.catch(trajectories, slot);
        let Schedule { detector, cells, candidates, simd, .. } = self;
        let search = Search::new(model, trajectories, rests, (detector, *simd), (slot, done));
        let mut plan = trajectories.hopping.plan(trajectories.sphere(slot));
        let count = match cells {
            Some(cells) => search.in_cells(cells, trajectories.records[slot].cell, None, (candidates, &mut plan)),
            None => search.everywhere(&mut plan),
        };
        self.evaluations += count;
        self.wear.look(count);
        trajectories.records[slot].plan = plan;
    }

    /// Moves the sphere at a slot, whose event this is, into the next cell: what it was to meet stays, the nine cells ahead
    /// and their walls are new.
    pub(crate) fn cross(&mut self, model: &Model, trajectories: &mut Trajectories, rests: &Rests, slot: usize) {
        let slots = trajectories.records.len();
        let Schedule { detector, cells, candidates, simd, .. } = self;
        let cells = cells.as_mut().expect("a crossing is planned where there are cells");
        let record = &mut trajectories.records[slot];
        let mut plan = record.plan;
        record.cell = cells.cross(slot, record.cell, plan.exit, slots);
        let (cell, way) = (record.cell, plan.exit);
        let search = Search::new(model, trajectories, rests, (detector, *simd), (slot, &[]));
        let count = search.in_cells(cells, cell, Some(way), (candidates, &mut plan));
        self.evaluations += count;
        self.wear.cross(count);
        trajectories.records[slot].plan = plan;
        self.enter_due(trajectories, rests, slot);
    }

    /// Enters the earliest of a sphere's plan and its island's end into the queue.
    #[inline(always)]
    pub(crate) fn enter(&mut self, trajectories: &Trajectories, rests: &Rests, slot: usize) {
        let due = event_time(trajectories, rests, slot);
        self.queue.set(slot, due);
        self.next = None;
        self.enter_tie(trajectories, rests, due, slot);
    }

    /// Enters the next event of the slot whose event is being handled, everything else being entered already: then it is
    /// known what comes next.
    #[inline(always)]
    fn enter_due(&mut self, trajectories: &Trajectories, rests: &Rests, slot: usize) {
        let due = event_time(trajectories, rests, slot);
        self.next = self.queue.replace_first(slot, due);
        self.enter_tie(trajectories, rests, due, slot);
    }

    #[inline(always)]
    fn enter_tie(&mut self, trajectories: &Trajectories, rests: &Rests, time: f64, slot: usize) {
        if self.ties.are_at(time) {
            self.enter_among_ties(trajectories, rests, time, slot);
        }
    }

    // out of the way: the loop is short
    #[inline(never)]
    fn enter_among_ties(&mut self, trajectories: &Trajectories, rests: &Rests, time: f64, slot: usize) {
        self.ties.enter(slot, event_order(trajectories, rests, time, slot));
    }
}

impl<'a, D: Detector> Search<'a, D> {
    /// The search of the sphere at a slot.
    #[inline(always)]
    fn new(
        model: &'a Model,
        trajectories: &'a Trajectories,
        rests: &'a Rests,
        (detector, simd): (&'a D, Simd),
        (slot, done): (usize, &'a [usize]),
    ) -> Search<'a, D> {
        let path = trajectories.path_from(slot);
        // where nothing rests no parabola ends
        let (mut until, mut way) = (f64::INFINITY, f64::INFINITY);
        if !rests.is_empty() {
            until = rests.end_of(trajectories.sphere(slot)).next_up();
            if until < f64::INFINITY {
                way = path.way_until(until - trajectories.now);
            }
        }
        Search { model, trajectories, rests, detector, simd, slot, done, path, until, way }
    }

    /// Looks at all other spheres and all walls, first at those of the kind that the sphere was to meet last; returns how many.
    fn everywhere(&self, plan: &mut Plan) -> u64 {
        let pairs_first = D::PAIRS_FIRST && self.trajectories.records[self.slot].plan.kind == Kind::Pair;
        let walls = if pairs_first { 0 } else { self.all_walls(plan) };
        let others = (0..self.trajectories.records.len()).filter(|&other| other != self.slot);
        let pairs: u64 = others.map(|other| self.pair(other, plan)).sum();
        walls + pairs + if pairs_first { self.all_walls(plan) } else { 0 }
    }

    /// Looks at the spheres around the sphere's cell and at the walls near it, or only at those that came within reach when
    /// it went `way`; and when it will leave its cell. Returns how many it looked at.
    fn in_cells(
        &self,
        cells: &Cells,
        cell: CellRef,
        way: Option<Exit>,
        (candidates, plan): (&mut Candidates, &mut Plan),
    ) -> u64 {
        cells.look(cell, way, candidates, self.trajectories.records.len());
        // what it is to meet soon of what is cheap to look at spares the rest a long search, here as in `everywhere`
        let mut count = if D::PAIRS_FIRST { self.pairs(candidates, plan) } else { 0 };
        if cell.is_loose() {
            count += self.all_walls(plan);
        } else {
            let (crossing, way) = cells.crossing(cell.coordinates, &self.path);
            (plan.crossing, plan.exit) = (self.trajectories.now + crossing, way);
            let walls = cells.walls_near(cell).iter().map(|&wall| wall as usize);
            count += self.walls(walls, plan);
        }
        if !D::PAIRS_FIRST {
            count += self.pairs(candidates, plan);
        }
        count
    }
}
