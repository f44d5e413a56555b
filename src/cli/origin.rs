//! Where results come from: the machine and the command, so that they can be repeated.

use std::thread;

use crate::printable;

/// What the timings are of: processor, cores, system, version.
pub(super) fn machine() -> String {
    let about = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = about.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    let model = model.map_or(std::env::consts::ARCH, |(_, name)| name.trim());
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let (system, version) = (std::env::consts::OS, env!("CARGO_PKG_VERSION"));
    printable::escaped(&format!("{model}, {cores} cores, {system}, carom {version}"))
}

/// The command line that was given.
pub(super) fn command() -> String {
    let words: Vec<String> = std::env::args_os().skip(1).map(|word| printable::name(&word)).collect();
    format!("carom {}", words.join(" "))
}
