//! Rows of `measure --crowd`: a figure of a crowd, by setting.

use serde::Serialize;

use super::table::Row;

/// A mean over runs of one setting.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CrowdRow {
    /// The scene's key.
    pub scene: String,
    /// The method's name.
    pub method: String,
    /// Longest step, s.
    pub dt: Option<f64>,
    /// Intersection tolerance, a degree.
    pub tolerance: Option<f64>,
    /// What it is.
    pub figure: String,
    /// Its unit; empty if it has none.
    pub unit: String,
    /// Mean over the runs that have it; empty if none has.
    pub mean: Option<f64>,
    /// Standard error of the mean.
    pub standard_error: Option<f64>,
    /// How many runs have it.
    pub seeds: u64,
    /// Whether it is within three standard errors of the setting that the others are held against.
    pub agrees: Option<bool>,
}

impl Row for CrowdRow {
    const COLUMNS: &'static [&'static str] =
        &["scene", "method", "dt", "tolerance", "figure", "unit", "mean", "standard_error", "seeds", "agrees"];
}
