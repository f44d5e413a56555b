//! The response: transient impulses and support forces for the next frame (source: paper 2.4).

use glam::DVec3;

use super::run::Paper;
use crate::physics::contact::{Class, Contact, Key, Kind};
use crate::physics::impact_law;
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::overlap::{self, Overlap};

/// A contact as the law sees it.
struct Meeting {
    at: Key,
    touch: overlap::Touch,
    v_n: f64,
    /// What presses the first and the second sphere against the contact, m/s².
    press: [f64; 2],
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
                let contact = self.row(model, &meeting, class, impulse);
                if class == Class::Collide {
                    log.event(contact);
                }
                log.contacts.push(contact);
            }
        }
        self.next.sort();
        log.follow_rests(|key| self.row(model, &self.meeting(model, key), Class::Release, 0.0));
    }

    fn meeting(&self, model: &Model, at: Key) -> Meeting {
        let (kind, a, b) = at;
        let touch = overlap::touch(model, &self.start.x, &self.end.x, at);
        let n = touch.normal;
        let (v_b, press_b) = match kind {
            Kind::Wall => (DVec3::ZERO, 0.0),
            Kind::Pair => (self.end.v[b], model.acceleration(b).dot(n).max(0.0)),
        };
        let v_n = impact_law::normal_velocity(self.end.v[a], v_b, n);
        Meeting { at, touch, v_n, press: [(-model.acceleration(a).dot(n)).max(0.0), press_b] }
    }

    /// Adds the response to what acts in the next frame; the impulse along the normal, N s: at rest what stops the
    /// approach and what the support force would give over the frame that ended here.
    fn answer(&mut self, model: &Model, meeting: &Meeting, class: Class) -> f64 {
        let Meeting { at: (kind, a, b), touch, v_n, press } = meeting;
        let (a, b, n) = (*a, *b, touch.normal);
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
                let impulse = impact_law::pair_impulse(model, a, b, *v_n, class);
                self.next.of(a).impulse += n * impulse;
                self.next.of(b).impulse -= n * impulse;
                impulse
            }
        };
        if class == Class::Collide {
            return along;
        }
        self.next.of(a).support += n * press[0];
        if *kind == Kind::Pair {
            self.next.of(b).support -= n * press[1];
        }
        along + press[0] * model.masses[a] * self.step
    }

    fn row(&self, model: &Model, meeting: &Meeting, class: Class, impulse: f64) -> Contact {
        let Meeting { at: (kind, a, b), touch, v_n, .. } = *meeting;
        Contact {
            time: self.end.t,
            kind,
            a,
            b,
            point: touch.point,
            normal: touch.normal,
            approach_speed: -v_n,
            separation_speed: impact_law::separation_speed(v_n, class, kind, &model.law),
            impulse,
            degree: touch.degree,
            class,
        }
    }
}

/// What the printed law makes of a contact: 0 < v_n ≤ rest_speed rests too, if something presses.
fn class(model: &Model, meeting: &Meeting) -> Class {
    let pressed = meeting.press != [0.0; 2];
    match impact_law::classify(meeting.v_n, pressed, &model.law) {
        Class::Leave if pressed && meeting.v_n <= model.law.rest_speed => Class::Rest,
        class => class,
    }
}
