//! The thread that owns a simulation: commands in, the latest snapshot out.
//!
//! The worker never waits for its reader: it puts each [`Report`] into one slot, over whatever lies there, and calls
//! `notify` only if the reader has taken the one before. While paused it sleeps until a command comes. No bit of a run
//! depends on any of it. Begin with `message`, then `run`.
//!
//! | file | owns |
//! |---|---|
//! | `message`, `job` | what goes to a worker and what comes back; what it works on |
//! | `thread` | the worker, seen from its reader |
//! | `run`, `pace` | what its thread does: obey, advance by a slice, report; how fast |
//! | `goal`, `heading`, `stop` | where the run ends its advance, and how it gets there; what it waits for |
//! | `course`, `keyframes`, `replay_cost` | the run and its past; what of it is kept; what a frame costs to be done again |
//! | `tape`, `recorder` | a recording under way, and one that is followed |
//! | `acting` | what acts over a frame from the one before |
//! | `around` | what was shortly before, and what comes next of a sphere |
//! | `exact_follower` | the exact run that follows the run shown |
//! | `errands` | a thread for what takes long and may be overtaken |
//! | `slot`, `mailbox` | how threads hand things over without waiting |

mod acting;
mod around;
mod course;
mod errands;
mod exact_follower;
mod goal;
mod heading;
mod job;
mod keyframes;
mod mailbox;
mod message;
mod pace;
mod recorder;
mod replay_cost;
mod run;
mod slot;
mod stop;
mod tape;
mod thread;

pub use around::Places;
pub use errands::Errands;
pub use exact_follower::{Ending, ExactFollower};
pub use job::Job;
pub use message::{Activity, Command, Notify, Report, Said, TakenAway};
pub use stop::{Bodies, Met, Stop};
pub use tape::Taped;
pub use thread::Worker;
