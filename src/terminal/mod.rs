//! Drives the application on a real terminal. The only place that names crossterm.
//!
//! Threads: the one of `drive` obeys inputs and draws; `input` reads the terminal; `signals` waits for signals; `writer`
//! sends pictures; the application's worker simulates. All of them post events to the first and wait for nothing. Begin
//! with `drive`.
//!
//! | file | owns |
//! |---|---|
//! | `outcome` | what to run, and how that can end |
//! | `drive` | the loop: inputs, signals and news in, pictures out |
//! | `event`, `backlog` | what the threads tell the one that draws; typed keys and replies that wait |
//! | `input`, `decoder`, `sequence`, `mouse`, `paste`, `reply` | bytes from the terminal as keys, mouse, pasted text and replies |
//! | `session`, `signals` | the terminal's modes, put back whatever happens; signals as events |
//! | `writer`, `pacer` | pictures to the terminal, and when the next is due |
//! | `line`, `budget` | how many pictures may be under way, and how many bytes per second |
//! | `detect`, `questions` | what the environment says of colours and characters, and what the terminal answers |

mod backlog;
mod budget;
mod decoder;
mod detect;
mod drive;
mod event;
mod input;
mod line;
mod mouse;
mod outcome;
mod pacer;
mod paste;
mod questions;
mod reply;
mod sequence;
mod session;
mod signals;
mod writer;

pub use drive::run;
pub use outcome::{Error, Options, Outcome};
pub(crate) use signals::not_ignored;
