//! The order of the records: neighbours side by side, so that what an event reads lies together.

use super::cells::nearness;
use super::parts::Schedule;
use crate::physics::events::detector::Detector;
use crate::physics::events::islands::resting::Rests;
use crate::physics::events::trajectories::Trajectories;

impl<D: Detector> Schedule<D> {
    /// Orders the records by the coordinates of their cells.
    pub(super) fn order_by_cells(&mut self, trajectories: &mut Trajectories, rests: &Rests) {
        let key = |slot: usize| {
            let record = &trajectories.records[slot];
            (nearness(record.cell.coordinates), record.sphere, slot as u32)
        };
        let mut order: Vec<_> = (0..trajectories.records.len()).map(key).collect();
        order.sort_unstable();
        let order: Vec<u32> = order.into_iter().map(|(.., slot)| slot).collect();
        self.reorder(trajectories, rests, &order);
    }

    /// Moves the sphere at slot `order[s]` to slot s.
    pub(crate) fn reorder(&mut self, trajectories: &mut Trajectories, rests: &Rests, order: &[u32]) {
        trajectories.reorder(order);
        if let Some(cells) = &mut self.cells {
            cells.fill(trajectories.records.iter().map(|record| record.cell.index));
        }
        self.forget();
        for slot in 0..order.len() {
            self.enter(trajectories, rests, slot);
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::physics::events::engine::EventDriven;
    use crate::physics::exact::root_detector::RootDetector;
    use crate::physics::log::Log;
    use crate::physics::method::{Progress, Until};
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
    fn the_order_of_the_records_changes_no_bit() {
        let model = Model::new(&gas());
        let settings = Settings { method: Method::Exact, dt: 0.01, tolerance: 1e-3 };
        let mut log = Log { recording: true, ..Log::default() };
        let mut still = EventDriven::<RootDetector>::begin(&model, settings, &model.initial, &mut log);
        let (mut moved, mut moved_log) = (still.clone(), log.clone());
        for round in 0..200_u64 {
            assert_eq!(still.advance(&model, &mut log, Until::Time(f64::INFINITY), 50), Progress::Yielded);
            assert_eq!(moved.advance(&model, &mut moved_log, Until::Time(f64::INFINITY), 50), Progress::Yielded);
            // 37 has no factor in common with 100: a permutation, another one each round
            let order: Vec<u32> = (0..100).map(|slot| ((37 * slot + 11 * round) % 100) as u32).collect();
            moved.schedule.reorder(&mut moved.mechanics.trajectories, &moved.mechanics.rests, &order);
        }
        assert_eq!(moved.at(&model, moved.time()).hash(), still.at(&model, still.time()).hash());
        assert_eq!(moved_log.events, log.events);
        assert!(log.tallies.impacts > 1000, "{}", log.tallies.impacts);
    }
}
