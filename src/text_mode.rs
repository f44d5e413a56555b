//! A run told in lines, one per event: for dumb terminals and screen readers. Full words, units, no escape codes.

use std::io::{self, Write};

use crate::audit::Watch;
use crate::format;
use crate::physics::{Class, Contact, Kind, Progress, Simulation, Stall};
use crate::scene::{Scene, Settings};

/// How a run was left.
#[derive(Debug, Clone, PartialEq)]
pub enum Ending {
    /// The run reached the scene's duration.
    Done,
    /// The run could not go on.
    Stalled(Stall),
    /// `keep_on` returned false, at the end of a frame at this time, s.
    Stopped(f64),
}

/// Tells a run of `scene` from its start to its duration, flushing `out` with what has happened so far.
///
/// # Errors
/// The error of the writer.
pub fn tell(scene: &Scene, settings: Settings, out: &mut impl Write, keep_on: impl Fn() -> bool) -> io::Result<Ending> {
    let mut simulation = Simulation::new(scene, settings);
    simulation.record_events(true);
    introduce(scene, settings, out)?;
    let watch = Watch::new(&simulation);
    let slice = Simulation::SLICE.min(watch.slice(simulation.model()));
    let mut teller = Teller { scene, out, watch, told: false, impacts: 0 };
    let (mut failed, mut first) = (None, true);
    let mut next = |run: &mut Simulation| {
        if std::mem::take(&mut first) {
            return Some(slice);
        }
        failed = teller.tell(run, true).err();
        (failed.is_none() && keep_on()).then_some(slice)
    };
    let progress = match simulation.time() < scene.duration {
        true => simulation.run_to(scene.duration, &mut next),
        false => Progress::Reached,
    };
    if let Some(error) = failed {
        return Err(error);
    }
    match progress {
        Progress::Yielded => Ok(Ending::Stopped(simulation.time())),
        Progress::Stalled(stall) => {
            teller.tell(&mut simulation, true)?;
            give_up(stall, teller.impacts, teller.out)
        }
        Progress::Reached => {
            teller.tell(&mut simulation, false)?;
            let end = simulation.at(scene.duration);
            teller.watch.state(simulation.model(), (&end, simulation.hidden_energy_at(&end)), 0);
            teller.warn()?;
            conclude(scene, &simulation, teller.impacts, teller.out)
        }
    }
}

/// What tells a run, and what it has told.
struct Teller<'a, W: Write> {
    scene: &'a Scene,
    out: &'a mut W,
    watch: Watch,
    /// Whether the alarm has been told: it is told once.
    told: bool,
    impacts: u64,
}

impl<W: Write> Teller<'_, W> {
    /// Tells what has happened since the last call; `anyway`: even if the watch finds that little has been done.
    fn tell(&mut self, simulation: &mut Simulation, anyway: bool) -> io::Result<()> {
        self.watch.look(simulation, anyway);
        if simulation.time() <= self.scene.duration {
            self.warn()?;
        }
        for event in simulation.take_events().iter().filter(|event| event.time <= self.scene.duration) {
            self.impacts = self.impacts.saturating_add(event.impact_count());
            writeln!(self.out, "{}", sentence(self.scene, event))?;
        }
        self.out.flush()
    }

    fn warn(&mut self) -> io::Result<()> {
        if self.told || self.watch.alarm().is_silent() {
            return Ok(());
        }
        self.told = true;
        writeln!(self.out, "Alarm: {}.", self.watch.alarm())
    }
}

fn introduce(scene: &Scene, settings: Settings, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "{}", scene.name)?;
    if !scene.about.is_empty() {
        writeln!(out, "{}", scene.about)?;
    }
    let bodies =
        format!("{}, {}", format::counted(scene.spheres.len(), "sphere"), format::counted(scene.walls.len(), "wall"));
    let Settings { method, dt, tolerance } = settings;
    writeln!(
        out,
        "{bodies}. Method {}, longest step {} seconds, tolerance {}. The run lasts {} seconds.",
        method.name(),
        format::spoken(dt),
        format::spoken(tolerance),
        format::spoken(scene.duration)
    )
}

fn conclude(scene: &Scene, simulation: &Simulation, impacts: u64, out: &mut impl Write) -> io::Result<Ending> {
    let energy = simulation.at(scene.duration).energy(simulation.model());
    let (now, first) = (format::spoken(energy), format::spoken(simulation.initial_energy()));
    let hits = format::counted(impacts, "impact");
    writeln!(out, "The run ends at {} seconds, after {hits}.", format::spoken(scene.duration))?;
    writeln!(out, "Energy is {now} joules; it was {first} joules at the start.")?;
    out.flush()?;
    Ok(Ending::Done)
}

fn give_up(stall: Stall, impacts: u64, out: &mut impl Write) -> io::Result<Ending> {
    writeln!(
        out,
        "The run stops at {} seconds, after {}.",
        format::spoken(stall.time),
        format::counted(impacts, "impact")
    )?;
    out.flush()?;
    Ok(Ending::Stalled(stall))
}

/// One event in words.
fn sentence(scene: &Scene, event: &Contact) -> String {
    let (time, a) = (format::spoken(event.time), sphere(scene, event.a));
    let b = match event.kind {
        Kind::Wall => format!("wall {}", event.b),
        Kind::Pair => sphere(scene, event.b),
    };
    match event.class {
        Class::Collide if event.impacts > 1 => {
            let (count, impulse) = (format::counted(event.impacts, "time"), format::spoken(event.impulse));
            format!("At {time} seconds {a} hits {b} {count} in a row, impulse {impulse} newton seconds in all.")
        }
        Class::Collide => {
            let (speed, impulse) = (format::spoken(event.approach_speed), format::spoken(event.impulse));
            format!("At {time} seconds {a} hits {b} at {speed} metres per second, impulse {impulse} newton seconds.")
        }
        Class::Rest => format!("At {time} seconds {a} comes to rest on {b}."),
        Class::Release | Class::Leave => format!("At {time} seconds {a} leaves {b}."),
    }
}

fn sphere(scene: &Scene, index: usize) -> String {
    let name = scene.spheres.get(index).and_then(|sphere| sphere.name.as_deref());
    name.map_or_else(|| format!("sphere {index}"), |name| format!("sphere {index} ({name})"))
}
