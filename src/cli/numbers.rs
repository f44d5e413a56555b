//! The ranges of the numbers on the command line. clap puts the option and the offending value in front of each message.

/// A time or length of time that must move the clock: finite, > 0 (s).
pub(super) fn positive(text: &str) -> Result<f64, String> {
    number(text).filter(|value| value.is_finite() && *value > 0.0).ok_or("must be a finite number above 0".to_string())
}

/// A time, tolerance or other amount: finite, ≥ 0.
pub(super) fn not_negative(text: &str) -> Result<f64, String> {
    number(text).filter(|value| value.is_finite() && *value >= 0.0).ok_or("must be a finite number, 0 or more".into())
}

/// A number of things of which there must be one at least.
pub(super) fn count(text: &str) -> Result<usize, String> {
    text.parse().ok().filter(|count| *count > 0).ok_or("must be a whole number from 1".into())
}

/// Largest screen that `render` draws, cells: a thousand columns and five hundred rows, some ten megabytes of SVG.
const LARGEST: (u16, u16) = (1000, 500);

/// A screen size `WxH`, cells.
pub(super) fn size(text: &str) -> Result<(u16, u16), String> {
    let whole = |part: &str| part.parse::<u16>().ok();
    let parsed = text.split_once('x').and_then(|(w, h)| Some((whole(w)?, whole(h)?)));
    parsed
        .filter(|(w, h)| *w <= LARGEST.0 && *h <= LARGEST.1)
        .ok_or(format!("must be COLUMNSxROWS, such as 80x24, up to {}x{}", LARGEST.0, LARGEST.1))
}

/// −0 is taken as 0, so that no sign of it can reach a result.
fn number(text: &str) -> Option<f64> {
    text.parse().ok().map(|value: f64| value + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hold_at_their_ends() {
        assert_eq!(positive("5e-324"), Ok(5e-324));
        assert_eq!(not_negative("0"), Ok(0.0));
        assert_eq!(not_negative("-0").map(f64::to_bits), Ok(0), "minus zero is zero");
        for refused in ["0", "-1", "nan", "inf", "-inf", "1e999", "", " 1", "1 s", "0x10", "1_000"] {
            assert!(positive(refused).is_err(), "{refused:?} is no positive number");
        }
        for refused in ["-5e-324", "NaN", "infinity", "one"] {
            assert!(not_negative(refused).is_err(), "{refused:?} is no number from 0");
        }
    }

    #[test]
    fn sizes_are_columns_by_rows() {
        assert_eq!(size("80x24"), Ok((80, 24)));
        assert_eq!(size("0x0"), Ok((0, 0)));
        assert_eq!(size("1000x500"), Ok((1000, 500)));
        for refused in ["80", "80x", "x24", "80X24", "1001x24", "80x501", "-1x5", "80x24x1", "99999x1", "8 0x24"] {
            assert!(size(refused).is_err(), "{refused:?} is no size");
        }
    }
}
