//! The event engine, on which `exact` and `swept` run.
//!
//! Between events every sphere moves on a parabola. `engine` holds the loop, between two halves that know nothing of each
//! other's work. The `schedule` knows what comes next: it predicts each sphere's next event and finds the earliest of all.
//! The mechanics know what becomes of it:
//!
//! | file | what |
//! |---|---|
//! | `mechanics` | the state that events act on: trajectories, rests, impacts |
//! | `trajectories`, `record` | where every sphere is, and the clock |
//! | `contact_state` | two bodies that touch, at one instant |
//! | `impact`, `plain_pair`, `plain_wall` | a contact happens: the impact law acts, or a rest may begin |
//! | `rest_reason`, `rest_criteria` | why a contact rests: every reason with its threshold, and the tests |
//! | `rounding` | every threshold that stands for rounding |
//! | `bounce`, `bounce_series`, `rub` | corrections of a bounce; series of bounces in closed form |
//! | `chattering`, `instant`, `impacts` | what impacts have led to: small bounces in a row, chains at one instant |
//! | `long_chain`, `last_impacts`, `repeated_round` | a chain of impacts that repeats a round at one place: many rounds at once |
//! | `hopping`, `hop_on` | a sphere that repeats the same low flights between faces: many at once |
//! | `hops`, `orbit` | equal hops on one face; a periodic orbit between several |
//! | `squeezed` | spheres that just fit between walls |
//! | `islands` | resting contacts, solved island by island: what holds, and how the spheres move on |
//! | `curved` | islands without a parabola: the motion over edges, corners and spheres |
//!
//! Data flow: `schedule` → the earliest event → `impact` or `islands` → which spheres have [`changed`] → `schedule`. What
//! happens at load is in `initial_contacts`; `resumable` lets a run go on bit for bit where another was; `detector` is what
//! a method gives to the engine: when do bodies next touch? Begin with `engine`, then `record`, then `impact`.

mod bounce;
mod bounce_series;
mod changed;
mod chattering;
mod contact_state;
mod curved;
pub(super) mod detector;
pub(super) mod engine;
mod hop_on;
mod hopping;
mod hops;
mod impact;
mod impacts;
mod initial_contacts;
mod instant;
mod islands;
mod last_impacts;
mod long_chain;
mod mechanics;
mod orbit;
mod plain_pair;
mod plain_wall;
mod record;
mod repeated_round;
mod rest_criteria;
pub(super) mod rest_reason;
pub(super) mod resumable;
pub(super) mod rounding;
mod rub;
mod schedule;
mod squeezed;
mod trajectories;
