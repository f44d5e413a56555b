//! What acts on single spheres during one frame, beside what always does.

use std::ops::Range;

use glam::DVec3;

/// What acts on one sphere during one frame, beside what always does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Kick {
    /// Index of the sphere.
    pub(super) sphere: usize,
    /// Transient impulse, N s: it acts in full however short the frame is.
    pub(super) impulse: DVec3,
    /// Acceleration by support, m/s²: it acts for the frame's real length.
    pub(super) support: DVec3,
}

/// The kicks of a frame, at most one per sphere.
#[derive(Debug, Clone)]
pub(super) struct Kicks {
    /// The kicks, sorted by sphere once the responses are complete.
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

    /// A copy of the list alone.
    pub(super) fn kept(&self) -> Kicks {
        Kicks { list: self.list.clone(), place: Vec::new() }
    }

    /// Makes a kept list ready for the kicks of so many spheres.
    pub(super) fn wake(&mut self, spheres: usize) {
        self.place = vec![NOWHERE; spheres];
    }

    pub(super) fn list(&self) -> &[Kick] {
        &self.list
    }

    /// The kicks of a range of spheres.
    pub(super) fn of_spheres(&self, range: &Range<usize>) -> &[Kick] {
        let before = |sphere: usize| self.list.partition_point(|k| k.sphere < sphere);
        &self.list[before(range.start)..before(range.end)]
    }

    pub(super) fn clear(&mut self) {
        self.list.clear();
    }

    /// Replaces the impulses by these, N s by sphere.
    pub(super) fn replace_impulses(&mut self, impulses: &[DVec3]) {
        let support = |kicks: &Kicks, i: usize| kicks.of_spheres(&(i..i + 1)).first().map(|k| k.support);
        let kicks = impulses.iter().enumerate().filter_map(|(sphere, &impulse)| {
            let support = support(self, sphere);
            let needed = support.is_some() || impulse != DVec3::ZERO;
            needed.then(|| Kick { sphere, impulse, support: support.unwrap_or(DVec3::ZERO) })
        });
        self.list = kicks.collect();
    }

    pub(super) fn of(&mut self, sphere: usize) -> &mut Kick {
        let known = self.place[sphere] as usize;
        if self.list.get(known).is_none_or(|k| k.sphere != sphere) {
            self.place[sphere] = self.list.len() as u32;
            self.list.push(Kick { sphere, impulse: DVec3::ZERO, support: DVec3::ZERO });
        }
        &mut self.list[self.place[sphere] as usize]
    }

    pub(super) fn sort(&mut self) {
        self.list.sort_unstable_by_key(|k| k.sphere);
    }
}
