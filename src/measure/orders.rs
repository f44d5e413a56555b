//! The order at which the error of each method falls with its own knob.

use super::axes::Axes;
use super::fit::{Fit, fit};
use super::trade::PARTED;
use crate::export::TradeRow;
use crate::physics::{Effect, knobs};
use crate::scene::Method;

/// An order found.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Order {
    pub(super) method: String,
    /// Name of the knob.
    pub(super) knob: &'static str,
    pub(super) fit: Fit,
}

/// The orders of all methods in the rows of one scene: in dt where the error depends on it, with the finest tolerance of
/// each step; else in the tolerance, with the longest step. `floor` (m) is the reference's own error.
pub(super) fn orders(rows: &[TradeRow], axes: Axes, floor: f64) -> Vec<Order> {
    let methods = rows.chunk_by(|a, b| a.method == b.method);
    methods.filter_map(|of_method| order(of_method, axes, floor)).collect()
}

/// The order in the rows of one method. Rows that part from the reference, or are no better than its own error, say
/// nothing.
fn order(rows: &[TradeRow], axes: Axes, floor: f64) -> Option<Order> {
    let known = knobs(Method::from_name(&rows[0].method)?);
    let counts = |row: &&TradeRow| {
        let above = axes.y != super::axes::Error::Position || row.position_error.is_some_and(|error| error > floor);
        row.note.stalled.is_none() && above && !row.note.doubts.iter().any(|doubt| doubt == PARTED)
    };
    let knob = match (known.dt, known.tolerance) {
        (Effect::Error, _) => "dt",
        (_, Effect::Error) => "tolerance",
        _ => return None,
    };
    let in_dt = knob == "dt";
    let pair = |row: &TradeRow| if in_dt { (row.dt, row.tolerance) } else { (row.tolerance, row.dt) };
    let mut points: Vec<(f64, f64, f64)> = Vec::new();
    for row in rows.iter().filter(counts) {
        let (Some(value), other, Some(error)) = (pair(row).0, pair(row).1.unwrap_or(0.0), axes.error(row)) else {
            continue;
        };
        let better = |known: f64| if in_dt { other < known } else { other > known };
        match points.iter_mut().find(|point| point.0 == value) {
            Some(point) if better(point.1) => *point = (value, other, error),
            Some(_) => {}
            None => points.push((value, other, error)),
        }
    }
    let fit = fit(points.into_iter().map(|(value, _, error)| (value, error)))?;
    Some(Order { method: rows[0].method.clone(), knob, fit })
}

impl std::fmt::Display for Order {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Order { method, knob, fit } = self;
        write!(f, "{method} {fit} in {knob} ({} settings)", fit.points)
    }
}
