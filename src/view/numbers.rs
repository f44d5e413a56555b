//! Numbers in columns that do not jitter: fixed widths while running, shortest forms for settings.

/// A value right-aligned in `width` columns with so many decimals; scientific where that would show nothing of it or
/// not fit.
pub(super) fn decimal(value: f64, width: usize, decimals: usize) -> String {
    let value = if value == 0.0 { 0.0 } else { value }; // −0 is 0
    let plain = format!("{value:>width$.decimals$}");
    let shown = value == 0.0 || !value.is_finite() || value.abs() >= 0.5 * tenth_to(decimals);
    if shown && plain.len() <= width { plain } else { scientific(value, width) }
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
