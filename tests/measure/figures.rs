//! The figure and the report of rows made by hand: the same bytes as stored.

use carom::export::TradeRow;
use carom::measure::{Axes, CostAxis, ErrorAxis, figure, report};
use carom::physics::Method;

fn row(method: &str, (dt, tolerance): (f64, f64), (error, cost): (f64, f64)) -> TradeRow {
    let used = |knob: f64| (knob > 0.0).then_some(knob);
    TradeRow {
        scene: "wedge <&> \"ball\"".into(),
        method: method.into(),
        dt: used(dt),
        tolerance: used(tolerance),
        until: 20.0,
        horizon: Some(7.8),
        certified: Some(7.8),
        floor: Some(2e-3),
        position_error: Some(error),
        impact_time_error: Some(error / 10.0),
        common_events: 18,
        energy_error: Some(error / 100.0),
        deepest_degree: tolerance,
        impacts: 22,
        evaluations: (20.0 / dt.max(0.1)) as u64,
        events: 25,
        frames: (20.0 / dt.max(1e-4)) as u64,
        cpu_per_s: Some(cost),
        cpu_median: Some(cost * 1.02),
        cpu_spread: Some(0.04),
        note: "horizon short".into(),
    }
}

/// A trade in round numbers: an order of error for an order of cost, one setting that is beaten, one that stalls.
fn rows() -> Vec<TradeRow> {
    let mut rows = vec![
        row("paper", (1e-1, 1e-3), (0.4, 2e-6)),
        row("paper", (1e-2, 1e-3), (0.04, 2e-5)),
        row("paper", (1e-2, 1e-5), (0.05, 3e-5)),
        row("paper", (1e-3, 1e-3), (0.004, 2e-4)),
        row("paper", (1e-4, 1e-3), (0.5, 2e-3)),
        row("exact", (0.0, 0.0), (0.0, 5e-6)),
    ];
    rows[4].note = "stalled at 10.3 s (resting-contact); horizon short".into();
    rows
}

#[test]
fn the_figure_is_the_stored_one() {
    let svg = figure(&rows(), &[Method::Paper], Axes::default(), "");
    insta::assert_snapshot!("figure", svg);
}

#[test]
fn the_report_is_the_stored_one() {
    insta::assert_snapshot!("report", report(&rows(), &[Method::Paper], &[], Axes::default()));
}

#[test]
fn the_figure_is_well_formed_and_brings_all_it_needs() {
    let svg = figure(&rows(), &[Method::Paper, Method::Exact], Axes::default(), "carom measure; a <machine>");
    let mut open: Vec<&str> = Vec::new();
    for tag in svg.split('<').skip(1) {
        let (tag, _) = tag.split_once('>').expect("a tag ends");
        let name = tag.split([' ', '/']).find(|name| !name.is_empty()).expect("a tag has a name");
        match (tag.starts_with('/'), tag.ends_with('/')) {
            (true, _) => assert_eq!(open.pop(), Some(name), "{tag}"),
            (false, false) => open.push(name),
            (false, true) => {}
        }
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
    }
    assert_eq!(open, [""; 0]);
    assert!(!svg.contains("href") && !svg.contains("url(") && !svg.contains("font-face"), "nothing from elsewhere");
    assert!(svg.len() < 20_000, "{} bytes", svg.len());
}

#[test]
fn nothing_to_show_is_still_a_figure() {
    assert!(figure(&[], Method::ALL, Axes::default(), "").ends_with("</svg>\n"));
    assert_eq!(report(&[], Method::ALL, &[], Axes::default()), "");
    let unknown = TradeRow { position_error: None, cpu_per_s: None, ..row("paper", (0.1, 0.1), (1.0, 1.0)) };
    assert!(report(std::slice::from_ref(&unknown), Method::ALL, &[], Axes::default()).contains("No setting"));
    assert!(figure(&[unknown], Method::ALL, Axes::default(), "").contains("wedge"));
}

#[test]
fn any_error_stands_over_any_cost() {
    for (word, x) in CostAxis::ALL {
        for (_, y) in ErrorAxis::ALL {
            let axes = Axes { x, y };
            let (svg, text) =
                (figure(&rows(), &[Method::Paper], axes, ""), report(&rows(), &[Method::Paper], &[], axes));
            assert!(svg.matches("<title>paper").count() == 5, "{word} {y:?}: {svg}");
            assert!(
                text.contains("Cheapest for") && text.lines().all(|line| line.chars().count() <= 80),
                "{word}: {text}"
            );
        }
    }
}

#[test]
fn settings_that_are_one_and_the_same_run_are_one_line_that_says_so() {
    let mut rows = rows();
    let mut same = rows[1].clone();
    same.tolerance = Some(1e-9);
    (same.cpu_per_s, same.cpu_spread) = (Some(5e-5), None);
    rows.insert(2, same);
    let text = report(&rows, &[Method::Paper], &[], Axes::default());
    assert!(text.contains("the very same run as with 1e-9"), "{text}");
    assert_eq!(
        text.lines().filter(|line| line.starts_with(['*', ' ']) && line.contains("paper  1e-2")).count(),
        2,
        "{text}"
    );
}
