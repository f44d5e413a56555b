//! Snapshots built by hand: what a picture needs, without a physics.
#![allow(dead_code, reason = "the bench uses a part of it")]

use std::sync::Arc;

use carom::random::SplitMix64;
use carom::{
    geometry::{Bounds, Parallelogram},
    snapshot::{Alarm, Class, Contact, ContactLaw, Ghost, Kept, Kind, Probe, Snapshot, Stage, Tallies, Ticks, Trade},
    view::{Comparison, Mode, Pace, Popup, Screen, ViewSettings},
};
use glam::{DVec3, dvec3};

/// What one frame is drawn from, owned.
#[derive(Clone)]
pub(crate) struct Scene {
    pub(crate) snapshot: Snapshot,
    pub(crate) ticks: Ticks,
    pub(crate) kept: Kept,
    pub(crate) view_settings: ViewSettings,
    pub(crate) pace: Pace,
    /// The exact run beside it.
    pub(crate) comparison: Option<(Option<Ghost>, Trade)>,
}

pub(crate) const HINTS: &[(&str, &str)] = &[
    ("space", "run"),
    (".", "step"),
    (",", "back"),
    ("c", "collision"),
    ("+-", "speed"),
    ("tT", "tolerance"),
    ("m", "method"),
    ("o", "scenes"),
    ("?", "help"),
    ("q", "quit"),
];

impl Scene {
    pub(crate) fn screen(&self) -> Screen<'_> {
        Screen {
            snapshot: &self.snapshot,
            pace: self.pace,
            ticks: &self.ticks,
            kept: self.kept,
            recorded: None,
            trail: &[],
            ahead: None,
            log: None,
            comparison: self.comparison.as_ref().map(|(ghost, trade)| Comparison { ghost: ghost.as_ref(), trade }),
            view_settings: &self.view_settings,
            popup: Popup::None,
            message: None,
            hints: HINTS,
        }
    }
}

/// The paper's room, 10 × 10 × 20 m, with its green and red walls.
pub(crate) fn room() -> Vec<([DVec3; 4], Option<[f64; 3]>)> {
    let (grey, green, red) = (Some([0.725, 0.71, 0.68]), Some([0.14, 0.45, 0.091]), Some([0.63, 0.065, 0.05]));
    vec![
        wall(dvec3(0.0, 0.0, 7.5), dvec3(10.0, 0.0, 0.0), dvec3(0.0, 0.0, -20.0), grey),
        wall(dvec3(0.0, 10.0, 7.5), dvec3(10.0, 0.0, 0.0), dvec3(0.0, 0.0, 20.0), grey),
        wall(dvec3(0.0, 5.0, -2.5), dvec3(10.0, 0.0, 0.0), dvec3(0.0, 10.0, 0.0), grey),
        wall(dvec3(0.0, 5.0, 17.5), dvec3(-10.0, 0.0, 0.0), dvec3(0.0, 10.0, 0.0), grey),
        wall(dvec3(5.0, 5.0, 7.5), dvec3(0.0, 0.0, 20.0), dvec3(0.0, 10.0, 0.0), green),
        wall(dvec3(-5.0, 5.0, 7.5), dvec3(0.0, 0.0, -20.0), dvec3(0.0, 10.0, 0.0), red),
    ]
}

pub(crate) fn wall(center: DVec3, s1: DVec3, s2: DVec3, color: Option<[f64; 3]>) -> ([DVec3; 4], Option<[f64; 3]>) {
    (Parallelogram { center, s1, s2 }.corners(), color)
}

/// A paused scene at rest in the room, its spheres given as (centre, velocity), all of 1 kg and 0.5 m.
pub(crate) fn scene(key: &str, spheres: &[(DVec3, DVec3)]) -> Scene {
    let stage = Stage {
        key: key.into(),
        name: format!("The scene {key}"),
        about: "Built by hand.".into(),
        duration: 20.0,
        view: Bounds { min: dvec3(-5.0, 0.0, -2.5), max: dvec3(5.0, 10.0, 2.5) },
        walls: room(),
        radii: vec![0.5; spheres.len()],
        masses: vec![1.0; spheres.len()],
        colors: vec![None; spheres.len()],
        names: vec![None; spheres.len()],
        gravity: dvec3(0.0, -9.8, 0.0),
        forces: vec![DVec3::ZERO; spheres.len()],
        law: ContactLaw { restitution: 0.8, wall_restitution: 0.8, tangential: 0.98, rest_speed: 0.1 },
    };
    let snapshot = Snapshot {
        stage: Arc::new(stage),
        t: 0.0,
        step: 0.0,
        x: spheres.iter().map(|sphere| sphere.0).collect(),
        v: spheres.iter().map(|sphere| sphere.1).collect(),
        energy: 98.0,
        initial_energy: 98.0,
        contacts: Vec::new(),
        acting: Vec::new(),
        rest_reasons: Vec::new(),
        approaches: Vec::new(),
        probes: Vec::new(),
        trials: Vec::new(),
        left_out: Vec::new(),
        tallies: Tallies::default(),
        method: "paper",
        dt: 0.01,
        tolerance: 0.001,
        slack: Some(1e-4),
        stall: None,
        alarm: Alarm::default(),
    };
    let ticks = Ticks { span: 20.0, impacts: vec![0; 80] };
    let pace = Pace { mode: Mode::Pause, wanted: 1.0, reached: None };
    Scene { snapshot, ticks, kept: Kept::default(), view_settings: ViewSettings::default(), pace, comparison: None }
}

/// Changes what is constant.
pub(crate) fn edit(scene: &mut Scene, change: impl FnOnce(&mut Stage)) {
    change(Arc::make_mut(&mut scene.snapshot.stage));
}

pub(crate) fn contact(kind: Kind, a: usize, b: usize, class: Class) -> Contact {
    Contact {
        time: 1.0,
        kind,
        a,
        b,
        point: DVec3::ZERO,
        normal: DVec3::Y,
        velocity: dvec3(1.5, -7.4, 0.0),
        approach_speed: 7.891,
        separation_speed: 6.3128,
        impulse: 14.2038,
        degree: 9.8e-4,
        class,
        impacts: 1,
    }
}

/// One sphere in the air over the floor.
pub(crate) fn drop() -> Scene {
    scene("paper-0", &[(dvec3(-4.5, 9.5, 0.0), DVec3::ZERO)])
}

/// Two spheres over a V of two walls, one of them just hitting its wall; running.
pub(crate) fn wedge() -> Scene {
    let spheres = [(dvec3(-2.1, 3.0, -0.5), dvec3(1.5, -7.4, 0.0)), (dvec3(2.4, 6.6, -0.5), dvec3(-5.0, -2.0, 0.0))];
    let mut scene = scene("paper-4", &spheres);
    edit(&mut scene, |stage| {
        let color = Some([0.14, 0.45, 0.091]);
        stage.walls.push(wall(dvec3(-2.5, 2.5, -0.5), dvec3(5.0, -3.0, 0.0), dvec3(0.0, 0.0, -4.0), color));
        stage.walls.push(wall(dvec3(2.5, 2.5, -0.5), dvec3(0.0, 0.0, 4.0), dvec3(5.0, 3.0, 0.0), color));
        stage.colors = vec![Some([0.725, 0.58, 0.71]), Some([0.58, 0.725, 0.71])];
        stage.names = vec![Some("left".into()), Some("right".into())];
    });
    let snapshot = &mut scene.snapshot;
    (snapshot.t, snapshot.step, snapshot.energy, snapshot.initial_energy) = (3.5072, 0.0031, 81.25, 221.2);
    let hit = Contact {
        point: dvec3(-2.357, 2.571, -0.5),
        normal: dvec3(0.5145, 0.8575, 0.0),
        ..contact(Kind::Wall, 0, 6, Class::Collide)
    };
    snapshot.contacts = vec![hit];
    snapshot.probes = vec![
        Probe { step: 0.01, degree: 0.0312 },
        Probe { step: 0.005, degree: 0.0091 },
        Probe { step: 0.0025, degree: -0.0043 },
        Probe { step: 0.00375, degree: 0.0017 },
        Probe { step: 0.003125, degree: 0.00098 },
    ];
    snapshot.tallies = Tallies {
        frames: 357,
        impacts: 11,
        rests: 0,
        releases: 0,
        evaluations: 5712,
        probes: 55,
        deepest_degree: 0.00109,
        ..Tallies::default()
    };
    for (bin, impacts) in [(3, 2), (7, 1), (9, 4), (12, 1), (13, 2), (14, 1)] {
        scene.ticks.impacts[bin] = impacts;
    }
    scene.pace = Pace { mode: Mode::Run, wanted: 0.25, reached: Some(0.2493) };
    scene.view_settings.selected = Some(0);
    scene
}

/// Three touching spheres on the floor: two at rest, one hitting another.
pub(crate) fn pile() -> Scene {
    let spheres = [
        (dvec3(-0.5, 0.5, 0.0), DVec3::ZERO),
        (dvec3(0.5, 0.5, 0.0), DVec3::ZERO),
        (dvec3(0.0, 1.366_025_403_784_438_6, 0.0), dvec3(0.0, -3.1, 0.0)),
        (dvec3(3.0, 7.0, 1.0), dvec3(2.0, 4.0, -3.0)),
    ];
    let mut scene = scene("pile", &spheres);
    let snapshot = &mut scene.snapshot;
    (snapshot.t, snapshot.method, snapshot.tolerance) = (12.5, "swept", 1e-9);
    snapshot.contacts = vec![
        Contact { point: dvec3(-0.5, 0.0, 0.0), ..contact(Kind::Wall, 0, 0, Class::Rest) },
        Contact { point: dvec3(0.5, 0.0, 0.0), ..contact(Kind::Wall, 1, 0, Class::Rest) },
        Contact {
            point: dvec3(-0.25, 0.933, 0.0),
            normal: dvec3(-0.5, -0.866, 0.0),
            ..contact(Kind::Pair, 0, 2, Class::Collide)
        },
        Contact {
            point: dvec3(0.25, 0.933, 0.0),
            normal: dvec3(0.5, -0.866, 0.0),
            ..contact(Kind::Pair, 1, 2, Class::Leave)
        },
    ];
    scene.view_settings.overlays.velocities = true;
    scene.view_settings.overlays.normals = true;
    scene.view_settings.overlays.ids = true;
    scene
}

/// A run that has strayed from the exact one beside it, which lags a little.
pub(crate) fn strayed() -> Scene {
    let mut scene = wedge();
    let off = [dvec3(-0.3, 0.6, 0.0), dvec3(0.02, -0.01, 0.0)];
    let x: Vec<DVec3> = scene.snapshot.x.iter().zip(off).map(|(x, off)| *x + off).collect();
    let deviations = off.iter().map(|off| off.length()).collect();
    let ghost = Ghost { t: 3.4572, x, deviations, energy_error: -3.2e-3, horizon: None, stall: None };
    let mut trade = Trade::new(20.0);
    for k in 0..70 {
        let t = f64::from(k) * 0.05;
        trade.deviation.add(t, 1e-6 * f64::from(k * k * k));
        trade.energy_error.add(t, -1e-4 * f64::from(k / 10));
        trade.deepest_degree.add(t, 1.1e-3);
        trade.evaluations.add(t, f64::from(8 + k % 7));
        trade.cost.add(t, 0.35 + 0.01 * f64::from(k % 3));
    }
    scene.view_settings.ghost = true;
    scene.comparison = Some((Some(ghost), trade));
    scene
}

/// A run that cannot go on, and says why.
pub(crate) fn stalled() -> Scene {
    let mut scene = wedge();
    scene.pace.mode = Mode::Stalled;
    scene.snapshot.t = 7.4983;
    scene.snapshot.stall = Some(
        "The bisection for the collision time of sphere 0 with wall 6 came to the end of its digits at t = 7.4983 s \
         without an end to the overlap: the sphere rests in a wedge, which this method cannot solve; m continues with \
         another from here."
            .into(),
    );
    scene
}

/// Many spheres of three sizes on a jittered grid: positions the same everywhere.
pub(crate) fn gas(count: usize) -> Scene {
    let mut random = SplitMix64::new(7);
    let mut uniform = move || random.unit();
    let mut place = || dvec3(-4.7 + 9.4 * uniform(), 0.3 + 9.4 * uniform(), -2.2 + 4.4 * uniform());
    let spheres: Vec<_> = (0..count).map(|_| (place(), place() * 0.2)).collect();
    let mut scene = scene("gas", &spheres);
    edit(&mut scene, |stage| stage.radii = (0..count).map(|i| [0.08, 0.15, 0.3][i % 3]).collect());
    scene.snapshot.tallies.impacts = 1_234_567;
    scene
}
