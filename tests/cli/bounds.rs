//! Nothing without bound: rows, time, memory and inputs that are asked for without being meant.

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command};

use rustix::process::{Pid, Signal, kill_process};

use crate::program::{Ran, carom, folder, in_folder, piped, spawn};
use crate::watch::{Watch, finish};

/// The first line on stderr of a run that would not end; the run is then ended.
fn first_words(mut child: Child) -> String {
    let watch = Watch::over(Pid::from_child(&child));
    let mut said = String::new();
    let err = child.stderr.take().expect("its stderr");
    BufReader::new(err).read_line(&mut said).expect("a line");
    kill_process(Pid::from_child(&child), Signal::TERM).expect("a living process");
    assert_eq!(finish(child).status.code(), Some(143));
    drop(watch);
    said
}

#[test]
fn a_run_that_nobody_will_see_end_says_so_in_the_numbers_it_was_given() {
    let cases: &[(&[&str], &[&str])] = &[
        (&["run", "paper-0", "--until", "1e300"], &["1e300 s", "1e302 frames of 0.01 s"]),
        (&["run", "paper-0", "--until", "1", "--dt", "1e-17"], &["1 s take 1e17 frames of 1e-17 s"]),
        (&["run", "paper-0", "--until", "1e300", "--dt", "1e-300"], &["more than 1e308 frames"]),
        (
            &["run", "newtons-cradle", "--method", "exact", "--until", "1e300"],
            &["1e300 s", "times the scene's duration"],
        ),
        (&["run", "paper-0", "--until", "1.7976931348623157e308"], &["1.798e308 s", "frames"]),
        (&["render", "paper-0", "--at", "1e300"], &["1e300 s", "1e302 frames"]),
        (&["--text", "paper-0", "--dt", "1e-17"], &["20 s", "2e18 frames"]),
        (&["measure", "paper-0", "--methods", "paper", "--dt", "0.1,1e-17"], &["20 s", "2e18 frames of 1e-17 s"]),
    ];
    for (arguments, words) in cases {
        let said = first_words(spawn(arguments));
        assert!(words.iter().all(|word| said.contains(word)), "{arguments:?}: {words:?} are not in {said}");
        assert!(said.len() < 200, "{said}");
    }
}

#[test]
fn a_run_that_ends_soon_is_not_warned_of_by_the_scene_s_duration() {
    // 20 s of it would take 2e16 frames; what is asked for takes one hundred.
    let ran = carom(&["run", "paper-0", "--dt", "1e-15", "--until", "1e-13"]).succeeds();
    assert_eq!(ran.err, "");
}

#[test]
fn more_rows_than_anybody_has_room_for_are_written_only_if_they_are_meant() {
    for (every, rows) in [("1e-300", "2e301"), ("5e-324", "more than 1e308"), ("1e-7", "2e8")] {
        let asked = ["run", "paper-0", "--states", "-", "--every", every];
        let ran = carom(&asked).fails_with(2);
        assert!(ran.err.contains(&format!("asks for {rows} rows")) && ran.err.contains("--yes"), "{}", ran.err);
        assert!(ran.err.lines().count() == 1 && ran.err.len() < 200 && ran.out.is_empty(), "{}", ran.err);
    }
    let meant = ["run", "paper-0", "--states", "/dev/null", "--every", "1e-300", "--yes"];
    assert!(first_words(spawn(&meant)).contains("writes 2e301 rows"));
    carom(&["run", "paper-0", "--until", "1", "--states", "/dev/null", "--every", "1e-4"]).succeeds();
}

#[test]
fn what_is_merged_is_a_file_and_not_too_large() {
    let folder = folder();
    let large = in_folder(&folder, "large.csv");
    fs::File::create(&large).and_then(|file| file.set_len((16 << 20) + 1)).expect("sparse");
    let pipe = in_folder(&folder, "pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().is_ok_and(|status| status.success()));
    for (path, words) in [
        ("/dev/zero", "a device or pipe"),
        (pipe.as_str(), "a device or pipe"),
        (folder.path().to_str().expect("a plain path"), "a folder"),
        (large.as_str(), "16777217 bytes is refused; allowed are up to 16 MiB"),
    ] {
        let ran = carom(&["measure", "--merge", path]).fails_with(1);
        assert!(ran.err.contains(path) && ran.err.contains(words), "{}", ran.err);
        assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_scene_too_large_for_the_memory_there_is_is_refused_before_it_is_made() {
    let folder = folder();
    let scene = in_folder(&folder, "large.ron");
    let crystal = "Lattice(origin: (0, 0, 0), counts: (100, 100, 100), spacing: 1, mass: 1, radius: 0.4)";
    fs::write(&scene, format!("Scene(spheres: [{crystal}])")).expect("a file");
    for command in ["check", "run", "render"] {
        let mut shell = Command::new("sh");
        let limited = r#"ulimit -v 500000; exec "$0" "$@""#;
        shell.args(["-c", limited, env!("CARGO_BIN_EXE_carom"), command, &scene]);
        let ran = Ran::from(finish(piped(shell))).fails_with(1);
        assert!(
            ran.err.contains("large.ron:1:") && ran.err.contains("1000000 spheres and 0 walls need"),
            "{}",
            ran.err
        );
        assert!(ran.err.contains("ulimit -v") && ran.err.lines().count() == 1, "{}", ran.err);
    }
}
