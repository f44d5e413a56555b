//! What is taken away: the picture as an image, and the state as a scene that goes on from here.

use std::{
    sync::mpsc::{self, TryRecvError},
    time::Duration,
};

use super::{files, state::State};
use crate::{
    format::{counted, significant},
    printable,
    recording::Recording,
    scene::{self, Scene},
    worker::{Command, TakenAway, Taped},
};

/// Longest text of a scene, bytes: what a file may have to be opened.
const LONGEST: usize = 16 << 20;

impl State {
    /// Asks the worker for the run as it stands, to be written.
    pub(super) fn take_away(&mut self) {
        let (sender, receiver) = mpsc::channel();
        self.worker.send(Command::TakeAway(sender));
        self.taken = Some(receiver);
    }

    /// The run to be written, once it has been handed over.
    pub(super) fn taken_away(&mut self) -> Option<TakenAway> {
        let found = self.taken.as_ref()?.try_recv();
        if !matches!(found, Err(TryRecvError::Empty)) {
            self.taken = None;
        }
        found.ok()
    }

    /// Writes picture and state, and says where they are.
    pub(super) fn write_away(&mut self, taken: &TakenAway, picture: &str) {
        let scene = taken.scene.as_ref().ok_or_else(|| "a number of it is not finite".to_owned()).and_then(readable);
        let mut all = vec![("svg", picture.as_bytes())];
        if let Ok(text) = &scene {
            all.push(("ron", text.as_bytes()));
        }
        let stem = files::stem(&taken.snapshot.stage.key);
        let names = match files::write(&self.folder, &stem, &all) {
            Ok(names) => names,
            Err(error) => return self.say(format!("Nothing is written: {}.", printable::cause(&error))),
        };
        let t = significant(taken.snapshot.t, 5);
        self.say(match (&names[..], scene) {
            ([svg, ron, ..], _) if taken.to_the_bit => {
                format!("Written: {svg}, and {ron}, which goes on from t = {t} s bit for bit.")
            }
            ([svg, ron, ..], _) => {
                format!(
                    "Written: {svg}, and {ron}, which goes on from t = {t} s to rounding: the tolerance was changed."
                )
            }
            ([svg], Err(why)) => format!("Written: {svg}. The state is not: {why}."),
            _ => "Nothing is written.".into(),
        });
    }
}

/// How long a recording is waited for: a slice of work and the writing of its end.
const PATIENCE: Duration = Duration::from_secs(5);

impl State {
    /// Begins a recording, or writes the one under way.
    pub(super) fn toggle_recording(&mut self) {
        match self.report.recorded {
            Some(_) => self.end_recording(),
            None => self.worker.send(Command::Record),
        }
    }

    /// Writes the recording under way, if there is one, and says where it is.
    pub(super) fn end_recording(&mut self) {
        if self.report.recorded.is_some() {
            self.write_tape();
        }
    }

    /// Asks the worker for the recording under way, whether or not its latest report knows of it, and writes it.
    pub(super) fn write_tape(&mut self) {
        let (sender, receiver) = mpsc::channel();
        self.worker.send(Command::EndRecording(sender));
        match receiver.recv_timeout(PATIENCE) {
            Ok(Some(taped)) => self.write_recording(taped),
            Ok(None) => {} // it was given up, which has been said
            Err(_) => self.say_of_recording("The recording is lost: the simulation does not answer.".into()),
        }
    }

    fn write_recording(&mut self, taped: Taped) {
        let Taped { key, scene, settings, changes, frames } = taped;
        let count = frames.len() - 1;
        let scene = match readable(&scene) {
            Ok(scene) => scene,
            Err(why) => return self.say_of_recording(format!("The recording is not written: {why}.")),
        };
        let stem = files::stem(&key);
        let bytes = Recording { key, scene, settings, changes, frames }.to_bytes();
        self.say_of_recording(match files::write(&self.folder, &stem, &[("carom", &bytes)]) {
            Ok(names) => format!("Written: {}, {}.", names.join(", "), counted(count as u64, "frame")),
            Err(error) => format!("The recording is not written: {}.", printable::cause(&error)),
        });
    }

    /// Says what has become of a recording, now and, if this is the end, after it.
    fn say_of_recording(&mut self, said: String) {
        self.farewell = Some(said.clone());
        self.say(said);
    }
}

/// The text of a scene, if it can be opened again.
fn readable(scene: &Scene) -> Result<String, String> {
    let text = scene::written(scene);
    if text.len() > LONGEST {
        return Err(format!("it takes {} MiB, and a scene's file may have 16", text.len() >> 20));
    }
    scene::parse(&text, &scene.name).map(|_| text).map_err(|error| error.to_string())
}
