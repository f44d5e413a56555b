//! When do a sphere and a wall, or two spheres, next touch while approaching?
//!
//! The event rule (Bannerman, Strobl, Formella, Pöschel, Comput. Part. Mech. 1, 191, 2014): the first t ≥ 0 at which
//! the gap is ≤ 0 **and** shrinking. So bodies that overlap by rounding and approach meet now, bodies that overlap and
//! part do not meet, and bodies that overlap, part and are brought back meet at the apex. There are no tolerances in
//! time and no memory of the last partner.
//!
//! Centres move as x + v t + a t²/2. Spheres with equal accelerations and faces are quadratics; edges, corners and
//! spheres with different accelerations are quartics, solved only where the path comes near enough.

use glam::DVec3;

use super::impact_law::{normal_velocity, pair_normal_velocity};
use super::path::Path;
use super::wall::{Face, Part, Touch, curvature, edge_direction, touch};
use super::wall_parts::part_ahead;
use crate::roots::{bound, bracketed, monotone, quadratic_fall, value};

/// An approach that would go no deeper than this, relative to the coordinates, before it turns back is none: 8 ulp.
const GRAZE: f64 = 8.0 * f64::EPSILON;

/// Rounding of the gap to a closest point, in units of what [`WallSearch::rounding`] allows the polynomial of its time: 16 ulp of
/// all lengths.
const FOOT: f64 = 1.0 / 16.0;

/// Square of a distance over that of the sum of the radii from which a pair is far: 1e-13 radii of ε x²/reach²/2.
const FAR: f64 = 1e3;

/// The times t in [0, before) from which a quartic is ≤ 0 while falling, one for each stretch on which it falls.
fn quartic_falls(c: &[f64; 5], before: f64) -> ([f64; 3], usize) {
    let mut falls = [0.0; 3];
    let mut count = 0;
    let end = before.min(bound(c) * 1.01);
    for [from, to] in monotone(c, 0.0, end).pieces() {
        let (start, finish) = (value(c, from), value(c, to));
        if start <= finish || finish > 0.0 || count == 3 {
            continue;
        }
        falls[count] = if start <= 0.0 { from } else { bracketed(c, from, to) };
        count += 1;
    }
    (falls, count)
}

/// Σ cᵢ tⁱ = |x + v t + a t²/2|² − `reach`², lowest power first, in m² over sⁱ; `reach` in m.
pub(super) fn distance_polynomial(path: &Path, reach: f64) -> [f64; 5] {
    let Path { x, v, a } = *path;
    [
        x.length_squared() - reach * reach,
        2.0 * x.dot(v),
        v.length_squared() + x.dot(a),
        v.dot(a),
        0.25 * a.length_squared(),
    ]
}

/// When two spheres whose radii sum to `reach` (m) next meet while approaching, s from now; `path` is that of one
/// centre seen from the other. Only times below `before` (s) matter.
#[inline]
pub fn sphere_sphere(path: &Path, reach: f64, before: f64) -> Option<f64> {
    if path.a == DVec3::ZERO { straight_pair(path.x, path.v, reach) } else { curved_pair(path, reach, before) }
}

/// When two spheres of equal acceleration next meet, s from now: the first t at which |x + v t| falls to `reach` (m), for a
/// relative position `x` (m) and velocity `v` (m/s).
#[inline]
pub fn straight_pair(x: DVec3, v: DVec3, reach: f64) -> Option<f64> {
    let b = x.dot(v);
    if b >= 0.0 {
        return None;
    }
    let c = x.length_squared() - reach * reach;
    if c <= 0.0 {
        // the handler's own expression decides whether it is an approach
        let closing = pair_normal_velocity(x, v);
        let path = Path { x, v, a: DVec3::ZERO };
        return (closing < 0.0 && !pair_grazes(&path, closing)).then_some(0.0);
    }
    let discriminant = if is_far(c, reach) {
        reach * reach * v.length_squared() - x.cross(v).length_squared()
    } else {
        b * b - v.length_squared() * c
    };
    (discriminant > 0.0).then(|| c / (discriminant.sqrt() - b))
}

/// Whether spheres of which c = x² − `reach`² (m²) are so far from each other that b² − v² c cancels: it would be off by
/// ε x²/reach² of itself, and the gap at the time found by half as much, in radii; v² reach² − |x × v|² by ε |x|/reach.
#[inline]
pub(super) fn is_far(c: f64, reach: f64) -> bool {
    c > FAR * (reach * reach)
}

/// What decides whether an approach turns into a retreat by itself.
struct ClosingMotion {
    /// v_n < 0, m/s.
    closing: f64,
    /// How fast v_n grows, m/s².
    bends: f64,
    /// Relative speed, m/s: with the acceleration it bounds how fast `bends` changes.
    speed: f64,
    /// Size of the relative acceleration, m/s².
    acceleration: f64,
    /// Radius of curvature, m.
    radius: f64,
    /// Size of the coordinates, m.
    size: f64,
}

impl ClosingMotion {
    /// Whether rounding has made an approach that is none. Where a sphere is pressed against one body and slides past
    /// another, it would otherwise be driven into the one and the other in turn, for ever at one instant. An approach that
    /// an impulse has made is none of rounding's, however shallow; that of places turns the normal.
    fn grazes(&self) -> bool {
        let rounding = f64::EPSILON * (4.0 * self.size / self.radius).max(64.0);
        -self.closing <= rounding * self.speed && self.turns_within(GRAZE * self.size)
    }

    /// Whether it turns into a retreat by itself before the gap has shrunk by `room`, m. `bends` must still be positive
    /// when v_n reaches 0.
    fn turns_within(&self, room: f64) -> bool {
        let ClosingMotion { closing, bends, speed, acceleration, radius, .. } = *self;
        let jerk = 3.0 * speed * (acceleration + speed * speed / radius) / radius;
        bends > 0.0 && closing * closing <= 2.0 * bends * room && -2.0 * jerk * closing <= bends * bends
    }
}

/// Whether two spheres that approach at v_n = `closing` (m/s) only graze; `path` is that of one centre seen from the other,
/// now.
fn pair_grazes(path: &Path, closing: f64) -> bool {
    let (distance, speed) = (path.x.length(), path.v.length());
    let bends = path.x.dot(path.a) / distance + (speed * speed - closing * closing) / distance;
    let acceleration = path.a.length();
    ClosingMotion { closing, bends, speed, acceleration, radius: distance, size: distance }.grazes()
}

fn curved_pair(path: &Path, reach: f64, before: f64) -> Option<f64> {
    // first of all: of most pairs nothing else need be known
    if path.stays_within(path.x.length() - reach, before) {
        return None;
    }
    let c = distance_polynomial(path, reach);
    let closing = pair_normal_velocity(path.x, path.v);
    if c[0] <= 0.0 && closing < 0.0 && !pair_grazes(path, closing) {
        return Some(0.0);
    }
    let (falls, count) = quartic_falls(&c, before);
    falls[..count].iter().find_map(|&t| approached_pair(path, reach, t)).filter(|&t| t < before)
}

/// When two spheres that touch at about `t` (s) approach, s from now: then, if v_n < 0; where v_n = 0 to rounding is about
/// to become negative, then too; else not. One Newton step on the distance itself, whose rounding is far below that of its
/// square's polynomial.
fn approached_pair(path: &Path, reach: f64, t: f64) -> Option<f64> {
    let (x, v) = (path.at(t), path.velocity(t));
    let (closing, then) = (pair_normal_velocity(x, v), Path { x, v, a: path.a });
    if closing < 0.0 {
        if pair_grazes(&then, closing) {
            return None;
        }
        let polished = t - (x.length() - reach) / closing;
        return Some(if (polished - t).abs() <= 1e-6 * t { polished } else { t });
    }
    if closing > 1e-13 * (path.v.length() + v.length()) {
        return None;
    }
    let bends = then.distance_acceleration(x / x.length(), x.length());
    (bends < 0.0).then(|| t - 2.0 * closing / bends)
}

/// When a sphere of radius `r` (m) next meets a wall while approaching it, s from now: face, edges and corners, from
/// both sides. Only times below `before` (s) matter.
#[inline]
pub fn sphere_wall(path: &Path, r: f64, face: &Face, before: f64) -> Option<f64> {
    if path.v == DVec3::ZERO && path.a == DVec3::ZERO {
        return None; // what stands still meets nothing; a bound of its way would be 0 · ∞
    }
    let search = WallSearch { path, r, face, before };
    let height = [face.height(path.x), face.normal.dot(path.v), 0.5 * face.normal.dot(path.a)];
    if height[0].abs() > r {
        let side = if height[0] < 0.0 { -1.0 } else { 1.0 };
        // the plane is never farther than the wall: nothing can happen before it is within reach
        let t = quadratic_fall([side * height[0] - r, side * height[1], side * height[2]])?;
        if t >= before {
            return None;
        }
        if search.is_out_of_reach() {
            return None;
        }
        if let Some(t) = search.verified(t) {
            return Some(t);
        }
    } else if search.is_out_of_reach() {
        return None;
    }
    search.everywhere(height)
}

/// A search for the time at which one sphere next meets one wall.
struct WallSearch<'a> {
    /// The sphere's path from now on.
    path: &'a Path,
    /// The sphere's radius, m.
    r: f64,
    face: &'a Face,
    /// Only times below this matter, s from now.
    before: f64,
}

impl WallSearch<'_> {
    /// Whether the wall is certainly too far away: tiles beside the one that a sphere bounces on, of which the closest
    /// point takes longer to find. Asked where the plane is within reach, and so is the wall if the foot lies on it.
    fn is_out_of_reach(&self) -> bool {
        if self.face.shades(self.path.x) {
            return false;
        }
        let room = self.face.at_least(self.path.x) - self.r;
        room > 0.0 && self.path.stays_within(room, self.before)
    }

    /// The earliest of all candidates that hold, s from now, for the polynomial `height` of the height over the plane (m
    /// over sⁱ): faces first, since they bound the time for the quartics.
    fn everywhere(&self, height: [f64; 3]) -> Option<f64> {
        let now = touch(self.face, self.path.x, self.r);
        let closing = normal_velocity(self.path.v, DVec3::ZERO, now.normal);
        if now.gap <= 0.0 && closing < 0.0 && !self.grazes(0.0, &now, closing) {
            return Some(0.0);
        }
        if self.path.stays_within(now.gap, self.before) {
            return None;
        }
        let mut best = Best { time: self.before, found: None };
        for side in [1.0, -1.0] {
            let t = quadratic_fall([side * height[0] - self.r, side * height[1], side * height[2]]);
            best.take(t.filter(|&t| t < best.time).and_then(|t| self.verified(t)));
        }
        for t in self.entries(height, best.time) {
            best.take(self.verified(t));
        }
        if self.stays_over_face(best.time) {
            return best.found;
        }
        let (stays, count) = self.stays(height, best.time);
        for &[from, to] in &stays[..count] {
            self.outline(from, to, &mut best);
        }
        best.found
    }

    /// When the foot of the centre comes on to the face while the gap to its plane is 0 to rounding: where a sphere that
    /// has passed over the edge without an approach begins to sink into the face beyond it. Only times before `end`
    /// (s) matter.
    fn entries(&self, height: [f64; 3], end: f64) -> impl Iterator<Item = f64> {
        let Path { x, v, a } = *self.path;
        let foot = x - self.face.shape.center;
        let touches = move |t: f64| (value(&height, t).abs() - self.r).abs() <= self.rounding(t);
        let [d1, d2] = [self.face.dual1, self.face.dual2];
        let outwards = [d1, -d1, d2, -d2].into_iter().filter(move |out| foot.dot(*out) > 0.5);
        let enters = move |out: DVec3| quadratic_fall([foot.dot(out) - 0.5, v.dot(out), 0.5 * a.dot(out)]);
        outwards.filter_map(enters).filter(move |&t| t < end && touches(t))
    }

    /// Whether the foot of the centre certainly lies on the face until `end` (s): edges and corners are no nearer then.
    fn stays_over_face(&self, end: f64) -> bool {
        let Path { x, v, a } = *self.path;
        let foot = x - self.face.shape.center;
        let stays = |dual: DVec3| {
            let (v, a) = (v.dot(dual).abs(), a.dot(dual).abs());
            // for ever: 0 · ∞ is no way
            let way = if v + a > 0.0 { (v + 0.5 * a * end) * end } else { 0.0 };
            foot.dot(dual).abs() + way <= 0.5
        };
        stays(self.face.dual1) && stays(self.face.dual2)
    }

    /// The stretches [from, to] (s) before `end` (s) in which the centre is within reach of the plane, and their number:
    /// edges and corners need looking at only then.
    fn stays(&self, height: [f64; 3], end: f64) -> ([[f64; 2]; 3], usize) {
        // a little more than r, so that rounding at the rim of the slab excludes nothing
        let reach = self.r * (1.0 + 1e-9);
        let mut cuts = [end; 6];
        cuts[0] = 0.0;
        let mut count = 1;
        for level in [reach, -reach] {
            for &t in crate::roots::quadratic([height[0] - level, height[1], height[2]]).iter() {
                if t > 0.0 && t < end {
                    cuts[count] = t;
                    count += 1;
                }
            }
        }
        cuts[..count].sort_unstable_by(f64::total_cmp);
        let mut stays = [[0.0; 2]; 3];
        let mut found = 0;
        for k in 0..count {
            let (from, to) = (cuts[k], if k + 1 < count { cuts[k + 1] } else { end });
            let middle = if to.is_finite() { from + 0.5 * (to - from) } else { from + 1.0 };
            if value(&height, middle).abs() > reach || from >= to {
                continue;
            }
            if found > 0 && stays[found - 1][1] == from {
                stays[found - 1][1] = to;
            } else if found < 3 {
                stays[found] = [from, to];
                found += 1;
            }
        }
        (stays, found)
    }

    /// Offers `best` the contacts with edges and corners that the path comes near in [from, to], s.
    fn outline(&self, from: f64, to: f64, best: &mut Best) {
        let corners = self.face.shape.corners();
        let spans = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| self.path.reach(axis, from, to));
        let near = |a: DVec3, b: DVec3| {
            let (low, high) = (a.min(b) - DVec3::splat(self.r * 1.001), a.max(b) + DVec3::splat(self.r * 1.001));
            // NaN from an endless stay counts as near
            (0..3).all(|i| !(spans[i].1 < low[i] || spans[i].0 > high[i]))
        };
        for k in 0..4 {
            let (a, b) = (corners[k], corners[(k + 1) % 4]);
            if !near(a, b) {
                continue;
            }
            let along = edge_direction(self.face, k as u8);
            let across = |y: DVec3| y - along * along.dot(y);
            let path = self.path;
            let seen = Path { x: path.x - a, v: path.v, a: path.a };
            let line = Path { x: across(seen.x), v: across(seen.v), a: across(seen.a) };
            self.falls(&distance_polynomial(&line, self.r), best);
            if near(a, a) {
                self.falls(&distance_polynomial(&seen, self.r), best);
            }
        }
    }

    fn falls(&self, c: &[f64; 5], best: &mut Best) {
        let (falls, count) = quartic_falls(c, best.time);
        for &t in &falls[..count] {
            if t < best.time {
                best.take(self.verified(t));
            }
        }
    }

    /// The time (s) of a candidate `t` (s) that holds: the clamped closest point there is at distance r to rounding, and
    /// approached. Never by ranges of (u, v): at a seam both sides would refuse.
    fn verified(&self, t: f64) -> Option<f64> {
        let (mut t, mut at) = (t, touch(self.face, self.path.at(t), self.r));
        for _ in 0..2 {
            let closing = normal_velocity(self.path.velocity(t), DVec3::ZERO, at.normal);
            // Newton on the distance itself, whose rounding is far below that of the polynomial; only for a nudge
            let step = -at.gap / closing;
            if t == 0.0 || closing >= 0.0 || step.abs() > 1e-6 * t {
                break;
            }
            t += step;
            at = touch(self.face, self.path.at(t), self.r);
        }
        if at.gap > self.rounding(t) {
            return None;
        }
        self.approached(t, &at)
    }

    /// When a touch at `t` is approached: at once if v_n < 0. If v_n = 0 to rounding and about to become negative, which
    /// is rest and the apex of what overlaps, then too, but never while the handler's expression says that v_n > 0: the
    /// time that such a v_n takes to come back is waited for.
    fn approached(&self, t: f64, at: &Touch) -> Option<f64> {
        let v = self.path.velocity(t);
        let closing = normal_velocity(v, DVec3::ZERO, at.normal);
        if closing < 0.0 && self.grazes(t, at, closing) || closing > 1e-13 * (self.path.v.length() + v.length()) {
            return None;
        }
        self.closing_time(t, at, closing).map(|wait| t + wait)
    }

    /// How long after `t` (s) a touch with v_n = `closing` (m/s) has closed, s; none if it opens. What rounding of the
    /// polynomial says to touch may be apart by more than the closest point tells, beside an edge that carries the sphere
    /// meanwhile: pressed on this one, it would sink into that.
    fn closing_time(&self, t: f64, at: &Touch, closing: f64) -> Option<f64> {
        let touches = at.part == Part::Face || at.gap <= FOOT * self.rounding(t);
        if touches && closing < 0.0 {
            return Some(0.0);
        }
        let (gap, bends) = (if touches { 0.0 } else { at.gap }, self.bends(t, at));
        let square = closing * closing - 2.0 * bends * gap;
        if closing < 0.0 {
            return (square >= 0.0).then(|| 2.0 * gap / (square.sqrt() - closing));
        }
        (bends < 0.0).then(|| (closing + square.sqrt()) / -bends)
    }

    /// Rate at which v_n of a touch at `t` (s) grows, m/s². On a border it is the part ahead that counts: over an edge a fast
    /// sphere leaves what it was pressed against.
    fn bends(&self, t: f64, at: &Touch) -> f64 {
        let Path { v, a, .. } = *self.path;
        let path = Path { x: self.path.at(t), v: v + a * t, a };
        at.normal.dot(a) + curvature(self.face, part_ahead(self.face, &path, self.r), at.normal, path.v, self.r)
    }

    /// Whether a touch at `t` (s) that approaches at v_n = `closing` (m/s) only grazes.
    fn grazes(&self, t: f64, at: &Touch, closing: f64) -> bool {
        let (x, v, a) = (self.path.at(t), self.path.velocity(t), self.path.a);
        // no impulse has made an approach that is still to come; over the end of a wall, towards the edge of the next, its gap
        // is 0 to rounding, of all that it is found from, from √(2 r ulp) on, where v_n is not
        let ahead = t > 0.0 && at.part != Part::Face;
        let here = x.abs().max_element().max(self.r);
        let size = if ahead { here.max(self.path.x.abs().max_element()).max(self.face.size()) } else { here };
        let most = a.length() + v.length_squared() / self.r;
        let room = GRAZE * size + if ahead { at.gap.max(0.0) } else { 0.0 };
        if closing * closing > 2.0 * most * room {
            return false;
        }
        let bends = self.bends(t, at);
        let approach =
            ClosingMotion { closing, bends, speed: v.length(), acceleration: a.length(), radius: self.r, size };
        if ahead { approach.turns_within(room) } else { approach.grazes() }
    }

    /// What rounding may leave of a gap that is meant to be 0, m: some hundred ulp of the coordinates and the path.
    fn rounding(&self, t: f64) -> f64 {
        let Path { x, v, a } = *self.path;
        let shape = &self.face.shape;
        let size = x.length() + shape.center.length() + shape.s1.length() + shape.s2.length() + self.r;
        let way = (v.length() + 0.5 * a.length() * t) * t;
        256.0 * f64::EPSILON * (size + way)
    }
}

/// The earliest time found so far.
struct Best {
    /// Later times do not count, s from now.
    time: f64,
    /// The earliest time taken, s from now; none if none was.
    found: Option<f64>,
}

impl Best {
    fn take(&mut self, t: Option<f64>) {
        if let Some(t) = t.filter(|&t| t < self.time) {
            self.time = t;
            self.found = Some(t);
        }
    }
}
