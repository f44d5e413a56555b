//! `carom run --certify`: what the closing line then says, and what is refused.

use crate::program::{carom, closing};

#[test]
fn a_certified_run_says_until_when_and_how_far_it_is_off_and_is_the_run_by_exact() {
    let ran = carom(&["run", "paper-1", "--certify"]).succeeds();
    let line = closing(&ran.out);
    assert_eq!(line.certified_until, Some(20.0), "{}", ran.out);
    assert!(line.error.is_some_and(|error| error > 0.0 && error < 1e-10), "{}", ran.out);
    assert_eq!(ran.err, "");
    let plain = carom(&["run", "paper-1", "--method", "exact"]).succeeds().out;
    assert!(ran.out.starts_with(plain.trim_end()), "{} is not {plain}", ran.out);
}

#[test]
fn a_certificate_that_ends_early_says_where_and_why_and_is_no_failure() {
    let ran = carom(&["run", "stack", "--certify", "--until", "1"]).succeeds();
    let line = closing(&ran.out);
    assert!(line.certified_until.is_some_and(|until| until > 0.16 && until < 0.2), "{}", ran.out);
    let why = ["certified until 0.165", "no longer because of sphere", "amid impacts of one instant, whose order"];
    assert!(why.iter().all(|words| ran.err.contains(words)), "{}", ran.err);
}

#[test]
fn only_exact_is_certified() {
    let refused = carom(&["run", "paper-1", "--certify", "--method", "swept"]).fails_with(2);
    assert!(refused.err.contains("exact") && refused.err.contains("swept"), "{}", refused.err);
    carom(&["run", "paper-1", "--certify", "--accuracy", "1e-3"]).fails_with(2);
}
