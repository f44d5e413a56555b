//! The polynomial between the ends of an arc, and the two roots that arcs need.

use glam::DVec3;

/// The path x + v t + a t²/2 + s³ (b₃ + b₄ s + b₅ s²), m, with s = t/span.
pub(crate) struct Hermite {
    pub(crate) x: DVec3,
    pub(crate) v: DVec3,
    pub(crate) a: DVec3,
    pub(crate) b: [DVec3; 3],
    pub(crate) span: f64,
}

impl Hermite {
    /// Position (m) and velocity (m/s) at `t`, s.
    pub(crate) fn read(&self, t: f64) -> (DVec3, DVec3) {
        let (s, [b3, b4, b5]) = (t / self.span, self.b);
        let x = self.x + (self.v + self.a * (0.5 * t)) * t + (b3 + (b4 + b5 * s) * s) * (s * s * s);
        let v = self.v + self.a * t + (b3 * 3.0 + (b4 * 4.0 + b5 * (5.0 * s)) * s) * (s * s / self.span);
        (x, v)
    }

    /// Acceleration (m/s²) of the parabola that leaves the path at `from` with its velocity and meets it `h` seconds later:
    /// 2 (x_h − x₀ − v₀ h)/h² without the cancellation, which over a nanosecond would leave nothing but rounding.
    pub(crate) fn chord_acceleration(&self, from: f64, h: f64) -> DVec3 {
        let (s, d, [b3, b4, b5]) = (from / self.span, h / self.span, self.b);
        let square = (b3 * 3.0 + (b4 * 6.0 + b5 * (10.0 * s)) * s) * s;
        let cube = b3 + (b4 * 4.0 + b5 * (10.0 * s)) * s;
        let fourth = b4 + b5 * (5.0 * s);
        self.a + (square + (cube + (fourth + b5 * d) * d) * d) * (2.0 / (self.span * self.span))
    }

    /// Third derivative at `t` (s), m/s³.
    pub(crate) fn jerk(&self, t: f64) -> DVec3 {
        let (s, [b3, b4, b5]) = (t / self.span, self.b);
        (b3 * 6.0 + (b4 * 24.0 + b5 * (60.0 * s)) * s) / (self.span * self.span * self.span)
    }
}

/// The end of an interval no longer than `precision` in which `margin` falls below 0: between a time at which it is not
/// and a later one at which it is, each with its margin. By the rule of false position, halved where that creeps
/// (the Illinois method; Dowell, Jarratt, BIT 11, 168, 1971), and by bisection if that takes long.
pub(crate) fn fall_below_zero(margin: &impl Fn(f64) -> f64, good: (f64, f64), bad: (f64, f64), precision: f64) -> f64 {
    let ((mut from, mut above), (mut to, mut below)) = (good, bad);
    let mut side = 0;
    for count in 0..80 {
        if to - from <= precision {
            break;
        }
        let share = above / (above - below);
        // each end stays out of the way of the other: a root next to one end is then closed in from both
        let aside = (0.5 * precision / (to - from)).min(0.5);
        let share = if share.is_finite() && count < 40 { share.clamp(aside, 1.0 - aside) } else { 0.5 };
        let time = from + share * (to - from);
        let left = margin(time);
        if left < 0.0 {
            above *= if side < 0 { 0.5 } else { 1.0 };
            (to, below, side) = (time, left, -1);
        } else {
            below *= if side > 0 { 0.5 } else { 1.0 };
            (from, above, side) = (time, left, 1);
        }
    }
    to
}

/// Cube root of y ≥ 0 (∞ of ∞; 0 of what is too small for all its digits), by Newton's method from above: with + − × ÷
/// alone, equal on every machine.
pub(crate) fn cube_root(y: f64) -> f64 {
    if !(y >= f64::MIN_POSITIVE && y.is_finite()) {
        return if y < f64::MIN_POSITIVE { 0.0 } else { y };
    }
    // A third of the exponent, and of the mantissa for want of better: at most 6 % too much.
    let mut root = f64::from_bits(y.to_bits() / 3 + (1023_u64 << 52) / 3 * 2);
    loop {
        let next = (2.0 * root + y / (root * root)) / 3.0;
        if next >= root {
            return root;
        }
        root = next;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cube_root_is_one() {
        for y in [0.0, 1e-300, 1e-40, 0.3, 1.0, 2.0, 27.0, 1e40, 1e300, f64::INFINITY] {
            let root = cube_root(y);
            assert!(root == y || (root * root * root / y - 1.0).abs() < 1e-14, "∛{y} = {root}");
        }
    }

    #[test]
    fn the_fall_is_found_where_the_margin_turns_negative() {
        // A corner, as where one contact takes over from another, a root of high order, and one next to an end.
        let margins: [(&dyn Fn(f64) -> f64, f64); 4] = [
            (&|t| (0.3 - t).min(5.0 * (0.25 - t)), 0.25),
            (&|t| (0.7 - t) * (0.7 - t) * (0.7 - t), 0.7),
            (&|t| 1e-9 - t, 1e-9),
            (&|t| if t < 0.5 { 1.0 } else { -1e9 }, 0.5),
        ];
        for (margin, expected) in margins {
            let found = fall_below_zero(&margin, (0.0, margin(0.0)), (1.0, margin(1.0)), 1e-11);
            assert!(margin(found) < 0.0 && (found - expected).abs() <= 1e-11, "{found} instead of {expected}");
        }
    }
}

#[cfg(test)]
mod chord_tests {
    use super::*;

    #[test]
    fn a_chord_meets_the_path_at_both_ends_and_is_no_rounding_however_short() {
        let path = Hermite {
            x: DVec3::new(1.0, 2.0, 3.0),
            v: DVec3::new(0.3, -0.2, 0.1),
            a: DVec3::new(1.0, -9.8, 0.5),
            b: [DVec3::new(0.1, 0.2, -0.3), DVec3::new(-0.2, 0.1, 0.4), DVec3::new(0.05, -0.3, 0.1)],
            span: 0.5,
        };
        for (from, h) in [(0.0, 0.5), (0.1, 0.2), (0.3, 0.2)] {
            let (x, v) = path.read(from);
            let a = path.chord_acceleration(from, h);
            let end = x + v * h + a * (0.5 * h * h);
            // Some twenty operations on numbers below 4.
            assert!(end.distance(path.read(from + h).0) < 1e-14, "{end}");
        }
        // Over a picosecond it is the path's own acceleration, but for its jerk times a third of that.
        let own = path.a + (path.b[0] * 6.0 + (path.b[1] * 12.0 + path.b[2] * (20.0 * 0.2)) * 0.2) * (0.2 / 0.25);
        let short = path.chord_acceleration(0.1, 1e-12);
        assert!(short.distance(own) < 1e-10, "{short} instead of {own}");
    }
}
