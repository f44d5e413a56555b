//! Carom simulates rigid spheres that bounce between parallelogram walls and each other, and measures how much
//! accuracy costs how much time.
//!
//! Data flows one way: scene file → validated [`scene::Scene`] → [`physics`] model → method → [`snapshot`] →
//! [`view`] → terminal. Imports run the other way; `tests/tidy.rs` enforces it. SI units throughout; `f64`; y is up.
#![forbid(unsafe_code)]

pub mod app;
pub mod audit;
pub mod cli;
pub mod export;
pub mod format;
pub mod frame;
pub mod geometry;
pub mod measure;
pub mod physics;
pub mod printable;
pub mod random;
pub mod roots;
pub mod scene;
pub mod snapshot;
pub mod terminal;
pub mod text_mode;
pub mod view;
pub mod worker;
