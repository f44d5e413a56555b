//! A run that certifies another: how far `exact` is from what its scene says, and until when that is known.
//!
//! [`certify`] runs a scene by `exact` and a *shadow* beside it in arithmetic of 32 digits ([`Double`]). The shadow is told
//! which bodies meet next, and nothing else: it finds the time by Newton's iteration, acts by the paper's law, slides on
//! faces, over edges and over other spheres, and shows for all other bodies, by planes between them, that they do not
//! touch. With the solvers it shares that arithmetic alone, and it reads the scene, not the model. Where it cannot follow, the
//! certificate ends, and says why.
//!
//! ```
//! use carom::certify::certify;
//!
//! let scene = carom::scene::open("paper-0")?.scene;
//! let certificate = certify(&scene, 3.0, &|| true).expect("it was not interrupted");
//! assert_eq!(certificate.ending, None);
//! assert!(certificate.error < 1e-13, "{} m", certificate.error);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | file | owns |
//! |---|---|
//! | `vector` | points and directions in the arithmetic of [`Double`] |
//! | `course` | how a sphere moves between events |
//! | `obstacle` | walls and spheres as what is met: closest points, normals |
//! | `bend`, `polynomial` | the series of a motion that what holds it bends; where a polynomial falls below 0 |
//! | `touching`, `start` | when bodies touch; what touches as a motion begins |
//! | `law`, `support` | what an impact does; what contacts take that hold |
//! | `clear`, `glance`, `gaps` | that nothing else touches; by one obstacle, by a quick look, by all |
//! | `body`, `shadow` | a sphere, and all of them, from event to event |
//! | `meeting`, `island` | how bodies come to a contact; how an instant ends, for spheres that lean on each other |
//! | `next` | what comes next by itself of spheres that rest |
//! | `ending` | why a certificate ends |
//! | `growth` | when the error became how large |
//! | `certificate` | `exact` and the shadow side by side; begin here |

mod bend;
mod body;
mod certificate;
mod clear;
mod course;
mod ending;
mod gaps;
mod glance;
mod growth;
mod island;
mod law;
mod meeting;
mod next;
mod obstacle;
mod polynomial;
mod shadow;
mod start;
mod support;
mod touching;
mod vector;

pub use crate::double::Double;
pub use certificate::{Certificate, certify, certify_within};
pub use ending::{Cause, Ending};
