//! Colours by depth. Sixteen colours follow the user's theme: only the terminal's own are used, the default colour for
//! text and walls. No state of a sphere is told by colour alone.

use ratatui::style::{Color, Modifier, Style};

use super::screen::Colors;

/// Colours by role, for one depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Palette {
    colors: Colors,
}

/// What spheres without a telling colour of their own take in turn; red stays for impacts.
const TURNS: [Color; 5] = [Color::Cyan, Color::Yellow, Color::Green, Color::Magenta, Color::LightBlue];

impl Palette {
    /// The palette of that depth.
    pub(super) const fn new(colors: Colors) -> Palette {
        Palette { colors }
    }

    /// Text.
    pub(super) const fn plain(self) -> Style {
        Style::new()
    }

    /// Text that recedes: units, labels, what keys do.
    pub(super) const fn faint(self) -> Style {
        Style::new().add_modifier(Modifier::DIM)
    }

    /// Text that stands out.
    pub(super) const fn strong(self) -> Style {
        Style::new().add_modifier(Modifier::BOLD)
    }

    /// The cursor, the entry under it, a badge.
    pub(super) const fn reverse(self) -> Style {
        Style::new().add_modifier(Modifier::REVERSED)
    }

    /// A heading.
    pub(super) fn heading(self) -> Style {
        self.ansi(Color::Cyan).add_modifier(Modifier::BOLD)
    }

    /// Good news: it runs.
    pub(super) fn good(self) -> Style {
        self.ansi(Color::Green)
    }

    /// A state worth noticing: paused, resting, news.
    pub(super) fn notice(self) -> Style {
        self.ansi(Color::Yellow)
    }

    /// An impact, or a run that cannot go on.
    pub(super) fn alarm(self) -> Style {
        self.ansi(Color::LightRed)
    }

    /// Velocity arrows.
    pub(super) fn velocity(self) -> Style {
        self.ansi(Color::Green)
    }

    /// The exact run.
    pub(super) fn ghost(self) -> Style {
        self.ansi(Color::LightCyan)
    }

    /// Contact normals.
    pub(super) fn normal(self) -> Style {
        self.ansi(Color::LightMagenta)
    }

    /// A wall, by its own colour if it has one.
    pub(super) fn wall(self, own: Option<[f64; 3]>) -> Style {
        let color = own.and_then(|rgb| self.own(rgb));
        // Dimmed default colour, not "bright black": some themes give that the background's colour.
        color.map_or(self.faint(), |color| Style::new().fg(color))
    }

    /// A sphere, by its own colour if that tells it apart, else by turns.
    pub(super) fn sphere(self, index: usize, own: Option<[f64; 3]>) -> Style {
        let color = own.and_then(|rgb| self.own(rgb));
        color.map_or_else(|| self.ansi(TURNS[index % TURNS.len()]), |color| Style::new().fg(color))
    }

    fn ansi(self, color: Color) -> Style {
        match self.colors {
            Colors::Never => Style::new(),
            _ => Style::new().fg(color),
        }
    }

    /// The scene's colour as far as this depth can show it; with 16 only colours of a clear hue.
    fn own(self, rgb: [f64; 3]) -> Option<Color> {
        if rgb.iter().any(|channel| !channel.is_finite()) {
            return None;
        }
        let [r, g, b] = rgb.map(|channel| channel.clamp(0.0, 1.0));
        match self.colors {
            Colors::Never => None,
            Colors::Ansi16 => hue(r, g, b),
            Colors::Ansi256 => Some(Color::Indexed(cube(r, g, b))),
            Colors::Rgb => {
                let byte = |channel: f64| (channel * 255.0).round() as u8;
                Some(Color::Rgb(byte(r), byte(g), byte(b)))
            }
        }
    }
}

/// The terminal's own colour of that hue; `None` for greys.
fn hue(r: f64, g: f64, b: f64) -> Option<Color> {
    let (most, least) = (r.max(g).max(b), r.min(g).min(b));
    if most - least < 0.4 * most || most == 0.0 {
        return None;
    }
    let high = |channel: f64| channel > 0.5 * (most + least);
    Some(match (high(r), high(g), high(b)) {
        (true, false, false) => Color::Red,
        (false, true, false) => Color::Green,
        (false, false, true) => Color::LightBlue,
        (true, true, _) => Color::Yellow,
        (true, false, true) => Color::Magenta,
        _ => Color::Cyan,
    })
}

/// The nearest of the 6×6×6 cube and the 24 greys of the 256 colours.
fn cube(r: f64, g: f64, b: f64) -> u8 {
    const LEVELS: [f64; 6] = [0.0, 95.0, 135.0, 175.0, 215.0, 255.0];
    let nearest = |channel: f64| {
        let value = channel * 255.0;
        (1..6).fold(0, |best, i| if (LEVELS[i] - value).abs() < (LEVELS[best] - value).abs() { i } else { best })
    };
    let (i, j, k) = (nearest(r), nearest(g), nearest(b));
    let off = |x: f64, y: f64, z: f64| {
        let (dr, dg, db) = (r * 255.0 - x, g * 255.0 - y, b * 255.0 - z);
        dr * dr + dg * dg + db * db
    };
    let step = (((r + g + b) * 85.0 - 8.0) / 10.0).round().clamp(0.0, 23.0);
    let grey = 8.0 + 10.0 * step;
    if off(grey, grey, grey) < off(LEVELS[i], LEVELS[j], LEVELS[k]) {
        232 + step as u8
    } else {
        (16 + 36 * i + 6 * j + k) as u8
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clear_hue_becomes_the_terminals_own_and_a_grey_none() {
        let cases = [
            ([0.63, 0.065, 0.05], Some(Color::Red)),
            ([0.14, 0.45, 0.091], Some(Color::Green)),
            ([0.1, 0.2, 0.9], Some(Color::LightBlue)),
            ([0.9, 0.8, 0.1], Some(Color::Yellow)),
            ([0.725, 0.71, 0.68], None),
            ([0.0, 0.0, 0.0], None),
            ([f64::NAN, 0.0, 1.0], None),
        ];
        for (rgb, color) in cases {
            assert_eq!(Palette::new(Colors::Ansi16).own(rgb), color, "{rgb:?}");
        }
    }

    #[test]
    fn the_256_colours_are_met_where_the_cube_and_the_greys_have_them() {
        // xterm's table: 16 + 36 r + 6 g + b for the levels 0, 95, 135, 175, 215, 255; 232 + i is the grey 8 + 10 i.
        let level = |n: f64| n / 255.0;
        assert_eq!(cube(1.0, 0.0, 0.0), 196);
        assert_eq!(cube(level(95.0), level(135.0), level(175.0)), 16 + 36 + 12 + 3);
        assert_eq!(cube(level(118.0), level(118.0), level(118.0)), 232 + 11);
        assert_eq!((cube(0.0, 0.0, 0.0), cube(1.0, 1.0, 1.0)), (16, 231));
    }
}
