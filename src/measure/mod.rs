//! Runs without a screen that measure: how far a method is from the truth, and what it costs.
//!
//! The error of a run is measured against `exact` on the same scene, up to the scene's *horizon*: until there the certified
//! error of `exact` is within what is asked, or a displacement of 1e-12 m has not yet grown by 1e6; beyond it positions
//! mean nothing. The cost is the processor time of one thread per simulated second, and the work counted. How far `exact`
//! itself is off, [`certify`](crate::certify) tells.
//!
//! For others to build on:
//! - [`Deviation::between`] two lists of positions: the largest distance and the sphere it is of. What a live panel shows.
//! - [`Reference::of`] a scene: an `exact` run kept at fixed [`Instants`], its impacts, and its [`Horizon`];
//!   [`Reference::meaningful`] says until when positions can be compared.
//! - [`errors`] of a setting against a reference, in one run; [`cost`] of a setting, best of several runs.
//! - [`Subject::measure`]: both as one row of the trade; [`front`] and [`cheapest`] of such rows.
//! - [`choose`]: the setting of least counted work that meets an error.
//!
//! ```
//! use carom::measure::Deviation;
//! use carom::physics::Simulation;
//! use carom::scene::{self, Method, Settings};
//!
//! let scene = scene::open("paper-1")?.scene;
//! let at = |method| {
//!     let mut run = Simulation::new(&scene, Settings { method, dt: 1e-3, tolerance: 1e-6 });
//!     run.run_to(0.25, |_| Some(Simulation::SLICE));
//!     run.at(0.25).x
//! };
//! let off = Deviation::between(&at(Method::Paper), &at(Method::Exact));
//! assert!(off.distance < 0.1, "{} m", off.distance);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Begin with `trade`, then `sample` and `yardstick`. Every function that may take long asks a [`GoOn`] every few
//! milliseconds and returns [`Interrupted`] if it returns false. Everything but times repeats to the bit.
//!
//! | file | owns |
//! |---|---|
//! | `sample` | a run read at fixed instants |
//! | `interrupt` | how what takes long is told to stop |
//! | `reference` | a run kept at fixed instants, for others to be compared with |
//! | `yardstick`, `horizon` | the reference of a scene, and until when it holds |
//! | `displaced`, `growth` | runs that begin a little aside; such runs taken along, a slice at a time |
//! | `deviation` | how far one run is from another |
//! | `slices` | how much work fits between two looks at whether to go on |
//! | `clock`, `cost` | processor time; the only clocks |
//! | `work` | counted work, the same on every machine |
//! | `ladder`, `trade` | which settings are tried, and a row of each |
//! | `side_by_side` | many tasks at a time, in order |
//! | `sweep`, `shard` | many settings side by side, or in parts that are merged |
//! | `front` | which settings are worth their time |
//! | `axes` | which error over which cost |
//! | `orders` | the order of each method in its knob |
//! | `fit` | the order at which an error falls |
//! | `accuracy` | the cheapest setting that meets an error |
//! | `observables` | what a crowd is seen to do, in a run or a file |
//! | `crowd`, `crowds` | what means over many seeds say beyond the horizon; many runs, or parts joined |
//! | `crowd_report`, `crowd_figure` | the same in words and as SVG |
//! | `alike` | settings that are one and the same run |
//! | `report`, `chart`, `figure`, `scale` | what was found, for a terminal and as SVG |
//! | `verify` | known results of physics and mathematics, measured here |

mod accuracy;
mod alike;
mod axes;
mod chart;
mod clock;
mod cost;
mod crowd;
mod crowd_figure;
mod crowd_report;
mod crowds;
mod deviation;
mod displaced;
mod figure;
mod fit;
mod front;
mod growth;
mod horizon;
mod interrupt;
mod ladder;
mod observables;
mod orders;
mod reference;
mod report;
mod sample;
mod scale;
mod shard;
mod side_by_side;
mod slices;
mod sweep;
mod trade;
pub mod verify;
mod work;
mod yardstick;

pub use accuracy::{Choice, Miss, Tried, choose};
pub use alike::alike;
pub use axes::{Axes, Cost as CostAxis, Error as ErrorAxis};
pub use clock::thread_cpu;
pub use cost::{Cost, cost};
pub use crowd::{Crowd, Mean, Ran, Stopped, crowd_run};
pub use crowd_figure::crowd_figure;
pub use crowd_report::{crowd_report, crowd_rows};
pub use crowds::{CrowdPlan, GatherError, PlacedRun, SceneCrowds, crowd_runs, crowds, gather};
pub use deviation::{Deviation, common_impacts, impact_time_error};
pub use figure::figure;
pub use fit::{Fit, fit};
pub use front::{Cheapest, cheapest, front};
pub use growth::Growth;
pub use interrupt::{GoOn, Interrupted};
pub use ladder::{DT, Ladder, Rung, TOLERANCES};
pub use observables::{Figures, Observables};
pub use reference::{Horizon, OwnError, Reference};
pub use report::report;
pub use sample::{Budget, EndReason, Impact, Instants, Sampled, sample};
pub use shard::{MergeError, NoShard, Placed, Shard, merge};
pub(crate) use side_by_side::side_by_side;
pub use slices::Slices;
pub use sweep::{Advance, Measured, Sweep, SweepError, Yardstick};
pub use trade::{ASKED, Errors, Subject, errors};
