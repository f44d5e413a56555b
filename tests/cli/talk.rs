//! Can a run be led without a screen, line by line?

use std::io::Write;
use std::process::Stdio;

use crate::program::{Ran, command};

/// What is told when these lines come, all at once, through a pipe.
fn talk(scene: &str, lines: &str) -> Ran {
    talk_in(std::path::Path::new("."), scene, lines)
}

/// The same in a folder.
fn talk_in(folder: &std::path::Path, scene: &str, lines: &str) -> Ran {
    let mut command = command(&["--text", "--paused", scene]);
    command.current_dir(folder);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the built binary");
    let mut stdin = child.stdin.take().expect("a pipe");
    stdin.write_all(lines.as_bytes()).expect("it is read");
    drop(stdin);
    let ran = Ran::from(child.wait_with_output().expect("it ends"));
    assert!(ran.out.lines().all(|line| line.chars().all(carom::printable::is_printable)), "{ran:?}");
    ran
}

#[test]
fn a_run_is_stepped_with_empty_lines_and_with_the_keys() {
    let said = talk("paper-0", "\n\n.\nn\nRight\n....\nq\n").succeeds().out;
    let times: Vec<&str> = said.lines().filter(|line| line.starts_with("At ")).collect();
    let expected = ["At 0 ", "At 0.01 ", "At 0.02 ", "At 0.03 ", "At 0.04 ", "At 0.05 ", "At 0.09 "];
    assert_eq!(times.len(), expected.len(), "{said}");
    assert!(times.iter().zip(expected).all(|(line, time)| line.starts_with(time)), "{said}");
}

#[test]
fn it_goes_to_a_collision_and_shows_its_card() {
    let said = talk("paper-1", "c\ncard\ncard 0\ncard 9\nq\n").succeeds().out;
    let card = "Sphere 0 and wall 6: impact at ";
    assert_eq!(said.matches(card).count(), 3, "told when it comes, among all, and by number: {said}");
    for word in ["m/s", "N s", "degree", "9 is not allowed: there are contacts 0 to "] {
        assert!(said.contains(word), "{word:?} is not in {said}");
    }
    assert!(talk("paper-0", "\ncard\n").succeeds().out.contains("no contacts in this frame"));
}

#[test]
fn it_runs_until_what_is_waited_for_and_steps_back() {
    let said = talk("paper-0", ":until rest\n,\nu\ncollision\nq\n").succeeds().out;
    let times: Vec<f64> =
        said.lines().filter_map(|line| line.strip_prefix("At ")?.strip_suffix(" seconds.")?.parse().ok()).collect();
    assert!(times.len() >= 3 && times[1] > 1.0 && times[2] < times[1], "{said}");
    assert!(said.contains("An order is a line of its own"), "{said}");
}

#[test]
fn it_goes_back_from_collision_to_collision_and_to_both_ends() {
    let said = talk("paper-0", "c\nc\n,\nC\nC\ng\nG\n:goto 0.5\nq\n").succeeds().out;
    let times: Vec<f64> =
        said.lines().filter_map(|line| line.strip_prefix("At ")?.strip_suffix(" seconds.")?.parse().ok()).collect();
    let [start, first, second, before, again, oldest, newest, gone_to] = times[..] else { panic!("{said}") };
    assert!(start == 0.0 && first < second && before < second && before > first, "{said}");
    assert_eq!((again, oldest, newest), (first, 0.0, second), "{said}");
    assert_eq!(said.matches("There is no collision before this one.").count(), 1, "{said}");
    assert_eq!(gone_to, 0.5, "{said}");
}

#[test]
fn it_lists_what_has_happened_as_far_as_it_is_wanted() {
    let said = talk("paper-3", "log 0 1\n:goto 3\nlog\nlog wall 0\nlog rest\nlog bounce\nL\nq\n").succeeds().out;
    assert!(said.contains("Nothing of this has happened."), "{said}");
    let listed = |text: &str| said.lines().filter(|line| line.contains(text) && line.contains(". At ")).count();
    assert!(listed("spheres 0 and 1 collide") >= 2, "in both whole lists: {said}");
    assert_eq!(said.matches("On the way").count(), 1, "what was answered before is not said again: {said}");
    assert_eq!(listed("hits wall 0") % 3, 0, "in both whole lists and in the short one: {said}");
    assert!(said.contains("bounce is not allowed: a filter takes spheres"), "{said}");
}

#[test]
fn a_state_that_is_taken_away_goes_on_to_the_end_that_the_run_has() {
    let folder = tempfile::tempdir().expect("a folder");
    let said = talk_in(folder.path(), "paper-3", ":goto 2\ne\nq\n").succeeds().out;
    assert!(said.contains("paper-3-1.ron, which goes on from t = 2.0"), "{said}");
    let file = folder.path().join("paper-3-1.ron");
    let file = file.to_str().expect("a plain path");
    let end = |scene: &str| {
        let line = command(&["run", scene, "--until", "9.5"]).output().expect("the built binary");
        let line = Ran::from(line).succeeds().out;
        line.split_whitespace().find(|word| word.starts_with("hash=")).map(str::to_owned)
    };
    assert!(end(file).is_some());
    assert_eq!(end(file), end("paper-3"));
    let rows = Ran::from(
        command(&["run", file, "--states", "-", "--every", "1", "--until", "4"]).output().expect("the built binary"),
    );
    let rows = rows.succeeds().out;
    let times: Vec<&str> = rows.lines().skip(1).filter_map(|row| row.split(',').next()).collect();
    assert_eq!(times, ["3.0", "3.0", "4.0", "4.0"], "nothing is told of what was before: {rows}");
    for arguments in [&["measure", file][..], &["run", file, "--certify"], &["run", file, "--accuracy", "1e-6"]] {
        let ran = Ran::from(command(arguments).output().expect("the built binary"));
        assert!(ran.err.contains("counts errors from a scene's start, and this one goes on from t = 2.0"), "{ran:?}");
    }
}

#[test]
fn a_recording_with_changes_is_replayed_and_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let said =
        talk_in(folder.path(), "paper-3", ":goto 0.5\nE\n:goto 1\nmm\n:goto 1.5\ns\n:goto 2\nq\n").succeeds().out;
    assert!(said.contains("Recording from t = 0.5 s on."), "{said}");
    let file = folder.path().join("paper-3-1.carom");
    let file = file.to_str().expect("a plain path");
    let ran = |arguments: &[&str]| Ran::from(command(arguments).output().expect("the built binary"));
    let replayed = ran(&["replay", file]).succeeds().out;
    assert!(replayed.trim().ends_with("same"), "written at the end of the talk, and the same: {replayed}");
    let told = talk(file, ":goto 9\n:hash\nq\n").succeeds().out;
    assert!(told.contains("all of it as recorded."), "{told}");
    let hash = |text: &str| text.split_whitespace().find(|word| word.starts_with("hash=")).map(str::to_owned);
    assert_eq!(hash(&told), hash(&replayed));
    assert!(ran(&["--text", "--paused", file, "--dt", "0.1"]).fails_with(2).err.contains("its own settings"));
    let told = Ran::from(command(&["--text", file]).stdin(Stdio::null()).output().expect("the built binary"));
    let told = told.succeeds().out;
    let impacts = told.lines().filter(|line| line.contains(" hits ")).count();
    assert!(impacts > 0 && told.contains("all of it as recorded."), "told like a run, up to its end: {told}");
    let mut bytes = std::fs::read(file).expect("it is there");
    let last = bytes.len() - 8 * 40 + 2;
    bytes[last] ^= 0x10;
    std::fs::write(file, bytes).expect("written");
    assert!(ran(&["replay", file]).fails_with(1).err.contains("differs"));
    assert!(talk(file, ":goto 9\nq\n").succeeds().out.contains("differs, at t = "));
}

#[test]
fn orders_are_obeyed_in_turn_and_wrong_ones_are_told() {
    let said =
        talk("paper-0", ":goto 2\n:tolerance 1e-6\n.\n:nonsense\n:hash\n?\nZ\n\u{1b}[A\u{202e}\nq\n").succeeds().out;
    let place = |text: &str| said.find(text).unwrap_or_else(|| panic!("{text:?} is not in {said}"));
    assert!(place("At 2 seconds.") < place("At 2.0") || place("At 2 seconds.") < place("There is no :nonsense"));
    assert!(place("There is no :nonsense") < place("hash="));
    assert!(place("hash=") < place("q Ctrl-C: quit."));
    assert!(place("q Ctrl-C: quit.") < place("Z has a use on a screen only."));
}

#[test]
fn the_end_of_the_lines_and_lines_without_end_do_no_harm() {
    talk("paper-0", "").succeeds();
    talk("paper-0", " ").succeeds();
    let said = talk("paper-0", &format!("{}\n.\nq\n", ":goto 1 ".repeat(100_000))).succeeds().out;
    assert!(said.contains("At 0.01 seconds."), "{}", said.len());
}
