//! Where simulated time should be by now, how fast it really goes. Wall time comes in as seconds, so that tests need no
//! clock.

/// A run that is further behind than this, s of wall time, gives the lost time up instead of chasing it.
const PATIENCE: f64 = 0.1;

/// Length of the measurement of the speed reached, s of wall time: long enough to read, short enough to follow.
const WINDOW: f64 = 0.5;

/// Simulated time against wall time.
#[derive(Debug)]
pub(super) struct Pace {
    wanted: f64,
    origin: Mark,
    window: Mark,
    reached: Option<f64>,
}

/// A moment in both times, s.
#[derive(Debug, Clone, Copy)]
struct Mark {
    wall: f64,
    simulated: f64,
}

impl Pace {
    /// A pace of `wanted` simulated seconds per second from now on.
    pub(super) fn new(wanted: f64, wall: f64, simulated: f64) -> Pace {
        let mark = Mark { wall, simulated };
        Pace { wanted, origin: mark, window: mark, reached: None }
    }

    pub(super) fn wanted(&self) -> f64 {
        self.wanted
    }

    pub(super) fn reached(&self) -> Option<f64> {
        self.reached
    }

    /// Simulated time that should be reached now, s; time lost beyond [`PATIENCE`] is given up.
    pub(super) fn target(&mut self, wall: f64, simulated: f64) -> f64 {
        let ahead = self.origin.simulated + (wall - self.origin.wall) * self.wanted;
        let most = simulated + PATIENCE * self.wanted;
        if ahead > most {
            self.origin = Mark { wall, simulated: most };
        }
        ahead.min(most)
    }

    /// Wall time until `simulated` is due, s; not positive if it is.
    pub(super) fn wait(&self, wall: f64, simulated: f64) -> f64 {
        self.origin.wall + (simulated - self.origin.simulated) / self.wanted - wall
    }

    /// Takes note of what has been reached by now.
    pub(super) fn measure(&mut self, wall: f64, simulated: f64) {
        let length = wall - self.window.wall;
        if length >= WINDOW {
            self.reached = Some((simulated - self.window.simulated) / length);
            self.window = Mark { wall, simulated };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn simulated_time_follows_the_wall_at_the_wanted_speed() {
        let mut pace = Pace::new(0.5, 100.0, 7.0);
        assert_eq!(pace.target(100.0625, 7.0), 7.03125);
        assert_eq!(pace.wait(100.0, 8.0), 2.0);
    }

    #[test]
    fn a_run_that_falls_behind_does_not_chase_the_lost_time() {
        let mut pace = Pace::new(2.0, 0.0, 0.0);
        assert_eq!(pace.target(60.0, 1.0), 1.2, "a tenth of a second's worth, not the lost minute");
        assert!((pace.target(60.05, 1.2) - 1.3).abs() < 1e-12, "and on from there; rounding of the subtraction only");
    }

    #[test]
    fn the_speed_reached_is_measured_over_half_a_second() {
        let mut pace = Pace::new(4.0, 0.0, 0.0);
        pace.measure(0.25, 0.5);
        assert_eq!(pace.reached(), None);
        pace.measure(0.5, 0.5);
        assert_eq!(pace.reached(), Some(1.0));
        pace.measure(1.0, 2.0);
        assert_eq!(pace.reached(), Some(3.0));
    }
}
