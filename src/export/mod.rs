//! Rows → CSV or JSON lines, to any writer; and rows of the trade read back.
//!
//! Numbers are written with the fewest digits that read back to the same `f64`: `20.0`, `1e300`, `5e-324`, `-0.0`.
//!
//! | file | owns |
//! |---|---|
//! | `table` | what a row is, and a table of them under way |
//! | `rows` | a state, an event |
//! | `columns` | what a file calls its columns |
//! | `states`, `wide` | states of any program, read back; with all spheres in a row |
//! | `crowd` | a figure of a crowd, and a run of it |
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
mod wide;

pub use columns::{Columns, ColumnsError};
pub use crowd::{CrowdRow, CrowdRun, FIGURES, RESIDUALS, is_crowd_part, read_crowd, read_crowd_runs};
pub use mark::{CrowdMark, MarkRow};
pub use note::Note;
pub use rows::{EventRow, StateRow};
pub use states::{Moment, States};
pub use table::{Format, Row, Table};
pub use trade::{ReadError, TradeNote, TradeRow, read_trade};
