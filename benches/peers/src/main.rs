//! Carom beside another engine: the same scenes by both in one run, the time of each as a ratio, the error of each.
//!
//! `cargo run --release --manifest-path benches/peers/Cargo.toml [-- [SCENE…] [--rounds K] [--raw FILE]]`
//!
//! Rapier is a real-time engine: any shapes, rotation, friction, joints, a fixed price per frame. Carom knows spheres and
//! flat walls only, and no friction worth the name. A ratio here says what specialising buys on these scenes, and
//! nothing on what Carom cannot do at all.

// Results go to stdout: this is a program for people.
#![allow(clippy::print_stdout)]
#![forbid(unsafe_code)]

use std::process::ExitCode;

mod arguments;
mod cases;
mod engine;
mod errors;
mod machine;
mod overlap;
mod peer;
mod report;
mod timing;

use arguments::Arguments;
use machine::Machine;
use report::Row;

fn main() -> ExitCode {
    match Arguments::read(std::env::args().skip(1)).and_then(|arguments| run(&arguments)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

/// Measures the cases asked for, prints a table each, keeps the raw rows where asked to.
fn run(arguments: &Arguments) -> Result<(), String> {
    let machine = Machine::here();
    println!("{machine}");
    let cases = cases::all();
    let mut results = Vec::new();
    for case in cases.iter().filter(|case| arguments.wants(case.name)) {
        let costs = timing::interleaved(case, arguments.rounds);
        let errors = case.entrants.iter().map(|entrant| errors::of(case, entrant));
        let rows: Vec<Row> = costs.into_iter().zip(errors).map(|(cost, error)| Row { cost, error }).collect();
        report::table(case, &rows);
        results.push((case, rows));
    }
    let load = machine::load();
    println!("\nload at the end: {load}");
    match &arguments.raw {
        Some(path) => std::fs::write(path, report::raw(&results, &machine, &load))
            .map_err(|error| format!("{} could not be written: {error}.", path.display())),
        None => Ok(()),
    }
}
