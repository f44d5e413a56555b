//! Numbers in words: every way in which a number is written for a reader, on the screen, in a report or in a message.
//! (Tables for programs have shortest digits that read back; `export` writes them.)

/// A number in a message: the shortest digits that read back, with an exponent where a row of zeros would stand.
pub fn number(value: f64) -> String {
    let plain = value == 0.0 || !value.is_finite() || (1e-5..1e16).contains(&value.abs());
    if plain { format!("{value}") } else { format!("{value:e}") }
}

/// A measured number in a message, to four digits.
pub fn rounded(value: f64) -> String {
    let text = format!("{value:.3e}");
    text.parse().ok().filter(|value: &f64| value.is_finite()).map_or(text, number)
}

/// A number of things, however many: to four digits, and in words where it is beyond all numbers.
pub fn amount(things: f64) -> String {
    match things {
        f64::INFINITY => "more than 1e308".into(),
        things if things < 1e6 => format!("{things}"),
        things => format!("{:e}", format!("{things:.3e}").parse().unwrap_or(things)),
    }
}

/// `1 wall`, `2 walls`.
pub fn counted(count: impl TryInto<u64>, noun: &str) -> String {
    match count.try_into().unwrap_or(u64::MAX) {
        1 => format!("1 {noun}"),
        count => format!("{count} {noun}s"),
    }
}

/// A number to be heard: three decimals, or three significant digits where three decimals would say nothing.
pub fn spoken(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e9).contains(&size) {
        return format!("{value:.2e}");
    }
    trimmed(&format!("{value:.3}")).into()
}

/// A figure with its power of ten and so many digits after the first, or 0: 4.9e-2.
pub fn digits(value: f64, digits: usize) -> String {
    if value == 0.0 { "0".into() } else { format!("{value:.digits$e}") }
}

/// How far apart timings are, as a part of the best: 3%, or as a factor from twice on: 5×.
pub fn spread(part: f64) -> String {
    if part >= FIXED {
        return format!("{part:.0e}×");
    }
    if part < 0.995 { format!("{:.0}%", part * 100.0) } else { format!("{:.0}×", part + 1.0) }
}

/// A time (s) with three digits and its unit.
pub fn duration(seconds: f64) -> String {
    if seconds >= FIXED {
        return format!("{} s", rounded(seconds));
    }
    let (value, unit) = [(1.0, "s"), (1e-3, "ms"), (1e-6, "µs")]
        .into_iter()
        .find(|(size, _)| seconds >= *size)
        .map_or((seconds * 1e9, "ns"), |(size, unit)| (seconds / size, unit));
    let digits = if value < 10.0 { 2 } else { usize::from(value < 100.0) };
    format!("{value:.digits$} {unit}")
}

/// Least number of seconds, and least factor, that is written with an exponent.
const FIXED: f64 = 1e9;

/// A time (s) with four decimals, without its unit.
pub fn seconds(value: f64) -> String {
    if value < FIXED { format!("{value:.4}") } else { rounded(value) }
}

/// A time (s) with at most four decimals, without its unit.
pub fn time(value: f64) -> String {
    let text = seconds(value);
    if value >= FIXED { text } else { trimmed(&text).into() }
}

/// A knob's value with its power of ten; 0 is 0.
pub fn power(value: f64) -> String {
    if value == 0.0 { "0".into() } else { format!("{value:e}") }
}

/// A value to so many digits after the first, with an exponent where a row of zeros would stand.
pub fn significant(value: f64, digits: usize) -> String {
    let rounded: f64 = format!("{value:.digits$e}").parse().unwrap_or(value);
    let plain = rounded == 0.0 || (1e-4..1e9).contains(&rounded.abs());
    if plain { format!("{rounded}") } else { format!("{rounded:e}") }
}

/// An error to two digits at most, since no more are meant; `-` if it is not a number.
pub fn error(error: f64) -> String {
    match error {
        0.0 => "0".into(),
        error if error.is_nan() => "-".into(),
        error => format!("{error:.1e}").replace(".0e", "e"),
    }
}

/// A value right-aligned in `width` columns with so many decimals, or fewer where they do not fit; scientific where that
/// would show nothing of it.
pub fn decimal(value: f64, width: usize, decimals: usize) -> String {
    let value = if value == 0.0 { 0.0 } else { value }; // −0 is 0
    let shown = value == 0.0 || !value.is_finite() || value.abs() >= 0.5 * tenth_to(decimals);
    let with = |decimals: usize| format!("{value:>width$.decimals$}");
    let plain = (0..=decimals).rev().map(with).find(|text| text.len() <= width);
    plain.filter(|_| shown).unwrap_or_else(|| scientific(value, width))
}

/// A value right-aligned in `width` columns as 1.23e-4, with at most two decimals, fewer where they do not fit.
pub fn scientific(value: f64, width: usize) -> String {
    if value == 0.0 {
        return format!("{:>width$}", "0");
    }
    let with = |decimals: usize| format!("{value:>width$.decimals$e}");
    (0..=2).rev().map(with).find(|text| text.len() <= width).unwrap_or_else(|| with(0))
}

/// The shortest form of a setting, four digits at most: 0.25, 1e-3, 2.5e-4.
pub fn setting(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    if !value.is_finite() || (0.1..10_000.0).contains(&value.abs()) {
        return if value.is_finite() { trimmed(&format!("{value:.3}")).into() } else { format!("{value}") };
    }
    let text = format!("{value:.3e}");
    match text.split_once('e') {
        Some((digits, power)) => format!("{}e{power}", trimmed(digits)),
        None => text,
    }
}

/// A time, s, in a width that a run of `duration` (s) does not outgrow, with one decimal more than dt (s) needs.
pub fn clock(t: f64, duration: f64, dt: f64) -> String {
    let decimals = (2..9).find(|d| dt >= 0.999 * tenth_to(*d)).unwrap_or(8) + 1;
    let digits = (1..7).find(|d| duration < 1.0 / tenth_to(*d)).unwrap_or(7);
    decimal(t, digits + 1 + decimals, decimals)
}

/// A count with the thousands set apart, so that it can be read while it runs.
pub fn thousands(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::with_capacity(digits.len() * 4 / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// 10⁻ⁿ by repeated division: no `powi`, so the same on every machine.
fn tenth_to(n: usize) -> f64 {
    (0..n).fold(1.0, |value, _| value / 10.0)
}

/// The largest of 1, 2 and 5 times a power of ten that is ≤ `limit`; 1 if the limit is not a positive number.
pub fn round_down(limit: f64) -> f64 {
    if !(limit.is_finite() && limit > 0.0) {
        return 1.0;
    }
    // The exponent from the printed form: exact, and no logarithm.
    let text = format!("{limit:e}");
    let power: i32 = text.split_once('e').and_then(|(_, power)| power.parse().ok()).unwrap_or(0);
    let candidates = [5, 2, 1].map(|digit| format!("{digit}e{power}").parse::<f64>().unwrap_or(1.0));
    candidates.into_iter().find(|value| *value <= limit).unwrap_or(limit)
}

/// Digits after a decimal point without the zeros at their end.
fn trimmed(text: &str) -> &str {
    text.trim_end_matches('0').trim_end_matches('.')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_as_people_write_them() {
        let shown = [0.0, -1.0, 0.1, 1e300, 1e-9, f64::INFINITY, f64::NAN].map(number);
        assert_eq!(shown, ["0", "-1", "0.1", "1e300", "1e-9", "inf", "NaN"]);
        assert_eq!([0.123_456, f64::MAX].map(rounded), ["0.1235", "1.798e308"]);
        let counted = [6.0, 2e10, 123_456_789.0, f64::INFINITY].map(amount);
        assert_eq!(counted, ["6", "2e10", "1.235e8", "more than 1e308"]);
    }

    #[test]
    fn numbers_are_as_short_as_they_can_be_heard() {
        let heard = [0.0, 20.0, 1.5, 12.345_678, 100.0, 1e-12, 0.001, 1e300].map(spoken);
        assert_eq!(heard, ["0", "20", "1.5", "12.346", "100", "1.00e-12", "0.001", "1.00e300"]);
    }

    #[test]
    fn one_is_singular() {
        assert_eq!((counted(1_u64, "impact"), counted(0_u64, "wall")), ("1 impact".into(), "0 walls".into()));
    }

    #[test]
    fn durations_have_three_digits_and_a_unit() {
        let words = [2.0, 0.0123, 4.5e-6, 1.5e-8, 123e-6, 0.0].map(duration);
        assert_eq!(words, ["2.00 s", "12.3 ms", "4.50 µs", "15.0 ns", "123 µs", "0.00 ns"]);
    }

    #[test]
    fn no_figure_has_a_row_of_zeros() {
        let largest = [duration(1e308), spread(1e308), time(1e308), seconds(1e308)];
        assert_eq!(largest, ["1e308 s", "1e308×", "1e308", "1e308"]);
    }

    #[test]
    fn spreads_are_spreads_up_to_twice_and_then_factors() {
        assert_eq!([0.034, 0.99, 1.0, 4.2].map(spread), ["3%", "99%", "2×", "5×"]);
    }

    #[test]
    fn settings_take_their_shortest_form() {
        let texts = [1e-3, 0.01, 2.5e-4, 0.25, 1.0, 20.0, 0.0, 1.0 / 3.0 * 1e-2, 1e6, 1e-9, -0.5].map(setting);
        assert_eq!(texts, ["1e-3", "1e-2", "2.5e-4", "0.25", "1", "20", "0", "3.333e-3", "1e6", "1e-9", "-0.5"]);
    }

    #[test]
    fn a_decimal_keeps_its_width_at_the_cost_of_digits_and_turns_scientific_where_it_would_show_nothing() {
        let texts = [1.5, -2.25, 0.0, -0.0, 1e-7, -1e-300, f64::NAN].map(|value| decimal(value, 9, 4));
        let expected = ["   1.5000", "  -2.2500", "   0.0000", "   0.0000", "  1.00e-7", "-1.0e-300", "      NaN"];
        assert_eq!(texts, expected);
        let texts = [12_345.678_9, 123_456.0, 1.234_567_89e8, 1e12].map(|value| decimal(value, 9, 4));
        assert_eq!(texts, ["12345.679", "123456.00", "123456789", "  1.00e12"]);
    }

    #[test]
    fn the_clock_shows_a_digit_more_than_dt_and_does_not_widen_up_to_the_duration() {
        assert_eq!(clock(3.5, 20.0, 0.01), " 3.500");
        assert_eq!(clock(20.0, 20.0, 0.01), "20.000");
        assert_eq!(clock(3.5, 20.0, 1e-5), " 3.500000");
        assert_eq!(clock(0.0, 100.0, 0.3), "  0.000");
    }

    #[test]
    fn counts_are_read_by_thousands() {
        assert_eq!([0, 999, 1000, 1_234_567].map(thousands), ["0", "999", "1 000", "1 234 567"]);
    }

    #[test]
    fn a_round_length_is_one_two_or_five_times_a_power_of_ten() {
        let rounded = [0.9, 1.0, 1.99, 2.0, 4.9, 5.0, 9.99, 10.0, 3e-7].map(round_down);
        assert_eq!(rounded, [0.5, 1.0, 1.0, 2.0, 2.0, 5.0, 5.0, 10.0, 2e-7]);
        assert_eq!([f64::NAN, 0.0, -3.0, f64::INFINITY].map(round_down), [1.0; 4]);
    }
}
