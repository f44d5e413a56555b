//! When a sphere and an obstacle touch: Newton's iteration on the distance, or on its square.

use super::obstacle::Part;
use super::vector::Vector;
use crate::double::Double;

/// Steps of Newton's iteration after which there is nothing near: from 16 digits three suffice, a graze takes one per bit.
const MOST_STEPS: u32 = 120;

/// A step that is no shorter than half the one before stands for rounding once it is this part of the time: 2⁻⁷⁵.
const ROUNDING: f64 = 2.7e-23;

/// When a motion, place (m) and velocity (m/s) by time, comes as near as `reach` (m) to `part`, s, close to `guess` (s); none
/// if it does not approach there.
pub(super) fn touching(
    motion: impl Fn(Double) -> [Vector; 2],
    part: &Part,
    reach: Double,
    guess: f64,
) -> Option<Double> {
    let mut t = Double::from(guess);
    let mut last = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let [excess, rate] = part.excess(motion(t), reach);
        if !(rate < Double::ZERO && excess.value().is_finite()) {
            return None;
        }
        let step = excess / rate;
        t = t - step;
        let size = step.value().abs();
        if size == 0.0 || (size >= 0.5 * last && size <= ROUNDING * (t.value().abs() + guess.abs())) {
            return Some(t);
        }
        last = size;
    }
    None
}
