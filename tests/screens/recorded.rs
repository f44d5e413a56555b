//! Does a recording made on the screen hold the run, and can it be gone through again?

use carom::{
    physics::{Progress, Simulation, Until},
    recording::{Recording, Sums},
    scene,
};

use super::app::User;

/// The recording of that name.
fn recording(user: &User, name: &str) -> Recording {
    let bytes = std::fs::read(user.folder.path().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    Recording::from_bytes(&bytes).expect("it is a recording")
}

/// What the keys have led to, in one line.
fn said(user: &User) -> String {
    user.text().split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Runs a recording by itself, its changes made where they were: the first frame that is not as recorded.
fn differs(recording: &Recording) -> Option<usize> {
    let scene = scene::parse(&recording.scene, "recorded").expect("a scene");
    let mut run = Simulation::new(&scene, recording.settings);
    let mut changes = recording.changes.iter().peekable();
    for (frame, sums) in recording.frames.iter().enumerate() {
        if Sums::of(&run.state()) != *sums {
            return Some(frame);
        }
        let mut stalled = false;
        while frame + 1 < recording.frames.len() {
            while let Some(change) = changes.next_if(|change| change.frame == frame as u64 && change.stalled <= stalled)
            {
                run.set_settings(change.settings);
                stalled = false;
            }
            match run.advance(Until::Frame, u64::MAX) {
                _ if run.tallies().frames > frame as u64 => break, // also one at whose end it cannot go on
                Progress::Reached => break,
                _ => stalled = true,
            }
            assert!(changes.peek().is_some_and(|change| change.stalled), "it goes on");
        }
    }
    None
}

/// What is done between two presses of the key.
const DONE: [&str; 6] = [
    ":goto 1\n",
    ":goto 0.7\ns:goto 1\nm:goto 1.3\n",
    "mm:goto 1\n:tolerance 1e-7\n....m..T..",
    "ccc,,<CCs:goto 2\n", // back, and on another way
    "..mmmm..SS,,m...",
    ":goto 1\nG",
];

#[test]
fn a_recording_holds_the_run_from_where_it_was_begun_with_all_changes() {
    for name in ["paper-0", "paper-3", "newtons-cradle", "zigzag"] {
        for before in ["", "m", "mm....", "mmm:goto 0.2\n"] {
            for keys in DONE {
                let mut user = User::with(name);
                user.type_in(&format!("{before}E"));
                let begun = user.snapshot().tallies.frames;
                assert!(said(&user).contains("Recording from t = ") && user.row(0).contains("REC"), "{}", user.text());
                user.type_in(keys);
                let frames = user.app.report().kept.newest - begun;
                user.type_in("E");
                assert!(said(&user).contains(&format!("{name}-1.carom, {frames} frames.")), "{keys}: {}", user.text());
                assert!(!user.row(0).contains("REC"), "{}", user.row(0));
                let recording = recording(&user, &format!("{name}-1.carom"));
                assert_eq!(recording.frames.len() as u64, frames + 1, "{name} {before} {keys}");
                assert_eq!(differs(&recording), None, "{name} {before} {keys}");
            }
        }
    }
}

#[test]
fn a_change_where_the_run_could_not_go_on_is_recorded_as_such() {
    let mut user = User::with("paper-2");
    user.type_in(":goto 10\nE:goto 20\ntm:goto 11\nE"); // resting in a wedge stalls the printed method near 10.3 s
    let recording = recording(&user, "paper-2-1.carom");
    assert_eq!(
        recording.changes.iter().map(|change| change.stalled).collect::<Vec<_>>(),
        [true, false],
        "the second without another try"
    );
    assert_eq!(differs(&recording), None);
    let mut user = User::replays(recording);
    user.type_in(":goto 30\n");
    assert!(said(&user).contains("all of it as recorded."), "{}", user.text());
}

#[test]
fn what_ends_a_run_writes_its_recording_and_what_loses_it_says_so() {
    for keys in ["E..r", "E..]", "E..q"] {
        let mut user = User::with("paper-0");
        user.type_in(keys);
        assert_eq!(recording(&user, "paper-0-1.carom").frames.len(), 3, "{keys}");
    }
    let mut user = User::with("paper-0");
    user.type_in("...E..<s");
    assert!(said(&user).contains("The recording is given up"), "{}", user.text());
    user.type_in("E");
    assert!(said(&user).contains("Recording from"), "another one can be begun: {}", user.text());
    user.type_in("E..,E");
    assert!(said(&user).contains("A recording begins at the newest frame"), "{}", user.text());
    let mut user = User::with("paper-0");
    user.type_in("m..tE");
    assert!(said(&user).contains("No recording begins here: the tolerance of swept was changed"), "{}", user.text());
}

#[test]
fn a_recording_stops_at_its_end_however_far_one_wants_to_go_and_says_when_it_is_left() {
    for method in ["", "m", "mm", "mmm"] {
        let mut user = User::with("paper-0");
        user.type_in(&format!("{method}E:goto 1\nE"));
        let recording = recording(&user, "paper-0-1.carom");
        let end = recording.frames.len() as u64 - 1;
        let mut user = User::replays(recording);
        user.type_in(":goto 1e9\n");
        let text = format!("The recording ends here, with frame {end}: all of it as recorded.");
        assert!(said(&user).contains(&text), "{}", user.text());
        assert_eq!(user.snapshot().tallies.frames, end);
        user.type_in(".");
        let text = format!("The recording has ended with frame {end}: what comes now is no part of it.");
        assert!(said(&user).contains(&text), "{}", user.text());
        assert_eq!(user.snapshot().tallies.frames, end + 1);
        user.type_in(".");
        assert!(!said(&user).contains("no part of it"), "once is enough: {}", user.text());
        user.type_in("gr:goto 1e9\n");
        assert_eq!(user.snapshot().tallies.frames, end, "it is followed again from the start");
    }
}

#[test]
fn a_recording_is_gone_through_like_a_run_and_its_frames_are_compared() {
    let mut user = User::with("paper-3");
    user.type_in("E:goto 1\nmm:goto 1.5\ns:goto 2\n");
    let end = (user.snapshot().tallies.frames, user.snapshot().hash());
    user.type_in(":goto 1.2\n");
    let middle = user.snapshot().hash();
    user.type_in("GE");
    let recording = recording(&user, "paper-3-1.carom");

    let mut replayed = User::replays(recording.clone());
    replayed.type_in(":goto 99\n");
    let text = format!("The recording ends here, with frame {}: all of it as recorded.", end.0);
    assert!(said(&replayed).contains(&text), "{}", replayed.text());
    assert_eq!((replayed.snapshot().tallies.frames, replayed.snapshot().hash()), end);
    assert_eq!((replayed.snapshot().method, replayed.snapshot().dt), ("exact", user.snapshot().dt));
    replayed.type_in(":goto 1.2\n");
    assert_eq!(replayed.snapshot().hash(), middle);
    assert!(replayed.row(0).contains("BACK"), "{}", replayed.row(0));
    replayed.type_in("r");
    assert_eq!((replayed.snapshot().method, replayed.snapshot().t), ("paper", 0.0), "again with its own settings");
    replayed.type_in("R");
    assert!(said(&replayed).contains("This is a recording"), "{}", replayed.text());

    for frame in [0, 1, 57, recording.frames.len() - 1] {
        let mut flipped = recording.clone();
        let mut bytes = flipped.frames[frame].to_bytes();
        bytes[3] ^= 4;
        flipped.frames[frame] = Sums::from_bytes(bytes);
        let mut user = User::replays(flipped);
        if frame > 0 {
            user.type_in(":goto 99\n");
        }
        assert!(said(&user).contains(&format!("Frame {frame} differs, at t = ")), "{frame}: {}", user.text());
        assert_eq!(user.snapshot().tallies.frames, frame as u64, "it stops there");
        user.type_in(":goto 99\n");
        if frame + 1 < recording.frames.len() {
            assert!(said(&user).contains("not all of it as recorded"), "{}", user.text());
        }
    }
}

#[test]
fn a_recording_whose_settings_are_changed_is_followed_no_more() {
    let mut user = User::with("paper-3");
    user.type_in("E:goto 1\nm:goto 2\nE");
    let mut user = User::replays(recording(&user, "paper-3-1.carom"));
    user.type_in("..s:goto 5\n");
    assert!(!said(&user).contains("recorded"), "{}", user.text());
    assert_eq!(user.snapshot().method, "paper", "the change at 1 s is not made");
    assert!(user.snapshot().t >= 5.0);
}
