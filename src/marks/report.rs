//! Marks in words and as rows.

use std::fmt::Write;

use super::class::Marked;
use super::crowded::{crowd, crowd_marks};
use super::exam::{Exam, Mark};
use super::ledger::Ledger;
use super::order::{Wrong, WrongImpact};
use crate::export::MarkRow;
use crate::format;
use crate::measure::{Fit, fit};
use crate::physics::Kind;
use crate::physics::contact::Key;

/// Most files of which each gets a paragraph below the table.
const TOLD: usize = 8;

/// Most spheres that are no crowd.
const CROWD: usize = 16;

/// Changes below this part stand for rounding, of a program or of its rows.
const ROUNDING: f64 = 1e-9;

/// The whole report: what they are held against, a line for each file, and for a few of them what was found. `other` names
/// the file that they are held against instead of `exact`.
pub fn report(exam: &Exam, scene: &str, other: Option<&str>, marked: &[Marked]) -> String {
    let mut text = heading(exam, scene, other) + "\n\n";
    text += "verdict  error m at s    wrong impact               depth likely mistake         file\n";
    for Marked { name, mark } in marked {
        match mark {
            Ok(mark) => text += &(line(mark) + name + "\n"),
            Err(problem) => {
                let _ = writeln!(text, "no file  {name}:{problem}");
            }
        }
    }
    if marked.len() <= TOLD {
        for Marked { name, mark } in marked {
            if let Ok(mark) = mark {
                text += &format!("\n{name}: {}\n{}", paragraph(mark), crowd(&mark.crowd));
            }
        }
    } else {
        let count = |verdict: &str| marked.iter().filter(|marked| word(marked) == verdict).count();
        let [passes, fails, plain, broken] = ["passes", "fails", "marked", "unreadable"].map(count);
        let marks = if plain > 0 { format!("{plain} marked") } else { format!("{passes} pass, {fails} fail") };
        let _ = writeln!(text, "\n{}: {marks}, {broken} cannot be read", format::counted(marked.len(), "file"));
    }
    text
}

fn heading(exam: &Exam, scene: &str, other: Option<&str>) -> String {
    let asked = exam.tolerance.map(|tolerance| format!("; {} m pass", format::power(tolerance))).unwrap_or_default();
    if let Some(other) = other {
        return format!("{scene}: against {other}{asked}");
    }
    let certificate = &exam.certificate;
    let floor = format!(
        "{scene}: against exact, certified to {} m until {} s",
        format::digits(certificate.error, 1),
        format::time(certificate.until)
    );
    let horizon = match exam.horizon < certificate.until {
        true => format!(
            "; positions are compared up to {} s, where that is a tenth of what is asked",
            format::time(exam.horizon)
        ),
        false => String::new(),
    };
    let because = certificate.ending.as_ref().map(|ending| format!(" ({})", ending.cause.words())).unwrap_or_default();
    let many = exam.spheres() > CROWD && exam.horizon < exam.until && exam.norm.is_none();
    let beyond = if many { ";\n  beyond that --crowd compares figures of the crowd" } else { "" };
    floor + &because + &horizon + &asked + beyond
}

/// The word of a verdict.
fn word(marked: &Marked) -> &'static str {
    match marked.mark.as_ref().map(|mark| mark.passes) {
        Err(_) => "unreadable",
        Ok(None) => "marked",
        Ok(Some(true)) => "passes",
        Ok(Some(false)) => "fails",
    }
}

fn line(mark: &Mark) -> String {
    let verdict = match mark.passes {
        None => "",
        Some(true) => "passes",
        Some(false) => "fails",
    };
    let (error, at, _) = mark.error;
    let wrong = mark.impacts.and_then(|impacts| impacts.first_wrong);
    format!(
        "{verdict:8} {:7} {:7} {:26} {:5} {:22} ",
        format::digits(error, 1),
        format::time(at),
        wrong.map(short).unwrap_or("-".into()),
        format::digits(mark.deepest.map_or(0.0, |deepest| deepest.degree), 0),
        mark.mistake.map_or("-", |suspicion| suspicion.mistake.name()),
    )
}

/// `missing #0–wall 6 3.102`.
fn short(wrong: WrongImpact) -> String {
    format!("{} {} {}", kind(wrong.wrong), bodies(wrong.key), format::time(wrong.time))
}

fn kind(wrong: Wrong) -> &'static str {
    match wrong {
        Wrong::Missing => "missing",
        Wrong::Late(delay) if delay < 0.0 => "early",
        Wrong::Late(_) => "late",
        Wrong::Extra => "extra",
    }
}

fn bodies((kind, a, b): Key) -> String {
    if kind == Kind::Wall { format!("#{a}–wall {b}") } else { format!("#{a}–#{b}") }
}

fn paragraph(mark: &Mark) -> String {
    let mut said = vec![format!(
        "{} up to {} s, at most {} s apart",
        format::counted(mark.moments, "time"),
        format::time(mark.end),
        format::significant(mark.spacing, 2)
    )];
    said.push(places(mark));
    if mark.passes == Some(false) && !mark.complete {
        said.push("it ends before the horizon".into());
    }
    if mark.interpolation > 0.0 {
        let uncertain = format::digits(mark.interpolation, 1);
        said.push(format!("places between the other's rows are uncertain by up to {uncertain} m"));
    }
    said.extend(mark.impacts.map(|impacts| {
        let wrong = impacts.first_wrong.map(|wrong| format!("; first wrong: {}", at_length(wrong))).unwrap_or_default();
        format!("{} of the {} impacts that can be seen are found{wrong}", impacts.found, impacts.wanted)
    }));
    said.extend(mark.deepest.map(|deepest| {
        let (degree, time) = (format::digits(deepest.degree, 1), format::time(deepest.time));
        format!("deepest overlap {degree}, {} at {time} s", bodies(deepest.key))
    }));
    said.extend(mark.energy.as_ref().map(energy));
    said.extend(mark.energy.as_ref().map(momentum));
    if mark.imbalance > ROUNDING {
        let part = format::digits(mark.imbalance, 1);
        said.push(format!("impacts of pairs by themselves change the momentum by up to {part} of what they exchange"));
    }
    said.extend(mark.unexplained.map(|(time, sphere)| {
        format!("no contact explains a change of the velocity of sphere {sphere} after {} s", format::time(time))
    }));
    said.extend(mark.mistake.map(|suspicion| format!("likely mistake: {suspicion}")));
    said.join(";\n  ")
}

fn places(mark: &Mark) -> String {
    let ((error, at, sphere), compared) = (mark.error, format::time(mark.compared));
    match error > 0.0 {
        true => {
            let (error, at) = (format::digits(error, 1), format::time(at));
            format!("sphere {sphere} is {error} m off at {at} s, compared up to {compared} s")
        }
        false => format!("no sphere is off, compared up to {compared} s"),
    }
}

fn energy(energy: &Ledger) -> String {
    let [start, end] = [energy.start, energy.end].map(format::rounded);
    let off = energy.error.map(|off| format!(", off by {} J at most", format::rounded(off))).unwrap_or_default();
    let rise = match energy.rise > ROUNDING * energy.scale {
        true => format!(", rises by {} J at {} s", format::rounded(energy.rise), format::time(energy.rise_time)),
        false => String::new(),
    };
    format!("energy {start} J to {end} J{rise}{off}")
}

fn momentum(ledger: &Ledger) -> String {
    let vector = |p: glam::DVec3| format!("({})", p.to_array().map(format::rounded).join(", "));
    let off = ledger.momentum_error.map(|off| format!(", off by {} at most", format::rounded(off))).unwrap_or_default();
    format!("momentum {} to {} kg m/s{off}", vector(ledger.momentum_start), vector(ledger.momentum_end))
}

fn at_length(wrong: WrongImpact) -> String {
    let by = match wrong.wrong {
        Wrong::Late(delay) => format!(" by {} s", format::digits(delay.abs(), 1)),
        Wrong::Missing | Wrong::Extra => String::new(),
    };
    format!("{} at {} s is {}{by}", bodies(wrong.key), format::time(wrong.time), kind(wrong.wrong))
}

/// The order at which the errors of one program fall with its steps. Displays as a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Order {
    /// The order, its interval and the number of files.
    pub fit: Fit,
    /// Errors count up to here, s.
    pub until: f64,
    /// Whether the first file is a radius off there: beyond that no error depends on a step.
    pub parted: bool,
}

/// The order of files of one program with these steps, s; none of fewer than two with errors.
pub fn order(exam: &Exam, steps: &[f64], marked: &[Marked]) -> Option<Order> {
    let marks = || marked.iter().filter_map(|marked| marked.mark.as_ref().ok());
    let parted = marks().flat_map(|mark| mark.series.points().iter().filter(|point| point.1 > exam.smallest_radius()));
    let parted = parted.map(|point| point.0).fold(f64::INFINITY, f64::min);
    let end = marks().map(|mark| mark.compared).fold(f64::INFINITY, f64::min);
    let counts = |time: f64| time < parted && time <= end;
    let error = |mark: &Mark| {
        let counted = mark.series.points().iter().filter(|point| counts(point.0));
        counted.map(|point| point.1).fold(0.0, f64::max)
    };
    let errors = marked.iter().map(|marked| marked.mark.as_ref().map_or(f64::NAN, error));
    let fit = fit(steps.iter().copied().zip(errors))?;
    Some(Order { fit, until: parted.min(end), parted: parted <= end })
}

impl std::fmt::Display for Order {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Order { fit, until, parted } = self;
        let certain = if fit.margin.is_some() { " (95 %)" } else { "" };
        let until = match parted {
            true => format!("before {} s, where one is a radius off", format::time(*until)),
            false => format!("up to {} s", format::time(*until)),
        };
        write!(f, "Order of convergence in dt: {fit}{certain}, of {} files {until}.", fit.points)
    }
}

/// A mark as a row of JSON.
pub fn row(exam: &Exam, against_exact: bool, marked: &Marked) -> MarkRow {
    let verdict = word(marked).to_owned();
    let file = marked.name.clone();
    let (tolerance, horizon) = (exam.tolerance, against_exact.then_some(exam.horizon));
    let begun = MarkRow { file, verdict, tolerance, horizon, ..MarkRow::default() };
    match &marked.mark {
        Err(problem) => MarkRow { problem: Some(problem.trim().to_owned()), ..begun },
        Ok(mark) => filled(begun, mark),
    }
}

fn filled(begun: MarkRow, mark: &Mark) -> MarkRow {
    let wrong = mark.impacts.and_then(|impacts| impacts.first_wrong);
    let energy = |of: fn(&Ledger) -> f64| mark.energy.as_ref().map(of);
    MarkRow {
        moments: mark.moments,
        end: mark.end,
        spacing: mark.spacing,
        compared: mark.compared,
        error: Some(mark.error.0),
        error_time: Some(mark.error.1),
        error_sphere: Some(mark.error.2),
        interpolation_error: mark.interpolation,
        wrong_impact: wrong.map(|wrong| kind(wrong.wrong).into()),
        wrong_impact_time: wrong.map(|wrong| wrong.time),
        wrong_impact_delay: wrong.and_then(|wrong| match wrong.wrong {
            Wrong::Late(delay) => Some(delay),
            Wrong::Missing | Wrong::Extra => None,
        }),
        wrong_impact_kind: wrong.map(|wrong| if wrong.key.0 == Kind::Wall { "wall" } else { "pair" }.into()),
        wrong_impact_bodies: wrong.map(|wrong| [wrong.key.1, wrong.key.2]),
        impacts_found: mark.impacts.map(|impacts| impacts.found),
        impacts_wanted: mark.impacts.map(|impacts| impacts.wanted),
        deepest_degree: mark.deepest.map_or(0.0, |deepest| deepest.degree),
        deepest_time: mark.deepest.map(|deepest| deepest.time),
        energy_start: energy(|energy| energy.start),
        energy_end: energy(|energy| energy.end),
        energy_rise: energy(|energy| energy.rise),
        energy_error: mark.energy.and_then(|energy| energy.error),
        momentum_start: mark.energy.map(|ledger| ledger.momentum_start.to_array()),
        momentum_end: mark.energy.map(|ledger| ledger.momentum_end.to_array()),
        momentum_off: mark.energy.and_then(|ledger| ledger.momentum_error),
        momentum_error: mark.energy.map(|_| mark.imbalance),
        unexplained_time: mark.unexplained.map(|(time, _)| time),
        mistake: mark.mistake.map(|suspicion| suspicion.mistake.name().into()),
        mistake_seen: mark.mistake.map(|suspicion| [suspicion.seen, suspicion.of]),
        crowd: crowd_marks(&mark.crowd),
        errors: mark.series.points().to_vec(),
        ..begun
    }
}
