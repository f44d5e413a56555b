//! A finished buffer as bytes: terminal differences, text, ANSI, SVG.
//!
//! Nothing here knows what a frame shows. All four read cells through `cells`, which keeps control characters out,
//! whatever a buffer holds. Begin with `cells`.
//!
//! | file | owns |
//! |---|---|
//! | `cells` | a cell as a terminal can show it |
//! | `sgr` | colours and attributes as SGR sequences |
//! | `encode` | the bytes that turn the frame a terminal shows into the next |
//! | `text`, `svg` | a buffer as text, with or without colours; as an image |

mod cells;
mod encode;
mod sgr;
mod svg;
mod text;

pub use encode::Encoder;
pub use svg::svg;
pub use text::{ansi, text};
