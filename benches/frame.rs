//! What a frame costs: milliseconds to draw, bytes to send. `cargo bench --bench frame`
//!
//! Two views of bouncing spheres. Times are medians of processor time on this machine; the ratios, taken in the same run, are what can be
//! compared between machines. Bytes are the same everywhere.

use std::{fmt::Write as _, hint::black_box, io::Write as _};

use carom::{
    frame::{Encoder, ansi, svg, text},
    measure,
    view::{self, Colors, Marker, Mode},
};
use glam::{DVec3, dvec3};
use ratatui::{
    buffer::{Buffer, Cell},
    layout::Rect,
    style::{Color, Modifier},
};

#[path = "../tests/support/stages.rs"]
mod stages;

/// Frames of a measurement: ten seconds at 30 frames per second.
const FRAMES: usize = 300;

fn main() -> std::io::Result<()> {
    let mut out = std::io::stdout().lock();
    writeln!(out, "drawing, 200x60, both views, median")?;
    for (count, target) in [(30, 1.0), (1000, 1.0), (10_000, 12.0)] {
        let (whole, naive) = (draw_ms(count), 2.0 * naive_circles_ms(count));
        writeln!(
            out,
            "  {count:>6} spheres  view::draw {whole:>8.3} ms (target {target} ms)   360-point circles alone {naive:>8.3} ms, \
             {:>5.1} times as long",
            naive / whole
        )?;
    }
    writeln!(out, "sending, 80x24, 30 moving spheres, 30 frames per second, 16 colours unless said, bytes")?;
    let kinds = [
        ("braille", Marker::Braille, Colors::Ansi16),
        ("no colour", Marker::Braille, Colors::Never),
        ("24-bit", Marker::Braille, Colors::Rgb),
        ("block", Marker::Block, Colors::Ansi16),
        ("ascii", Marker::Ascii, Colors::Ansi16),
    ];
    for (name, marker, colors) in kinds {
        let bytes = Bytes::of(marker, colors);
        writeln!(
            out,
            "  {name:<9} first frame {:>5}   then {:>5} median, {:>5} p95   by absolute moves and 256-colour codes {:>5}",
            bytes.first, bytes.median, bytes.p95, bytes.naive
        )?;
    }
    writeln!(out, "as a file, 80x24, 30 spheres: {}", files())
}

/// Spheres that fly straight and are mirrored at the walls: a closed form, so any frame can be drawn at once.
fn bouncing(count: usize, t: f64) -> stages::Scene {
    let mut scene = stages::gas(count);
    scene.pace.mode = Mode::Run;
    if count <= 30 {
        // Pale colours of their own, as the paper's spheres have: 24 bits show them, 16 colours take turns instead.
        let pale = |i: usize| Some([0.6 + 0.02 * (i % 7) as f64, 0.7, 0.8 - 0.03 * (i % 5) as f64]);
        stages::edit(&mut scene, |stage| {
            stage.radii = vec![0.5; count];
            stage.colors = (0..count).map(pale).collect();
        });
    }
    let snapshot = &mut scene.snapshot;
    let (min, max) = (dvec3(-4.5, 0.5, -2.0), dvec3(4.5, 9.5, 2.0));
    for (x, v) in snapshot.x.iter_mut().zip(&snapshot.v) {
        *x = mirrored(*x + (*v - dvec3(0.0, 1.0, 0.0)) * 2.0 * t, min, max);
    }
    snapshot.t = t;
    scene
}

/// A point folded back into a box as often as needed.
fn mirrored(x: DVec3, min: DVec3, max: DVec3) -> DVec3 {
    let fold = |x: f64, min: f64, max: f64| {
        let size = max - min;
        let along = (x - min).rem_euclid(2.0 * size);
        min + if along > size { 2.0 * size - along } else { along }
    };
    dvec3(fold(x.x, min.x, max.x), fold(x.y, min.y, max.y), fold(x.z, min.z, max.z))
}

fn draw(scene: &stages::Scene, width: u16, height: u16) -> Buffer {
    let area = Rect::new(0, 0, width, height);
    let mut buffer = Buffer::empty(area);
    view::draw(&scene.screen(), area, &mut buffer);
    buffer
}

/// Median time of `view::draw` at 200×60, ms.
fn draw_ms(count: usize) -> f64 {
    let scene = bouncing(count, 1.0);
    let area = Rect::new(0, 0, 200, 60);
    let mut buffer = Buffer::empty(area);
    median_ms(|| view::draw(black_box(&scene.screen()), area, black_box(&mut buffer)))
}

/// Median time of as many circles as ratatui's canvas draws them: 360 points by sine and cosine each, ms.
fn naive_circles_ms(count: usize) -> f64 {
    let scene = bouncing(count, 1.0);
    let mut dots = vec![0_u8; 200 * 60];
    median_ms(|| {
        for (x, r) in scene.snapshot.x.iter().zip(&scene.snapshot.stage.radii) {
            for degrees in 0..360 {
                let angle = f64::from(degrees).to_radians();
                let (px, py) = (82.0 + 20.0 * (x.x + r * angle.cos()), 110.0 - 20.0 * (x.y - 5.0 + r * angle.sin()));
                if px >= 0.0 && py >= 0.0 && px < 400.0 && py < 240.0 {
                    dots[py as usize / 4 * 200 + px as usize / 2] |= 1 << (py as usize % 4 * 2 + px as usize % 2);
                }
            }
        }
        black_box(&mut dots);
    })
}

/// Median processor time of a run, ms.
fn median_ms(mut run: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..41)
        .map(|_| {
            let start = measure::thread_cpu();
            run();
            (measure::thread_cpu() - start) * 1e3
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Bytes of the first frame, and of those that follow it.
struct Bytes {
    first: usize,
    median: usize,
    p95: usize,
    naive: usize,
}

impl Bytes {
    fn of(marker: Marker, colors: Colors) -> Bytes {
        let frame = |i: usize| {
            let mut scene = bouncing(30, i as f64 / 30.0);
            (scene.view_settings.marker, scene.view_settings.colors) = (marker, colors);
            draw(&scene, 80, 24)
        };
        let mut encoder = Encoder::new();
        let first = encoder.encode(&frame(0), None).len();
        let mut sizes: Vec<usize> = (1..FRAMES).map(|i| encoder.encode(&frame(i), None).len()).collect();
        let mut naive: Vec<usize> = (1..FRAMES).map(|i| naive_bytes(&frame(i - 1), &frame(i)).len()).collect();
        sizes.sort_unstable();
        naive.sort_unstable();
        Bytes {
            first,
            median: sizes[sizes.len() / 2],
            p95: sizes[sizes.len() * 95 / 100],
            naive: naive[naive.len() / 2],
        }
    }
}

/// What ratatui's own backend sends: an absolute move for every run, both colours by number at every change, resets.
fn naive_bytes(old: &Buffer, new: &Buffer) -> String {
    let (mut bytes, mut place) = (String::new(), None);
    let (mut colors, mut modifier) = ((Color::Reset, Color::Reset), Modifier::empty());
    for (x, y, cell) in old.diff(new) {
        if place != Some((x, y)) {
            push(&mut bytes, format_args!("\x1b[{};{}H", y + 1, x + 1));
        }
        place = Some((x + 1, y));
        if modifier != cell.modifier {
            push(&mut bytes, format_args!("\x1b[{}m", if cell.modifier.is_empty() { "22" } else { "1" }));
        }
        if colors != (cell.fg, cell.bg) {
            push(&mut bytes, format_args!("\x1b[{};{}m", number(cell, 38), number(cell, 48)));
        }
        (colors, modifier) = ((cell.fg, cell.bg), cell.modifier);
        bytes += cell.symbol();
    }
    bytes + "\x1b[39m\x1b[49m\x1b[59m\x1b[0m\x1b[?25l"
}

/// A colour as crossterm writes it: 38;5;9 or 39.
fn number(cell: &Cell, base: u8) -> String {
    let color = if base == 38 { cell.fg } else { cell.bg };
    match color {
        Color::Reset => (base + 1).to_string(),
        _ => format!("{base};5;{}", if color == Color::LightBlue { "12" } else { "9" }),
    }
}

fn push(bytes: &mut String, data: std::fmt::Arguments) {
    bytes.write_fmt(data).expect("writing to memory does not fail");
}

fn files() -> String {
    let buffer = draw(&bouncing(30, 1.0), 80, 24);
    format!("text {} bytes, ansi {}, svg {}", text(&buffer).len(), ansi(&buffer).len(), svg(&buffer).len())
}
