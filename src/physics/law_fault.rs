//! The impact law broken on purpose, on one thread: for the test that known results then fail. Not part of the product.

use std::cell::Cell;

use super::model::ContactLaw;

thread_local! {
    /// What the restitution of pairs and of walls is multiplied by.
    static FACTORS: Cell<(f64, f64)> = const { Cell::new((1.0, 1.0)) };
}

/// What `work` makes of an impact law whose restitution is `pairs` and `walls` times what scenes ask for.
pub(crate) fn with_restitution_times<T>(pairs: f64, walls: f64, work: impl FnOnce() -> T) -> T {
    FACTORS.set((pairs, walls));
    let result = work();
    FACTORS.set((1.0, 1.0));
    result
}

/// The law of this thread, where a scene asks for `law`.
pub(super) fn broken(law: ContactLaw) -> ContactLaw {
    let (pairs, walls) = FACTORS.get();
    let (restitution, wall_restitution) = (law.restitution * pairs, law.wall_restitution * walls);
    ContactLaw { restitution, wall_restitution, ..law }
}
