//! The running application without a terminal: keys and news in, a buffer out. A test drives it as a user would.
//!
//! An [`Input`] goes through `keys` to an [`Action`], which `act` does to the `state`; what it changes goes to the worker
//! as a command, and comes back as a report, which `application` takes when it is told of news. Begin with `application`
//! and `act`.
//!
//! | file | owns |
//! |---|---|
//! | `input` | what the application starts with, what reaches it, what it asks for |
//! | `application` | the application as its owner sees it: inputs in, a buffer out |
//! | `state` | what it holds, and the steps that keys and news are made of |
//! | `keys`, `action` | the keys, the table of what each does, and the actions |
//! | `keymap`, `key_name` | the table as bound by the configuration; keys by name |
//! | `act`, `knobs`, `view_settings`, `prompt` | what each action does: to the settings, to the picture, by exact values |
//! | `current`, `loading`, `opening`, `scene_list` | the scene shown, the one on its way, and the list of them |
//! | `event_list`, `seek` | the list of all that has happened; what is looked at where the run was sent |
//! | `hints` | the keys that are useful where one is |
//! | `line` | the `:` line while it is typed |
//! | `until`, `said` | what a run goes on until; what the worker has to say, in words |
//! | `take_away`, `files` | the picture and the state as files, and files that replace none |
//! | `mouse`, `pointer` | the mouse, and what it does |
//! | `comparison` | the exact run beside the one shown |

mod act;
mod action;
mod application;
mod comparison;
mod current;
mod event_list;
mod files;
mod hints;
mod input;
mod key_name;
mod keymap;
mod keys;
mod knobs;
mod line;
mod loading;
mod mouse;
mod opening;
mod pointer;
mod prompt;
mod said;
mod scene_list;
mod seek;
mod state;
mod take_away;
mod until;
mod view_settings;

pub use action::{Action, Direction};
pub use application::App;
pub use input::{Effect, Input, Setup};
pub use keymap::{Clash, Keymap, help_rows, hints};
pub use keys::{Binding, Code, Key, table};
pub use mouse::{Gesture, Mouse};
