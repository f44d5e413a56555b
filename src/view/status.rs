//! The first row: what runs, how far, how fast, solved how; that as a list on tiny screens; why a run stalled.

use ratatui::{layout::Rect, style::Style};

use super::{
    layout::{split_left, split_right, split_top},
    screen::{Mode, Screen},
    sheet::{self, Sheet},
};
use crate::format;

/// Columns between two fields.
const GAP: usize = 2;

/// Columns that the scene's name keeps, if it is that long, when fields have to go.
const NAME: usize = 8;

/// A piece of the status row: label, value, unit.
struct Field {
    label: String,
    value: String,
    unit: &'static str,
}

impl Field {
    fn new(label: &str, value: String, unit: &'static str) -> Field {
        Field { label: label.into(), value, unit }
    }

    fn width(&self) -> usize {
        sheet::width(&self.label) + sheet::width(&self.value) + sheet::width(self.unit)
    }
}

/// Draws the status row: badge, scene, then as many fields as fit, the most telling first.
pub(super) fn draw(screen: &Screen, area: Rect, sheet: &mut Sheet) {
    let (word, style) = badge(screen.pace.mode, sheet);
    let mut used = sheet.put(area, &format!("{word:^7}"), style);
    if !screen.snapshot.alarm.is_silent() {
        let alarm = sheet.palette.alarm().patch(sheet.palette.reverse()).patch(sheet.palette.strong());
        used += 1 + sheet.put(split_left(area, used + 1).1, " ALARM ", alarm);
    }
    if screen.recorded.is_some() {
        used +=
            1 + sheet.put(split_left(area, used + 1).1, " REC ", sheet.palette.alarm().patch(sheet.palette.reverse()));
    }
    let (_, area) = split_left(area, used + 1);
    let (area, _) = split_right(area, 1);
    let key = &screen.snapshot.stage.key;
    let mut room = usize::from(area.width).saturating_sub(sheet::width(key).min(NAME));
    let mut fields = fields(screen, sheet);
    let kept = fields.iter().take_while(|field| {
        let fits = field.width() + GAP <= room;
        room -= if fits { field.width() + GAP } else { 0 };
        fits
    });
    let kept = kept.count();
    fields.truncate(kept);
    let name_width = (room + sheet::width(key).min(NAME)).min(sheet::width(key));
    sheet.put(split_left(area, name_width as u16).0, key, sheet.palette.strong());
    // Whatever is left over spreads the fields, so that they stay put while numbers change.
    let spare = usize::from(area.width) - name_width - fields.iter().map(|field| field.width() + GAP).sum::<usize>();
    let mut x = name_width;
    for (i, field) in fields.iter().enumerate() {
        let share = spare * (i + 1) / fields.len() - spare * i / fields.len();
        x += GAP + share.min(3);
        put_field(field, split_left(area, x as u16).1, sheet);
        x += field.width();
    }
}

/// The word for the mode, and how it looks.
fn badge(mode: Mode, sheet: &Sheet) -> (&'static str, Style) {
    let palette = sheet.palette;
    let (word, style) = match mode {
        Mode::Run => ("RUN", palette.good()),
        Mode::Pause => ("PAUSE", palette.notice()),
        Mode::Back => ("BACK", palette.ghost()),
        Mode::Stalled => ("STALL", palette.alarm()),
    };
    (word, style.patch(palette.reverse()).patch(palette.strong()))
}

/// The fields in order of importance, which is their order on the screen.
fn fields(screen: &Screen, sheet: &Sheet) -> Vec<Field> {
    let snapshot = screen.snapshot;
    let duration = snapshot.stage.duration.max(snapshot.t);
    let times = sheet.glyphs.times;
    let reached = screen.pace.reached.map(|reached| format!("({}{times})", format::decimal(reached, 4, 2)));
    let wanted = format!("{}{times}", format::setting(screen.pace.wanted));
    vec![
        Field::new("t ", format::clock(snapshot.t, duration, snapshot.dt), " s"),
        Field::new("speed ", format!("{wanted} {:<7}", reached.unwrap_or_default()), ""),
        Field::new("", snapshot.method.into(), ""),
        Field::new("dt ", format::setting(snapshot.dt), " s"),
        Field::new("tol ", format::setting(snapshot.tolerance), ""),
        Field::new("E ", format::decimal(snapshot.energy, 9, 4), " J"),
        Field::new("impacts ", format!("{:>6}", format::thousands(snapshot.tallies.impacts)), ""),
    ]
}

fn put_field(field: &Field, area: Rect, sheet: &mut Sheet) {
    let (faint, plain) = (sheet.palette.faint(), sheet.palette.plain());
    sheet.put_all(area, &[(&field.label, faint), (&field.value, plain), (field.unit, faint)]);
}

/// Draws the status as a list, for screens too small for a picture.
pub(super) fn draw_numbers(screen: &Screen, area: Rect, sheet: &mut Sheet) {
    let (word, style) = badge(screen.pace.mode, sheet);
    let (first, mut rest) = split_top(area, 1);
    let used = sheet.put(first, &format!(" {word} "), style);
    sheet.put(split_left(first, used + 1).1, &screen.snapshot.stage.key, sheet.palette.strong());
    if let Some(reason) = &screen.snapshot.stall {
        for line in sheet::wrap(reason, rest.width) {
            let (row, below) = split_top(rest, 1);
            sheet.put(row, &line, sheet.palette.plain());
            rest = below;
        }
    }
    for sentence in screen.snapshot.alarm.sentences() {
        for line in sheet::wrap(&format!("ALARM {sentence}"), rest.width) {
            let (row, below) = split_top(rest, 1);
            sheet.put(row, &line, sheet.palette.alarm());
            rest = below;
        }
    }
    for field in fields(screen, sheet) {
        let (row, below) = split_top(rest, 1);
        put_field(&field, row, sheet);
        rest = below;
    }
}

/// Draws what the watch has found wrong, with its time and bodies, as a band over the lowest rows of the body.
pub(super) fn draw_alarm(screen: &Screen, body: Rect, sheet: &mut Sheet) {
    let style = sheet.palette.alarm().patch(sheet.palette.reverse());
    let sentences = screen.snapshot.alarm.sentences();
    let width = body.width.saturating_sub(2);
    let lines = sentences.iter().flat_map(|sentence| sheet::wrap(&format!("ALARM {sentence}"), width));
    let lines: Vec<String> = lines.take(usize::from(body.height / 2)).collect();
    let (_, mut rest) = split_top(body, body.height - lines.len() as u16);
    for line in lines {
        let (row, below) = split_top(rest, 1);
        sheet.clear(row);
        sheet.put(row, &" ".repeat(row.width.into()), style);
        sheet.put(split_left(row, 1).1, &line, style);
        rest = below;
    }
}

/// Draws a stalled run's reason, as a band over the upper rows of the body, as high as it needs.
pub(super) fn draw_stall(screen: &Screen, body: Rect, sheet: &mut Sheet) {
    let Some(reason) = &screen.snapshot.stall else { return };
    let style = sheet.palette.alarm().patch(sheet.palette.reverse());
    let (_, mut rest) = split_top(body, u16::from(body.height > 4)); // the views' labels stay
    for line in sheet::wrap(reason, body.width.saturating_sub(2)) {
        let (row, below) = split_top(rest, 1);
        sheet.clear(row); // or attributes of what was drawn there would show through
        sheet.put(row, &" ".repeat(row.width.into()), style);
        sheet.put(split_left(row, 1).1, &line, style);
        rest = below;
    }
}
