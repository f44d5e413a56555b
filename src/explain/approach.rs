//! How a contact time follows from a polynomial: its coefficients, its roots, and which of them it is.

use super::line::Line;
use crate::format::{number, significant};
use crate::snapshot::{Approach, Shape};

/// Digits after the first that a number is written with.
const DIGITS: usize = 4;

/// Largest difference between a contact's time and its root, as a part of the time: what rounding and a touch that is held
/// back differ by.
const CLOSE: f64 = 1e-6;

/// The lines of an approach.
pub(super) fn lines(approach: &Approach) -> Vec<Line> {
    let Approach { time, since, .. } = *approach;
    let (what, unit) = match approach.shape {
        Shape::Face => ("the gap to its face", "m"),
        Shape::Edge => ("d² − r² from its edge", "m²"),
        Shape::Corner => ("d² − r² from its corner", "m²"),
        Shape::Centers => ("d² − (r₁ + r₂)² of the centres", "m²"),
    };
    let polynomial = format!("{what}: {} {unit}, τ = t − {} s", polynomial(&approach.polynomial), number(since));
    let roots = approach.roots();
    let shown: Vec<String> = roots.iter().map(|root| significant(*root, DIGITS)).collect();
    let listed = if shown.is_empty() { "none from τ = 0 on".into() } else { format!("τ = {} s", shown.join(", ")) };
    vec![
        Line::new("gap", polynomial),
        Line::new("roots", listed),
        Line::new("chosen", which(approach, &roots, time - since)),
    ]
}

/// Which root the contact is, and why that one.
fn which(approach: &Approach, roots: &[f64], tau: f64) -> String {
    let falls = |root: &&f64| approach.slope(**root) <= 0.0;
    let is = |root: &f64| (root - tau).abs() <= CLOSE * tau.max(approach.time.abs());
    let why = match roots.iter().filter(falls).position(is) {
        Some(0) => "the first root at which it falls: there they touch and approach",
        Some(_) => {
            "a root at which it falls; before it they came closer by less than rounding, or touched another part"
        }
        None => return "they touch already, and begin to approach now".into(),
    };
    format!("τ = {} s, {why}", significant(tau, DIGITS))
}

/// The polynomial of an approach in words: `0.512 − 1.2 τ − 4.9 τ²`.
fn polynomial(c: &[f64; 5]) -> String {
    let powers = ["", " τ", " τ²", " τ³", " τ⁴"];
    let mut text = String::new();
    for (value, power) in c.iter().zip(powers) {
        if *value == 0.0 {
            continue;
        }
        let sign = match (text.is_empty(), *value < 0.0) {
            (true, true) => "−",
            (true, false) => "",
            (false, true) => " − ",
            (false, false) => " + ",
        };
        text += &format!("{sign}{}{power}", significant(value.abs(), DIGITS));
    }
    if text.is_empty() { "0".into() } else { text }
}
