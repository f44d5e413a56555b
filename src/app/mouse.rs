//! The mouse as the terminal reports it, and as the application knows it.

use ratatui::layout::Position;

use crate::view::Aim;

/// What the mouse did over which cell of the screen; columns and rows count from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Mouse {
    /// What the mouse did.
    pub gesture: Gesture,
    /// Column, which may be beyond the screen.
    pub column: u16,
    /// Row, which may be beyond the screen.
    pub row: u16,
}

/// What the mouse did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Gesture {
    /// The left button was pressed.
    Press,
    /// The mouse moved with the left button pressed.
    Drag,
    /// The button was released.
    Release,
    /// The wheel was turned away from the user.
    WheelUp,
    /// The wheel was turned towards the user.
    WheelDown,
}

/// The mouse as the application knows it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Pointer {
    /// Whether the mouse was asked for.
    pub(super) on: bool,
    /// What the button was pressed on, while it is pressed.
    pub(super) held: Option<Held>,
}

/// What the button was pressed on.
#[derive(Debug, Clone, Copy)]
pub(super) enum Held {
    /// A view, last seen over that cell.
    View { aim: Aim, last: Position, moved: bool },
    /// The timeline, last seen over that column.
    Timeline { column: u16 },
}

impl Mouse {
    /// The cell under the mouse.
    pub(super) fn at(self) -> Position {
        Position::new(self.column, self.row)
    }
}
