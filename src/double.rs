//! Numbers of twice the length of an `f64`: the unevaluated sum of two, some 32 digits.
//!
//! Every operation is a published one whose error is proven for all operands that neither overflow nor underflow; u is
//! 2⁻⁵³. The sum of two `f64` is exact (Knuth, TAOCP 2, 4.2.2, theorem B), so is their product (Veltkamp's splitting and
//! Dekker's product, Numer. Math. 18, 224, 1971; no fused operation, so that all machines have the same bits). The rest is
//! from Joldes, Muller, Popescu, ACM Trans. Math. Softw. 44, 15res, 2017: sum (algorithm 6, relative error at most 3 u² +
//! 13 u³), product (10, at most 7 u²; Muller, Rideau, ibid. 48, 9, 2022, prove 5 u²), quotient (17, at most 15 u² + 56 u³).
//! The root is Dekker's: one Newton step from the `f64` root, whose square is taken exactly; at most 25/8 u² (Lefèvre et
//! al., ibid. 49, 2023).

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// `high` + `low`, of which `high` is the nearest `f64`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Double {
    high: f64,
    low: f64,
}

/// The sum, and what rounding took from it.
#[inline]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    (sum, (a - (sum - b_part)) + (b - b_part))
}

/// The sum of |a| ≥ |b|, or a = 0, and what rounding took from it.
#[inline]
fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// Two halves of at most 26 bits whose sum is `a`.
#[inline]
fn split(a: f64) -> (f64, f64) {
    let scaled = 134_217_729.0 * a; // 2²⁷ + 1
    let high = scaled - (scaled - a);
    (high, a - high)
}

/// The product, and what rounding took from it.
#[inline]
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a1, a2), (b1, b2)) = (split(a), split(b));
    (product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2)
}

impl Double {
    /// The number 0.
    pub const ZERO: Double = Double { high: 0.0, low: 0.0 };
    /// The number 1.
    pub const ONE: Double = Double { high: 1.0, low: 0.0 };

    /// The nearest `f64`.
    #[inline]
    pub fn value(self) -> f64 {
        self.high
    }

    /// What the nearest `f64` lacks.
    #[inline]
    pub fn rest(self) -> f64 {
        self.low
    }

    /// The square root; not a number below 0.
    #[inline]
    pub fn sqrt(self) -> Double {
        if self == Double::ZERO {
            return self;
        }
        let root = self.high.sqrt();
        let (square, lost) = two_product(root, root);
        let left = ((self.high - square) - lost) + self.low;
        let (high, low) = fast_two_sum(root, left / (2.0 * root));
        Double { high, low }
    }

    /// Half of the number, exactly.
    #[inline]
    pub fn half(self) -> Double {
        Double { high: 0.5 * self.high, low: 0.5 * self.low }
    }

    /// Magnitude of the number.
    #[inline]
    pub fn abs(self) -> Double {
        if self.high < 0.0 { -self } else { self }
    }
}

impl From<f64> for Double {
    #[inline]
    fn from(high: f64) -> Double {
        Double { high, low: 0.0 }
    }
}

impl Neg for Double {
    type Output = Double;

    #[inline]
    fn neg(self) -> Double {
        Double { high: -self.high, low: -self.low }
    }
}

impl Add for Double {
    type Output = Double;

    #[inline]
    fn add(self, other: Double) -> Double {
        let (high, lost) = two_sum(self.high, other.high);
        let (low, lost_low) = two_sum(self.low, other.low);
        let (high, low) = fast_two_sum(high, lost + low);
        let (high, low) = fast_two_sum(high, low + lost_low);
        Double { high, low }
    }
}

impl Sub for Double {
    type Output = Double;

    #[inline]
    fn sub(self, other: Double) -> Double {
        self + -other
    }
}

impl Mul for Double {
    type Output = Double;

    #[inline]
    fn mul(self, other: Double) -> Double {
        let (high, lost) = two_product(self.high, other.high);
        let (high, low) = fast_two_sum(high, lost + (self.high * other.low + self.low * other.high));
        Double { high, low }
    }
}

impl Div for Double {
    type Output = Double;

    #[inline]
    fn div(self, other: Double) -> Double {
        let high = self.high / other.high;
        let (product, lost) = two_product(other.high, high);
        let (sum, lost_low) = fast_two_sum(product, other.low * high);
        let (product, lost) = fast_two_sum(sum, lost_low + lost);
        let left = (self.high - product) + (self.low - lost);
        let (high, low) = fast_two_sum(high, left / other.high);
        Double { high, low }
    }
}

impl PartialOrd for Double {
    #[inline]
    fn partial_cmp(&self, other: &Double) -> Option<Ordering> {
        match self.high.partial_cmp(&other.high) {
            Some(Ordering::Equal) => self.low.partial_cmp(&other.low),
            order => order,
        }
    }
}
