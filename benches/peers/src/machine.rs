//! Where and when: what a number is worth depends on it.

use std::fmt;
use std::time::{SystemTime, UNIX_EPOCH};

/// The machine, the day and the versions.
pub struct Machine {
    /// Processor, as the system names it.
    pub cpu: String,
    /// Cores this process may use.
    pub cores: usize,
    /// Day, UTC, `YYYY-MM-DD`.
    pub date: String,
    /// Averages of waiting processes over 1, 5 and 15 minutes at the start.
    pub load: String,
    /// `carom A; rapier3d-f64 B`.
    pub versions: String,
}

impl Machine {
    /// This one, now.
    pub fn here() -> Machine {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let versions = format!("carom {}; rapier3d-f64 {}", locked("carom"), locked("rapier3d-f64"));
        Machine { cpu: cpu(), cores, date: today(), load: load(), versions }
    }
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Machine { cpu, cores, date, load, versions } = self;
        write!(f, "{date}, {cpu}, {cores} cores, load {load}; {versions}; one thread each")
    }
}

fn cpu() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix("model name"));
    let name = line.and_then(|line| line.split_once(':')).map(|(_, name)| name.trim().replace(',', ""));
    name.unwrap_or_else(|| format!("unknown {}", std::env::consts::ARCH))
}

/// How many processes want to run, over 1, 5 and 15 minutes, where the system tells it.
pub fn load() -> String {
    let text = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    let averages: Vec<&str> = text.split_whitespace().take(3).collect();
    if averages.is_empty() { "unknown".into() } else { averages.join(" ") }
}

/// The version that the lock file beside this package holds.
fn locked(package: &str) -> &'static str {
    let lock = include_str!("../Cargo.lock");
    let entry = lock.split_once(&format!("name = \"{package}\"\nversion = \"")).map(|(_, rest)| rest);
    entry.and_then(|rest| rest.split('"').next()).unwrap_or("unknown")
}

/// Today's date, UTC, by the days since 1970 (H. Hinnant, `civil_from_days`).
fn today() -> String {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    // days since 0000-03-01, so that the leap day is a year's last
    let days = seconds / 86_400 + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (year, month) = (400 * era + year + month / 10, (month + 2) % 12 + 1);
    format!("{year:04}-{month:02}-{day:02}")
}
