//! What is under a cell of the screen: the way back from cells to metres and seconds.

use glam::DVec3;
use ratatui::layout::{Position, Rect};

use super::{
    draw::extent,
    layout::{Plan, sizes},
    projection::{ACROSS, Camera, DOWN},
    screen::{Popup, Screen, ViewSettings},
    side::Side,
    timeline,
};
use crate::snapshot::Contact;

/// A view with a cell of it that is pointed at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aim {
    side: Side,
    canvas: Rect,
    camera: Camera,
}

/// What is nearest to a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// The sphere of that index.
    Sphere(usize),
    /// The contact of that index in the snapshot.
    Contact(usize),
}

impl Aim {
    /// The view that holds the cell, as the screen is drawn in `area`; none if no view does.
    pub fn at(screen: &Screen, area: Rect, at: Position) -> Option<Aim> {
        let (Popup::None | Popup::Prompt { .. }) = screen.popup else { return None };
        let (snapshot, settings) = (screen.snapshot, screen.view_settings);
        let Plan::Full(plan) = Plan::new(area, settings, extent(&snapshot.stage)) else { return None };
        let sizes = sizes(&plan.panes);
        let pane = plan.panes.into_iter().find(|pane| pane.canvas.contains(at))?;
        let followed = settings.selected.filter(|_| settings.follow).and_then(|i| snapshot.x.get(i).copied());
        let camera = Camera::new(settings, &snapshot.stage, followed, sizes);
        Some(Aim { side: pane.side, canvas: pane.canvas, camera })
    }

    /// The way from the centre of the view to the centre of a cell, m; 0 along the line of sight.
    pub fn offset(&self, at: Position) -> DVec3 {
        let middle = |from: u16, length: u16| f64::from(from) + f64::from(length) * 0.5 - 0.5;
        let columns = f64::from(at.x) - middle(self.canvas.x, self.canvas.width);
        let rows = f64::from(at.y) - middle(self.canvas.y, self.canvas.height);
        self.shift(columns, rows)
    }

    /// The way across `columns` cells to the right and `rows` cells down, m.
    pub fn shift(&self, columns: f64, rows: f64) -> DVec3 {
        let (right, down) = (columns * f64::from(ACROSS), rows * f64::from(DOWN));
        let across = match self.side {
            Side::Side => DVec3::new(right, -down, 0.0),
            Side::Top => DVec3::new(right, 0.0, down),
        };
        across / self.camera.scale
    }

    /// The sphere or, where contacts are marked, the contact nearest to a cell: by the distance on the screen from the
    /// cell's centre to the disc of the one or the point of the other. A contact within a cell wins over a sphere.
    pub fn nearest(&self, screen: &Screen, at: Position) -> Option<Target> {
        let snapshot = screen.snapshot;
        let (column, row) = (f64::from(at.x - self.canvas.x), f64::from(at.y - self.canvas.y));
        let cell = ((column + 0.5) * f64::from(ACROSS) - 0.5, (row + 0.5) * f64::from(DOWN) - 0.5);
        let distance = |point: DVec3| {
            let (x, y) = self.camera.project(self.side, point, self.canvas);
            ((x - cell.0) * (x - cell.0) + (y - cell.1) * (y - cell.1)).sqrt()
        };
        let marked: &[Contact] = if screen.view_settings.overlays.contacts { &snapshot.contacts } else { &[] };
        let contact = least(marked.iter().map(|contact| distance(contact.point)));
        if let Some((index, away)) = contact
            && away <= f64::from(DOWN) * 0.5
        {
            return Some(Target::Contact(index));
        }
        let discs = snapshot.x.iter().zip(&snapshot.stage.radii);
        // Within a disc the one whose centre is nearest; a thousandth of the way there tells discs that overlap apart.
        let sphere = least(discs.map(|(x, radius)| {
            let away = distance(*x);
            (away - radius * self.camera.scale).max(0.0) + 1e-3 * away
        }));
        match (sphere, contact) {
            (Some((_, near)), Some((index, away))) if away < near => Some(Target::Contact(index)),
            (Some((index, _)), _) => Some(Target::Sphere(index)),
            (None, contact) => contact.map(|(index, _)| Target::Contact(index)),
        }
    }
}

/// Index and value of the least; NaN is left out.
fn least(values: impl Iterator<Item = f64>) -> Option<(usize, f64)> {
    values.enumerate().filter(|(_, value)| value.is_finite()).min_by(|a, b| a.1.total_cmp(&b.1))
}

/// The time, s, of a cell of the timeline; none if the cell is not on it.
pub fn time_at(screen: &Screen, area: Rect, at: Position) -> Option<f64> {
    let Plan::Full(plan) = Plan::new(area, screen.view_settings, DVec3::ZERO) else { return None };
    let row = plan.timeline.filter(|row| row.contains(at))?;
    timeline::time_at(screen, row, at.x)
}

/// The row of the timeline on a screen of that size and settings, if it has one.
pub fn timeline_row(settings: &ViewSettings, area: Rect) -> Option<u16> {
    let Plan::Full(plan) = Plan::new(area, settings, DVec3::ZERO) else { return None };
    plan.timeline.map(|row| row.y)
}
