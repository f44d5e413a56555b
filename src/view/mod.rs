//! Snapshot + look → ratatui `Buffer`. No clock, no input, no environment: a frame test builds a snapshot by hand.
//!
//! `layout` says what goes where, `projection` turns metres into dots, `canvas` and `shapes` turn dots into cells,
//! `stage` draws walls and spheres, `overlays` what lies on them; the rest is one file per strip or popup. Every
//! string goes through `sheet`, the only place that writes text into the buffer, so that nothing leaves its area and
//! the ASCII marker means ASCII everywhere.

mod canvas;
mod glyphs;
mod help;
mod inspector;
mod layout;
mod numbers;
mod overlays;
mod palette;
mod probes;
mod projection;
mod prompt;
mod scenes;
mod shapes;
mod sheet;
mod stage;
mod status;
mod timeline;
mod trade;

use glam::DVec3;
use ratatui::{
    buffer::Buffer,
    layout::{Position, Rect},
};

use self::{layout::Plan, sheet::Sheet};
use crate::snapshot::{Ghost, Snapshot, Stage, Ticks, Trade};

/// Everything one frame shows.
#[derive(Debug, Clone, Copy)]
pub struct Screen<'a> {
    /// The run at the end of the frame shown (its `stage` tells what is constant).
    pub snapshot: &'a Snapshot,
    /// Pace of the run.
    pub pace: Pace,
    /// Collisions so far.
    pub ticks: &'a Ticks,
    /// The exact run beside this one, where it was asked for.
    pub beside: Option<Beside<'a>>,
    /// What the user chose to look at, and how.
    pub look: &'a Look,
    /// What lies over the views.
    pub popup: Popup<'a>,
    /// One line of news in place of the key hints.
    pub message: Option<&'a str>,
    /// Key hints of the last row, (keys, what they do), the most useful first: as many as fit are shown.
    pub hints: &'a [(&'a str, &'a str)],
}

/// The exact run beside the one shown, and what its accuracy costs.
#[derive(Debug, Clone, Copy)]
pub struct Beside<'a> {
    /// Where the exact run is, once it has reached a moment that was shown.
    pub ghost: Option<&'a Ghost>,
    /// Errors and costs over time.
    pub trade: &'a Trade,
}

/// Whether and how fast the run goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// The word of the status line.
    pub mode: Mode,
    /// Simulated seconds per second asked for.
    pub wanted: f64,
    /// Simulated seconds per second reached, once measured.
    pub reached: Option<f64>,
}

/// The word of the status line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// Running.
    Run,
    /// Paused at the newest frame.
    Pause,
    /// The run cannot go on.
    Stalled,
}

/// What the user chose to look at, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct Look {
    /// Which projections.
    pub views: Views,
    /// Zoom factor over the scene's own view box; 1 shows the whole scene.
    pub zoom: f64,
    /// Shift of the centre of view from the centre of the scene's view box, m.
    pub pan: DVec3,
    /// Keep the selected sphere in the centre.
    pub follow: bool,
    /// The selected sphere.
    pub selected: Option<usize>,
    /// Which overlays are drawn.
    pub overlays: Overlays,
    /// Whether the inspector was asked for; wide screens always show it.
    pub inspector: bool,
    /// Whether the exact run is shown beside this one.
    pub ghost: bool,
    /// Dots or characters.
    pub marker: Marker,
    /// Depth of colour.
    pub colors: Colors,
}

impl Default for Look {
    /// The whole scene in both views, contacts marked, in braille dots and the terminal's own colours.
    fn default() -> Look {
        Look {
            views: Views::Both,
            zoom: 1.0,
            pan: DVec3::ZERO,
            follow: false,
            selected: None,
            overlays: Overlays { contacts: true, ..Overlays::default() },
            inspector: false,
            ghost: false,
            marker: Marker::Braille,
            colors: Colors::Ansi16,
        }
    }
}

/// Which projections are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Views {
    /// Side and top-down, sharing the x axis.
    Both,
    /// Side: x right, y up.
    Side,
    /// Top-down: x right, z down the screen.
    Top,
}

/// What is drawn over the spheres.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Overlays {
    /// Contact points.
    pub contacts: bool,
    /// Contact normals.
    pub normals: bool,
    /// Velocity arrows.
    pub velocities: bool,
    /// Sphere numbers.
    pub ids: bool,
}

/// How dots become characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// 2×4 dots a cell.
    Braille,
    /// 2×2 quadrant blocks a cell.
    Block,
    /// Plain ASCII.
    Ascii,
}

/// Depth of colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Colors {
    /// None; bold and reverse stay.
    Never,
    /// The terminal's own 16.
    Ansi16,
    /// The 256-colour cube.
    Ansi256,
    /// 24 bits.
    Rgb,
}

/// What lies over the views.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Popup<'a> {
    /// Nothing.
    None,
    /// The key table: (keys, what they do), scrolled down by so many rows.
    Help {
        /// Rows of the table.
        rows: &'a [(&'a str, &'a str)],
        /// Rows scrolled down.
        scroll: usize,
    },
    /// The scene list.
    Scenes {
        /// What was typed after `/`; `filtering` tells whether it is being typed.
        filter: &'a str,
        /// Whether the filter has the keyboard.
        filtering: bool,
        /// The scenes that pass the filter: (name, about).
        entries: &'a [(&'a str, &'a str)],
        /// The one under the cursor.
        cursor: usize,
    },
    /// The `:` line, as typed so far, with the byte offset of its cursor.
    Prompt {
        /// Text after the colon.
        text: &'a str,
    },
}

/// Draws the frame into `area`, and only there. Any area is fine, 0×0 included; the part outside the buffer is left out.
///
/// Every cell of `area` is written, so the buffer need not be cleared first.
pub fn draw(screen: &Screen, area: Rect, buffer: &mut Buffer) {
    let area = area.intersection(*buffer.area());
    let mut sheet = Sheet::new(buffer, screen.look);
    sheet.clear(area);
    match Plan::new(area, screen.look) {
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

/// Status, views, inspector and timeline, each where the plan has room for it.
fn draw_full(screen: &Screen, plan: &layout::Full, sheet: &mut Sheet) {
    status::draw(screen, plan.status, sheet);
    if !draw_popup(screen, plan.body, sheet) {
        for pane in &plan.panes {
            stage::draw(screen, pane, sheet);
        }
        if let Some(area) = plan.inspector {
            inspector::draw(screen, area, sheet);
        }
        if let (Some(area), Some(beside)) = (plan.trade, &screen.beside) {
            trade::draw(screen, beside, area, sheet);
        }
        status::draw_alarm(screen, plan.body, sheet);
        status::draw_stall(screen, plan.body, sheet);
    }
    if let Some(area) = plan.timeline {
        timeline::draw(screen, area, sheet);
    }
}

/// Numbers only, for screens too small for a picture; popups and the prompt still show.
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
        Popup::Help { rows, scroll } => help::draw(rows, scroll, body, sheet),
        Popup::Scenes { filter, filtering, entries, cursor } => {
            scenes::draw(&scenes::List { filter, filtering, entries, cursor }, body, sheet);
        }
    }
    true
}

/// Where the terminal's own cursor belongs while text is typed (prompt, filter); `None`: hidden.
pub fn cursor(screen: &Screen, area: Rect) -> Option<Position> {
    let (body, last) = popup_places(screen.look, area)?;
    match screen.popup {
        Popup::Prompt { text } => prompt::cursor(text, last),
        Popup::Scenes { filter, filtering: true, .. } => scenes::cursor(filter, body),
        _ => None,
    }
}

/// How far the key table can be scrolled down at this size: rows of it that do not fit.
pub fn help_scroll_limit(rows: &[(&str, &str)], look: &Look, area: Rect) -> usize {
    popup_places(look, area).map_or(0, |(body, _)| help::scroll_limit(rows, body))
}

/// (where lists go, where the prompt goes), if there is room for any.
fn popup_places(look: &Look, area: Rect) -> Option<(Rect, Rect)> {
    match Plan::new(area, look) {
        Plan::TooSmall => None,
        Plan::Numbers { area } => Some((area, layout::split_bottom(area, 1).1)),
        Plan::Full(full) => Some((full.body, full.last)),
    }
}

/// What one view shows of the world at this size, m: width along x, height along y (side), height along z (top-down).
///
/// A pan step is a fraction of it. Where no view is drawn, the extent of the scene's own view box over the zoom.
pub fn visible_span(look: &Look, stage: &Stage, area: Rect) -> DVec3 {
    let pane = match Plan::new(area, look) {
        Plan::Full(full) => full.panes.first().map(|pane| pane.canvas),
        _ => None,
    };
    match pane {
        Some(canvas) => projection::Camera::new(look, stage, None, canvas).span(canvas),
        None => (stage.view.max - stage.view.min) / projection::sane_zoom(look.zoom),
    }
}
