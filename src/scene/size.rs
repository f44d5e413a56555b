//! Whether a scene is too large, for any use or for this machine, told from its numbers before anything is made of them.
//!
//! A refused allocation ends a Rust program at once, with no chance to put a terminal right, so it must not come to
//! that. Where this ends: the need is that of the scene and one run of it by the method that keeps most; heaps in which
//! every sphere has many neighbours, a second run beside the first and long recordings need more, other programs may
//! take the memory meanwhile, and a system that gives memory it does not have (as Linux does by default) ends the
//! program later, when it is used. Where the system tells no limit, nothing is refused.

use std::fs;

use rustix::process::{Resource, getrlimit};

use super::error::{Error, Source};
use super::file::{SceneFile, SphereFile, WallFile};
use super::generate::SIDES;
use super::locate::Step::{Field, Index};
use super::number::{MOST_SPHERES, MOST_WALLS};
use super::validated::Draft;

/// Bytes that a sphere takes in the scene and in a run: 600 by `exact`, measured, and a quarter more.
const SPHERE: u64 = 750;
/// Bytes that a wall takes in the scene and in a run, measured, and a quarter more.
const WALL: u64 = 400;
/// A scene that needs less than this many bytes is not checked.
const SMALL: u64 = 16 << 20;

/// Refuses more walls or spheres than a scene may have, and so many that this machine has no room for them.
///
/// # Errors
/// The refusal, at the entry that is one too many.
pub(super) fn refuse_too_large(file: &SceneFile, source: Source) -> Result<(), Error> {
    let walls = counted(("walls", &file.walls), walls_of, MOST_WALLS, source)?;
    let spheres = counted(("spheres", &file.spheres), spheres_of, MOST_SPHERES, source)?;
    refuse_more_than_fits(spheres, walls).map_err(|message| source.refuse(&[Field("spheres")], message))
}

/// Refuses more walls or spheres in a draft than a scene may have, and so many that this machine has no room for a run.
///
/// # Errors
/// The refusal, at the body that is one too many.
pub(super) fn refuse_too_many(draft: &Draft, source: Source) -> Result<(), Error> {
    let walls = counted(("walls", &draft.walls), |_| 1, MOST_WALLS, source)?;
    let spheres = counted(("spheres", &draft.spheres), |_| 1, MOST_SPHERES, source)?;
    refuse_more_than_fits(spheres, walls).map_err(|message| source.refuse(&[Field("spheres")], message))
}

/// How many bodies the entries of a list make, if they are not more than `most`.
fn counted<T>(
    (list, entries): (&str, &[T]),
    bodies: fn(&T) -> usize,
    most: usize,
    source: Source,
) -> Result<usize, Error> {
    entries.iter().enumerate().try_fold(0_usize, |total, (index, entry)| {
        let total = total.saturating_add(bodies(entry));
        let message = || format!("with it the scene has {total} {list}; allowed are up to {most}");
        (total <= most).then_some(total).ok_or_else(|| source.refuse(&[Field(list), Index(index)], message()))
    })
}

fn walls_of(entry: &WallFile) -> usize {
    if matches!(entry, WallFile::Room { .. }) { SIDES.len() } else { 1 }
}

fn spheres_of(entry: &SphereFile) -> usize {
    match entry {
        SphereFile::Sphere { .. } => 1,
        SphereFile::Gas { count, .. } => count.0,
        SphereFile::Lattice { counts: (x, y, z), .. } => x.0.saturating_mul(y.0).saturating_mul(z.0),
    }
}

fn refuse_more_than_fits(spheres: usize, walls: usize) -> Result<(), String> {
    let need = (spheres as u64).saturating_mul(SPHERE).saturating_add((walls as u64).saturating_mul(WALL));
    match available() {
        Some((there, what)) if need > SMALL && need > there => Err(format!(
            "{spheres} spheres and {walls} walls need about {}, but {what} {}; allowed are fewer",
            megabytes(need),
            megabytes(there)
        )),
        _ => Ok(()),
    }
}

fn megabytes(bytes: u64) -> String {
    format!("{} MB", bytes.div_ceil(1_000_000))
}

/// The memory that this process may still take, bytes, and what bounds it; none if the system does not tell.
fn available() -> Option<(u64, &'static str)> {
    let limit = |resource| getrlimit(resource).current;
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let left = |resource, used| Some(limit(resource)?.saturating_sub(kilobytes(&status, used).unwrap_or(0)));
    let free = fs::read_to_string("/proc/meminfo").ok().and_then(|text| kilobytes(&text, "MemAvailable:"));
    let bounds = [
        (left(Resource::As, "VmSize:"), "the process may take (ulimit -v)"),
        (left(Resource::Data, "VmData:"), "the process may take (ulimit -d)"),
        (free, "the system has free"),
        (group(), "the control group may take"),
    ];
    bounds.into_iter().filter_map(|(bytes, what)| Some((bytes?, what))).min_by_key(|(bytes, _)| *bytes)
}

/// The value of a line `NAME  123 kB`, bytes.
fn kilobytes(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    Some(line.split_whitespace().next()?.parse::<u64>().ok()?.saturating_mul(1024))
}

/// What the memory control group of this process leaves, bytes: of a container, say.
fn group() -> Option<u64> {
    let read = |path: &str| fs::read_to_string(path).ok()?.trim().parse::<u64>().ok();
    let folder = "/sys/fs/cgroup";
    let names = [("memory.max", "memory.current"), ("memory/memory.limit_in_bytes", "memory/memory.usage_in_bytes")];
    names.iter().find_map(|(most, used)| {
        Some(read(&format!("{folder}/{most}"))?.saturating_sub(read(&format!("{folder}/{used}"))?))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_of_the_system_is_read_in_bytes() {
        let text = "MemTotal:  8000 kB\nMemAvailable:    1234 kB\n";
        assert_eq!(kilobytes(text, "MemAvailable:"), Some(1234 * 1024));
        assert_eq!(kilobytes(text, "SwapFree:"), None);
    }

    #[test]
    fn what_no_machine_has_is_refused_and_what_any_has_is_not() {
        assert_eq!(refuse_more_than_fits(20_000, 6), Ok(()));
        let refusal = refuse_more_than_fits(usize::MAX >> 16, 0);
        assert!(available().is_none() || refusal.is_err_and(|said| said.contains(" MB, but the ")));
    }
}
