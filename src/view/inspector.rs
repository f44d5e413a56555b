//! The inspector: the selected sphere, the run's balance, the frame's contacts, its search for the collision time.

use ratatui::layout::Rect;

use super::{
    column::Column,
    distribution,
    layout::split_left,
    probes,
    screen::Screen,
    sheet::{self, Sheet},
    sphere,
};
use crate::format;
use crate::snapshot::{Class, Contact, Kind, Snapshot};

/// Rows of what the model leaves out, at most.
const LEFT_OUT: usize = 3;

/// Rows of the run's balance.
const RUN: usize = 9 + LEFT_OUT;
/// Fewest rows that the contacts should have.
const CONTACTS: usize = 14;

/// Rows kept for the search for the collision time, if there was one.
const SEARCH: usize = 6;

/// Draws the inspector.
pub(super) fn draw(screen: &Screen, area: Rect, sheet: &mut Sheet) {
    let (_, area) = split_left(area, 1);
    let area = Rect { width: area.width.saturating_sub(1), ..area };
    let mut column = Column::new(area, sheet);
    // with a sphere selected it is that one that matters
    let chosen = screen.view_settings.selected.is_some();
    if chosen || !distribution::draw(screen.snapshot, &mut column) {
        sphere::draw(screen, &mut column);
    }
    // Only sizes decide what is shown, never how many contacts there are: nothing jumps while it runs.
    if column.rows() >= RUN + CONTACTS {
        draw_run(screen.snapshot, &mut column);
    }
    draw_contacts(screen.snapshot, &mut column);
    probes::draw(&probes::Search::new(screen.snapshot, None), &mut column);
}

/// Draws energy and tallies of the whole run.
fn draw_run(snapshot: &Snapshot, column: &mut Column) {
    let tallies = snapshot.tallies;
    let unsolved = match tallies.unconverged {
        0 => String::new(),
        frames => format!(", {} unsolved", format::thousands(frames)),
    };
    column.heading("run", &format!("frame of {} s{unsolved}", format::setting(snapshot.step)));
    column.entry("energy", &format::decimal(snapshot.energy, 10, 4), "J");
    let change = (snapshot.energy - snapshot.initial_energy) / snapshot.initial_energy.abs() * 100.0;
    if change.is_finite() {
        column.entry("  since 0", &format::decimal(change, 10, 4), "%");
    }
    column.entry("deepest", &format::scientific(tallies.deepest_degree, 10), "overlap");
    column.entry("frames", &format::thousands(tallies.frames), "");
    column.entry("impacts", &format::thousands(tallies.impacts), "");
    column.entry("rests", &format::thousands(tallies.rests), "");
    column.entry("gaps", &format::thousands(tallies.evaluations), "computed");
    draw_left_out(snapshot, column);
    column.skip();
}

/// Draws what the model leaves out, because the scene does not require it.
fn draw_left_out(snapshot: &Snapshot, column: &mut Column) {
    if snapshot.left_out.is_empty() {
        return;
    }
    let text = format!("leaves out {}", snapshot.left_out.join(", "));
    let faint = column.sheet().palette.faint();
    let lines = sheet::wrap(&text, column.width() as u16);
    let cut = lines.len() > LEFT_OUT;
    for (index, line) in lines.into_iter().take(LEFT_OUT).enumerate() {
        let end = if cut && index + 1 == LEFT_OUT { column.sheet().glyphs.ellipsis } else { "" };
        column.row(&format!("{line}{end}"), faint);
    }
}

/// Draws two rows a contact: bodies, class, degree; approach speed before → separation speed after, impulse.
fn draw_contacts(snapshot: &Snapshot, column: &mut Column) {
    let contacts = &snapshot.contacts;
    column.heading("contacts", &format!("{} in this frame", contacts.len()));
    draw_legend(column);
    // The contacts come first: the search gets what they leave, up to its share.
    let spare = column.rows().saturating_sub(2 * contacts.len().min(1));
    let search = if snapshot.probes.is_empty() { 1 } else { SEARCH.min(spare) };
    let room = (column.rows().saturating_sub(search) / 2).min(contacts.len());
    for contact in &contacts[..room] {
        draw_contact(contact, column);
    }
    if room < contacts.len() {
        let faint = column.sheet().palette.faint();
        column.row(&format!("and {} more", contacts.len() - room), faint);
    } else {
        column.skip();
    }
}

/// Draws what the two rows of a contact say, in the columns of these rows.
fn draw_legend(column: &mut Column) {
    let (faint, arrow) = (column.sheet().palette.faint(), column.sheet().glyphs.arrow);
    let bodies = column.width().saturating_sub(CLASS + DEGREE);
    column.row(&format!("{:<bodies$}{:<CLASS$}{:>DEGREE$}", "bodies", "class", "overlap"), faint);
    column.row(&format!("{:>7}{arrow}{:<9}{:>11}", "before", "after m/s", "J in N s"), faint);
}

/// Columns for a contact's class.
const CLASS: usize = 9;
/// Columns for a contact's degree.
const DEGREE: usize = 8;

fn draw_contact(contact: &Contact, column: &mut Column) {
    let (palette, glyphs) = (column.sheet().palette, column.sheet().glyphs);
    let bodies = match contact.kind {
        Kind::Wall => format!("#{}{}wall {}", contact.a, glyphs.with, contact.b),
        Kind::Pair => format!("#{}{}#{}", contact.a, glyphs.with, contact.b),
    };
    let (class, style) = match contact.class {
        Class::Collide => ("collides", palette.alarm()),
        Class::Rest => ("rests", palette.notice()),
        Class::Leave => ("leaves", palette.plain()),
        Class::Release => ("released", palette.plain()),
    };
    let (faint, plain) = (palette.faint(), palette.plain());
    let pad = " ".repeat(column.width().saturating_sub(CLASS + DEGREE + sheet::width(&bodies)));
    let (class, degree) = (format!("{class:<CLASS$}"), format::scientific(contact.degree, DEGREE));
    column.pieces(&[(&bodies, plain), (&pad, plain), (&class, style), (&degree, faint)]);
    let before = format::decimal(contact.approach_speed, 7, 3);
    let after = format::decimal(contact.separation_speed, 6, 3);
    let impulse = format::decimal(contact.impulse, 14, 4);
    column.row(&format!("{before}{}{after}{impulse}", glyphs.arrow), plain);
}
