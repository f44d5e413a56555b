//! One error line on stderr and a true exit code; everything else is in the library.
#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    carom::cli::main()
}
