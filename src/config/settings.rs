//! What can be configured.

use std::ffi::OsString;

use crate::{
    app::Keymap,
    view::{Colors, Inks, Marker},
};

/// The scene to begin with where nothing names one: sixteen balls, and from the first collision on there is much to see.
pub const FIRST: &str = "billiard";

/// Most pictures per second that a configuration may ask for.
pub(super) const FASTEST: u32 = 60;

/// What can be configured; the default is what holds without a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Config {
    /// The scene to begin with where none is named: a built-in name or a path.
    pub scene: OsString,
    /// Dots or characters; `None`: as the terminal can show.
    pub marker: Option<Marker>,
    /// Depth of colour; `None`: as the terminal can show.
    pub color: Option<Colors>,
    /// Most pictures per second of a running run, 1 to 60.
    pub frame_rate: u32,
    /// Most bytes per second to the terminal; `None`: as many as it takes.
    pub bandwidth: Option<u64>,
    /// Colours by role.
    pub inks: Inks,
    /// Which key does what.
    pub keymap: Keymap,
}

impl Default for Config {
    fn default() -> Config {
        Config {
            scene: FIRST.into(),
            marker: None,
            color: None,
            frame_rate: 30,
            bandwidth: None,
            inks: Inks::default(),
            keymap: Keymap::default(),
        }
    }
}
