//! Why a contact was answered as it was, in lines that can be checked by hand: plain text of a [`Snapshot`], for the
//! screen and for lines.
//!
//! What is said is what the method used, at the instant of the contact; nothing is simulated again. Begin with `card`.
//!
//! | file | owns |
//! |---|---|
//! | `card` | one contact: class and rule, speeds, impulse, energy, how deep, why it rests |
//! | `approach` | how its time follows from a polynomial |
//! | `sentence` | a contact, or an event of the list, in one line |
//! | `support` | the force that holds a contact at rest |
//! | `line` | a line of text and what it is about |
//!
//! [`Snapshot`]: crate::snapshot::Snapshot

mod approach;
mod card;
mod line;
mod sentence;
mod support;

pub use card::{Card, acting, card};
pub use line::Line;
pub use sentence::{event, sentence};
pub use support::support_force;
