//! How far work is that may take minutes, on a terminal.

use std::io::{self, IsTerminal};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Steps of the progress bar: finer than any terminal shows.
pub(super) const STEPS: f64 = 1000.0;

/// Time between two pictures of a progress bar that counts: it shows seconds.
const TICK: Duration = Duration::from_millis(250);

/// A progress bar of `length` steps on stderr; nothing is drawn where that is no terminal, or a dumb one.
pub(super) fn bar(length: u64, template: &str) -> ProgressBar {
    let dumb = std::env::var_os("TERM").is_none_or(|term| term == "dumb");
    if dumb || !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(length), ProgressDrawTarget::stderr());
    ProgressStyle::with_template(template).map(|style| bar.clone().with_style(style)).unwrap_or(bar)
}

/// A progress bar of [`STEPS`] that says how many of `wanted` things (`what`, a plural) are done.
pub(super) fn counting(wanted: usize, what: &str) -> ProgressBar {
    let template =
        format!("{{bar:32}} {{percent:>3}} %  {{msg}} of {wanted} {what}, {{elapsed}} elapsed, {{eta}} to go");
    let bar = bar(STEPS as u64, &template);
    if !bar.is_hidden() {
        bar.set_message("0");
        bar.enable_steady_tick(TICK); // the time left goes on while a setting is measured
    }
    bar
}
