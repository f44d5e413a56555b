//! Lists of an island: nearly all are short, and are made anew for every event.

use smallvec::SmallVec;

/// A list that asks for memory of its own only beyond eight entries.
pub type Short<T> = SmallVec<[T; 8]>;
