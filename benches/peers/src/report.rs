//! A table for people, rows for programs.

use crate::cases::Case;
use crate::engine::Entrant;
use crate::errors::Errors;
use crate::machine::Machine;
use crate::timing::Cost;

/// What was found on one entrant.
pub struct Row {
    /// What it costs.
    pub cost: Cost,
    /// What it gets wrong.
    pub error: Errors,
}

/// Prints a Markdown table of one scene.
pub fn table(case: &Case, rows: &[Row]) {
    println!("\n{}, {} s, {} spheres\n", case.name, case.until, case.scene.spheres.len());
    println!(
        "| engine | settings | CPU ms/s (worst) | ratio | mean (E−E₀)², J² | E/E₀−1 | mean Σ overlap², m² | deepest, m \
         | impacts/s |\n|---|---|---|---|---|---|---|---|---|"
    );
    for (entrant, Row { cost, error }) in case.entrants.iter().zip(rows) {
        println!(
            "| {} | {} | {:.3} ({:.3}) | {:.2} | {} | {} | {} | {} | {} |",
            entrant.engine(),
            entrant.settings(),
            1e3 * cost.best,
            1e3 * cost.worst,
            cost.best / rows[0].cost.best,
            if case.elastic { short(error.squared_energy) } else { "–".into() },
            if case.elastic { short(error.drift) } else { "–".into() },
            short(error.squared_overlap),
            short(error.deepest),
            error.impact_rate.map_or("–".into(), |rate| format!("{rate:.0}")),
        );
    }
}

/// Two digits.
fn short(number: f64) -> String {
    if number == 0.0 { "0".into() } else { format!("{number:.1e}") }
}

/// All rows of all scenes as CSV, all digits kept, each with the machine and the day.
pub fn raw(results: &[(&Case, Vec<Row>)], machine: &Machine, load_at_end: &str) -> String {
    let mut text = String::from(
        "date,cpu,cores,load_at_start,load_at_end,versions,scene,spheres,duration_s,engine,settings,frames_per_s,\
         cpu_s_per_s_best,cpu_s_per_s_worst,ratio,mean_squared_energy_error_j2,relative_energy_drift,\
         mean_squared_overlap_m2,deepest_overlap_m,impacts_per_s\n",
    );
    let Machine { cpu, cores, date, load, versions } = machine;
    for (case, rows) in results {
        for (entrant, row) in case.entrants.iter().zip(rows) {
            let fields = raw_fields(case, entrant, row, rows[0].cost.best);
            text.push_str(&format!("{date},{cpu},{cores},{load},{load_at_end},{versions},{fields}\n"));
        }
    }
    text
}

/// What depends on the run; energy is left empty where it need not last.
fn raw_fields(case: &Case, entrant: &Entrant, Row { cost, error }: &Row, first: f64) -> String {
    let elastic = |number: f64| if case.elastic { format!("{number:e}") } else { String::new() };
    [
        format!("{},{},{}", case.name, case.scene.spheres.len(), case.until),
        format!("{},{},{:.0}", entrant.engine(), entrant.settings(), entrant.rate()),
        format!("{:e},{:e},{}", cost.best, cost.worst, cost.best / first),
        format!("{},{}", elastic(error.squared_energy), elastic(error.drift)),
        format!("{:e},{:e}", error.squared_overlap, error.deepest),
        error.impact_rate.map_or(String::new(), |rate| rate.to_string()),
    ]
    .join(",")
}
