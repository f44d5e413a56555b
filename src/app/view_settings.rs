//! What the user chose to look at: moves of the camera, selection, overlays.

use glam::DVec3;

use super::action::Direction;
use crate::{
    geometry::Bounds,
    view::{Overlays, ViewSettings, Views},
};

/// Share of the picture by which a press of a pan key moves.
const PAN: f64 = 0.1;

/// Factor by which a press of a zoom key magnifies.
pub(super) const ZOOM: f64 = 1.25;

/// Smallest and largest zoom: the scene as a dot, a sphere of a millimetre in a hall across the screen.
const ZOOMS: (f64, f64) = (1.0 / 64.0, 65536.0);

/// The sets of overlays in the order of the key.
const OVERLAYS: [(Overlays, &str); 6] = [
    (overlays(false, false, false, false), "none"),
    (overlays(true, false, false, false), "contacts"),
    (overlays(true, true, false, false), "contacts and normals"),
    (overlays(false, false, true, false), "velocities"),
    (overlays(false, false, false, true), "ids"),
    (overlays(true, true, true, true), "contacts, normals, velocities and ids"),
];

const fn overlays(contacts: bool, normals: bool, velocities: bool, ids: bool) -> Overlays {
    Overlays { contacts, normals, velocities, ids, impulses: false, forces: false, path: false, predicted: false }
}

/// Goes to the next set of overlays and says which; those that are shown by name only stay as they are.
pub(super) fn next_overlays(settings: &mut ViewSettings) -> String {
    let now = settings.overlays;
    let is = |set: &Overlays| {
        (set.contacts, set.normals, set.velocities, set.ids) == (now.contacts, now.normals, now.velocities, now.ids)
    };
    let at = OVERLAYS.iter().position(|(set, _)| is(set)).unwrap_or(0);
    let (set, name) = OVERLAYS[(at + 1) % OVERLAYS.len()];
    let Overlays { impulses, forces, path, predicted, .. } = now;
    settings.overlays = Overlays { impulses, forces, path, predicted, ..set };
    format!("Overlays: {name}.")
}

/// An overlay by its name.
type NamedOverlay = (&'static str, fn(&mut Overlays) -> &mut bool);

/// The overlays by name.
pub(super) const NAMED: [NamedOverlay; 8] = [
    ("contacts", |overlays| &mut overlays.contacts),
    ("normals", |overlays| &mut overlays.normals),
    ("velocities", |overlays| &mut overlays.velocities),
    ("ids", |overlays| &mut overlays.ids),
    ("impulses", |overlays| &mut overlays.impulses),
    ("forces", |overlays| &mut overlays.forces),
    ("path", |overlays| &mut overlays.path),
    ("predicted", |overlays| &mut overlays.predicted),
];

/// Shows or hides the overlays of these names, or all; says which are shown then.
///
/// # Errors
/// A sentence that names the first word that is none, or what there is.
pub(super) fn show(settings: &mut ViewSettings, words: &str, on: bool) -> Result<String, String> {
    let (names, order): (Vec<&str>, _) = (NAMED.map(|(name, _)| name).to_vec(), if on { "show" } else { "hide" });
    let words: Vec<&str> = words.split_whitespace().collect();
    if let Some(wrong) = words.iter().find(|word| **word != "all" && !names.contains(word)) {
        return Err(format!("{wrong} is not allowed: :{order} takes {}, or all.", names.join(", ")));
    }
    if words.is_empty() {
        return Err(format!(":{order} needs what to {order}: {}, or all.", names.join(", ")));
    }
    for (name, field) in NAMED {
        if words.contains(&name) || words.contains(&"all") {
            *field(&mut settings.overlays) = on;
        }
    }
    let shown = NAMED.iter().filter(|(_, field)| *field(&mut settings.overlays)).map(|(name, _)| *name);
    let shown: Vec<&str> = shown.collect();
    Ok(format!("Shown: {}.", if shown.is_empty() { "nothing but the spheres".into() } else { shown.join(", ") }))
}

/// Shows both views, the side view, the view from above, and round again.
pub(super) fn next_views(settings: &mut ViewSettings) {
    settings.views = match settings.views {
        Views::Both => Views::Side,
        Views::Side => Views::Top,
        Views::Top => Views::Both,
    };
}

/// Magnifies by `factor`; false if it is already at the end.
pub(super) fn zoom(settings: &mut ViewSettings, factor: f64) -> bool {
    let next = (settings.zoom * factor).clamp(ZOOMS.0, ZOOMS.1);
    let changed = next != settings.zoom;
    settings.zoom = next;
    changed
}

/// Moves the picture by a part of `span`, which is what it shows, m.
pub(super) fn pan(settings: &mut ViewSettings, direction: Direction, span: DVec3) {
    let step = span * PAN;
    let down = |sign: f64| match settings.views {
        Views::Side => DVec3::new(0.0, -sign, 0.0),
        Views::Top => DVec3::new(0.0, 0.0, sign),
        Views::Both => DVec3::new(0.0, -sign, sign),
    };
    settings.pan += step
        * match direction {
            Direction::Left => -DVec3::X,
            Direction::Right => DVec3::X,
            Direction::Down => down(1.0),
            Direction::Up => down(-1.0),
        };
}

/// Stops following: from the followed sphere's place `x`, m, the camera over `scene`'s view box goes on alone.
pub(super) fn let_go(settings: &mut ViewSettings, scene: &Bounds, x: Option<DVec3>) {
    if let Some(x) = x.filter(|_| settings.follow) {
        settings.pan = x - (scene.min + scene.max) * 0.5;
    }
    settings.follow = false;
}

/// Shows the whole scene, as at first; what is selected stays so.
pub(super) fn whole_scene(settings: &mut ViewSettings) {
    settings.zoom = 1.0;
    settings.pan = DVec3::ZERO;
    settings.follow = false;
}

/// Selects the next sphere of `count`, or the one before; after the last comes none.
pub(super) fn select(settings: &mut ViewSettings, count: usize, forward: bool) {
    let at = settings.selected.map_or(0, |i| i.min(count) + 1); // 0: none
    let next = if forward { at + 1 } else { at + count } % (count + 1);
    settings.selected = next.checked_sub(1);
    settings.follow &= settings.selected.is_some();
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settings() -> ViewSettings {
        ViewSettings { overlays: Overlays::default(), ..ViewSettings::default() }
    }

    #[test]
    fn selecting_goes_round_through_none_both_ways() {
        let mut settings = settings();
        let forward: Vec<_> = (0..4).map(|_| (select(&mut settings, 2, true), settings.selected).1).collect();
        assert_eq!(forward, [Some(0), Some(1), None, Some(0)]);
        let back: Vec<_> = (0..4).map(|_| (select(&mut settings, 2, false), settings.selected).1).collect();
        assert_eq!(back, [None, Some(1), Some(0), None]);
        select(&mut settings, 0, true);
        assert_eq!(settings.selected, None, "a scene without spheres");
    }

    #[test]
    fn down_is_down_the_screen_in_every_view_shown() {
        let span = DVec3::new(10.0, 20.0, 30.0);
        let mut settings = settings();
        pan(&mut settings, Direction::Down, span);
        assert_eq!(settings.pan, DVec3::new(0.0, -2.0, 3.0));
        settings.views = Views::Top;
        pan(&mut settings, Direction::Up, span);
        assert_eq!(settings.pan, DVec3::new(0.0, -2.0, 0.0));
    }

    #[test]
    fn a_camera_that_lets_go_of_a_sphere_stays_where_it_is() {
        let scene = Bounds { min: DVec3::ZERO, max: DVec3::splat(10.0) };
        let mut settings = ViewSettings { follow: true, selected: Some(0), ..settings() };
        let_go(&mut settings, &scene, Some(DVec3::new(8.0, 5.0, 5.0)));
        assert_eq!((settings.pan, settings.follow), (DVec3::new(3.0, 0.0, 0.0), false));
    }

    #[test]
    fn zoom_stops_at_its_ends() {
        let mut settings = settings();
        while zoom(&mut settings, ZOOM) {}
        assert_eq!(settings.zoom, ZOOMS.1);
        while zoom(&mut settings, 1.0 / ZOOM) {}
        assert_eq!(settings.zoom, ZOOMS.0);
    }
}
