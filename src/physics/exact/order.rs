//! Who sits where: neighbours side by side, so that what an event reads lies together.

use super::Exact;

/// Crossings per sphere after which the spheres are seated anew: they have gone some cubes from their seats by then.
const CROSSINGS: usize = 3;

impl Exact {
    /// Counts a crossing, and seats the spheres anew when there were many. No result depends on it.
    pub(super) fn count_crossing(&mut self) {
        self.crossings += 1;
        if self.crossings > CROSSINGS * self.flight.records.len() {
            self.reseat();
        }
    }

    /// Finds the cube of every sphere at the start, and seats the spheres.
    pub(super) fn enter_cubes(&mut self) {
        let Some(cells) = &self.cells else { return };
        for record in &mut self.flight.records {
            record.cube = cells.cube_of(record.line.x);
        }
        self.reseat();
    }

    /// Seats the spheres by their places in the table of cells, and fills it.
    pub(super) fn reseat(&mut self) {
        let Exact { cells: Some(cells), flight, .. } = self else { return };
        let key =
            |seat: usize| (cells.place(flight.records[seat].cube) as u32, flight.records[seat].sphere, seat as u32);
        let mut order: Vec<_> = (0..flight.records.len()).map(key).collect();
        order.sort_unstable();
        let order: Vec<u32> = order.into_iter().map(|(.., seat)| seat).collect();
        flight.reseat(&order);
        cells.fill(flight.records.iter().map(|record| record.cube));
        (self.crossings, self.next) = (0, None);
        for seat in 0..order.len() {
            self.schedule(seat);
        }
    }
}
