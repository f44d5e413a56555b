//! A run told in lines, one per event: for dumb terminals and screen readers. Full words, units, no escape codes.

use std::io::{self, Write};

use crate::audit::Watch;
use crate::physics::{Class, Contact, Kind, Progress, Simulation, Stall, Until};
use crate::scene::{Scene, Settings};

/// Units of work between two looks at `keep_on`: some milliseconds. No bit of a result depends on it.
const SLICE: u64 = 20_000;

/// How a run was left.
#[derive(Debug, Clone, PartialEq)]
pub enum Ending {
    /// It reached the scene's duration.
    Done,
    /// It could not go on.
    Stalled(Stall),
    /// `keep_on` said no.
    Stopped,
}

/// Tells a run of `scene` from its start to its duration, flushing `out` with what has happened so far.
///
/// # Errors
/// The writer's.
pub fn tell(scene: &Scene, settings: Settings, out: &mut impl Write, keep_on: impl Fn() -> bool) -> io::Result<Ending> {
    let mut simulation = Simulation::new(scene, settings);
    simulation.record_events(true);
    introduce(scene, settings, out)?;
    let mut impacts = 0;
    let mut watch = Watch::new(&simulation);
    let (mut told, slice) = (false, SLICE.min(watch.slice(simulation.model())));
    loop {
        let progress = match simulation.time() < scene.duration {
            true => simulation.advance(Until::Time(scene.duration), slice),
            false => Progress::Reached,
        };
        watch.look(&simulation, progress != Progress::Reached);
        if simulation.time() <= scene.duration && !told && !watch.alarm().is_silent() {
            told = true;
            writeln!(out, "Alarm: {}.", watch.alarm())?;
        }
        for event in simulation.take_events().iter().filter(|event| event.time <= scene.duration) {
            impacts += u64::from(event.class == Class::Collide);
            writeln!(out, "{}", sentence(scene, event))?;
        }
        out.flush()?;
        match progress {
            Progress::Yielded if !keep_on() => return Ok(Ending::Stopped),
            Progress::Yielded => {}
            Progress::Reached => {
                watch.state(simulation.model(), &simulation.at(scene.duration), 0);
                if !told && !watch.alarm().is_silent() {
                    writeln!(out, "Alarm: {}.", watch.alarm())?;
                }
                return conclude(scene, &simulation, impacts, out);
            }
            Progress::Stalled(stall) => return give_up(stall, impacts, out),
        }
    }
}

fn introduce(scene: &Scene, settings: Settings, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "{}", scene.name)?;
    if !scene.about.is_empty() {
        writeln!(out, "{}", scene.about)?;
    }
    let bodies = format!("{}, {}", counted(scene.spheres.len(), "sphere"), counted(scene.walls.len(), "wall"));
    let Settings { method, dt, tolerance } = settings;
    writeln!(
        out,
        "{bodies}. Method {}, longest step {} seconds, tolerance {}. The run lasts {} seconds.",
        method.name(),
        short(dt),
        short(tolerance),
        short(scene.duration)
    )
}

fn conclude(scene: &Scene, simulation: &Simulation, impacts: u64, out: &mut impl Write) -> io::Result<Ending> {
    let energy = simulation.at(scene.duration).energy(simulation.model());
    let (now, first) = (short(energy), short(simulation.initial_energy()));
    let hits = counted(impacts, "impact");
    writeln!(out, "The run ends at {} seconds, after {hits}.", short(scene.duration))?;
    writeln!(out, "Energy is {now} joules; it was {first} joules at the start.")?;
    out.flush()?;
    Ok(Ending::Done)
}

fn give_up(stall: Stall, impacts: u64, out: &mut impl Write) -> io::Result<Ending> {
    writeln!(out, "The run stops at {} seconds, after {}.", short(stall.time), counted(impacts, "impact"))?;
    out.flush()?;
    Ok(Ending::Stalled(stall))
}

/// One event in words.
fn sentence(scene: &Scene, event: &Contact) -> String {
    let (time, a) = (short(event.time), sphere(scene, event.a));
    let b = match event.kind {
        Kind::Wall => format!("wall {}", event.b),
        Kind::Pair => sphere(scene, event.b),
    };
    match event.class {
        Class::Collide => {
            let (speed, impulse) = (short(event.approach_speed), short(event.impulse));
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

fn counted(count: impl TryInto<u64>, noun: &str) -> String {
    match count.try_into().unwrap_or(u64::MAX) {
        1 => format!("1 {noun}"),
        count => format!("{count} {noun}s"),
    }
}

/// A number to be heard: three decimals, or three significant digits where three decimals would say nothing.
fn short(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e9).contains(&size) {
        return format!("{value:.2e}");
    }
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_as_short_as_they_can_be_heard() {
        let heard = [0.0, 20.0, 1.5, 12.345_678, 100.0, 1e-12, 0.001, 1e300].map(short);
        assert_eq!(heard, ["0", "20", "1.5", "12.346", "100", "1.00e-12", "0.001", "1.00e300"]);
    }

    #[test]
    fn one_is_singular() {
        assert_eq!((counted(1_u64, "impact"), counted(0_u64, "wall")), ("1 impact".into(), "0 walls".into()));
    }
}
