//! The response: transient impulses and support forces for the next frame (source: paper 2.4).

use std::ops::Range;

use glam::DVec3;

use super::super::contact::Key;
use super::super::log::Log;
use super::super::overlap::{self, Overlap};
use super::super::{Class, Contact, Kind, Model, motion};
use super::Paper;

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
    /// Sorted by sphere once the responses are complete.
    list: Vec<Kick>,
    /// Place in the list by sphere while it is filled; [`NOWHERE`] without a kick.
    place: Vec<u32>,
}

/// More than the million spheres a scene may have.
const NOWHERE: u32 = u32::MAX;

impl Kicks {
    pub(super) fn none(spheres: usize) -> Kicks {
        Kicks { list: Vec::new(), place: vec![NOWHERE; spheres] }
    }

    pub(super) fn list(&self) -> &[Kick] {
        &self.list
    }

    /// Those of a range of spheres.
    pub(super) fn of_spheres(&self, range: &Range<usize>) -> &[Kick] {
        let before = |sphere: usize| self.list.partition_point(|k| k.sphere < sphere);
        &self.list[before(range.start)..before(range.end)]
    }

    pub(super) fn clear(&mut self) {
        self.list.clear();
    }

    /// Takes these impulses, N s by sphere, instead of its own.
    pub(super) fn replace_impulses(&mut self, impulses: &[DVec3]) {
        let support = |kicks: &Kicks, i: usize| kicks.of_spheres(&(i..i + 1)).first().map(|k| k.support);
        let kicks = impulses.iter().enumerate().filter_map(|(sphere, &impulse)| {
            let support = support(self, sphere);
            let needed = support.is_some() || impulse != DVec3::ZERO;
            needed.then(|| Kick { sphere, impulse, support: support.unwrap_or(DVec3::ZERO) })
        });
        self.list = kicks.collect();
    }

    fn of(&mut self, sphere: usize) -> &mut Kick {
        let known = self.place[sphere] as usize;
        if self.list.get(known).is_none_or(|k| k.sphere != sphere) {
            self.place[sphere] = self.list.len() as u32;
            self.list.push(Kick { sphere, impulse: DVec3::ZERO, support: DVec3::ZERO });
        }
        &mut self.list[self.place[sphere] as usize]
    }

    fn sort(&mut self) {
        self.list.sort_unstable_by_key(|k| k.sphere);
    }
}

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
        let v_n = motion::normal_velocity(self.end.v[a], v_b, n);
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
                let impulse = motion::wall_impulse(model, a, self.end.v[a], n, *v_n, class);
                self.next.of(a).impulse += impulse;
                impulse.dot(n)
            }
            Kind::Pair => {
                let impulse = motion::pair_impulse(model, a, b, *v_n, class);
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
            separation_speed: motion::separation_speed(v_n, class, kind, &model.law),
            impulse,
            degree: touch.degree,
            class,
        }
    }
}

/// What the printed law makes of a contact: 0 < v_n ≤ rest_speed rests too, if something presses.
fn class(model: &Model, meeting: &Meeting) -> Class {
    let pressed = meeting.press != [0.0; 2];
    match motion::classify(meeting.v_n, pressed, &model.law) {
        Class::Leave if pressed && meeting.v_n <= model.law.rest_speed => Class::Rest,
        class => class,
    }
}
