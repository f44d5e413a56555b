//! When do bodies next touch? `contact_time` against an oracle that shares no code with it: fine sampling of the gap
//! with conservative steps, and a ternary search wherever the samples have a minimum.

use crate::random::Random;
use carom::geometry::Parallelogram;
use carom::physics::contact_time::{sphere_sphere, sphere_wall};
use carom::physics::path::Path;
use carom::physics::wall::Face;
use carom::physics::wall::{Part, touch};
use glam::DVec3;

/// Gap of a sphere and a parallelogram by the normal equations of min |q − u s1 − w s2|² over the box, then its edges.
fn wall_gap(wall: &Parallelogram, x: DVec3, r: f64) -> f64 {
    let (s1, s2) = (wall.s1, wall.s2);
    let q = x - (wall.center - 0.5 * s1 - 0.5 * s2);
    let (a, b, c) = (s1.dot(s1), s1.dot(s2), s2.dot(s2));
    let (d, e) = (q.dot(s1), q.dot(s2));
    let determinant = a * c - b * b;
    let (u, w) = ((d * c - e * b) / determinant, (a * e - b * d) / determinant);
    if (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&w) {
        return q.dot(s1.cross(s2).normalize()).abs() - r;
    }
    let on = |from: DVec3, side: DVec3| {
        let along = ((q - from).dot(side) / side.dot(side)).clamp(0.0, 1.0);
        (q - from - side * along).length()
    };
    on(DVec3::ZERO, s1).min(on(DVec3::ZERO, s2)).min(on(s1, s2)).min(on(s2, s1)) - r
}

struct Case<'a> {
    gap: &'a dyn Fn(f64) -> f64,
    /// Bound on the speed, m/s.
    speed: f64,
    /// What rounding may leave of a gap, m.
    rounding: f64,
    horizon: f64,
}

impl Case<'_> {
    /// The deepest gap met in [0, end], by samples no farther apart than the gap allows, refined at minima.
    fn deepest(&self, end: f64) -> (f64, f64) {
        let (mut best, mut at) = ((self.gap)(0.0), 0.0);
        let (mut before, mut last) = ([0.0, best], [0.0, best]);
        let mut t = 0.0;
        while t < end {
            let step = (last[1].abs() / self.speed * 0.999).max(self.horizon / 1024.0);
            t = (t + step).min(end);
            let next = [t, (self.gap)(t)];
            let lowest = if last[1] <= before[1] && last[1] <= next[1] { self.minimum(before[0], t) } else { next };
            for [time, gap] in [next, lowest] {
                if gap < best {
                    (best, at) = (gap, time);
                }
            }
            (before, last) = (last, next);
        }
        (best, at)
    }

    fn minimum(&self, from: f64, to: f64) -> [f64; 2] {
        let (mut low, mut high) = (from, to);
        for _ in 0..60 {
            let (one, two) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if (self.gap)(one) < (self.gap)(two) { high = two } else { low = one }
        }
        [low, (self.gap)(low)]
    }

    fn judge(&self, found: Option<f64>) -> Result<(), String> {
        let start = (self.gap)(0.0).min(0.0);
        let end = found.unwrap_or(self.horizon);
        let (deepest, at) = self.deepest(end);
        if deepest < start - self.rounding {
            return Err(format!(
                "found {found:?}, but the gap is already {deepest:e} at {at} (rounding {:e})",
                self.rounding
            ));
        }
        let Some(t) = found else { return Ok(()) };
        let gap = (self.gap)(t);
        if gap > self.rounding {
            return Err(format!("found {t}, where the gap is still {gap:e} (rounding {:e})", self.rounding));
        }
        // approaching: an instant later it is not shallower by more than rounding can explain
        let later = (self.gap)(t + 1e-8 * self.horizon);
        if later > gap + self.rounding {
            return Err(format!("found {t} with gap {gap:e}, but it opens to {later:e}"));
        }
        Ok(())
    }
}

/// A path that comes to `target` (relative to nothing) at a random time: wild speeds, a quarter without acceleration.
fn path_to(random: &mut Random, target: DVec3, size: f64, horizon: f64) -> Path {
    let v = random.vector() * (size / horizon) * random.decade(-2.0, 2.0);
    let a = if random.unit() < 0.25 {
        DVec3::ZERO
    } else {
        random.vector() * (size / (horizon * horizon)) * random.decade(-2.0, 2.0)
    };
    let t = random.between(0.0, 1.2) * horizon;
    Path { x: target - v * t - a * (0.5 * t * t), v, a }
}

fn check_wall(seed: u64, met: &mut [u32; 4]) -> Result<(), String> {
    let random = &mut Random::new(seed.wrapping_mul(0x2545_f491_4f6c_dd1d));
    let size = random.decade(-3.0, 3.0);
    let horizon = random.decade(-2.0, 2.0);
    let center = random.vector() * size * random.decade(-1.0, 2.0);
    let s1 = random.vector().normalize_or(DVec3::X) * size;
    let s2 =
        (random.vector().normalize_or(DVec3::Y) + s1.any_orthonormal_vector() * 0.5) * size * random.decade(-1.5, 1.5);
    if s1.cross(s2).length() < 1e-3 * s1.length() * s2.length() {
        return Ok(());
    }
    let wall = Parallelogram { center, s1, s2 };
    let face = Face::new(wall);
    let r = size * random.decade(-2.0, 0.5);
    let side = if random.unit() < 0.5 { 1.0 } else { -1.0 };
    let foot = center + s1 * random.between(-0.7, 0.7) + s2 * random.between(-0.7, 0.7);
    let target = foot + face.normal * (side * r * random.between(0.2, 1.0));
    let mut path = path_to(random, target, size, horizon);
    if random.unit() < 0.1 {
        // start in touch, a rounding deep: what every impact leaves
        let near = touch(&face, path.x, r);
        path.x -= near.normal * near.gap;
    } else if wall_gap(&wall, path.x, r) < 0.0 {
        return Ok(());
    }
    let speed = path.v.length() + path.a.length() * horizon;
    let way = speed * horizon;
    let scale = path.x.length() + center.length() + s1.length() + s2.length() + r + way;
    let case = Case {
        gap: &|t| wall_gap(&wall, path.x + path.v * t + path.a * (0.5 * t * t), r),
        speed,
        // the oracle's own rounding: coordinates of this size, a skewed parallelogram amplifies it
        rounding: 1e-12 * scale,
        horizon,
    };
    let found = sphere_wall(&path, r, &face, horizon);
    let part = found.map(|t| touch(&face, path.at(t), r).part);
    met[part.map_or(0, |part| match part {
        Part::Face => 1,
        Part::Edge(_) => 2,
        Part::Corner(_) => 3,
    })] += 1;
    case.judge(found).map_err(|e| format!("seed {seed}: {e}\n{path:?} r {r} {wall:?}"))
}

fn check_pair(seed: u64, met: &mut [u32; 2]) -> Result<(), String> {
    let random = &mut Random::new(seed.wrapping_mul(0x9e6c_63d0_a5b4_7a1d));
    let size = random.decade(-3.0, 3.0);
    let horizon = random.decade(-2.0, 2.0);
    let reach = size * random.decade(-2.0, 0.5);
    let target = random.vector() * reach;
    let mut path = path_to(random, target, size, horizon);
    if random.unit() < 0.1 {
        path.x *= reach / path.x.length();
    } else if path.x.length() < reach {
        return Ok(());
    }
    let speed = path.v.length() + path.a.length() * horizon;
    let case = Case {
        gap: &|t| (path.x + path.v * t + path.a * (0.5 * t * t)).length() - reach,
        speed,
        rounding: 1e-12 * (path.x.length() + reach + speed * horizon),
        horizon,
    };
    let found = sphere_sphere(&path, reach, horizon).filter(|&t| t < horizon);
    met[usize::from(found.is_some())] += 1;
    case.judge(found).map_err(|e| format!("seed {seed}: {e}\n{path:?} reach {reach}"))
}

#[test]
fn spheres_meet_faces_edges_and_corners_when_sampling_says_so() {
    let mut met = [0; 4];
    let wrong: Vec<_> = (0..140_000).filter_map(|seed| check_wall(seed, &mut met).err()).collect();
    assert!(wrong.is_empty(), "{} wrong, e.g.\n{}", wrong.len(), wrong[..wrong.len().min(3)].join("\n"));
    // none, face, edge, corner: a generator that never reached one would test nothing
    assert!(met.iter().all(|&n| n > 1000), "{met:?}");
}

#[test]
fn spheres_meet_each_other_when_sampling_says_so() {
    let mut met = [0; 2];
    let wrong: Vec<_> = (0..60_000).filter_map(|seed| check_pair(seed, &mut met).err()).collect();
    assert!(wrong.is_empty(), "{} wrong, e.g.\n{}", wrong.len(), wrong[..wrong.len().min(3)].join("\n"));
    assert!(met.iter().all(|&n| n > 1000), "{met:?}");
}

/// What falls from rest across an edge, sliding along it or not, has a polynomial without odd powers.
#[test]
fn a_fall_from_rest_onto_an_edge_is_found() {
    for seed in 0..20_000_u64 {
        let mut random = Random::new(seed);
        let (r, g) = (random.between(0.05, 0.5), 9.8);
        let center = random.vector() * 5.0;
        let (high, deep) = (random.between(0.05, 0.5), random.between(0.5, 2.0));
        let plate = Parallelogram { center, s1: DVec3::Y * high, s2: DVec3::Z * deep };
        let aside = random.between(-0.99, 0.99) * r;
        let above = random.between(1.0, 3.0) * r + (r * r - aside * aside).sqrt();
        let top = center + DVec3::Y * (0.5 * high);
        let fall = (2.0 * (above - (r * r - aside * aside).sqrt()) / g).sqrt();
        let z = random.between(-0.4, 0.4) * deep;
        let speed = random.pick(&[0.0, 1.0]) * random.between(-0.05, 0.05) * deep / fall;
        let x = top + DVec3::new(aside, above, z);
        let path = Path { x, v: DVec3::Z * speed, a: DVec3::NEG_Y * g };
        let before = random.pick(&[f64::INFINITY, 10.0, 1.001 * fall]);
        let found = sphere_wall(&path, r, &Face::new(plate), before);
        assert!(found.is_some_and(|t| (t - fall).abs() <= 1e-9 * fall), "seed {seed}: {found:?} instead of {fall}");
    }
}

/// A sphere slides over the edge of the wall that it touches; the next wall begins at that edge and leads down. Its gap comes
/// to 0 there and nowhere else, so that nothing approaches, however rounding places the edge.
#[test]
fn a_slide_over_the_edge_where_the_next_wall_leads_down_is_no_approach() {
    for seed in 0..20_000_u64 {
        let mut random = Random::new(seed);
        let along = random.vector().normalize();
        let across = along.any_orthonormal_vector();
        let up = across.cross(along);
        let (r, edge) = (random.between(0.05, 0.6), random.vector() * 5.0);
        let (long, slope) = (random.between(1.0, 8.0), random.between(0.01, 3.1));
        let down = across * slope.cos() - up * slope.sin();
        let s2 = down * random.between(0.1, 5.0);
        let next = Parallelogram { center: edge + s2 * 0.5, s1: along * long, s2 };
        let (speed, sideways) = (random.decade(-1.0, 1.0), random.between(-0.5, 0.5));
        let way = random.between(0.01, 1.0);
        let x = edge + up * r - (across + along * sideways) * way;
        let path = Path { x, v: (across + along * sideways) * speed, a: DVec3::ZERO };
        let found = sphere_wall(&path, r, &Face::new(next), f64::INFINITY);
        assert_eq!(found, None, "seed {seed}: the edge is reached at {}", way / speed);
    }
}

#[test]
fn small_spheres_that_come_from_afar_touch_to_rounding_when_they_meet() {
    let mut random = Random::new(7);
    for _ in 0..10_000 {
        let reach = random.decade(-9.0, -2.0);
        let (from, speed) = (random.vector().normalize() * random.between(1.0, 10.0), random.decade(-3.0, 3.0));
        let aside = random.vector().cross(from).normalize() * reach * random.between(0.0, 0.99);
        let path = Path { x: from + aside, v: from * -speed, a: DVec3::ZERO };
        let t = sphere_sphere(&path, reach, f64::INFINITY).expect("they meet: aside by less than their radii");
        // Beside the centre the gap grows with the tangent of the angle under which they meet: at 0.99 it is 7.
        let gap = path.at(t).length() - reach;
        assert!(
            gap.abs() <= 64.0 * f64::EPSILON * path.x.length(),
            "gap {gap} m of {reach} m from {} m",
            path.x.length()
        );
    }
}
