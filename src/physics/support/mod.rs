//! What holds resting spheres up: the two complementarity problems of an island of resting contacts.
//!
//! With A = J M⁻¹ Jᵀ, per island (Acary, Brogliato, Numerical Methods for Nonsmooth Dynamical Systems, ch. 3 and 12):
//! velocity v⁺ = v + M⁻¹ Jᵀ Λ, 0 ≤ Λ ⊥ J v⁺ ≥ 0; then, for the contacts with J v⁺ = 0 alone, acceleration a = a_applied +
//! M⁻¹ Jᵀ λ, 0 ≤ λ ⊥ J a + k ≥ 0, where k is what the curvature of the contact adds to the second derivative of its gap. No
//! friction. v⁺ and a are unique; Λ and λ are not where contacts are redundant.
//!
//! One contact: closed form. One sphere on few walls: enumeration. Islands whose loads are nearly known: pivoting, where
//! that ends soon. Else small islands, and those of unlike masses: active set. Large islands of like masses: projected
//! Gauss–Seidel, and the active set if that has not converged.
//!
//! | file | owns |
//! |---|---|
//! | `resting` | both problems, for resting contacts; begin here |
//! | `problem`, `solution` | an island's problem, and the answer with how good it is |
//! | `island` | which bodies contacts connect |
//! | `solve` | island by island, by the solver that suits it |
//! | `enumerate`, `candidate`, `closely` | one body on few walls; one set of contacts that might carry it; that with all digits |
//! | `active_set`, `factor` | the active set, and its orthogonal factor |
//! | `pivoting`, `gram` | block principal pivoting, and its Cholesky factor |
//! | `gauss_seidel` | projected Gauss–Seidel |
//! | `equality` | contacts that hold both ways |
//! | `short` | lists that ask for no memory of their own as long as they are short |
//! | `agreement` | the solvers against each other, a test |
//!
//! Plain data in, plain data out; nothing here knows of scenes, walls or time.

mod active_set;
#[cfg(test)]
mod agreement;
mod candidate;
mod closely;
mod enumerate;
mod equality;
mod factor;
mod gauss_seidel;
mod gram;
mod island;
mod pivoting;
mod problem;
mod resting;
mod short;
mod solution;
mod solve;

pub use equality::{bind, restore, restore_both, restore_places, restore_unmet};
pub use island::{Island, islands};
pub use problem::Row;
pub use resting::{Bodies, Fate, Held, Resting, Surface, accelerations, hold, velocities};
pub use short::Short;
pub use solution::{Report, Solution, Solver};
pub use solve::solve;
