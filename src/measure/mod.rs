//! Runs without a screen that answer a question: what is exact, what it costs, whether known results are met.

pub mod verify;
