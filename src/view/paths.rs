//! Where spheres were, and where the selected one goes.

use glam::DVec3;

use super::{
    canvas::{Layer, Stroke},
    pane::View,
    shapes,
    sheet::Sheet,
};

/// Most spheres of which all paths are drawn where none is selected; more would be a carpet.
const FEW: usize = 20;

/// Distance between two signs of a predicted path, dots.
const APART: f64 = 3.0;

/// Draws the paths that are wanted, under the spheres.
pub(super) fn draw(view: &mut View, sheet: &Sheet) {
    let screen = view.screen;
    let (overlays, selected) = (screen.view_settings.overlays, screen.view_settings.selected);
    if overlays.path {
        let all = 0..if screen.snapshot.x.len() <= FEW { screen.snapshot.x.len() } else { 0 };
        match selected {
            Some(sphere) => draw_trail(view, sphere, sheet),
            None => all.for_each(|sphere| draw_trail(view, sphere, sheet)),
        }
    }
    if let Some(ahead) = screen.ahead.filter(|ahead| overlays.predicted && Some(ahead.sphere) == selected) {
        draw_ahead(view, &ahead.path, Stroke::new(Layer::Arrow, sheet.palette.strong()));
    }
}

/// Draws a line through the centres in the last frames.
fn draw_trail(view: &mut View, sphere: usize, sheet: &Sheet) {
    let color = view.screen.snapshot.stage.colors.get(sphere).copied().flatten();
    let stroke = Stroke::new(Layer::Ghost, sheet.palette.sphere(sphere, color).patch(sheet.palette.faint()));
    let places = view.screen.trail.iter().filter_map(|places| places.get(sphere));
    let dots: Vec<shapes::Dots> = places.map(|x| view.project(*x)).collect();
    for ends in dots.windows(2) {
        shapes::line(&mut view.canvas, ends[0], ends[1], stroke);
    }
}

/// Draws dots at equal distances along a path (m) that is still to come.
fn draw_ahead(view: &mut View, path: &[DVec3], stroke: Stroke) {
    let dots: Vec<shapes::Dots> = path.iter().map(|x| view.project(*x)).collect();
    let reach = f64::from(view.canvas.width() + view.canvas.height());
    let mut left = APART;
    for ends in dots.windows(2) {
        let (dx, dy) = (ends[1].0 - ends[0].0, ends[1].1 - ends[0].1);
        let length = (dx * dx + dy * dy).sqrt();
        if !(length > 0.0 && length < reach) {
            continue; // far off the canvas
        }
        let mut at = left;
        while at <= length {
            let share = at / length;
            let (x, y) = (ends[0].0 + share * dx, ends[0].1 + share * dy);
            view.canvas.dot(x.round() as i32, y.round() as i32, stroke);
            at += APART;
        }
        left = at - length;
    }
}
