//! Lines, circles and discs in dots. Square roots only (correctly rounded everywhere), so a frame has the same dots on
//! every machine; nothing ever loops over dots that are off the canvas.

use std::f64::consts::FRAC_1_SQRT_2;

use super::canvas::{Canvas, Stroke};

/// A point in dots: the centre of dot (i, j) is (i, j).
pub(super) type Dots = (f64, f64);

/// Draws a straight line from `a` to `b`: one dot in each column, or each row if it is steep, as far as it is on the
/// canvas. Nothing if a coordinate is not finite.
pub(super) fn line(canvas: &mut Canvas, a: Dots, b: Dots, stroke: Stroke) {
    let Some((a, b)) = clip(canvas, a, b) else { return };
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let slope = |rise: f64, run: f64| if run == 0.0 { 0.0 } else { rise / run };
    if dx.abs() >= dy.abs() {
        for x in between(a.0, b.0) {
            canvas.dot(x, (a.1 + (f64::from(x) - a.0) * slope(dy, dx)).round() as i32, stroke);
        }
    } else {
        for y in between(a.1, b.1) {
            canvas.dot((a.0 + (f64::from(y) - a.1) * slope(dx, dy)).round() as i32, y, stroke);
        }
    }
}

/// Where a line that is partly on the canvas goes on beyond its border: the last dot there, and whether it goes on to the
/// left, the right, up or down.
pub(super) fn leaves(canvas: &Canvas, a: Dots, b: Dots) -> Vec<(i32, i32, usize)> {
    let Some((from, to)) = clip(canvas, a, b) else { return Vec::new() };
    let (right, bottom) = (canvas.width() - 1, canvas.height() - 1);
    let cut = [(a, from), (b, to)].into_iter().filter(|(end, seen)| end != seen);
    let at = cut.map(|(_, seen)| {
        let (x, y) = ((seen.0.round() as i32).clamp(0, right), (seen.1.round() as i32).clamp(0, bottom));
        let borders = [seen.0 + 0.5, f64::from(right) + 0.5 - seen.0, seen.1 + 0.5, f64::from(bottom) + 0.5 - seen.1];
        let nearest = (0..4).fold(0, |best, side| if borders[side] < borders[best] { side } else { best });
        (x, y, nearest)
    });
    at.collect()
}

/// The dots from the one nearest to `a` to the one nearest to `b`.
fn between(a: f64, b: f64) -> std::ops::RangeInclusive<i32> {
    a.min(b).round() as i32..=a.max(b).round() as i32
}

/// The part of a line that is on the canvas, half a dot of rim included (Liang and Barsky 1984).
fn clip(canvas: &Canvas, a: Dots, b: Dots) -> Option<(Dots, Dots)> {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    if !(dx.is_finite() && dy.is_finite()) {
        return None;
    }
    let (right, bottom) = (f64::from(canvas.width()) - 0.5, f64::from(canvas.height()) - 0.5);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (along, inside) in [(-dx, a.0 + 0.5), (dx, right - a.0), (-dy, a.1 + 0.5), (dy, bottom - a.1)] {
        // The line is on this side's inner half where along · s ≤ inside.
        if along == 0.0 && inside < 0.0 {
            return None;
        } else if along < 0.0 {
            enter = enter.max(inside / along);
        } else if along > 0.0 {
            leave = leave.min(inside / along);
        }
    }
    let at = |s: f64| ((a.0 + s * dx).clamp(-0.5, right), (a.1 + s * dy).clamp(-0.5, bottom));
    (enter <= leave).then(|| (if enter > 0.0 { at(enter) } else { a }, if leave < 1.0 { at(leave) } else { b }))
}

/// Draws the circle of radius `r` dots about `c`, one dot wide: in its steep parts the two dots of each row nearest to it,
/// in its flat parts the two of each column. No dot's centre is farther than half a dot from the true circle.
pub(super) fn circle(canvas: &mut Canvas, c: Dots, r: f64, stroke: Stroke) {
    rim(canvas, c, r, |_, _| true, stroke);
}

/// Draws a circle of radius `r` dots about `c` with every other dot left out.
pub(super) fn dotted_circle(canvas: &mut Canvas, c: Dots, r: f64, stroke: Stroke) {
    rim(canvas, c, r, |x, y| (x ^ y) & 1 == 0, stroke);
}

/// Draws the dots of a circle that are wanted.
fn rim(canvas: &mut Canvas, c: Dots, r: f64, wanted: impl Fn(i32, i32) -> bool, stroke: Stroke) {
    if !meets(canvas, c, r) {
        return;
    }
    let (width, height) = (canvas.width(), canvas.height());
    let mut dot = |x: i32, y: i32| {
        if wanted(x, y) {
            canvas.dot(x, y, stroke);
        }
    };
    // Half a dot more than the eighth of the circle, so that steep and flat parts meet without a hole.
    let h = r * FRAC_1_SQRT_2 + 0.5;
    for y in range(c.1 - h, c.1 + h, height) {
        let half = half_chord(r, f64::from(y) - c.1);
        dot(nearest(c.0 - half), y);
        dot(nearest(c.0 + half), y);
    }
    for x in range(c.0 - h, c.0 + h, width) {
        let half = half_chord(r, f64::from(x) - c.0);
        dot(x, nearest(c.1 - half));
        dot(x, nearest(c.1 + half));
    }
}

/// Draws the disc of radius `r` dots about `c`: every `every`-th row of the dots whose centres are in it, and at least the
/// dot nearest to `c`.
pub(super) fn disc(canvas: &mut Canvas, c: Dots, r: f64, every: i32, stroke: Stroke) {
    if !meets(canvas, c, r) {
        return;
    }
    canvas.dot(c.0.round() as i32, c.1.round() as i32, stroke);
    for y in range(c.1 - r, c.1 + r, canvas.height()).filter(|y| y % every == 0) {
        let half = half_chord(r, f64::from(y) - c.1);
        bar(canvas, (c.0 - half, c.0 + half), y, stroke);
    }
}

/// Takes away the dots of other spheres within the circle of radius `r` dots about `c`, its rim left out.
pub(super) fn hide(canvas: &mut Canvas, c: Dots, r: f64) {
    if !meets(canvas, c, r) {
        return;
    }
    for y in range(c.1 - r, c.1 + r, canvas.height()) {
        let half = half_chord(r, f64::from(y) - c.1) - 0.5;
        let row = range(c.0 - half, c.0 + half, canvas.width());
        canvas.hide(row.start, row.end, y);
    }
}

/// Draws the horizontal chord through the centre of the circle of radius `r` dots about `c`.
pub(super) fn chord(canvas: &mut Canvas, c: Dots, r: f64, stroke: Stroke) {
    if meets(canvas, c, r) {
        bar(canvas, (c.0 - r, c.0 + r), c.1.round() as i32, stroke);
    }
}

/// Draws the dots of a row whose centres are within `ends`.
fn bar(canvas: &mut Canvas, ends: (f64, f64), y: i32, stroke: Stroke) {
    for x in range(ends.0, ends.1, canvas.width()) {
        canvas.dot(x, y, stroke);
    }
}

/// Whether any of the disc can be on the canvas; false if a number is not finite.
fn meets(canvas: &Canvas, c: Dots, r: f64) -> bool {
    let rim = r.max(1.0) + 1.0;
    let within = |x: f64, size: i32| x + rim >= 0.0 && x - rim <= f64::from(size);
    r.is_finite() && within(c.0, canvas.width()) && within(c.1, canvas.height())
}

/// √(r² − d²): half the chord at distance `d` from the centre, as √((r − d)(r + d)) so that nothing is lost when r is
/// huge; 0 outside the circle.
fn half_chord(r: f64, d: f64) -> f64 {
    ((r - d) * (r + d)).max(0.0).sqrt()
}

/// The whole numbers from `from` to `to` that are in 0..size.
fn range(from: f64, to: f64, size: i32) -> std::ops::Range<i32> {
    // `as` cuts to whole numbers and saturates; calls of `ceil` and `floor` would be a part of what a circle costs.
    let (from, to) = (from.clamp(0.0, f64::from(size)), to.min(f64::from(size)));
    let first = from as i32;
    let end = if to < 0.0 { 0 } else { (to as i32 + 1).min(size) };
    first + i32::from(f64::from(first) < from)..end
}

/// The whole number nearest to `x`, of two the one farther from 0: what `round` gives, without a call.
fn nearest(x: f64) -> i32 {
    let whole = x as i32;
    let rest = x - f64::from(whole);
    whole.saturating_add(i32::from(rest >= 0.5) - i32::from(rest <= -0.5))
}

#[cfg(test)]
mod tests {
    use ratatui::layout::Rect;

    use super::*;

    #[test]
    fn whole_numbers_are_those_that_ceil_floor_and_round_give() {
        let mut ends =
            vec![0.0, -0.0, 0.5, -0.5, 1.5, -1.5, 2.5, 0.49999999999999994, 39.5, 40.0, 41.0, -1.0, 1e300, -1e300];
        ends.extend((1..2000).map(|i| f64::from(i * 37 % 1009) / 19.0 - 8.0));
        for &from in &ends {
            assert_eq!(nearest(from), from.round() as i32, "{from}");
            for &to in &ends[..20] {
                let wanted: Vec<i32> = (0..40).filter(|&i| f64::from(i) >= from && f64::from(i) <= to).collect();
                assert_eq!(range(from, to, 40).collect::<Vec<_>>(), wanted, "{from} to {to}");
            }
        }
    }

    fn drawn(draw: impl Fn(&mut Canvas)) -> Vec<(i32, i32)> {
        let mut canvas = Canvas::new(Rect::new(0, 0, 40, 20));
        draw(&mut canvas);
        let all = (0..80).flat_map(|y| (0..80).map(move |x| (x, y)));
        all.filter(|(x, y)| canvas.has(*x, *y)).collect()
    }

    fn distance(a: Dots, b: (i32, i32)) -> f64 {
        let (dx, dy) = (f64::from(b.0) - a.0, f64::from(b.1) - a.1);
        (dx * dx + dy * dy).sqrt()
    }

    /// Radii and centres that fall everywhere between dots.
    fn circles() -> impl Iterator<Item = (Dots, f64)> {
        (0..400).map(|i| {
            let i = f64::from(i);
            ((39.0 + (i * 0.37) % 1.0, 41.0 + (i * 0.73) % 1.0), 1.5 + i * 0.09)
        })
    }

    #[test]
    fn a_line_leaves_the_canvas_where_its_border_cuts_it_and_nowhere_else() {
        let canvas = Canvas::new(Rect::new(0, 0, 40, 20));
        assert_eq!(leaves(&canvas, (10.0, 10.0), (70.0, 60.0)), []);
        assert_eq!(leaves(&canvas, (-50.0, 20.0), (40.0, 20.0)), [(0, 20, 0)]);
        assert_eq!(leaves(&canvas, (40.0, 20.0), (900.0, 20.0)), [(79, 20, 1)]);
        assert_eq!(leaves(&canvas, (40.0, -9e9), (40.0, 9e9)), [(40, 0, 2), (40, 79, 3)]);
        assert_eq!(leaves(&canvas, (200.0, 0.0), (300.0, 40.0)), [], "all of it is beyond");
        assert_eq!(leaves(&canvas, (f64::NAN, 0.0), (3.0, 4.0)), []);
    }

    #[test]
    fn every_dot_of_a_circle_is_within_half_a_dot_of_the_true_circle() {
        for (c, r) in circles() {
            for dot in drawn(|canvas| circle(canvas, c, r, Stroke::default())) {
                // Half a dot, and rounding of the square root.
                assert!((distance(c, dot) - r).abs() <= 0.5 + 1e-12, "radius {r} about {c:?}: {dot:?}");
            }
        }
    }

    #[test]
    fn a_circle_has_no_holes() {
        for (c, r) in circles() {
            let dots = drawn(|canvas| circle(canvas, c, r, Stroke::default()));
            for dot in &dots {
                let beside = |other: &&(i32, i32)| (other.0 - dot.0).abs().max((other.1 - dot.1).abs()) == 1;
                assert!(dots.iter().filter(beside).count() >= 2, "radius {r} about {c:?}: {dot:?} is an end");
            }
        }
    }

    #[test]
    fn a_disc_holds_the_dots_whose_centres_are_in_it() {
        for (c, r) in circles() {
            let dots = drawn(|canvas| disc(canvas, c, r, 1, Stroke::default()));
            let inside = (0..80).flat_map(|y| (0..80).map(move |x| (x, y))).filter(|dot| distance(c, *dot) <= r);
            assert_eq!(dots.len(), inside.count(), "radius {r} about {c:?}");
        }
        assert_eq!(drawn(|canvas| disc(canvas, (7.4, 7.4), 1e-9, 1, Stroke::default())), [(7, 7)]);
    }

    #[test]
    fn a_line_of_any_length_is_drawn_as_far_as_it_is_on_the_canvas() {
        let diagonal: Vec<(i32, i32)> = (0..80).map(|i| (i, i)).collect();
        for far in [1e2, 1e5, 1e9] {
            let ends = ((40.0 - far, 40.0 - far), (40.0 + far, 40.0 + far));
            assert_eq!(drawn(|canvas| line(canvas, ends.0, ends.1, Stroke::default())), diagonal, "to {far}");
        }
        let vertical: Vec<(i32, i32)> = (0..80).map(|y| (12, y)).collect();
        assert_eq!(drawn(|canvas| line(canvas, (12.0, -1e9), (12.0, 1e9), Stroke::default())), vertical);
    }

    #[test]
    fn a_line_that_misses_the_canvas_or_is_not_finite_draws_nothing() {
        let far = [(-5.0, 3.0), (-1.0, 90.0), (85.0, 85.0), (1e300, 5.0)];
        for (a, b) in
            [(far[0], far[1]), (far[2], far[3]), ((f64::NAN, 0.0), (1.0, 1.0)), ((0.0, f64::INFINITY), (3.0, 3.0))]
        {
            assert_eq!(drawn(|canvas| line(canvas, a, b, Stroke::default())), [], "{a:?} {b:?}");
        }
    }

    #[test]
    fn the_rim_of_an_enormous_circle_is_a_straight_line_of_its_own_slope() {
        let r = 1e9;
        let dots = drawn(|canvas| circle(canvas, (40.0 - r, 40.0), r, Stroke::default()));
        assert_eq!(dots, (0..80).map(|y| (40, y)).collect::<Vec<_>>());
    }
}
