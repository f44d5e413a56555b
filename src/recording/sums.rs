//! Two sums over the bits of a state: enough to see any difference, and to name the sphere if it is one alone.

use glam::DVec3;

use crate::physics::State;

/// Two sums over the bits of a state, modulo 2³²: of one word per body, and of that word times an odd number of its own.
/// The time counts as one more body. A change of one body by d changes them by d and by its number times d.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sums([u32; 2]);

/// What differs between two states, as far as their sums tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Suspect {
    /// One sphere alone, by its index.
    Sphere(usize),
    /// The time alone.
    Time,
    /// More than one body, or the sums themselves.
    Several,
}

impl Sums {
    /// Bytes that the sums take in a file.
    pub const BYTES: usize = 8;

    /// The sums of a state.
    pub fn of(state: &State) -> Sums {
        let bodies = state.x.iter().zip(&state.v).map(|(x, v)| word(&[*x, *v]));
        let time = word(&[DVec3::splat(state.t)]);
        let mut sums = [0_u32; 2];
        for (index, word) in bodies.chain([time]).enumerate() {
            sums[0] = sums[0].wrapping_add(word);
            sums[1] = sums[1].wrapping_add(word.wrapping_mul(number(index)));
        }
        Sums(sums)
    }

    /// The sums as bytes, lowest first.
    pub fn to_bytes(self) -> [u8; Sums::BYTES] {
        let [a, b] = self.0.map(u32::to_le_bytes);
        [a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]]
    }

    /// The sums that these bytes are.
    pub fn from_bytes(bytes: [u8; Sums::BYTES]) -> Sums {
        let [a, b, c, d, e, f, g, h] = bytes;
        Sums([u32::from_le_bytes([a, b, c, d]), u32::from_le_bytes([e, f, g, h])])
    }

    /// What differs from `other`, the sums of as many spheres; none if nothing does.
    pub fn suspect(self, other: Sums, spheres: usize) -> Option<Suspect> {
        if self == other {
            return None;
        }
        let [change, weighed] = [0, 1].map(|k| self.0[k].wrapping_sub(other.0[k]));
        let mut fits = (0..=spheres).filter(|&index| change != 0 && change.wrapping_mul(number(index)) == weighed);
        Some(match (fits.next(), fits.next()) {
            (Some(index), None) if index == spheres => Suspect::Time,
            (Some(index), None) => Suspect::Sphere(index),
            _ => Suspect::Several,
        })
    }
}

/// The odd number that the word of a body is multiplied by in the second sum.
fn number(index: usize) -> u32 {
    (index as u32).wrapping_mul(2).wrapping_add(1)
}

/// A word of the bits of vectors: each bit of them changes about half of its bits.
fn word(vectors: &[DVec3]) -> u32 {
    let bits = vectors.iter().flat_map(|v| v.to_array()).map(f64::to_bits);
    let hash = bits.fold(0x9e37_79b9_7f4a_7c15_u64, |hash, bits| {
        let mixed = (hash ^ bits).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed ^ (mixed >> 29)
    });
    (hash ^ (hash >> 32)) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(spheres: usize) -> State {
        let at = |i: usize| DVec3::new(i as f64, 0.1 * i as f64, -1.0 / (i as f64 + 1.0));
        State { t: 1.5, x: (0..spheres).map(at).collect(), v: (0..spheres).map(|i| at(i) * 3.0).collect() }
    }

    #[test]
    fn one_changed_bit_names_its_sphere_or_the_time() {
        for spheres in [1, 2, 64, 1000] {
            let sums = Sums::of(&state(spheres));
            assert_eq!(sums.suspect(sums, spheres), None);
            for index in [0, spheres / 2, spheres - 1] {
                for bit in [0, 1, 31, 51, 63] {
                    let mut other = state(spheres);
                    other.x[index].y = f64::from_bits(other.x[index].y.to_bits() ^ (1 << bit));
                    assert_eq!(Sums::of(&other).suspect(sums, spheres), Some(Suspect::Sphere(index)), "bit {bit}");
                }
            }
            let later = State { t: 1.5_f64.next_up(), ..state(spheres) };
            assert_eq!(Sums::of(&later).suspect(sums, spheres), Some(Suspect::Time));
        }
    }

    #[test]
    fn two_changed_spheres_are_several() {
        let (sums, mut other) = (Sums::of(&state(10)), state(10));
        (other.x[2].x, other.v[7].z) = (9.0, 9.0);
        assert_eq!(Sums::of(&other).suspect(sums, 10), Some(Suspect::Several));
    }

    #[test]
    fn the_bytes_give_the_sums_back() {
        let sums = Sums::of(&state(5));
        assert_eq!(Sums::from_bytes(sums.to_bytes()), sums);
    }
}
