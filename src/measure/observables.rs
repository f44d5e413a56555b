//! What a crowd is seen to do, followed in the order of time: figures that a run and a file of states both give.

use glam::DVec3;

use crate::export::FIGURES;
use crate::geometry::Parallelogram;
use crate::scene::Scene;

/// The figures of one run, in the order of [`FIGURES`]; none where there is no such figure.
pub type Figures = [Option<f64>; FIGURES.len()];

/// Parts of the run after which energy is read, in the order of [`FIGURES`].
const MARKS: [f64; 5] = [0.05, 0.1, 0.25, 0.5, 1.0];

/// Part of the run, at its end, over which the load on the walls is taken.
pub(super) const WINDOW: f64 = 0.2;

/// What lies apart by less than this part of its reach counts as a contact.
const TOUCHES: f64 = 1e-3;

/// Settled is a crowd whose kinetic energy stays below this part of the largest.
const SETTLED: f64 = 1e-3;

/// Parts of the run of which kinetic energy is kept; a row within half of one stands for a mark.
pub(super) const INSTANTS: usize = 200;

/// Part of the run that is rounding between times that mean the same.
const SAME: f64 = 1e-9;

/// What the contacts of a run tell, and no file of states.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Told {
    /// The impulses of walls against the weight over the window, as a part of what the weight gives; none without a weight.
    pub(super) forces: Option<f64>,
    /// Largest force that pulls, N; none where nothing rests.
    pub(super) pull: Option<f64>,
    /// Largest |gap × force|, J.
    pub(super) product: Option<f64>,
}

/// A crowd that is followed.
#[derive(Debug, Clone)]
pub struct Observables {
    masses: Vec<f64>,
    radii: Vec<f64>,
    pulls: Vec<DVec3>,
    walls: Vec<Parallelogram>,
    /// The length of the run, s.
    until: f64,
    /// By mark, the last time up to it, s, and the energy then, J.
    energies: [Option<(f64, f64)>; MARKS.len()],
    /// The largest kinetic energy of each part of the run, J; below 0 where there was none.
    kinetic: Vec<f64>,
    /// Time (s) and momentum against the pulls (N s) as the window begins and at the last time.
    momenta: Option<[(f64, f64); 2]>,
    /// The last time, s, and places then, m.
    last: f64,
    places: Vec<DVec3>,
}

impl Observables {
    /// A crowd as its scene begins, to be followed up to `until` (s).
    pub fn new(scene: &Scene, until: f64) -> Observables {
        Observables {
            masses: scene.spheres.iter().map(|sphere| sphere.mass).collect(),
            radii: scene.spheres.iter().map(|sphere| sphere.radius).collect(),
            pulls: scene.spheres.iter().map(|sphere| scene.gravity + sphere.force / sphere.mass).collect(),
            walls: scene.walls.iter().map(|wall| wall.shape).collect(),
            until,
            energies: [None; MARKS.len()],
            kinetic: vec![-1.0; INSTANTS + 1],
            momenta: None,
            last: f64::NEG_INFINITY,
            places: Vec::new(),
        }
    }

    /// Σ of all constant forces, N.
    pub(super) fn weight(&self) -> DVec3 {
        self.pulls.iter().zip(&self.masses).map(|(pull, mass)| *pull * *mass).sum()
    }

    /// Unit vector against the weight; y where there is none.
    pub(super) fn up(&self) -> DVec3 {
        let weight = self.weight();
        if weight == DVec3::ZERO { DVec3::Y } else { -weight.normalize() }
    }

    /// Enters centres (m) and velocities (m/s) at a time (s) not before the last; no velocities, where they are not known.
    pub fn enter(&mut self, time: f64, x: &[DVec3], v: &[DVec3]) {
        let rounding = SAME * self.until;
        if time > self.until + rounding {
            return;
        }
        self.last = time;
        self.places.clear();
        self.places.extend_from_slice(x);
        if v.is_empty() {
            return;
        }
        let moving: f64 = v.iter().zip(&self.masses).map(|(v, mass)| 0.5 * mass * v.length_squared()).sum();
        let depth: f64 = x.iter().zip(&self.masses).zip(&self.pulls).map(|((x, mass), pull)| mass * pull.dot(*x)).sum();
        for (mark, energy) in MARKS.iter().zip(&mut self.energies) {
            if time <= mark * self.until + rounding {
                *energy = Some((time, moving - depth));
            }
        }
        let part =
            ((time / self.until * INSTANTS as f64 - SAME * INSTANTS as f64).ceil().max(0.0) as usize).min(INSTANTS);
        self.kinetic[part] = self.kinetic[part].max(moving);
        if time >= self.until * (1.0 - WINDOW) - rounding {
            let up = self.up();
            let momentum = v.iter().zip(&self.masses).map(|(v, mass)| v.dot(up) * mass).sum();
            let begin = self.momenta.map_or((time, momentum), |momenta| momenta[0]);
            self.momenta = Some([begin, (time, momentum)]);
        }
    }

    /// Whether the crowd was followed to the end of the run, but for half a part of it.
    fn is_whole(&self) -> bool {
        self.until - self.last <= 0.5 * self.until / INSTANTS as f64
    }

    /// The load on the walls over the weight, as it follows from what the crowd's momentum has gained over the window.
    fn load(&self) -> Option<f64> {
        let [(from, before), (to, after)] = self.momenta?;
        let (weight, length) = (self.weight().length(), to - from);
        let long = length >= 0.9 * WINDOW * self.until;
        (long && weight > 0.0).then(|| 1.0 + (after - before) / (length * weight))
    }

    /// The figures at the end.
    pub fn figures(&self) -> Figures {
        self.figures_with(Told::default())
    }

    /// The figures at the end, those that only contacts tell included.
    pub(super) fn figures_with(&self, Told { forces, pull, product }: Told) -> Figures {
        let near = |k: usize| {
            let (time, energy) = self.energies[k]?;
            (MARKS[k] * self.until - time <= 0.5 * self.until / INSTANTS as f64).then_some(energy)
        };
        let energy = [0, 1, 2, 3, 4].map(near);
        if !self.is_whole() {
            let mut figures = [None; FIGURES.len()];
            figures[..MARKS.len()].copy_from_slice(&energy);
            return figures;
        }
        let up = self.up();
        let mut heights: Vec<f64> = self.places.iter().map(|x| x.dot(up)).collect();
        heights.sort_by(f64::total_cmp);
        let height = |part: f64| heights.get((part * heights.len() as f64) as usize).copied();
        let Contacts { count, overlap } = self.contacts();
        let [twentieth, tenth, quarter, half, end] = energy;
        let [low, median, high] = [0.1, 0.5, 0.9].map(height);
        let (packing, settled) = (Some(self.packing()), self.settled());
        let (contacts, overlap, load) = (Some(count), Some(overlap), self.load());
        [
            twentieth, tenth, quarter, half, end, load, forces, contacts, packing, low, median, high, settled, overlap,
            pull, product,
        ]
    }

    /// Time from which on the kinetic energy stays small, s.
    fn settled(&self) -> Option<f64> {
        let most = self.kinetic.iter().copied().fold(0.0, f64::max);
        let moves = self.kinetic.iter().rposition(|energy| *energy > SETTLED * most)?;
        (moves + 1 < self.kinetic.len()).then(|| (moves + 1) as f64 * self.until / INSTANTS as f64)
    }

    /// The contacts at the last time.
    fn contacts(&self) -> Contacts {
        let (n, x) = (self.places.len(), &self.places);
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&a, &b| x[a].x.total_cmp(&x[b].x));
        let widest = self.radii.iter().copied().fold(0.0, f64::max);
        let (mut count, mut overlap) = (0_usize, 0.0_f64);
        for (place, &a) in order.iter().enumerate() {
            let near = x[a].x + (self.radii[a] + widest) * (1.0 + TOUCHES);
            for &b in order[place + 1..].iter().take_while(|&&b| x[b].x <= near) {
                let (reach, distance) = (self.radii[a] + self.radii[b], x[a].distance(x[b]));
                count += 2 * usize::from(distance <= reach * (1.0 + TOUCHES));
                overlap = overlap.max(reach - distance);
            }
            for wall in &self.walls {
                let distance = wall.distance(x[a]);
                count += usize::from(distance <= self.radii[a] * (1.0 + TOUCHES));
                overlap = overlap.max(self.radii[a] - distance);
            }
        }
        Contacts { count: count as f64 / n.max(1) as f64, overlap }
    }

    /// The spheres' volume over that of the box around them.
    fn packing(&self) -> f64 {
        let around = |sign: f64| {
            let edge = |(x, r): (&DVec3, &f64)| *x * sign + DVec3::splat(*r);
            self.places.iter().zip(&self.radii).map(edge).fold(DVec3::NEG_INFINITY, DVec3::max)
        };
        let size = around(1.0) + around(-1.0);
        let volume: f64 = self.radii.iter().map(|r| 4.0 / 3.0 * std::f64::consts::PI * r * r * r).sum();
        volume / (size.x * size.y * size.z)
    }
}

/// Contacts at one time.
struct Contacts {
    /// Mean number of bodies that touch a sphere.
    count: f64,
    /// The deepest overlap, m.
    overlap: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    fn figure(figures: &Figures, name: &str) -> Option<f64> {
        figures[FIGURES.iter().position(|figure| figure.0 == name).expect("a figure")]
    }

    #[test]
    fn a_ball_in_flight_loads_no_wall_and_one_that_lies_loads_the_floor_with_its_weight() {
        let scene = scene::open("paper-0").expect("built in").scene;
        let ball = &scene.spheres[0];
        let follow = |v: &dyn Fn(f64) -> f64, y: &dyn Fn(f64) -> f64| {
            let mut seen = Observables::new(&scene, 2.0);
            for k in 0..=400 {
                let t = f64::from(k) * 0.005;
                seen.enter(t, &[DVec3::new(ball.x.x, y(t), ball.x.z)], &[DVec3::Y * v(t)]);
            }
            seen.figures()
        };
        let g = -scene.gravity.y;
        let flies = follow(&|t| -g * t, &|t| 9.0 - 0.5 * g * t * t);
        assert!(figure(&flies, "load on walls / weight").is_some_and(|load| load.abs() < 1e-12), "{flies:?}");
        let lies = follow(&|_| 0.0, &|_| ball.radius);
        assert_eq!(figure(&lies, "load on walls / weight"), Some(1.0));
        // The ball of this scene is beside a wall from the start.
        assert_eq!((figure(&lies, "contacts of a sphere"), figure(&lies, "overlap at rest")), (Some(2.0), Some(0.0)));
        // ½ m g² t² − m g (½ g t²) + m g 9: what it had, at every mark.
        let ends = [figure(&flies, "energy at a tenth"), figure(&flies, "energy at the end")];
        assert!(ends.iter().all(|energy| energy.is_some_and(|energy| (energy - 9.0 * g * ball.mass).abs() < 1e-9)));
    }

    #[test]
    fn a_crowd_that_stops_half_way_has_the_figures_up_to_there() {
        let scene = scene::open("paper-0").expect("built in").scene;
        let mut seen = Observables::new(&scene, 2.0);
        (0..=100).for_each(|k| seen.enter(f64::from(k) * 0.01, &[DVec3::Y], &[DVec3::X]));
        let figures = seen.figures();
        assert!(figure(&figures, "energy at half").is_some() && figure(&figures, "energy at the end").is_none());
        assert_eq!(figures[5..], [None; FIGURES.len() - 5]);
    }

    #[test]
    fn settled_is_what_stays_slow() {
        let scene = scene::open("paper-0").expect("built in").scene;
        let mut seen = Observables::new(&scene, 2.0);
        for k in 0..=200 {
            let speed = if k < 100 { 5.0 } else { 0.1 };
            seen.enter(f64::from(k) * 0.01, &[DVec3::Y], &[DVec3::X * speed]);
        }
        assert_eq!(figure(&seen.figures(), "settled after"), Some(1.0));
    }
}
