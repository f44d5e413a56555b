//! Trajectories of any program, marked: held against `exact` up to where that is certified, or against each other.
//!
//! A file is read moment by moment (`export::States`); beside it `exact` runs to the same times, so that nothing is
//! interpolated and no file fills the memory. An `Observer` looks at the trajectory by itself: velocities that change
//! by more than pulls explain are impacts, and what they break of the law tells known mistakes.
//!
//! | file | owns |
//! |---|---|
//! | `exam` | a scene to mark on, and a mark; begin here |
//! | `bodies` | gaps, pulls and energy, from the scene alone |
//! | `interval` | what has happened between two moments |
//! | `observer` | impacts, overlaps and evidence of a whole trajectory |
//! | `mistake` | known mistakes, and what speaks for them |
//! | `truth`, `standard` | what it is held against |
//! | `order` | which impact comes first that should not |
//! | `ledger`, `series` | energy, and an error over time, in bounded memory |
//! | `norm` | what many runs of a crowd do, and how far a trajectory is from that |
//! | `class` | many files side by side |
//! | `report`, `crowded`, `figure` | what was found, for a terminal and as SVG |

mod bodies;
mod class;
mod crowded;
mod exam;
mod figure;
mod interval;
mod ledger;
mod mistake;
mod norm;
mod observer;
mod order;
mod report;
mod series;
mod standard;
mod truth;

pub use class::{Marked, mark_all};
pub use exam::{Exam, Impacts, Mark, NoMark};
pub use figure::figure;
pub use ledger::Ledger;
pub use mistake::{Mistake, Suspicion};
pub use norm::{Beside, Norm, Normal};
pub use observer::Deepest;
pub use order::{Wrong, WrongImpact};
pub use report::{Order, order, report, row};
pub use series::Series;
pub use standard::Source;
