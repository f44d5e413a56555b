//! Who sits where: neighbours side by side, so that what an event reads lies together.

use super::cells::nearness;
use crate::physics::events::detector::Detector;
use crate::physics::events::engine::EventDriven;

impl<D: Detector> EventDriven<D> {
    /// Seats the spheres by their cubes.
    pub(crate) fn reseat(&mut self) {
        let flight = &self.flight;
        let key = |seat: usize| {
            let record = &flight.records[seat];
            (nearness(record.spot.cube), record.sphere, seat as u32)
        };
        let mut order: Vec<_> = (0..flight.records.len()).map(key).collect();
        order.sort_unstable();
        self.seat(&order.into_iter().map(|(.., seat)| seat).collect::<Vec<_>>());
    }

    /// Who sat at `order[s]` now sits at s.
    fn seat(&mut self, order: &[u32]) {
        self.flight.reseat(order);
        if let Some(cells) = &mut self.cells {
            cells.fill(self.flight.records.iter().map(|record| record.spot.place));
        }
        self.next = None;
        self.forget_ties();
        for seat in 0..order.len() {
            self.schedule(seat);
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::physics::exact::Exact;
    use crate::physics::log::Log;
    use crate::physics::method::{Engine, Progress, Until};
    use crate::physics::model::{Method, Model, Scene, Settings};

    /// A hundred spheres in a box, with walls that open no way out, crowded enough that most meet.
    fn gas() -> Scene {
        let text = "Scene(name: \"gas\", gravity: (0, -1, 0), \
            contact: (restitution: 1, tangential: 1, rest_speed: 0), \
            walls: [Room(min: (-1, -1, -1), max: (1, 1, 1))], \
            spheres: [Gas(min: (-1, -1, -1), max: (1, 1, 1), count: 100, seed: 3, speed: 1, mass: 1, radius: 0.1)])";
        crate::scene::parse(text, "gas").expect("a valid scene")
    }

    #[test]
    fn where_anybody_sits_changes_no_bit() {
        let model = Model::new(&gas());
        let settings = Settings { method: Method::Exact, dt: 0.01, tolerance: 1e-3 };
        let mut log = Log { recording: true, ..Log::default() };
        let mut still = Exact::begin(&model, settings, model.initial.clone(), &mut log);
        let (mut moved, mut moved_log) = (still.clone(), log.clone());
        for round in 0..200_u64 {
            assert_eq!(still.advance(&model, &mut log, Until::Time(f64::INFINITY), 50), Progress::Yielded);
            assert_eq!(moved.advance(&model, &mut moved_log, Until::Time(f64::INFINITY), 50), Progress::Yielded);
            // 37 has no factor in common with 100: a permutation, another one each round
            moved.seat(&(0..100).map(|seat| ((37 * seat + 11 * round) % 100) as u32).collect::<Vec<_>>());
        }
        assert_eq!(moved.state(&model).hash(), still.state(&model).hash());
        assert_eq!(moved_log.events, log.events);
        assert!(log.tallies.impacts > 1000, "{}", log.tallies.impacts);
    }
}
