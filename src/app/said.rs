//! What a worker has to say, in words.

use crate::{
    format::{number, rounded, significant, thousands},
    recording::Suspect,
    snapshot::{Class, Contact, Kind, Logged},
    worker::{Bodies, Met, Said, Stop},
};

/// A sentence for the line under the picture; `duration` is the scene's, s.
pub(super) fn sentence(said: &Said, duration: f64) -> String {
    match said {
        Said::Met { stop, met, t } => format!("Stopped at t = {} s: {}.", significant(*t, 5), came(stop, met)),
        Said::Nothing { stop, from, within } => {
            let another = if *from >= duration { "another " } else { "" };
            let over = if *from >= duration { ", past the scene's duration" } else { "" };
            format!(
                "No {} within {another}{} s: the run stays at t = {} s{over}.",
                noun(stop),
                number(*within),
                significant(*from, 5)
            )
        }
        Said::Past { t } => format!("t = {} s is past; :goto {} goes back.", number(*t), number(*t)),
        Said::Dropped { frames, t } => {
            let are = if *frames == 1 { "frame is" } else { "frames are" };
            format!("The run goes on from t = {} s; {} later {are} dropped.", significant(*t, 5), thousands(*frames))
        }
        Said::Start => "This is the start of the run.".into(),
        Said::Oldest { t } => format!("Nothing before t = {} s is kept; r starts again.", significant(*t, 5)),
        Said::Newest => "This is the newest frame.".into(),
        Said::NoEarlierImpact => "There is no collision before this one.".into(),
        Said::Recording { .. } | Said::NotRecordable | Said::RecordingInThePast => begun(said),
        Said::RecordingLost => "The recording is given up: the run has gone back to before its beginning.".into(),
        Said::RecordingFull { frames } => format!("The recording is full: it has {} frames.", thousands(*frames)),
        Said::Differs { frame, t, suspect } => {
            let what = match suspect {
                Suspect::Sphere(index) => format!("sphere {index} is not as recorded"),
                Suspect::Time => "its time is not as recorded".into(),
                Suspect::Several => "more than one sphere is not as recorded, or the file is damaged there".into(),
            };
            format!("Frame {} differs, at t = {} s: {what}.", thousands(*frame), significant(*t, 5))
        }
        Said::RecordingEnds { frame, same } => {
            let all = if *same { "all of it as recorded" } else { "not all of it as recorded" };
            format!("The recording ends here, with frame {}: {all}.", thousands(*frame))
        }
        Said::BeyondRecording { frame } => {
            format!("The recording has ended with frame {}: what comes now is no part of it.", thousands(*frame))
        }
        Said::Anew { t } => {
            format!("Frames on the way were too many to be kept: the past begins at t = {} s.", significant(*t, 5))
        }
    }
}

/// A sentence on whether a recording has begun.
fn begun(said: &Said) -> String {
    match said {
        Said::Recording { t } => format!("Recording from t = {} s on.", significant(*t, 5)),
        Said::RecordingInThePast => {
            "A recording begins at the newest frame, or where the run goes on from here.".into()
        }
        _ => "No recording begins here: the tolerance of swept was changed, so that it would not go on bit for bit."
            .into(),
    }
}

/// What came, as the text after a colon.
fn came(stop: &Stop, met: &Met) -> String {
    match met {
        Met::Event(contact) => event(contact.kind, contact.class, contact.a, contact.b),
        Met::Exit(i) => format!("sphere {i} leaves the box around the walls"),
        Met::Time => "it is time".into(),
        Met::Speed(i, speed) => format!("sphere {i} has {} m/s, a {}", rounded(*speed), noun(stop)),
        Met::Degree(contact) => format!("{} overlap by {}", bodies(contact), rounded(contact.degree)),
        Met::Energy(off) => format!("the energy is off by {}", rounded(*off)),
    }
}

/// An event of the list as a sentence.
pub(super) fn of_event(logged: &Logged) -> String {
    let Logged { kind, class, a, b, .. } = *logged;
    format!("t = {} s: {}.", number(logged.time), event(kind, class, a as usize, b as usize))
}

fn event(kind: Kind, class: Class, a: usize, b: usize) -> String {
    match (kind, class) {
        (Kind::Wall, Class::Rest) => format!("sphere {a} comes to rest on wall {b}"),
        (Kind::Wall, Class::Release) => format!("sphere {a} no longer rests on wall {b}"),
        (Kind::Wall, _) => format!("sphere {a} hits wall {b}"),
        (Kind::Pair, Class::Rest) => format!("spheres {a} and {b} come to rest on each other"),
        (Kind::Pair, Class::Release) => format!("spheres {a} and {b} no longer rest on each other"),
        (Kind::Pair, _) => format!("spheres {a} and {b} collide"),
    }
}

fn bodies(contact: &Contact) -> String {
    let Contact { kind, a, b, .. } = contact;
    if *kind == Kind::Wall { format!("sphere {a} and wall {b}") } else { format!("spheres {a} and {b}") }
}

/// What is waited for, as a noun.
fn noun(stop: &Stop) -> String {
    match stop {
        Stop::Event(class, bodies) => {
            let what = match class {
                Class::Rest => "rest",
                Class::Release => "release",
                Class::Collide | Class::Leave => "collision",
            };
            match bodies {
                Bodies::Any => what.into(),
                Bodies::Sphere(i) => format!("{what} of sphere {i}"),
                Bodies::Wall(i, wall) => format!("{what} of sphere {i} with wall {wall}"),
                Bodies::Pair(i, j) => format!("{what} of spheres {i} and {j}"),
            }
        }
        Stop::Exit => "sphere leaves the box around the walls".into(),
        Stop::Time(t) => format!("t = {} s", number(*t)),
        Stop::Speed(least) => format!("speed above {} m/s", number(*least)),
        Stop::Degree(least) => format!("overlap above {}", number(*least)),
        Stop::Energy(least) => format!("energy error above {}", number(*least)),
    }
}
