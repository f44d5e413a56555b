//! From a name, a file or a draft to the validated [`Scene`], on whose rules everything else relies.
//!
//! ```text
//! name or path ─ open, builtin ─▶ text ─ parse, file ─▶ values in their ranges ─ rules ─▶ Scene
//!                                                            Draft, built in code ─ rules ─▶ Scene
//! ```
//!
//! ```
//! use carom::scene::{Draft, Sphere};
//! use glam::DVec3;
//!
//! let ball = |x| Sphere { x, v: DVec3::ZERO, mass: 1.0, radius: 0.5, force: DVec3::ZERO, color: None, name: None };
//! let apart = Draft::new(Vec::new(), vec![ball(DVec3::ZERO), ball(DVec3::X * 2.0)]);
//! assert!(apart.validated().is_ok());
//! let one_in_the_other = Draft::new(Vec::new(), vec![ball(DVec3::ZERO), ball(DVec3::X * 0.1)]);
//! assert!(one_in_the_other.validated().is_err());
//! ```
//!
//! Begin with `validated`, which says what a scene holds, then `rules`.
//!
//! | file | owns |
//! |---|---|
//! | `validated` | the scene, and the draft that it is made of |
//! | `draft` | scenes built in code, and scenes that follow from others |
//! | `open`, `builtin`, `parse`, `key` | from a word of the command line to a text, and from a text to a scene |
//! | `notation` | RON as text and as values: reading it, and telling what is wrong with it where |
//! | `file`, `number` | the shape of a scene as written in RON; the range of each single value, as a type |
//! | `values` | the same ranges, asked of a draft |
//! | `rules` | every rule that concerns more than one value |
//! | `bodies` | walls and spheres, and which entry of the file each came from |
//! | `generate`, `gas` | what a room, a lattice and a gas expand to |
//! | `size`, `effort` | what is too much: bodies, memory, comparisons |
//! | `overlaps`, `near` | which bodies overlap at the start, found by a tree |
//! | `write` | a scene as a text that holds it to the bit |
//! | `warnings` | what is allowed but hardly meant |
//! | `error`, `locate` | the refusal, and where in the text it points |

mod bodies;
pub mod builtin;
mod draft;
mod effort;
mod error;
mod file;
mod gas;
mod generate;
mod key;
mod locate;
mod near;
mod notation;
mod number;
mod open;
mod overlaps;
mod parse;
mod rules;
mod size;
mod validated;
mod values;
mod warnings;
mod write;

pub use error::Error;
pub use locate::Position;
pub use open::{Opened, open, open_with_text};
pub use parse::parse;
pub use validated::{Color, ContactLaw, Draft, Method, Resume, Scene, Settings, Sphere, Wall};
pub use warnings::{endless, warnings};
pub use write::written;
#[cfg(feature = "cli")]
pub(crate) use {
    error::{Source, quote},
    locate::Step,
    notation::{Words, read},
    open::{contents, contents_within, not_text},
};
