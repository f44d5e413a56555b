//! The earliest event of many: a tournament of eight.
//!
//! Each seat has one entry, the time of its next event. Every eight entries share a winner one level up, so that a
//! changed entry is one cache line a level and a million spheres are seven levels. Who wins is kept beside the winner's
//! time, so that the first of all is found without going down again. Bounded memory, no rebuilding, no dependence on how
//! event rates change (a calendar of buckets is within a few per cent here, and needs retuning).

use super::simd::{Eight, Judge, Simd, Tournament};

/// Entries that share a winner: one cache line of times.
const FAN: usize = 8;

/// Levels that the indices of spheres can need: 8¹¹ > 2³².
const MOST_LEVELS: usize = 11;

/// In place of a winner: several have the same time.
const TIED: u32 = u32::MAX;

/// The next event time at each seat, s; infinite where there is none.
#[derive(Debug, Clone)]
pub(crate) struct Queue {
    /// Leaves first, then winners of eight, up to a level of one block.
    blocks: Vec<Eight>,
    /// Who won each entry above the leaves, block by block from the second level on.
    winners: Vec<[u32; FAN]>,
    /// Where each level begins.
    starts: [usize; MOST_LEVELS],
    levels: usize,
    lanes: Simd,
}

impl Queue {
    /// No events at `count` seats.
    pub(crate) fn new(count: usize) -> Queue {
        let (mut starts, mut levels, mut total) = ([0; MOST_LEVELS], 0, 0);
        let mut width = count.max(1);
        loop {
            starts[levels] = total;
            levels += 1;
            width = width.div_ceil(FAN);
            total += width;
            if width == 1 {
                let blocks = vec![Eight([f64::INFINITY; FAN]); total];
                let leaves = if levels > 1 { starts[1] } else { total };
                let winners = vec![[TIED; FAN]; total - leaves];
                return Queue { blocks, winners, starts, levels, lanes: Simd::new() };
            }
        }
    }

    /// Sets the next event at a seat to `time`, s.
    #[inline]
    pub(crate) fn set(&mut self, seat: usize, time: f64) {
        let lanes = self.lanes;
        lanes.run(Lift::<false> { queue: self, seat, time });
    }

    /// The same for the seat of the first event, which has won all the way up: the earliest time then, and its seat if it
    /// is the only one.
    #[inline]
    pub(crate) fn replace_first(&mut self, seat: usize, time: f64) -> Option<(f64, usize)> {
        let lanes = self.lanes;
        let (time, winner) = lanes.run(Lift::<true> { queue: self, seat, time });
        (winner != TIED).then_some((time, winner as usize))
    }

    /// The earliest time, s, infinite if nothing ever happens; and its seat if it is the only one.
    #[inline]
    pub(crate) fn earliest(&self) -> (f64, Option<usize>) {
        let (time, winner) = self.lanes.run(Winner { queue: self });
        (time, (winner != TIED).then_some(winner as usize))
    }

    /// When the event of a seat is, s.
    pub(crate) fn time_of(&self, seat: usize) -> f64 {
        self.blocks[seat / FAN].0[seat % FAN]
    }

    /// Lists the events until `time` (s), no more than `most` or little more, level by level: what the next one will read
    /// is asked for meanwhile. `blocks` is lent.
    pub(crate) fn until(&self, time: f64, most: usize, list: &mut Vec<(f64, u32)>, blocks: &mut [Vec<u32>; 2]) {
        let [above, below] = blocks;
        above.clear();
        above.push(0);
        for level in (0..self.levels).rev() {
            below.clear();
            for &block in above.iter().take(most) {
                for (k, &entry) in self.blocks[self.starts[level] + block as usize].0.iter().enumerate() {
                    if entry <= time {
                        let place = block * FAN as u32 + k as u32;
                        match level {
                            0 => list.push((entry, place)),
                            _ => {
                                self.lanes.fetch(&self.blocks[self.starts[level - 1] + place as usize]);
                                below.push(place);
                            }
                        }
                    }
                }
            }
            std::mem::swap(above, below);
        }
    }

    /// Asks for the entry of a seat: it will change soon.
    #[inline]
    pub(crate) fn fetch(&self, seat: usize) {
        self.lanes.fetch(&self.blocks[seat / FAN]);
    }

    /// Visits every seat with the earliest time, s.
    #[cold]
    pub(crate) fn each_at(&self, time: f64, mut visit: impl FnMut(usize)) {
        self.descend(self.levels - 1, 0, time, &mut visit);
    }

    fn descend(&self, level: usize, block: usize, time: f64, visit: &mut impl FnMut(usize)) {
        for (k, &entry) in self.blocks[self.starts[level] + block].0.iter().enumerate() {
            if entry == time {
                match level {
                    0 => visit(block * FAN + k),
                    _ => self.descend(level - 1, block * FAN + k, time, visit),
                }
            }
        }
    }
}

/// An entry changes: the winners above it are found anew, all of them or up to the first that stays.
struct Lift<'a, const ALL: bool> {
    queue: &'a mut Queue,
    seat: usize,
    /// The new time, s.
    time: f64,
}

impl<const ALL: bool> Tournament for Lift<'_, ALL> {
    /// The earliest time and its seat, if all were found anew.
    type Output = (f64, u32);

    #[inline(always)]
    fn run(self, judge: impl Judge) -> (f64, u32) {
        let Lift { queue: Queue { blocks, winners, starts, levels, .. }, seat, mut time } = self;
        let (leaves, mut place) = (starts[1], seat);
        let mut level = 0;
        loop {
            let block = starts[level] + place / FAN;
            let (least, equal) = judge.exchange(&mut blocks[block], place % FAN, time);
            let first = equal.trailing_zeros();
            let entered = if level == 0 {
                (place - place % FAN) as u32 + first
            } else {
                winners[block - leaves][first as usize % FAN]
            };
            let winner = if equal & equal.wrapping_sub(1) != 0 { TIED } else { entered };
            place /= FAN;
            level += 1;
            if level == *levels {
                return (least, winner);
            }
            let above = starts[level] + place / FAN;
            let entry = &mut winners[above - leaves][place % FAN];
            if !ALL && (*entry == winner) & (blocks[above].0[place % FAN] == least) {
                return (least, TIED);
            }
            (*entry, time) = (winner, least);
        }
    }
}

/// The earliest time, and its seat unless several have it.
struct Winner<'a> {
    queue: &'a Queue,
}

impl Tournament for Winner<'_> {
    type Output = (f64, u32);

    #[inline(always)]
    fn run(self, judge: impl Judge) -> (f64, u32) {
        let Queue { blocks, winners, .. } = self.queue;
        let Some(root) = blocks.last() else { return (f64::INFINITY, TIED) };
        let (time, equal) = judge.judge(root);
        let first = equal.trailing_zeros();
        let winner = match winners.last() {
            _ if equal & equal.wrapping_sub(1) != 0 => TIED,
            Some(winners) => winners[first as usize % FAN],
            None => first,
        };
        (time, winner)
    }
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
            let first = queue.earliest();
            if first.1 == Some(i) {
                let found = queue.replace_first(i, time);
                assert!(found.is_none_or(|(time, seat)| (time, Some(seat)) == queue.earliest()));
            } else {
                queue.set(i, time);
            }
            assert_eq!(queue.time_of(i), time);
            let least = times.iter().copied().fold(f64::INFINITY, f64::min);
            let expected: Vec<usize> = (0..count).filter(|&i| times[i] == least).collect();
            let (found, only) = queue.earliest();
            let mut all = Vec::new();
            queue.each_at(found, |seat| all.push(seat));
            assert_eq!((found, &all), (least, &expected));
            // a tie may go unnoticed by the seat, never the other way round
            assert!(only.is_none_or(|seat| expected == [seat]));
            assert!(expected.len() > 1 || least == f64::INFINITY || only.is_some());
        }
    }
}
