//! Which settings are worth their time: the Pareto front, and the cheapest setting for each decade of error.

use super::axes::Axes;
use crate::export::TradeRow;
use crate::scene::Method;

/// Decades of error that are asked for: from 1 m down to what rounding leaves.
const DECADES: [f64; 17] =
    [1e0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15, 1e-16];

/// The indices of the rows (of one scene) that no other beats in both error and cost, cheapest first. A run that
/// stalled does not compete, nor does one without figures, nor a method that is not `allowed`.
pub fn front(rows: &[TradeRow], allowed: &[Method], axes: Axes) -> Vec<usize> {
    let mut order: Vec<(f64, f64, usize)> = competitors(rows, allowed, axes).collect();
    order.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.total_cmp(&b.0)).then(a.2.cmp(&b.2)));
    let mut best = f64::INFINITY;
    let better = |(error, _, index): &(f64, f64, usize)| (*error < best).then(|| (best = *error, *index).1);
    order.iter().filter_map(better).collect()
}

/// Error, cost and index of the rows that may compete.
fn competitors(rows: &[TradeRow], allowed: &[Method], axes: Axes) -> impl Iterator<Item = (f64, f64, usize)> {
    rows.iter().enumerate().filter_map(move |(index, row)| {
        let method = Method::from_name(&row.method).filter(|method| allowed.contains(method));
        let finished = row.note.stalled.is_none();
        method.filter(|_| finished).and(Some((axes.error(row)?, axes.cost(row)?, index)))
    })
}

/// The cheapest setting for some decades of error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cheapest {
    /// Largest error for which the setting is the cheapest.
    pub from: f64,
    /// Smallest error that the setting meets, a power of ten.
    pub to: f64,
    /// Index of the setting's row.
    pub row: usize,
}

/// For each decade of error from 1 down, the cheapest row of a [`front`] that meets it; decades with the same answer
/// are one entry. What no row meets is not there.
pub fn cheapest(rows: &[TradeRow], front: &[usize], axes: Axes) -> Vec<Cheapest> {
    let mut found: Vec<Cheapest> = Vec::new();
    for decade in DECADES {
        let meets = |row: &&usize| axes.error(&rows[**row]).is_some_and(|error| error <= decade);
        let Some(&row) = front.iter().find(meets) else { break };
        match found.last_mut().filter(|last| last.row == row) {
            Some(last) => last.to = decade,
            None => found.push(Cheapest { from: decade, to: decade, row }),
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(error: f64, cost: f64) -> TradeRow {
        TradeRow {
            scene: "s".into(),
            method: "paper".into(),
            until: 1.0,
            position_error: Some(error),
            cpu_per_s: Some(cost),
            ..TradeRow::default()
        }
    }

    #[test]
    fn the_front_holds_what_nothing_beats_in_both() {
        let mut rows = vec![row(1e-1, 4.0), row(1e-2, 2.0), row(0.5, 1.0), row(1e-2, 3.0), row(1e-9, 0.5)];
        rows[4].note = "stalled at 1 s".into();
        rows.push(TradeRow { method: "exact".into(), ..row(0.0, 0.1) });
        assert_eq!(front(&rows, &[Method::Paper], Axes::default()), [2, 1]);
        assert_eq!(front(&rows, &[Method::Paper, Method::Exact], Axes::default()), [5], "exact competes if it may");
        assert_eq!(front(&[], &[Method::Paper], Axes::default()), [0; 0]);
    }

    #[test]
    fn decades_with_the_same_answer_are_one() {
        let rows = [row(0.5, 1.0), row(5e-5, 2.0)];
        let found = cheapest(&rows, &front(&rows, &[Method::Paper], Axes::default()), Axes::default());
        let wanted = [Cheapest { from: 1.0, to: 1.0, row: 0 }, Cheapest { from: 1e-1, to: 1e-4, row: 1 }];
        assert_eq!(found, wanted);
    }
}
