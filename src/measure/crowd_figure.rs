//! Crowds as a figure for a lecture: energy over time, the height profile and what the walls carry, each setting with bands of three
//! standard errors, within which right methods agree. SVG without colours that matter: a method has a marker, a setting a dash.

use std::fmt::Write;

use super::crowd::{Crowd, ERRORS, Mean};
use super::crowds::SceneCrowds;
use super::figure::{COLORS, Look, escape, marker};
use super::report::setting;
use crate::export::FIGURES;
use crate::format;
use crate::scene::Method;

/// Width of the figure, px.
const WIDTH: f64 = 900.0;

/// Top of the plots within the panel of a scene, and their height, px.
const TOP: f64 = 60.0;
const HEIGHT: f64 = 300.0;

/// Left and width of the three plots, px.
const PLOTS: [[f64; 2]; 3] = [[90.0, 360.0], [540.0, 140.0], [770.0, 100.0]];

/// Height of a line of the legend, and the names of the axes above it, px.
const LINE: f64 = 22.0;
const AXIS: f64 = 62.0;

/// Dashes of the settings of one method, coarse to fine.
const DASHES: [&str; 4] = ["none", "7 3", "2 3", "7 3 2 3"];

/// Marks along a vertical axis, about.
const TICKS: f64 = 6.0;

/// Values that differ by less than this part of themselves are drawn in the middle, with so much room on either side.
const ALIKE: f64 = 1e-3;
const ASIDE: f64 = 0.05;

/// Parts of the run at which energy is told, in the order of the figures.
const TIMES: [f64; 5] = [0.05, 0.1, 0.25, 0.5, 1.0];

/// A plot: which figures, where across (0 to 1), and what the axes are.
struct Plot<'a> {
    left: f64,
    width: f64,
    title: &'a str,
    up: &'a str,
    /// Place across, and the figure's index.
    points: Vec<(f64, usize)>,
    /// Place across and words, below.
    marks: Vec<(f64, String)>,
    /// A value that is right, drawn as a line.
    right: Option<f64>,
    /// Whether points of one setting belong on one line.
    joined: bool,
}

/// A vertical axis, in the unit of its figures.
struct Range {
    low: f64,
    high: f64,
    step: f64,
}

impl Range {
    /// Round numbers around all values.
    fn around(values: impl Iterator<Item = f64>) -> Range {
        let finite = values.filter(|value| value.is_finite());
        let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        if low > high {
            return Range { low: 0.0, high: 1.0, step: 0.5 };
        }
        let size = low.abs().max(high.abs()).max(f64::MIN_POSITIVE);
        let alike = high - low < ALIKE * size;
        let (low, high) = if alike { (low - ASIDE * size, high + ASIDE * size) } else { (low, high) };
        let width = high - low;
        let decade = 10.0_f64.powf((width / TICKS).log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|part| part * decade).into_iter().find(|step| width / step <= TICKS);
        let step = step.unwrap_or(width);
        let high = (high / step).floor() * step + step;
        Range { low: (low / step).ceil() * step - step, high, step }
    }

    fn up(&self, value: f64) -> f64 {
        TOP + (1.0 - ((value - self.low) / (self.high - self.low)).clamp(0.0, 1.0)) * HEIGHT
    }

    fn ticks(&self) -> Vec<f64> {
        let count = ((self.high - self.low) / self.step).round() as usize;
        let first = (self.low / self.step).round();
        (0..=count).map(|k| (first + k as f64) * self.step).collect()
    }
}

/// The figure of the crowds of all scenes, a panel for each; `about`, the machine and the command, becomes its description.
pub fn crowd_figure(scenes: &[SceneCrowds], about: &str) -> String {
    let heights: Vec<f64> =
        scenes.iter().map(|scene| TOP + HEIGHT + AXIS + LINE * scene.crowds.len() as f64 + 12.0).collect();
    let height = heights.iter().sum::<f64>().max(1.0);
    let names: Vec<&str> = scenes.iter().map(|scene| scene.key.as_str()).collect();
    let mut svg = format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" viewBox="0 0 {WIDTH} {height}" role="img" aria-labelledby="title" font-family="sans-serif" font-size="13" fill="#000000">
<title id="title">Crowds beyond the horizon: {}</title>
<desc>{}</desc>
<rect width="100%" height="100%" fill="#ffffff"/>
"##,
        escape(&names.join(", ")),
        escape(about),
    );
    let mut top = 0.0;
    for (scene, height) in scenes.iter().zip(heights) {
        let _ = writeln!(svg, r#"<g transform="translate(0 {top})">"#);
        panel(scene, &mut svg);
        svg += "</g>\n";
        top += height;
    }
    svg + "</svg>\n"
}

fn panel(scene: &SceneCrowds, svg: &mut String) {
    let seeds = format::counted(scene.seeds, "seed");
    let title = escape(&format!("{}: means over {seeds}, bands of ±{ERRORS:.0} standard errors", scene.key));
    let _ = writeln!(svg, r#"<text x="{}" y="24" font-size="17" font-weight="bold">{title}</text>"#, PLOTS[0][0]);
    for plot in plots(scene) {
        let range = Range::around(scene.crowds.iter().flat_map(|crowd| plot.values(crowd)).chain(plot.right));
        frame(&plot, &range, svg);
        for (index, crowd) in scene.crowds.iter().enumerate() {
            plot.draw(crowd, (index, &scene.crowds), &range, svg);
        }
    }
    for (index, crowd) in scene.crowds.iter().enumerate() {
        legend(index, crowd, &scene.crowds, svg);
    }
}

fn plots(scene: &SceneCrowds) -> [Plot<'static>; 3] {
    let index = |name: &str| FIGURES.iter().position(|(_, _, column)| *column == name);
    let energies = ["energy_5", "energy_10", "energy_25", "energy_50", "energy_100"];
    let energies = TIMES.into_iter().zip(energies).filter_map(|(at, name)| Some((at, index(name)?)));
    let heights = ["height_10", "height_50", "height_90"].into_iter().zip([0.1, 0.5, 0.9]);
    let loads = ["load", "forces"].into_iter().zip([0.25, 0.75]);
    let time = |part: f64| (part, format::significant(part * scene.until, 2));
    let words = |marks: &[(f64, &str)]| marks.iter().map(|(at, words)| (*at, (*words).to_owned())).collect();
    let [energy, height, load] = PLOTS;
    let named = |[left, width]: [f64; 2], title, up| Plot {
        left,
        width,
        title,
        up,
        points: Vec::new(),
        marks: Vec::new(),
        right: None,
        joined: true,
    };
    [
        Plot {
            points: energies.collect(),
            marks: [0.0, 0.25, 0.5, 0.75, 1.0].map(time).to_vec(),
            ..named(energy, "time, s", "energy, J")
        },
        Plot {
            points: heights.filter_map(|(name, at)| Some((at, index(name)?))).collect(),
            marks: words(&[(0.1, "10 %"), (0.5, "50 %"), (0.9, "90 %")]),
            ..named(height, "of the centres lie below", "height at the end, m")
        },
        Plot {
            points: loads.filter_map(|(name, at)| Some((at, index(name)?))).collect(),
            marks: words(&[(0.25, "load"), (0.75, "forces")]),
            right: Some(1.0),
            joined: false,
            ..named(load, "of the walls, at the end", "over the weight")
        },
    ]
}

impl Plot<'_> {
    /// What the axis must hold of a setting.
    fn values(&self, crowd: &Crowd) -> Vec<f64> {
        let means = self.points.iter().filter_map(|(_, k)| crowd.means[*k]);
        means.flat_map(|Mean { mean, error, .. }| [mean - ERRORS * error, mean + ERRORS * error]).collect()
    }

    fn across(&self, part: f64) -> f64 {
        self.left + part * self.width
    }

    /// A setting's band, line and marks. Where points are not joined, settings stand side by side.
    fn draw(&self, crowd: &Crowd, (index, crowds): (usize, &[Crowd]), range: &Range, svg: &mut String) {
        let aside = (index as f64 + 0.5) / crowds.len() as f64 - 0.5;
        let shift = if self.joined { 0.0 } else { 0.4 * aside * self.width };
        let points: Vec<(f64, Mean)> =
            self.points.iter().filter_map(|(at, k)| Some((self.across(*at) + shift, crowd.means[*k]?))).collect();
        let (color, dash) = look(crowd, crowds);
        let edge = |(x, mean): &(f64, Mean), sign: f64| {
            format!("{x:.1} {:.1}", range.up(mean.mean + sign * ERRORS * mean.error))
        };
        if self.joined && points.len() > 1 {
            let above = points.iter().map(|point| edge(point, 1.0));
            let below = points.iter().rev().map(|point| edge(point, -1.0));
            let outline: Vec<String> = above.chain(below).collect();
            let _ = writeln!(svg, r#"<path fill="{color}" fill-opacity="0.2" d="M{}Z"/>"#, outline.join("L"));
            let line: Vec<String> = points.iter().map(|point| edge(point, 0.0)).collect();
            let _ = writeln!(
                svg,
                r#"<path fill="none" stroke="{color}" stroke-width="1.5" stroke-dasharray="{dash}" d="M{}"/>"#,
                line.join("L")
            );
        }
        for point in &points {
            let (above, below) = (edge(point, 1.0), range.up(point.1.mean - ERRORS * point.1.error));
            let _ = writeln!(svg, r#"<path stroke="{color}" stroke-width="1.5" d="M{above}V{below:.1}"/>"#);
            let tip = format!(
                "{}: {} ± {}",
                name(crowd),
                format::significant(point.1.mean, 6),
                format::digits(point.1.error, 1)
            );
            let look = if self.joined { Look::Filled } else { Look::Open };
            marker(crowd.rung.method.name(), (point.0, range.up(point.1.mean)), look, &tip, svg);
        }
    }
}

/// Outline, grid, ticks and the names of the axes.
fn frame(plot: &Plot, range: &Range, svg: &mut String) {
    let (left, width, bottom) = (plot.left, plot.width, TOP + HEIGHT);
    for value in range.ticks() {
        let y = range.up(value);
        let label = format::significant(value, 4).replace('-', "−");
        let _ = writeln!(svg, r##"<path stroke="#dddddd" d="M{left} {y:.1}h{width}"/>"##);
        let _ = writeln!(svg, r#"<text x="{}" y="{:.1}" text-anchor="end">{label}</text>"#, left - 8.0, y + 4.5);
    }
    for (at, words) in &plot.marks {
        let x = plot.across(*at);
        let _ = writeln!(svg, r##"<path stroke="#dddddd" d="M{x:.1} {TOP}v{HEIGHT}"/>"##);
        let _ = writeln!(svg, r#"<text x="{x:.1}" y="{}" text-anchor="middle">{words}</text>"#, bottom + 20.0);
    }
    if let Some(right) = plot.right {
        let y = range.up(right);
        let _ = writeln!(svg, r##"<path stroke="#000000" stroke-dasharray="2 3" d="M{left} {y:.1}h{width}"/>"##);
    }
    let _ = writeln!(
        svg,
        r##"<rect x="{left}" y="{TOP}" width="{width}" height="{HEIGHT}" fill="none" stroke="#000000"/>"##
    );
    let middle = left + width / 2.0;
    let _ = writeln!(svg, r#"<text x="{middle}" y="{}" text-anchor="middle">{}</text>"#, bottom + 42.0, plot.title);
    let _ = writeln!(svg, r#"<text x="{left}" y="{}">{}</text>"#, TOP - 10.0, plot.up);
}

/// Colour of the method, dash of the setting.
fn look(crowd: &Crowd, crowds: &[Crowd]) -> (&'static str, &'static str) {
    let method = crowd.rung.method;
    let color = Method::ALL.iter().position(|other| *other == method).unwrap_or(COLORS.len() - 1);
    let finer = crowds.iter().filter(|other| other.rung.method == method).position(|other| other.rung == crowd.rung);
    (COLORS[color % COLORS.len()], DASHES[finer.unwrap_or(0) % DASHES.len()])
}

fn name(crowd: &Crowd) -> String {
    setting(crowd.rung.method.name(), crowd.rung.dt, crowd.rung.tolerance)
}

/// A line of the legend; how many runs came to the end, if not all did.
fn legend(index: usize, crowd: &Crowd, crowds: &[Crowd], svg: &mut String) {
    let (x, y) = (PLOTS[0][0] + 16.0, TOP + HEIGHT + AXIS + LINE * index as f64 + 6.0);
    let (color, dash) = look(crowd, crowds);
    let (done, begun) = crowd.finished;
    let mut words = name(crowd);
    if done < begun {
        let _ =
            write!(words, ": {done} of {begun} came to the end, all to at least {} s", format::time(crowd.reached.0));
    }
    let line = format!(r#"stroke="{color}" stroke-width="1.5" stroke-dasharray="{dash}" d="M{} {y}h32""#, x - 16.0);
    let _ = writeln!(svg, "<path {line}/>");
    marker(crowd.rung.method.name(), (x, y), Look::Filled, "", svg);
    let _ = writeln!(svg, r#"<text x="{}" y="{}" font-size="12">{}</text>"#, x + 24.0, y + 4.5, escape(&words));
}
