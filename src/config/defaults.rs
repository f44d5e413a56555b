//! The defaults as a file with comments.

use super::{
    settings::{Config, FASTEST},
    values::{DEPTHS, INKS, MARKERS, UNLIMITED},
};
use crate::app::{Key, table};

/// The configuration that holds without a file, as a file to start from: reading it changes nothing.
pub fn defaults() -> String {
    let Config { scene, frame_rate, .. } = Config::default();
    let scene = scene.to_string_lossy();
    let names = |all: Vec<&str>| all.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
    let markers = names(MARKERS.iter().map(|(name, _)| *name).collect());
    let depths = names(DEPTHS.iter().map(|(name, _)| *name).collect());
    let (dark, bright) = (INKS[..8].join(", "), "bright-black to bright-white");
    format!(
        r##"// The configuration of carom: these are the defaults, and what is left out has them too.
// Options of the command line win over it; `carom --help` says where it is read from.
Config(
    // The scene to begin with where none is named: a built-in name, or a path as seen from the folder of this file.
    scene: "{scene}",
    // What dots are drawn with: "auto" (what the terminal can show), {markers}.
    marker: "auto",
    // Depth of colour: "auto", {depths}.
    color: "auto",
    // Most pictures per second of a running run, 1 to {FASTEST}.
    frame_rate: {frame_rate},
    // Most bytes per second to the terminal: "{UNLIMITED}", or a number as "64k" or "2M".
    bandwidth: "{UNLIMITED}",
    // Colours by role: "auto" (by the background), "text" (that of text), "#rrggbb", or one of the terminal's own:
    // {dark}, {bright}.
    colors: (
        heading: "auto",
        good: "auto",
        notice: "auto",
        alarm: "auto",
        velocity: "auto",
        ghost: "auto",
        normal: "auto",
        // What spheres without a colour of their own take in turn, up to eight; none: by the background.
        spheres: [],
    ),
    // The keys of each action, as many as you like; [] for none. A key is a character, or space, Enter, Esc, Tab,
    // Backspace, Delete, Left, Right, Up, Down, Home, End, PageUp, PageDown, F1 to F12, after Ctrl-, Alt- or Shift- if
    // it is pressed with them. No key has two actions. Ctrl-C always quits, and Esc always closes what is open.
    keys: (
{}    ),
)
"##,
        keys()
    )
}

/// A line for each action, its keys and what it does.
fn keys() -> String {
    let line = |action: String, keys: &[Key]| {
        let keys: Vec<String> = keys.iter().map(|key| format!("{:?}", key.to_string())).collect();
        format!("        {action}: [{}],", keys.join(", "))
    };
    let lines: Vec<(String, &str)> = table().map(|row| (line(row.action.name(), row.keys), row.does)).collect();
    let column = lines.iter().map(|(line, _)| line.len()).max().unwrap_or(0);
    lines.into_iter().map(|(line, does)| format!("{line:column$} // {does}\n")).collect()
}
