//! A film of the screen in asciinema's format (asciicast v3): a header, then one line per picture or marker, each with
//! the time since the line before, s.

use std::io::Write;
use std::sync::Arc;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::failure::Failure;
use super::frames::next_frame;
use super::output::Output;
use super::render::screen_of;
use super::signals::Signals;
use crate::audit::Watch;
use crate::explain;
use crate::frame::Encoder;
use crate::physics::{Class, Simulation};
use crate::scene::{Opened, Settings};
use crate::snapshot::{Snapshot, Stage, Ticks};
use crate::view;

/// Pictures per second of the film.
const RATE: f64 = 30.0;

/// Markers, at most: among more, one would not be found.
const MOST_MARKERS: usize = 1000;

/// What is filmed, and how.
pub(super) struct Film<'a> {
    pub(super) opened: &'a Opened,
    pub(super) settings: Settings,
    /// Simulated time at the end, s.
    pub(super) until: f64,
    /// Columns and rows.
    pub(super) size: (u16, u16),
    /// Simulated seconds per second of film.
    pub(super) speed: f64,
}

/// Writes the film: a picture for every thirtieth of a second in which something has changed, a marker per collision.
pub(super) fn write(film: &Film, out: &mut Output, signals: &Signals) -> Result<(), Failure> {
    let (columns, rows) = film.size;
    let title = quoted(&format!("carom {}", film.opened.key));
    writeln!(out, r#"{{"version":3,"term":{{"cols":{columns},"rows":{rows}}},"title":{title}}}"#)?;
    let mut run = Simulation::new(&film.opened.scene, film.settings);
    run.record_events(true);
    let mut camera = Camera {
        film,
        stage: Arc::new(Stage::of(&film.opened.key, &film.opened.scene)),
        watch: Watch::new(&run),
        ticks: Ticks::new(film.opened.scene.duration),
        encoder: Encoder::new(),
        last: 0.0,
        markers: 0,
    };
    camera.picture(&run, out)?;
    let mut pictures = 0.0;
    let mut goes_on = true;
    while goes_on && run.time() < film.until {
        goes_on = next_frame(&mut run, signals)?;
        camera.watch.look(&run, true);
        camera.mark(&mut run, out)?;
        let due = (run.time() / film.speed * RATE).floor();
        if due > pictures || !goes_on || run.time() >= film.until {
            pictures = due;
            camera.picture(&run, out)?;
        }
    }
    Ok(())
}

/// What the film is taken with.
struct Camera<'a> {
    film: &'a Film<'a>,
    stage: Arc<Stage>,
    watch: Watch,
    ticks: Ticks,
    encoder: Encoder,
    /// Time of the line before, s of film.
    last: f64,
    markers: usize,
}

impl Camera<'_> {
    /// The screen at the end of the frame.
    fn picture(&mut self, run: &Simulation, out: &mut Output) -> Result<(), Failure> {
        let snapshot = Snapshot { alarm: *self.watch.alarm(), ..Snapshot::of(&self.stage, run, None) };
        let (columns, rows) = self.film.size;
        let mut buffer = Buffer::empty(Rect::new(0, 0, columns, rows));
        screen_of(&snapshot, &self.ticks, self.film.speed, &view::ViewSettings::default(), |screen| {
            view::draw(screen, buffer.area, &mut buffer);
        });
        let bytes = self.encoder.encode(&buffer, None);
        if bytes.is_empty() {
            return Ok(());
        }
        self.line(run.time(), 'o', &String::from_utf8_lossy(&bytes), out)
    }

    /// A marker for every collision since the last picture.
    fn mark(&mut self, run: &mut Simulation, out: &mut Output) -> Result<(), Failure> {
        for event in run.take_events().into_iter().filter(|event| event.class == Class::Collide) {
            self.ticks.add(event.time);
            if self.markers < MOST_MARKERS {
                self.markers += 1;
                self.line(event.time, 'm', &explain::sentence(&event), out)?;
            }
        }
        Ok(())
    }

    /// A line of the film at `time`, simulated s.
    fn line(&mut self, time: f64, kind: char, text: &str, out: &mut Output) -> Result<(), Failure> {
        let now = (time / self.film.speed).max(self.last);
        writeln!(out, r#"[{:.6},"{kind}",{}]"#, now - self.last, quoted(text))?;
        self.last = now;
        Ok(())
    }
}

/// A text as JSON.
fn quoted(text: &str) -> String {
    let mut json = String::with_capacity(text.len() + 2);
    json.push('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => json.extend(['\\', c]),
            c if c < ' ' || c == '\u{7f}' => json += &format!("\\u{:04x}", u32::from(c)),
            c => json.push(c),
        }
    }
    json.push('"');
    json
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn escape_sequences_and_quotes_become_json() {
        assert_eq!(quoted("\x1b[1m \"a\\b\" ⠋"), r#""\u001b[1m \"a\\b\" ⠋""#);
    }
}
