//! A run as a file that proves itself: the scene's text, the settings, and two sums of every frame's bits, so that a run
//! on another machine or by another version either gives the same bits or is named where it first does not.
//!
//! Begin with `file`.
//!
//! | file | owns |
//! |---|---|
//! | `file` | what a recording holds, and how it is written and read |
//! | `change` | a change of settings on the way |
//! | `sums` | the two sums of a state, and which sphere differs where they differ |

mod change;
mod file;
mod sums;

pub use change::Change;
pub use file::{BadRecording, LARGEST, Recording};
pub use sums::{Sums, Suspect};
