//! One view: its label and scale, the walls' outlines, the spheres, and what lies on them.

use ratatui::layout::Rect;

use super::{
    arrows::Quantity,
    canvas::{Canvas, Layer, Stroke},
    layout::Pane,
    overlays,
    pane::View,
    projection::{Camera, Sizes, sane_zoom},
    screen::Screen,
    shapes,
    sheet::{self, Sheet},
    side::Side,
};
use crate::format;
use crate::snapshot::{Class, Kind, Snapshot};

/// Below this radius, dots, a sphere is drawn filled: an outline would have no inside.
const TINY: f64 = 1.5;

/// Up to this radius, dots, a colliding sphere is filled; larger ones are hatched, so that labels in them stay legible.
const FILLED: f64 = 6.0;

/// Rows from one line of the hatching to the next, dots: one line a cell.
const HATCH: i32 = 4;

/// Least radius, dots, of a sphere that hides what is behind it: a smaller one would be a hole.
const HIDES: f64 = 1.5;

/// Distance of the selected sphere's second ring from its first, dots.
const HALO: f64 = 2.0;

/// Draws one view with its label; `sizes` are those of both views, which have one scale.
pub(super) fn draw(screen: &Screen, pane: &Pane, sizes: Sizes, sheet: &mut Sheet) {
    let (snapshot, settings) = (screen.snapshot, screen.view_settings);
    let followed = settings.selected.filter(|_| settings.follow).and_then(|i| snapshot.x.get(i).copied());
    let camera = Camera::new(settings, &snapshot.stage, followed, sizes);
    let canvas = Canvas::new(pane.canvas);
    let mut view = View { side: pane.side, area: pane.canvas, camera, canvas, screen };
    draw_walls(&mut view, sheet);
    draw_ghost(&mut view, sheet);
    let states = states(snapshot);
    overlays::draw_arrows(&mut view, sheet);
    draw_spheres(&mut view, &states, sheet);
    overlays::draw_signs(&mut view, sheet);
    view.canvas.paint(pane.canvas, sheet);
    draw_label(&view, pane.label, sheet);
}

/// Draws the outline of every wall: four lines, which fall together where the wall is seen edge-on.
fn draw_walls(view: &mut View, sheet: &Sheet) {
    let stage = &view.screen.snapshot.stage;
    for (corners, color) in &stage.walls {
        let stroke = Stroke::new(Layer::Wall, sheet.palette.wall(*color));
        let dots = corners.map(|corner| view.project(corner));
        for i in 0..4 {
            let (from, to) = (dots[i], dots[(i + 1) % 4]);
            shapes::line(&mut view.canvas, from, to, stroke);
            // a wall that the view cuts goes on there
            for (x, y, side) in shapes::leaves(&view.canvas, from, to) {
                view.canvas.sign(x, y, sheet.glyphs.on[side], stroke);
            }
        }
    }
}

/// Draws the exact run's spheres: dotted circles under all others, so that only what has strayed shows one.
fn draw_ghost(view: &mut View, sheet: &Sheet) {
    let Some(ghost) = view.screen.comparison.and_then(|comparison| comparison.ghost) else { return };
    let stroke = Stroke::new(Layer::Ghost, sheet.palette.ghost());
    for (x, radius) in ghost.x.iter().zip(&view.screen.snapshot.stage.radii) {
        let (center, r) = (view.project(*x), radius * view.camera.scale);
        match r < TINY {
            true => shapes::disc(&mut view.canvas, center, r, 1, stroke),
            false => shapes::dotted_circle(&mut view.canvas, center, r, stroke),
        }
    }
}

/// What a sphere is doing, as far as its shape tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum State {
    Free,
    Rests,
    Collides,
}

/// What each sphere did in the frame shown; an impact outranks a rest.
fn states(snapshot: &Snapshot) -> Vec<State> {
    let mut states = vec![State::Free; snapshot.x.len()];
    for contact in &snapshot.contacts {
        let state = match contact.class {
            Class::Collide => State::Collides,
            Class::Rest => State::Rests,
            Class::Leave | Class::Release => continue,
        };
        let second = (contact.kind == Kind::Pair).then_some(contact.b);
        for sphere in [Some(contact.a), second].into_iter().flatten() {
            if let Some(known) = states.get_mut(sphere) {
                *known = state.max(*known);
            }
        }
    }
    states
}

/// Draws every sphere as a circle in true proportion; its shape tells what it does. A nearer one hides what is behind it;
/// the selected one is never hidden.
fn draw_spheres(view: &mut View, states: &[State], sheet: &Sheet) {
    let snapshot = view.screen.snapshot;
    let stage = &snapshot.stage;
    for i in far_to_near(view) {
        let (Some(x), Some(radius), Some(state)) = (snapshot.x.get(i), stage.radii.get(i), states.get(i)) else {
            continue;
        };
        let selected = view.screen.view_settings.selected == Some(i);
        let layer = match state {
            _ if selected => Layer::Selected,
            State::Free => Layer::Sphere,
            State::Rests | State::Collides => Layer::Contact,
        };
        let style = match state {
            State::Collides => sheet.palette.alarm(),
            _ => sheet.palette.sphere(i, stage.colors.get(i).copied().flatten()),
        };
        let (center, r) = (view.project(*x), radius * view.camera.scale);
        if r >= HIDES {
            shapes::hide(&mut view.canvas, center, r);
        }
        draw_sphere(&mut view.canvas, center, r, *state, Stroke::new(layer, style));
        if selected {
            let stroke = Stroke::new(layer, sheet.palette.strong());
            shapes::circle(&mut view.canvas, center, r.max(TINY) + HALO, stroke);
        }
    }
}

/// The spheres from the farthest to the nearest as seen in this view, from +z or from above, the selected one last.
fn far_to_near(view: &View) -> Vec<usize> {
    let snapshot = view.screen.snapshot;
    let nearness = |i: usize| match view.side {
        Side::Side => snapshot.x[i].z,
        Side::Top => snapshot.x[i].y,
    };
    let selected = view.screen.view_settings.selected;
    let mut order: Vec<(bool, f64, usize)> =
        (0..snapshot.x.len()).map(|i| (selected == Some(i), nearness(i), i)).collect();
    order.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
    order.into_iter().map(|(_, _, i)| i).collect()
}

/// Draws a sphere by its state. Free: an outline. Resting: with a chord. Colliding: filled. Tiny: a dot or a few, a bar, a
/// cross.
fn draw_sphere(canvas: &mut Canvas, center: shapes::Dots, r: f64, state: State, stroke: Stroke) {
    if r < TINY {
        shapes::disc(canvas, center, r, 1, stroke);
        match state {
            State::Free => {}
            State::Rests => shapes::chord(canvas, center, TINY, stroke),
            State::Collides => {
                shapes::chord(canvas, center, TINY, stroke);
                shapes::line(canvas, (center.0, center.1 - 1.0), (center.0, center.1 + 1.0), stroke);
            }
        }
        return;
    }
    shapes::circle(canvas, center, r, stroke);
    match state {
        State::Free => {}
        State::Rests => shapes::chord(canvas, center, r, stroke),
        State::Collides if r <= FILLED => shapes::disc(canvas, center, r, 1, stroke),
        State::Collides => shapes::disc(canvas, center, r, HATCH, stroke),
    }
}

/// Draws the view's name and axes, zoom, and a bar of a round length that holds for both axes.
fn draw_label(view: &View, label: Rect, sheet: &mut Sheet) {
    let (name, axes) = match view.side {
        Side::Side => ("side", sheet.glyphs.side_axes),
        Side::Top => ("top-down", sheet.glyphs.top_axes),
    };
    let (faint, heading) = (sheet.palette.faint(), sheet.palette.heading());
    let used = sheet.put_all(label, &[(" ", faint), (name, heading), (" ", faint), (axes, faint)]);
    let zoom = sane_zoom(view.screen.view_settings.zoom);
    let (mut extra, mut arrows) = (String::new(), String::new());
    if zoom != 1.0 {
        extra += &format!("  {}{}", sheet.glyphs.times, format::setting(zoom));
    }
    if let Some(seconds) = overlays::arrow_seconds(view).filter(|_| view.screen.view_settings.overlays.velocities) {
        arrows += &format!("  {} {} s", sheet.glyphs.arrow, format::setting(seconds));
    }
    for quantity in [Quantity::Impulse, Quantity::Force] {
        arrows += &quantity.label(view).unwrap_or_default();
    }
    let scale = scale_bar(view, sheet) + " ";
    let room = usize::from(label.width - used);
    let rest = Rect { x: label.x + used, width: label.width - used, ..label };
    let fits = |text: &str| sheet::width(text) + sheet::width(&scale) + 2 <= room;
    let all = extra + &arrows;
    if fits(&all) {
        sheet.put(rest, &all, faint);
    } else if !arrows.is_empty() {
        // arrows without a scale tell nothing: it comes before the bar, which can be read off the room
        let own = if fits(&arrows) { room - sheet::width(&scale) } else { room };
        sheet.put(Rect { width: own as u16, ..rest }, &arrows, faint);
    }
    if fits(&arrows) {
        sheet.put_right(rest, &scale, faint);
    }
}

/// The scale bar, "2 m ━━━━━━━╸": the largest round length that is at most a quarter of the width, exact to a dot.
fn scale_bar(view: &View, sheet: &Sheet) -> String {
    let meters = format::round_down(view.camera.span(view.area).x * 0.25);
    let dots = (meters * view.camera.scale).round().clamp(0.0, f64::from(view.canvas.width())) as usize;
    let [cell, half] = sheet.glyphs.bar;
    let half = if dots % 2 == 1 { half } else { "" };
    format!("{} m {}{half}", format::setting(meters), cell.repeat(dots / 2))
}
