//! The hint line: the keys that are useful for what is on the screen.

use super::{action::Action, keymap::Keymap};

/// What the hint line is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// Anywhere else.
    Run,
    /// A pause at a frame with an impact, whose search can be gone through or not.
    Impact {
        /// Whether the frame's trial steps are known.
        searched: bool,
    },
    /// An earlier frame.
    Past,
    /// The scene list.
    List,
    /// The help.
    Help,
    /// The list of all that has happened.
    Events {
        /// Whether something was typed to narrow it.
        narrowed: bool,
    },
}

/// The hints: a key and a word each, the most needed first.
pub(super) fn hints(keymap: &Keymap, place: Place) -> Vec<(String, &'static str)> {
    let way: &[(Action, &'static str)] = match place {
        Place::Run => return keymap.hints(),
        Place::List => return plain(&[("j k", "move"), ("/", "filter"), ("Enter", "open"), ("Esc", "close")]),
        Place::Help => return plain(&[("j k", "scroll"), ("Esc", "close")]),
        Place::Events { narrowed } => {
            let out = if narrowed { "show all" } else { "close" };
            return plain(&[("Up Down", "move"), ("Enter", "go there"), ("3  wall 0  rest", "narrow"), ("Esc", out)]);
        }
        Place::Past => &[
            (Action::TogglePause, "go on here"),
            (Action::Step, "on"),
            (Action::StepBack, "back"),
            (Action::PreviousImpact, "collision before"),
            (Action::Newest, "newest"),
        ],
        Place::Impact { .. } => &[
            (Action::TogglePause, "run"),
            (Action::Step, "step"),
            (Action::StepBack, "back"),
            (Action::Card, "why"),
            (Action::NextTrial, "search"),
            (Action::NextImpact, "next"),
            (Action::PreviousImpact, "before"),
        ],
    };
    let out = [(Action::Help, "help"), (Action::Quit, "quit")];
    let shown = |action: Action| action != Action::NextTrial || place == Place::Impact { searched: true };
    let all = way.iter().chain(&out).filter(|(action, _)| shown(*action));
    all.filter_map(|(action, word)| Some((keymap.keys(*action).first()?.to_string(), *word))).collect()
}

fn plain(rows: &[(&str, &'static str)]) -> Vec<(String, &'static str)> {
    rows.iter().map(|(key, word)| ((*key).to_owned(), *word)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hints_lead_to_the_help_and_out_on_80_columns() {
        for place in [Place::Run, Place::Past, Place::Impact { searched: true }] {
            let mut column = 0;
            for (key, word) in hints(&Keymap::default(), place) {
                column += key.len() + 1 + word.len() + 2;
                if word == "quit" {
                    break;
                }
            }
            assert!(column <= 80, "{place:?}: `quit` ends in column {column}");
        }
    }
}
