//! How much work fits between two looks at whether to go on.

/// Units of work for one call of `advance`, learnt from how long the calls take. A unit is a degree evaluation or an
/// event, and one event that settles a heap takes longer than a thousand in flight. No bit of a run depends on where
/// slices end.
#[derive(Debug, Clone)]
pub struct Slices {
    work: u64,
    /// How long a call should last, s.
    aim: f64,
}

impl Slices {
    /// Slices that aim at `aim` (s): so little work at first that any machine is quick with it; a cheap scene multiplies it
    /// within milliseconds.
    pub fn of(aim: f64) -> Slices {
        Slices { work: 256, aim }
    }

    /// Units of work for the next call.
    pub fn work(&self) -> u64 {
        self.work
    }

    /// Takes note that a call which used all its work took `length`, s.
    pub fn learn(&mut self, length: f64) {
        let factor = (self.aim / length.max(1e-9)).clamp(0.25, 4.0);
        self.work = ((self.work as f64 * factor) as u64).clamp(16, 1 << 40);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slices_grow_with_fast_calls_and_shrink_with_slow_ones() {
        let mut slices = Slices::of(3e-3);
        slices.learn(1e-6);
        assert_eq!(slices.work(), 1024);
        slices.learn(6e-3);
        assert_eq!(slices.work(), 512);
        for _ in 0..100 {
            slices.learn(1.0);
        }
        assert_eq!(slices.work(), 16);
    }
}
