//! An independent judge of a run. It reads states and contacts as they are told, and shares no code with what finds and
//! answers contacts: its distances, its law and its search are written anew, from the raw data of the scene.
//!
//! | file | judges |
//! |---|---|
//! | `distance` | how far a point is from a wall: by projection and by clamped segments |
//! | `crowd` | which spheres are near each other and the walls |
//! | `promise` | how deep each method may overlap |
//! | `overlap` | overlap, passage through walls |
//! | `law` | each contact by itself: its normal, its impulse, its jump of velocity |
//! | `replay` | velocities between two frames: impulses and forces explain them, momentum with the walls |
//! | `energy` | that energy never rises, and falls by no more than impacts and rests take |
//! | `rest` | that what rests is at rest |
//! | `watch` | the cheapest part, for every run: the deepest overlap, and energy |
//! | `frame`, `judge`, `finding` | what is judged; all of the above, asked in turn; what they find |
//!
//! What it can't see: what happens between the ends of two frames and leaves no trace in states or contacts.
//!
//! A [`Judge`] is shown frame by frame what a run tells (a [`Frame`]) and keeps [`Findings`]; begin with `judge`.

mod crowd;
mod distance;
mod energy;
mod finding;
mod frame;
mod judge;
mod law;
mod overlap;
mod promise;
mod replay;
mod rest;
mod watch;

pub use finding::{Bodies, Fault, Finding, Findings};
pub use frame::Frame;
pub use judge::Judge;
pub use watch::{Alarm, Watch};
