//! The thread that owns a simulation: commands in, the latest snapshot out.
//!
//! The worker never waits for its reader: it puts each [`Report`] into one slot, over whatever lies there, and calls
//! `notify` only if the reader has taken the one before. While paused it sleeps until a command comes. No bit of a run
//! depends on any of it. Begin with `message`, then `run`.
//!
//! | file | owns |
//! |---|---|
//! | `message` | what goes to a worker and what comes back |
//! | `thread` | the worker, seen from its reader |
//! | `run`, `pace` | what its thread does: obey, advance by a slice, report; how fast |
//! | `exact_follower` | the exact run that follows the run shown |
//! | `errands` | a thread for what takes long and may be overtaken |
//! | `slot`, `mailbox` | how threads hand things over without waiting |

mod errands;
mod exact_follower;
mod mailbox;
mod message;
mod pace;
mod run;
mod slot;
mod thread;

pub use errands::Errands;
pub use exact_follower::{Ending, ExactFollower};
pub use message::{Activity, Command, Job, Notify, Report};
pub use thread::Worker;
