//! What is taken away: the picture as an image, and the state as a scene that goes on from here.

use std::sync::mpsc::{self, TryRecvError};

use super::{files, state::State};
use crate::{
    format::significant,
    printable,
    scene::{self, Scene},
    worker::{Command, TakenAway},
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

    /// What was asked for, once it has been handed over.
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

/// The text of a scene, if it can be opened again.
fn readable(scene: &Scene) -> Result<String, String> {
    let text = scene::written(scene);
    if text.len() > LONGEST {
        return Err(format!("it takes {} MiB, and a scene's file may have 16", text.len() >> 20));
    }
    scene::parse(&text, &scene.name).map(|_| text).map_err(|error| error.to_string())
}
