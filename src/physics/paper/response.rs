//! The response: transient impulses and support forces for the next frame (source: paper 2.4).

use glam::DVec3;

use super::super::log::{Key, Log, key};
use super::super::{Class, Contact, Kind, Model, motion, overlap};
use super::{Overlap, Paper};

/// What acts on one sphere during one frame, beside what always does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Kick {
    /// Which.
    pub(super) sphere: usize,
    /// Transient: acts in full however short the frame is, N s.
    pub(super) impulse: DVec3,
    /// Support: acts for the frame's real length, m/s².
    pub(super) support: DVec3,
}

/// The kicks of a frame, at most one per sphere.
#[derive(Debug, Clone)]
pub(super) struct Kicks {
    list: Vec<Kick>,
    /// Place in the list, by sphere; `NOWHERE` without a kick.
    place: Vec<u32>,
}

const NOWHERE: u32 = u32::MAX;

impl Kicks {
    pub(super) fn none(spheres: usize) -> Kicks {
        Kicks { list: Vec::new(), place: vec![NOWHERE; spheres] }
    }

    pub(super) fn list(&self) -> &[Kick] {
        &self.list
    }

    pub(super) fn clear(&mut self) {
        for kick in self.list.drain(..) {
            self.place[kick.sphere] = NOWHERE;
        }
    }

    fn of(&mut self, sphere: usize) -> &mut Kick {
        if self.place[sphere] == NOWHERE {
            self.place[sphere] = self.list.len() as u32;
            self.list.push(Kick { sphere, impulse: DVec3::ZERO, support: DVec3::ZERO });
        }
        &mut self.list[self.place[sphere] as usize]
    }
}

/// "sphere 0 and wall 6", for sentences.
pub(super) fn names(contact: &Contact) -> String {
    match contact.kind {
        Kind::Wall => format!("sphere {} and wall {}", contact.a, contact.b),
        Kind::Pair => format!("spheres {} and {}", contact.a, contact.b),
    }
}

impl Paper {
    /// All responses to the overlaps found, computed from the same velocities, walls before pairs.
    pub(super) fn respond(&mut self, model: &Model, log: &mut Log) {
        self.next.clear();
        log.contacts.clear();
        for k in 0..self.found.len() {
            let Some(contact) = self.answer(model, self.found[k]) else { continue };
            if contact.class == Class::Collide {
                log.event(contact);
            }
            log.contacts.push(contact);
        }
        self.update_rests(model, log);
    }

    fn touch(&self, model: &Model, (kind, a, b): Key) -> overlap::Touch {
        let x = &self.end.x;
        match kind {
            Kind::Wall => overlap::wall_touch(&model.faces[b], self.start.x[a], x[a], model.radii[a]),
            Kind::Pair => overlap::pair_touch(x[a], x[b], model.radii[b], model.radii[a] + model.radii[b]),
        }
    }

    /// What the printed law makes of one contact: 0 < v_n ≤ rest_speed rests too, if something presses.
    /// A gap of exactly 0 is a contact in flight only as long as it rests (nothing overlaps; at load it is one).
    fn answer(&mut self, model: &Model, Overlap { key: at, degree }: Overlap) -> Option<Contact> {
        let (kind, a, b) = at;
        let touch = self.touch(model, at);
        let n = touch.normal;
        let v_b = if kind == Kind::Pair { self.end.v[b] } else { DVec3::ZERO };
        let v_n = motion::normal_velocity(self.end.v[a], v_b, n);
        let press_a = (-model.acceleration(a).dot(n)).max(0.0);
        let press_b = if kind == Kind::Pair { model.acceleration(b).dot(n).max(0.0) } else { 0.0 };
        let pressed = press_a > 0.0 || press_b > 0.0;
        let mut class = motion::classify(v_n, pressed, &model.law);
        if class == Class::Leave && pressed && v_n <= model.law.rest_speed {
            class = Class::Rest;
        }
        if degree <= 0.0 && self.end.t > 0.0 && class != Class::Rest {
            return None;
        }
        let mut impulse = match kind {
            _ if class == Class::Leave => 0.0,
            Kind::Wall => {
                let j = motion::wall_impulse(model, a, self.end.v[a], n, v_n, class);
                self.next.of(a).impulse += j;
                j.dot(n)
            }
            Kind::Pair => {
                let j = motion::pair_impulse(model, a, b, v_n, class);
                self.next.of(a).impulse += n * j;
                self.next.of(b).impulse -= n * j;
                j
            }
        };
        if class == Class::Rest {
            self.next.of(a).support += n * press_a;
            if kind == Kind::Pair {
                self.next.of(b).support -= n * press_b;
            }
            impulse += press_a * model.masses[a] * self.step;
        }
        Some(Contact {
            time: self.end.t,
            kind,
            a,
            b,
            point: touch.point,
            normal: n,
            approach_speed: -v_n,
            separation_speed: motion::separation_speed(v_n, class, kind, &model.law),
            impulse,
            degree: touch.degree,
            class,
        })
    }

    /// One `rest` row when a contact begins to rest, one `release` row when it ends.
    fn update_rests(&mut self, model: &Model, log: &mut Log) {
        let now: Vec<Key> = log.contacts.iter().filter(|c| c.class == Class::Rest).map(key).collect();
        if now == self.resting {
            return;
        }
        for k in 0..log.contacts.len() {
            let contact = log.contacts[k];
            if contact.class == Class::Rest && self.resting.binary_search(&key(&contact)).is_err() {
                log.event(contact);
            }
        }
        for &gone in self.resting.iter().filter(|k| now.binary_search(k).is_err()) {
            log.event(self.release(model, gone));
        }
        self.resting = now;
    }

    /// The row of a contact whose rest has ended.
    fn release(&self, model: &Model, at: Key) -> Contact {
        let (kind, a, b) = at;
        let touch = self.touch(model, at);
        let v_b = if kind == Kind::Pair { self.end.v[b] } else { DVec3::ZERO };
        let v_n = motion::normal_velocity(self.end.v[a], v_b, touch.normal);
        Contact {
            time: self.end.t,
            kind,
            a,
            b,
            point: touch.point,
            normal: touch.normal,
            approach_speed: -v_n,
            separation_speed: v_n,
            impulse: 0.0,
            degree: touch.degree,
            class: Class::Release,
        }
    }
}
