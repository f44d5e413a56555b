//! What holds resting spheres up, against statics by hand.
//!
//! g = 9.8 m/s² downwards, radius 0.5 m throughout. Oracles are closed forms, the complementarity conditions
//! themselves, and energy.

use carom::physics::support::{Bodies, Fate, Held, Resting, Row, Solver, Surface, hold, islands, solve};
use carom::random::SplitMix64;
use glam::DVec3;

const G: DVec3 = DVec3::new(0.0, -9.8, 0.0);

/// Ten ulp of a number around 10: a handful of products and sums of that size.
const ROUNDING: f64 = 1e-14;

/// Spheres and their contacts, held under gravity.
struct Pile {
    masses: Vec<f64>,
    velocity: Vec<DVec3>,
    applied: Vec<DVec3>,
    contacts: Vec<Resting>,
}

impl Pile {
    /// Spheres of these masses at rest, touching nothing.
    fn of(masses: &[f64]) -> Pile {
        let count = masses.len();
        let (velocity, applied) = (vec![DVec3::ZERO; count], vec![G; count]);
        Pile { masses: masses.to_vec(), velocity, applied, contacts: Vec::new() }
    }

    fn on_face(mut self, a: usize, normal: DVec3) -> Pile {
        self.contacts.push(Resting { a, b: None, normal, surface: Surface::Face });
        self
    }

    fn on_sphere(mut self, a: usize, b: usize, normal: DVec3) -> Pile {
        self.contacts.push(Resting { a, b: Some(b), normal, surface: Surface::Round { radius: 1.0 } });
        self
    }

    fn moving(mut self, body: usize, velocity: DVec3) -> Pile {
        self.velocity[body] = velocity;
        self
    }

    fn hold(&self) -> Held {
        let inverse_mass: Vec<f64> = self.masses.iter().map(|m| 1.0 / m).collect();
        let (velocity, applied) = (&self.velocity[..], &self.applied[..]);
        let held = hold(Bodies { inverse_mass: &inverse_mass, velocity, applied }, &self.contacts, &[]);
        assert!(held.converged(), "{:?} {:?}", held.velocity.reports, held.acceleration.reports);
        held
    }
}

/// Face normal of a slope of this rise over a run of `run`, leaning towards +x.
fn slope(rise: f64, run: f64) -> DVec3 {
    DVec3::new(rise, run, 0.0).normalize()
}

/// A column on the floor, sphere 0 lowest.
fn column(masses: &[f64]) -> Pile {
    let pile = Pile::of(masses).on_face(0, DVec3::Y);
    (1..masses.len()).fold(pile, |pile, above| pile.on_sphere(above, above - 1, DVec3::Y))
}

/// Square layers of 4 × 4, 3 × 3, 2 × 2, 1 touching spheres on a floor, the lowest between four walls.
fn pyramid(top_mass: f64) -> Pile {
    let mut centers = Vec::new();
    for layer in 0..4_u8 {
        let (side, height) = (4 - layer, f64::from(layer) * 0.5_f64.sqrt());
        for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
            let at = |k: u8| f64::from(k) - f64::from(side - 1) * 0.5;
            centers.push(DVec3::new(at(i), 0.5 + height, at(j)));
        }
    }
    let mut masses = vec![1.0; centers.len()];
    masses[29] = top_mass;
    let mut pile = Pile::of(&masses);
    for (a, x) in centers.iter().enumerate() {
        if x.y == 0.5 {
            pile = pile.on_face(a, DVec3::Y);
            for (coordinate, inwards) in [(x.x, -DVec3::X), (x.z, -DVec3::Z)] {
                if coordinate.abs() == 1.5 {
                    pile = pile.on_face(a, inwards * coordinate.signum());
                }
            }
        }
        for (b, y) in centers.iter().enumerate().skip(a + 1) {
            if (y - x).length() < 1.0 + 1e-9 {
                pile = pile.on_sphere(a, b, (x - y).normalize());
            }
        }
    }
    pile
}

/// Largest difference of a number from what is expected, relative to the size of the latter.
fn error(found: f64, expected: f64) -> f64 {
    (found - expected).abs() / expected.abs().max(1.0)
}

#[test]
fn a_sphere_on_a_slope_slides_with_g_sine_and_presses_with_m_g_cosine() {
    // A 3-4-5 slope: sine 0.6, cosine 0.8.
    let held = Pile::of(&[2.0]).on_face(0, slope(3.0, 4.0)).hold();
    let a = held.acceleration.vectors[0];
    assert!((a - DVec3::new(9.8 * 0.8 * 0.6, -9.8 * 0.6 * 0.6, 0.0)).length() < ROUNDING, "{a}");
    assert!(error(held.acceleration.multipliers[0], 2.0 * 9.8 * 0.8) < ROUNDING);
    assert_eq!(held.fate, [Fate::Loaded]);
}

#[test]
fn a_sphere_in_a_v_presses_each_face_with_m_g_over_twice_the_cosine() {
    for (rise, run) in [(3.0, 4.0), (0.01, 1.0), (100.0, 1.0), (1.0, 1.0)] {
        let (left, right) = (slope(rise, run), slope(-rise, run));
        let held = Pile::of(&[2.0]).on_face(0, left).on_face(0, right).hold();
        assert_eq!(held.acceleration.vectors[0], DVec3::ZERO);
        for force in &held.acceleration.multipliers {
            let expected = 2.0 * 9.8 / (2.0 * left.y);
            assert!(error(*force, expected) < ROUNDING, "{force} instead of {expected}");
        }
        let forces = &held.acceleration.multipliers;
        assert_eq!(forces[0], forces[1], "the mirror images differ");
    }
}

#[test]
fn a_tilted_v_lets_the_sphere_slide_along_its_crease_alone() {
    // Both faces contain the direction (0, −0.6, 0.8): gravity along it is 9.8 · 0.6.
    let along = DVec3::new(0.0, -0.6, 0.8);
    let up = DVec3::new(0.0, 0.8, 0.6);
    let faces = [(up + DVec3::X).normalize(), (up - DVec3::X).normalize()];
    let held = Pile::of(&[1.0]).on_face(0, faces[0]).on_face(0, faces[1]).hold();
    assert!((held.acceleration.vectors[0] - along * (9.8 * 0.6)).length() < ROUNDING);
}

#[test]
fn a_three_face_corner_holds_a_sphere_with_one_third_of_the_diagonal_force_each() {
    // Gravity along −(1, 1, 1)/√3 into the corner of a cube: each face carries m g/√3.
    let mut pile = Pile::of(&[3.0]).on_face(0, DVec3::X).on_face(0, DVec3::Y).on_face(0, DVec3::Z);
    pile.applied[0] = DVec3::splat(-9.8 / 3.0_f64.sqrt());
    let held = pile.hold();
    assert_eq!(held.acceleration.vectors[0], DVec3::ZERO);
    for force in held.acceleration.multipliers {
        assert!(error(force, 3.0 * 9.8 / 3.0_f64.sqrt()) < ROUNDING, "{force}");
    }
}

#[test]
fn each_contact_of_a_column_carries_the_weight_above_it() {
    let held = column(&[1.0; 10]).hold();
    for (contact, force) in held.acceleration.multipliers.iter().enumerate() {
        let above = (10 - contact) as f64;
        // Ten sums of weights up to 98 N, each rounded once.
        assert!(error(*force, above * 9.8) < 10.0 * ROUNDING, "contact {contact} carries {force}");
    }
    assert!(held.acceleration.vectors.iter().all(|a| *a == DVec3::ZERO));
}

#[test]
fn a_heavy_sphere_on_a_column_of_light_ones_is_carried() {
    for top in [1e4, 1e8] {
        let mut masses = [1.0; 10];
        masses[9] = top;
        let held = column(&masses).hold();
        // Forces of 1e9 N on 1 kg have an ulp of 1.2e-7 m/s²; the task asks for 1e-6.
        assert!(held.acceleration.residual() <= 1e-6, "top {top}: {}", held.acceleration.residual());
        assert!(held.acceleration.vectors.iter().all(|a| *a == DVec3::ZERO));
        for (contact, force) in held.acceleration.multipliers.iter().enumerate() {
            let expected = 9.8 * ((9 - contact) as f64 + top);
            // The condition of the problem is the mass ratio, that of the forces is 1: they are sums of weights.
            assert!(error(*force, expected) < 1e-13, "contact {contact}: {force} instead of {expected}");
        }
    }
}

#[test]
fn a_confined_pyramid_of_thirty_spheres_rests_at_any_top_mass() {
    for (top, allowed) in [(1.0, 1e-12), (1e4, 1e-8), (1e8, 1e-4)] {
        let pile = pyramid(top);
        assert_eq!((pile.masses.len(), pile.contacts.len()), (30, 128));
        let held = pile.hold();
        // Rounding of forces that grow with the top mass; a prototype left 5e-6 at 1e8.
        assert!(held.acceleration.residual() <= allowed, "top {top}: {}", held.acceleration.residual());
        assert!(held.acceleration.vectors.iter().all(|a| *a == DVec3::ZERO));
        let floor: f64 = pile
            .contacts
            .iter()
            .zip(&held.acceleration.multipliers)
            .filter(|(contact, _)| contact.b.is_none() && contact.normal == DVec3::Y)
            .map(|(_, force)| force)
            .sum();
        let weight = 9.8 * (29.0 + top);
        assert!(error(floor, weight) < 1e-12, "the floor carries {floor} of {weight}");
    }
}

#[test]
fn speeds_too_small_for_all_their_digits_are_none() {
    // What a collapse has left, among redundant contacts: two spheres in the corners of a trough, one between them.
    let speed = |v: f64| DVec3::new(0.0, 0.0, v);
    let corner = |pile: Pile, body: usize| pile.on_face(body, DVec3::Y).on_face(body, DVec3::X);
    let mut pile = corner(corner(corner(Pile::of(&[1.0, 1.0, 3.7]), 0), 1).on_face(1, DVec3::Z), 2);
    pile = pile.moving(0, speed(-2.53e-321)).moving(2, speed(8.2e-322));
    let along = DVec3::new(0.02, 0.02, 1.0).normalize();
    let held = pile.on_sphere(0, 2, along).on_sphere(2, 1, along).hold();
    assert!((0..3).all(|body| held.velocity.vector(body).is_none_or(|v| v == DVec3::ZERO)));
}

#[test]
fn two_coplanar_tiles_carry_a_sphere_once() {
    let held = Pile::of(&[1.0]).on_face(0, DVec3::Y).on_face(0, DVec3::Y).moving(0, -DVec3::Y).hold();
    assert_eq!(held.velocity.vectors[0], DVec3::ZERO);
    assert!(error(held.velocity.multipliers.iter().sum(), 1.0) < ROUNDING);
    assert_eq!(held.acceleration.vectors[0], DVec3::ZERO);
    assert!(error(held.acceleration.multipliers.iter().sum(), 9.8) < ROUNDING);
    assert!(!held.fate.contains(&Fate::Opening), "a tile let go: {:?}", held.fate);
}

#[test]
fn redundant_tiles_under_a_whole_column_change_nothing() {
    let mut pile = column(&[1.0, 2.0, 3.0]);
    for _ in 0..3 {
        pile = pile.on_face(0, DVec3::Y);
    }
    let held = pile.hold();
    let tiles: f64 = [0, 3, 4, 5].iter().map(|&i| held.acceleration.multipliers[i]).sum();
    assert!(error(tiles, 6.0 * 9.8) < ROUNDING, "{tiles}");
    assert!(!held.fate.contains(&Fate::Opening));
}

#[test]
fn a_sphere_pulled_away_leaves_with_zero_multiplier() {
    let mut pile = column(&[1.0, 1.0]);
    pile.applied[1] = DVec3::Y;
    let held = pile.hold();
    assert_eq!(held.acceleration.vectors, [DVec3::ZERO, DVec3::Y]);
    assert_eq!(held.acceleration.multipliers[1], 0.0);
    assert_eq!(held.fate, [Fate::Loaded, Fate::Opening]);
}

#[test]
fn a_departing_sphere_takes_no_part_in_the_acceleration_problem() {
    let held = column(&[1.0, 1.0]).moving(1, DVec3::Y).hold();
    assert_eq!(held.velocity.vectors, [DVec3::ZERO, DVec3::Y]);
    assert_eq!(held.acceleration.vectors, [DVec3::ZERO, G]);
    assert_eq!(held.fate, [Fate::Loaded, Fate::Opening]);
}

#[test]
fn an_unpressed_contact_stays_closed_and_idle() {
    let mut pile = Pile::of(&[1.0]).on_face(0, DVec3::X).moving(0, DVec3::Y);
    pile.applied[0] = DVec3::ZERO;
    let held = pile.hold();
    assert_eq!(held.fate, [Fate::Idle]);
    assert_eq!(held.velocity.vectors[0], DVec3::Y);
}

#[test]
fn a_sphere_passing_over_another_presses_with_m_g_less_the_centripetal_force() {
    // On top of a held sphere with speed v: N = m (g − v²/(r₁ + r₂)); at v² = g (r₁ + r₂) it flies off.
    let fixed = 1e30;
    for (v, flies) in [(1.0, false), (3.0, false), (3.2, true)] {
        let mut pile = Pile::of(&[1.0, fixed]).on_sphere(0, 1, DVec3::Y).moving(0, DVec3::X * v);
        pile.applied[1] = DVec3::ZERO;
        let held = pile.hold();
        let expected = (9.8_f64 - v * v).max(0.0);
        assert!(error(held.acceleration.multipliers[0], expected) < ROUNDING);
        assert_eq!(held.fate, [if flies { Fate::Opening } else { Fate::Loaded }]);
    }
}

#[test]
fn only_motion_across_an_edge_counts_as_curved() {
    let along = DVec3::Z;
    let edge = Surface::Edge { along, radius: 0.5 };
    let v = DVec3::new(3.0, 0.0, 4.0);
    assert_eq!(edge.curvature_term(DVec3::Y, v), 18.0);
    assert_eq!(Surface::Round { radius: 0.5 }.curvature_term(DVec3::Y, v), 50.0);
    assert_eq!(Surface::Face.curvature_term(DVec3::Y, v), 0.0);
}

#[test]
fn two_spheres_in_a_v_press_each_other_and_mirror_each_other() {
    // Slopes of 3-4-5, centres level and touching: faces carry m g/0.8, the pair m g · 0.75.
    let pile = Pile::of(&[1.0, 1.0]).on_face(0, slope(3.0, 4.0)).on_face(1, slope(-3.0, 4.0));
    let held = pile.on_sphere(0, 1, -DVec3::X).hold();
    assert!(held.acceleration.vectors.iter().all(|a| *a == DVec3::ZERO));
    for (force, expected) in held.acceleration.multipliers.iter().zip([12.25, 12.25, 7.35]) {
        assert!(error(*force, expected) < ROUNDING, "{force} instead of {expected}");
    }
}

#[test]
fn a_row_of_three_hundred_spheres_in_a_groove_is_pivoted_and_says_so() {
    // Single spheres in V grooves, joined in one row: a large island of which each row couples with few.
    let count = 300;
    let mut pile = Pile::of(&vec![1.0; count]);
    for a in 0..count {
        pile = pile.on_face(a, slope(1.0, 1.0)).on_face(a, slope(-1.0, 1.0));
        if a > 0 {
            pile = pile.on_sphere(a, a - 1, DVec3::Z);
        }
    }
    let held = pile.hold();
    assert_eq!(held.acceleration.reports[0].solver, Solver::Pivoting);
    assert!(held.acceleration.vectors.iter().all(|a| *a == DVec3::ZERO));
}

/// The random numbers that a problem is made of.
struct Random(SplitMix64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0.unit()
    }

    fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - DVec3::ONE
    }

    fn direction(&mut self) -> DVec3 {
        self.vector().normalize_or(DVec3::Y)
    }
}

/// A random problem: 1–12 bodies, up to 30 contacts, some of them repeated, masses over `decades` decades.
fn random_problem(seed: u64, decades: i32) -> (Vec<f64>, Vec<DVec3>, Vec<Row>) {
    let mut random = Random(SplitMix64::new(seed));
    let count = 1 + random.below(12);
    let mass = |random: &mut Random| 10_f64.powf((random.unit() - 0.5) * f64::from(decades));
    let inverse_mass: Vec<f64> = (0..count).map(|_| mass(&mut random)).collect();
    let free: Vec<DVec3> = (0..count).map(|_| random.vector() * 5.0).collect();
    let mut rows: Vec<Row> = Vec::new();
    for _ in 0..1 + random.below(30) {
        let (a, b) = (random.below(count), random.below(count));
        let offset = if random.unit() < 0.5 { 0.0 } else { random.unit() };
        let row = Row { a, b: (a != b).then_some(b), normal: random.direction(), offset };
        rows.push(if random.unit() < 0.2 { rows.last().copied().unwrap_or(row) } else { row });
    }
    (inverse_mass, free, rows)
}

#[test]
fn random_islands_satisfy_complementarity_and_never_gain_energy() {
    for seed in 0..20_000 {
        let decades = [0, 2, 8][seed as usize % 3];
        let (inverse_mass, free, mut rows) = random_problem(seed, decades);
        for velocity in [true, false] {
            if velocity {
                rows.iter_mut().for_each(|row| row.offset = 0.0);
            }
            let solution = solve(&inverse_mass, &free, &rows, &[]);
            assert!(solution.converged(), "seed {seed}: {:?}", solution.reports);
            let mut u = free.clone();
            for (&body, &vector) in solution.bodies.iter().zip(&solution.vectors) {
                u[body] = vector;
            }
            for (row, &multiplier) in rows.iter().zip(&solution.multipliers) {
                let relative = u[row.a] - row.b.map_or(DVec3::ZERO, |b| u[b]);
                let opening = row.normal.dot(relative) + row.offset;
                let share = inverse_mass[row.a] + row.b.map_or(0.0, |b| inverse_mass[b]);
                // u is of size 10; light bodies between heavy ones feel forces, and rounding, up to 1e4 times that, and
                // repeated contacts of an island with a condition of 1e4 inherit its rounding (seed 1633).
                let rounding = 1e-10 * 10_f64.powi(decades / 2);
                assert!(multiplier >= 0.0, "seed {seed}: a contact pulls with {multiplier}");
                assert!(opening >= -rounding, "seed {seed}: a contact closes with {opening}");
                assert!(opening.min(multiplier * share) <= rounding, "seed {seed}: {opening} under {multiplier}");
            }
            if velocity {
                let energy =
                    |v: &[DVec3]| -> f64 { v.iter().zip(&inverse_mass).map(|(v, w)| v.length_squared() / w).sum() };
                let (before, after) = (energy(&free), energy(&u));
                assert!(after <= before * (1.0 + 1e-13), "seed {seed}: energy grew from {before} to {after}");
            }
        }
    }
}

#[test]
fn a_mirror_image_has_the_mirrored_solution() {
    let mirror = |v: DVec3| DVec3::new(-v.x, v.y, v.z);
    for seed in 0..2000 {
        let (inverse_mass, free, mut rows) = random_problem(seed, 2);
        let there = solve(&inverse_mass, &free, &rows, &[]);
        rows.iter_mut().for_each(|row| row.normal = mirror(row.normal));
        rows.reverse();
        let free: Vec<DVec3> = free.into_iter().map(mirror).collect();
        let back = solve(&inverse_mass, &free, &rows, &[]);
        assert_eq!(there.bodies, back.bodies);
        for (u, w) in there.vectors.iter().zip(&back.vectors) {
            // Accelerations of 10 times the condition of random islands, which is rarely above 1e3.
            assert!((*u - mirror(*w)).length() < 1e-11, "seed {seed}: {u} against {w}");
        }
    }
}

#[test]
fn the_order_of_islands_and_their_parts_follows_from_the_indices() {
    let found = islands(&[(5, Some(3)), (1, None), (3, Some(2)), (8, Some(1))]);
    let bodies: Vec<_> = found.iter().map(|island| island.bodies.to_vec()).collect();
    assert_eq!(bodies, [vec![2, 3, 5], vec![1, 8]]);
}
