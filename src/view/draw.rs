//! One frame, each part in its place; and where those places are.

use glam::DVec3;
use ratatui::{
    buffer::Buffer,
    layout::{Position, Rect},
};

use super::{
    card, events, help, inspector,
    layout::{self, Plan},
    projection, prompt, scenes,
    screen::{Popup, Screen, ViewSettings},
    sheet::Sheet,
    stage, status, timeline, trade,
};
use crate::snapshot::Stage;

/// Draws the frame into `area`, and only there. Any area is fine, 0×0 included; the part outside the buffer is left out.
///
/// Every cell of `area` is written, so the buffer need not be cleared first.
pub fn draw(screen: &Screen, area: Rect, buffer: &mut Buffer) {
    let area = area.intersection(*buffer.area());
    let mut sheet = Sheet::new(buffer, screen.view_settings);
    sheet.clear(area);
    match Plan::new(area, screen.view_settings, extent(&screen.snapshot.stage)) {
        Plan::TooSmall => {
            let plain = sheet.palette.plain();
            sheet.put(area, &format!("too small {}x{}", area.width, area.height), plain);
        }
        Plan::Numbers { area } => draw_numbers(screen, area, &mut sheet),
        Plan::Full(full) => {
            draw_full(screen, &full, &mut sheet);
            prompt::draw_last_row(screen, area, &mut sheet);
        }
    }
}

/// Draws status, views, inspector and timeline, each where the plan has room for it.
fn draw_full(screen: &Screen, plan: &layout::Full, sheet: &mut Sheet) {
    status::draw(screen, plan.status, sheet);
    if !draw_popup(screen, plan.body, sheet) {
        let sizes = layout::sizes(&plan.panes);
        for pane in &plan.panes {
            stage::draw(screen, pane, sizes, sheet);
        }
        if let Some(area) = plan.inspector {
            match screen.view_settings.card {
                Some(card) => card::draw(screen, card, area, sheet),
                None => inspector::draw(screen, area, sheet),
            }
        }
        if let (Some(area), Some(comparison)) = (plan.trade, &screen.comparison) {
            trade::draw(screen, comparison, area, sheet);
        }
        status::draw_alarm(screen, plan.body, sheet);
        status::draw_stall(screen, plan.body, sheet);
    }
    if let Some(area) = plan.timeline {
        timeline::draw(screen, area, sheet);
    }
}

/// Draws numbers only, for screens too small for a picture; popups and the prompt still show.
fn draw_numbers(screen: &Screen, area: Rect, sheet: &mut Sheet) {
    let (body, _) = layout::split_bottom(area, 1);
    let speaking = screen.message.is_some() || matches!(screen.popup, Popup::Prompt { .. });
    if !draw_popup(screen, if speaking { body } else { area }, sheet) {
        status::draw_numbers(screen, if speaking { body } else { area }, sheet);
    }
    if speaking {
        prompt::draw_last_row(screen, area, sheet);
    }
}

/// Draws the popup that takes the views' place; false if none does.
fn draw_popup(screen: &Screen, body: Rect, sheet: &mut Sheet) -> bool {
    match screen.popup {
        Popup::None | Popup::Prompt { .. } => return false,
        Popup::Events(list) => events::draw(&list, screen.snapshot, body, sheet),
        Popup::Help { rows, scroll } => help::draw(rows, scroll, body, sheet),
        Popup::Scenes { filter, filtering, entries, cursor } => {
            scenes::draw(&scenes::List { filter, filtering, entries, cursor }, body, sheet);
        }
    }
    true
}

/// Where the terminal's own cursor belongs while text is typed (prompt, filter); `None`: hidden.
pub fn cursor(screen: &Screen, area: Rect) -> Option<Position> {
    let (body, last) = popup_places(screen.view_settings, area)?;
    match screen.popup {
        Popup::Prompt { text, cursor, .. } => prompt::cursor(text, cursor, last),
        Popup::Events(list) => events::cursor(list.typed, body),
        Popup::Scenes { filter, filtering: true, .. } => scenes::cursor(filter, body),
        _ => None,
    }
}

/// How far the key table can be scrolled down at this size: rows of it that do not fit.
pub fn help_scroll_limit(rows: &[(&str, &str)], settings: &ViewSettings, area: Rect) -> usize {
    popup_places(settings, area).map_or(0, |(body, _)| help::scroll_limit(rows, settings.marker, body))
}

/// The places of lists and of the prompt, if there is room for any.
fn popup_places(settings: &ViewSettings, area: Rect) -> Option<(Rect, Rect)> {
    match Plan::new(area, settings, DVec3::ZERO) {
        Plan::TooSmall => None,
        Plan::Numbers { area } => Some((area, layout::split_bottom(area, 1).1)),
        Plan::Full(full) => Some((full.body, full.last)),
    }
}

/// What one view shows of the world at this size, m: width along x, height along y (side), height along z (top-down).
///
/// A pan step is a fraction of it. Where no view is drawn, the extent of the scene's own view box over the zoom.
pub fn visible_span(settings: &ViewSettings, stage: &Stage, area: Rect) -> DVec3 {
    let panes = match Plan::new(area, settings, extent(stage)) {
        Plan::Full(full) => full.panes,
        _ => Vec::new(),
    };
    if panes.is_empty() {
        return extent(stage) / projection::sane_zoom(settings.zoom);
    }
    let sizes = layout::sizes(&panes);
    let camera = projection::Camera::new(settings, stage, None, sizes);
    let (side, top) = (camera.span(sizes.side), camera.span(sizes.top));
    DVec3::new(side.x, side.y, top.z)
}

/// The extent of the scene's own view box, m.
pub(super) fn extent(stage: &Stage) -> DVec3 {
    stage.view.max - stage.view.min
}
