//! The results as text in 80 columns: a line each, then a note on each check.

use super::check::Check;
use super::runner::Row;
use crate::format;

/// Columns of every line.
const WIDTH: usize = 80;

/// Columns of a value.
const VALUE: usize = 12;

/// Most significant digits of a value, less one.
const DIGITS: usize = 7;

/// The head of the table, a line and a rule.
pub fn head() -> String {
    format!("{}\n{}\n", line("", "known result", ["expected", "found", "error", "allowed"], ""), "─".repeat(WIDTH))
}

/// The rows of the check of this number (from 1), a line each.
pub fn rows(number: usize, rows: &[Row]) -> String {
    let of = |(index, row): (usize, &Row)| {
        let number = if index == 0 { number.to_string() } else { String::new() };
        let figures = [
            value(row.expected, row.unit),
            value(row.found, row.unit),
            format::error(row.error()),
            format::error(row.allowed),
        ];
        line(&number, &row.what, figures.each_ref().map(String::as_str), if row.passes() { "pass" } else { "FAIL" })
            + "\n"
    };
    rows.iter().enumerate().map(of).collect()
}

/// The check of this number that has no rows, and why not.
pub fn failure(number: usize, check: &Check, reason: &str) -> String {
    let told = line(&number.to_string(), check.title, ["", "none", "", ""], "FAIL");
    format!("{told}\n{}", wrapped(reason, 4))
}

/// The rule that ends the table, and a note on each check: source, and why that much error is allowed.
pub fn notes(checks: &[Check]) -> String {
    let mut text = "─".repeat(WIDTH) + "\n";
    for (index, check) in checks.iter().enumerate() {
        let Check { title, source, allowed, .. } = check;
        let note = wrapped(&format!("{title}: {source}. Allowed: {allowed}."), 4);
        text += &format!("{:>2}{}", index + 1, &note[2..]);
    }
    text + &wrapped("Errors are relative where something else than 0 is expected.", 4)
}

fn line(number: &str, what: &str, [expected, found, error, allowed]: [&str; 4], verdict: &str) -> String {
    let text = format!("{number:>2}  {what:<28}{expected:>VALUE$} {found:>VALUE$} {error:>8} {allowed:>8} {verdict}");
    text.trim_end().to_string()
}

/// A value with as many digits as fit, and its unit.
fn value(value: f64, unit: &str) -> String {
    if value.is_nan() {
        return "none".into();
    }
    let mut texts = (0..=DIGITS)
        .rev()
        .map(|digits| format!("{} {unit}", format::significant(value, digits)).trim_end().to_string());
    texts.clone().find(|text| text.chars().count() <= VALUE).or_else(|| texts.next_back()).unwrap_or_default()
}

/// The words in lines of [`WIDTH`], each after so many spaces.
fn wrapped(text: &str, indent: usize) -> String {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= WIDTH => *line += &format!(" {word}"),
            _ => lines.push(format!("{:indent$}{word}", "")),
        }
    }
    lines.iter().map(|line| format!("{line}\n")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(expected: f64, found: f64, allowed: f64) -> Row {
        Row::new("fall of a metre", "s", [expected, found], allowed)
    }

    #[test]
    fn a_line_has_what_expected_found_error_allowed_and_verdict_in_eighty_columns() {
        let text = rows(3, &[of(0.5, 0.500_000_000_1, 1e-6), of(0.0, 0.25, 0.1), of(1e12, f64::NAN, 1.0)]);
        let expected = [
            " 3  fall of a metre                    0.5 s        0.5 s    2e-10     1e-6 pass",
            "    fall of a metre                      0 s       0.25 s   2.5e-1     1e-1 FAIL",
            "    fall of a metre                   1e12 s         none        -      1e0 FAIL",
        ];
        assert_eq!(text.lines().collect::<Vec<_>>(), expected);
        assert!(text.lines().chain(head().lines()).all(|line| line.chars().count() <= WIDTH));
    }

    #[test]
    fn notes_are_wrapped_and_lose_no_word() {
        let text = notes(super::super::CHECKS);
        assert!(text.lines().all(|line| line.chars().count() <= WIDTH), "{text}");
        for word in super::super::CHECKS.iter().flat_map(|check| check.source.split_whitespace()) {
            assert!(text.contains(word), "{word}");
        }
    }
}
