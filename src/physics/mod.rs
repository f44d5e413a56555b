//! The door to the physics: a [`Simulation`] of a [`Scene`] by a [`Method`], advanced in slices and read between frames.
//!
//! Data flow: scene → [`model`] (what is constant, and only what the scene requires) → one method, which advances a
//! [`State`] and tells a log of contacts, events and tallies → read through [`Simulation`]. Begin with [`simulation`], then
//! [`method`]; then `events`, or the methods `paper` and `moreau`.
//!
//! | file | owns |
//! |---|---|
//! | [`simulation`], [`method`] | a scene under way; what every method is to the rest |
//! | `paper`, `moreau`, `exact`, `swept` | the methods |
//! | `events` | the event engine, on which `exact` and `swept` run |
//! | [`model`], [`requirements`], `closed_room` | what is constant, what a scene requires, and which edges no sphere reaches |
//! | [`state`], `conserved` | what moves, tallies and stalls; energy and momentum |
//! | [`contact`], `approach`, `log` | a contact as it is told; how its bodies came together; all that a run tells |
//! | [`impact_law`], `frame_contact` | the impact law; a contact at the end of a frame, before it is answered |
//! | [`path`], `free_flight` | a centre between contacts; what flight does to velocities |
//! | [`contact_time`] | when bodies next touch |
//! | [`wall`], `wall_parts` | a wall, the closest part of it, and which part comes next |
//! | [`overlap`], [`neighbors`] | how deep bodies overlap now, and which may |
//! | [`support`] | what holds resting spheres up |
//! | `law_fault` | the impact law broken on purpose, for a test |
//!
//! ```
//! use carom::physics::{Progress, Simulation};
//! use carom::scene::{self, Method, Settings};
//!
//! let scene = scene::open("paper-1")?.scene;
//! let mut run = Simulation::new(&scene, Settings { method: Method::Exact, dt: 0.1, tolerance: 1e-6 });
//! let end = run.run_to(1.0, |_| Some(Simulation::SLICE));
//! assert!(matches!(end, Progress::Reached));
//! assert_eq!(run.state().x.len(), scene.spheres.len());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Nothing in here knows of snapshots, threads, clocks, files or the screen. Same scene, method and settings give the same
//! bits on every machine: only + − × ÷ √ on `f64`, in an order fixed by the indices.

mod approach;
mod closed_room;
mod conserved;
pub mod contact;
#[doc(hidden)]
pub mod contact_time;
mod events;
mod exact;
mod frame_contact;
mod free_flight;
#[doc(hidden)]
pub mod impact_law;
#[cfg(test)]
pub(crate) mod law_fault;
mod log;
pub mod method;
pub mod model;
mod moreau;
#[doc(hidden)]
pub mod neighbors;
#[doc(hidden)]
pub mod overlap;
mod paper;
#[doc(hidden)]
pub mod path;
pub mod requirements;
pub mod simulation;
pub mod state;
#[doc(hidden)]
pub mod support;
mod swept;
#[doc(hidden)]
pub mod wall;
mod wall_parts;

pub use approach::{Approach, Shape};
pub use contact::{Class, Contact, Kind, Probe};
pub use events::rest_reason::RestReason;
pub use method::{Description, Effect, Knobs, Progress, Until, knobs};
pub use model::{ContactLaw, Method, Model, Scene, Settings};
pub use requirements::{PairSearch, Requirements};
pub use simulation::{Keyframe, Simulation, describe, deviations, slack};
pub use state::{Stall, StallKind, State, Tallies};
