//! What contacts that hold an island leave of its spheres' velocities or accelerations u: w = u + Σ λ J with λ ≥ 0, rate ≥
//! 0, and λ = 0 where rate > 0, where J pushes both bodies of a contact apart by their masses, and the rate is n · (w_a −
//! w_b) and what curvature adds. Every set of contacts is tried; w is the same for all that fit.

use super::double::Double;
use super::vector::Vector;

/// Most contacts that hold one island here: a thousand sets.
pub(super) const MOST_CONTACTS: usize = 10;

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

/// What is left of `u`, by sphere, and what becomes of each contact; none if no set of contacts fits.
pub(super) fn held(u: &[Vector], masses: &[Double], props: &[Prop]) -> Option<Kept> {
    let largest = u.iter().map(|u| u.length()).chain(props.iter().map(|prop| prop.bias.abs()));
    let small = Double::from(ROUNDING) * largest.fold(Double::ZERO, |most, size| if size > most { size } else { most });
    (0..1_u32 << props.len()).find_map(|set| {
        let chosen: Vec<Prop> = (0..props.len()).filter(|k| set >> k & 1 == 1).map(|k| props[k]).collect();
        let forces = forces(u, masses, &chosen)?;
        let mut w = u.to_vec();
        for (prop, force) in chosen.iter().zip(&forces) {
            w[prop.body] = w[prop.body] + prop.normal * (*force / masses[prop.body]);
            if let Some(other) = prop.other {
                w[other] = w[other] - prop.normal * (*force / masses[other]);
            }
        }
        let pushes = |(force, prop): (&Double, &Prop)| *force / masses[prop.body] >= -small;
        let fits = forces.iter().zip(&chosen).all(pushes) && props.iter().all(|prop| prop.rate(&w) >= -small);
        let push = |k: usize| (0..k).filter(|k| set >> k & 1 == 1).count();
        let is_push = |k: usize| set >> k & 1 == 1 && forces[push(k)] / masses[props[k].body] > small;
        fits.then(|| Kept {
            closed: props.iter().map(|prop| prop.rate(&w) <= small).collect(),
            pushes: (0..props.len()).map(is_push).collect(),
            left: w,
        })
    })
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
