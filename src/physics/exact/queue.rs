//! The earliest event of many: a tournament of eight.
//!
//! Each sphere has one entry, the time of its next event. Every eight entries share a winner one level up, so that a
//! changed entry is one cache line a level and a million spheres are seven levels. Bounded memory, no rebuilding, no
//! dependence on how event rates change (a calendar of buckets is within a few per cent here, and needs retuning).

/// Entries that share a winner: one cache line of times.
const FAN: usize = 8;

/// The next event time of each sphere, s; infinite where there is none.
#[derive(Debug, Clone, Default)]
pub(super) struct Queue {
    /// Leaves first, then winners of eight, up to a level of at most eight.
    levels: Vec<Vec<f64>>,
}

impl Queue {
    /// No events for `count` spheres.
    pub(super) fn new(count: usize) -> Queue {
        let mut levels = Vec::new();
        let mut width = count.max(1);
        loop {
            levels.push(vec![f64::INFINITY; width.next_multiple_of(FAN)]);
            if width <= FAN {
                return Queue { levels };
            }
            width = width.div_ceil(FAN);
        }
    }

    /// Sets the next event of sphere `i` to `time`, s.
    #[inline]
    pub(super) fn set(&mut self, i: usize, time: f64) {
        self.levels[0][i] = time;
        let mut place = i;
        for level in 1..self.levels.len() {
            place /= FAN;
            let winner = least(&self.levels[level - 1][place * FAN..place * FAN + FAN]);
            if self.levels[level][place] == winner {
                return;
            }
            self.levels[level][place] = winner;
        }
    }

    /// The earliest time and its sphere; among equal times the sphere that `before` puts first; sphere 0
    /// if nothing ever happens.
    #[inline]
    pub(super) fn first(&self, before: impl Fn(usize, usize) -> bool) -> (f64, usize) {
        let top = self.levels.len() - 1;
        let time = least(&self.levels[top]);
        if time == f64::INFINITY {
            return (time, 0);
        }
        let mut place = 0;
        for level in (0..=top).rev() {
            let equal = equals(&self.levels[level][place * FAN..place * FAN + FAN], time);
            if equal & (equal - 1) != 0 {
                return (time, self.first_of_equals(time, before));
            }
            place = place * FAN + equal.trailing_zeros() as usize;
        }
        (time, place)
    }

    /// Which of several spheres with the earliest time `before` puts first.
    #[cold]
    fn first_of_equals(&self, time: f64, before: impl Fn(usize, usize) -> bool) -> usize {
        let mut best = usize::MAX;
        self.descend(self.levels.len() - 1, 0, time, &mut |i| {
            if best == usize::MAX || before(i, best) {
                best = i;
            }
        });
        best
    }

    fn descend(&self, level: usize, block: usize, time: f64, visit: &mut impl FnMut(usize)) {
        for place in block * FAN..block * FAN + FAN {
            if self.levels[level][place] == time {
                match level {
                    0 => visit(place),
                    _ => self.descend(level - 1, place, time, visit),
                }
            }
        }
    }
}

/// A bit for each of eight times that equals `time`, the least of them.
#[inline]
fn equals(times: &[f64], time: f64) -> u32 {
    let &[a, b, c, d, e, f, g, h] = times else { return 1 };
    // none is below the least: one comparison tells, where equality takes two
    let bit = |t: f64, k: u32| u32::from(t <= time) << k;
    bit(a, 0) | bit(b, 1) | bit(c, 2) | bit(d, 3) | bit(e, 4) | bit(f, 5) | bit(g, 6) | bit(h, 7)
}

/// The smallest of eight times, pairwise.
#[inline]
fn least(times: &[f64]) -> f64 {
    let smaller = |a: f64, b: f64| if b < a { b } else { a };
    let &[a, b, c, d, e, f, g, h] = times else { return f64::INFINITY };
    smaller(smaller(smaller(a, b), smaller(c, d)), smaller(smaller(e, f), smaller(g, h)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_is_what_a_linear_search_finds() {
        let count = 1000;
        let mut queue = Queue::new(count);
        let mut times = vec![f64::INFINITY; count];
        let mut seed = 1_u64;
        for _ in 0..20_000 {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let (i, time) = ((seed >> 33) as usize % count, ((seed >> 20) % 512) as f64);
            times[i] = time;
            queue.set(i, time);
            // ties go to the larger index here, to see that the order is the caller's
            let expected = (0..count).rev().min_by(|&a, &b| times[a].total_cmp(&times[b])).expect("not empty");
            let found = queue.first(|a, b| a > b);
            assert_eq!(found, (times[expected], expected));
        }
    }
}
