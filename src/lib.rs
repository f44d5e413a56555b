//! Carom simulates rigid spheres that bounce between parallelogram walls and each other, and measures how much accuracy
//! costs how much time.
//!
//! Data flows one way: scene file → validated [`scene::Scene`] → [`physics`] model → method → [`snapshot`] → [`view`] →
//! terminal. Imports run the other way; `tests/tidy.rs` enforces it. SI units throughout; `f64`; y is up.
//!
//! As a library there are three doors: [`scene`] makes scenes, [`physics`] runs them, [`measure`] says how far off they
//! are; beside them [`audit`] judges a run, [`marks`] the trajectory of any program, [`snapshot`] copies one, [`export`]
//! writes rows. Every other module is the program's own: public for its tests, not shown here, and free to change. The
//! physics builds without the terminal and the command line: `default-features = false`. A whole program:
//!
//! ```
//! use carom::physics::{Class, Simulation};
//! use carom::scene::{self, Method, Settings};
//!
//! let scene = scene::open("paper-1")?.scene;
//! let mut run = Simulation::new(&scene, Settings { method: Method::Exact, ..scene.solver });
//! run.record_events(true);
//! run.run_to(1.0, |_| Some(Simulation::SLICE));
//! let impacts = run.take_events().into_iter().filter(|row| row.class == Class::Collide);
//! for impact in impacts {
//!     println!("{} s: {:?} with {} m/s", impact.time, impact.key(), impact.approach_speed);
//! }
//! assert!(run.energy() <= run.initial_energy());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

#[cfg(feature = "tui")]
#[doc(hidden)]
pub mod app;
pub mod audit;
pub mod certify;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod config;
#[doc(hidden)]
pub mod double;
#[doc(hidden)]
pub mod explain;
pub mod export;
#[doc(hidden)]
pub mod format;
#[cfg(feature = "tui")]
#[doc(hidden)]
pub mod frame;
#[doc(hidden)]
pub mod geometry;
pub mod marks;
pub mod measure;
pub mod physics;
#[doc(hidden)]
pub mod printable;
#[doc(hidden)]
pub mod random;
#[doc(hidden)]
pub mod recording;
#[doc(hidden)]
pub mod roots;
pub mod scene;
pub mod snapshot;
#[cfg(feature = "tui")]
#[doc(hidden)]
pub mod terminal;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod text_mode;
#[cfg(feature = "tui")]
#[doc(hidden)]
pub mod view;
#[doc(hidden)]
pub mod worker;
