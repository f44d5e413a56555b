//! How much work one scene may be to read. A file of 16 MiB can describe more meetings of walls and spheres than could
//! be looked at in hours; so they are counted, and a scene that has too many is refused, on every machine alike.

use std::cell::Cell;

/// Comparisons of boxes that one scene may take for its walls and gases: about a second. A gas of a million spheres in
/// a room takes a fortieth of them, with a hundred walls right through it a third.
const MOST: u64 = 200_000_000;

/// What a comparison with a slanted wall takes, in comparisons of boxes.
pub(super) const SLANTED: u64 = 8;

/// What noting a wall in a cell of a gas takes, in comparisons of boxes; the note is kept too.
pub(super) const NOTED: u64 = 16;

/// The comparisons that reading a scene has left.
#[derive(Debug)]
pub(super) struct Effort {
    left: Cell<u64>,
}

impl Effort {
    /// The effort of a scene of which nothing is read yet.
    pub(super) fn whole() -> Effort {
        Effort { left: Cell::new(MOST) }
    }

    /// Counts so many comparisons; whether some are left.
    pub(super) fn spend(&self, comparisons: u64) -> bool {
        self.left.set(self.left.get().saturating_sub(comparisons));
        !self.spent()
    }

    /// Whether there were too many comparisons. What was found since is not to be believed.
    pub(super) fn spent(&self) -> bool {
        self.left.get() == 0
    }

    /// The refusal of a scene that takes more comparisons.
    pub(super) fn refusal() -> String {
        format!(
            "placing and checking its bodies takes more than {MOST:e} comparisons, which is refused; allowed are fewer \
             walls through the spheres, or fewer spheres"
        )
    }
}
