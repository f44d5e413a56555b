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

/// Cost of a crossing in looks at a pair, those that it takes included.
const CROSSING: f64 = 32.0;

/// Factor by which less roaming keeps a sphere out of the cells than takes one out: none goes to and fro.
const STAYS_OUT: f64 = 4.0;

/// Why a schedule that takes spheres out of its cells has them.
const CELLS: &str = "a sphere is taken out of cells only where there are some";

impl<D: Detector> Schedule<D> {
    /// Asks whether the cells still fit, changes them if they do not, and reorders the records after many crossings.
    #[cold]
    #[inline(never)]
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
            self.order_by_cells(trajectories, rests);
            self.wear = Wear::new(model.len(), trajectories.now);
        }
    }

    /// Lays out cells for the spheres as they are, and orders the records by them; nothing is predicted.
    pub(crate) fn lay_out(&mut self, model: &Model, trajectories: &mut Trajectories, rests: &Rests) {
        let layout = best_layout(trajectories);
        self.fill_cells(model, trajectories, rests, layout);
    }

    fn fill_cells(&mut self, model: &Model, trajectories: &mut Trajectories, rests: &Rests, layout: Layout) {
        let cells = Cells::new(model, layout);
        for slot in 0..trajectories.records.len() {
            let record = &trajectories.records[slot];
            let out =
                record.trajectory.r > cells.widest() || self.roams(model, trajectories, record, cells.edge(), 1.0);
            let cell = if out { CellRef::LOOSE } else { cells.cell_of(trajectories.path_from(slot).x) };
            trajectories.records[slot].cell = cell;
        }
        self.cells = Some(Box::new(cells));
        self.order_by_cells(trajectories, rests);
    }

    /// Whether a sphere has crossed, or would have, so many cells of this edge (m) since its motion last changed that
    /// looking at all spheres once and being looked at by all is no more work; `times` that many.
    fn roams(&self, model: &Model, trajectories: &Trajectories, record: &Record, edge: f64, times: f64) -> bool {
        let now = trajectories.now;
        let (alone, span) = (now - record.trajectory.t, now - self.wear.since);
        if alone <= 0.0 || span <= 0.0 {
            return false;
        }
        let v = record.trajectory.path(trajectories.acceleration(record.sphere as usize), now).v;
        let crossings = (v * (alone / edge)).abs().element_sum();
        let all = (model.len() + model.faces.len()) as f64;
        // looks around by others while it was alone
        let others = self.wear.looks as f64 * (alone / span);
        crossings * CROSSING * times >= all + others
    }

    /// Takes spheres out of the cells that roam, and enters those again that do no longer.
    fn sort_out_loose(&mut self, model: &Model, trajectories: &mut Trajectories, rests: &Rests) {
        for i in 0..model.len() {
            let slot = trajectories.slot(i);
            let (record, cells) = (&trajectories.records[slot], self.cells.as_ref().expect(CELLS));
            if record.trajectory.r > cells.widest() {
                continue;
            }
            let is_out = record.cell.is_loose();
            let times = if is_out { STAYS_OUT } else { 1.0 };
            let out = self.roams(model, trajectories, record, cells.edge(), times);
            if out != is_out {
                let cell = if out { CellRef::LOOSE } else { cells.cell_of(trajectories.path_from(slot).x) };
                self.put(trajectories, slot, cell);
                self.predict(model, trajectories, rests, slot);
            }
        }
    }

    /// Enters a sphere in no cell again, since something has happened to it.
    #[inline(always)]
    pub(super) fn catch(&mut self, trajectories: &mut Trajectories, slot: usize) {
        if trajectories.records[slot].cell.is_loose() {
            self.catch_loose(trajectories, slot);
        }
    }

    #[cold]
    fn catch_loose(&mut self, trajectories: &mut Trajectories, slot: usize) {
        let line = trajectories.records[slot].trajectory;
        let cells = self.cells.as_ref().expect(CELLS);
        if line.t == trajectories.now && line.r <= cells.widest() {
            let cell = cells.cell_of(line.x);
            self.put(trajectories, slot, cell);
        }
    }

    fn put(&mut self, trajectories: &mut Trajectories, slot: usize, cell: CellRef) {
        let slots = trajectories.records.len();
        let (record, cells) = (&mut trajectories.records[slot], self.cells.as_mut().expect(CELLS));
        cells.leave(slot, record.cell.index);
        cells.enter(slot, cell.index, slots);
        record.cell = cell;
    }
}

/// Where the spheres in cells are, m; where all are if none is in a cell.
fn positions(trajectories: &Trajectories) -> Vec<DVec3> {
    let at = |slot: usize| trajectories.path_from(slot).x;
    let records = &trajectories.records;
    let kept: Vec<DVec3> = (0..records.len()).filter(|&slot| !records[slot].cell.is_loose()).map(at).collect();
    if kept.is_empty() { (0..records.len()).map(at).collect() } else { kept }
}

/// Whether it looks as if other cells would spare work.
fn misfits(cells: &Cells, trajectories: &Trajectories) -> bool {
    let x = positions(trajectories);
    cells.is_crowded(x.len()) || cells.layout().is_outgrown(&x, bounds(&x).size())
}

fn best_layout(trajectories: &Trajectories) -> Layout {
    let x = positions(trajectories);
    let radii: Vec<f64> = trajectories.records.iter().map(|record| record.trajectory.r).collect();
    Layout::new(&x, widest_in_table(&x, &radii))
}
