//! `carom list`: the built-in scenes, a line each.

use std::io::{self, IsTerminal, Write};

use super::failure::Failure;
use super::output::Output;
use crate::scene::{self, builtin};

pub(super) fn list() -> Result<(), Failure> {
    let mut out = Output::stdout();
    for line in lines(&entries()?, width()) {
        writeln!(out, "{line}")?;
    }
    out.finish()
}

/// Name and `about` of every built-in scene.
fn entries() -> Result<Vec<(&'static str, String)>, Failure> {
    let about = |name| scene::open(name).map(|opened| opened.scene.about.clone());
    let entries = builtin::ALL.iter().map(|scene| about(scene.name).map(|about| (scene.name, about)));
    entries.collect::<Result<_, _>>().map_err(|error| Failure::Failed(error.to_string()))
}

/// Columns of the terminal; none if the lines go elsewhere, which takes them whole.
fn width() -> Option<usize> {
    let stdout = io::stdout();
    let size = stdout.is_terminal().then(|| rustix::termios::tcgetwinsize(&stdout).ok()).flatten()?;
    Some(size.ws_col.into()).filter(|columns| *columns > 0)
}

fn lines(entries: &[(&str, String)], width: Option<usize>) -> Vec<String> {
    let column = entries.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
    let line = |(name, about): &(&str, String)| format!("{name:column$}  {about}").trim_end().to_string();
    entries.iter().map(line).map(|line| cut(line, width.unwrap_or(usize::MAX))).collect()
}

fn cut(line: String, width: usize) -> String {
    if line.chars().count() <= width {
        return line;
    }
    line.chars().take(width.saturating_sub(1)).chain(['…']).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_aligned_and_long_lines_are_cut_to_the_terminal() {
        let entries = [("a", "short".to_string()), ("long-name", "a line of some length".to_string())];
        assert_eq!(lines(&entries, None), ["a          short", "long-name  a line of some length"]);
        assert_eq!(lines(&entries, Some(20)), ["a          short", "long-name  a line o…"]);
    }
}
