//! Every threshold by which the event engine tells rest and rounding from motion, in one place. Those of the integration of
//! curved rest stand in `curved`, those of the linear solvers in `support`, those of memory and speed in `schedule`.
//!
//! Each is relative to the size of what it is a rounding of: the clock's ulp, the coordinates, a speed, a radius. None is a
//! length or a time, so that a scene in other units decides the same. Errors are usually an ulp or two; the thresholds are
//! so far above that sums of many stay below, and as far below what a scene can mean as they can be.
//!
//! | threshold | of what | usual error | too small | too large |
//! |---|---|---|---|---|
//! | [`CLOCK_ULPS`] | time of a flight | 1 ulp of the clock | events without end at one instant | real hops rest |
//! | [`HOP`] | height of a hop | 1 ulp of the coordinates | bounces that coordinates hide go on | low hops rest |
//! | [`SUM`] | velocities, accelerations | 1 ulp a summand | contacts that hold let go, and again | slow motion stops |
//! | [`BRUSH`] | an approach between two that open, or along a wall | 2 ulp of the speed | contacts take turns for ever; edges rub | soft impacts lose nothing |
//! | [`CHAIN`] | approaches after a long chain | 1000 ulp of the speed | a collapse is not seen to end | a chain ends early |
//! | [`HELD`] | an approach, beside a long chain, to what rests | below 1e-8 of the speed | chains go on impact by impact | a rest that breaks is missed |
//! | [`CLOSING`] | an approach that a look sees | 2 ulp of the speeds | three in a row push the middle one for ever | slow approaches are seen late |
//! | [`LOST`] | an impact's change of speed | 10 ulp of the speed | loops count as chains | chains count as loops |
//! | [`DRIVEN`] | an approach of two that rest | 1e-15 of the speed | rests break by rounding | soft blows break no rest |
//! | [`WEDGE`] | the way out between two walls | 2 ulp | a sphere that just fits bounces for ever | a narrow wedge holds |
//! | [`SHARED_GAP`] | a gap at a seam | 2 ulp of the coordinates | a sphere sinks in beyond a seam | walls hold too early |
//! | [`SHARED_POINT`] | place of a seam | 1e-15 r | a sphere sinks in beyond a seam | walls hold too early |
//! | [`COVERED_GAP`] | gap at which a search finds an edge to be touched | 256 ulp of lengths | it is met again and again | it is looked at longer |
//! | [`HEALED`], [`HEALED_WITHIN_TOLERANCE`] | overlap of what rests, over many rests | up to 1e-11 r | overlaps add up | bodies are lifted for nothing |
//! | [`TOUCHED_GAP`] | gap right after an impact | 1e-15 r | the energy of low bounces drifts | a graze counts as a bounce |
//! | [`SUMMED_HOP`] | height of a bounce | – | millions of events before a rest | visible bounces are summed up |
//! | [`UNTOLD`] | energy of sliding that repeated flights may lose untold | – | rubbed hops are followed one by one | energies of frames are off |
//! | [`PULLED`] | way pulled while bounces are summed | – | millions of events before a rest | the sum misses the pull |
//! | [`SLOW`] | a slide's normal velocity | 1e-15 of the speed | what slides is pressed by the wrong part | more work |
//! | [`APART`] | gap of an idle contact | up to 1e-11 r | rests that hold are not told | rests are told that are over |
//! | [`PAUSE`] | time that a stuck contact is held | – | it is stuck again at once | it is seen to hang |
//!
//! Counts, and bounds that stand for what many contacts do together rather than for rounding:
//!
//! | threshold | of what | usually | too small | too large |
//! |---|---|---|---|---|
//! | [`LEVEL`] | cosine between two walls | 1 at a seam, 0 in a corner of a box | corners hold down | seams strike for ever |
//! | [`SMALL`] | way of a bounce, in radii | – | chatter is not seen | bounces that can be seen count |
//! | [`LONG_ROW`], [`DECAY`] | small bounces in a row | fewer if they die out | rows that die out rest | events without end |
//! | [`ELASTIC_ROW`] | small elastic bounces in a row | – | chains that end rest | events without end |
//! | [`FED`] | impulses beside what weighs | about 1 in a pile | piles chatter on | chains that end rest |
//! | [`MEMORY`] | what each impact leaves of a row's sums | – | one impact decides | what is long past decides |
//! | [`LONG_CHAIN`] | events at one instant | a few | more work | more work |
//! | [`SHARE`] | impacts of one contact in a collapse | – | a bystander rests with it | a collapse rests piece by piece |
//! | [`STUCK`] | releases of one contact at an instant or, creeping, in a pause | 1 or 2 | islands pause that would let go | more work |

/// Flights shorter than this many ulp of the clock never decay: what is left of one is a rounding of its beginning (Zeno).
pub(crate) const CLOCK_ULPS: f64 = 10.0;

/// Hops no higher than this, relative to the coordinates, are rounding: 4 ulp.
pub(crate) const HOP: f64 = 4.0 * f64::EPSILON;

/// Below this share of what they are sums of, velocities and accelerations are rounding: 256 ulp.
pub(crate) const SUM: f64 = 256.0 * f64::EPSILON;

/// Approaches below this share of the speeds are rounding where the contact is about to open, or a wall is not pressed: 8 ulp.
pub(crate) const BRUSH: f64 = 8.0 * f64::EPSILON;

/// Normal velocities that a look sees are rounding below this share of the bodies' speeds: 64 ulp.
pub(crate) const CLOSING: f64 = 64.0 * f64::EPSILON;

/// Below this share of the fastest approach of a chain, or of the speeds of its bodies, an approach is what the rounding of
/// a thousand impacts may have made: 4096 ulp.
pub(crate) const CHAIN: f64 = 4096.0 * f64::EPSILON;

/// Share of the speeds with which a round of a long chain may drive a body into what it rests on, and be stopped by that.
pub(crate) const HELD: f64 = 1e-6;

/// Impacts at approaches below this share of the speeds of their bodies change nothing: 64 ulp.
pub(crate) const LOST: f64 = 64.0 * f64::EPSILON;

/// Approaches of two bodies that rest on each other are rounding below this share of the speed.
pub(crate) const DRIVEN: f64 = 1e-12;

/// A wall can be left if that does not take turning by nearly a right angle: u·n above 64 ulp is a wedge of 1e-7 rad, in
/// which a sphere bounces thirty million times and is out.
pub(crate) const WEDGE: f64 = 64.0 * f64::EPSILON;

/// Gap to a wall at a point where another one is touched that counts as none, relative to the coordinates: 64 ulp.
pub(crate) const SHARED_GAP: f64 = 64.0 * f64::EPSILON;

/// Gap up to which an edge that a face covers is held without carrying, relative to the coordinates and the wall: a search finds it to be touched from up to 256 ulp of the sum of all lengths that it is found from.
pub(crate) const COVERED_GAP: f64 = 4096.0 * f64::EPSILON;

/// Deepest overlap at rest that is rounding and put right, in radii: a contact that opens and closes over and over may sink in
/// further than the 1e-12 r of one rest.
pub(crate) const HEALED: f64 = 1e-10;

/// Deepest overlap at rest that is put right where a tolerance leaves deeper ones, in radii: contacts are found at any depth within it then.
pub(crate) const HEALED_WITHIN_TOLERANCE: f64 = 1e-12;

/// Contacts of one sphere are at one point if no farther apart than this, in radii: between rounding, and an angle at
/// which the approach to the second wall shows before it overlaps.
pub(crate) const SHARED_POINT: f64 = 1e-8;

/// A sphere no farther than this many radii from a face has just touched it; one that hops no higher touches it all the
/// while.
pub(crate) const TOUCHED_GAP: f64 = 1e-9;

/// Bounces whose hops are lower than this many radii are summed up in closed form, and what rests and is pressed takes none. Off
/// an overlap that a tolerance allows, or where coordinates tell less, higher ones are summed up too.
pub(crate) const SUMMED_HOP: f64 = 1e-12;

/// Largest energy of sliding that flights followed at once may rub away before they are told, in units of what a fall by the
/// radius gains: no more than a tenth of what the energy of a frame may be off by.
pub(crate) const UNTOLD: f64 = 1e-12;

/// How far a sphere that something else holds may be pulled while bounces that are summed up go on, in radii.
pub(crate) const PULLED: f64 = 1e-9;

/// Normal velocities below this share of the speed may be those of a sphere that slides.
pub(crate) const SLOW: f64 = 1e-6;

/// Gap, in radii, from which on a contact that carries nothing is not told to rest: idle ones open up to 1e-6 of the
/// accelerations before their island is solved again.
pub(crate) const APART: f64 = 1e-10;

/// How long stuck contacts are held, in units of the time in which the spheres move by a radius: long enough that the clock
/// goes on, too short to be seen.
pub(crate) const PAUSE: f64 = 1e-7;

/// Cosine of the angle between two walls up to which an impulse off the one is mostly one off the other: 45°.
pub(crate) const LEVEL: f64 = 0.7;

/// A bounce is small if the gap has opened by less than this many radii since the impact before.
pub(crate) const SMALL: f64 = 1e-7;

/// Fewest small bounces of one contact in a row, without dying out, that count as chatter. Across less than [`SUMMED_HOP`]
/// that alone is enough; else they must be more than [`DECAY`] times 1 / (1 − e) too.
pub(crate) const LONG_ROW: u32 = 100;

/// Number of impacts, in units of 1 / (1 − e), after which restitution alone leaves e⁻⁵⁰ of the speed.
pub(crate) const DECAY: f64 = 50.0;

/// Elastic bounces in a row that coordinates cannot tell from none, or, beside walls that rub, lower than [`SUMMED_HOP`].
pub(crate) const ELASTIC_ROW: u32 = 1000;

/// A row is fed if its last impulses are no more than this many times what all bodies weigh meanwhile: whatever is piled
/// upon them. Those of a chain that ends by itself, in which a fast body is turned round across a small gap, are far more.
pub(crate) const FED: f64 = 8.0;

/// What each impact leaves of the memory of those before: the last ones are some 64.
pub(crate) const MEMORY: f64 = 1.0 - 1.0 / 64.0;

/// Events at one instant after which it is watched whether approaches die out: chains that die sooner end by themselves.
pub(crate) const LONG_CHAIN: u64 = 1000;

/// Impacts at one instant of a contact that belongs to a collapse of others, and rests with it: the limit of the chain is
/// that none of them approaches any longer.
pub(crate) const SHARE: u32 = 100;

/// Releases of one contact without the clock advancing or, of one that creeps, within one pause, after which it is held for
/// a moment.
pub(crate) const STUCK: u32 = 20;
