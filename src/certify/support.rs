//! What contacts that hold an island leave of its spheres' velocities or accelerations u: w = u + Σ λ J with λ ≥ 0, rate ≥
//! 0, and λ = 0 where rate > 0, where J pushes both bodies of a contact apart by their masses, and the rate is n · (w_a −
//! w_b) and what curvature adds. w is the same for all sets of contacts that push and fit: of few contacts every set is tried, of
//! more a search proposes one, and either way what is found is held against all three conditions.

use super::vector::Vector;
use crate::double::Double;

/// Most contacts of which every set is tried: a thousand sets.
const MOST_TRIED: usize = 10;

/// Most contacts that hold one island here: a search among more takes seconds.
pub(super) const MOST_CONTACTS: usize = 200;

/// As how many looks at pairs of bodies (30 ns each) what holds so many contacts counts: so many eliminations are made, of up to as
/// many rows, and every third row costs a look.
pub(super) fn looks(contacts: usize) -> u64 {
    if contacts <= MOST_TRIED { 0 } else { (contacts as u64).pow(4) / 36 }
}

/// A part of |u| that stands for rounding: a thousand times what the sums here round.
pub(super) const ROUNDING: f64 = 1e-27;

/// A contact of an island.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Prop {
    /// Index in the island.
    pub(super) body: usize,
    /// The second sphere; none if it is a wall.
    pub(super) other: Option<usize>,
    /// Unit normal, towards `body`.
    pub(super) normal: Vector,
    /// What the rate has besides n · (w_a − w_b).
    pub(super) bias: Double,
}

impl Prop {
    fn rate(&self, w: &[Vector]) -> Double {
        let relative = self.other.map_or(w[self.body], |other| w[self.body] - w[other]);
        self.normal.dot(relative) + self.bias
    }

    /// What a unit force at `self` does to the rate of `of`.
    fn acts(&self, of: &Prop, masses: &[Double]) -> Double {
        let sides = |prop: &Prop| [(Some(prop.body), prop.normal), (prop.other, -prop.normal)];
        let mut sum = Double::ZERO;
        for (one, push) in sides(self) {
            for (two, normal) in sides(of) {
                if let Some(body) = one.filter(|_| one == two) {
                    sum = sum + push.dot(normal) / masses[body];
                }
            }
        }
        sum
    }
}

/// What contacts leave of velocities or accelerations.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Kept {
    /// What is left, by sphere.
    pub(super) left: Vec<Vector>,
    /// By contact, whether it stays closed.
    pub(super) closed: Vec<bool>,
    /// By contact, whether it pushes.
    pub(super) pushes: Vec<bool>,
}

/// What is left of `u`, by sphere, and what becomes of each contact; none if no set of contacts fits, or the search finds none.
pub(super) fn held(u: &[Vector], masses: &[Double], props: &[Prop]) -> Option<Kept> {
    let largest = u.iter().map(|u| u.length()).chain(props.iter().map(|prop| prop.bias.abs()));
    let small = Double::from(ROUNDING) * largest.fold(Double::ZERO, |most, size| if size > most { size } else { most });
    let island = Props { u, masses, props, small };
    if props.len() > MOST_TRIED {
        return island.fits(&island.search()?);
    }
    (0..1_u32 << props.len()).find_map(|set| {
        let chosen: Vec<usize> = (0..props.len()).filter(|k| set >> k & 1 == 1).collect();
        island.fits(&chosen)
    })
}

/// An island's contacts, and what presses on them.
struct Props<'a> {
    u: &'a [Vector],
    masses: &'a [Double],
    props: &'a [Prop],
    /// What stands for rounding of `u`.
    small: Double,
}

impl Props<'_> {
    fn forces(&self, set: &[usize]) -> Option<Vec<Double>> {
        let chosen: Vec<Prop> = set.iter().map(|&k| self.props[k]).collect();
        forces(self.u, self.masses, &chosen)
    }

    /// What forces in a set of contacts leave of `u`.
    fn pushed(&self, set: &[usize], forces: &[Double]) -> Vec<Vector> {
        let mut w = self.u.to_vec();
        for (prop, &force) in set.iter().map(|&k| &self.props[k]).zip(forces) {
            w[prop.body] = w[prop.body] + prop.normal * (force / self.masses[prop.body]);
            if let Some(other) = prop.other {
                w[other] = w[other] - prop.normal * (force / self.masses[other]);
            }
        }
        w
    }

    /// What is left if a set of contacts pushes, should all three conditions hold.
    fn fits(&self, set: &[usize]) -> Option<Kept> {
        let forces = self.forces(set)?;
        let w = self.pushed(set, &forces);
        let of_mass = |(k, force): (&usize, &Double)| *force / self.masses[self.props[*k].body];
        let push = set.iter().zip(&forces).all(|pair| of_mass(pair) >= -self.small);
        if !push || self.props.iter().any(|prop| prop.rate(&w) < -self.small) {
            return None;
        }
        let mut pushes = vec![false; self.props.len()];
        set.iter().zip(&forces).for_each(|pair| pushes[*pair.0] = of_mass(pair) > self.small);
        Some(Kept { closed: self.props.iter().map(|prop| prop.rate(&w) <= self.small).collect(), pushes, left: w })
    }

    /// A set of contacts that may fit, by the method of Lawson and Hanson (Solving Least Squares Problems, 1974): the contact that is
    /// pressed most is taken in, and those that would have to pull are given up on the way to the forces of the new set.
    fn search(&self) -> Option<Vec<usize>> {
        let (mut set, mut found): (Vec<usize>, Vec<Double>) = (Vec::new(), Vec::new());
        for _ in 0..3 * self.props.len() {
            let w = self.pushed(&set, &found);
            let pressed = (0..self.props.len()).filter(|k| !set.contains(k)).map(|k| (k, self.props[k].rate(&w)));
            let worst = pressed.reduce(|one, other| if other.1 < one.1 { other } else { one });
            let Some((worst, _)) = worst.filter(|(_, rate)| *rate < -self.small) else { return Some(set) };
            set.push(worst);
            found.push(Double::ZERO);
            loop {
                let wanted = self.forces(&set)?;
                if wanted.iter().all(|force| *force > Double::ZERO) {
                    found = wanted;
                    break;
                }
                give_up(&mut set, &mut found, &wanted);
            }
        }
        None
    }
}

/// Goes from forces that push towards `wanted` ones as far as all push, and gives up the contact that ends it.
fn give_up(set: &mut Vec<usize>, found: &mut Vec<Double>, wanted: &[Double]) {
    let part = |k: usize| found[k] / (found[k] - wanted[k]);
    let ends = (0..set.len()).filter(|&k| wanted[k] <= Double::ZERO);
    let Some(first) = ends.reduce(|one, other| if part(other) < part(one) { other } else { one }) else { return };
    // a force that is 0 and stays so goes at once
    let part = if found[first] > Double::ZERO { part(first) } else { Double::ZERO };
    for (force, &wanted) in found.iter_mut().zip(wanted) {
        *force = *force + (wanted - *force) * part;
    }
    set.remove(first);
    found.remove(first);
}

/// The forces of contacts that all stay closed, by elimination; none if their normals depend on each other.
pub(super) fn forces(u: &[Vector], masses: &[Double], props: &[Prop]) -> Option<Vec<Double>> {
    let count = props.len();
    let mut rows: Vec<Vec<Double>> = props
        .iter()
        .map(|prop| props.iter().map(|other| other.acts(prop, masses)).chain([-prop.rate(u)]).collect())
        .collect();
    let whole: Vec<Double> = (0..count).map(|k| rows[k][k]).collect();
    for k in 0..count {
        // of a matrix of products every pivot is the square of a distance: none, where normals depend on each other
        if rows[k][k] <= Double::from(1e-12) * whole[k] {
            return None;
        }
        let pivot = rows[k].clone();
        for row in rows.iter_mut().skip(k + 1) {
            let factor = row[k] / pivot[k];
            row.iter_mut().zip(&pivot).skip(k).for_each(|(value, above)| *value = *value - factor * *above);
        }
    }
    let mut found = vec![Double::ZERO; count];
    for k in (0..count).rev() {
        let rest = (k + 1..count).fold(rows[k][count], |sum, column| sum - rows[k][column] * found[column]);
        found[k] = rest / rows[k][k];
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::SplitMix64;

    #[test]
    fn a_search_finds_what_trying_every_set_finds() {
        let random = &mut SplitMix64::new(3);
        let (mut searched, mut pushing) = (0, 0);
        for _ in 0..300 {
            let bodies = 1 + (random.unit() * 4.0) as usize;
            let vector = |random: &mut SplitMix64| Vector::from(random.unit_vector());
            let u: Vec<Vector> = (0..bodies).map(|_| vector(random)).collect();
            let masses: Vec<Double> = (0..bodies).map(|_| Double::from(0.1 + 10.0 * random.unit())).collect();
            let props: Vec<Prop> = (0..1 + (random.unit() * 7.0) as usize)
                .map(|k| {
                    let body = k % bodies;
                    let other = (body + 1 + k / bodies) % bodies;
                    let other = (other != body).then_some(other);
                    Prop { body, other, normal: vector(random), bias: Double::ZERO }
                })
                .collect();
            let all = held(&u, &masses, &props).expect("w = 0 for all is possible");
            let island = Props { u: &u, masses: &masses, props: &props, small: Double::from(4.0 * ROUNDING) };
            let Some(found) = island.search().and_then(|set| island.fits(&set)) else { continue };
            searched += 1;
            pushing += found.pushes.iter().filter(|pushes| **pushes).count();
            for (one, other) in all.left.iter().zip(&found.left) {
                assert!((*one - *other).length().value() < 1e-24, "{one:?} {other:?}");
            }
            assert_eq!(all.closed, found.closed);
        }
        assert!(searched > 290 && pushing > 300, "{searched} of 300 are found, {pushing} contacts push");
    }
}
