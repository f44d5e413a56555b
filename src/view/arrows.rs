//! Impulses and support forces, as arrows to a scale that the view's label states.

use glam::DVec3;

use super::{
    canvas::{Layer, Stroke},
    pane::View,
    shapes,
    sheet::Sheet,
};
use crate::explain;
use crate::format;
use crate::snapshot::{Class, Contact, Kind, Snapshot};

/// Part of the view's width that the longest arrow takes at most.
const LONGEST: f64 = 0.2;

/// Cells of a view that there are for each contact's arrows: with fewer they are drawn over each other, and none can be
/// read.
const CELLS: usize = 24;

/// Length of an arrow head's barbs, dots; shorter arrows have none.
const BARB: f64 = 3.0;

/// What an arrow stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    /// The impulse of an impact, N s.
    Impulse,
    /// The support force of a contact at rest, N.
    Force,
}

impl Quantity {
    /// Whether the quantity is drawn.
    pub(super) fn is_shown(self, view: &View) -> bool {
        let overlays = view.screen.view_settings.overlays;
        match self {
            Quantity::Impulse => overlays.impulses,
            Quantity::Force => overlays.forces,
        }
    }

    /// The quantity of a contact, N s or N; none if it has none.
    fn of(self, snapshot: &Snapshot, contact: &Contact) -> Option<f64> {
        let amount = match self {
            Quantity::Impulse => (contact.class == Class::Collide).then_some(contact.impulse),
            Quantity::Force => explain::support_force(snapshot, contact),
        };
        amount.filter(|amount| amount.is_finite() && *amount > 0.0)
    }

    /// The contacts whose arrows are drawn, and how the label names the choice, if not all are: where they would lie over
    /// each other, those of the selected sphere and of what it touches, or else the largest.
    fn drawn(self, view: &View) -> (Vec<usize>, String) {
        let snapshot = view.screen.snapshot;
        let amount = |index: usize| self.of(snapshot, &snapshot.contacts[index]);
        let mut all: Vec<usize> = (0..snapshot.contacts.len()).filter(|index| amount(*index).is_some()).collect();
        let most = usize::from(view.area.width) * usize::from(view.area.height) / CELLS;
        if all.len() <= most {
            return (all, String::new());
        }
        if let Some(selected) = view.screen.view_settings.selected {
            let has = |index: usize, sphere: usize| bodies(&snapshot.contacts[index]).contains(&Some(sphere));
            let touched: Vec<usize> = all.iter().filter(|index| has(**index, selected)).copied().collect();
            let near: Vec<usize> =
                touched.iter().flat_map(|index| bodies(&snapshot.contacts[*index])).flatten().collect();
            all.retain(|index| near.iter().any(|sphere| has(*index, *sphere)));
            return (all, format!(" at #{selected}"));
        }
        all.sort_by(|a, b| amount(*b).unwrap_or(0.0).total_cmp(&amount(*a).unwrap_or(0.0)));
        all.truncate(most);
        (all, format!(" top {most}"))
    }

    /// What an arrow of the length of a metre stands for, if there is an arrow: so much that the longest takes a fifth of
    /// the width, to a round number, so that arrows of different frames can be compared.
    fn per_meter(self, view: &View) -> Option<f64> {
        let snapshot = view.screen.snapshot;
        let most = snapshot.contacts.iter().filter_map(|contact| self.of(snapshot, contact)).fold(0.0, f64::max);
        let least = most / (view.camera.span(view.area).x * LONGEST);
        // 1/round_down(1/x) is x rounded up to a round number
        (least.is_finite() && least > 0.0).then(|| 1.0 / format::round_down(1.0 / least))
    }

    /// The scale for the view's label, if it is shown and there is an arrow.
    pub(super) fn label(self, view: &View) -> Option<String> {
        let per_meter = self.per_meter(view).filter(|_| self.is_shown(view))?;
        let (sign, unit) = match self {
            Quantity::Impulse => ("J", "N s"),
            Quantity::Force => ("F", "N"),
        };
        Some(format!("  {sign} {} {unit}/m{}", format::setting(per_meter), self.drawn(view).1))
    }

    /// Draws an arrow on each sphere that is pushed, along the contact's normal.
    pub(super) fn draw(self, view: &mut View, sheet: &Sheet) {
        let Some(per_meter) = self.per_meter(view).filter(|_| self.is_shown(view)) else { return };
        let style = match self {
            Quantity::Impulse => sheet.palette.alarm(),
            Quantity::Force => sheet.palette.notice(),
        };
        let stroke = Stroke::new(Layer::Arrow, style);
        let snapshot = view.screen.snapshot;
        for index in self.drawn(view).0 {
            let contact = &snapshot.contacts[index];
            if let Some(amount) = self.of(snapshot, contact) {
                draw_pushes(view, contact, amount / per_meter, stroke);
            }
        }
    }
}

/// The spheres of a contact.
fn bodies(contact: &Contact) -> [Option<usize>; 2] {
    [Some(contact.a), (contact.kind == Kind::Pair).then_some(contact.b)]
}

/// Draws arrows of `length` (m) along a contact's normal, outside the spheres that it pushes.
pub(super) fn draw_pushes(view: &mut View, contact: &Contact, length: f64, stroke: Stroke) {
    let snapshot = view.screen.snapshot;
    let other = (contact.kind == Kind::Pair).then_some((contact.b, -contact.normal));
    for (sphere, normal) in [(contact.a, contact.normal)].into_iter().chain(other) {
        let (Some(x), Some(radius)) = (snapshot.x.get(sphere), snapshot.stage.radii.get(sphere)) else { continue };
        let rim = *x + normal * *radius;
        draw_arrow(view, rim, rim + normal * length, stroke);
    }
}

/// Draws a line from one point of the world (m) to another, with two barbs at 45° to it.
pub(super) fn draw_arrow(view: &mut View, from: DVec3, to: DVec3, stroke: Stroke) {
    let (tail, tip) = (view.project(from), view.project(to));
    if tail == tip {
        return;
    }
    shapes::line(&mut view.canvas, tail, tip, stroke);
    let (dx, dy) = (tip.0 - tail.0, tip.1 - tail.1);
    let length = (dx * dx + dy * dy).sqrt();
    if length.is_nan() || length < BARB + 1.0 {
        return;
    }
    let (ux, uy) = (dx / length * BARB * 0.7, dy / length * BARB * 0.7);
    shapes::line(&mut view.canvas, tip, (tip.0 - ux - uy, tip.1 - uy + ux), stroke);
    shapes::line(&mut view.canvas, tip, (tip.0 - ux + uy, tip.1 - uy - ux), stroke);
}
