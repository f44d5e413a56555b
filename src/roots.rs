//! Real roots of polynomials of degree four and less on an interval. No import of ours.
//!
//! Source: isolation by the roots of the derivative, then Newton's method kept inside a bracket by bisection (Press et
//! al., *Numerical Recipes*, 9.4–9.5); the quadratic by q = −(b + sign(b)√D)/2, which loses neither root to
//! cancellation. No dependency is needed for that.
//!
//! Assumes finite coefficients, lowest power first. Guarantees: roots ascending, inside the interval, and at each of
//! them the polynomial as evaluated in floating point changes sign within one representable step (so the residual is
//! that of rounding, also where roots are ill-conditioned). Limits: two roots closer than rounding may be reported as
//! none or one, so a tangency is not reliable; callers here never need one. Cost: a quartic takes
//! some tens of Newton steps. Only + − × ÷ √ and comparisons, so the bits are the same everywhere.

/// At most four roots, ascending.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Roots {
    roots: [f64; 4],
    count: usize,
}

impl Roots {
    /// Appends a root; a fifth, which rounding alone can suggest, is dropped.
    fn push(&mut self, root: f64) {
        if self.count < 4 {
            self.roots[self.count] = root;
            self.count += 1;
        }
    }
}

impl std::ops::Deref for Roots {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.roots[..self.count]
    }
}

/// The first t ≥ 0 at which c₀ + c₁ t + c₂ t² is ≤ 0 and falling, if any. Stable: q = −(b + sign(b)√D)/2.
#[inline]
pub fn quadratic_fall(c: [f64; 3]) -> Option<f64> {
    let [c0, c1, c2] = c;
    let half = 0.5 * c1;
    if half < 0.0 {
        if c0 <= 0.0 {
            return Some(0.0);
        }
        let discriminant = half * half - c0 * c2;
        // D = 0 only touches
        return (discriminant > 0.0).then(|| c0 / (discriminant.sqrt() - half));
    }
    if c2 >= 0.0 {
        return None;
    }
    // rises to the apex and falls from there on
    let discriminant = half * half - c0 * c2;
    if discriminant <= 0.0 { Some(-half / c2) } else { Some((half + discriminant.sqrt()) / -c2) }
}

/// Σ cᵢ tⁱ by Horner's rule.
pub fn value(c: &[f64], t: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, &k| sum * t + k)
}

/// Σ i cᵢ tⁱ⁻¹.
pub fn slope(c: &[f64], t: f64) -> f64 {
    let mut sum = 0.0;
    for i in (1..c.len()).rev() {
        sum = sum * t + c[i] * i as f64;
    }
    sum
}

/// Both real roots of c₂ t² + c₁ t + c₀, ascending; the one root of a straight line; none of a constant. A double root
/// is reported once.
pub fn quadratic(c: [f64; 3]) -> Roots {
    let mut roots = Roots::default();
    let [c0, c1, c2] = c;
    if c2 == 0.0 {
        if c1 != 0.0 {
            roots.push(-c0 / c1);
        }
        return roots;
    }
    let half = 0.5 * c1;
    let discriminant = half * half - c2 * c0;
    if discriminant < 0.0 {
        return roots;
    }
    // q has the sign of −b, so nothing cancels; q = 0 only where b = D = 0
    let q = if half < 0.0 { -half + discriminant.sqrt() } else { -half - discriminant.sqrt() };
    if q == 0.0 {
        roots.push(0.0);
        return roots;
    }
    let (one, two) = (q / c2, c0 / q);
    roots.push(one.min(two));
    if one != two {
        roots.push(one.max(two));
    }
    roots
}

/// Every real root in [lo, hi] at which the polynomial changes sign, ascending. Degree four at most; `hi` may be
/// infinite.
pub fn in_interval(c: &[f64], lo: f64, hi: f64) -> Roots {
    let mut roots = Roots::default();
    let c = trimmed(c);
    if let &[c0, c1, c2] = c {
        quadratic([c0, c1, c2]).iter().filter(|&&t| lo <= t && t <= hi).for_each(|&t| roots.push(t));
        return roots;
    }
    let hi = if hi.is_finite() { hi } else { lo.max(bound(c)) };
    for [from, to] in monotone(c, lo, hi).pieces() {
        let (below, above) = (value(c, from), value(c, to));
        if below != 0.0 && (below < 0.0) != (above <= 0.0) || below == 0.0 && from == lo {
            roots.push(bracketed(c, from, to));
        } else if above == 0.0 && below > 0.0 {
            roots.push(to);
        }
    }
    roots
}

/// The polynomial without vanishing highest powers.
pub fn trimmed(c: &[f64]) -> &[f64] {
    let degree = c.iter().rposition(|&k| k != 0.0).unwrap_or(0);
    &c[..=degree.min(c.len().saturating_sub(1))]
}

/// The ends of the stretches of [lo, hi] on which a polynomial of degree four at most is monotone.
#[derive(Debug, Clone, Copy)]
pub struct Monotone {
    ends: [f64; 5],
    count: usize,
}

impl Monotone {
    /// The stretches [from, to], in order; empty ones are left out.
    pub fn pieces(&self) -> impl Iterator<Item = [f64; 2]> {
        let Monotone { ends, count } = *self;
        (1..count).map(move |k| [ends[k - 1], ends[k]]).filter(|[from, to]| from < to)
    }
}

/// Cuts [lo, hi] (finite) at the roots of the derivative.
pub fn monotone(c: &[f64], lo: f64, hi: f64) -> Monotone {
    let mut ends = [lo; 5];
    let mut count = 1;
    if c.len() > 2 {
        let mut derivative = [0.0; 4];
        for i in 1..c.len() {
            derivative[i - 1] = c[i] * i as f64;
        }
        for &t in in_interval(&derivative[..c.len() - 1], lo, hi).iter().take(3) {
            ends[count] = t;
            count += 1;
        }
    }
    ends[count] = hi;
    Monotone { ends, count: count + 1 }
}

/// A number that no positive root exceeds: Fujiwara's bound 2 max |cₙ₋ₖ/cₙ|^(1/k), the cube root replaced by a larger
/// root that needs only √.
pub fn bound(c: &[f64]) -> f64 {
    let c = trimmed(c);
    let degree = c.len() - 1;
    let mut largest = 0.0_f64;
    for k in 1..=degree {
        let ratio = (c[degree - k] / c[degree]).abs();
        let root = match k {
            1 => ratio,
            2 => ratio.sqrt(),
            3 if ratio > 1.0 => ratio.sqrt(),
            _ => ratio.sqrt().sqrt(),
        };
        largest = largest.max(root);
    }
    (2.0 * largest).min(f64::MAX)
}

/// The root of a polynomial that is monotone on [lo, hi] and changes sign there: Newton's steps, replaced by bisection
/// whenever they would leave the bracket or shrink too slowly. Ends when no representable number is left between the
/// ends of the bracket, or when a step no longer moves t.
pub fn bracketed(c: &[f64], lo: f64, hi: f64) -> f64 {
    let (mut lo, mut hi) = (lo, hi);
    let at_lo = value(c, lo);
    if at_lo == 0.0 {
        return lo;
    }
    let rising = at_lo < 0.0;
    let mut t = lo + 0.5 * (hi - lo);
    let mut last_step = hi - lo;
    // 2100 halvings separate any two doubles; Newton needs some ten steps
    for _ in 0..2100 {
        let f = value(c, t);
        if f == 0.0 {
            return t;
        }
        if (f < 0.0) == rising {
            lo = t
        } else {
            hi = t
        }
        let newton = t - f / slope(c, t);
        let step = (newton - t).abs();
        let next = if newton > lo && newton < hi && step < 0.5 * last_step { newton } else { lo + 0.5 * (hi - lo) };
        last_step = (next - t).abs();
        if next == t || next <= lo || next >= hi {
            return next;
        }
        t = next;
    }
    t
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::{prelude::*, test_runner::RngSeed};

    #[test]
    fn the_later_root_of_a_nearly_linear_quadratic_is_not_lost_to_cancellation() {
        // x² − (1e9 + 1e-9) x + 1: roots 1e-9 and 1e9; the textbook formula returns 0 for the first
        let roots = quadratic([1.0, -(1e9 + 1e-9), 1.0]);
        assert_eq!(roots.len(), 2);
        assert!((roots[0] - 1e-9).abs() < 1e-24 && (roots[1] - 1e9).abs() < 1e-6);
    }

    #[test]
    fn a_quartic_with_four_known_roots_gives_them_in_order() {
        // (t−1)(t−2)(t−3)(t−4)
        let roots = in_interval(&[24.0, -50.0, 35.0, -10.0, 1.0], 0.0, f64::INFINITY);
        assert_eq!(roots.len(), 4);
        for (root, expected) in roots.iter().zip([1.0, 2.0, 3.0, 4.0]) {
            // condition of these roots: below 1e3 ulp
            assert!((root - expected).abs() < 1e-12);
        }
    }

    #[test]
    fn vanishing_leading_coefficients_lower_the_degree() {
        assert_eq!(&*in_interval(&[-6.0, 3.0, 0.0, 0.0, 0.0], 0.0, 10.0), &[2.0]);
        assert_eq!(&*in_interval(&[-4.0, 0.0, 1.0, 0.0, 0.0], 0.0, 10.0), &[2.0]);
        assert!(in_interval(&[1.0, 0.0, 0.0, 0.0, 0.0], 0.0, 10.0).is_empty());
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 20_000, rng_seed: RngSeed::Fixed(4), failure_persistence: None, ..ProptestConfig::default() })]

        /// The oracle knows the roots because it multiplied the factors.
        #[test]
        fn well_separated_roots_of_a_product_are_all_found(
            gaps in prop::array::uniform4(0.3f64..3.0), size in 1e-3f64..1e3, negative in any::<bool>(),
        ) {
            let lead = if negative { -size } else { size };
            let mut c = [lead, 0.0, 0.0, 0.0, 0.0];
            let mut root = 0.0;
            let mut expected = Vec::new();
            for (k, gap) in gaps.iter().enumerate() {
                root += gap;
                expected.push(root);
                for i in (0..=k).rev() {
                    c[i + 1] += c[i];
                    c[i] *= -root;
                }
            }
            let found = in_interval(&c, 0.0, f64::INFINITY);
            prop_assert_eq!(found.len(), 4, "{:?} of {:?}", found, expected);
            for (t, e) in found.iter().zip(&expected) {
                // rounding of the coefficients moves a root by ~ 1e-16 · 12⁴ / 0.3³ ~ 1e-10
                prop_assert!((t - e).abs() < 1e-6, "{} against {}", t, e);
            }
        }
    }
}
