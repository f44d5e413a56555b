//! Recordings that prove themselves, and films of the screen.

use std::fs;

use crate::program::{carom, folder, in_folder};

/// Where the sums of a recording's frames begin, and the frames there are.
fn frames(bytes: &[u8]) -> (usize, usize) {
    let head = String::from_utf8_lossy(bytes);
    let count = head.lines().find_map(|line| line.strip_prefix("frames ")).expect("a head");
    let count: usize = count.parse().expect("a number");
    (bytes.len() - 8 * count, count)
}

#[test]
fn a_recording_is_replayed_to_the_bit_by_every_method() {
    let folder = folder();
    for method in ["paper", "exact", "swept", "moreau"] {
        let file = in_folder(&folder, &format!("{method}.carom"));
        carom(&["record", "paper-3", &file, "--until", "2", "--method", method]).succeeds();
        let ran = carom(&["replay", &file]).succeeds();
        assert!(ran.out.starts_with("frames=") && ran.out.trim().ends_with("same"), "{method}: {}", ran.out);
        let alone = carom(&["run", "paper-3", "--until", "2", "--method", method]).succeeds().out;
        let hash = |text: &str| text.split_whitespace().find(|word| word.starts_with("hash=")).map(str::to_owned);
        // `run` ends at 2 s; the recording's last frame may end later.
        if ran.out.contains("t=2.0 ") {
            assert_eq!(hash(&ran.out), hash(&alone), "{method}");
        }
    }
}

#[test]
fn a_flipped_bit_names_its_frame_and_the_file_is_damaged() {
    let folder = folder();
    let file = in_folder(&folder, "fall.carom");
    carom(&["record", "paper-1", &file, "--until", "1"]).succeeds();
    let bytes = fs::read(&file).expect("it is there");
    let (start, count) = frames(&bytes);
    for frame in [0, 1, count / 2, count - 1] {
        let mut flipped = bytes.clone();
        flipped[start + 8 * frame + 2] ^= 0x10;
        fs::write(&file, flipped).expect("written");
        let ran = carom(&["replay", &file]).fails_with(1);
        assert!(ran.err.contains(&format!("frame {frame}, at t = ")), "{}", ran.err);
        assert!(
            ran.err.contains("differs: more than one sphere is not as recorded, or the file is damaged there"),
            "{}",
            ran.err
        );
    }
}

#[test]
fn another_scene_names_the_first_frame_and_the_sphere_that_differ() {
    let folder = folder();
    let file = in_folder(&folder, "three.carom");
    carom(&["record", "paper-2", &file, "--until", "1"]).succeeds();
    let text = fs::read(&file).expect("it is there");
    let (start, _) = frames(&text);
    // As many bytes, another digit: sphere 1 begins elsewhere.
    let head = String::from_utf8_lossy(&text[..start]).into_owned();
    let place = head.match_indices("Sphere(x: (").nth(1).expect("a second sphere").0;
    let (before, after) = head.split_at(place);
    let digit = 11 + after[11..].find(|c: char| c.is_ascii_digit()).expect("a digit");
    let mut changed = format!("{before}{after}").into_bytes();
    let old = changed[place + digit];
    changed[place + digit] = if old == b'9' { b'8' } else { old + 1 };
    fs::write(&file, [&changed[..], &text[start..]].concat()).expect("written");
    let ran = carom(&["replay", &file]).fails_with(1);
    assert!(ran.err.contains("frame 0, at t = 0.0 s, differs: sphere 1 is not as recorded"), "{}", ran.err);
}

#[test]
fn what_is_no_recording_is_refused_and_no_file_is_replaced_unasked() {
    let folder = folder();
    let file = in_folder(&folder, "x.carom");
    fs::write(&file, "Scene()\n").expect("written");
    assert!(carom(&["replay", &file]).fails_with(1).err.contains("this is no recording"));
    let ran = carom(&["record", "paper-0", &file, "--until", "0.1"]).fails_with(1);
    assert!(ran.err.contains("is there already; --force replaces it"), "{}", ran.err);
    assert_eq!(fs::read_to_string(&file).expect("it is there"), "Scene()\n");
    carom(&["record", "paper-0", &file, "--until", "0.1", "--force"]).succeeds();
    let bytes = fs::read(&file).expect("it is there");
    fs::write(&file, &bytes[..bytes.len() - 3]).expect("written");
    assert!(carom(&["replay", &file]).fails_with(1).err.contains("ends 3 bytes early"));
    assert!(carom(&["record", "paper-0", &in_folder(&folder, "x.txt")]).fails_with(2).err.contains(".cast"));
}

#[test]
fn a_recording_of_a_hundred_thousand_frames_is_less_than_a_megabyte() {
    let folder = folder();
    let file = in_folder(&folder, "long.carom");
    carom(&["record", "paper-0", &file, "--until", "10", "--dt", "1e-4"]).succeeds();
    let bytes = fs::read(&file).expect("it is there");
    let (_, count) = frames(&bytes);
    assert!(count > 100_000 && bytes.len() < 1_000_000, "{count} frames, {} bytes", bytes.len());
}

#[test]
fn a_film_has_a_header_pictures_in_order_and_a_marker_per_collision() {
    let folder = folder();
    let file = in_folder(&folder, "film.cast");
    carom(&["record", "paper-2", &file, "--until", "1", "--size", "80x24"]).succeeds();
    let film = fs::read_to_string(&file).expect("text");
    let mut lines = film.lines();
    let header: serde_json::Value = serde_json::from_str(lines.next().expect("a header")).expect("JSON");
    assert_eq!((&header["version"], &header["term"]["cols"]), (&3.into(), &80.into()));
    let mut emulator = vt100::Parser::new(24.try_into().expect("not 0"), 80.try_into().expect("not 0"), 0);
    let (mut seconds, mut markers) = (0.0, 0);
    for line in lines {
        let event: serde_json::Value = serde_json::from_str(line).unwrap_or_else(|error| panic!("{error}: {line}"));
        seconds += event[0].as_f64().expect("a time since the line before");
        match event[1].as_str().expect("a kind") {
            "o" => emulator.process(event[2].as_str().expect("text").as_bytes()),
            "m" => markers += 1,
            other => panic!("{other}"),
        }
    }
    let closing = carom(&["run", "paper-2", "--until", "1"]).succeeds().out;
    assert!(closing.contains(&format!("impacts={markers} ")), "{markers} markers, {closing}");
    assert!((0.95..=1.05).contains(&seconds), "{seconds} s");
    assert!(emulator.screen().contents().contains("paper-2"), "{}", emulator.screen().contents());
}
