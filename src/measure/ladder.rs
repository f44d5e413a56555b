//! Which settings are tried: methods × dt × tolerance, a knob that a method lacks tried once.

use super::reference;
use crate::physics::{Method, Settings, knobs};

/// Steps tried unless told otherwise, s.
pub const DT: [f64; 4] = [1e-1, 1e-2, 1e-3, 1e-4];

/// Tolerances tried unless told otherwise, degrees.
pub const TOLERANCES: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

/// The settings to try.
#[derive(Debug, Clone, PartialEq)]
pub struct Ladder {
    /// In this order.
    pub methods: Vec<Method>,
    /// Longest steps, s.
    pub dt: Vec<f64>,
    /// Tolerances, degrees.
    pub tolerances: Vec<f64>,
}

impl Default for Ladder {
    fn default() -> Ladder {
        Ladder { methods: Method::ALL.to_vec(), dt: DT.to_vec(), tolerances: TOLERANCES.to_vec() }
    }
}

/// A setting, with only the knobs that its method has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rung {
    /// The method.
    pub method: Method,
    /// Longest step, s, if it matters.
    pub dt: Option<f64>,
    /// Tolerance, a degree, if it matters.
    pub tolerance: Option<f64>,
}

impl Rung {
    /// What to run with for `until` seconds: a step that does not matter is as long as the run.
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
        let used = knobs(method);
        let (dts, tolerances) = (values(used.dt, &self.dt), values(used.tolerance, &self.tolerances));
        let pairs = dts.iter().flat_map(|&dt| tolerances.iter().map(move |&tolerance| (dt, tolerance)));
        pairs.map(|(dt, tolerance)| Rung { method, dt, tolerance }).collect()
    }
}

/// Large to small, each once; nothing, once, for a knob that is not used.
fn values(used: bool, list: &[f64]) -> Vec<Option<f64>> {
    if !used {
        return vec![None];
    }
    let mut values = list.to_vec();
    values.sort_by(|a, b| b.total_cmp(a));
    values.dedup();
    values.into_iter().map(Some).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_knob_that_a_method_lacks_is_not_multiplied() {
        let ladder = Ladder { dt: vec![1e-2, 1e-1, 1e-2], tolerances: vec![1e-3], ..Ladder::default() };
        let rungs = ladder.rungs();
        let of = |method| rungs.iter().filter(|rung| rung.method == method).collect::<Vec<_>>();
        assert_eq!(of(Method::Exact), [&Rung { method: Method::Exact, dt: None, tolerance: None }]);
        let dts: Vec<_> = of(Method::Paper).iter().map(|rung| rung.dt).collect();
        assert_eq!(dts, [Some(1e-1), Some(1e-2)], "coarse to fine, each once");
    }
}
