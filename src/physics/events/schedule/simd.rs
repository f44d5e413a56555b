//! Four numbers at a time, where the processor can (AVX2, asked once); the same operations in the same order one by one
//! where it cannot. Both make the same bits, which is tested: nothing is contracted or reordered.

use glam::DVec3;

use crate::physics::events::record::Record;
use crate::physics::path::Path;

#[cfg(target_arch = "x86_64")]
use pulp::x86::V3;

/// Slots that are looked at in one call at most: a bit each.
pub(crate) const MOST: usize = 64;

/// Eight times, s: one cache line.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(crate) struct Eight(pub(super) [f64; 8]);

/// What is found out about four pairs, each at offset x with relative velocity v: b = x·v or 0 where they part,
/// c = x² − reach², and the discriminant b² − v² c. They meet if b is negative and the discriminant positive.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct PairBatch {
    pub(crate) b: [f64; 4],
    pub(crate) c: [f64; 4],
    pub(crate) discriminant: [f64; 4],
}

/// Room for what is found out in one call, and for a pair that never meets.
pub(crate) const BATCHES: usize = MOST / 4 + 1;

impl PairBatch {
    /// A pair that never meets.
    pub(crate) const NEVER: PairBatch = PairBatch { b: [-1.0; 4], c: [f64::INFINITY; 4], discriminant: [0.0; 4] };
}

/// The earliest of some pairs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Earliest {
    /// Time at which the pair meets, s; infinite if none does before the other sphere has its own next contact.
    pub(crate) time: f64,
    /// Slot of the other sphere.
    pub(crate) with: u32,
    /// The pair's c, m².
    pub(crate) c: f64,
    /// A bit for each pair that meets.
    pub(crate) meet: u64,
    /// Whether some pair overlaps, or another meets at the same time: then the pairs are to be looked at one by one.
    pub(crate) doubtful: bool,
}

/// The query sphere: its path from `now` (s) on and its radius (m); all spheres share its acceleration.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Query<'a> {
    pub(crate) path: &'a Path,
    pub(crate) r: f64,
    pub(crate) now: f64,
}

/// The instructions that the processor has.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Simd {
    #[cfg(target_arch = "x86_64")]
    wide: Option<V3>,
}

impl Simd {
    /// The instructions of this processor.
    pub(crate) fn new() -> Simd {
        Simd {
            #[cfg(target_arch = "x86_64")]
            wide: V3::try_new(),
        }
    }

    /// The instructions of a processor without AVX2.
    #[cfg(test)]
    fn plain() -> Simd {
        Simd {
            #[cfg(target_arch = "x86_64")]
            wide: None,
        }
    }

    /// Looks at the pairs of the query with the spheres at some slots, four by four and [`MOST`] at most.
    #[inline]
    pub(crate) fn look(
        self,
        query: Query,
        records: &[Record],
        slots: &[u32],
        batches: &mut [PairBatch; BATCHES],
    ) -> Earliest {
        #[cfg(target_arch = "x86_64")]
        if let Some(wide) = self.wide {
            return match query.path.a == DVec3::ZERO {
                true => wide.vectorize(wide::PairScan::<false> { wide, query, records, slots, batches }),
                false => wide.vectorize(wide::PairScan::<true> { wide, query, records, slots, batches }),
            };
        }
        let meet = look(query, records, slots, batches);
        earliest(meet, records, slots, batches, |batch| times(query.now, batch))
    }

    /// Asks for what will be read soon.
    #[inline]
    pub(crate) fn fetch<T>(self, what: &T) {
        #[cfg(target_arch = "x86_64")]
        if let Some(wide) = self.wide {
            wide.sse._mm_prefetch::<{ std::arch::x86_64::_MM_HINT_T0 }>((&raw const *what).cast());
        }
    }

    /// Does a job on the tree of minima of eight, as the processor can.
    #[inline]
    pub(crate) fn run<J: MinTreeJob>(self, job: J) -> J::Output {
        #[cfg(target_arch = "x86_64")]
        if let Some(wide) = self.wide {
            return wide.vectorize(wide::Run { wide, job });
        }
        job.run(Plain)
    }
}

/// A job on the tree of minima of eight.
pub(crate) trait MinTreeJob {
    /// Result of the job.
    type Output;
    /// Does the job, with this way to find the smallest of eight.
    fn run(self, minimum: impl MinOfEight) -> Self::Output;
}

/// Finds the smallest of eight times.
pub(crate) trait MinOfEight: Copy {
    /// The smallest, and a bit for each that equals it.
    fn of(self, times: &Eight) -> (f64, u32);
    /// Puts `time` in the place `k` of another, and finds the smallest.
    fn exchange(self, times: &mut Eight, k: usize, time: f64) -> (f64, u32);
}

/// Finds the smallest one by one.
#[derive(Clone, Copy)]
struct Plain;

impl MinOfEight for Plain {
    #[inline]
    fn of(self, times: &Eight) -> (f64, u32) {
        let smaller = |a: f64, b: f64| if b < a { b } else { a };
        let [a, b, c, d, e, f, g, h] = times.0;
        let least = smaller(smaller(smaller(a, b), smaller(c, d)), smaller(smaller(e, f), smaller(g, h)));
        // none is below the least: one comparison tells, where equality takes two
        (least, times.0.iter().enumerate().map(|(k, &t)| u32::from(t <= least) << k).sum())
    }

    #[inline]
    fn exchange(self, times: &mut Eight, k: usize, time: f64) -> (f64, u32) {
        times.0[k] = time;
        self.of(times)
    }
}

fn look(query: Query, records: &[Record], slots: &[u32], batches: &mut [PairBatch; BATCHES]) -> u64 {
    let mut meet = 0;
    for (k, &slot) in slots.iter().enumerate() {
        let line = &records[slot as usize].trajectory;
        let (dt, a) = (query.now - line.t, query.path.a);
        let x = query.path.x - (line.x + (line.v + a * (0.5 * dt)) * dt);
        let v = query.path.v - (line.v + a * dt);
        let reach = query.r + line.r;
        let (b, c) = (x.dot(v).min(0.0), x.length_squared() - reach * reach);
        let discriminant = b * b - v.length_squared() * c;
        let batch = &mut batches[k / 4];
        (batch.b[k % 4], batch.c[k % 4], batch.discriminant[k % 4]) = (b, c, discriminant);
        meet |= u64::from(discriminant > 0.0 && b < 0.0) << k;
    }
    meet
}

/// Times at which four pairs that meet do so, s.
fn times(now: f64, batch: &PairBatch) -> [f64; 4] {
    [0, 1, 2, 3].map(|k| now + batch.c[k] / (batch.discriminant[k].sqrt() - batch.b[k]))
}

/// The earliest of the pairs with a bit in `meet`, four at a time: few meet at all, and how many cannot be predicted.
#[inline(always)]
fn earliest(
    meet: u64,
    records: &[Record],
    slots: &[u32],
    batches: &[PairBatch; BATCHES],
    times: impl Fn(&PairBatch) -> [f64; 4],
) -> Earliest {
    let mut first = Earliest { time: f64::INFINITY, with: slots[0], c: 0.0, meet, doubtful: false };
    let mut left = meet;
    loop {
        // 64 when none is left, which stands for the pair that never meets
        let hits = [0; 4].map(|_| {
            let hit = left.trailing_zeros() as usize;
            left &= left.wrapping_sub(1);
            hit
        });
        let batch = PairBatch {
            b: hits.map(|k| batches[k / 4].b[k % 4]),
            c: hits.map(|k| batches[k / 4].c[k % 4]),
            discriminant: hits.map(|k| batches[k / 4].discriminant[k % 4]),
        };
        let others = hits.map(|k| slots[k % MOST]);
        let found = times(&batch);
        // what the other meets before makes it look around anew, and find this one then
        let due = [0, 1, 2, 3].map(|k| {
            let theirs = records[others[k] as usize].plan.contact;
            if found[k] <= theirs { found[k] } else { f64::INFINITY }
        });
        let smaller = |a: f64, b: f64| if b < a { b } else { a };
        let least = smaller(smaller(due[0], due[1]), smaller(due[2], due[3]));
        let equal: u32 = (0..4).map(|k| u32::from(due[k] <= least) << k).sum();
        let tied = (equal & equal.wrapping_sub(1) != 0 || least == first.time) && least < f64::INFINITY;
        let overlap = smaller(smaller(batch.c[0], batch.c[1]), smaller(batch.c[2], batch.c[3])) <= 0.0;
        first.doubtful |= tied || overlap;
        if least < first.time {
            let k = equal.trailing_zeros() as usize % 4;
            (first.time, first.with, first.c) = (least, others[k], batch.c[k]);
        }
        if left == 0 {
            return first;
        }
    }
}

#[cfg(target_arch = "x86_64")]
mod wide {
    use std::arch::x86_64::__m256d;

    use pulp::NullaryFnOnce;

    use glam::DVec3;
    use pulp::x86::V3;

    use super::{BATCHES, Earliest, Eight, MinOfEight, MinTreeJob, PairBatch, Query, earliest};
    use crate::physics::events::record::{Record, Trajectory};

    /// Looks at pairs of spheres that an acceleration bends or not.
    pub(crate) struct PairScan<'a, const BENT: bool> {
        pub(crate) wide: V3,
        pub(crate) query: Query<'a>,
        pub(crate) records: &'a [Record],
        pub(crate) slots: &'a [u32],
        pub(crate) batches: &'a mut [PairBatch; BATCHES],
    }

    pub(crate) struct Run<J> {
        pub(crate) wide: V3,
        pub(crate) job: J,
    }

    impl<J: MinTreeJob> NullaryFnOnce for Run<J> {
        type Output = J::Output;

        #[inline(always)]
        fn call(self) -> J::Output {
            self.job.run(self.wide)
        }
    }

    impl MinOfEight for V3 {
        #[inline(always)]
        fn of(self, times: &Eight) -> (f64, u32) {
            minimum(self, halves(self, times))
        }

        #[inline(always)]
        fn exchange(self, times: &mut Eight, k: usize, time: f64) -> (f64, u32) {
            // in registers: what has just been written to memory in one piece is slow to read with what is beside it
            let (k, time) = (self.avx._mm256_set1_pd(k as f64), self.avx._mm256_set1_pd(time));
            let [low, high] = halves(self, times);
            let place = |first: f64| self.avx._mm256_set_pd(first + 3.0, first + 2.0, first + 1.0, first);
            let here = |first: f64| self.avx._mm256_cmp_pd::<EQUAL>(k, place(first));
            let both =
                [self.avx._mm256_blendv_pd(low, time, here(0.0)), self.avx._mm256_blendv_pd(high, time, here(4.0))];
            times.0 = pulp::cast(both);
            minimum(self, both)
        }
    }

    #[inline(always)]
    fn minimum(wide: V3, [low, high]: [__m256d; 2]) -> (f64, u32) {
        let avx = wide.avx;
        let four = avx._mm256_min_pd(low, high);
        let two = avx._mm256_min_pd(four, avx._mm256_permute2f128_pd::<1>(four, four));
        let least = avx._mm256_min_pd(two, avx._mm256_permute_pd::<5>(two));
        // none is below the least: as one by one
        let bits = |four| avx._mm256_movemask_pd(avx._mm256_cmp_pd::<LESS_OR_EQUAL>(four, least)) as u32;
        (pulp::cast::<__m256d, [f64; 4]>(least)[0], bits(low) | bits(high) << 4)
    }

    const LESS_OR_EQUAL: i32 = std::arch::x86_64::_CMP_LE_OQ;
    const EQUAL: i32 = std::arch::x86_64::_CMP_EQ_OQ;
    const GREATER: i32 = std::arch::x86_64::_CMP_GT_OQ;

    #[inline(always)]
    fn halves(wide: V3, times: &Eight) -> [__m256d; 2] {
        let [a, b, c, d, e, f, g, h] = times.0;
        [wide.avx._mm256_set_pd(d, c, b, a), wide.avx._mm256_set_pd(h, g, f, e)]
    }

    impl<const BENT: bool> NullaryFnOnce for PairScan<'_, BENT> {
        type Output = Earliest;

        #[inline(always)]
        fn call(self) -> Earliest {
            let PairScan { wide, query, records, slots, batches } = self;
            let avx = wide.avx;
            // beside the velocities the radii: what is subtracted there is the reach, but for its sign
            let rows = [row(wide, query.path.x, 0.0), row(wide, query.path.v, -query.r), row(wide, query.path.a, 0.0)];
            let (now, zero) = (avx._mm256_set1_pd(query.now), avx._mm256_set1_pd(0.0));
            let mut meet = 0;
            for (k, (slots, batch)) in slots.chunks_exact(4).zip(&mut batches[..]).enumerate() {
                let [a, b, c, d] =
                    [slots[0], slots[1], slots[2], slots[3]].map(|slot| &records[slot as usize].trajectory);
                let (one, two) = (apart::<BENT>(wide, rows, a, now), apart::<BENT>(wide, rows, b, now));
                let (three, last) = (apart::<BENT>(wide, rows, c, now), apart::<BENT>(wide, rows, d, now));
                let [x, y, z, _] = across(wide, [one.0, two.0, three.0, last.0]);
                let [vx, vy, vz, reach] = across(wide, [one.1, two.1, three.1, last.1]);
                let dot = |[ax, ay, az]: [__m256d; 3], [bx, by, bz]: [__m256d; 3]| {
                    let xy = avx._mm256_add_pd(avx._mm256_mul_pd(ax, bx), avx._mm256_mul_pd(ay, by));
                    avx._mm256_add_pd(xy, avx._mm256_mul_pd(az, bz))
                };
                let (x, v) = ([x, y, z], [vx, vy, vz]);
                let b = avx._mm256_min_pd(dot(x, v), zero);
                let c = avx._mm256_sub_pd(dot(x, x), avx._mm256_mul_pd(reach, reach));
                let discriminant = avx._mm256_sub_pd(avx._mm256_mul_pd(b, b), avx._mm256_mul_pd(dot(v, v), c));
                *batch = PairBatch { b: pulp::cast(b), c: pulp::cast(c), discriminant: pulp::cast(discriminant) };
                let (real, near) =
                    (avx._mm256_cmp_pd::<GREATER>(discriminant, zero), avx._mm256_cmp_pd::<GREATER>(zero, b));
                let bits = avx._mm256_movemask_pd(avx._mm256_and_pd(real, near));
                meet |= (bits as u64) << (4 * k);
            }
            earliest(meet, records, slots, batches, |batch| {
                let [b, c, discriminant] = [batch.b, batch.c, batch.discriminant].map(pulp::cast::<[f64; 4], __m256d>);
                let root = avx._mm256_sqrt_pd(discriminant);
                pulp::cast(avx._mm256_add_pd(now, avx._mm256_div_pd(c, avx._mm256_sub_pd(root, b))))
            })
        }
    }

    #[inline(always)]
    fn row(wide: V3, p: DVec3, last: f64) -> __m256d {
        wide.avx._mm256_set_pd(last, p.z, p.y, p.x)
    }

    /// Offset and relative velocity of a line from the query's rows, at the present.
    #[inline(always)]
    fn apart<const BENT: bool>(
        wide: V3,
        [x, v, a]: [__m256d; 3],
        line: &Trajectory,
        now: __m256d,
    ) -> (__m256d, __m256d) {
        let avx = wide.avx;
        let (lx, lv) = (row(wide, line.x, line.t), row(wide, line.v, line.r));
        let dt = avx._mm256_sub_pd(now, avx._mm256_set1_pd(line.t));
        let (mut mean, mut last) = (lv, lv);
        if BENT {
            let half = avx._mm256_mul_pd(avx._mm256_set1_pd(0.5), dt);
            mean = avx._mm256_add_pd(lv, avx._mm256_mul_pd(a, half));
            last = avx._mm256_add_pd(lv, avx._mm256_mul_pd(a, dt));
        }
        let there = avx._mm256_add_pd(lx, avx._mm256_mul_pd(mean, dt));
        (avx._mm256_sub_pd(x, there), avx._mm256_sub_pd(v, last))
    }

    /// Rows as columns.
    #[inline(always)]
    fn across(wide: V3, [a, b, c, d]: [__m256d; 4]) -> [__m256d; 4] {
        let avx = wide.avx;
        let [low, high] = [avx._mm256_unpacklo_pd(a, b), avx._mm256_unpackhi_pd(a, b)];
        let [lows, highs] = [avx._mm256_unpacklo_pd(c, d), avx._mm256_unpackhi_pd(c, d)];
        [
            avx._mm256_permute2f128_pd::<0x20>(low, lows),
            avx._mm256_permute2f128_pd::<0x20>(high, highs),
            avx._mm256_permute2f128_pd::<0x31>(low, lows),
            avx._mm256_permute2f128_pd::<0x31>(high, highs),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::events::trajectories::Trajectories;
    use crate::physics::model::Model;
    use crate::random::SplitMix64;
    use glam::dvec3;

    /// Numbers of three magnitudes and either sign, the same in every run.
    fn numbers() -> impl FnMut() -> f64 {
        let mut draw = SplitMix64::new(1);
        move || draw.centered() * [1.0, 1e-3, 1e3][draw.below(3)]
    }

    #[test]
    fn four_at_a_time_make_the_bits_of_one_by_one() {
        let mut number = numbers();
        let scene =
            crate::scene::parse("Scene(name: \"one\", spheres: [Sphere(x: (0, 0, 0), mass: 1, radius: 1)])", "one");
        let model = Model::new(&scene.expect("a valid scene"));
        let mut records = Trajectories::new(&model, &model.initial).records;
        records.resize(MOST, records[0]);
        for round in 0..2000 {
            let mut point = || dvec3(number(), number(), number());
            for record in &mut records {
                (record.trajectory.x, record.trajectory.v, record.trajectory.t) = (point(), point(), point().x);
                record.trajectory.r = point().y.abs();
            }
            let a = if round % 2 == 0 { DVec3::ZERO } else { point() };
            let path = Path { x: point(), v: point(), a };
            let query = Query { path: &path, r: 0.5, now: 1.5 };
            let slots: Vec<u32> = (0..MOST as u32).rev().collect();
            let (mut wide, mut plain) = ([PairBatch::NEVER; BATCHES], [PairBatch::NEVER; BATCHES]);
            let found = Simd::new().look(query, &records, &slots, &mut wide);
            assert_eq!(found, Simd::plain().look(query, &records, &slots, &mut plain));
            assert_eq!(wide, plain);
        }
    }

    #[test]
    fn eight_at_once_are_judged_as_one_by_one() {
        struct Both(Eight, usize, f64);
        impl MinTreeJob for Both {
            type Output = [(f64, u32); 2];
            fn run(mut self, minimum: impl MinOfEight) -> [(f64, u32); 2] {
                [minimum.exchange(&mut self.0, self.1, self.2), minimum.of(&self.0)]
            }
        }
        let mut number = numbers();
        for round in 0..2000 {
            // few different times, so that some are equal
            let mut few = || (4.0 * number()).round();
            let (times, time) = (Eight([0; 8].map(|_| few())), few());
            let mut then = times.0;
            then[round % 8] = time;
            let least = then.into_iter().fold(f64::INFINITY, f64::min);
            let expected = [(least, (0..8).map(|k| u32::from(then[k] == least) << k).sum()); 2];
            assert_eq!(Simd::new().run(Both(times, round % 8, time)), expected);
            assert_eq!(Both(times, round % 8, time).run(Plain), expected);
        }
    }
}
