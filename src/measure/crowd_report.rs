//! What is said of crowds: a block of text for each figure, a row for each setting and figure.

use std::fmt::Write;

use super::crowd::{Crowd, ERRORS, Mean};
use super::crowds::SceneCrowds;
use super::ladder::Rung;
use super::report::setting;
use crate::export::{CrowdRow, FIGURES, RESIDUALS};
use crate::format;
use crate::scene::Method;

/// Largest difference that is told, in standard errors.
const FAR: f64 = 1000.0;

/// Which setting the others are held against in figure `k`: `exact`, if all its runs have the figure or came to the end;
/// else the last setting of which that is so.
fn standard(crowds: &[Crowd], k: usize) -> Option<usize> {
    let known = |crowd: &&(usize, &Crowd)| {
        let (done, begun) = crowd.1.finished;
        let has = crowd.1.means[k].map_or(0, |mean| mean.runs);
        begun > 0 && has > 0 && (done == begun || has == begun)
    };
    let known: Vec<(usize, &Crowd)> = crowds.iter().enumerate().filter(|crowd| known(&crowd)).collect();
    let exact = known.iter().find(|(_, crowd)| crowd.rung.method == Method::Exact);
    exact.or_else(|| known.last()).map(|(index, _)| *index)
}

/// Whether a figure is held against others: a residual is 0 or it is not.
fn is_held(k: usize) -> bool {
    k < FIGURES.len() - RESIDUALS
}

/// The crowd of this setting with half the step, and finer in nothing else.
fn half<'a>(crowds: &'a [Crowd], rung: &Rung) -> Option<&'a Crowd> {
    let dt = rung.dt? * 0.5;
    crowds.iter().find(|other| other.rung == Rung { dt: Some(dt), ..*rung })
}

/// A row for each setting and figure.
pub fn crowd_rows(scene: &SceneCrowds) -> Vec<CrowdRow> {
    let crowds = &scene.crowds;
    let row = |index: usize, k: usize| {
        let crowd = &crowds[index];
        let (figure, unit, _) = FIGURES[k];
        let (mean, standard) = (crowd.means[k], standard(crowds, k));
        let agrees = |other: Option<&Crowd>| {
            let wanted = other.and_then(|other| other.means[k]);
            mean.zip(wanted).filter(|_| is_held(k)).map(|(mean, wanted)| mean.agrees(&wanted))
        };
        CrowdRow {
            scene: scene.key.clone(),
            method: crowd.rung.method.name().into(),
            dt: crowd.rung.dt,
            tolerance: crowd.rung.tolerance,
            runs: crowd.finished.1 as u64,
            reached: crowd.reached.0,
            figure: figure.into(),
            unit: unit.into(),
            mean: mean.map(|mean| mean.mean),
            standard_error: mean.map(|mean| mean.error),
            seeds: mean.map_or(0, |mean| mean.runs as u64),
            standard: is_held(k) && standard == Some(index),
            agrees: agrees(standard.map(|standard| &crowds[standard])),
            agrees_with_half: agrees(half(crowds, &crowd.rung)),
        }
    };
    (0..crowds.len())
        .flat_map(|index| (0..FIGURES.len()).map(move |k| (index, k)))
        .map(|(index, k)| row(index, k))
        .collect()
}

/// The report on a scene's crowds.
pub fn crowd_report(scene: &SceneCrowds) -> String {
    let mut text = format!(
        "{}: {} s, {}; means ± standard errors (s.e.), and whether a setting is within {ERRORS:.0} of them\n",
        scene.key,
        format::time(scene.until),
        format::counted(scene.seeds, "seed")
    );
    for (k, (figure, unit, _)) in FIGURES.iter().enumerate() {
        let unit = if unit.is_empty() { String::new() } else { format!(", {unit}") };
        let _ = writeln!(text, "\n{figure}{unit}");
        let standard = standard(&scene.crowds, k);
        for (index, crowd) in scene.crowds.iter().enumerate() {
            let verdict = match (crowd.means[k], standard) {
                (None, _) | (_, None) => String::new(),
                (Some(_), _) if !is_held(k) => String::new(),
                (Some(_), Some(standard)) if standard == index => "standard".into(),
                (Some(mean), Some(standard)) => {
                    scene.crowds[standard].means[k].map_or(String::new(), |w| verdict(&mean, &w))
                }
            };
            let line = format!("  {:35} {} {verdict}", name(&crowd.rung), words(crowd.means[k]));
            let _ = writeln!(text, "{}", line.trim_end());
        }
    }
    text.push('\n');
    scene.crowds.iter().filter_map(|crowd| halves(&scene.crowds, crowd)).for_each(|line| text += &line);
    scene.crowds.iter().filter_map(|crowd| unfinished(crowd, scene.seeds)).for_each(|line| text += &line);
    text
}

fn verdict(mean: &Mean, wanted: &Mean) -> String {
    match mean.apart(wanted) {
        apart if apart <= ERRORS => format!("within: {apart:.1} s.e."),
        apart if apart < FAR => format!("differs: {apart:.1} s.e."),
        _ => "differs: over 1000".into(),
    }
}

/// How a setting compares with half its step.
fn halves(crowds: &[Crowd], crowd: &Crowd) -> Option<String> {
    let half = half(crowds, &crowd.rung)?;
    let pairs: Vec<(usize, bool)> = (0..FIGURES.len())
        .filter(|k| is_held(*k))
        .filter_map(|k| Some((k, crowd.means[k]?.agrees(&half.means[k]?))))
        .collect();
    let wrong: Vec<&str> = pairs.iter().filter(|pair| !pair.1).map(|pair| FIGURES[pair.0].0).collect();
    let (same, all) = (pairs.len() - wrong.len(), pairs.len());
    if all == 0 {
        return None;
    }
    let mut text = format!("{}: half the step gives the same in {same} of {all} figures", name(&crowd.rung));
    for (k, figure) in wrong.iter().enumerate() {
        text += if k == 0 {
            ";\n  not in "
        } else if k % 3 == 0 {
            ",\n  "
        } else {
            ", "
        };
        text += figure;
    }
    Some(text + "\n")
}

/// What is said of a setting of which not all runs came to the end.
fn unfinished(crowd: &Crowd, seeds: u64) -> Option<String> {
    let ((done, begun), stalled) = (crowd.finished, crowd.stalled);
    let missing = seeds.saturating_sub(begun as u64);
    if done == begun && missing == 0 {
        return None;
    }
    let mut said = Vec::new();
    if stalled > 0 {
        said.push(format!("{stalled} of {begun} runs stalled"));
    }
    if begun - done > stalled {
        said.push(format!("{} of {begun} runs had spent what they may take", begun - done - stalled));
    }
    if missing > 0 {
        said.push(format!("{missing} of {seeds} runs are missing"));
    }
    let (least, most) = crowd.reached;
    if done < begun {
        said.push(format!("reached {} to {} s", format::time(least), format::time(most)));
    }
    Some(format!("{}: {}\n", name(&crowd.rung), said.join(", ")))
}

fn words(mean: Option<Mean>) -> String {
    mean.map_or(format!("{:>12}", "-"), |Mean { mean, error, .. }| {
        format!("{:>12} ± {:8}", format::significant(mean, 5), format::digits(error, 1))
    })
}

fn name(rung: &Rung) -> String {
    setting(rung.method.name(), rung.dt, rung.tolerance)
}
