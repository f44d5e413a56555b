//! The one window into a run: plain public data, complete enough to draw a frame from, and to build by hand in a test.
//!
//! A [`Stage`] is made of a scene once; a [`Snapshot`] of a simulation after a frame. Begin with `run`.
//!
//! | file | owns |
//! |---|---|
//! | `stage` | what does not change during a run |
//! | `run` | the run at the end of one frame |
//! | `ghost` | where the exact run of the same scene is |
//! | `ahead` | where a sphere goes next |
//! | `kept` | which frames can be gone back to |
//! | `event_log`, `event_filter` | what has happened from the start on, and which of it is wanted |
//! | `ticks`, `trend`, `bins` | impacts and other quantities over time |

mod ahead;
mod bins;
mod event_filter;
mod event_log;
mod ghost;
mod kept;
mod run;
mod stage;
mod ticks;
mod trend;

pub use ahead::Ahead;
pub use event_filter::{EventFilter, UnknownWord};
pub use event_log::{EventLog, Logged};
pub use ghost::Ghost;
pub use kept::Kept;
pub use run::Snapshot;
pub(crate) use run::shows_trials;
pub use stage::Stage;
pub use ticks::Ticks;
pub use trend::{Trade, Trend};

pub use crate::audit::Alarm;
pub use crate::physics::{Approach, Class, Contact, Kind, Probe, RestReason, Shape, Tallies};
pub use crate::scene::ContactLaw;
