//! Colours by depth and background. Sixteen colours follow the user's theme: only the terminal's own are used, the
//! default colour for text and walls. On a light background those of them that are light have darker ones in their place,
//! and with more than sixteen colours such as can be read on any. No state of a sphere is told by colour alone.

use ratatui::style::{Color, Modifier, Style};

use super::{
    ink::{Background, Ink, Inks, MOST_TURNS},
    screen::{Colors, ViewSettings},
};

/// Colours by role, for one depth and background.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Palette {
    colors: Colors,
    background: Background,
    inks: Inks,
}

/// What a role looks like where the user has not said.
#[derive(Debug, Clone, Copy)]
struct Role {
    /// The colour on a dark background.
    dark: Color,
    /// The colour on a light background with 16 colours: of those only blue, magenta and red can be read on white.
    light: Color,
    /// The colour on a light background with 256 colours or more, by its number among them.
    light_of_256: u8,
}

const fn role(dark: Color, light: Color, light_of_256: u8) -> Role {
    Role { dark, light, light_of_256 }
}

const HEADING: Role = role(Color::Cyan, Color::Blue, 24);
const GOOD: Role = role(Color::Green, Color::Blue, 22);
const NOTICE: Role = role(Color::Yellow, Color::Magenta, 94);
const ALARM: Role = role(Color::LightRed, Color::Red, 160);
const VELOCITY: Role = role(Color::Green, Color::Blue, 22);
const GHOST: Role = role(Color::LightCyan, Color::Blue, 24);
const NORMAL: Role = role(Color::LightMagenta, Color::Magenta, 127);

/// Colours that spheres without a telling colour of their own take in turn; red stays for impacts.
const TURNS: [Role; 5] = [
    role(Color::Cyan, Color::Blue, 24),
    role(Color::Yellow, Color::Magenta, 94),
    role(Color::Green, Color::Reset, 22),
    role(Color::Magenta, Color::Blue, 127),
    role(Color::LightBlue, Color::Magenta, 19),
];

/// Least luminance of a scene's colour on a dark background, and largest on a light one, as parts of white: about where
/// WCAG finds the contrast of large text enough, 3 to 1.
const LEAST: f64 = 0.078;
const LARGEST: f64 = 0.3;

impl Palette {
    /// The palette of these settings.
    pub(super) const fn new(settings: &ViewSettings) -> Palette {
        Palette { colors: settings.colors, background: settings.background, inks: settings.inks }
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
        self.role(HEADING, self.inks.heading).add_modifier(Modifier::BOLD)
    }

    /// Good news: it runs.
    pub(super) fn good(self) -> Style {
        self.role(GOOD, self.inks.good)
    }

    /// A state worth noticing: paused, resting, news.
    pub(super) fn notice(self) -> Style {
        self.role(NOTICE, self.inks.notice)
    }

    /// An impact, or a run that cannot go on.
    pub(super) fn alarm(self) -> Style {
        self.role(ALARM, self.inks.alarm)
    }

    /// Velocity arrows.
    pub(super) fn velocity(self) -> Style {
        self.role(VELOCITY, self.inks.velocity)
    }

    /// The exact run.
    pub(super) fn ghost(self) -> Style {
        self.role(GHOST, self.inks.ghost)
    }

    /// Contact normals.
    pub(super) fn normal(self) -> Style {
        self.role(NORMAL, self.inks.normal)
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
        color.map_or_else(|| self.turn(index), |color| Style::new().fg(color))
    }

    /// The colour of the sphere of that number, by turns.
    fn turn(self, index: usize) -> Style {
        let given = self.inks.spheres.iter().take_while(|ink| ink.is_some()).count().min(MOST_TURNS);
        match given {
            0 => self.role(TURNS[index % TURNS.len()], None),
            given => self.role(TURNS[0], self.inks.spheres[index % given]),
        }
    }

    fn role(self, role: Role, ink: Option<Ink>) -> Style {
        match (self.colors, self.background, ink) {
            (Colors::Never, ..) => Style::new(),
            (_, _, Some(ink)) => self.ink(ink),
            (_, Background::Dark, None) => Style::new().fg(role.dark),
            (Colors::Ansi16, Background::Light, None) => paint(role.light),
            (_, Background::Light, None) => Style::new().fg(Color::Indexed(role.light_of_256)),
        }
    }

    /// A colour of the user's as far as this depth can show it.
    fn ink(self, ink: Ink) -> Style {
        match ink {
            Ink::Text => Style::new(),
            Ink::Ansi(number) => Style::new().fg(ANSI[usize::from(number) % ANSI.len()]),
            Ink::Rgb(r, g, b) => {
                let [r, g, b] = [r, g, b].map(|channel| f64::from(channel) / 255.0);
                self.deep(r, g, b).map_or(Style::new(), |color| Style::new().fg(color))
            }
        }
    }

    /// The scene's colour as far as this depth can show it; with 16 only colours of a clear hue.
    fn own(self, rgb: [f64; 3]) -> Option<Color> {
        if rgb.iter().any(|channel| !channel.is_finite()) {
            return None;
        }
        let [r, g, b] = self.readable(rgb.map(|channel| channel.clamp(0.0, 1.0)));
        self.deep(r, g, b)
    }

    /// The colour, as dark as it has to be to be read on a light background, or as light on a dark one.
    fn readable(self, rgb: [f64; 3]) -> [f64; 3] {
        let shown = |[r, g, b]: [f64; 3]| match self.colors {
            Colors::Ansi256 => luminance(indexed(cube(r, g, b))),
            _ => luminance([r, g, b]),
        };
        match self.background {
            Background::Light if shown(rgb) > LARGEST => mixed(rgb, 0.0, |mixture| shown(mixture) <= LARGEST),
            Background::Dark if shown(rgb) < LEAST => mixed(rgb, 1.0, |mixture| shown(mixture) >= LEAST),
            _ => rgb,
        }
    }

    /// A colour as far as this depth can show it; with 16 only colours of a clear hue.
    fn deep(self, r: f64, g: f64, b: f64) -> Option<Color> {
        match self.colors {
            Colors::Never => None,
            Colors::Ansi16 => {
                hue(r, g, b).map(|color| on(color, self.background)).filter(|color| *color != Color::Reset)
            }
            Colors::Ansi256 => Some(Color::Indexed(cube(r, g, b))),
            Colors::Rgb => {
                let byte = |channel: f64| (channel * 255.0).round() as u8;
                Some(Color::Rgb(byte(r), byte(g), byte(b)))
            }
        }
    }
}

/// The terminal's 16 in the order of their numbers.
const ANSI: [Color; 16] = [
    Color::Black,
    Color::Red,
    Color::Green,
    Color::Yellow,
    Color::Blue,
    Color::Magenta,
    Color::Cyan,
    Color::Gray,
    Color::DarkGray,
    Color::LightRed,
    Color::LightGreen,
    Color::LightYellow,
    Color::LightBlue,
    Color::LightMagenta,
    Color::LightCyan,
    Color::White,
];

/// A style of that colour; the default one needs none.
fn paint(color: Color) -> Style {
    if color == Color::Reset { Style::new() } else { Style::new().fg(color) }
}

/// The terminal's own colour that can be read on that background in place of one that may not.
fn on(color: Color, background: Background) -> Color {
    match (background, color) {
        (Background::Dark, color) => color,
        (Background::Light, Color::LightBlue | Color::Cyan) => Color::Blue,
        (Background::Light, Color::Green | Color::Yellow) => Color::Reset,
        (Background::Light, color) => color,
    }
}

/// Luminance as a part of white's, with a cubic in place of the display's curve, at most 0.01 off.
fn luminance(rgb: [f64; 3]) -> f64 {
    let [r, g, b] = rgb.map(|channel| channel * channel * (0.75 + 0.25 * channel));
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// The colour mixed with as little of black (0) or white (1) as is enough; black or white alone is always enough.
fn mixed(rgb: [f64; 3], other: f64, enough: impl Fn([f64; 3]) -> bool) -> [f64; 3] {
    let with = |share: f64| rgb.map(|channel| channel + share * (other - channel));
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..20 {
        let middle = 0.5 * (low + high);
        if enough(with(middle)) {
            high = middle;
        } else {
            low = middle;
        }
    }
    with(high)
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

/// The levels of a channel in the 6×6×6 cube, of 255.
const LEVELS: [f64; 6] = [0.0, 95.0, 135.0, 175.0, 215.0, 255.0];

/// The colour of a number from 16 on.
fn indexed(index: u8) -> [f64; 3] {
    let level = |i: u8| LEVELS[usize::from(i % 6)] / 255.0;
    match index.saturating_sub(16) {
        place @ 0..216 => [level(place / 36), level(place / 6), level(place)],
        place => [(8.0 + 10.0 * f64::from(place - 216)) / 255.0; 3],
    }
}

/// The nearest of the 6×6×6 cube and the 24 greys of the 256 colours.
fn cube(r: f64, g: f64, b: f64) -> u8 {
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

    fn palette(colors: Colors, background: Background) -> Palette {
        Palette::new(&ViewSettings { colors, background, ..ViewSettings::default() })
    }

    /// xterm's colours of these numbers, as parts of 255.
    const XTERM: [[u8; 3]; 16] = [
        [0, 0, 0],
        [205, 0, 0],
        [0, 205, 0],
        [205, 205, 0],
        [0, 0, 238],
        [205, 0, 205],
        [0, 205, 205],
        [229, 229, 229],
        [127, 127, 127],
        [255, 0, 0],
        [0, 255, 0],
        [255, 255, 0],
        [92, 92, 255],
        [255, 0, 255],
        [0, 255, 255],
        [255, 255, 255],
    ];

    fn rgb(style: Style, text: [u8; 3]) -> [u8; 3] {
        match style.fg {
            None | Some(Color::Reset) => text,
            Some(Color::Rgb(r, g, b)) => [r, g, b],
            Some(Color::Indexed(index @ 16..232)) => {
                let level = |n: u8| if n == 0 { 0 } else { 55 + 40 * n };
                [level((index - 16) / 36), level((index - 16) / 6 % 6), level((index - 16) % 6)]
            }
            Some(Color::Indexed(index @ 232..)) => [8 + 10 * (index - 232); 3],
            Some(named) => XTERM[ANSI.iter().position(|color| *color == named).expect("one of the 16")],
        }
    }

    /// WCAG 2's contrast ratio.
    fn contrast(a: [u8; 3], b: [u8; 3]) -> f64 {
        let linear = |channel: u8| {
            let c = f64::from(channel) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        };
        let light = |[r, g, b]: [u8; 3]| 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b) + 0.05;
        let (a, b) = (light(a), light(b));
        a.max(b) / a.min(b)
    }

    #[test]
    fn every_role_and_every_colour_of_a_scene_can_be_read_on_light_and_on_dark() {
        let (black, white) = ([0; 3], [255; 3]);
        for colors in [Colors::Never, Colors::Ansi16, Colors::Ansi256, Colors::Rgb] {
            for (background, paper, text) in [(Background::Dark, black, white), (Background::Light, white, black)] {
                let palette = palette(colors, background);
                let roles = [
                    palette.heading(),
                    palette.good(),
                    palette.notice(),
                    palette.alarm(),
                    palette.velocity(),
                    palette.ghost(),
                    palette.normal(),
                ];
                let levels = || (0..=4).map(|n| f64::from(n) / 4.0);
                let own = levels().flat_map(|r| levels().flat_map(move |g| levels().map(move |b| [r, g, b])));
                let spheres =
                    own.map(|rgb| palette.sphere(0, Some(rgb))).chain((0..5).map(|i| palette.sphere(i, None)));
                for style in roles.into_iter().chain(spheres) {
                    let found = contrast(rgb(style, text), paper);
                    assert!(found >= 2.5, "{colors:?} {background:?} {style:?}: {found:.2}");
                }
            }
        }
    }

    #[test]
    fn the_users_own_colours_are_taken_as_far_as_the_depth_can_show_them() {
        let mut settings = ViewSettings { colors: Colors::Ansi256, ..ViewSettings::default() };
        settings.inks.good = Some(Ink::Rgb(255, 0, 0));
        settings.inks.notice = Some(Ink::Ansi(12));
        settings.inks.spheres[..2].copy_from_slice(&[Some(Ink::Text), Some(Ink::Ansi(1))]);
        let palette = Palette::new(&settings);
        assert_eq!(palette.good().fg, Some(Color::Indexed(196)));
        assert_eq!(palette.notice().fg, Some(Color::LightBlue));
        let turns: Vec<_> = (0..4).map(|i| palette.sphere(i, None).fg).collect();
        assert_eq!(turns, [None, Some(Color::Red), None, Some(Color::Red)]);
        let never = Palette::new(&ViewSettings { colors: Colors::Never, ..settings });
        assert_eq!((never.good().fg, never.sphere(1, None).fg), (None, None));
    }

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
            assert_eq!(palette(Colors::Ansi16, Background::Dark).own(rgb), color, "{rgb:?}");
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
