//! Rows of `judge --json`: a trajectory marked, an object a line.

use serde::Serialize;

use super::table::Row;

/// A trajectory marked; an empty field where there is no such figure.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct MarkRow {
    /// Name of the file.
    pub file: String,
    /// `passes`, `fails`, `unreadable`, or `marked` where no tolerance was asked for.
    pub verdict: String,
    /// Why the file cannot be read: line, and what is wrong there.
    pub problem: Option<String>,
    /// Largest position error that passes, m.
    pub tolerance: Option<f64>,
    /// Up to when `exact` may be held against others, s; none against another file.
    pub horizon: Option<f64>,
    /// Number of times in the file.
    pub moments: u64,
    /// Last time in the file, s.
    pub end: f64,
    /// Longest time between two rows of a sphere, s.
    pub spacing: f64,
    /// Up to when positions were compared, s.
    pub compared: f64,
    /// Largest position error, m.
    pub error: Option<f64>,
    /// Time of the largest position error, s.
    pub error_time: Option<f64>,
    /// Sphere with the largest position error.
    pub error_sphere: Option<usize>,
    /// How far places between rows of the other file are uncertain, m.
    pub interpolation_error: f64,
    /// `missing`, `late`, `early` or `extra`: the first impact that is wrong.
    pub wrong_impact: Option<String>,
    /// Time of the first wrong impact, s.
    pub wrong_impact_time: Option<f64>,
    /// By how much the first wrong impact is late, s; below 0: early.
    pub wrong_impact_delay: Option<f64>,
    /// Kind of the first wrong impact: `wall` or `pair`.
    pub wrong_impact_kind: Option<String>,
    /// Bodies of the first wrong impact: the sphere, and the wall or second sphere.
    pub wrong_impact_bodies: Option<[usize; 2]>,
    /// Impacts found of those of the standard.
    pub impacts_found: Option<usize>,
    /// Impacts of the standard that the rows can show, up to `compared`.
    pub impacts_wanted: Option<usize>,
    /// Deepest intersection degree in any row, dimensionless.
    pub deepest_degree: f64,
    /// Time of the deepest overlap, s.
    pub deepest_time: Option<f64>,
    /// Energy at the first row, J.
    pub energy_start: Option<f64>,
    /// Energy at the last row, J.
    pub energy_end: Option<f64>,
    /// By how much the energy rises above the least before, J.
    pub energy_rise: Option<f64>,
    /// Largest |E − E_exact|, J.
    pub energy_error: Option<f64>,
    /// Momentum of all spheres at the first row, kg m/s.
    pub momentum_start: Option<[f64; 3]>,
    /// Momentum of all spheres at the last row, kg m/s.
    pub momentum_end: Option<[f64; 3]>,
    /// Largest |p − p_exact|, kg m/s.
    pub momentum_off: Option<f64>,
    /// Largest momentum that an impact of a pair by itself makes or loses, as a part of what it exchanges.
    pub momentum_error: Option<f64>,
    /// When a velocity first changes without a contact, s.
    pub unexplained_time: Option<f64>,
    /// The likeliest mistake.
    pub mistake: Option<String>,
    /// In how many cases the mistake was seen, and of how many.
    pub mistake_seen: Option<[u64; 2]>,
    /// Order at which the errors of all the files fall with their steps; none without steps.
    pub order: Option<f64>,
    /// Half width of the interval that holds the order with 95 % certainty; none of two files.
    pub order_margin: Option<f64>,
    /// Figures of a crowd beside those of many runs; empty if it is held against none.
    pub crowd: Vec<CrowdMark>,
    /// Times, s, and the largest errors of the rows around them, m.
    pub errors: Vec<(f64, f64)>,
}

/// A figure of a crowd beside that of many runs; an empty field where one of them does not tell.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct CrowdMark {
    /// Name of the figure.
    pub figure: String,
    /// Unit of the figure; empty if it has none.
    pub unit: String,
    /// Value of the figure in the trajectory.
    pub value: Option<f64>,
    /// Mean of the figure over the runs.
    pub mean: Option<f64>,
    /// Standard deviation of the figure of a run.
    pub deviation: Option<f64>,
    /// Number of runs.
    pub seeds: Option<u64>,
    /// The setting that made the runs.
    pub by: Option<String>,
    /// Distance of the trajectory from the mean, in deviations of one more run.
    pub apart: Option<f64>,
    /// Whether `apart` is no more than three.
    pub agrees: Option<bool>,
}

impl Row for MarkRow {
    /// No columns: a row holds a list, and is written as JSON only.
    const COLUMNS: &'static [&'static str] = &[];
}
