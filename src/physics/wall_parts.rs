//! Which part of a wall is closest: its face, an edge or a corner, for how long, and which comes next.
//!
//! The parts share the plane among them: over the face, the face; between the normals of an edge's ends, outside it, the
//! edge; the rest belongs to the corners. All borders are planes perpendicular to the wall.

use glam::DVec3;

use super::path::Path;
use super::wall::{Face, Part};
use crate::roots::quadratic_fall;

/// A plane beyond which another part takes over: `normal`·(x − `at`) is the room left, m.
#[derive(Clone, Copy)]
struct Border {
    /// A point of the plane, m.
    at: DVec3,
    /// Unit vector into the part.
    inward: DVec3,
}

/// The corners of a wall, and the unit vectors along its edges and outwards from them.
struct Sides {
    corners: [DVec3; 4],
    along: [DVec3; 4],
    outward: [DVec3; 4],
}

impl Sides {
    fn of(face: &Face) -> Sides {
        let corners = face.shape.corners();
        let along = [0, 1, 2, 3].map(|k: usize| {
            let side = corners[(k + 1) % 4] - corners[k];
            side / side.length()
        });
        Sides { corners, along, outward: outward(face) }
    }

    /// The borders of a part: four of a face, three of an edge, two of a corner.
    fn borders(&self, part: Part) -> ([Border; 4], usize) {
        let Sides { corners, along, outward } = self;
        let border = |at: usize, inward: DVec3| Border { at: corners[at % 4], inward };
        match part {
            Part::Face => ([0, 1, 2, 3].map(|k| border(k, -outward[k])), 4),
            Part::Edge(k) => {
                let k = k as usize;
                let from = border(k, along[k]);
                ([from, border(k + 1, -along[k]), border(k, outward[k]), from], 3)
            }
            Part::Corner(k) => {
                let k = k as usize;
                let from = border(k, -along[k]);
                ([from, border(k, along[(k + 3) % 4]), from, from], 2)
            }
        }
    }

    /// The part that the point closest to `x` is farthest inside, and how far, m.
    fn widest(&self, x: DVec3) -> (Part, f64) {
        let mut best = (Part::Face, self.room(Part::Face, x));
        for part in (0..4).map(Part::Edge).chain((0..4).map(Part::Corner)) {
            let room = self.room(part, x);
            if room > best.1 {
                best = (part, room);
            }
        }
        best
    }

    /// How far the point closest to `x` is inside a part, m.
    fn room(&self, part: Part, x: DVec3) -> f64 {
        let (borders, count) = self.borders(part);
        borders[..count].iter().map(|border| border.inward.dot(x - border.at)).fold(f64::INFINITY, f64::min)
    }
}

/// Whether the point closest to `x` is inside the face by more than `least` (m), by what [`room`] says of it: no other part
/// has room then.
fn is_inside(face: &Face, x: DVec3, least: f64) -> bool {
    let corners = face.shape.corners();
    outward(face).iter().zip(corners).all(|(outward, corner)| -outward.dot(x - corner) > least)
}

/// The unit vectors outwards from the edges of a wall, in its plane.
fn outward(face: &Face) -> [DVec3; 4] {
    let [one, two] = face.outward;
    [-two, one, two, -one]
}

/// How far the point closest to `x` is inside a part of a wall, m: the least distance to where another part takes over;
/// negative beyond.
pub(crate) fn room(face: &Face, part: Part, x: DVec3) -> f64 {
    Sides::of(face).room(part, x)
}

/// How far beyond a border at which it begins a contact belongs to the next part, in radii or coordinates, whichever are
/// larger: more than rounding, so that a sphere that slides along a border does not change its part for ever, and less
/// than matters, since the distances to two parts differ by half its square.
pub(crate) const BORDER: f64 = 1e-12;

/// When a sphere of radius `r` (m) on `path`, in touch with `part` of a wall, comes to where another part takes over, s
/// from now: the first time at which it is on the border and moving outwards; if it begins there, or beyond, the first time
/// at which it is [`BORDER`] beyond. Only times below `before` (s) matter.
pub(crate) fn part_end(face: &Face, part: Part, path: &Path, r: f64, before: f64) -> Option<f64> {
    let least = BORDER * path.x.abs().max_element().max(r);
    let end = |border: &Border| {
        let (n, room) = (border.inward, border.inward.dot(path.x - border.at));
        let room = if room > least { room } else { room + least };
        quadratic_fall([room, n.dot(path.v), 0.5 * n.dot(path.a)])
    };
    let (borders, count) = Sides::of(face).borders(part);
    borders[..count].iter().filter_map(end).filter(|&t| t < before).reduce(f64::min)
}

/// The part of a wall that is closest to a sphere of radius `r` (m) just from now on, on this path: where it is within half a
/// [`BORDER`] of a border, the part that the motion leads to. Decided by the borders alone: near a corner the distances to
/// the corner and to the edge beside it differ by less than rounding.
pub(crate) fn part_ahead(face: &Face, path: &Path, r: f64) -> Part {
    let border = BORDER * path.x.abs().max_element().max(r);
    part_within(face, path, 0.5 * border, border)
}

/// The part of a wall that a sphere of radius `r` (m) on this path comes to, which is at a border up to what is `told`, m.
pub(crate) fn part_beyond(face: &Face, path: &Path, r: f64, told: f64) -> Part {
    let border = BORDER * path.x.abs().max_element().max(r);
    part_within(face, path, told.max(0.5 * border), (2.0 * told).max(border))
}

/// The part whose point is closest, if that is inside it by more than `near` (m); else the part to which `ahead` m more on
/// the path lead: beyond the border by no more than where [`part_end`] ends the part.
fn part_within(face: &Face, path: &Path, near: f64, ahead: f64) -> Part {
    if is_inside(face, path.x, near) {
        return Part::Face;
    }
    let sides = Sides::of(face);
    let here = sides.widest(path.x);
    if here.1 > near {
        return here.0;
    }
    let (speed, pull) = (path.v.length(), path.a.length());
    // |v| t + |a| t²/2 = ahead: a velocity that is nothing but rounding leads nowhere
    let whole = speed + (speed * speed + 2.0 * pull * ahead).sqrt();
    if whole > 0.0 { sides.widest(path.at(2.0 * ahead / whole)).0 } else { here.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Parallelogram;
    use crate::physics::wall::touch;

    fn skewed() -> Face {
        Face::new(Parallelogram {
            center: DVec3::new(1.0, 2.0, 3.0),
            s1: DVec3::new(4.0, 0.0, 1.0),
            s2: DVec3::new(2.5, 2.0, 0.0),
        })
    }

    /// Every part, each once.
    fn parts() -> impl Iterator<Item = Part> {
        std::iter::once(Part::Face).chain((0..4).map(Part::Edge)).chain((0..4).map(Part::Corner))
    }

    /// Points of a grid around the wall.
    fn grid() -> impl Iterator<Item = DVec3> {
        let face = skewed();
        (0..15_625).map(move |i| {
            let at = |shift: i32| f64::from(i / shift % 25) - 12.0;
            face.shape.center + DVec3::new(at(1), at(25), at(625)) * 0.317
        })
    }

    #[test]
    fn the_closest_part_is_the_one_with_room() {
        let face = skewed();
        for x in grid() {
            let closest = touch(&face, x, 0.5).part;
            for part in parts() {
                let room = room(&face, part, x);
                // No grid point lies within rounding of a border.
                assert_eq!(room > 0.0, part == closest, "{x}: {closest:?}, but {part:?} has room {room}");
            }
        }
    }

    #[test]
    fn beside_a_corner_the_edge_is_closest_however_near_the_corner() {
        // their distances differ by 1e-17 m of 0.5 m, which rounding does not tell; their normals by 7e-9 rad
        let square = Parallelogram { center: DVec3::new(-0.5, 0.0, 0.0), s1: DVec3::X, s2: DVec3::Z * 8.0 };
        for beside in [-3.6e-9, -1e-12, -1e-15] {
            let at = touch(&Face::new(square), DVec3::new(beside, 0.45, 4.2), 0.5);
            assert!(matches!(at.part, Part::Edge(_)), "{beside}: {at:?}");
            assert_eq!(at.normal.x, 0.0, "{beside}: {at:?}");
        }
        let beyond = touch(&Face::new(square), DVec3::new(1e-15, 0.45, 4.2), 0.5);
        assert!(matches!(beyond.part, Part::Corner(_)), "{beyond:?}");
    }

    #[test]
    fn beside_a_sharp_corner_the_edge_beyond_which_the_centre_is_counts() {
        // the foot on the other edge is as far to rounding, and some 1e-9 m off
        let sharp = Parallelogram { center: DVec3::ZERO, s1: DVec3::X * 2.0, s2: DVec3::new(1.5, 0.0, 1.0) };
        let corner = sharp.corners()[0];
        for (along, beyond) in [(2e-9, 1e-9), (4e-9, 1e-12), (1e-9, 3e-9)] {
            let at = touch(&Face::new(sharp), corner + DVec3::new(along, 0.3, -beyond), 0.3);
            assert_eq!(at.part, Part::Edge(0), "{along} {beyond}");
            assert!((at.point - corner).distance(DVec3::X * along) < 1e-15, "{along} {beyond}: {at:?}");
        }
    }

    #[test]
    fn a_wall_is_said_to_be_farther_only_where_it_is() {
        let face = skewed();
        let mut said = 0;
        for x in grid() {
            let distance = face.shape.distance(x);
            assert!(!face.is_farther(x, distance), "{x}: {distance}");
            said += u32::from(face.is_farther(x, 0.5 * distance));
        }
        assert!(said > 5_000, "{said} of 15 625 points");
    }

    #[test]
    fn a_part_ends_where_the_room_does_and_the_next_one_begins() {
        let face = skewed();
        let mut ends = 0;
        for x in grid().step_by(7) {
            let path = Path { x, v: (face.shape.center - x) * 0.5 + DVec3::new(0.3, -0.2, 0.7), a: DVec3::NEG_Y };
            let part = touch(&face, x, 0.5).part;
            let Some(t) = part_end(&face, part, &path, 0.5, 10.0) else { continue };
            ends += 1;
            // Coordinates of some tens of metres.
            assert!(room(&face, part, path.at(t)).abs() < 1e-12);
            let next = part_ahead(&face, &Path { x: path.at(t), v: path.velocity(t), a: path.a }, 0.5);
            assert_ne!(next, part, "{x}: after {t} s");
            assert!(room(&face, next, path.at(t + 1e-7)) > 0.0, "{x}: {next:?}");
        }
        assert!(ends > 1000, "{ends} ends");
    }

    #[test]
    fn a_part_ends_later_than_it_begins_wherever_it_begins() {
        // on and beside the border at x = 1, moving to and from it at speeds from rounding up, pulled as slowly
        let square = Parallelogram { center: DVec3::ZERO, s1: DVec3::X * 2.0, s2: DVec3::Z * 2.0 };
        let (face, sizes) = (Face::new(square), [0.0, 1e-90, 1e-20, 1e-12, 1e-9, 1e-6, 1.0]);
        let signed = || sizes.into_iter().flat_map(|size| [size, -size]);
        for place in [0.0, 2e-16, 1e-13, 6e-13, 2e-12, 3e-10, 1e-9].into_iter().flat_map(|size| [size, -size]) {
            for (v, a) in signed().flat_map(|v| signed().map(move |a| (v, a))) {
                let path = Path { x: DVec3::new(1.0 + place, 0.5, 0.0), v: DVec3::X * v, a: DVec3::X * a };
                let part = part_ahead(&face, &path, 0.5);
                let end = part_end(&face, part, &path, 0.5, f64::INFINITY);
                assert!(end.is_none_or(|end| end > 0.0), "{path:?}: {part:?} ends at {end:?}");
                // farther from the border than it counts as one, the part is the one that is closest
                if place.abs() > 1e-12 {
                    assert_eq!(part, touch(&face, path.x, 0.5).part, "{path:?}");
                }
            }
        }
    }

    #[test]
    fn a_border_crossed_inwards_is_no_end() {
        let face = skewed();
        let on_border = face.shape.corners()[1] * 0.5 + face.shape.corners()[2] * 0.5;
        let path = Path { x: on_border + face.normal * 0.5, v: face.shape.center - on_border, a: DVec3::ZERO };
        let t = part_end(&face, Part::Face, &path, 0.5, 100.0).expect("it leaves on the other side");
        assert!((t - 2.0).abs() < 1e-14, "{t}");
        assert_eq!(part_ahead(&face, &path, 0.5), Part::Face);
        assert_eq!(part_ahead(&face, &Path { v: -path.v, ..path }, 0.5), Part::Edge(1));
    }
}
