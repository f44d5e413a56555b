//! A finished buffer as bytes: terminal differences, text, ANSI, SVG.
//!
//! Nothing here knows what a frame shows. All four read cells through `cells`, the chokepoint that keeps control
//! characters out, whatever a buffer holds.

mod cells;
mod encode;
mod sgr;
mod svg;
mod text;

pub use encode::Encoder;
pub use svg::svg;
pub use text::{ansi, text};
