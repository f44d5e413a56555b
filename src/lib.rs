//! Carom simulates rigid spheres that bounce between parallelogram walls and each other, and measures how much
//! accuracy costs how much time.
//!
//! Data flows one way: scene file → validated [`scene::Scene`] → [`physics`] model → method → [`snapshot`] →
//! [`view`] → terminal. Imports run the other way; `tests/tidy.rs` enforces it. SI units throughout; `f64`; y is up.
//!
//! As a library there are three doors: [`scene`] makes scenes, [`physics`] runs them, [`measure`] says how far off they are.
//! The physics builds without the terminal and the command line: `default-features = false`. A whole program:
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
pub mod app;
pub mod audit;
#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "cli")]
pub mod config;
pub mod export;
pub mod format;
#[cfg(feature = "tui")]
pub mod frame;
pub mod geometry;
pub mod measure;
pub mod physics;
pub mod printable;
pub mod random;
pub mod roots;
pub mod scene;
pub mod snapshot;
#[cfg(feature = "tui")]
pub mod terminal;
#[cfg(feature = "cli")]
pub mod text_mode;
#[cfg(feature = "tui")]
pub mod view;
pub mod worker;
