//! What lies on the spheres: contact marks, normals, velocity arrows, numbers.

use glam::DVec3;

use super::{
    arrows::{Quantity, draw_arrow, draw_pushes},
    canvas::{Layer, Stroke},
    card,
    pane::View,
    paths,
    sheet::Sheet,
};
use crate::format;
use crate::snapshot::{Class, Kind};

/// Length of a contact normal seen from the side, dots: three cells high, whatever the zoom.
const NORMAL: f64 = 12.0;

/// Distance of a wall's number from the point of its contact, dots: a cell and a half, on the side away from the sphere.
const BEHIND: f64 = 6.0;

/// Draws paths, normals, velocities, impulses and forces, under the spheres.
pub(super) fn draw_arrows(view: &mut View, sheet: &Sheet) {
    paths::draw(view, sheet);
    let overlays = view.screen.view_settings.overlays;
    if overlays.velocities {
        draw_velocities(view, sheet);
    }
    if overlays.normals {
        draw_normals(view, sheet);
    }
    Quantity::Force.draw(view, sheet);
    Quantity::Impulse.draw(view, sheet);
}

/// Draws contact marks and numbers, over the spheres.
pub(super) fn draw_signs(view: &mut View, sheet: &Sheet) {
    let settings = view.screen.view_settings;
    if settings.overlays.contacts {
        draw_contacts(view, sheet);
    }
    draw_chosen(view, sheet);
    let others = if settings.overlays.ids { 0..view.screen.snapshot.x.len() } else { 0..0 };
    let others = others.filter(|sphere| settings.selected != Some(*sphere));
    // The selected one's is always there; of others that would stand in each other's way the first.
    let mut taken = vec![false; usize::from(view.area.width) * usize::from(view.area.height)];
    for sphere in settings.selected.into_iter().chain(others) {
        draw_number(view, sphere, &mut taken, sheet);
    }
}

/// The simulated time that the velocity arrows stand for, s: an arrow goes from the sphere's rim to where that point would
/// be after so long without forces. The largest of 1, 2, 5 × 10ᵏ s for which the fastest arrow is no longer than a fifth of
/// the width, so that arrows of different frames can be compared; `None` if nothing moves.
pub(super) fn arrow_seconds(view: &View) -> Option<f64> {
    let squares = view.screen.snapshot.v.iter().map(|v| v.length_squared()).filter(|square| square.is_finite());
    let fastest = squares.fold(0.0, f64::max).sqrt();
    let seconds = view.camera.span(view.area).x * 0.2 / fastest;
    (seconds.is_finite() && seconds > 0.0).then(|| format::round_down(seconds))
}

fn draw_velocities(view: &mut View, sheet: &Sheet) {
    let Some(seconds) = arrow_seconds(view) else { return };
    let stroke = Stroke::new(Layer::Arrow, sheet.palette.velocity());
    let snapshot = view.screen.snapshot;
    for ((x, v), radius) in snapshot.x.iter().zip(&snapshot.v).zip(&snapshot.stage.radii) {
        let rim = *x + v.normalize_or_zero() * *radius;
        draw_arrow(view, rim, rim + *v * seconds, stroke);
    }
}

/// Draws the normal of every contact, from the far side of each sphere that it pushes: under the sphere's own dots it would
/// vanish.
fn draw_normals(view: &mut View, sheet: &Sheet) {
    let stroke = Stroke::new(Layer::Arrow, sheet.palette.normal());
    for contact in &view.screen.snapshot.contacts {
        draw_pushes(view, contact, NORMAL / view.camera.scale, stroke);
    }
}

/// Draws the contact whose card is open: its normal, and the wall's number beside its point.
fn draw_chosen(view: &mut View, sheet: &Sheet) {
    let chosen = view.screen.view_settings.card.and_then(|card| card::chosen(view.screen, card));
    let Some(contact) = chosen.map(|index| view.screen.snapshot.contacts[index]) else { return };
    let style = sheet.palette.alarm().patch(sheet.palette.strong());
    draw_pushes(view, &contact, NORMAL / view.camera.scale, Stroke::new(Layer::Selected, style));
    let behind = contact.point - contact.normal * (BEHIND / view.camera.scale);
    if contact.kind == Kind::Wall && on_canvas(view, contact.point).is_some() {
        let text = format!("w{}", contact.b);
        let (x, y) = view.project(behind);
        let (right, bottom) = (view.canvas.width() - 2 * text.len() as i32, view.canvas.height() - 1);
        let at = (x.round().clamp(0.0, f64::from(right.max(0))), y.round().clamp(0.0, f64::from(bottom)));
        view.canvas.text(at.0 as i32, at.1 as i32, &text, Stroke::new(Layer::Selected, style));
    }
}

/// Draws a sign at each contact point: a cross for an impact, a bullet for a rest, a small dot for what leaves.
fn draw_contacts(view: &mut View, sheet: &Sheet) {
    let [collides, rests, leaves] = sheet.glyphs.contact;
    for contact in &view.screen.snapshot.contacts {
        let (sign, style) = match contact.class {
            Class::Collide => (collides, sheet.palette.alarm().patch(sheet.palette.strong())),
            Class::Rest => (rests, sheet.palette.notice()),
            Class::Leave | Class::Release => (leaves, sheet.palette.plain()),
        };
        if let Some((x, y)) = on_canvas(view, contact.point) {
            view.canvas.sign(x, y, sign, Stroke::new(Layer::Contact, style));
        }
    }
}

/// Draws a sphere's number: in it if it is large enough, else to its upper right. The selected one's has a `#`.
fn draw_number(view: &mut View, sphere: usize, taken: &mut [bool], sheet: &Sheet) {
    let snapshot = view.screen.snapshot;
    let (Some(x), Some(radius)) = (snapshot.x.get(sphere), snapshot.stage.radii.get(sphere)) else { return };
    let selected = view.screen.view_settings.selected == Some(sphere);
    let (text, layer) =
        if selected { (format!("#{sphere}"), Layer::Selected) } else { (format!("{sphere}"), Layer::Contact) };
    let Some((x, y)) = on_canvas(view, *x) else { return };
    let (half, r) = (text.len() as i32, radius * view.camera.scale);
    // The text is 2 · half dots wide and 4 high; a ring of r dots holds it with a dot to spare on each side.
    let (x, y) = if r > f64::from(half) + 2.5 {
        (x - half + 1, y)
    } else {
        let aside = r.clamp(0.0, f64::from(view.canvas.width())) + if selected { 4.0 } else { 1.0 };
        (x + (aside * 0.8) as i32 + 1, y - (aside * 0.8) as i32 - 1)
    };
    if takes(view, (x, y), text.len(), taken) {
        view.canvas.text(x, y, &text, Stroke::new(layer, sheet.palette.strong()));
    }
}

/// Takes the cells of a text of so many characters that begins at a dot, and one beside it, unless one of them is taken.
fn takes(view: &View, (x, y): (i32, i32), length: usize, taken: &mut [bool]) -> bool {
    let columns = usize::from(view.area.width);
    let row = usize::try_from(y.div_euclid(4)).ok();
    let cells: Vec<usize> = (0..=length as i32)
        .filter_map(|i| usize::try_from((x + 2 * i).div_euclid(2)).ok().filter(|column| *column < columns))
        .filter_map(|column| Some(row? * columns + column).filter(|cell| *cell < taken.len()))
        .collect();
    let free = cells.iter().all(|cell| !taken[*cell]);
    if free {
        cells.iter().for_each(|cell| taken[*cell] = true);
    }
    free
}

/// The dot a point falls on, if it is on the canvas.
fn on_canvas(view: &View, point: DVec3) -> Option<(i32, i32)> {
    let (x, y) = view.project(point);
    let (width, height) = (f64::from(view.canvas.width()), f64::from(view.canvas.height()));
    let inside = x >= -0.5 && y >= -0.5 && x < width - 0.5 && y < height - 0.5;
    inside.then(|| (x.round() as i32, y.round() as i32))
}
