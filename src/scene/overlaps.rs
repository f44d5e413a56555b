//! Which bodies overlap at the start, by more than rounding.

use super::bodies::Bodies;
use super::effort::{Effort, SLANTED};
use super::error::{Error, Source};
use super::locate::Step::{Field, Index};
use super::near::Tree;
use super::validated::{Sphere, Wall};
use crate::format::rounded;
use crate::geometry::Bounds;

/// Overlap that a scene may start with, in radii (of a pair: in sums of radii).
const OVERLAP: f64 = 1e-9;

/// Refuses the first two spheres that overlap by more than rounding, then the first wall that a sphere overlaps so.
pub(super) fn refuse_overlaps(
    walls: &Bodies<Wall>,
    spheres: &Bodies<Sphere>,
    effort: &Effort,
    source: Source,
) -> Result<(), Error> {
    let all = &spheres.list;
    let boxes: Vec<Bounds> = all.iter().map(|sphere| Bounds::around(sphere.x, sphere.radius)).collect();
    let tree = Tree::new(&boxes);
    let partner = |a: usize| {
        let hit = |b: usize| b > a && pair_depth(&all[a], &all[b]).is_some();
        tree.first(|bounds| bounds.touches(&boxes[a]), hit).map(|b| (a, b))
    };
    let refuse = |(a, later): (usize, usize), other: String, depth: Option<f64>| {
        let (one, depth) = (spheres.describe(a), rounded(depth.unwrap_or(0.0)));
        let message = format!("{one} overlaps {other} by {depth} m; allowed is up to 1e-9 of the radius");
        source.refuse(&[Field("spheres"), Index(spheres.entry(later))], message)
    };
    if let Some((a, b)) = (0..all.len()).find_map(partner) {
        return Err(refuse((a, b), spheres.describe(b), pair_depth(&all[a], &all[b])));
    }
    let overlapped = |(index, wall): (usize, &Wall)| {
        let outline = wall.shape.outline();
        let hit = |a: usize| effort.spend(SLANTED) && wall_depth(&all[a], wall).is_some();
        tree.first(|bounds| effort.spend(SLANTED) && outline.may_touch(bounds), hit).map(|a| (a, index))
    };
    if let Some((a, wall)) = walls.list.iter().enumerate().find_map(overlapped) {
        return Err(refuse((a, a), walls.describe(wall), wall_depth(&all[a], &walls.list[wall])));
    }
    if effort.spent() { Err(source.refuse(&[Field("spheres")], Effort::refusal())) } else { Ok(()) }
}

/// Depth of the overlap of two spheres, m; none if no deeper than allowed.
fn pair_depth(a: &Sphere, b: &Sphere) -> Option<f64> {
    let reach = a.radius + b.radius;
    let depth = reach - a.x.distance(b.x);
    (depth > OVERLAP * reach).then_some(depth)
}

/// Depth of the overlap of a sphere with the closest point of a wall, m; none if no deeper than allowed.
fn wall_depth(sphere: &Sphere, wall: &Wall) -> Option<f64> {
    let depth = sphere.radius - wall.shape.distance(sphere.x);
    (depth > OVERLAP * sphere.radius).then_some(depth)
}
