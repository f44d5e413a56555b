//! The same scene in other units of length and time: the same events, the trajectory scaled, to rounding. A twin whose
//! places are off by some ulp says how fast rounding grows; what it does not survive itself is not asked of the scaled run.

use carom::physics::{Contact, Kind, Progress, Scene, Simulation, Until};
use carom::scene::{Sphere, Wall};
use glam::DVec3;

use crate::joints::joint_scene;
use crate::judged::{EXACT, Failure, Met, keep};
use crate::random::Random;
use crate::rooms::room_scene;

/// Turns of the method's loop that each run may take.
const BUDGET: u64 = 400_000;

/// How much more than its twin the scaled run may be off: the twin's rounding is one of many.
const MORE: f64 = 1e4;

/// What every event may be off by, relative to sizes of some metres and seconds: a thousand ulp of a deviation that the
/// twin does not have, since its places alone are off.
const LEAST: f64 = 1e-11;

/// The same where bounces are summed up: on a tilted wall rounding of the gap is up to a hundredth of the first hop that is
/// summed, and the end of the series moves with it.
const SUMMED: f64 = 2e-8;

/// What rounding leaves of places, ulp: a slow approach crosses them in a while, and bends all that time.
const ULPS: f64 = 16.0;

/// Normals of two walls at one point are the same up to rounding of the places, which are some metres and reach back to radii of
/// some decimetres.
const SHARED: f64 = 1e-12;

/// Twins that are asked where the scaled run is off by more than the first one says.
const MORE_TWINS: usize = 8;

/// What a twin has off by some ulp.
#[derive(Clone, Copy, PartialEq)]
enum Off {
    /// Places: what moves on a line of symmetry leaves it.
    Places,
    /// Velocities and walls too, as in other units all is rounded anew: tiles no longer meet, no wall goes along a coordinate.
    All,
}

/// A scene that is off by some ulp, each vector in any direction.
fn twin(scene: &Scene, what: Off, random: &mut Random) -> Scene {
    let mut off = |x: &mut DVec3| *x += random.vector() * (4.0 * f64::EPSILON * x.abs().max_element());
    let changed = scene.changed(|draft| {
        draft.spheres.iter_mut().for_each(|s| off(&mut s.x));
        if what == Off::All {
            draft.spheres.iter_mut().for_each(|s| off(&mut s.v));
            let shapes = draft.walls.iter_mut().map(|wall| &mut wall.shape);
            shapes.for_each(|shape| [&mut shape.center, &mut shape.s1, &mut shape.s2].into_iter().for_each(&mut off));
        }
    });
    changed.expect("a scene within the rules")
}

/// A scene with lengths in units of `length` and times in units of `time`.
fn in_units(scene: &Scene, length: f64, time: f64) -> Scene {
    let (speed, pull) = (length / time, length / (time * time));
    let wall = |wall: &Wall| {
        let mut wall = wall.clone();
        wall.shape.center *= length;
        wall.shape.s1 *= length;
        wall.shape.s2 *= length;
        wall
    };
    let sphere = |s: &Sphere| Sphere {
        x: s.x * length,
        v: s.v * speed,
        radius: s.radius * length,
        force: s.force * pull,
        ..s.clone()
    };
    let scaled = scene.changed(|scaled| {
        scaled.gravity *= pull;
        scaled.contact.rest_speed *= speed;
        scaled.walls = scene.walls.iter().map(wall).collect();
        scaled.spheres = scene.spheres.iter().map(sphere).collect();
    });
    scaled.expect("a scene within the rules")
}

/// What stops less than this (m/s, in the scene's own units), and the end of a rest, is told or not, or later, as rounding has
/// it.
const STOPPED: f64 = 1e-6;

/// Factor around [`STOPPED`] within which rounding decides which side of it a row is on: its speeds differ by some percent
/// there.
const EITHER: f64 = 4.0;

/// Whether a row tells of more than a stop at the level of rounding, `least` (m/s in the scene's own units); `unit` of speed, m/s.
fn matters(scene: &Scene, row: &Contact, unit: f64, least: f64) -> bool {
    let change = |i: usize| row.impulse / scene.spheres[i].mass;
    let other = if row.kind == Kind::Pair { change(row.b) } else { 0.0 };
    change(row.a).max(other).max(row.approach_speed.abs()) > least * unit
}

/// The events of a run until `t` (s) that matter, by more than `least`, in this unit of speed (m/s), and why it did not get
/// there if it did not.
fn events(scene: &Scene, dt: f64, t: f64, (unit, least): (f64, f64)) -> (Vec<Contact>, Option<String>) {
    let (mut rows, end) = all_events(scene, dt, t);
    // the last frame may reach beyond the end
    rows.retain(|row| row.time <= t && matters(scene, row, unit, least));
    (rows, end)
}

fn all_events(scene: &Scene, dt: f64, t: f64) -> (Vec<Contact>, Option<String>) {
    let mut run = Simulation::new(scene, carom::physics::Settings { dt, ..EXACT });
    run.record_events(true);
    for _ in 0..BUDGET / 1000 {
        match run.advance(Until::Time(t), 1000) {
            Progress::Reached => return (run.take_events(), None),
            Progress::Yielded => {}
            Progress::Stalled(stall) => return (run.take_events(), Some(stall.kind.to_string())),
        }
    }
    (run.take_events(), Some("work".into()))
}

/// How far two events are apart, lengths and times taken in these units; none if they are different ones.
fn apart(one: &Contact, other: &Contact, length: f64, time: f64) -> Option<f64> {
    // at the edge that two walls share, rounding says which of them is touched
    let shared = one.kind == Kind::Wall && other.kind == Kind::Wall && one.a == other.a;
    let shared = shared && (one.normal - other.normal).length() <= SHARED;
    let same = (one.key() == other.key() || shared) && one.class == other.class;
    let off = (one.point - other.point / length).length() + (one.time - other.time / time).abs();
    let speeds = (one.approach_speed - other.approach_speed * time / length).abs();
    same.then_some(off + speeds)
}

/// The scene of this seed: a room or a joint, away from places that many bodies share by symmetry.
fn base(seed: u64, random: &mut Random) -> Scene {
    let scene = if seed.is_multiple_of(2) { room_scene(seed / 2) } else { joint_scene(seed / 2) };
    let nudge = |random: &mut Random| random.vector() * 1e-3;
    let shift: DVec3 = nudge(random);
    scene.changed(|draft| draft.spheres.iter_mut().for_each(|s| s.v += shift)).expect("a scene within the rules")
}

/// What rounding of places makes of an approach (s, m and m/s): its time by their part of v_n, the place by the way in that
/// time, and v_n itself by what it grows in it, where it comes of gravity or of a path that bends round the point.
fn by_slowness(scene: &Scene, event: &Contact) -> f64 {
    let sphere = &scene.spheres[event.a];
    let (speed, pull) = (event.velocity.length(), (scene.gravity + sphere.force / sphere.mass).length());
    // places of an edge are rounded as the far end of its wall
    let far = |wall: &Wall| (wall.shape.center.abs() + 0.5 * (wall.shape.s1.abs() + wall.shape.s2.abs())).max_element();
    let size = if event.kind == Kind::Wall { far(&scene.walls[event.b]) } else { event.point.abs().max_element() };
    let late = ULPS * f64::EPSILON * size / event.approach_speed;
    late * (1.0 + speed + pull + speed * speed / sphere.radius)
}

/// A scene, and what happens in it.
struct Run {
    scene: Scene,
    rows: Vec<Contact>,
    /// Why it did not get to its end, if it did not.
    end: Option<String>,
}

impl Run {
    fn new(scene: Scene, until: f64) -> Run {
        let (rows, end) = events(&scene, 0.5, until, (1.0, STOPPED));
        Run { scene, rows, end }
    }
}

/// Compares a scene with itself in other units.
pub(crate) fn check(seed: u64, until: f64, met: &mut Met) -> Result<(), Failure> {
    let random = &mut Random::new(seed.wrapping_mul(0xff51_afd7_ed55_8ccd) ^ 0x0101_2323_4545_6767);
    let scene = base(seed, random);
    let (length, time) = (random.decade(-3.0, 3.0), random.decade(-3.0, 3.0));
    let first = twin(&scene, Off::Places, random);
    let plain = Run::new(scene, until);
    met.impacts += plain.rows.len() as u64;
    let scene = in_units(&plain.scene, length, time);
    let (rows, end) = events(&scene, 0.5 * time, until * time, (length / time, STOPPED / EITHER));
    let scaled = Run { scene, rows, end };
    let mut found = compare(&plain, &[Run::new(first, until)], &scaled, (length, time));
    if found.is_err() {
        // the first twin may have been lucky: what none of several survives is as rounding has it
        let more = (0..MORE_TWINS).map(|_| Run::new(twin(&plain.scene, Off::All, random), until));
        found = compare(&plain, &more.collect::<Vec<_>>(), &scaled, (length, time));
        met.undecided += u64::from(found.is_ok());
    }
    found.map_err(|failure| {
        keep(&plain.scene, seed);
        Failure { text: format!("seed {seed}, {length:e} m and {time:e} s: {}", failure.text), ..failure }
    })
}

/// Compares a run with one in units of `length` and `time`, as long as all twins are like it.
fn compare(plain: &Run, twins: &[Run], scaled: &Run, (length, time): (f64, f64)) -> Result<(), Failure> {
    let fail = |kind: &str, text: String| Err(Failure { kind: kind.into(), text });
    // what rounding leaves out of the one run, or of the other, is passed over
    let slight = |row: &Contact| !matters(&scaled.scene, row, length / time, STOPPED * EITHER);
    let mut rows = scaled.rows.iter().peekable();
    let e = plain.scene.contact.wall_restitution;
    let least = if 0.0 < e && e < 1.0 { SUMMED } else { LEAST };
    let (mut grown, mut slow) = (0.0_f64, 0.0_f64);
    for (k, event) in plain.rows.iter().enumerate() {
        for twin in twins {
            let Some(off) = twin.rows.get(k).and_then(|it| apart(event, it, 1.0, 1.0)) else { return Ok(()) };
            grown = grown.max(off);
        }
        if grown > 1e-7 {
            return Ok(()); // growth has made the rest moot
        }
        if event.approach_speed > 0.0 {
            slow = slow.max(by_slowness(&plain.scene, event));
        }
        let allowed = MORE * grown + least + slow;
        let differs = |row: &Contact| apart(event, row, length, time).is_none_or(|off| off > allowed);
        while rows.next_if(|row| slight(row) && differs(row)).is_some() {}
        let it = rows.next();
        match it.and_then(|it| apart(event, it, length, time)) {
            Some(off) if off <= allowed => {}
            Some(off) => {
                return fail("deviates", format!("event {k} is off by {off:e}, its twin by {grown:e}: {event:?}"));
            }
            // of events at one time, rounding may choose the first; a slight one has been passed over then
            None if is_tied(&plain.rows, k, allowed) => return Ok(()),
            None if it.is_none() => {
                return fail("missing", format!("{event:?} does not happen ({:?}, plain {:?})", scaled.end, plain.end));
            }
            None => return fail("differs", format!("event {k}: {event:?} became {it:?}")),
        }
    }
    if plain.end != scaled.end && twins.iter().all(|twin| twin.end == plain.end) {
        return fail("ends", format!("{:?} became {:?} after {} events", plain.end, scaled.end, plain.rows.len()));
    }
    Ok(())
}

fn is_tied(events: &[Contact], k: usize, allowed: f64) -> bool {
    let near = |j: usize| events.get(j).is_some_and(|other| (other.time - events[k].time).abs() <= allowed);
    near(k + 1) || (k > 0 && near(k - 1))
}
