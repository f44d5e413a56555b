//! No output destroys an input or another output, whatever it is called.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Stdio;

use tempfile::TempDir;

use crate::program::{self, Ran, carom, closing, folder, in_folder, names_in};
use crate::watch::finish;

/// A measure that takes no time.
const QUICK: [&str; 5] = ["measure", "paper-0", "--methods=paper", "--dt=1e-1", "--tolerances=1e-3"];

/// What `name`, a file of the folder whether or not it exists, is called by other words: with a detour, by its absolute
/// path, by a link to it, by a link to its folder.
fn spellings(folder: &TempDir, name: &str) -> Vec<String> {
    let (sub, linked, link) = (in_folder(folder, "sub"), in_folder(folder, "linked"), in_folder(folder, "link"));
    fs::create_dir(&sub).expect("a folder");
    symlink(".", &linked).expect("a link to the folder");
    symlink(name, &link).expect("a link to the file");
    let to_link = in_folder(folder, "link-to-link");
    symlink("sub/../link", &to_link).expect("a link to the link");
    let direct = in_folder(folder, name);
    vec![direct, in_folder(folder, &format!("sub/../{name}")), format!("{linked}/./{name}"), link, to_link]
}

/// Refused as wrong usage, in one line that holds both words.
#[track_caller]
fn refused(arguments: &[&str], words: [&str; 2]) {
    let ran = carom(arguments).fails_with(2);
    assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    assert!(words.iter().all(|word| ran.err.contains(word)), "{words:?} are not both in {}", ran.err);
    assert_eq!(ran.out, "");
}

#[test]
fn no_output_replaces_the_scene_it_is_made_of() {
    let folder = folder();
    let scene = in_folder(&folder, "s.ron");
    let text = carom(&["show", "paper-0"]).succeeds().out;
    fs::write(&scene, &text).expect("a file");
    let mut names = spellings(&folder, "s.ron");
    names.push(in_folder(&folder, "hard"));
    fs::hard_link(&scene, names.last().expect("it has some")).expect("a second name");
    let before = names_in(&folder);
    for name in &names {
        for option in ["--states", "--events"] {
            refused(&["run", &scene, "--until=0", option, name], [&scene, name]);
            refused(&["run", name, "--until=0", option, &scene], [&scene, name]);
        }
        for option in ["--csv", "--svg"] {
            let measure = ["measure", &scene, "--methods=paper", "--dt=0.1", "--tolerances=1e-3", option, name];
            refused(&measure, [&scene, name]);
        }
        let appended = fs::File::options().append(true).open(name).expect("the scene");
        let child = program::command(&["run", &scene, "--states", "-"]).stdout(appended).stderr(Stdio::piped()).spawn();
        assert!(Ran::from(finish(child.expect("the built binary"))).fails_with(2).err.contains(&scene));
    }
    assert_eq!(fs::read_to_string(&scene).expect("the scene"), text);
    assert_eq!(names_in(&folder), before);
}

#[test]
fn no_output_replaces_a_part_that_is_merged() {
    let folder = folder();
    let (one, two) = (in_folder(&folder, "1.csv"), in_folder(&folder, "2.csv"));
    carom(&[&QUICK[..], &["--shard=1/2", "--csv", &one]].concat()).succeeds();
    carom(&[&QUICK[..], &["--shard=2/2", "--csv", &two]].concat()).succeeds();
    let rows = fs::read(&two).expect("a part");
    for name in spellings(&folder, "2.csv") {
        for option in ["--csv", "--svg"] {
            refused(&["measure", "--merge", &one, &two, option, &name], [&two, &name]);
        }
    }
    assert_eq!(fs::read(&two).expect("a part"), rows);
}

#[test]
fn two_outputs_are_never_one_file() {
    for exists in [false, true] {
        let folder = folder();
        let plain = in_folder(&folder, "a.csv");
        let mut names = spellings(&folder, "a.csv");
        if exists {
            fs::write(&plain, "precious").expect("a file");
            names.push(in_folder(&folder, "hard"));
            fs::hard_link(&plain, names.last().expect("it has some")).expect("a second name");
        }
        let before = names_in(&folder);
        for name in &names {
            let run = ["run", "paper-0", "--until=0", "--states", &plain, "--events", name];
            refused(&run, ["--states and --events", &plain]);
            refused(&[&QUICK[..], &["--csv", name, "--svg", &plain]].concat(), ["--csv and --svg", name]);
        }
        assert_eq!(names_in(&folder), before);
        assert!(!exists || fs::read_to_string(&plain).expect("the file") == "precious");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn standard_output_is_itself_by_every_name() {
    for name in ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"] {
        refused(
            &["run", "paper-0", "--until=0", "--states", "-", "--events", name],
            ["--states and --events", "output"],
        );
        refused(
            &["run", "paper-0", "--until=0", "--states", name, "--events", "-"],
            ["--states and --events", "output"],
        );
        refused(&[&QUICK[..], &["--csv", name, "--svg", "-"]].concat(), ["--csv and --svg", "standard output"]);
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_file_that_the_shell_has_opened_is_written_and_not_replaced() {
    let folder = folder();
    let path = in_folder(&folder, "out.csv");
    let into_file = |name: &str, stream: &str| {
        let file = fs::File::create(&path).expect("a file");
        let mut command = program::command(&["run", "paper-0", "--until=0", "--states", name]);
        let (out, err) = match stream {
            "stdout" => (Stdio::from(file), Stdio::piped()),
            _ => (Stdio::piped(), Stdio::from(file)),
        };
        let ran = Ran::from(finish(command.stdout(out).stderr(err).spawn().expect("the built binary"))).succeeds();
        (ran, fs::read_to_string(&path).expect("what it wrote"))
    };
    for name in ["/dev/stdout", &path] {
        let (ran, written) = into_file(name, "stdout");
        assert!(written.starts_with("time,") && written.lines().count() == 2, "{written}");
        assert_eq!(closing(&ran.err).t, 0.0, "standard output has the table for itself");
    }
    let (ran, written) = into_file("/dev/stderr", "stderr");
    assert!(written.starts_with("time,"), "{written}");
    assert_eq!(closing(&ran.out).t, 0.0);
}

#[test]
fn the_null_device_takes_any_number_of_outputs() {
    carom(&["run", "paper-0", "--until=0", "--states", "/dev/null", "--events", "/dev/null"]).succeeds();
    carom(&[&QUICK[..], &["--csv", "/dev/null", "--svg", "/dev/null"]].concat()).succeeds();
    let mut command = program::command(&["run", "paper-0", "--until=0", "--states", "-", "--events", "/dev/null"]);
    let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("the built binary");
    Ran::from(finish(child)).succeeds();
}

#[test]
fn a_link_to_what_is_not_there_yet_is_followed() {
    let folder = folder();
    fs::create_dir(in_folder(&folder, "sub")).expect("a folder");
    let (link, chain, circle) = (in_folder(&folder, "link"), in_folder(&folder, "chain"), in_folder(&folder, "circle"));
    symlink("sub/new.csv", &link).expect("a link");
    symlink("link", &chain).expect("a link to it");
    symlink("circle", &circle).expect("a link to itself");
    carom(&["run", "paper-0", "--until=0", "--states", &chain]).succeeds();
    assert!(fs::symlink_metadata(&link).expect("the link").is_symlink());
    assert!(fs::symlink_metadata(&chain).expect("the link").is_symlink());
    assert!(fs::read_to_string(in_folder(&folder, "sub/new.csv")).expect("the file").starts_with("time,"));
    let ran = carom(&["run", "paper-0", "--until=0", "--states", &circle]).fails_with(1);
    assert!(ran.err.starts_with("carom: cannot write ") && ran.err.lines().count() == 1, "{}", ran.err);
    symlink("no/such/folder/x", in_folder(&folder, "nowhere")).expect("a link");
    carom(&["run", "paper-0", "--until=0", "--states", &in_folder(&folder, "nowhere")]).fails_with(1);
    assert!(!Path::new(&in_folder(&folder, "no")).exists());
}
