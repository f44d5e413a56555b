//! What goes where: pure arithmetic on rectangles.

use glam::DVec3;
use ratatui::layout::Rect;

use super::projection::{Sizes, fit};
use super::screen::{ViewSettings, Views};
use super::side::Side;

/// Factor by which the views one over the other must draw the scene larger to stand so.
const LARGER: f64 = 1.15;

/// Depth over height from which a scene lies flat: what happens in it is seen from above.
const FLAT: f64 = 2.0;

/// Rows that each of two views over each other has at least.
const FEWEST: u16 = 3;

/// Columns from which on a third column holds the inspector.
const WIDE: u16 = 110;

/// The screen's plan, by its size.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Plan {
    /// Under 12×3 cells: only that the screen is too small.
    TooSmall,
    /// Under 30×8 cells: numbers only.
    Numbers {
        /// The whole screen.
        area: Rect,
    },
    /// Anything larger: a picture.
    Full(Full),
}

/// A screen with a picture.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Full {
    /// The first row.
    pub(super) status: Rect,
    /// Everything between status and timeline: panes and inspector, or a popup in their place.
    pub(super) body: Rect,
    /// The views, of equal size so that the same x is in the same column of each.
    pub(super) panes: Vec<Pane>,
    /// The inspector's place, if it is shown.
    pub(super) inspector: Option<Rect>,
    /// Where the exact run is compared, if it was asked for.
    pub(super) trade: Option<Rect>,
    /// The timeline's row, if there is room.
    pub(super) timeline: Option<Rect>,
    /// Last row: hints, message or prompt.
    pub(super) last: Rect,
}

/// One view: a row for its label over the dots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pane {
    /// Which projection.
    pub(super) side: Side,
    /// The label's row.
    pub(super) label: Rect,
    /// The place of the dots.
    pub(super) canvas: Rect,
}

impl Plan {
    /// The plan for an area and a scene whose view box has this extent, m.
    pub(super) fn new(area: Rect, settings: &ViewSettings, extent: DVec3) -> Plan {
        if area.width < 12 || area.height < 3 {
            return Plan::TooSmall;
        }
        if area.width < 30 || area.height < 8 {
            return Plan::Numbers { area };
        }
        let (rest, last) = split_bottom(area, 1);
        let (status, rest) = split_top(rest, 1);
        let (body, timeline) = split_bottom(rest, u16::from(area.height >= 11));
        let (views, inspector) = split_inspector(body, area, settings);
        let (views, trade) = split_bottom(views, if settings.ghost { trade_rows(views.height) } else { 0 });
        let trade = (!trade.is_empty()).then_some(trade);
        let panes = panes(views, area, settings, (inspector.is_some(), extent));
        let timeline = (timeline.height > 0).then_some(timeline);
        Plan::Full(Full { status, body, panes, inspector, trade, timeline, last })
    }
}

/// Rows of the comparison with the exact run under views of so many rows: whole, one row, or none.
fn trade_rows(views: u16) -> u16 {
    match views {
        15.. => 6,
        4.. => 1,
        _ => 0,
    }
}

/// Whether a screen of that size shows the inspector, or a card in its place.
pub fn inspector_is_shown(settings: &ViewSettings, area: Rect) -> bool {
    settings.card.is_some() || settings.inspector.unwrap_or(area.width >= WIDE)
}

/// The views' part of the body and the inspector's: a third column if wide, else in the side view's place, if at all.
fn split_inspector(body: Rect, area: Rect, settings: &ViewSettings) -> (Rect, Option<Rect>) {
    if !inspector_is_shown(settings, area) {
        return (body, None);
    }
    if area.width >= WIDE {
        let width = (area.width / 4).clamp(30, 42);
        let (views, inspector) = split_right(body, width);
        return (views, Some(inspector));
    }
    if area.width < 60 || area.height < 16 {
        return (Rect { width: 0, ..body }, Some(body));
    }
    let (inspector, views) = split_left(body, body.width / 2);
    (views, Some(inspector))
}

/// The panes: two of equal width where both are wanted and fit, side by side or one over the other, whichever draws the
/// scene of this extent (m) larger.
fn panes(views: Rect, area: Rect, settings: &ViewSettings, (inspected, extent): (bool, DVec3)) -> Vec<Pane> {
    let narrow = area.width < 60 || area.height < 16;
    let replaced = inspected && area.width < WIDE;
    match settings.views {
        _ if views.is_empty() => Vec::new(),
        Views::Side => vec![pane(Side::Side, views)],
        Views::Top => vec![pane(Side::Top, views)],
        // A card explains the contact in the view that shows slopes, or from above where a scene lies flat.
        Views::Both if replaced && settings.card.is_some() && extent.z > FLAT * extent.y => {
            vec![pane(Side::Top, views)]
        }
        Views::Both if replaced && settings.card.is_some() => vec![pane(Side::Side, views)],
        Views::Both if replaced => vec![pane(Side::Top, views)],
        Views::Both if narrow => vec![pane(Side::Side, views)],
        Views::Both => {
            let (beside, over) = (beside(views), over(views, extent));
            let scale = |panes: &[Pane; 2]| fit(extent, sizes(panes));
            let stacked = scale(&over) > LARGER * scale(&beside);
            Vec::from(if stacked { over } else { beside })
        }
    }
}

/// The panes side by side. An odd column is left free in the middle: equal widths keep one x in one column of both.
fn beside(views: Rect) -> [Pane; 2] {
    let (left, rest) = split_left(views, views.width / 2);
    let (_, right) = split_right(rest, views.width / 2);
    [pane(Side::Side, left), pane(Side::Top, right)]
}

/// The side view over the top-down view, each as high as the scene's extent (m) in it asks for.
fn over(views: Rect, extent: DVec3) -> [Pane; 2] {
    let rows = views.height.saturating_sub(2);
    let share = extent.y / (extent.y + extent.z);
    let side = if share.is_finite() { (f64::from(rows) * share).round() as u16 } else { rows / 2 };
    let side = side.clamp(FEWEST.min(rows / 2), rows - FEWEST.min(rows / 2));
    let (upper, lower) = split_top(views, side + 1);
    [pane(Side::Side, upper), pane(Side::Top, lower)]
}

/// The sizes of both views; of one alone, as if the other had as many cells.
pub(super) fn sizes(panes: &[Pane]) -> Sizes {
    let of = |side: Side| panes.iter().find(|pane| pane.side == side).or(panes.first());
    let size = |side: Side| of(side).map_or_else(Rect::default, |pane| pane.canvas);
    Sizes { side: size(Side::Side), top: size(Side::Top) }
}

/// A pane with its label on top.
fn pane(side: Side, area: Rect) -> Pane {
    let (label, canvas) = split_top(area, 1);
    Pane { side, label, canvas }
}

/// The first `rows` rows, and the rest.
pub(super) fn split_top(area: Rect, rows: u16) -> (Rect, Rect) {
    let rows = rows.min(area.height);
    (Rect { height: rows, ..area }, Rect { y: area.y + rows, height: area.height - rows, ..area })
}

/// The rest, and the last `rows` rows.
pub(super) fn split_bottom(area: Rect, rows: u16) -> (Rect, Rect) {
    let (rest, bottom) = split_top(area, area.height.saturating_sub(rows));
    (rest, bottom)
}

/// The first `columns` columns, and the rest.
pub(super) fn split_left(area: Rect, columns: u16) -> (Rect, Rect) {
    let columns = columns.min(area.width);
    (Rect { width: columns, ..area }, Rect { x: area.x + columns, width: area.width - columns, ..area })
}

/// The rest, and the last `columns` columns.
pub(super) fn split_right(area: Rect, columns: u16) -> (Rect, Rect) {
    split_left(area, area.width.saturating_sub(columns))
}
