//! What happens next to one sphere: its earliest contact, its way out of its cell, the end of its island's parabola.

use super::candidates::Candidates;
use super::cells::Cells;
use super::entry::{event_order, event_time};
use super::parts::Schedule;
use super::search::Search;
use super::simd::Simd;
use crate::physics::events::detector::Detector;
use crate::physics::events::islands::resting::Rests;
use crate::physics::events::record::{CellRef, Exit, Plan};
use crate::physics::events::trajectories::Trajectories;
use crate::physics::model::Model;

impl<D: Detector> Schedule<D> {
    /// Predicts the sphere at a seat afresh from the present on.
    pub(crate) fn predict(&mut self, model: &Model, trajectories: &mut Trajectories, rests: &Rests, seat: usize) {
        self.make_plan(model, trajectories, rests, seat);
        self.enter(trajectories, rests, seat);
    }

    /// Predicts the sphere whose event is being handled, at this seat; call last, everything else being predicted: then it
    /// is known what comes next.
    pub(crate) fn predict_due(&mut self, model: &Model, trajectories: &mut Trajectories, rests: &Rests, seat: usize) {
        self.make_plan(model, trajectories, rests, seat);
        self.enter_due(trajectories, rests, seat);
    }

    /// Predicts all spheres afresh, by index.
    pub(crate) fn predict_all(&mut self, model: &Model, trajectories: &mut Trajectories, rests: &Rests) {
        for i in 0..model.len() {
            self.predict(model, trajectories, rests, trajectories.seat(i));
        }
    }

    fn make_plan(&mut self, model: &Model, trajectories: &mut Trajectories, rests: &Rests, seat: usize) {
        self.catch(trajectories, seat);
        let Schedule { detector, cells, candidates, simd, .. } = self;
        let search = Search::new(model, trajectories, rests, (detector, *simd), seat);
        let mut plan = Plan::IDLE;
        let count = match cells {
            Some(cells) => search.in_cells(cells, trajectories.records[seat].spot, None, (candidates, &mut plan)),
            None => {
                let others = (0..model.len()).filter(|&other| other != seat);
                search.walls(0..model.faces.len(), &mut plan)
                    + others.map(|other| search.pair(other, &mut plan)).sum::<u64>()
            }
        };
        self.evaluations += count;
        self.wear.look(count);
        trajectories.records[seat].plan = plan;
    }

    /// The sphere at a seat, whose event this is, goes into the next cell: what it was to meet stays, the nine cells ahead
    /// and their walls are new.
    pub(crate) fn cross(&mut self, model: &Model, trajectories: &mut Trajectories, rests: &Rests, seat: usize) {
        let seats = trajectories.records.len();
        let Schedule { detector, cells, candidates, simd, .. } = self;
        let cells = cells.as_mut().expect("a crossing is planned where there are cells");
        let record = &mut trajectories.records[seat];
        let mut plan = record.plan;
        record.spot = cells.cross(seat, record.spot, plan.way, seats);
        let (spot, way) = (record.spot, plan.way);
        let search = Search::new(model, trajectories, rests, (detector, *simd), seat);
        let count = search.in_cells(cells, spot, Some(way), (candidates, &mut plan));
        self.evaluations += count;
        self.wear.cross(count);
        trajectories.records[seat].plan = plan;
        self.enter_due(trajectories, rests, seat);
    }

    /// Enters the earliest of a sphere's plan and its island's end into the queue.
    pub(crate) fn enter(&mut self, trajectories: &Trajectories, rests: &Rests, seat: usize) {
        let due = event_time(trajectories, rests, seat);
        self.queue.set(seat, due);
        self.next = None;
        self.enter_tie(trajectories, rests, due, seat);
    }

    /// Enters the next event of the seat whose event is being handled, everything else being entered already: then it is
    /// known what comes next.
    #[inline]
    fn enter_due(&mut self, trajectories: &Trajectories, rests: &Rests, seat: usize) {
        let due = event_time(trajectories, rests, seat);
        self.next = self.queue.replace_first(seat, due);
        self.enter_tie(trajectories, rests, due, seat);
    }

    #[inline(always)]
    fn enter_tie(&mut self, trajectories: &Trajectories, rests: &Rests, time: f64, seat: usize) {
        if self.ties.are_at(time) {
            self.ties.enter(seat, event_order(trajectories, rests, time, seat));
        }
    }
}

impl<'a, D: Detector> Search<'a, D> {
    /// The search of the sphere at a seat.
    #[inline(always)]
    fn new(
        model: &'a Model,
        trajectories: &'a Trajectories,
        rests: &'a Rests,
        (detector, simd): (&'a D, Simd),
        seat: usize,
    ) -> Search<'a, D> {
        let until = rests.end_of(trajectories.sphere(seat)).next_up();
        Search { model, trajectories, rests, detector, simd, seat, path: trajectories.path_from(seat), until }
    }

    /// Looks at the spheres around the sphere's cell and at the walls near it, or only at those that came within reach when
    /// it went `way`; and when it will leave its cell. Returns how many it looked at.
    fn in_cells(
        &self,
        cells: &Cells,
        spot: CellRef,
        way: Option<Exit>,
        (candidates, plan): (&mut Candidates, &mut Plan),
    ) -> u64 {
        cells.look(spot, way, candidates, self.trajectories.records.len());
        // what it is to meet soon of what is cheap to look at spares the rest a long search
        let mut count = if D::PAIRS_FIRST { self.pairs(candidates, plan) } else { 0 };
        if spot.is_loose() {
            count += self.walls(0..self.model.faces.len(), plan);
        } else {
            let (crossing, way) = cells.crossing(spot.cube, &self.path);
            (plan.crossing, plan.way) = (self.trajectories.now + crossing, way);
            let walls = cells.walls_near(spot).iter().map(|&wall| wall as usize);
            count += self.walls(walls, plan);
        }
        if !D::PAIRS_FIRST {
            count += self.pairs(candidates, plan);
        }
        count
    }
}
