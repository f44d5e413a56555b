//! Random numbers that are the same on every machine: only integers, + − × ÷ √, in a fixed order.

use glam::DVec3;

/// SplitMix64 (Steele, Lea and Flood, 2014): one 64-bit word of state, every seed as good as the next.
#[derive(Debug, Clone)]
pub struct SplitMix64(u64);

impl SplitMix64 {
    /// The stream of a seed.
    pub fn new(seed: u64) -> SplitMix64 {
        SplitMix64(seed)
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// The next number in [0, 1): the top 53 bits, over 2⁵³.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Three numbers in [0, 1), x first.
    pub fn units(&mut self) -> DVec3 {
        let x = self.unit();
        let y = self.unit();
        DVec3::new(x, y, self.unit())
    }

    /// A number of mean 0 and variance 1, nearly normal: the sum of twelve units minus six. No logarithm, no cosine,
    /// hence the same bits everywhere; no value beyond ±6.
    pub fn normal(&mut self) -> f64 {
        (0..12).fold(-6.0, |sum, _| sum + self.unit())
    }

    /// A whole number in [0, bound).
    pub fn below(&mut self, bound: usize) -> usize {
        ((self.unit() * bound as f64) as usize).min(bound - 1)
    }

    /// The next number in [−1, 1): the top 53 bits, over 2⁵², less one.
    pub fn centered(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// A direction, evenly over the sphere: points of the cube until one lies in the ball. Its length is 1 to rounding.
    pub fn unit_vector(&mut self) -> DVec3 {
        loop {
            let x = self.centered();
            let y = self.centered();
            let point = DVec3::new(x, y, self.centered());
            let length = point.length();
            if (0.1..=1.0).contains(&length) {
                return point / length;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splitmix64_gives_the_published_numbers() {
        // Sebastiano Vigna's splitmix64.c with seed 1234567, as listed at Rosetta Code ("Pseudo-random numbers/Splitmix64").
        let mut draw = SplitMix64::new(1_234_567);
        let published: [u64; 5] = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
            4_593_380_528_125_082_431,
            16_408_922_859_458_223_821,
        ];
        assert_eq!(published.map(|_| draw.bits()), published);
        // The first words for seed 0, as in Java's SplittableRandom and the test vectors of xoshiro's authors.
        let mut draw = SplitMix64::new(0);
        assert_eq!([draw.bits(), draw.bits()], [0xe220_a839_7b1d_cdaf, 0x6e78_9e6a_a1b9_65f4]);
    }

    #[test]
    fn directions_are_unit_vectors_and_repeat() {
        let directions = || [0; 9].map(|_| SplitMix64::new(7).unit_vector());
        assert_eq!(directions(), directions());
        // Division by the length rounds each coordinate once: 3 half units in the last place.
        assert!(directions().iter().all(|way| (way.length() - 1.0).abs() < 4e-16));
    }

    #[test]
    fn units_fill_their_interval_evenly() {
        let mut draw = SplitMix64::new(3);
        let (n, bins) = (100_000, 10);
        let mut counted = vec![0_u32; bins];
        for _ in 0..n {
            counted[(draw.unit() * bins as f64) as usize] += 1;
        }
        // Expected 10 000 each, standard deviation 95: five of them.
        assert!(counted.iter().all(|&count| count.abs_diff(10_000) < 475), "{counted:?}");
    }
}
