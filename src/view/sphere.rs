//! The selected sphere in the inspector: where it is, what it carries, what pushes it, what it met last and meets next.

use glam::DVec3;

use super::{column::Column, screen::Screen};
use crate::explain;
use crate::format;
use crate::snapshot::{Class, Contact, Kind, Logged, Snapshot};

/// Fewest rows with momentum, potential energy and forces: with fewer the contacts need the room.
const TALL: usize = 30;

/// Support forces that are listed, at most.
const SUPPORTS: usize = 3;

/// Draws the section: a heading alone where no sphere is selected.
pub(super) fn draw(screen: &Screen, column: &mut Column) {
    let snapshot = screen.snapshot;
    let chosen = screen.view_settings.selected.and_then(|i| Some((i, *snapshot.x.get(i)?, *snapshot.v.get(i)?)));
    let Some((i, x, v)) = chosen else {
        column.heading("sphere", "none selected");
        return column.skip();
    };
    let stage = &snapshot.stage;
    let name = stage.names.get(i).and_then(|name| name.as_deref()).unwrap_or("");
    let mass = stage.masses.get(i).copied().unwrap_or(f64::NAN);
    let radius = stage.radii.get(i).copied().unwrap_or(f64::NAN);
    let force = stage.gravity * mass + stage.forces.get(i).copied().unwrap_or_default();
    let tall = column.rows() >= TALL;
    column.heading(&format!("sphere #{i}"), name);
    draw_vectors(x, v, column);
    column.entry("speed", &format::decimal(v.length(), 10, 4), "m/s");
    if tall {
        column.entry("momentum", &format::decimal(mass * v.length(), 10, 4), "kg m/s");
    }
    column.entry("kinetic", &format::decimal(0.5 * mass * v.length_squared(), 10, 4), "J");
    if tall && force != DVec3::ZERO {
        // as in the energy of the run: −m g·x − F·x
        column.entry("potential", &format::decimal(0.0 - force.dot(x), 10, 4), "J");
    }
    let faint = column.sheet().palette.faint();
    column.row(&format!("{} kg, radius {} m", format::setting(mass), format::setting(radius)), faint);
    if tall {
        draw_forces(snapshot, i, mass, column);
    }
    draw_meetings(screen, i, column);
    column.skip();
}

/// Draws position (m) and velocity (m/s) side by side, in columns as wide as there is room for.
fn draw_vectors(x: DVec3, v: DVec3, column: &mut Column) {
    let (faint, plain) = (column.sheet().palette.faint(), column.sheet().palette.plain());
    let width = (column.width().saturating_sub(1) / 2).clamp(9, 14);
    let decimals = (width - 6).min(6);
    column.row(&format!(" {:>width$}{:>width$}", "position m", "velocity m/s"), faint);
    for (axis, x, v) in [("x", x.x, v.x), ("y", x.y, v.y), ("z", x.z, v.z)] {
        let values = format::decimal(x, width, decimals) + &format::decimal(v, width, decimals);
        column.pieces(&[(axis, faint), (&values, plain)]);
    }
}

/// Draws the forces on sphere `i` of mass `mass` (kg), by source.
fn draw_forces(snapshot: &Snapshot, i: usize, mass: f64, column: &mut Column) {
    let stage = &snapshot.stage;
    let mut forces = Vec::new();
    if stage.gravity != DVec3::ZERO {
        forces.push(("gravity".to_owned(), stage.gravity * mass));
    }
    if let Some(own) = stage.forces.get(i).filter(|own| **own != DVec3::ZERO) {
        forces.push(("own".to_owned(), *own));
    }
    let supports = snapshot.contacts.iter().filter_map(|contact| support(snapshot, contact, i));
    let supports: Vec<_> = supports.collect();
    let more = supports.len().saturating_sub(SUPPORTS);
    forces.extend(supports.into_iter().take(SUPPORTS));
    let (faint, plain) = (column.sheet().palette.faint(), column.sheet().palette.plain());
    column.row(if forces.is_empty() { "no force" } else { "force N" }, faint);
    for (source, force) in forces {
        let width = (column.width().saturating_sub(9) / 3).clamp(6, 9);
        let part = |value: f64| format!(" {}", format::decimal(value, width - 1, 3));
        let values: String = force.to_array().map(part).concat();
        column.pieces(&[(&format!(" {source:<8}"), faint), (&values, plain)]);
    }
    if more > 0 {
        column.row(&format!(" and {more} more"), faint);
    }
}

/// The support force of a contact on sphere `i`, N, and the name of what supports it.
fn support(snapshot: &Snapshot, contact: &Contact, i: usize) -> Option<(String, DVec3)> {
    let force = explain::support_force(snapshot, contact).filter(|force| *force > 0.0)?;
    match contact.kind {
        Kind::Wall if contact.a == i => Some((format!("wall {}", contact.b), contact.normal * force)),
        Kind::Pair if contact.a == i => Some((format!("#{}", contact.b), contact.normal * force)),
        Kind::Pair if contact.b == i => Some((format!("#{}", contact.a), contact.normal * -force)),
        _ => None,
    }
}

/// Draws the last contact of sphere `i` up to the frame shown, and the next, as far as they are known.
fn draw_meetings(screen: &Screen, i: usize, column: &mut Column) {
    let t = screen.snapshot.t;
    let takes_part = |event: &Logged| event.a as usize == i || event.kind == Kind::Pair && event.b as usize == i;
    let last = screen.log.and_then(|log| log.iter().rev().find(|(_, event)| event.time <= t && takes_part(event)));
    let last = last.map(|(_, event)| {
        let other = (event.kind, if event.a as usize == i { event.b as usize } else { event.a as usize });
        meeting(event.class, other, event.time)
    });
    let ahead = screen.ahead.filter(|ahead| ahead.sphere == i);
    let next = ahead.map(|ahead| match ahead.contact {
        Some(contact) => {
            let other = (contact.kind, if contact.a == i { contact.b } else { contact.a });
            meeting(contact.class, other, contact.time)
        }
        None => format!("nothing until {} s", format::significant(ahead.until, 5)),
    });
    let (faint, plain) = (column.sheet().palette.faint(), column.sheet().palette.plain());
    for (label, said) in [("last", last.unwrap_or("-".into())), ("next", next.unwrap_or("-".into()))] {
        column.pieces(&[(&format!("{label:<6}"), faint), (&said, plain)]);
    }
}

/// A contact in words: `wall 6 at 0.2213 s, collides`.
fn meeting(class: Class, (kind, other): (Kind, usize), time: f64) -> String {
    let other = if kind == Kind::Wall { format!("wall {other}") } else { format!("#{other}") };
    let word = match class {
        Class::Collide => "collides",
        Class::Rest => "rests",
        Class::Release | Class::Leave => "leaves",
    };
    format!("{word}, {other}, {} s", format::significant(time, 5))
}
