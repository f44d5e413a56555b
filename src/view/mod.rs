//! Snapshot + look → ratatui `Buffer`. No clock, no input, no environment: a frame test builds a snapshot by hand.

use glam::DVec3;
use ratatui::{buffer::Buffer, layout::Rect};

use crate::snapshot::{Snapshot, Ticks};

/// Everything one frame shows.
#[derive(Debug, Clone, Copy)]
pub struct Screen<'a> {
    /// The run at the end of the frame shown (its `stage` tells what is constant).
    pub snapshot: &'a Snapshot,
    /// Pace of the run.
    pub pace: Pace,
    /// Collisions so far.
    pub ticks: &'a Ticks,
    /// What the user chose to look at, and how.
    pub look: &'a Look,
    /// What lies over the views.
    pub popup: Popup<'a>,
    /// One line of news in place of the key hints.
    pub message: Option<&'a str>,
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
    /// Dots or characters.
    pub marker: Marker,
    /// Depth of colour.
    pub colors: Colors,
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

/// Draws the frame. Any area, 0×0 included.
pub fn draw(screen: &Screen, area: Rect, buffer: &mut Buffer) {
    let _ = (screen, area, buffer);
}
