//! Which impact comes first that should not, or does not come: the impacts of a trajectory against those of `exact`.

use std::collections::BTreeMap;

use super::observer::Seen;
use crate::physics::Kind;
use crate::physics::contact::Key;

/// What is wrong with an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wrong {
    /// `exact` has it, the trajectory does not.
    Missing,
    /// The impact comes later by this, s; earlier if below 0.
    Late(f64),
    /// The trajectory has it, `exact` does not.
    Extra,
}

/// An impact that is wrong.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WrongImpact {
    /// Time of the impact, s: in `exact`; of an extra one in the trajectory.
    pub time: f64,
    /// Sphere and wall, or two spheres.
    pub key: Key,
    /// How the impact is wrong.
    pub wrong: Wrong,
}

/// What rows so far apart can show.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sight {
    /// Up to when impacts are compared, s.
    pub(super) until: f64,
    /// Longest time between two rows, s.
    pub(super) spacing: f64,
    /// Delays (s) that count: at least a row, and what a position off by so much (m) means at the impact's speed.
    pub(super) tolerance: f64,
}

/// Rows within which two impacts of one sphere can't be told apart.
const ROWS: f64 = 2.0;

/// How many times the least speed that rows show an impact has to have, to be missed.
const CLEARLY: f64 = 1.5;

/// Impacts held against those that should be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Compared {
    /// The first impact that is wrong.
    pub(super) first_wrong: Option<WrongImpact>,
    /// Number of impacts found, of those that rows can show.
    pub(super) found: usize,
    /// Number of impacts that rows can show.
    pub(super) wanted: usize,
}

/// Compares impacts, both in order of time. `floor` is the least approach speed (m/s) of a contact that rows show.
pub(super) fn compare(exact: &[Seen], found: &[Seen], sight: Sight, floor: impl Fn(Key) -> f64) -> Compared {
    let shown = visible(exact, sight);
    let clear = |impact: &Seen| impact.approach > CLEARLY * floor(impact.key) && impact.time < sight.until;
    let mut rest = by_key(found.iter().copied().enumerate());
    let wanted = by_key(exact.iter().copied().enumerate());
    let (mut wrong, mut compared) = (Vec::new(), Compared { first_wrong: None, found: 0, wanted: 0 });
    for (key, list) in &wanted {
        let rest = rest.entry(*key).or_default();
        for (n, (index, impact)) in list.iter().enumerate() {
            let before = n.checked_sub(1).map_or(f64::NEG_INFINITY, |n| list[n].1.time);
            let after = list.get(n + 1).map_or(f64::INFINITY, |next| next.1.time);
            let near = |(_, seen): &(usize, Seen)| {
                seen.time - before > impact.time - seen.time && after - seen.time > seen.time - impact.time
            };
            let seen = rest.iter().position(near).map(|place| rest.remove(place).1);
            let counts = shown[*index] && clear(impact);
            compared.wanted += usize::from(counts);
            compared.found += usize::from(counts && seen.is_some());
            let what = match seen {
                None => Some(Wrong::Missing),
                Some(seen) => late(impact, &seen, sight),
            };
            wrong.extend(what.filter(|_| counts).map(|what| WrongImpact { time: impact.time, key: *key, wrong: what }));
        }
    }
    let extra = rest.into_values().flatten().map(|(_, seen)| seen);
    let extra = extra.filter(|seen| clear(seen) && !is_crowded(seen, exact, &shown, sight));
    wrong.extend(extra.map(|seen| WrongImpact { time: seen.time, key: seen.key, wrong: Wrong::Extra }));
    compared.first_wrong = wrong.into_iter().min_by(|one, other| one.time.total_cmp(&other.time));
    compared
}

fn by_key(all: impl Iterator<Item = (usize, Seen)>) -> BTreeMap<Key, Vec<(usize, Seen)>> {
    let mut lists: BTreeMap<Key, Vec<(usize, Seen)>> = BTreeMap::new();
    all.for_each(|impact| lists.entry(impact.1.key).or_default().push(impact));
    lists
}

fn late(impact: &Seen, seen: &Seen, sight: Sight) -> Option<Wrong> {
    let delay = seen.time - impact.time;
    (delay.abs() > sight.spacing.max(sight.tolerance / impact.approach)).then_some(Wrong::Late(delay))
}

fn spheres((kind, a, b): Key) -> impl Iterator<Item = usize> {
    [Some(a), (kind == Kind::Pair).then_some(b)].into_iter().flatten()
}

/// Which impacts have no other of the same sphere within two rows.
fn visible(exact: &[Seen], sight: Sight) -> Vec<bool> {
    let mut shown = vec![true; exact.len()];
    let mut last: BTreeMap<usize, usize> = BTreeMap::new();
    for (index, impact) in exact.iter().enumerate() {
        for i in spheres(impact.key) {
            if let Some(before) = last.insert(i, index).filter(|b| impact.time - exact[*b].time < ROWS * sight.spacing)
            {
                (shown[index], shown[before]) = (false, false);
            }
        }
    }
    shown
}

/// Whether an impact may be one of those that rows do not tell apart, or what they make of several.
fn is_crowded(seen: &Seen, exact: &[Seen], shown: &[bool], sight: Sight) -> bool {
    let reach = 2.0 * ROWS * sight.spacing;
    let from = exact.partition_point(|impact| impact.time < seen.time - reach);
    let near = exact[from..].iter().zip(&shown[from..]).take_while(|(impact, _)| impact.time <= seen.time + reach);
    near.filter(|(_, shown)| !**shown).any(|(impact, _)| spheres(impact.key).any(|i| spheres(seen.key).any(|k| i == k)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(list: &[(f64, usize)]) -> Vec<Seen> {
        list.iter().map(|&(time, wall)| Seen { key: (Kind::Wall, 0, wall), time, approach: 5.0 }).collect()
    }

    fn first(exact: &[(f64, usize)], found: &[(f64, usize)]) -> (Option<WrongImpact>, usize) {
        let sight = Sight { until: 10.0, spacing: 0.01, tolerance: 0.1 };
        let compared = compare(&seen(exact), &seen(found), sight, |_| 0.1);
        (compared.first_wrong, compared.found)
    }

    fn wrong(time: f64, wall: usize, wrong: Wrong) -> Option<WrongImpact> {
        Some(WrongImpact { time, key: (Kind::Wall, 0, wall), wrong })
    }

    #[test]
    fn the_first_impact_that_is_missing_late_or_extra_is_named() {
        let exact = [(1.0, 0), (2.0, 1), (3.0, 0), (4.0, 0)];
        assert_eq!(first(&exact, &exact), (None, 4));
        assert_eq!(first(&exact, &[(1.0, 0), (3.0, 0), (4.0, 0)]), (wrong(2.0, 1, Wrong::Missing), 3));
        let lacks = first(&exact, &[(1.0, 0), (2.0, 1), (4.0, 0)]).0;
        assert_eq!(lacks, wrong(3.0, 0, Wrong::Missing), "it is not late by a second");
        assert_eq!(first(&exact, &[(1.25, 0), (2.0, 1), (3.0, 0), (4.0, 0)]).0, wrong(1.0, 0, Wrong::Late(0.25)));
        let more = first(&exact, &[(1.0, 0), (1.5, 2), (2.0, 1), (3.0, 0), (4.0, 0)]).0;
        assert_eq!(more, wrong(1.5, 2, Wrong::Extra));
        // A position off by 0.1 m is 0.02 s at 5 m/s: so much may an impact be off.
        assert_eq!(first(&exact, &[(1.019, 0), (2.0, 1), (3.0, 0), (4.0, 0)]), (None, 4));
    }

    #[test]
    fn impacts_that_rows_cannot_tell_apart_are_not_missed_and_those_after_them_are() {
        let exact = [(1.0, 0), (2.0, 1), (2.015, 0), (3.0, 0)];
        assert_eq!(first(&exact, &[(1.0, 0), (2.01, 2), (3.0, 0)]), (None, 2));
        assert_eq!(first(&exact, &[(1.0, 0)]).0, wrong(3.0, 0, Wrong::Missing));
    }
}
