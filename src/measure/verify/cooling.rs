//! Haff's law: how a gas that loses energy at impacts cools while it is homogeneous.

use super::bodies::ELASTIC;
use super::check::Check;
use super::gas::{Gas, SIGMA, continued, gas};
use super::runner::{Row, Runner, Trouble};
use crate::scene::ContactLaw;

pub(super) const CHECK: Check = Check {
    title: "Haff's law",
    source: "granular temperature T = T₀/(1 + t/τ)², 1/τ = (1 − e²) ω₀/6, ω₀ the impacts of a sphere in unit time \
             before; that is exp(−(1 − e²) C/3) after C impacts of each (Haff, J. Fluid Mech. 134, 401, 1983); e = \
             0.99, walls elastic",
    allowed: "three standard errors of the energy that so many impacts lose, and of ω₀; 1e-3 for e near 1",
    measure,
};

const E: f64 = 0.99;

/// Share of the box that is filled: dilute, so that nothing clusters for long.
const PACKING: f64 = 0.1;

fn measure(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    let (count, looks) = runner.pick((2000, 500), (10_000, 2000));
    let scene = gas(PACKING, count, &[1.0])?;
    let mut elastic = Gas::thermal(runner, &scene)?;
    let (start, window) = (elastic.run.time(), 0.1 * SIGMA * f64::from(looks));
    let state = elastic.go(start + window)?;
    let before = elastic.impacts().filter(|impact| impact.time <= start + window).count() as f64;
    let rate = 2.0 * before / (elastic.count * window);
    let tau = 6.0 / ((1.0 - E * E) * rate);

    let lossy = continued(&scene, &state, ContactLaw { restitution: E, ..ELASTIC })?;
    let mut gas = Gas::new(runner, &lossy);
    gas.run.record_events(true);
    let first = gas.temperature();
    // T falls to 4/9: 122 impacts of each sphere.
    let end = gas.go(0.5 * tau)?;
    let impacts = gas.impacts().filter(|impact| impact.time <= 0.5 * tau).count() as f64;
    let found = end.energy(gas.run.model()) * 2.0 / (3.0 * gas.count) / first;
    let each = 2.0 * impacts / gas.count;
    let after = (-(1.0 - E * E) * each / 3.0).exp();
    // An impact loses (1 − e²) kT on average, exponentially distributed: as much as that is its standard deviation.
    let scatter = (1.0 - E * E) * each / 3.0 / impacts.sqrt();
    // T ~ (1 + t/τ)^−2 varies by 2 (t/τ)/(1 + t/τ) = 2/3 of what ω₀ does, which scatters as its root at most.
    let clock = 2.0 / 3.0 / before.sqrt();
    Ok(vec![
        Row::new(format!("T/T₀ after {each:.1} impacts"), "", [after, found], 1e-3 + 3.0 * scatter),
        Row::new("T/T₀ at half of τ", "", [4.0 / 9.0, found], 1e-3 + 3.0 * scatter.hypot(clock)),
    ])
}
