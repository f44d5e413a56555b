//! What is kept of each sphere: its trajectory, its next event, its cell. Two cache lines, in the layout that the speed
//! of the engine rests on.

use glam::DVec3;

use crate::physics::contact::Kind;
use crate::physics::path::Path;

/// State of a sphere at its own time, the beginning of its current parabola. 64 bytes, one cache line: twice four numbers,
/// as `schedule/simd.rs` reads them.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C)]
pub(crate) struct Trajectory {
    /// Centre at `t`, m.
    pub(crate) x: DVec3,
    /// The sphere's own time, s.
    pub(crate) t: f64,
    /// Velocity at `t`, m/s.
    pub(crate) v: DVec3,
    /// Radius, m.
    pub(crate) r: f64,
}

impl Trajectory {
    /// The path from time `t` (s) on, with acceleration `a`, m/s².
    #[inline(always)]
    pub(crate) fn path(&self, a: DVec3, t: f64) -> Path {
        let dt = t - self.t;
        Path { x: self.x + (self.v + a * (0.5 * dt)) * dt, v: self.v + a * dt, a }
    }

    /// The trajectory of this parabola with acceleration `a` (m/s²) that begins at time `t` (s).
    #[inline(always)]
    pub(crate) fn advanced_to(&self, a: DVec3, t: f64) -> Trajectory {
        let Path { x, v, .. } = self.path(a, t);
        if t == self.t { *self } else { Trajectory { x, t, v, r: self.r } }
    }
}

/// All that an event needs of a sphere: two cache lines, of which a look at it as a neighbour reads the first.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(128))]
pub(crate) struct Record {
    /// The sphere's current parabola.
    pub(crate) trajectory: Trajectory,
    /// The sphere's next event; written by the schedule alone.
    pub(crate) plan: Plan,
    /// The cell that the sphere is in, if there are cells; written by the schedule alone.
    pub(crate) cell: CellRef,
    /// How often the sphere's motion has changed.
    pub(crate) motion_version: u32,
    /// The sphere's index in the scene.
    pub(crate) sphere: u32,
    /// Inverse mass 1/m, 1/kg.
    pub(crate) inverse_mass: f64,
}

/// The next event of a sphere as predicted with what was known then. One is kept per sphere: of two partners the one that
/// was predicted last knows of their contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Plan {
    /// When the sphere touches something, s; infinite if never.
    pub(crate) contact: f64,
    /// When the sphere leaves its cell, s; infinite if never.
    pub(crate) crossing: f64,
    /// The wall's index, or the other sphere's slot.
    pub(crate) other: u32,
    /// How often the other sphere's motion had changed when the plan was made: if it has changed since, the plan is stale.
    pub(crate) motion_version: u32,
    /// Whether the sphere touches a wall or another sphere.
    pub(crate) kind: Kind,
    /// Whether the bodies touch at `contact`; else it is time to look again.
    pub(crate) is_contact: bool,
    /// Through which side the sphere leaves its cell.
    pub(crate) exit: Exit,
}

impl Plan {
    /// A plan in which nothing happens.
    pub(crate) const IDLE: Plan = Plan {
        contact: f64::INFINITY,
        crossing: f64::INFINITY,
        other: 0,
        motion_version: 0,
        kind: Kind::Wall,
        is_contact: true,
        exit: Exit { axis: 0, sign: 1 },
    };
}

/// A cube of space, counted along each axis from the origin of the cells.
pub(crate) type CellCoordinates = [i32; 3];

/// The cell that a sphere is in.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct CellRef {
    /// The cube of space.
    pub(crate) coordinates: CellCoordinates,
    /// The entry of the table into which space is folded.
    pub(crate) index: u32,
}

impl CellRef {
    /// A sphere that is in no cell.
    pub(crate) const LOOSE: CellRef = CellRef { coordinates: [0; 3], index: u32::MAX };

    /// Whether the sphere is in no cell.
    #[inline]
    pub(crate) fn is_loose(self) -> bool {
        self.index == u32::MAX
    }
}

/// A side of a cell: the axis, and +1 or −1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Exit {
    /// The axis: 0, 1 or 2.
    pub(crate) axis: u8,
    /// The side along the axis: +1 or −1.
    pub(crate) sign: i8,
}
