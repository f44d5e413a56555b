//! Which settings are tried: methods × dt × tolerance, a knob that a method lacks tried once.

use super::reference;
use crate::physics::{Effect, Knobs, knobs};
use crate::scene::{Method, Settings};

/// Steps tried unless told otherwise, s.
pub const DT: [f64; 4] = [1e-1, 1e-2, 1e-3, 1e-4];

/// Tolerances tried unless told otherwise, degrees.
pub const TOLERANCES: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

/// The settings to try.
#[derive(Debug, Clone, PartialEq)]
pub struct Ladder {
    /// Methods to try, in any order.
    pub methods: Vec<Method>,
    /// Longest steps, s; none: [`DT`], of which only the longest where a step changes nothing but the cost.
    pub dt: Option<Vec<f64>>,
    /// Tolerances, degrees; none: [`TOLERANCES`], of which only the coarsest where a tolerance changes nothing but the
    /// cost.
    pub tolerances: Option<Vec<f64>>,
}

impl Default for Ladder {
    fn default() -> Ladder {
        Ladder { methods: Method::ALL.to_vec(), dt: None, tolerances: None }
    }
}

/// A setting, with only the knobs that its method has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rung {
    /// The method.
    pub method: Method,
    /// Longest step, s; none if the method has no step.
    pub dt: Option<f64>,
    /// Tolerance, a degree; none if the method has no tolerance.
    pub tolerance: Option<f64>,
}

impl Rung {
    /// The settings of a run of `until` seconds: a step that does not matter is as long as the run.
    pub fn settings(&self, until: f64) -> Settings {
        let idle = reference::settings(until);
        Settings {
            method: self.method,
            dt: self.dt.unwrap_or(idle.dt),
            tolerance: self.tolerance.unwrap_or(idle.tolerance),
        }
    }
}

impl Ladder {
    /// Every setting: by method in the program's order, then coarse to fine. Whatever is listed twice comes once.
    pub fn rungs(&self) -> Vec<Rung> {
        let methods = Method::ALL.iter().filter(|method| self.methods.contains(method));
        methods.flat_map(|&method| self.of(method)).collect()
    }

    fn of(&self, method: Method) -> Vec<Rung> {
        let Knobs { dt, tolerance } = knobs(method);
        let (dts, tolerances) = (values(dt, &self.dt, &DT), values(tolerance, &self.tolerances, &TOLERANCES));
        let pairs = dts.iter().flat_map(|&dt| tolerances.iter().map(move |&tolerance| (dt, tolerance)));
        pairs.map(|(dt, tolerance)| Rung { method, dt, tolerance }).collect()
    }
}

/// Values of a knob, large to small, each once; none, once, for a knob that does nothing.
fn values(effect: Effect, listed: &Option<Vec<f64>>, usual: &[f64]) -> Vec<Option<f64>> {
    let mut values = listed.as_deref().unwrap_or(usual).to_vec();
    values.sort_by(|a, b| b.total_cmp(a));
    values.dedup();
    match effect {
        Effect::Nothing => return vec![None],
        Effect::Cost if listed.is_none() => values.truncate(1),
        Effect::Cost | Effect::Error => {}
    }
    values.into_iter().map(Some).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dts(ladder: &Ladder, method: Method) -> Vec<Option<f64>> {
        let mut dts: Vec<_> = ladder.rungs().iter().filter(|rung| rung.method == method).map(|rung| rung.dt).collect();
        dts.dedup();
        dts
    }

    #[test]
    fn a_knob_that_a_method_lacks_is_not_multiplied() {
        let listed = Ladder { dt: Some(vec![1e-2, 1e-1, 1e-2]), ..Ladder::default() };
        assert_eq!(listed.rungs().iter().filter(|rung| rung.method == Method::Exact).count(), 1);
        assert_eq!(dts(&listed, Method::Exact), [None]);
        assert_eq!(dts(&listed, Method::Paper), [Some(1e-1), Some(1e-2)], "coarse to fine, each once");
    }

    #[test]
    fn a_step_that_only_costs_is_as_long_as_can_be_unless_steps_are_listed() {
        assert_eq!(dts(&Ladder::default(), Method::Swept), [Some(1e-1)]);
        let listed = Ladder { dt: Some(vec![1e-3, 1e-2]), ..Ladder::default() };
        assert_eq!(dts(&listed, Method::Swept), [Some(1e-2), Some(1e-3)]);
    }
}
