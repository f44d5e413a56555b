//! The response: transient impulses and support forces for the next frame (source: paper 2.4).

use super::run::Paper;
use crate::physics::contact::{Class, Contact, Key, Kind};
use crate::physics::frame_contact::FrameContact;
use crate::physics::impact_law;
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::overlap::Overlap;

/// A contact at the end of a frame, as the impact law sees it.
struct Meeting {
    contact: Contact,
    /// Normal velocity, m/s; negative: approaching.
    v_n: f64,
    /// What presses the first and the second sphere against the contact, m/s².
    press: [f64; 2],
}

impl Meeting {
    /// Whether anything presses the bodies together.
    fn is_pressed(&self) -> bool {
        self.press != [0.0; 2]
    }

    /// The contact with its class and the impulse along its normal (N s).
    fn answered(&self, model: &Model, class: Class, impulse: f64) -> Contact {
        let separation_speed = impact_law::separation_speed(self.v_n, class, self.contact.kind, &model.law);
        Contact { class, impulse, separation_speed, ..self.contact }
    }
}

impl Paper {
    /// All responses to the overlaps found, computed from the same velocities, walls before pairs.
    pub(super) fn respond(&mut self, model: &Model, log: &mut Log) {
        self.next.clear();
        log.contacts.clear();
        for k in 0..self.finder.found.len() {
            let Overlap { key, degree } = self.finder.found[k];
            let meeting = self.meeting(model, key);
            let class = class(model, &meeting);
            // A gap of exactly 0 is a contact in flight only as long as it rests; at load it is one.
            if degree > 0.0 || self.end.t == 0.0 || class == Class::Rest {
                let impulse = self.answer(model, &meeting, class);
                let contact = meeting.answered(model, class, impulse);
                if class == Class::Collide {
                    log.event(contact);
                }
                log.contacts.push(contact);
            }
        }
        self.next.sort();
        log.follow_rests(|key| self.meeting(model, key).answered(model, Class::Release, 0.0));
    }

    fn meeting(&self, model: &Model, key: Key) -> Meeting {
        let at_end = FrameContact::new(model, &self.start.x, &self.end, key);
        let FrameContact { contact, v_n, accelerations: [a, b] } = at_end;
        let n = contact.normal;
        Meeting { contact, v_n, press: [(-a.dot(n)).max(0.0), b.dot(n).max(0.0)] }
    }

    /// Adds the response to what acts in the next frame; the impulse along the normal, N s: at rest what stops the
    /// approach and what the support force would give over the frame that ended here.
    fn answer(&mut self, model: &Model, meeting: &Meeting, class: Class) -> f64 {
        let Meeting { contact: Contact { kind, a, b, normal: n, .. }, v_n, press } = *meeting;
        if class == Class::Leave {
            return 0.0;
        }
        let along = match kind {
            Kind::Wall => {
                let impulse = impact_law::wall_impulse(model, a, self.end.v[a], n, class);
                self.next.of(a).impulse += impulse;
                impulse.dot(n)
            }
            Kind::Pair => {
                let impulse = impact_law::pair_impulse(model, a, b, v_n, class);
                self.next.of(a).impulse += n * impulse;
                self.next.of(b).impulse -= n * impulse;
                impulse
            }
        };
        if class == Class::Collide {
            return along;
        }
        self.next.of(a).support += n * press[0];
        if kind == Kind::Pair {
            self.next.of(b).support -= n * press[1];
        }
        along + press[0] * model.masses[a] * self.step
    }
}

/// What the printed law makes of a contact: 0 < v_n ≤ rest_speed rests too, if something presses.
fn class(model: &Model, meeting: &Meeting) -> Class {
    match impact_law::classify(meeting.v_n, meeting.is_pressed(), &model.law) {
        Class::Leave if meeting.is_pressed() && meeting.v_n <= model.law.rest_speed => Class::Rest,
        class => class,
    }
}
