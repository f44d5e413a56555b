//! The physics: closed forms, conservation, bits, rest, crowds, and what each method promises; and the judge. A file is a
//! question, `cargo test --test engine NAME::` asks one.
#![allow(clippy::print_stdout)] // the table of the extremes, asked for by `--nocapture`

mod agreement;
mod at_rest;
mod audit;
mod cases;
mod contact_times;
mod crowds;
mod exact;
mod exact_laws;
mod exact_repeat;
mod extremes;
mod funnels;
mod gas;
mod hops;
mod impact_law;
mod keyframes;
mod laws;
mod long;
mod long_chains;
mod moreau;
mod moreau_walls;
#[path = "../support/random.rs"]
mod random;
mod redundant;
mod rest_reasons;
mod roots;
mod seams;
mod seeds;
#[path = "../support/sums.rs"]
mod sums;
#[path = "../support/mod.rs"]
mod support;
mod support_laws;
mod swept;
