//! Numbers in columns that do not jitter: fixed widths while running, shortest forms for settings.

/// A value right-aligned in `width` columns with so many decimals, or fewer where they do not fit; scientific where that
/// would show nothing of it.
pub(super) fn decimal(value: f64, width: usize, decimals: usize) -> String {
    let value = if value == 0.0 { 0.0 } else { value }; // −0 is 0
    let shown = value == 0.0 || !value.is_finite() || value.abs() >= 0.5 * tenth_to(decimals);
    let with = |decimals: usize| format!("{value:>width$.decimals$}");
    let plain = (0..=decimals).rev().map(with).find(|text| text.len() <= width);
    plain.filter(|_| shown).unwrap_or_else(|| scientific(value, width))
}

/// A value right-aligned in `width` columns as 1.23e-4, with at most two decimals, fewer where they do not fit.
pub(super) fn scientific(value: f64, width: usize) -> String {
    if value == 0.0 {
        return format!("{:>width$}", "0");
    }
    let with = |decimals: usize| format!("{value:>width$.decimals$e}");
    (0..=2).rev().map(with).find(|text| text.len() <= width).unwrap_or_else(|| with(0))
}

/// The shortest form of a setting, four digits at most: 0.25, 1e-3, 2.5e-4.
pub(super) fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    if !value.is_finite() || (0.1..10_000.0).contains(&value.abs()) {
        let text = format!("{value:.3}");
        let text = text.trim_end_matches('0').trim_end_matches('.');
        return if value.is_finite() { text.into() } else { format!("{value}") };
    }
    let text = format!("{value:.3e}");
    match text.split_once('e') {
        Some((digits, power)) => format!("{}e{power}", digits.trim_end_matches('0').trim_end_matches('.')),
        None => text,
    }
}

/// A time, s, in a width that a run of `duration` (s) does not outgrow, with one decimal more than dt (s) needs.
pub(super) fn clock(t: f64, duration: f64, dt: f64) -> String {
    let decimals = (2..9).find(|d| dt >= 0.999 * tenth_to(*d)).unwrap_or(8) + 1;
    let digits = (1..7).find(|d| duration < 1.0 / tenth_to(*d)).unwrap_or(7);
    decimal(t, digits + 1 + decimals, decimals)
}

/// A count with the thousands set apart, so that it can be read while it runs.
pub(super) fn count(value: u64) -> String {
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
pub(super) fn round_down(limit: f64) -> f64 {
    if !(limit.is_finite() && limit > 0.0) {
        return 1.0;
    }
    // The exponent from the printed form: exact, and no logarithm.
    let text = format!("{limit:e}");
    let power: i32 = text.split_once('e').and_then(|(_, power)| power.parse().ok()).unwrap_or(0);
    let candidates = [5, 2, 1].map(|digit| format!("{digit}e{power}").parse::<f64>().unwrap_or(1.0));
    candidates.into_iter().find(|value| *value <= limit).unwrap_or(limit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_take_their_shortest_form() {
        let texts = [1e-3, 0.01, 2.5e-4, 0.25, 1.0, 20.0, 0.0, 1.0 / 3.0 * 1e-2, 1e6, 1e-9, -0.5].map(short);
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
        assert_eq!([0, 999, 1000, 1_234_567].map(count), ["0", "999", "1 000", "1 234 567"]);
    }

    #[test]
    fn a_round_length_is_one_two_or_five_times_a_power_of_ten() {
        let rounded = [0.9, 1.0, 1.99, 2.0, 4.9, 5.0, 9.99, 10.0, 3e-7].map(round_down);
        assert_eq!(rounded, [0.5, 1.0, 1.0, 2.0, 2.0, 5.0, 5.0, 10.0, 2e-7]);
        assert_eq!([f64::NAN, 0.0, -3.0, f64::INFINITY].map(round_down), [1.0; 4]);
    }
}
