//! Any way to look at a scene.

use carom::view::{Background, CardView, Colors, Ink, Inks, Marker, Overlays, ViewSettings, Views};
use glam::DVec3;
use proptest::prelude::*;

/// Colours as a user may choose them.
const INKS: Inks = Inks {
    heading: Some(Ink::Text),
    good: Some(Ink::Ansi(255)),
    notice: Some(Ink::Rgb(0, 0, 0)),
    alarm: None,
    velocity: Some(Ink::Ansi(0)),
    ghost: Some(Ink::Rgb(255, 0, 128)),
    normal: None,
    spheres: [Some(Ink::Ansi(3)), Some(Ink::Text), None, None, Some(Ink::Ansi(1)), None, None, None],
};

pub(crate) fn look() -> impl Strategy<Value = ViewSettings> {
    let number =
        prop_oneof![4 => -1e2..1e2, 1 => -1e12..1e12, 1 => Just(f64::NAN), 1 => Just(f64::INFINITY), 1 => Just(-1e300)];
    let zoom = prop_oneof![4 => (-6.0..6.0).prop_map(|power: f64| 10_f64.powf(power)), 1 => number.clone()];
    let views = prop_oneof![Just(Views::Both), Just(Views::Side), Just(Views::Top)];
    let marker = prop_oneof![Just(Marker::Braille), Just(Marker::Block), Just(Marker::Ascii)];
    let colors = prop_oneof![Just(Colors::Never), Just(Colors::Ansi16), Just(Colors::Ansi256), Just(Colors::Rgb)];
    let flags = proptest::collection::vec(any::<bool>(), 9);
    (views, zoom, [number.clone(), number.clone(), number], flags, proptest::option::of(0_usize..5), marker, colors)
        .prop_map(|(views, zoom, pan, flags, selected, marker, colors)| ViewSettings {
            views,
            zoom,
            pan: DVec3::from_array(pan),
            follow: flags[0],
            selected,
            overlays: Overlays {
                contacts: flags[1],
                normals: flags[2],
                velocities: flags[3],
                ids: flags[4],
                impulses: flags[2],
                forces: flags[3],
                path: flags[4],
                predicted: flags[1],
            },
            inspector: Some(flags[5]),
            card: flags[4].then(|| CardView { cursor: 1, scroll: 3, probe: flags[1].then_some(2) }),
            ghost: flags[6],
            marker,
            colors,
            background: if flags[7] { Background::Light } else { Background::Dark },
            inks: if flags[8] { INKS } else { Inks::default() },
        })
}
