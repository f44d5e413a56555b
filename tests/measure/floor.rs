//! The yardstick's own error in `measure`: the floor below which no figure means anything, and the horizon that follows from it.

use carom::measure::{Axes, Reference, Rung, Subject, figure, report};
use carom::physics::Method;
use carom::scene;

use crate::ON;

fn subject(name: &str, asked: f64) -> Subject {
    Subject::asking(name, scene::open(name).expect("built in").scene, asked, ON).expect("it is not interrupted")
}

#[test]
fn the_horizon_is_where_the_certified_error_leaves_what_is_asked() {
    // paper-3 is certified to 1.7e-10 m at 20 s, though a displacement grows by 1e6 within 11 s; photon's error is 1e-4 m at 10 s.
    let whole = subject("paper-3", 1e-6).reference;
    assert_eq!((whole.horizon.time, whole.meaningful()), (None, 20.0));
    let own = whole.own.expect("a certificate");
    assert!(own.until == 20.0 && own.error > 1e-11 && own.error < 1e-9, "{own:?}");
    let horizons =
        [1e-12, 1e-8, 1e-4].map(|asked| subject("photon", asked).reference.own.expect("a certificate").until);
    assert!(horizons[0] < horizons[1] && horizons[1] < horizons[2], "{horizons:?}");
}

#[test]
fn a_setting_nearer_to_exact_than_exact_is_to_the_truth_is_told() {
    let subject = subject("paper-3", 1e-6);
    let rows = [1e-3, 1e-12].map(|tolerance| {
        let rung = Rung { method: Method::Swept, dt: Some(0.1), tolerance: Some(tolerance) };
        subject.measure(rung, ON).expect("it is not interrupted")
    });
    let below = rows.each_ref().map(|row| row.note.to_string().contains("below the yardstick's own error"));
    let floor = rows[0].floor.expect("a floor");
    let expected = rows.each_ref().map(|row| row.position_error.is_some_and(|error| error > 0.0 && error < floor));
    assert_eq!(below, expected, "{rows:?}");
    assert!(!below[0], "a tolerance of 1e-3 is far above: {rows:?}");
    let text = report(&rows, &[Method::Swept], &[], Axes::default());
    assert!(text.contains("exact itself is off by") && text.contains("-: exact's own error"), "{text}");
    assert!(figure(&rows, &[Method::Swept], Axes::default(), "").contains("exact's own error"));
}

#[test]
fn a_reference_without_a_certificate_has_no_floor() {
    let scene = scene::open("paper-0").expect("built in").scene;
    let plain = Reference::of(&scene, 2.0, carom::measure::Budget::REFERENCE, ON).expect("it is not interrupted");
    assert_eq!(plain.own, None);
}
