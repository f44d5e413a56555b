//! The values that keys turn: tolerance, dt, speed. Bounded, and free of rounding noise after many turns.

use crate::physics::{Effect, knobs};
use crate::scene::{Method, Settings};

/// Finest and coarsest tolerance the keys reach, dimensionless: the resolution of f64, and the degree at which a
/// sphere's centre lies on the wall (larger values count as this).
const TOLERANCES: (f64, f64) = (1e-15, 0.5);

/// Shortest and longest dt the keys reach, s.
const STEPS: (f64, f64) = (1e-9, 10.0);

/// Slowest and fastest speed the keys reach, simulated seconds per second.
const SPEEDS: (f64, f64) = (1.0 / 65536.0, 65536.0);

/// `value` × `factor` within `range`; `None` if that is no change.
fn turned(value: f64, factor: f64, range: (f64, f64)) -> Option<f64> {
    let next = tidy((value * factor).clamp(range.0, range.1));
    // Exact values may lie outside the keys' range; a key must not jump against its own direction.
    let moves = if factor > 1.0 { next > value } else { next < value };
    moves.then_some(next)
}

/// The number rounded to twelve digits, so that ten times a tenth is one.
fn tidy(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

/// A tolerance finer or coarser by `factor`.
///
/// # Errors
/// A sentence, if there is none.
pub(super) fn tolerance(settings: Settings, factor: f64) -> Result<Settings, String> {
    let next = turned(settings.tolerance, factor, TOLERANCES);
    let tolerance = next.ok_or_else(|| edge("tolerance", settings.tolerance, factor, "tolerance 1e-17"))?;
    Ok(Settings { tolerance, ..settings })
}

/// A dt shorter or longer by `factor`.
///
/// # Errors
/// A sentence, if there is none.
pub(super) fn dt(settings: Settings, factor: f64) -> Result<Settings, String> {
    let dt = turned(settings.dt, factor, STEPS).ok_or_else(|| edge("dt", settings.dt, factor, "dt 1e-10"))?;
    Ok(Settings { dt, ..settings })
}

/// A speed lower or higher by `factor`.
///
/// # Errors
/// A sentence, if there is none.
pub(super) fn speed(wanted: f64, factor: f64) -> Result<f64, String> {
    turned(wanted, factor, SPEEDS).ok_or_else(|| edge("speed", wanted, factor, "speed 1e-6"))
}

fn edge(what: &str, value: f64, factor: f64, example: &str) -> String {
    let end = if factor > 1.0 { "larger" } else { "smaller" };
    format!("The keys take {what} no {end} than {value:e}; exact values: :{example}")
}

/// A sentence on a knob that was turned and that the method does not have; none if no such knob was.
pub(super) fn in_vain(before: Settings, after: Settings) -> Option<String> {
    let (knobs, method) = (knobs(after.method), after.method.name());
    if before.tolerance != after.tolerance && knobs.tolerance == Effect::Nothing {
        return Some(format!("{method} accepts no overlap: the tolerance changes nothing until the method changes."));
    }
    let frames = before.dt != after.dt && knobs.dt == Effect::Nothing;
    frames.then(|| format!("{method} has no time step: dt is only how long a frame lasts on the screen."))
}

/// The settings with the method that comes after theirs.
pub(super) fn next_method(settings: Settings) -> Settings {
    let at = Method::ALL.iter().position(|method| *method == settings.method).unwrap_or(0);
    Settings { method: Method::ALL[(at + 1) % Method::ALL.len()], ..settings }
}

/// `file`'s new settings, except where `current` was set otherwise than the file said `before`.
pub(super) fn reloaded(current: Settings, before: Settings, file: Settings) -> Settings {
    Settings {
        method: if current.method == before.method { file.method } else { current.method },
        dt: if current.dt == before.dt { file.dt } else { current.dt },
        tolerance: if current.tolerance == before.tolerance { file.tolerance } else { current.tolerance },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT: Settings = Settings { method: Method::Paper, dt: 0.01, tolerance: 1e-3 };

    #[test]
    fn turning_back_and_forth_ends_where_it_began() {
        let mut settings = AT;
        for _ in 0..12 {
            settings = tolerance(settings, 0.1).expect("down to 1e-15");
        }
        assert_eq!(settings.tolerance, 1e-15);
        assert!(tolerance(settings, 0.1).is_err());
        for _ in 0..12 {
            settings = tolerance(settings, 10.0).expect("and back");
        }
        assert_eq!(settings, AT);
    }

    #[test]
    fn a_knob_that_the_method_does_not_have_says_so() {
        let exact = Settings { method: Method::Exact, ..AT };
        let said = in_vain(exact, Settings { tolerance: 1e-6, ..exact }).expect("exact has no tolerance");
        assert!(said.contains("tolerance changes nothing"), "{said}");
        let said = in_vain(exact, Settings { dt: 0.1, ..exact }).expect("exact has no step");
        assert!(said.contains("no time step"), "{said}");
        assert_eq!(in_vain(exact, AT), None, "the method changed, no knob");
        assert_eq!(in_vain(AT, Settings { dt: 0.1, tolerance: 0.1, ..AT }), None, "paper has both");
        let swept = Settings { method: Method::Swept, ..AT };
        assert_eq!(in_vain(swept, Settings { dt: 0.1, ..swept }), None, "its dt costs");
    }

    #[test]
    fn no_key_turns_a_value_against_its_direction() {
        let zero = Settings { tolerance: 0.0, ..AT };
        assert!(tolerance(zero, 0.1).is_err());
        assert_eq!(tolerance(zero, 10.0).map(|s| s.tolerance), Ok(1e-15));
        assert!(dt(Settings { dt: 100.0, ..AT }, 2.0).is_err());
        assert_eq!(dt(Settings { dt: 100.0, ..AT }, 0.5).map(|s| s.dt), Ok(10.0));
        assert_eq!(speed(1.0, 2.0), Ok(2.0));
        assert!(speed(65536.0, 2.0).is_err());
    }

    #[test]
    fn a_reload_brings_the_files_new_values_but_keeps_what_was_set_by_hand() {
        let by_hand = Settings { dt: 0.005, ..AT };
        let file = Settings { dt: 0.1, tolerance: 1e-6, ..AT };
        assert_eq!(reloaded(by_hand, AT, file), Settings { dt: 0.005, tolerance: 1e-6, ..AT });
    }
}
