//! Opening another scene beside the one on the screen: a scene of a million spheres takes seconds, and keys go on
//! working meanwhile.

use std::{
    ffi::OsString,
    sync::mpsc::{RecvTimeoutError, TryRecvError},
    time::Duration,
};

use super::{
    input::Effect,
    loading::{Before, Loaded, Loading, load},
    state::State,
};
use crate::{printable, worker::Errands};

/// A scene that opens within this time is there before the next key, as if nothing had to be waited for; still well
/// below what a key may take to be answered.
const AT_ONCE: Duration = Duration::from_millis(30);

impl State {
    /// Reads the scene's file again; if it no longer loads, the old run goes on.
    pub(super) fn reload(&mut self) {
        if self.current.recording.is_some() {
            return self.say("This is a recording: there is no scene's file to reload.");
        }
        if self.current.path.is_none() {
            return self.say(format!("{} is built in: there is no file to reload.", self.current.name));
        }
        let source = self.current.source().to_owned();
        self.fetch(self.current.name.clone(), source, Some((self.settings, self.current.scene.solver)));
    }

    /// Opens another scene; if it does not load, the old run goes on.
    pub(super) fn open_scene(&mut self, name: &str) {
        // The file that the program was started with may have a name that can't be shown as it is.
        let given = self.given.as_ref().filter(|(entry, _)| entry.name == name);
        let source = given.map_or_else(|| name.into(), |(_, path)| path.as_os_str().to_owned());
        self.fetch(name.to_owned(), source, None);
    }

    /// The name of the scene that is shown, or that will be.
    pub(super) fn wanted_name(&self) -> &str {
        self.loading.as_ref().map_or(&self.current.name, |loading| &loading.name)
    }

    /// Gives up a scene on its way; whether there was one.
    pub(super) fn stop_loading(&mut self) -> bool {
        let loading = self.loading.take();
        if let Some(loading) = &loading {
            self.say(format!("{} is not opened.", loading.name));
        }
        loading.is_some()
    }

    fn fetch(&mut self, name: String, source: OsString, before: Before) {
        let errands = match self.errands.take().map_or_else(|| Errands::start(self.notify.clone()), Ok) {
            Ok(errands) => self.errands.insert(errands),
            Err(error) => return self.say(format!("{name} cannot be opened: {}.", printable::cause(&error))),
        };
        let result = errands.ask(move || load(&source, before));
        let at_once = result.recv_timeout(AT_ONCE);
        let loading = Loading { name, again: before.is_some(), result };
        match at_once {
            Ok(loaded) => self.arrived(&loading, loaded),
            Err(RecvTimeoutError::Timeout) => {
                self.say(format!("Opening {}; Esc gives it up.", loading.name));
                self.loading = Some(loading);
            }
            Err(RecvTimeoutError::Disconnected) => self.say(failed(&loading.name)),
        }
    }

    /// Takes the scene on its way if it has arrived.
    pub(super) fn look_for_scene(&mut self) -> Option<Effect> {
        let loading = self.loading.take()?;
        match loading.result.try_recv() {
            Ok(loaded) => self.arrived(&loading, loaded),
            Err(TryRecvError::Disconnected) => self.say(failed(&loading.name)),
            Err(TryRecvError::Empty) => {
                self.loading = Some(loading);
                return None;
            }
        }
        Some(Effect::DrawNow)
    }

    fn arrived(&mut self, loading: &Loading, loaded: Result<Loaded, String>) {
        match loaded {
            Ok(Loaded { current, settings, message }) => {
                self.show(current, settings);
                message.into_iter().for_each(|message| self.say(message));
                if loading.again {
                    self.say(format!("Reloaded {}.", loading.name));
                }
            }
            Err(said) => self.say(said),
        }
    }
}

/// What is said of a scene that made us panic.
fn failed(name: &str) -> String {
    format!("{name} cannot be opened: carom has made a mistake.")
}
