//! How far work is that may take minutes, on a terminal.

use std::io::{self, IsTerminal};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Steps of the progress bar: finer than any terminal shows.
pub(super) const STEPS: f64 = 1000.0;

/// Time between two pictures of the progress bar: it counts seconds.
const TICK: Duration = Duration::from_millis(250);

/// A progress bar on stderr; indicatif draws nothing where that is no terminal.
pub(super) fn progress_bar(wanted: usize, what: &str) -> ProgressBar {
    let dumb = std::env::var_os("TERM").is_none_or(|term| term == "dumb");
    if dumb || !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let template =
        format!("{{bar:32}} {{percent:>3}} %  {{msg}} of {wanted} {what}, {{elapsed}} elapsed, {{eta}} to go");
    let bar = ProgressBar::with_draw_target(Some(STEPS as u64), ProgressDrawTarget::stderr());
    let bar = ProgressStyle::with_template(&template).map(|style| bar.clone().with_style(style)).unwrap_or(bar);
    bar.set_message("0");
    bar.enable_steady_tick(TICK); // the time left goes on while a setting is measured
    bar
}
