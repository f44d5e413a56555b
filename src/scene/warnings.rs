//! What is allowed in a scene, but probably not meant.

use super::validated::{Method, Scene, Settings, Sphere};
use crate::format::{amount, rounded};
use crate::geometry::Bounds;

/// Spacings of the numbers around a coordinate that a radius should hold at least: fewer, and the gap is mostly rounding.
const RESOLVED: f64 = 1e6;

/// More frames than a user waits for: at a nanosecond each, a quarter of an hour.
const FRAMES: f64 = 1e12;

/// Durations of a scene that a run without frames may last before it is warned of: at a microsecond each, a quarter of
/// an hour.
const DURATIONS: f64 = 1e9;

/// Sentences on what is allowed in the scene, solved with `settings` up to `until` (s), but probably not meant; none for
/// most scenes.
pub fn warnings(scene: &Scene, settings: Settings, until: f64) -> Vec<String> {
    let of_the_scene = [restitution(scene), empty(scene), outside_view(scene), outside_walls(scene), rounding(scene)];
    let of_the_settings = [tunnels(scene, settings), endless(scene, settings, until)];
    of_the_scene.into_iter().chain(of_the_settings).flatten().collect()
}

fn restitution(scene: &Scene) -> Option<String> {
    let law = &scene.contact;
    let elastic =
        law.wall_restitution == 1.0 && !scene.walls.is_empty() || law.restitution == 1.0 && scene.spheres.len() > 1;
    (elastic && law.rest_speed > 0.0).then(|| {
        let speed = rounded(law.rest_speed);
        format!(
            "restitution is 1 but rest_speed is {speed} m/s: slow impacts rest and lose energy; set rest_speed to 0"
        )
    })
}

fn empty(scene: &Scene) -> Option<String> {
    scene.spheres.is_empty().then(|| "the scene has no spheres: nothing will move".to_owned())
}

fn outside_view(scene: &Scene) -> Option<String> {
    let unseen = |sphere: &Sphere| !scene.view.touches(&Bounds::around(sphere.x, sphere.radius));
    counted(scene, unseen).map(|spheres| format!("{spheres} outside the view box and can't be seen at first"))
}

fn outside_walls(scene: &Scene) -> Option<String> {
    let walls = Bounds::of(scene.walls.iter().map(|wall| wall.shape.bounds()))?;
    // Flat boxes (a single floor) enclose nothing.
    let closed = scene.walls.len() >= 6 && walls.size().min_element() > 0.0;
    let outside = |sphere: &Sphere| closed && !walls.contains(sphere.x);
    counted(scene, outside).map(|spheres| format!("{spheres} outside the box of all walls"))
}

/// What must be said of a run to `until` (s) that will not end in any time a user waits.
pub fn endless(scene: &Scene, Settings { method, dt, .. }: Settings, until: f64) -> Option<String> {
    let end = rounded(until);
    if method == Method::Exact {
        let times = until / scene.duration;
        let long = scene.duration > 0.0 && times > DURATIONS;
        return long.then(|| {
            let times = amount(times);
            format!("{end} s are {times} times the scene's duration: if it never rests, nobody will see the end")
        });
    }
    let frames = until / dt;
    (frames > FRAMES).then(|| {
        let (frames, dt) = (amount(frames), rounded(dt));
        format!("{end} s take {frames} frames of {dt} s: nobody will see the end; raise dt or end sooner")
    })
}

fn tunnels(scene: &Scene, Settings { method, dt, .. }: Settings) -> Option<String> {
    let jumps = |sphere: &Sphere| method == Method::Paper && sphere.v.length() * dt > 2.0 * sphere.radius;
    counted(scene, jumps).map(|spheres| {
        let dt = rounded(dt);
        format!("{spheres} so fast that it crosses more than its diameter in a step of {dt} s: `paper` may miss its contacts; lower dt")
    })
}

fn rounding(scene: &Scene) -> Option<String> {
    let lost = |sphere: &Sphere| sphere.x.abs().max_element() * f64::EPSILON * RESOLVED > sphere.radius;
    counted(scene, lost)
        .map(|spheres| format!("{spheres} so far from the origin for its radius that rounding moves it visibly"))
}

/// The spheres for which something holds, as the beginning of a sentence.
fn counted(scene: &Scene, holds: impl Fn(&Sphere) -> bool) -> Option<String> {
    let mut found = scene.spheres.iter().enumerate().filter(|(_, sphere)| holds(sphere));
    let (first, _) = found.next()?;
    Some(match found.count() {
        0 => format!("sphere {first} is"),
        others => format!("sphere {first} (and {others} more) is"),
    })
}
