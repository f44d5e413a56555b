//! The command line: arguments turned into plain values, and which wing runs.

/// Runs the program; the exit code is 0 done, 1 failed, 2 wrong usage, 128 + n for signal n.
pub fn main() -> std::process::ExitCode {
    std::process::ExitCode::SUCCESS
}
