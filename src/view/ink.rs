//! The user's own colours, and the background that the terminal has.

/// A colour of the user's choice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ink {
    /// The colour of the terminal's text.
    Text,
    /// One of the terminal's own 16 colours, by its number.
    Ansi(u8),
    /// Red, green and blue.
    Rgb(u8, u8, u8),
}

/// Most colours that spheres take in turn.
pub const MOST_TURNS: usize = 8;

/// The user's own colours, by role; `None`: chosen by the background.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Inks {
    /// Headings.
    pub heading: Option<Ink>,
    /// Good news: it runs.
    pub good: Option<Ink>,
    /// A state worth noticing.
    pub notice: Option<Ink>,
    /// An impact, or a run that cannot go on.
    pub alarm: Option<Ink>,
    /// Velocity arrows.
    pub velocity: Option<Ink>,
    /// The exact run.
    pub ghost: Option<Ink>,
    /// Contact normals.
    pub normal: Option<Ink>,
    /// Colours that spheres without a telling colour of their own take in turn: the first of these that are given.
    pub spheres: [Option<Ink>; MOST_TURNS],
}

/// What the terminal shows behind its text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Background {
    /// Dark, or unknown, which is dark more often than not.
    #[default]
    Dark,
    /// Light.
    Light,
}
