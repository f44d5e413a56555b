//! Does the built binary meet the known results, and say so in a table?

use crate::watch;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

fn carom(words: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_carom"));
    command.args(words).stdin(Stdio::null());
    command
}

#[test]
fn every_known_result_is_met_here() {
    let done = watch::output(&mut carom(&["verify", "--quick"]));
    let (table, told) = (String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
    assert_eq!((done.status.code(), &*told), (Some(0), ""), "{table}");
    assert!(table.lines().all(|line| line.chars().count() <= 80), "{table}");

    let parts: Vec<Vec<&str>> = table
        .split_inclusive('\n')
        .map(str::trim_end)
        .collect::<Vec<_>>()
        .split(|line| line.starts_with('─'))
        .map(<[&str]>::to_vec)
        .collect();
    let [head, rows, notes] = parts.as_slice() else { panic!("two rules part a head, rows and notes:\n{table}") };
    assert_eq!(head.len(), 1);
    assert_eq!(
        head[0].split_whitespace().collect::<Vec<_>>(),
        ["known", "result", "expected", "found", "error", "allowed"]
    );
    assert!(rows.len() >= 25 && rows.iter().all(|row| row.ends_with(" pass")), "{table}");

    // Each check numbers its first row and its note.
    let numbers =
        |lines: &[&str]| lines.iter().filter_map(|line| line.get(..2)?.trim().parse().ok()).collect::<Vec<usize>>();
    assert_eq!(numbers(rows), (1..=numbers(rows).len()).collect::<Vec<_>>());
    assert_eq!(numbers(rows), numbers(notes));
    assert_eq!(notes.join(" ").matches("Allowed: ").count(), numbers(notes).len());
}

#[test]
fn who_reads_no_further_is_not_measured_for() {
    let mut child = carom(&["verify"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the built binary");
    let mut head = String::new();
    let mut reader = BufReader::new(child.stdout.take().expect("a pipe"));
    reader.read_line(&mut head).expect("the head of the table");
    drop(reader);
    let done = watch::finish(child);
    assert_eq!((done.status.code(), String::from_utf8_lossy(&done.stderr).as_ref()), (Some(141), ""));
}
