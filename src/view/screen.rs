//! Everything that a frame shows: what a caller fills in, and every part of the view reads.

use std::sync::Arc;

use glam::DVec3;

use super::ink::{Background, Inks};
use crate::snapshot::{Ahead, EventFilter, EventLog, Ghost, Kept, Snapshot, Ticks, Trade};

/// Everything one frame shows.
#[derive(Debug, Clone, Copy)]
pub struct Screen<'a> {
    /// The run at the end of the frame shown (its `stage` tells what is constant).
    pub snapshot: &'a Snapshot,
    /// Pace of the run.
    pub pace: Pace,
    /// Collisions so far.
    pub ticks: &'a Ticks,
    /// Which frames can be gone to.
    pub kept: Kept,
    /// Where all spheres were in the last frames, the one shown included, the newest last, m, if that is known.
    pub trail: &'a [Arc<Vec<DVec3>>],
    /// What comes next of the selected sphere, if that is known.
    pub ahead: Option<&'a Ahead>,
    /// What has happened so far.
    pub log: Option<&'a EventLog>,
    /// Frames of the recording under way.
    pub recorded: Option<u64>,
    /// The exact run beside this one, where it was asked for.
    pub comparison: Option<Comparison<'a>>,
    /// What the user chose to look at, and how.
    pub view_settings: &'a ViewSettings,
    /// What lies over the views.
    pub popup: Popup<'a>,
    /// One line of news in place of the key hints.
    pub message: Option<&'a str>,
    /// Key hints of the last row, (keys, what they do), the most useful first: as many as fit are shown.
    pub hints: &'a [(&'a str, &'a str)],
}

/// The exact run beside the one shown, and what its accuracy costs.
#[derive(Debug, Clone, Copy)]
pub struct Comparison<'a> {
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
    /// Paused at an earlier frame, or on the way there.
    Back,
    /// The run cannot go on.
    Stalled,
}

/// What the user chose to look at, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct ViewSettings {
    /// Which projections.
    pub views: Views,
    /// Zoom factor over the scene's own view box; 1 shows the whole scene.
    pub zoom: f64,
    /// Shift of the centre of view from the centre of the scene's view box, m.
    pub pan: DVec3,
    /// Whether the selected sphere stays in the centre.
    pub follow: bool,
    /// The selected sphere.
    pub selected: Option<usize>,
    /// Which overlays are drawn.
    pub overlays: Overlays,
    /// Whether the inspector is shown; none: on wide screens.
    pub inspector: Option<bool>,
    /// The card of a contact in the inspector's place, if it is open.
    pub card: Option<CardView>,
    /// Whether the exact run is shown beside this one.
    pub ghost: bool,
    /// Dots or characters.
    pub marker: Marker,
    /// Depth of colour.
    pub colors: Colors,
    /// What is behind the text.
    pub background: Background,
    /// The user's own colours.
    pub inks: Inks,
}

impl Default for ViewSettings {
    /// The whole scene in both views, contacts marked, in braille dots and the terminal's own colours.
    fn default() -> ViewSettings {
        ViewSettings {
            views: Views::Both,
            zoom: 1.0,
            pan: DVec3::ZERO,
            follow: false,
            selected: None,
            overlays: Overlays { contacts: true, ..Overlays::default() },
            inspector: None,
            card: None,
            ghost: false,
            marker: Marker::Braille,
            colors: Colors::Ansi16,
            background: Background::default(),
            inks: Inks::default(),
        }
    }
}

/// Which contact's card is open, and how far it is scrolled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CardView {
    /// The contact: its place among the frame's contacts, the selected sphere's first.
    pub cursor: usize,
    /// Rows scrolled down.
    pub scroll: usize,
    /// The trial step of the frame's search that the views show, if they show one.
    pub probe: Option<usize>,
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
    /// Impulses of impacts, as arrows to a scale.
    pub impulses: bool,
    /// Support forces of contacts at rest, as arrows to a scale.
    pub forces: bool,
    /// Where spheres were in the last frames.
    pub path: bool,
    /// Where the selected sphere goes until its next contact.
    pub predicted: bool,
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
    /// No colours; bold and reverse stay.
    Never,
    /// The terminal's own 16 colours.
    Ansi16,
    /// The 256-colour cube.
    Ansi256,
    /// Colours of 24 bits.
    Rgb,
}

/// The list of all that has happened, as far as it is wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EventsView<'a> {
    /// What has happened.
    pub log: &'a EventLog,
    /// What of it is shown.
    pub filter: &'a EventFilter,
    /// What was typed to narrow it.
    pub typed: &'a str,
    /// What is wrong with what was typed: a sentence.
    pub wrong: Option<&'a str>,
    /// The number of the event under the cursor; none: the newest.
    pub cursor: Option<u64>,
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
        /// Index of the scene under the cursor.
        cursor: usize,
    },
    /// The list of all that has happened.
    Events(EventsView<'a>),
    /// The `:` line, as typed so far, with the byte offset of its cursor.
    Prompt {
        /// Text after the colon.
        text: &'a str,
        /// Byte of the text before which the cursor is.
        cursor: usize,
        /// What the last word of the text may go on as.
        offers: &'a str,
    },
}
