//! Does the screen show what it should, at every size, and nothing where it should not?

use std::sync::Arc;

use carom::{
    physics::Simulation,
    scene,
    snapshot::{Class, Snapshot, Stage},
    view::{self, Colors, Marker, Overlays, Popup, Screen, ViewSettings, Views},
};
use glam::{DVec3, dvec3};
use proptest::{prelude::*, test_runner::RngSeed};
use ratatui::{
    buffer::{Buffer, Cell},
    layout::{Position, Rect},
    style::Color,
};

#[path = "screens/alarm.rs"]
mod alarm;
#[path = "screens/app.rs"]
mod app;
#[path = "screens/bounds.rs"]
mod bounds;
#[path = "screens/card.rs"]
mod card;
#[path = "screens/card_keys.rs"]
mod card_keys;
#[path = "screens/comparison.rs"]
mod comparison;
#[path = "screens/depth.rs"]
mod depth;
#[path = "screens/drawn.rs"]
mod drawn;
#[path = "screens/emulators.rs"]
mod emulators;
#[path = "screens/frames.rs"]
mod frames;
#[path = "screens/history.rs"]
mod history;
#[path = "screens/inspected.rs"]
mod inspected;
#[path = "screens/keymap.rs"]
mod keymap;
#[path = "screens/log.rs"]
mod log;
#[path = "screens/look.rs"]
mod look;
#[path = "screens/many.rs"]
mod many;
#[path = "screens/mouse.rs"]
mod mouse;
#[path = "screens/projections.rs"]
mod projections;
#[path = "screens/recorded.rs"]
mod recorded;
#[path = "support/stages.rs"]
mod stages;
#[path = "screens/taken.rs"]
mod taken;

use look::look;
use stages::Scene;

const KEYS: &[(&str, &str)] = &[
    ("space p", "pause, run"),
    (". n →", "step one frame"),
    (", N ←", "step back one frame"),
    ("c / C", "to the next, previous collision"),
    ("g / G", "start, newest of the history"),
    ("+ - =", "speed up, down, real time"),
    ("[ ]", "previous, next scene"),
    ("t / T", "tolerance ÷10, ×10"),
    ("h j k l, ⇧arrows", "pan"),
    ("d", "overlays: contacts, normals, velocities, ids"),
    (":", "exact values: :dt 1e-3 :tolerance 1e-9 :goto 3.25"),
    ("q Ctrl-C", "quit"),
    ("Esc", "closes what is open, never quits"),
];

const SCENES: &[(&str, &str)] = &[
    ("paper-0", "One sphere dropped into a room"),
    ("paper-1", "One sphere and an inclined wall"),
    ("newton", "Five spheres that touch each other in a row; the momentum of the first passes through all to the last"),
    ("大きな箱", "A wide name is aligned by its width"),
];

fn help(scroll: usize) -> Popup<'static> {
    Popup::Help { rows: KEYS, scroll }
}

fn list(filter: &'static str, filtering: bool, cursor: usize) -> Popup<'static> {
    Popup::Scenes { filter, filtering, entries: SCENES, cursor }
}

fn prompt(text: &str) -> Popup<'_> {
    Popup::Prompt { text, cursor: text.len(), offers: "" }
}

fn draw(screen: &Screen, width: u16, height: u16) -> Buffer {
    let area = Rect::new(0, 0, width, height);
    let mut buffer = Buffer::empty(area);
    view::draw(screen, area, &mut buffer);
    buffer
}

fn text(scene: &Scene, width: u16, height: u16) -> String {
    carom::frame::text(&draw(&scene.screen(), width, height))
}

/// Stores the frame, characters and styles, at the four sizes.
fn store(name: &str, screen: &Screen) {
    for (width, height) in [(80, 24), (120, 40), (40, 12), (1, 1)] {
        insta::assert_debug_snapshot!(format!("{name} {width}x{height}"), draw(screen, width, height));
    }
}

#[test]
fn a_sphere_over_the_floor_looks_as_stored() {
    store("drop", &stages::drop().screen());
}

#[test]
fn an_impact_in_a_wedge_looks_as_stored() {
    store("wedge", &stages::wedge().screen());
}

#[test]
fn a_pile_with_every_overlay_looks_as_stored() {
    store("pile", &stages::pile().screen());
}

#[test]
fn a_stalled_run_looks_as_stored() {
    store("stalled", &stages::stalled().screen());
}

#[test]
fn a_run_beside_the_exact_one_looks_as_stored() {
    store("strayed", &stages::strayed().screen());
}

#[test]
fn a_gas_looks_as_stored() {
    store("gas", &stages::gas(60).screen());
}

#[test]
fn the_help_looks_as_stored() {
    let scene = stages::drop();
    store("help", &Screen { popup: help(2), ..scene.screen() });
}

#[test]
fn the_scene_list_looks_as_stored() {
    let scene = stages::drop();
    store("list", &Screen { popup: list("a", true, 2), ..scene.screen() });
}

#[test]
fn the_prompt_and_news_look_as_stored() {
    let scene = stages::drop();
    store("prompt", &Screen { popup: prompt("tolerance 1e-9"), ..scene.screen() });
    store("message", &Screen { message: Some("tolerance 1e-9 from here"), ..scene.screen() });
}

#[test]
fn the_inspector_in_place_of_the_side_view_looks_as_stored() {
    let mut scene = stages::wedge();
    scene.view_settings.inspector = Some(true);
    store("inspector", &scene.screen());
    scene.view_settings.inspector = Some(false);
    insta::assert_debug_snapshot!("no inspector 110x30", draw(&scene.screen(), 110, 30));
}

/// A built-in scene as it begins.
fn built_in(name: &str) -> Scene {
    let opened = scene::open(name).expect("built in");
    let sim = Simulation::new(&opened.scene, opened.scene.solver);
    let stage = Arc::new(Stage::of(&opened.key, &opened.scene));
    let mut scene = stages::drop();
    scene.snapshot = Snapshot::of(&stage, &sim, None);
    scene
}

#[test]
fn a_built_in_scene_looks_as_stored() {
    store("paper-2", &built_in("paper-2").screen());
}

#[test]
fn every_built_in_scene_is_drawn_within_every_size() {
    for builtin in scene::builtin::ALL {
        let scene = built_in(builtin.name);
        for (width, height) in [(0, 0), (1, 1), (12, 3), (30, 8), (40, 12), (60, 16), (80, 24), (120, 40), (200, 60)] {
            assert_stays_within(&scene.screen(), width, height);
        }
        let frame = text(&scene, 80, 24);
        let dots = frame.chars().filter(|c| ('\u{2801}'..='\u{28FF}').contains(c)).count();
        assert!(dots > 20, "{} shows next to nothing:\n{frame}", builtin.name);
    }
}

#[test]
fn blocks_and_ascii_look_as_stored() {
    for (name, marker) in [("block", Marker::Block), ("ascii", Marker::Ascii)] {
        let mut scene = stages::wedge();
        scene.view_settings.marker = marker;
        insta::assert_debug_snapshot!(name, draw(&scene.screen(), 80, 24));
    }
}

#[test]
fn scene_colours_look_as_stored() {
    for (name, colors) in
        [("256 colours", Colors::Ansi256), ("24-bit colours", Colors::Rgb), ("no colours", Colors::Never)]
    {
        let mut scene = stages::wedge();
        scene.view_settings.colors = colors;
        insta::assert_debug_snapshot!(name, draw(&scene.screen(), 80, 24));
    }
}

/// Every scene with every popup.
fn everything(mut check: impl FnMut(&Screen)) {
    let mut hostile = hostile(3);
    for marker in [Marker::Braille, Marker::Ascii] {
        let scenes =
            [stages::drop(), stages::wedge(), stages::pile(), stages::stalled(), stages::gas(9), hostile.clone()];
        for mut scene in scenes {
            scene.view_settings.marker = marker;
            for popup in [Popup::None, help(0), help(99), list("é", true, 3), list("", false, 0), prompt("dt 1e-3é")]
            {
                check(&Screen { popup, ..scene.screen() });
            }
            check(&Screen { message: Some("Wrote état.svg → here"), ..scene.screen() });
        }
    }
    hostile.view_settings.inspector = Some(true);
    check(&hostile.screen());
}

/// A scene that breaks every expectation a drawing could have.
fn hostile(seed: usize) -> Scene {
    let values = [f64::NAN, f64::INFINITY, -1e300, 1e9, 0.0, -0.0, 5e-324, f64::NEG_INFINITY, 1.0];
    let value = |i: usize| values[(i * 7 + seed) % values.len()];
    let vector = |i: usize| dvec3(value(i), value(i + 1), value(i + 3));
    let mut scene =
        stages::scene("名前\u{202e}é́👩‍👩‍👧‍👦", &[(vector(0), vector(1)), (vector(2), vector(3)), (DVec3::ONE, vector(4))]);
    stages::edit(&mut scene, |stage| {
        stage.radii = vec![value(1), 1e12, value(2)];
        stage.masses = vec![value(5)];
        stage.colors = vec![Some([value(1), 0.5, 2.0])];
        stage.names = vec![Some("a name of many words and 長い名前 without end".repeat(9))];
        stage
            .walls
            .extend((0..9).map(|i| stages::wall(vector(i), vector(i + 1), vector(i + 2), Some([value(i), 0.1, -1.0]))));
        stage.duration = value(4);
        if seed.is_multiple_of(2) {
            (stage.view.min, stage.view.max) = (vector(5), vector(6));
        }
    });
    let snapshot = &mut scene.snapshot;
    (snapshot.t, snapshot.dt, snapshot.tolerance, snapshot.energy) = (value(6), value(7), value(8), value(0));
    snapshot.contacts = [Class::Collide, Class::Rest, Class::Leave, Class::Release]
        .map(|class| stages::contact(carom::snapshot::Kind::Pair, 1, usize::MAX, class))
        .map(|contact| carom::snapshot::Contact {
            point: vector(seed),
            normal: vector(seed + 1),
            degree: value(3),
            ..contact
        })
        .to_vec();
    snapshot.tallies.impacts = u64::MAX;
    snapshot.stall = Some("Averylongwordthatdoesnotfitanywhereatall ".repeat(5) + "また");
    (scene.ticks.span, scene.ticks.impacts) = (value(seed), vec![u32::MAX; seed]);
    (scene.pace.wanted, scene.pace.reached) = (value(1), Some(value(2)));
    scene.view_settings.selected = Some(if seed.is_multiple_of(3) { usize::MAX } else { 1 });
    scene.view_settings.overlays =
        Overlays { contacts: true, normals: true, velocities: true, ids: true, ..Overlays::default() };
    scene
}

#[test]
fn every_size_up_to_forty_by_twenty_is_drawn_within_it() {
    for scene in [stages::stalled(), hostile(3)] {
        for popup in [Popup::None, help(2), list("é", true, 3), prompt("dt 1e-3é")] {
            let screen = Screen { popup, ..scene.screen() };
            for (width, height) in (0..=40).flat_map(|width| (0..=20).map(move |height| (width, height))) {
                assert_stays_within(&screen, width, height);
            }
        }
    }
}

#[test]
fn sizes_up_to_two_hundred_by_sixty_are_drawn_within_them() {
    everything(|screen| {
        for width in [1, 12, 29, 41, 59, 60, 80, 109, 110, 157, 200, 300] {
            for height in [0, 2, 3, 7, 8, 11, 15, 16, 24, 60, 100] {
                assert_stays_within(screen, width, height);
            }
        }
    });
}

/// Draws into the middle of a larger buffer and checks its rim; also into a buffer smaller than the area.
fn assert_stays_within(screen: &Screen, width: u16, height: u16) {
    let rim = Cell::new("%");
    let mut buffer = Buffer::filled(Rect::new(0, 0, width + 4, height + 2), rim.clone());
    let area = Rect::new(2, 1, width, height);
    view::draw(screen, area, &mut buffer);
    for y in 0..height + 2 {
        for x in 0..width + 4 {
            if !area.contains(Position::new(x, y)) {
                assert_eq!(buffer[(x, y)], rim, "column {x}, row {y} of {width}x{height}");
            }
        }
    }
    view::draw(screen, Rect::new(1, 1, width + 9, height + 9), &mut buffer);
    let cursor = view::cursor(screen, area);
    assert!(cursor.is_none_or(|cursor| area.contains(cursor)), "{cursor:?} of {width}x{height}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, rng_seed: RngSeed::Fixed(2), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_look_at_any_scene_is_drawn_within_any_size(look in look(), seed in 0_usize..12, width in 0_u16..=200, height in 0_u16..=60) {
        let mut scene = if seed < 9 { hostile(seed) } else { stages::pile() };
        scene.comparison = stages::strayed().comparison;
        scene.view_settings = look;
        assert_stays_within(&scene.screen(), width, height);
        let span = view::visible_span(&scene.view_settings, &scene.snapshot.stage, Rect::new(0, 0, width, height));
        prop_assert!(seed < 9 || span.min_element() > 0.0, "{span}");
    }
}

#[test]
fn the_ascii_marker_means_ascii_everywhere() {
    everything(|screen| {
        if screen.view_settings.marker != Marker::Ascii {
            return;
        }
        for (width, height) in [(200, 60), (120, 40), (80, 24), (40, 12), (25, 7), (5, 2)] {
            let buffer = draw(screen, width, height);
            let strange = buffer.content().iter().find(|cell| !cell.symbol().is_ascii());
            assert_eq!(strange, None, "at {width}x{height}");
        }
    });
}

#[test]
fn without_colours_no_cell_has_one() {
    everything(|screen| {
        let look = ViewSettings { colors: Colors::Never, ..screen.view_settings.clone() };
        let buffer = draw(&Screen { view_settings: &look, ..*screen }, 120, 40);
        assert!(buffer.content().iter().all(|cell| cell.fg == Color::Reset && cell.bg == Color::Reset));
    });
}

#[test]
fn sixteen_colours_are_the_terminals_own() {
    everything(|screen| {
        let buffer = draw(screen, 120, 40);
        let foreign = |color: Color| matches!(color, Color::Indexed(_) | Color::Rgb(..));
        assert!(!buffer.content().iter().any(|cell| foreign(cell.fg) || foreign(cell.bg)));
    });
}

#[test]
fn what_a_sphere_does_shows_without_colours() {
    // At 80×24 a sphere of 0.5 m has a radius of 3.75 dots; one of 0.05 m is tiny; one of 2 m is hatched.
    for radius in [0.05, 0.5, 2.0] {
        let frames = [None, Some(Class::Rest), Some(Class::Collide)].map(|class| {
            let mut scene = stages::scene("states", &[(dvec3(0.3, 5.2, 0.1), DVec3::ZERO)]);
            stages::edit(&mut scene, |stage| stage.radii[0] = radius);
            scene.snapshot.contacts =
                class.map(|class| stages::contact(carom::snapshot::Kind::Wall, 0, 0, class)).into_iter().collect();
            (scene.view_settings.colors, scene.view_settings.overlays) = (Colors::Never, Overlays::default());
            let free = text(&scene, 80, 24);
            scene.view_settings.selected = Some(0);
            (free, text(&scene, 80, 24))
        });
        let mut all: Vec<&String> = frames.iter().flat_map(|(free, selected)| [free, selected]).collect();
        all.sort();
        all.dedup();
        assert_eq!(all.len(), 6, "radius {radius}: two states look the same:\n{all:#?}");
    }
}

#[test]
fn numbers_of_a_running_scene_keep_their_columns() {
    let mut scene = stages::wedge();
    scene.view_settings.marker = Marker::Ascii; // one byte a column
    let fields = |scene: &Scene| {
        let row = text(scene, 120, 40).lines().next().expect("a status row").to_string();
        ["speed", "paper ", "dt", "tol", "E ", "impacts"].map(|field| row.find(field))
    };
    let before = fields(&scene);
    assert!(before.iter().all(Option::is_some));
    for (t, energy, impacts) in
        [(0.0, 221.2, 0), (9.999, 9.5, 7), (10.0, -0.001, 999), (19.99, 1e-9, 12_345), (20.0, 0.0, 99)]
    {
        (scene.snapshot.t, scene.snapshot.energy, scene.snapshot.tallies.impacts) = (t, energy, impacts);
        for reached in [None, Some(0.0), Some(0.25), Some(9.99)] {
            scene.pace.reached = reached;
            assert_eq!(fields(&scene), before, "t {t}, reached {reached:?}");
        }
    }
}

#[test]
fn a_stall_says_why_at_every_size_with_a_picture() {
    for (width, height) in [(30, 8), (40, 12), (60, 16), (80, 24), (120, 40), (200, 60)] {
        let frame = text(&stages::stalled(), width, height);
        let words: Vec<&str> = frame.split_whitespace().collect();
        assert!(frame.contains("STALL") && words.contains(&"bisection"), "{width}x{height}:\n{frame}");
    }
}

#[test]
fn long_names_end_in_an_ellipsis_and_wide_ones_are_not_split() {
    let mut scene = stages::drop();
    stages::edit(&mut scene, |stage| stage.key = "とても長い名前のとても長い名前".into());
    let frame = text(&scene, 60, 16);
    let row = frame.lines().next().expect("a status row");
    assert!(row.contains('…'), "{row}");
    assert!(row.contains("t  0.000 s"), "{row}");
}

#[test]
fn the_help_can_be_scrolled_to_its_last_row_and_no_further() {
    let scene = stages::drop();
    let area = Rect::new(0, 0, 40, 12);
    let limit = view::help_scroll_limit(KEYS, &scene.view_settings, area);
    let last = |scroll| carom::frame::text(&draw(&Screen { popup: help(scroll), ..scene.screen() }, 40, 12));
    assert!(limit > 0 && last(limit).contains("nowhere"), "{}", last(limit));
    assert!(!last(limit - 1).contains("nowhere"), "{}", last(limit - 1));
    assert_eq!(last(limit), last(limit + 5));
    let rows: String = (0..=limit).map(last).collect();
    assert!(rows.contains("quits") && rows.contains("ball"), "keys and signs: {rows}");
}

#[test]
fn one_tenth_of_the_visible_span_is_four_columns_of_a_forty_column_view() {
    let scene = stages::drop();
    let span = view::visible_span(&scene.view_settings, &scene.snapshot.stage, Rect::new(0, 0, 80, 24));
    // 75 of 80 dots show the 10 m of the room: one dot is what lies between the first and the last, two are its margins.
    assert!((span.x - 10.0 * 80.0 / 75.0).abs() < 1e-12, "{span}");
    let zoomed = ViewSettings { zoom: 4.0, ..scene.view_settings.clone() };
    assert_eq!(view::visible_span(&zoomed, &scene.snapshot.stage, Rect::new(0, 0, 80, 24)), span / 4.0);
}
