//! Block principal pivoting: guess which contacts carry, solve for those alone, exchange all that are wrong at once.
//!
//! Source: Portugal, Júdice, Vicente, Mathematics of Computation 63 (1994), 625; of those that are wrong only the last one is
//! exchanged where all together lead nowhere (Murty). From the loads of a moment ago it needs a step or two, each by the
//! skyline of [`gram`](super::gram). It answers where it comes to an end soon and its contacts are independent; the active
//! set does the rest.

use glam::DVec3;

use super::gram;
use super::problem::{Problem, ROUNDING, Row};
use super::short::Short;

/// Exchanges of everything that is wrong without fewer being wrong.
const PATIENCE: u32 = 3;

/// Exchanges in all: whatever needs more is no case for this method.
const MOST: usize = 40;

/// u by body, multipliers by row, and the exchanges that it took.
pub(super) type Answer = (Vec<DVec3>, Vec<f64>, usize);

/// Solves the problem from the multipliers `guess` (≥ 0; empty or all 0: from what approaches); none where it leads nowhere.
pub(super) fn solve(problem: &Problem, guess: &[f64]) -> Option<Answer> {
    let count = problem.rows.len();
    let rounding: Short<f64> = (0..count).map(|row| ROUNDING * problem.size(row)).collect();
    let mut carries: Short<bool> = guess.iter().map(|&load| load > 0.0).collect();
    if !carries.contains(&true) {
        carries = (0..count).map(|row| problem.opening(row, &problem.free) < -rounding[row]).collect();
    }
    let (mut fewest, mut patience) = (count + 1, PATIENCE);
    for passes in 1..=MOST {
        let (u, multipliers) = held(problem, &carries)?;
        let is_wrong = |row: usize| match carries[row] {
            true => multipliers[row] < 0.0,
            false => problem.opening(row, &u) < -rounding[row],
        };
        let wrong: Short<usize> = (0..count).filter(|&row| is_wrong(row)).collect();
        let Some(&last) = wrong.last() else {
            let finite = u.iter().all(|u| u.is_finite());
            return finite.then_some((u, multipliers, passes));
        };
        if wrong.len() < fewest {
            (fewest, patience) = (wrong.len(), PATIENCE);
        } else if patience > 0 {
            patience -= 1;
        } else {
            carries[last] = !carries[last];
            continue;
        }
        wrong.into_iter().for_each(|row| carries[row] = !carries[row]);
    }
    None
}

/// u and all multipliers if exactly these contacts hold; a contact that depends on others carries nothing.
fn held(problem: &Problem, carries: &[bool]) -> Option<(Vec<DVec3>, Vec<f64>)> {
    let holding: Short<usize> = (0..carries.len()).filter(|&row| carries[row]).collect();
    let rows: Short<Row> = holding.iter().map(|&row| problem.rows[row]).collect();
    let (u, loads) = gram::bind(&problem.inverse_mass, &problem.free, &rows, true)?;
    let mut multipliers = vec![0.0; carries.len()];
    holding.into_iter().zip(loads).for_each(|(row, load)| multipliers[row] = load);
    Some((u, multipliers))
}
