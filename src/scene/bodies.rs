//! Bodies on their way from a file into a scene, and what a refusal calls them.

use super::error::quote;
use super::generate::SIDES;
use super::validated::{Sphere, Wall};

/// Bodies and, for each, the entry of the file that it came from.
pub(super) struct Bodies<T> {
    pub(super) list: Vec<T>,
    entries: Vec<u32>,
}

impl<T> Bodies<T> {
    pub(super) fn new() -> Bodies<T> {
        Bodies { list: Vec::new(), entries: Vec::new() }
    }

    /// Bodies of which each is an entry of its own.
    pub(super) fn one_by_one(list: Vec<T>) -> Bodies<T> {
        let entries = (0..list.len() as u32).collect();
        Bodies { list, entries }
    }

    pub(super) fn extend(&mut self, entry: usize, bodies: impl IntoIterator<Item = T>) {
        self.list.extend(bodies);
        self.entries.resize(self.list.len(), entry as u32);
    }

    pub(super) fn entry(&self, body: usize) -> usize {
        self.entries[body] as usize
    }

    /// Place of a body among those of its entry, if the entry made several.
    fn place_in_entry(&self, body: usize) -> Option<usize> {
        let first = self.entries.partition_point(|&entry| entry < self.entries[body]);
        let next = self.entries.partition_point(|&entry| entry <= self.entries[body]);
        (next - first > 1).then_some(body - first)
    }
}

impl Bodies<Wall> {
    pub(super) fn describe(&self, wall: usize) -> String {
        let entry = self.entry(wall);
        match self.place_in_entry(wall) {
            Some(side) => format!("wall {wall} (the {} of walls[{entry}])", SIDES[side]),
            None => format!("wall {wall} (walls[{entry}])"),
        }
    }
}

impl Bodies<Sphere> {
    pub(super) fn describe(&self, sphere: usize) -> String {
        let entry = self.entry(sphere);
        let place = self.place_in_entry(sphere).map_or(String::new(), |place| format!(", its number {place}"));
        let name = self.list[sphere].name.as_deref().map_or(String::new(), |name| format!(", {}", quote(name)));
        format!("sphere {sphere} (spheres[{entry}]{place}{name})")
    }
}
