//! What does not keep to a rule yet, exactly: an entry that keeps to it fails as well, so that these lists only get
//! shorter.

/// Files of a circle of imports.
pub(crate) const IN_CIRCLES: &[&str] = &[
    "src/physics/events/bounce.rs",
    "src/physics/events/chattering.rs",
    "src/physics/events/engine.rs",
    "src/physics/events/impact.rs",
    "src/physics/events/instant.rs",
    "src/physics/events/islands/equilibrium.rs",
    "src/physics/events/islands/resting.rs",
    "src/physics/events/rest_criteria.rs",
    "src/physics/events/resumable.rs",
    "src/physics/events/schedule/candidates.rs",
    "src/physics/events/schedule/cells.rs",
    "src/physics/events/schedule/prediction.rs",
    "src/physics/events/schedule/prefetch.rs",
    "src/physics/events/schedule/queue.rs",
    "src/physics/events/schedule/simd.rs",
    "src/physics/events/schedule/ties.rs",
    "src/physics/events/schedule/upkeep.rs",
    "src/physics/events/trajectories.rs",
];

/// Files that take all names of their surroundings.
pub(crate) const ALL_NAMES: &[&str] = &[];

/// (file, function) of functions with too many arguments.
pub(crate) const MANY_ARGUMENTS: &[(&str, &str)] = &[
    ("src/physics/contact_time.rs", "grazes"),
    ("src/physics/events/schedule/prediction.rs", "choose"),
    ("src/physics/impact_law.rs", "wall_impulse"),
];
