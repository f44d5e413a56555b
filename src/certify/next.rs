//! What comes next by itself of spheres that rest: another part of a wall takes over, a contact lets go, or a curved motion needs another piece
//! of its series.

use super::bend;
use super::body::{Change, Due, Held};
use super::ending::{Cause, Ending};
use super::island::{Island, Motion};
use super::polynomial::{Fall, fall};
use super::shadow::Shadow;
use super::support::ROUNDING;
use super::vector::Vector;
use crate::double::Double;
use crate::physics::Kind;

/// Changes at one time, at most: a sphere goes over an edge once.
const MOST_AT_ONCE: u32 = 100;

/// The earliest of what comes next.
struct Earliest {
    t: Double,
    longest: f64,
    found: Option<(usize, Due)>,
}

impl Earliest {
    /// Of sphere `i`, when a polynomial of the time since `t` falls below 0.
    fn of(&mut self, i: usize, polynomial: &[Double], change: Change, unclear: Change) {
        match fall(polynomial, self.longest) {
            Fall::Never => {}
            Fall::At(after) => self.at(i, self.t + after, change),
            Fall::Unclear(after) => self.at(i, self.t + Double::from(after), unclear),
        }
    }

    fn at(&mut self, i: usize, t: Double, change: Change) {
        if self.found.is_none_or(|(_, due)| t < due.t) {
            self.found = Some((i, Due { t, change }));
        }
    }
}

impl Shadow {
    /// When what comes next of an island does, as it moves on from now.
    pub(super) fn plan(&mut self, island: &Island, motion: &Motion) -> Result<(), Ending> {
        let bodies: Vec<usize> = island.bodies.iter().copied().filter(|&j| self.bodies[j].now.t == island.t).collect();
        let longest = motion.length.min((Double::from(self.until) - island.t).value());
        if bodies.is_empty() || longest.is_nan() || longest <= 0.0 {
            return Ok(());
        }
        bodies.iter().for_each(|j| {
            self.dues.remove(j);
        });
        let mut next = Earliest { t: island.t, longest, found: None };
        for &j in &bodies {
            let terms = self.bodies[j].now.terms();
            for held in &self.bodies[j].held {
                self.plan_borders(&mut next, j, held, &terms);
            }
        }
        if let Some(series) = &motion.series {
            self.curved = true;
            for (tie, force) in island.pushing().zip(&series.forces) {
                let (kind, a, b) = island.contacts[tie];
                let unclear = Change::Unclear(Cause::CurvedRest, (kind, a, b));
                next.of(a, force, Change::Release((kind, b)), unclear);
            }
            for idle in (0..island.contacts.len()).filter(|&k| !island.pushes[k]) {
                let gap = island.ties[idle].gap(&series.places);
                let (_, a, _) = island.contacts[idle];
                let radius = self.bodies[a].radius.value();
                if !bend::is_nothing(&gap, radius.min(radius * radius), longest) {
                    let time = island.t.value();
                    return Err(Ending { time, bodies: Some(island.contacts[idle]), cause: Cause::CurvedRest });
                }
            }
            next.at(bodies[0], island.t + Double::from(longest), Change::Piece);
        }
        if let Some((i, due)) = next.found {
            self.dues.insert(i, due);
        }
        Ok(())
    }

    /// When sphere `i`, whose centre has these coefficients, comes to where another part of a wall takes over.
    fn plan_borders(&self, next: &mut Earliest, i: usize, held: &Held, terms: &[Vector]) {
        let plate = &self.plates[held.wall];
        for border in plate.borders(held.region) {
            let mut room: Vec<Double> = terms.iter().map(|&term| border.normal.dot(term)).collect();
            room[0] = border.normal.dot(terms[0] - plate.center) + border.offset;
            let unclear = Change::Unclear(Cause::RollsOver, (Kind::Wall, i, held.wall));
            next.of(i, &room, Change::Border(held.wall, border.beyond), unclear);
        }
    }

    /// What comes by itself up to `t`, s.
    pub(super) fn pass(&mut self, t: Double) -> Result<(), Ending> {
        let mut last = (Double::ZERO, 0);
        loop {
            let earliest = self.dues.iter().reduce(|one, two| if two.1.t < one.1.t { two } else { one });
            let Some((&i, &due)) = earliest else { return Ok(()) };
            if due.t > t {
                return Ok(());
            }
            last = (due.t, if due.t == last.0 { last.1 + 1 } else { 0 });
            if last.1 > MOST_AT_ONCE {
                return Err(Ending { time: due.t.value(), bodies: None, cause: Cause::CurvedRest });
            }
            self.change_by_itself(i, due)?;
            self.settle()?;
        }
    }

    /// A change of sphere `i` that is due.
    fn change_by_itself(&mut self, i: usize, due: Due) -> Result<(), Ending> {
        let t = due.t;
        let with = match due.change {
            Change::Border(wall, _) => (Kind::Wall, wall),
            Change::Release(with) => with,
            Change::Piece => self.holder(i),
            Change::Unclear(cause, contact) => {
                return Err(Ending { time: t.value(), bodies: Some(contact), cause });
            }
        };
        if self.bodies[i].now.bend.is_some() {
            self.checks.push((t.value(), i, self.bodies[i].now.at(t)));
        }
        let also = self.clear_until(i, t, None)?;
        self.change(i, t, t.value(), with);
        self.bodies[i].met.extend(also);
        let x = self.bodies[i].now.x;
        match due.change {
            Change::Border(wall, region) => {
                let held = Held::new(wall, region, &self.plates[wall], x);
                self.bodies[i].held.retain(|held| held.wall != wall);
                self.bodies[i].held.push(held);
                self.hand_over(i, t);
            }
            Change::Release((Kind::Wall, wall)) => {
                let gone = self.bodies[i].held.extract_if(.., |held| held.wall == wall);
                let gone: Vec<Held> = gone.filter(Held::is_round).collect();
                self.bodies[i].left.extend(gone);
            }
            Change::Release((Kind::Pair, other)) => {
                self.leans.remove(&(i.min(other), i.max(other)));
                self.part(i, other, t)?;
            }
            Change::Piece | Change::Unclear(..) => {}
        }
        Ok(())
    }

    /// At an edge other walls may be waiting: what sphere `i` touches at `t` (s) and neither approaches nor leaves holds it.
    fn hand_over(&mut self, i: usize, t: Double) {
        let body = &self.bodies[i];
        let small = body.now.v.length() * Double::from(ROUNDING);
        let waits = |w: &usize| {
            let with = (Kind::Wall, *w);
            body.holder(*w).is_none() && self.touches(i, with, t) && self.parting(i, with, t).abs() <= small
        };
        let held = |w: usize| {
            let (region, part) = self.plates[w].closest(body.now.x);
            Held { wall: w, region, part }
        };
        let found: Vec<Held> = (0..self.plates.len()).filter(waits).map(held).collect();
        self.bodies[i].met.extend(found.iter().map(|held| (Kind::Wall, held.wall)));
        self.bodies[i].held.extend(found);
    }

    /// Something that holds sphere `i`.
    fn holder(&self, i: usize) -> (Kind, usize) {
        if let Some(held) = self.bodies[i].held.first() {
            return (Kind::Wall, held.wall);
        }
        let lean = self.leans.iter().find(|(a, b)| *a == i || *b == i);
        (Kind::Pair, lean.map_or(i, |&(a, b)| if a == i { b } else { a }))
    }

    /// Sphere `other`, on which another one has rested up to `t` (s), goes on without it.
    fn part(&mut self, i: usize, other: usize, t: Double) -> Result<(), Ending> {
        let also = self.clear_until(other, t, Some((Kind::Pair, i)))?;
        self.change(other, t, t.value(), (Kind::Pair, i));
        self.bodies[other].met.extend(also);
        Ok(())
    }
}
