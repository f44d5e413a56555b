//! How many spheres are how fast, beside Maxwell's distribution, or where across the view: a chart for some spheres.

use glam::DVec3;
use ratatui::layout::Rect;

use super::{
    canvas::{Canvas, Layer, Stroke},
    column::Column,
    sheet::Sheet,
};
use crate::format;
use crate::snapshot::Snapshot;

/// Fewest spheres of which a distribution of speeds is seen.
const SPEEDS: usize = 50;
/// Fewest spheres of which a distribution of places is seen.
const PLACES: usize = 14;

/// Rows of the chart.
const CHART: u16 = 7;

/// Rows that must be left under the chart: a screen of 80×24 has as many.
const UNDER: usize = 12;

/// Most bars, one per column.
const BARS: usize = 28;

/// Largest speed shown over the speed by which Maxwell's distribution is scaled: beyond is a ten-thousandth.
const REACH: f64 = 4.5;

/// What is counted.
#[derive(Debug, Clone, PartialEq)]
struct Counts {
    /// Spheres in each bar.
    bars: Vec<u64>,
    /// Where the first bar begins, and where the last ends, m/s or m.
    ends: [f64; 2],
    /// Whether each bar is a bin of the scene.
    bins: bool,
    /// Spheres that Maxwell's distribution has in each bar; none where places are counted.
    maxwell: Option<Vec<f64>>,
}

/// Draws the chart where there are spheres enough, and room; whether it did. Without gravity it is of speeds, which in a
/// gas become Maxwell's; with gravity of places across, or of bins where the scene has such, which on a Galton board become
/// a bell.
pub(super) fn draw(snapshot: &Snapshot, column: &mut Column) -> bool {
    let flies = snapshot.stage.gravity == DVec3::ZERO;
    let least = if flies { SPEEDS } else { PLACES };
    if snapshot.x.len() < least || column.rows() < usize::from(CHART) + UNDER {
        return false;
    }
    let bars = BARS.min(column.width());
    let (heading, counts, unit) = match flies {
        true => ("speeds", speeds(snapshot, bars), "m/s"),
        false => ("places", bins(snapshot).or_else(|| places(snapshot, bars / 2)), "m"),
    };
    let Some(counts) = counts else { return false };
    let remark = match counts.maxwell {
        Some(_) => "line: Maxwell's".into(),
        None if counts.bins => counts.bars.iter().map(u64::to_string).collect::<Vec<_>>().join(" "),
        None => "along x".into(),
    };
    column.heading(if counts.bins { "bins" } else { heading }, &remark);
    let area = column.take(CHART);
    draw_chart(&counts, area, column.sheet_mut());
    let ends = counts.ends.map(|end| format!("{} {unit}", format::setting(end)));
    let room = column.width().saturating_sub(ends[0].len());
    let faint = column.sheet().palette.faint();
    column.row(&format!("{}{:>room$}", ends[0], ends[1]), faint);
    column.skip();
    true
}

/// Counts the spheres by speed. Where masses differ, the speeds are those that the mean mass would have with as much
/// energy.
fn speeds(snapshot: &Snapshot, bars: usize) -> Option<Counts> {
    let masses = &snapshot.stage.masses;
    let mean = masses.iter().sum::<f64>() / masses.len() as f64;
    let squares: Vec<f64> = snapshot.v.iter().zip(masses).map(|(v, mass)| v.length_squared() * mass / mean).collect();
    // ⟨v²⟩ = 3 a²
    let scale = (squares.iter().sum::<f64>() / (3.0 * squares.len() as f64)).sqrt();
    let most = REACH * scale;
    let counted = count(squares.into_iter().map(f64::sqrt), [0.0, most], bars)?;
    let width = most / bars as f64;
    let expected = |bar: usize| {
        let v = (bar as f64 + 0.5) * width / scale;
        // √(2/π) v² e^(−v²/2) of a sphere in units of the scale
        0.797_884_560_802_865_4 * v * v * falling(0.5 * v * v) * width / scale * snapshot.v.len() as f64
    };
    Some(Counts { maxwell: Some((0..bars).map(expected).collect()), ..counted })
}

/// Counts the spheres by place along x, in the scene's view.
fn places(snapshot: &Snapshot, bars: usize) -> Option<Counts> {
    let view = &snapshot.stage.view;
    count(snapshot.x.iter().map(|x| x.x), [view.min.x, view.max.x], bars)
}

/// Counts the spheres by bin: between two neighbours of the upright walls across x that stand lowest, and no higher than
/// the lower of them. None if there are no three such bins of one width.
fn bins(snapshot: &Snapshot) -> Option<Counts> {
    let upright = |corners: &[DVec3; 4]| corners.iter().all(|corner| corner.x == corners[0].x);
    let low = |corners: &[DVec3; 4]| corners.iter().map(|corner| corner.y).fold(f64::INFINITY, f64::min);
    let high = |corners: &[DVec3; 4]| corners.iter().map(|corner| corner.y).fold(f64::NEG_INFINITY, f64::max);
    let walls: Vec<&[DVec3; 4]> =
        snapshot.stage.walls.iter().map(|(corners, _)| corners).filter(|corners| upright(corners)).collect();
    let floor = walls.iter().map(|corners| low(corners)).fold(f64::INFINITY, f64::min);
    let mut plates: Vec<(f64, f64)> =
        walls.iter().filter(|corners| low(corners) == floor).map(|corners| (corners[0].x, high(corners))).collect();
    plates.sort_by(|a, b| a.0.total_cmp(&b.0));
    plates.dedup_by_key(|plate| plate.0);
    let widths = plates.windows(2).map(|pair| pair[1].0 - pair[0].0);
    let least = widths.clone().fold(f64::INFINITY, f64::min);
    // what a bin is wide is written in decimals: the sums of their binary forms differ by rounding
    let between: Vec<&[(f64, f64)]> =
        plates.windows(2).filter(|pair| pair[1].0 - pair[0].0 <= least * (1.0 + 1e-9)).collect();
    let (first, last) = (between.first()?, between.last()?);
    if between.len() < 3 || last[1].0 - first[0].0 > least * between.len() as f64 * (1.0 + 1e-9) {
        return None;
    }
    let inside = |pair: &[(f64, f64)], x: DVec3| x.x >= pair[0].0 && x.x < pair[1].0 && x.y < pair[0].1.min(pair[1].1);
    let counted = |pair: &&[(f64, f64)]| snapshot.x.iter().filter(|x| inside(pair, **x)).count() as u64;
    let ends = [first[0].0, last[1].0];
    Some(Counts { bars: between.iter().map(counted).collect(), ends, bins: true, maxwell: None })
}

/// Counts values in bars of equal width; those beyond the ends, and NaN, in none.
fn count(values: impl Iterator<Item = f64>, ends: [f64; 2], bars: usize) -> Option<Counts> {
    let width = (ends[1] - ends[0]) / bars as f64;
    if !(width.is_finite() && width > 0.0) {
        return None;
    }
    let mut counted = vec![0; bars];
    for value in values.filter(|value| (ends[0]..ends[1]).contains(value)) {
        counted[(((value - ends[0]) / width) as usize).min(bars - 1)] += 1;
    }
    Some(Counts { bars: counted, ends, bins: false, maxwell: None })
}

/// e^(−x) for x from 0 on, by its series: the same on every machine.
fn falling(x: f64) -> f64 {
    let (mut sum, mut term) = (1.0, 1.0);
    for n in 1..=60 {
        term *= x / f64::from(n);
        sum += term;
    }
    1.0 / sum
}

fn draw_chart(counts: &Counts, area: Rect, sheet: &mut Sheet) {
    let mut canvas = Canvas::new(area);
    let expected = counts.maxwell.as_deref().unwrap_or(&[]);
    let most = counts.bars.iter().map(|count| *count as f64).chain(expected.iter().copied()).fold(0.0, f64::max);
    if most <= 0.0 {
        return;
    }
    let (bars, width, height) = (counts.bars.len() as i32, canvas.width(), canvas.height());
    let bar_ink = Stroke::new(Layer::Wall, sheet.palette.heading());
    let line_ink = Stroke::new(Layer::Selected, sheet.palette.alarm());
    for x in 0..width {
        let bar = (x * bars / width) as usize;
        let top = (counts.bars[bar] as f64 / most * f64::from(height)).round() as i32;
        (height - top..height).for_each(|y| canvas.dot(x, y, bar_ink));
        if let Some(expected) = expected.get(bar) {
            canvas.dot(x, ((1.0 - expected / most) * f64::from(height - 1)).round() as i32, line_ink);
        }
    }
    canvas.paint(area, sheet);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_within_the_ends_is_in_its_bar() {
        let counted = count([0.0, 0.99, 1.0, 3.999, 4.0, -0.1, f64::NAN].into_iter(), [0.0, 4.0], 4).expect("bars");
        assert_eq!(counted.bars, [2, 1, 0, 1]);
        assert_eq!(count([1.0].into_iter(), [2.0, 2.0], 4), None, "a view without a width");
    }

    #[test]
    fn a_falling_exponential_is_what_it_should_be() {
        for (x, value) in [(0.0, 1.0), (1.0, 0.367_879_441_171_442_3), (10.0, 4.539_992_976_248_485e-5)] {
            assert!((falling(x) / value - 1.0).abs() < 1e-13, "{x}: {}", falling(x)); // rounding of sixty sums
        }
    }
}
