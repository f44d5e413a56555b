//! Nearer spheres hide farther ones, and flat scenes stack the two views.

use glam::{DVec3, dvec3};
use ratatui::{buffer::Buffer, layout::Rect};

use super::{built_in, draw, stages, store};

/// The rows of one view's dots: the left half of the screen is the side view, the right half the top-down view.
fn half(buffer: &Buffer, right: bool) -> Vec<String> {
    let columns = if right { 41..80 } else { 0..39 };
    let row = |y: u16| columns.clone().map(|x| buffer[(x, y)].symbol()).collect();
    (2..22).map(row).collect()
}

/// Spheres at rest in the room, seen at 80×24.
fn seen(spheres: &[(DVec3, f64)], selected: Option<usize>) -> Buffer {
    let at_rest: Vec<(DVec3, DVec3)> = spheres.iter().map(|(x, _)| (*x, DVec3::ZERO)).collect();
    let mut scene = stages::scene("depth", &at_rest);
    stages::edit(&mut scene, |stage| stage.radii = spheres.iter().map(|(_, r)| *r).collect());
    scene.view_settings.selected = selected;
    draw(&scene.screen(), 80, 24)
}

#[test]
fn a_sphere_behind_a_larger_one_is_seen_from_above_only() {
    // One looks from +z: the small one stands behind, at the same x and y.
    let (near, far) = ((dvec3(0.0, 5.0, 1.0), 1.5), (dvec3(0.0, 5.0, -1.5), 0.8));
    let (alone, both, turned) = (seen(&[near], None), seen(&[near, far], None), seen(&[far, near], None));
    assert_eq!(half(&alone, false), half(&both, false), "hidden");
    assert_eq!(half(&both, false), half(&turned, false), "whichever comes first in the file");
    assert_ne!(half(&alone, true), half(&both, true), "both from above");
    let selected = seen(&[near, far], Some(1));
    assert_ne!(half(&selected, false), half(&both, false), "the selected one is never hidden");
}

#[test]
fn a_nearer_sphere_hides_only_what_it_covers() {
    let (near, beside) = ((dvec3(0.0, 5.0, 1.0), 1.0), (dvec3(1.2, 5.0, -1.0), 1.0));
    let (one, two) = (half(&seen(&[near], None), false), half(&seen(&[beside], None), false));
    let both = half(&seen(&[near, beside], None), false);
    let dots = |rows: &[String]| -> u32 {
        let masks = rows.iter().flat_map(|row| row.chars()).filter(|c| ('\u{2800}'..='\u{28ff}').contains(c));
        masks.map(|c| (c as u32 - 0x2800).count_ones()).sum()
    };
    assert!(dots(&both) > dots(&one) && dots(&both) < dots(&one) + dots(&two), "a part of the far one is seen");
}

#[test]
fn a_flat_scene_stacks_its_views_where_that_draws_it_larger() {
    store("stacked", &built_in("billiard").screen());
    let (flat, cube) = (built_in("billiard"), built_in("paper-0"));
    let labels = |buffer: &Buffer| -> Vec<u16> {
        let label = |y: &u16| buffer[(1, *y)].symbol() == "t" && buffer[(2, *y)].symbol() == "o";
        (0..buffer.area.height).filter(label).collect()
    };
    assert_eq!(labels(&draw(&flat.screen(), 80, 40)).len(), 1, "the top-down view's label begins a row further down");
    assert_eq!(labels(&draw(&cube.screen(), 80, 40)).len(), 0, "a cube is seen side by side");
    assert_eq!(draw(&flat.screen(), 80, 40).area, Rect::new(0, 0, 80, 40));
}
