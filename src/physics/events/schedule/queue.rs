//! The earliest event of many: a tree of minima of eight.
//!
//! Each slot has one entry, the time of its next event. The minimum of every eight entries is kept one level up, so that a
//! changed entry is one cache line a level and a million spheres are seven levels. The slot of a minimum is kept beside its
//! time, so that the first of all is found without going down again. Bounded memory, no rebuilding, no dependence on how
//! event rates change (a calendar of buckets is within a few per cent here, and needs retuning).

use super::simd::{Eight, MinOfEight, MinTreeJob, Simd};

/// Entries that share a minimum: one cache line of times.
const FAN: usize = 8;

/// Levels that the indices of spheres can need: 8¹¹ > 2³².
const MOST_LEVELS: usize = 11;

/// What stands in place of a slot where several have one time.
const TIED: u32 = u32::MAX;

/// The next event time at each slot, s; infinite where there is none.
#[derive(Debug, Clone)]
pub(crate) struct Queue {
    /// Leaves first, then minima of eight, up to a level of one block.
    blocks: Vec<Eight>,
    /// The slot of each minimum above the leaves, block by block from the second level on.
    holders: Vec<[u32; FAN]>,
    /// Where each level begins.
    starts: [usize; MOST_LEVELS],
    levels: usize,
    simd: Simd,
}

impl Queue {
    /// A queue of `count` slots without events.
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
                let holders = vec![[TIED; FAN]; total - leaves];
                return Queue { blocks, holders, starts, levels, simd: Simd::new() };
            }
        }
    }

    /// Memory that it takes beside its own size, bytes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.blocks) + size_of_val(&*self.holders)
    }

    /// Sets the next event at a slot to `time`, s.
    #[inline]
    pub(crate) fn set(&mut self, slot: usize, time: f64) {
        let simd = self.simd;
        simd.run(Update::<false> { queue: self, slot, time });
    }

    /// Replaces the time of the minimum, which is entered for `slot`; returns the new minimum (s) and its slot, none if
    /// several tie.
    #[inline]
    pub(crate) fn replace_first(&mut self, slot: usize, time: f64) -> Option<(f64, usize)> {
        let simd = self.simd;
        let (time, holder) = simd.run(Update::<true> { queue: self, slot, time });
        (holder != TIED).then_some((time, holder as usize))
    }

    /// The earliest time, s, infinite if nothing ever happens; and its slot if it is the only one.
    #[inline]
    pub(crate) fn earliest(&self) -> (f64, Option<usize>) {
        let (time, holder) = self.simd.run(Lookup { queue: self });
        (time, (holder != TIED).then_some(holder as usize))
    }

    /// Time of the event of a slot, s.
    pub(crate) fn time_of(&self, slot: usize) -> f64 {
        self.blocks[slot / FAN].0[slot % FAN]
    }

    /// Lists the events until `time` (s), no more than `most` or little more, level by level: what the next one will read
    /// is asked for meanwhile. `blocks` are scratch buffers.
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
                                self.simd.fetch(&self.blocks[self.starts[level - 1] + place as usize]);
                                below.push(place);
                            }
                        }
                    }
                }
            }
            std::mem::swap(above, below);
        }
    }

    /// Asks for the entry of a slot: it will change soon.
    #[inline]
    pub(crate) fn fetch(&self, slot: usize) {
        self.simd.fetch(&self.blocks[slot / FAN]);
    }

    /// Visits every slot with the earliest time, s.
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

/// A change of an entry: the minima above it are found anew, all of them or up to the first that stays.
struct Update<'a, const ALL: bool> {
    queue: &'a mut Queue,
    slot: usize,
    /// The new time, s.
    time: f64,
}

impl<const ALL: bool> MinTreeJob for Update<'_, ALL> {
    /// The earliest time and its slot, if all were found anew.
    type Output = (f64, u32);

    #[inline(always)]
    fn run(self, minimum: impl MinOfEight) -> (f64, u32) {
        let Update { queue: Queue { blocks, holders, starts, levels, .. }, slot, mut time } = self;
        let (leaves, mut place) = (starts[1], slot);
        let mut level = 0;
        loop {
            let block = starts[level] + place / FAN;
            let (least, equal) = minimum.exchange(&mut blocks[block], place % FAN, time);
            let first = equal.trailing_zeros();
            let entered = if level == 0 {
                (place - place % FAN) as u32 + first
            } else {
                holders[block - leaves][first as usize % FAN]
            };
            let holder = if equal & equal.wrapping_sub(1) != 0 { TIED } else { entered };
            place /= FAN;
            level += 1;
            if level == *levels {
                return (least, holder);
            }
            let above = starts[level] + place / FAN;
            let entry = &mut holders[above - leaves][place % FAN];
            if !ALL && (*entry == holder) & (blocks[above].0[place % FAN] == least) {
                return (least, TIED);
            }
            (*entry, time) = (holder, least);
        }
    }
}

/// A look for the earliest time, and its slot unless several have it.
struct Lookup<'a> {
    queue: &'a Queue,
}

impl MinTreeJob for Lookup<'_> {
    type Output = (f64, u32);

    #[inline(always)]
    fn run(self, minimum: impl MinOfEight) -> (f64, u32) {
        let Queue { blocks, holders, .. } = self.queue;
        let root = blocks.last().expect("a queue has one block at least");
        let (time, equal) = minimum.of(root);
        let first = equal.trailing_zeros();
        let holder = match holders.last() {
            _ if equal & equal.wrapping_sub(1) != 0 => TIED,
            Some(holders) => holders[first as usize % FAN],
            None => first,
        };
        (time, holder)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::SplitMix64;

    #[test]
    fn the_first_is_what_a_linear_search_finds() {
        let count = 1000;
        let mut queue = Queue::new(count);
        let mut times = vec![f64::INFINITY; count];
        let mut draw = SplitMix64::new(1);
        for _ in 0..20_000 {
            let (i, time) = (draw.below(count), draw.below(512) as f64);
            times[i] = time;
            let first = queue.earliest();
            if first.1 == Some(i) {
                let found = queue.replace_first(i, time);
                assert!(found.is_none_or(|(time, slot)| (time, Some(slot)) == queue.earliest()));
            } else {
                queue.set(i, time);
            }
            assert_eq!(queue.time_of(i), time);
            let least = times.iter().copied().fold(f64::INFINITY, f64::min);
            let expected: Vec<usize> = (0..count).filter(|&i| times[i] == least).collect();
            let (found, only) = queue.earliest();
            let mut all = Vec::new();
            queue.each_at(found, |slot| all.push(slot));
            assert_eq!((found, &all), (least, &expected));
            // a tie may go unnoticed by the slot, never the other way round
            assert!(only.is_none_or(|slot| expected == [slot]));
            assert!(expected.len() > 1 || least == f64::INFINITY || only.is_some());
        }
    }
}
