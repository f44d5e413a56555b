//! Which settings are one and the same run, because a knob changes nothing.

use crate::export::TradeRow;
use crate::format;

/// By row, the index of the first one that is the very same run: of the same scene and method, with every counted figure equal. None if
/// the row is that first one itself.
pub fn alike(rows: &[TradeRow]) -> Vec<Option<usize>> {
    let mut first: Vec<usize> = Vec::new();
    let of = |(index, row): (usize, &TradeRow)| {
        let found = first.iter().copied().find(|&other| is_same(&rows[other], row));
        if found.is_none() {
            first.push(index);
        }
        found
    };
    rows.iter().enumerate().map(of).collect()
}

/// The rows of which each is another run, and which others a row stands for, in words.
pub(super) fn folded(rows: &[TradeRow]) -> Vec<(TradeRow, Option<String>)> {
    let alike = alike(rows);
    let stands_for = |index: usize| {
        let others: Vec<&TradeRow> =
            rows.iter().zip(&alike).filter(|(_, of)| **of == Some(index)).map(|(row, _)| row).collect();
        same_as(&rows[index], &others)
    };
    let kept = (0..rows.len()).filter(|&index| alike[index].is_none());
    kept.map(|index| (rows[index].clone(), stands_for(index))).collect()
}

fn is_same(a: &TradeRow, b: &TradeRow) -> bool {
    let counted = |row: &TradeRow| (row.common_events, row.impacts, row.evaluations, row.events, row.frames);
    let errors =
        |row: &TradeRow| (row.until, row.position_error, row.impact_time_error, row.energy_error, row.deepest_degree);
    (&a.scene, &a.method) == (&b.scene, &b.method) && counted(a) == counted(b) && errors(a) == errors(b)
}

/// Which settings a row stands for beside its own.
fn same_as(row: &TradeRow, alike: &[&TradeRow]) -> Option<String> {
    let one_step = alike.iter().all(|other| other.dt == row.dt);
    let knob = |other: &TradeRow| {
        let tolerance = other.tolerance.map(format::power).unwrap_or_default();
        let dt = other.dt.filter(|_| !one_step).map(|dt| format!("dt {} ", format::power(dt))).unwrap_or_default();
        dt + &tolerance
    };
    let list: Vec<String> = alike.iter().map(|other| knob(other).trim().to_string()).collect();
    (!list.is_empty()).then(|| format!("the very same run as with {}", list.join(", ")))
}
