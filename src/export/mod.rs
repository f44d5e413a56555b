//! Rows → CSV or JSON lines, to any writer; and rows of the trade read back.
//!
//! Numbers are written with the fewest digits that read back to the same `f64`: `20.0`, `1e300`, `5e-324`, `-0.0`.
//!
//! | file | owns |
//! |---|---|
//! | `table` | what a row is, and a table of them under way |
//! | `rows` | a state, an event |
//! | `states`, `columns` | states of any program, read back; what a file calls its columns |
//! | `crowd` | a figure of a crowd |
//! | `mark` | a trajectory marked |
//! | `trade`, `note` | a setting measured on a scene, and reasons to doubt its figures |

mod columns;
mod crowd;
mod mark;
mod note;
mod rows;
mod states;
mod table;
mod trade;

pub use columns::{Columns, ColumnsError};
pub use crowd::CrowdRow;
pub use mark::MarkRow;
pub use note::Note;
pub use rows::{EventRow, StateRow};
pub use states::{Moment, States};
pub use table::{Format, Row, Table};
pub use trade::{ReadError, TradeNote, TradeRow, read_trade};
