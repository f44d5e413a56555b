//! What counts as rounding in the event engine: every threshold that stands for it, in one place.
//!
//! Each is relative to the size of what it is a rounding of: the clock's ulp, the coordinates, a speed, a radius. None is
//! a length or a time, so that a scene in other units decides the same. Errors are usually an ulp or two; the thresholds
//! are so far above that sums of many stay below, and as far below what a scene can mean as they can be.
//!
//! | threshold | of what | usual error | too small | too large |
//! |---|---|---|---|---|
//! | [`CLOCK_ULPS`] | time of a flight | 1 ulp of the clock | events without end at one instant | real hops rest |
//! | [`HOP`] | height of a hop | 1 ulp of the coordinates | bounces that coordinates hide go on | low hops rest |
//! | [`SUM`] | velocities, accelerations | 1 ulp a summand | contacts that hold let go, and again | slow motion stops |
//! | [`BRUSH`] | an approach between two that open | 2 ulp of the speed | two contacts take turns for ever | soft impacts lose nothing |
//! | [`CHAIN`] | approaches after a long chain | 1000 ulp of the speed | a collapse is not seen to end | a chain ends early |
//! | [`CLOSING`] | an approach that a look sees | 2 ulp of the speeds | three in a row push the middle one for ever | slow approaches are seen late |
//! | [`LOST`] | an impact's change of speed | 10 ulp of the speed | loops count as chains | chains count as loops |
//! | [`DRIVEN`] | an approach of two that rest | 1e-15 of the speed | rests break by rounding | soft blows break no rest |
//! | [`WEDGE`] | the way out between two walls | 2 ulp | a sphere that just fits bounces for ever | a narrow wedge holds |
//! | [`SHARED_GAP`] | a gap at a seam | 2 ulp of the coordinates | a sphere sinks in beyond a seam | walls hold too early |
//! | [`SHARED_POINT`] | place of a seam | 1e-15 r | the same | the same |
//! | [`TOUCHED_GAP`] | gap right after an impact | 1e-15 r | the energy of low bounces drifts | a graze counts as a bounce |
//! | [`SUMMED_HOP`] | height of a bounce | – | millions of events before a rest | visible bounces are summed up |
//! | [`PULLED`] | way pulled while bounces are summed | – | the same | the sum misses the pull |

/// Flights shorter than this many ulp of the clock never decay: what is left of one is a rounding of its beginning (Zeno).
pub(crate) const CLOCK_ULPS: f64 = 10.0;

/// Hops no higher than this, relative to the coordinates, are rounding: 4 ulp.
pub(crate) const HOP: f64 = 4.0 * f64::EPSILON;

/// Below this share of what they are sums of, velocities and accelerations are rounding: 256 ulp.
pub(crate) const SUM: f64 = 256.0 * f64::EPSILON;

/// Approaches below this share of the speeds are rounding where the contact is about to open: 8 ulp.
pub(crate) const BRUSH: f64 = 8.0 * f64::EPSILON;

/// Normal velocities that a look sees are rounding below this share of the bodies' speeds: 64 ulp.
pub(crate) const CLOSING: f64 = 64.0 * f64::EPSILON;

/// Below this share of the fastest approach of a chain, or of the speeds of its bodies, an approach is what the rounding of
/// a thousand impacts may have made: 4096 ulp.
pub(crate) const CHAIN: f64 = 4096.0 * f64::EPSILON;

/// Impacts at approaches below this share of the speeds of their bodies change nothing: 64 ulp.
pub(crate) const LOST: f64 = 64.0 * f64::EPSILON;

/// Approaches of two bodies that rest on each other are rounding below this share of the speed.
pub(crate) const DRIVEN: f64 = 1e-12;

/// A wall can be left if that does not take turning by nearly a right angle: u·n above 64 ulp is a wedge of 1e-7 rad, in
/// which a sphere bounces thirty million times and is out.
pub(crate) const WEDGE: f64 = 64.0 * f64::EPSILON;

/// Gap to a wall at a point where another one is touched that counts as none, relative to the coordinates: 64 ulp.
pub(crate) const SHARED_GAP: f64 = 64.0 * f64::EPSILON;

/// Contacts of one sphere are at one point if no farther apart than this, in radii: between rounding, and an angle at
/// which the approach to the second wall shows before it overlaps.
pub(crate) const SHARED_POINT: f64 = 1e-8;

/// A sphere no farther than this many radii from a face has just touched it.
pub(crate) const TOUCHED_GAP: f64 = 1e-9;

/// Bounces whose hops are lower than this many radii are summed up in closed form.
pub(crate) const SUMMED_HOP: f64 = 1e-12;

/// How far a sphere that something else holds may be pulled while bounces that are summed up go on, in radii.
pub(crate) const PULLED: f64 = 1e-9;
