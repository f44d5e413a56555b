//! The search for the collision time, trial step by trial step.

use super::column::Column;
use crate::format;
use crate::snapshot::Probe;

/// Draws the trial steps, the last ones if there is no room for all: they are the closest to the collision.
pub(super) fn draw(probes: &[Probe], column: &mut Column) {
    if probes.is_empty() || column.rows() < 3 {
        return;
    }
    column.heading("search", &format!("{} trial steps", probes.len()));
    let (palette, glyphs) = (column.sheet().palette, column.sheet().glyphs);
    let rows = column.rows().saturating_sub(1);
    column.row("      step s      degree", palette.faint());
    for probe in &probes[probes.len() - rows.min(probes.len())..] {
        let touching = if probe.degree >= 0.0 { glyphs.contact[0] } else { ' ' };
        // Methods that look only for overlap report how deep it is, and of what is apart no more than that.
        let degree = if probe.degree == f64::NEG_INFINITY {
            format!("{:>10}", "apart")
        } else {
            format::scientific(probe.degree, 10)
        };
        let row = format!("{}  {degree} {touching}", format::decimal(probe.step, 12, 9));
        column.row(&row, palette.plain());
    }
}
