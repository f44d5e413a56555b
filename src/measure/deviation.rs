//! How far one run is from another: positions, impact times, order of impacts.

use glam::DVec3;

use super::sample::Impact;
use crate::physics::contact::Key;

/// Impacts closer than this, s, have no order: mirror-simultaneous ones come in either.
const SIMULTANEOUS: f64 = 1e-9;

/// Impacts whose times are compared: later ones carry what all earlier ones did.
const FIRST: usize = 10;

/// The largest deviation of positions between two runs of one scene at one time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Deviation {
    /// Largest |x − x_ref|, m.
    pub distance: f64,
    /// Sphere that deviates most; the first one if all agree.
    pub sphere: usize,
}

impl Deviation {
    /// The deviation between two lists of centres (m) in the same order, at the same time. A position that is no number is
    /// infinitely far off.
    pub fn between(x: &[DVec3], reference: &[DVec3]) -> Deviation {
        let mut largest = Deviation::default();
        for (sphere, (x, x_ref)) in x.iter().zip(reference).enumerate() {
            let apart = x.distance(*x_ref);
            let distance = if apart.is_nan() { f64::INFINITY } else { apart };
            if distance > largest.distance {
                largest = Deviation { distance, sphere };
            }
        }
        largest
    }
}

/// The largest time error of the reference's first 10 impacts, s. The n-th impact of two bodies is compared with the
/// n-th of the same two, so that the order of others does not matter. None if the run lacks one of them, or if there
/// are none.
pub fn impact_time_error(run: &[Impact], reference: &[Impact]) -> Option<f64> {
    let mut largest = None;
    for (index, wanted) in reference.iter().take(FIRST).enumerate() {
        let before = reference[..index].iter().filter(|impact| impact.key == wanted.key).count();
        let found = run.iter().filter(|impact| impact.key == wanted.key).nth(before)?;
        let error = (found.time - wanted.time).abs();
        largest = Some(largest.map_or(error, |largest: f64| largest.max(error)));
    }
    largest
}

/// How many impacts, from the first on, happen between the same bodies in the same order. Impacts of the reference
/// closer than 1e-9 s count as a set.
pub fn common_impacts(run: &[Impact], reference: &[Impact]) -> usize {
    let mut common = 0;
    for set in reference.chunk_by(|a, b| b.time - a.time <= SIMULTANEOUS) {
        let mut wanted: Vec<Key> = set.iter().map(|impact| impact.key).collect();
        for impact in run.iter().skip(common).take(set.len()) {
            let Some(place) = wanted.iter().position(|key| *key == impact.key) else { return common };
            wanted.swap_remove(place);
            common += 1;
        }
        if !wanted.is_empty() {
            return common;
        }
    }
    common
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Kind;

    fn impacts(list: &[(f64, usize)]) -> Vec<Impact> {
        list.iter().map(|&(time, b)| Impact { time, key: (Kind::Wall, 0, b) }).collect()
    }

    #[test]
    fn the_largest_deviation_names_its_sphere() {
        let (a, b) = ([DVec3::ZERO, DVec3::X, DVec3::Y], [DVec3::ZERO, DVec3::X * 1.5, DVec3::Y * 1.25]);
        assert_eq!(Deviation::between(&a, &b), Deviation { distance: 0.5, sphere: 1 });
        assert_eq!(Deviation::between(&[DVec3::NAN], &[DVec3::ZERO]).distance, f64::INFINITY);
    }

    #[test]
    fn impacts_closer_than_a_nanosecond_have_no_order() {
        let reference = impacts(&[(1.0, 0), (2.0, 1), (2.0 + 1e-10, 2), (3.0, 0)]);
        let flipped = impacts(&[(1.0, 0), (1.9, 2), (2.1, 1), (3.0, 0)]);
        assert_eq!(common_impacts(&flipped, &reference), 4);
        let late = impacts(&[(1.0, 0), (1.9, 2), (2.1, 0)]);
        assert_eq!(common_impacts(&late, &reference), 2);
        assert_eq!(common_impacts(&impacts(&[(1.0, 0), (2.0, 1)]), &reference), 2);
        assert_eq!(common_impacts(&[], &reference), 0);
    }

    #[test]
    fn the_time_error_is_that_of_the_same_impact_of_the_same_bodies() {
        let reference = impacts(&[(1.0, 0), (2.0, 1), (3.0, 0)]);
        let run = impacts(&[(1.25, 0), (2.5, 0), (2.0, 1)]);
        assert_eq!(impact_time_error(&run, &reference), Some(0.5));
        assert_eq!(impact_time_error(&run[..1], &reference), None, "an impact is missing");
        assert_eq!(impact_time_error(&run, &[]), None, "there is nothing to compare");
    }

    #[test]
    fn only_the_first_ten_impacts_are_timed() {
        let reference: Vec<Impact> = impacts(&(0..20).map(|k| (f64::from(k), 0)).collect::<Vec<_>>());
        let mut run = reference.clone();
        run[10].time += 100.0;
        run.truncate(11);
        assert_eq!(impact_time_error(&run, &reference), Some(0.0));
    }
}
