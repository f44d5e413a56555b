//! What is done once a run is where it was sent: what has happened there is selected, and its card opened.

use super::{
    event_list::EventList,
    said,
    state::{Open, Sought, State},
};
use crate::{
    format::{number, significant},
    snapshot::{Class, Contact, Kind, Logged},
    view::{self, CardView},
    worker::Command,
};

impl State {
    /// Opens the list of all that has happened, or closes it.
    pub(super) fn toggle_events(&mut self) {
        self.open = match self.open {
            Open::Events(_) => Open::Nothing,
            _ => Open::Events(EventList::at(&self.report.log, self.report.snapshot.t)),
        };
    }

    /// Goes to an event of the list, its first sphere selected, its card open once the run is there.
    pub(super) fn go_to_event(&mut self, number: u64) {
        self.open = Open::Nothing;
        let Some(event) = self.report.log.get(number).copied() else { return };
        self.head_for(Command::GotoEvent { number, time: event.time }, true);
        self.sought = Some(Sought::Event(event));
        self.view_settings.selected = Some(event.a as usize);
        self.say(said::of_event(&event));
    }

    /// Looks at what was sought, once the run has stopped.
    pub(super) fn look_at_sought(&mut self) {
        match self.sought.take_if(|_| !self.running) {
            Some(Sought::Event(event)) => self.take_apart(&event),
            Some(Sought::Impact | Sought::FirstLook) => self.select_what_collides(),
            Some(Sought::Time) => self.answer = self.past_the_duration(self.report.snapshot.t),
            None => {}
        }
    }

    /// Goes to the time `t`, s.
    pub(super) fn goto(&mut self, t: f64) {
        self.head_for(Command::Goto(t), true);
        self.sought = Some(Sought::Time);
        self.say("On the way to the first frame that ends then or later; Esc stops.");
    }

    /// What there is to say of a time `t`, s, beyond what the scene is meant for.
    fn past_the_duration(&self, t: f64) -> Option<String> {
        let duration = self.current.scene.duration;
        let said = || format!("t = {} s is past the scene's duration, {} s.", significant(t, 5), number(duration));
        (t > duration).then(said)
    }

    /// Opens the card of an event.
    fn take_apart(&mut self, event: &Logged) {
        let contacts = &self.report.snapshot.contacts;
        let index = contacts.iter().position(|contact| event.is(contact));
        self.view_settings.card = index.map(|index| self.card_of(index));
    }

    /// Selects what collides in the frame, and turns an open card to it: the selected sphere, if it does; else, but while
    /// the view follows that, the first sphere of the first impact.
    fn select_what_collides(&mut self) {
        let selected = self.view_settings.selected;
        let contacts = &self.report.snapshot.contacts;
        let impacts = || contacts.iter().enumerate().filter(|(_, contact)| contact.class == Class::Collide);
        let own = impacts().find(|(_, contact)| selected.is_some_and(|sphere| takes_part(contact, sphere)));
        let Some((index, contact)) = own.or_else(|| impacts().next()) else { return };
        if own.is_none() && !self.view_settings.follow {
            self.view_settings.selected = Some(contact.a);
        }
        if self.view_settings.card.is_some() {
            self.view_settings.card = Some(self.card_of(index));
        }
    }

    /// The card of the contact of index `index`, scrolled to its top.
    pub(super) fn card_of(&self, index: usize) -> CardView {
        let order = view::order(&self.report.snapshot, self.view_settings.selected);
        let cursor = order.iter().position(|&other| other == index).unwrap_or(0);
        CardView { cursor, ..CardView::default() }
    }
}

fn takes_part(contact: &Contact, sphere: usize) -> bool {
    contact.a == sphere || contact.kind == Kind::Pair && contact.b == sphere
}
