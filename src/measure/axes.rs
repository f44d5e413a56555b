//! Which error is put over which cost.

use crate::export::TradeRow;
use crate::format;

/// A cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Cost {
    /// Processor time per simulated second.
    #[default]
    Cpu,
    /// Gaps computed.
    Gaps,
    /// Impacts, rests and releases.
    Events,
    /// Frames.
    Frames,
    /// The longest step: no cost, but what an order is asked in.
    Dt,
}

/// An error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Error {
    /// The largest distance of a sphere from its place.
    #[default]
    Position,
    /// The largest time error of the first impacts.
    Time,
    /// The relative error of the energy.
    Energy,
    /// The deepest overlap.
    Depth,
}

impl Cost {
    /// All, with their words on the command line.
    pub const ALL: [(&'static str, Cost); 5] = [
        ("cpu", Cost::Cpu),
        ("gaps", Cost::Gaps),
        ("events", Cost::Events),
        ("frames", Cost::Frames),
        ("dt", Cost::Dt),
    ];

    /// The axis's name in the chart.
    pub(super) fn axis(self) -> &'static str {
        match self {
            Cost::Cpu => "CPU time per simulated second, s",
            Cost::Gaps => "gaps computed",
            Cost::Events => "impacts, rests and releases",
            Cost::Frames => "frames",
            Cost::Dt => "longest step dt, s",
        }
    }

    /// The axis's name in the figure.
    pub(super) fn label(self) -> &'static str {
        if self == Cost::Cpu { "cost: CPU seconds per simulated second" } else { self.axis() }
    }

    /// A cost in words.
    pub(super) fn words(self, value: f64) -> String {
        match self {
            Cost::Cpu => format!("{} per simulated second", format::duration(value)),
            Cost::Gaps => format!("{} gaps", format::significant(value, 2)),
            Cost::Events => format!("{} events", format::significant(value, 2)),
            Cost::Frames => format!("{} frames", format::significant(value, 2)),
            Cost::Dt => format!("dt {} s", format::power(value)),
        }
    }
}

impl Error {
    /// All, with their words on the command line.
    pub const ALL: [(&'static str, Error); 4] =
        [("position", Error::Position), ("time", Error::Time), ("energy", Error::Energy), ("depth", Error::Depth)];

    /// The axis's name in the chart.
    pub(super) fn axis(self) -> &'static str {
        match self {
            Error::Position => "position error, m",
            Error::Time => "time error of the first impacts, s",
            Error::Energy => "energy error, relative",
            Error::Depth => "deepest overlap, degree",
        }
    }

    /// The axis's name in the figure.
    pub(super) fn label(self) -> &'static str {
        if self == Error::Position { "largest position error up to the horizon, m" } else { self.axis() }
    }

    /// The error in words, as a title begins.
    pub(super) fn title(self) -> &'static str {
        match self {
            Error::Position => "Position error",
            Error::Time => "Time error of the first impacts",
            Error::Energy => "Energy error",
            Error::Depth => "Deepest overlap",
        }
    }

    /// The unit with a space before it, if it has one.
    pub(super) fn unit(self) -> &'static str {
        match self {
            Error::Position => " m",
            Error::Time => " s",
            Error::Energy | Error::Depth => "",
        }
    }
}

/// An error over a cost; position error over processor time unless told otherwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Axes {
    /// The cost across.
    pub x: Cost,
    /// The error up.
    pub y: Error,
}

impl Axes {
    /// The cost of a row; none if it lacks one.
    pub fn cost(self, row: &TradeRow) -> Option<f64> {
        match self.x {
            Cost::Cpu => row.cpu_per_s,
            Cost::Gaps => Some(row.evaluations as f64),
            Cost::Events => Some(row.events as f64),
            Cost::Frames => Some(row.frames as f64),
            Cost::Dt => row.dt,
        }
    }

    /// The error of a row; none if it lacks one.
    pub fn error(self, row: &TradeRow) -> Option<f64> {
        match self.y {
            Error::Position => row.position_error,
            Error::Time => row.impact_time_error,
            Error::Energy => row.energy_error,
            Error::Depth => Some(row.deepest_degree.max(0.0)),
        }
    }

    /// Cost and error of a row; none if it lacks one.
    pub(super) fn point(self, row: &TradeRow) -> Option<(f64, f64)> {
        Some((self.cost(row)?, self.error(row)?))
    }
}
