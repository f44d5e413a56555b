//! Files with a row for each time: columns `x0,y0,z0,x1,…`, a sphere's number behind each name.

use super::columns::COLUMNS;
use super::trade::{CELL, ReadError};
use crate::printable;

/// How a number stands behind a name: `x0`, `x_0`, `x.0`, `x[0]`, `x(0)`.
const STYLES: [(&str, &str); 5] = [("", ""), ("_", ""), (".", ""), ("[", "]"), ("(", ")")];

/// What stands for a sphere's number in a name of `--columns`.
const NUMBER: char = '#';

/// Where a row has each sphere's place, and velocity if the file has any.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Wide {
    /// The cell of the time.
    pub(super) time: usize,
    /// By sphere, the cells of x, y and z.
    pub(super) places: Vec<[usize; 3]>,
    /// By sphere, the cells of vx, vy and vz; empty if there are none.
    pub(super) velocities: Vec<[usize; 3]>,
}

/// How a file numbers its spheres.
#[derive(Debug, Clone, Copy)]
struct Numbering {
    style: (&'static str, &'static str),
    /// Number of the first sphere.
    first: usize,
}

impl Numbering {
    /// The file's name of a column of sphere `i`.
    fn name(&self, column: &str, i: usize) -> String {
        let number = (self.first + i).to_string();
        match column.contains(NUMBER) {
            true => column.replace(NUMBER, &number),
            false => format!("{column}{}{number}{}", self.style.0, self.style.1),
        }
    }
}

/// The cells of a file that has numbered columns; none if it has none. `ours` are its names for our columns.
///
/// # Errors
/// A column of a sphere that is missing, or of a sphere that the scene lacks.
pub(super) fn wide(
    header: &csv::StringRecord,
    ours: &[String; COLUMNS],
    spheres: usize,
) -> Result<Option<Wide>, ReadError> {
    let place = |name: &str| header.iter().position(|cell| cell == name);
    let all = [0, 1].into_iter().flat_map(|first| STYLES.map(|style| Numbering { style, first }));
    let Some(numbering) = all.into_iter().find(|numbering| place(&numbering.name(&ours[2], 0)).is_some()) else {
        return Ok(None);
    };
    let lacks = |name: &str| {
        let found = printable::shortened(&header.iter().collect::<Vec<_>>().join(","), CELL);
        let (first, last) = (numbering.first, numbering.first + spheres.saturating_sub(1));
        ReadError(format!(
            "1: there is no column {name}; the first line is \"{found}\"; wanted is one for each sphere, {first} to {last}"
        ))
    };
    let more = numbering.name(&ours[2], spheres);
    if place(&more).is_some() {
        return Err(ReadError(format!("1: column {more} is of a sphere more than the scene has, which are {spheres}")));
    }
    let time = place(&ours[0]).ok_or_else(|| lacks(&ours[0]))?;
    let cells = |columns: [usize; 3]| -> Result<Vec<[usize; 3]>, ReadError> {
        let of = |i: usize| -> Result<[usize; 3], ReadError> {
            let mut found = [0; 3];
            for (cell, column) in found.iter_mut().zip(columns) {
                let name = numbering.name(&ours[column], i);
                *cell = place(&name).ok_or_else(|| lacks(&name))?;
            }
            Ok(found)
        };
        (0..spheres).map(of).collect()
    };
    let moves = (5..COLUMNS).any(|column| place(&numbering.name(&ours[column], 0)).is_some());
    let velocities = if moves { cells([5, 6, 7])? } else { Vec::new() };
    Ok(Some(Wide { time, places: cells([2, 3, 4])?, velocities }))
}
