//! Whether the cells still fit, asked after so much counted work: a cloud that spreads gets wider cubes, one that gathers
//! narrower ones, and a sphere that has crossed empty cubes for long is taken out of them.
//!
//! A sphere in no cube is looked at by all and looks at all, and never crosses anything: a look at everybody, once, in
//! place of crossings without end. It comes back when something happens to it. What decides is the work of either way,
//! so that neither costs much more than the other would have; no unit enters, and no clock.

use glam::DVec3;

use super::cells::layout::{bounds, widest_in_table};
use super::cells::{CellRef, Cells, Layout};
use crate::physics::events::detector::Detector;
use crate::physics::events::engine::EventDriven;
use crate::physics::events::trajectories::Record;
use crate::physics::model::Model;

/// Crossings per sphere after which the spheres are seated anew: they have gone some cubes from their seats by then.
const CROSSINGS: u64 = 3;

/// Looks at a pair per sphere after which it is asked whether smaller cubes would spare some.
const PAIRS: u64 = 256;

/// A crossing costs about as much as this many looks at a pair, with those it takes.
const CROSSING: f64 = 32.0;

/// Work since the last review.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wear {
    crossings: u64,
    /// Looks at a pair since it was last asked whether they are too many.
    pairs: u64,
    /// Looks around that were not for a crossing.
    looks: u64,
    /// When the last review was, s.
    since: f64,
    /// So many are too many: crossings, pairs.
    most: [u64; 2],
}

impl Wear {
    /// None, among so many spheres at time `t`, s.
    pub(crate) fn new(spheres: usize, t: f64) -> Wear {
        Wear { crossings: 0, pairs: 0, looks: 0, since: t, most: [CROSSINGS, PAIRS].map(|each| each * spheres as u64) }
    }

    /// A sphere crossed into a cube and looked at so many.
    #[inline(always)]
    pub(crate) fn cross(&mut self, pairs: u64) {
        self.crossings += 1;
        self.pairs += pairs;
    }

    /// A sphere looked around, at so many.
    #[inline(always)]
    pub(crate) fn look(&mut self, pairs: u64) {
        self.looks += 1;
        self.pairs += pairs;
    }

    /// Whether it is time to ask.
    #[inline(always)]
    pub(crate) fn is_worn(&self) -> bool {
        self.has_many_crossings() | (self.pairs > self.most[1])
    }

    #[inline(always)]
    fn has_many_crossings(&self) -> bool {
        self.crossings > self.most[0]
    }
}

impl<D: Detector> EventDriven<D> {
    /// Asks whether the cells still fit, changes them if they do not, and seats the spheres anew after many crossings.
    pub(crate) fn review(&mut self, model: &Model) {
        self.wear.pairs = 0;
        if self.cells.is_none() {
            return;
        }
        if self.do_cells_misfit() {
            let before = self.cells.as_ref().map(|cells| cells.layout());
            let layout = self.best_layout();
            if before.is_none_or(|before| before.differs(&layout)) {
                self.enter_cubes(model, layout);
                (0..model.len()).for_each(|i| self.predict(model, i));
                self.wear = Wear::new(model.len(), self.now);
                return;
            }
        }
        if self.wear.has_many_crossings() {
            self.sort_out_loose(model);
            self.reseat();
            self.wear = Wear::new(model.len(), self.now);
        }
    }

    /// Lays out cells for the spheres as they are, and seats the spheres; nothing is predicted.
    pub(crate) fn lay_out(&mut self, model: &Model) {
        let layout = self.best_layout();
        self.enter_cubes(model, layout);
    }

    fn enter_cubes(&mut self, model: &Model, layout: Layout) {
        let cells = Cells::new(model, layout);
        for seat in 0..self.flight.records.len() {
            let record = &self.flight.records[seat];
            let out = record.line.r > cells.widest() || self.roams(model, record, cells.edge(), 1.0);
            let spot = if out { CellRef::LOOSE } else { cells.spot(self.flight.path_from(seat, self.now).x) };
            self.flight.records[seat].spot = spot;
        }
        self.cells = Some(Box::new(cells));
        self.reseat();
    }

    /// Where the spheres in cubes are, m; where all are if none is in a cube.
    fn places(&self) -> Vec<DVec3> {
        let at = |seat: usize| self.flight.path_from(seat, self.now).x;
        let records = &self.flight.records;
        let kept: Vec<DVec3> = (0..records.len()).filter(|&seat| !records[seat].spot.is_loose()).map(at).collect();
        if kept.is_empty() { (0..records.len()).map(at).collect() } else { kept }
    }

    /// Whether it looks as if other cells would spare work.
    fn do_cells_misfit(&self) -> bool {
        let Some(cells) = &self.cells else { return false };
        let x = self.places();
        cells.is_crowded(x.len()) || cells.layout().is_outgrown(&x, bounds(&x).size())
    }

    fn best_layout(&self) -> Layout {
        let x = self.places();
        let radii: Vec<f64> = self.flight.records.iter().map(|record| record.line.r).collect();
        Layout::new(&x, widest_in_table(&x, &radii))
    }

    /// Whether a sphere has crossed, or would have, so many cubes of this edge (m) since its motion last changed that
    /// looking at everybody and being looked at by all is no more work; `times` that many.
    fn roams(&self, model: &Model, record: &Record, edge: f64, times: f64) -> bool {
        let (alone, span) = (self.now - record.line.t, self.now - self.wear.since);
        if alone <= 0.0 || span <= 0.0 {
            return false;
        }
        let v = record.line.path(self.flight.acceleration(record.sphere as usize), self.now).v;
        let crossings = (v * (alone / edge)).abs().element_sum();
        let everybody = (model.len() + model.faces.len()) as f64;
        // looks around by others while it was alone
        let others = self.wear.looks as f64 * (alone / span);
        crossings * CROSSING * times >= everybody + others
    }

    /// Takes spheres out of the cubes that roam, and enters those again that do no longer.
    fn sort_out_loose(&mut self, model: &Model) {
        for i in 0..model.len() {
            let seat = self.flight.seat(i);
            let (record, Some(cells)) = (&self.flight.records[seat], &self.cells) else { return };
            if record.line.r > cells.widest() {
                continue;
            }
            let is_out = record.spot.is_loose();
            // no sphere goes to and fro
            let out = self.roams(model, record, cells.edge(), if is_out { 4.0 } else { 1.0 });
            if out != is_out {
                let spot = if out { CellRef::LOOSE } else { cells.spot(self.flight.path_from(seat, self.now).x) };
                self.put(seat, spot);
                self.predict_at(model, seat);
            }
        }
    }

    /// A sphere in no cube is in one again as soon as something has happened to it.
    #[inline(always)]
    pub(crate) fn catch(&mut self, seat: usize) {
        let record = &self.flight.records[seat];
        if record.spot.is_loose() {
            self.catch_loose(seat);
        }
    }

    #[cold]
    fn catch_loose(&mut self, seat: usize) {
        let line = self.flight.records[seat].line;
        let Some(cells) = &self.cells else { return };
        if line.t == self.now && line.r <= cells.widest() {
            let spot = cells.spot(line.x);
            self.put(seat, spot);
        }
    }

    fn put(&mut self, seat: usize, spot: CellRef) {
        let seats = self.flight.records.len();
        let (record, Some(cells)) = (&mut self.flight.records[seat], &mut self.cells) else { return };
        cells.leave(seat, record.spot.place);
        cells.enter(seat, spot.place, seats);
        record.spot = spot;
    }
}
