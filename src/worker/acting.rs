//! What acts over a frame of `paper` from the one before: its responses are forces of the next frame.

use crate::{
    physics::{Class, Contact, Simulation},
    scene::Method,
};

/// The impacts of a frame whose impulses act over the next one.
#[derive(Debug, Clone, Default)]
pub(super) struct Acting {
    /// The frame at whose end the impacts were.
    frame: u64,
    impacts: Vec<Contact>,
}

impl Acting {
    /// Takes note of a run between two frames, before it goes on.
    pub(super) fn note(&mut self, run: &Simulation) {
        self.frame = run.tallies().frames;
        self.impacts.clear();
        if run.settings().method == Method::Paper {
            let impacts = run.contacts().iter().filter(|contact| contact.class == Class::Collide);
            self.impacts.extend(impacts.copied());
        }
    }

    /// Memory that it takes beside its own size, bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.impacts)
    }

    /// The impacts whose impulses have acted over the frame at whose end the run is.
    pub(super) fn over(&self, run: &Simulation) -> &[Contact] {
        if self.frame + 1 == run.tallies().frames { &self.impacts } else { &[] }
    }
}
