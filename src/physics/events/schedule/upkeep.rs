//! Whether the cells still fit, asked after so much counted work: a cloud that spreads gets wider cells, one that gathers
//! narrower ones, and a sphere that has crossed empty cells for long is taken out of them.
//!
//! A sphere in no cell is looked at by all and looks at all, and never crosses anything: a look at all spheres, once, in
//! place of crossings without end. It comes back when something happens to it. What decides is the work of either way,
//! so that neither costs much more than the other would have; no unit enters, and no clock.

use glam::DVec3;

use super::cells::Cells;
use super::cells::layout::{Layout, bounds, widest_in_table};
use super::parts::Schedule;
use super::wear::Wear;
use crate::physics::events::detector::Detector;
use crate::physics::events::islands::resting::Rests;
use crate::physics::events::record::{CellRef, Record};
use crate::physics::events::trajectories::Trajectories;
use crate::physics::model::Model;

/// A crossing costs about as much as this many looks at a pair, with those it takes.
const CROSSING: f64 = 32.0;

/// A sphere that is out stays out if it has roamed this much less than takes one out: none goes to and fro.
const STAYS_OUT: f64 = 4.0;

impl<D: Detector> Schedule<D> {
    /// Asks whether the cells still fit, changes them if they do not, and seats the spheres anew after many crossings.
    pub(crate) fn review(&mut self, model: &Model, trajectories: &mut Trajectories, rests: &Rests) {
        self.wear.pairs = 0;
        let Some(cells) = &self.cells else { return };
        if misfits(cells, trajectories) {
            let layout = best_layout(trajectories);
            if cells.layout().differs(&layout) {
                self.fill_cells(model, trajectories, rests, layout);
                self.predict_all(model, trajectories, rests);
                self.wear = Wear::new(model.len(), trajectories.now);
                return;
            }
        }
        if self.wear.has_many_crossings() {
            self.sort_out_loose(model, trajectories, rests);
            self.reseat(trajectories, rests);
            self.wear = Wear::new(model.len(), trajectories.now);
        }
    }

    /// Lays out cells for the spheres as they are, and seats the spheres; nothing is predicted.
    pub(crate) fn lay_out(&mut self, model: &Model, trajectories: &mut Trajectories, rests: &Rests) {
        let layout = best_layout(trajectories);
        self.fill_cells(model, trajectories, rests, layout);
    }

    fn fill_cells(&mut self, model: &Model, trajectories: &mut Trajectories, rests: &Rests, layout: Layout) {
        let cells = Cells::new(model, layout);
        for seat in 0..trajectories.records.len() {
            let record = &trajectories.records[seat];
            let out = record.line.r > cells.widest() || self.roams(model, trajectories, record, cells.edge(), 1.0);
            let spot = if out { CellRef::LOOSE } else { cells.spot(trajectories.path_from(seat).x) };
            trajectories.records[seat].spot = spot;
        }
        self.cells = Some(Box::new(cells));
        self.reseat(trajectories, rests);
    }

    /// Whether a sphere has crossed, or would have, so many cells of this edge (m) since its motion last changed that looking at all
    /// spheres once and being looked at by all is no more work; `times` that many.
    fn roams(&self, model: &Model, trajectories: &Trajectories, record: &Record, edge: f64, times: f64) -> bool {
        let now = trajectories.now;
        let (alone, span) = (now - record.line.t, now - self.wear.since);
        if alone <= 0.0 || span <= 0.0 {
            return false;
        }
        let v = record.line.path(trajectories.acceleration(record.sphere as usize), now).v;
        let crossings = (v * (alone / edge)).abs().element_sum();
        let all = (model.len() + model.faces.len()) as f64;
        // looks around by others while it was alone
        let others = self.wear.looks as f64 * (alone / span);
        crossings * CROSSING * times >= all + others
    }

    /// Takes spheres out of the cells that roam, and enters those again that do no longer.
    fn sort_out_loose(&mut self, model: &Model, trajectories: &mut Trajectories, rests: &Rests) {
        for i in 0..model.len() {
            let seat = trajectories.seat(i);
            let (record, Some(cells)) = (&trajectories.records[seat], &self.cells) else { return };
            if record.line.r > cells.widest() {
                continue;
            }
            let is_out = record.spot.is_loose();
            let times = if is_out { STAYS_OUT } else { 1.0 };
            let out = self.roams(model, trajectories, record, cells.edge(), times);
            if out != is_out {
                let spot = if out { CellRef::LOOSE } else { cells.spot(trajectories.path_from(seat).x) };
                self.put(trajectories, seat, spot);
                self.predict(model, trajectories, rests, seat);
            }
        }
    }

    /// A sphere in no cell is in one again as soon as something has happened to it.
    #[inline(always)]
    pub(super) fn catch(&mut self, trajectories: &mut Trajectories, seat: usize) {
        if trajectories.records[seat].spot.is_loose() {
            self.catch_loose(trajectories, seat);
        }
    }

    #[cold]
    fn catch_loose(&mut self, trajectories: &mut Trajectories, seat: usize) {
        let line = trajectories.records[seat].line;
        let Some(cells) = &self.cells else { return };
        if line.t == trajectories.now && line.r <= cells.widest() {
            let spot = cells.spot(line.x);
            self.put(trajectories, seat, spot);
        }
    }

    fn put(&mut self, trajectories: &mut Trajectories, seat: usize, spot: CellRef) {
        let seats = trajectories.records.len();
        let (record, Some(cells)) = (&mut trajectories.records[seat], &mut self.cells) else { return };
        cells.leave(seat, record.spot.place);
        cells.enter(seat, spot.place, seats);
        record.spot = spot;
    }
}

/// Where the spheres in cells are, m; where all are if none is in a cell.
fn positions(trajectories: &Trajectories) -> Vec<DVec3> {
    let at = |seat: usize| trajectories.path_from(seat).x;
    let records = &trajectories.records;
    let kept: Vec<DVec3> = (0..records.len()).filter(|&seat| !records[seat].spot.is_loose()).map(at).collect();
    if kept.is_empty() { (0..records.len()).map(at).collect() } else { kept }
}

/// Whether it looks as if other cells would spare work.
fn misfits(cells: &Cells, trajectories: &Trajectories) -> bool {
    let x = positions(trajectories);
    cells.is_crowded(x.len()) || cells.layout().is_outgrown(&x, bounds(&x).size())
}

fn best_layout(trajectories: &Trajectories) -> Layout {
    let x = positions(trajectories);
    let radii: Vec<f64> = trajectories.records.iter().map(|record| record.line.r).collect();
    Layout::new(&x, widest_in_table(&x, &radii))
}
