//! The small language of `:until`: what a run goes on until.

use crate::{
    snapshot::Class,
    worker::{Bodies, Stop},
};

/// All that may follow `:until`, for the errors.
const ALLOWED: &str = "collision, rest or release (alone, or of: selected; 3; 3 5; 3 wall 0), exit, t=3, speed>2, \
                       degree>1e-4, energy>1e-3";

/// The words with which an order begins, as they are offered.
pub(super) const WORDS: [&str; 8] = ["collision", "rest", "release", "exit", "t=", "speed>", "degree>", "energy>"];

/// The bodies that can be named.
#[derive(Debug, Clone, Copy)]
pub(super) struct Named {
    pub(super) spheres: usize,
    pub(super) walls: usize,
    /// The selected sphere.
    pub(super) selected: Option<usize>,
}

/// Reads what comes after `until`.
///
/// # Errors
/// A sentence that names what is wrong, and what is allowed.
pub(super) fn read(text: &str, named: Named) -> Result<Stop, String> {
    if let Some((name, sign, value)) = comparison(text) {
        return measured(name, sign, value);
    }
    let words: Vec<&str> = text.split_whitespace().collect();
    let Some((what, of)) = words.split_first() else {
        return Err(format!(":until needs what to wait for: {ALLOWED}."));
    };
    let class = match *what {
        "collision" => Class::Collide,
        "rest" => Class::Rest,
        "release" => Class::Release,
        "exit" if of.is_empty() => return Ok(Stop::Exit),
        "exit" => return Err("exit takes nothing: the first sphere that leaves the walls' box ends it.".into()),
        other => return Err(format!("{other} is not allowed: :until takes {ALLOWED}.")),
    };
    Ok(Stop::Event(class, bodies(of, named)?))
}

/// The parts of `name sign value`.
fn comparison(text: &str) -> Option<(&str, char, &str)> {
    let at = text.find(['=', '>', '<'])?;
    let sign = text[at..].chars().next()?;
    Some((text[..at].trim(), sign, text[at + 1..].trim()))
}

fn measured(name: &str, sign: char, value: &str) -> Result<Stop, String> {
    let (stop, needs, unit): (fn(f64) -> Stop, char, &str) = match name {
        "t" => (Stop::Time, '=', "seconds, 0 or more"),
        "speed" => (Stop::Speed, '>', "m/s, 0 or more"),
        "degree" => (Stop::Degree, '>', "an overlap as a part of the radius, 0 or more"),
        "energy" => (Stop::Energy, '>', "a part of the initial energy, 0 or more"),
        other => return Err(format!("{other} is not allowed before {sign}: :until takes {ALLOWED}.")),
    };
    if sign != needs {
        return Err(format!("{name}{sign} is not allowed: :until takes {name}{needs}."));
    }
    match value.parse::<f64>() {
        Ok(number) if number.is_finite() && number >= 0.0 => Ok(stop(number)),
        _ => Err(format!("{value} is not allowed: {name}{needs} takes {unit}.")),
    }
}

fn bodies(words: &[&str], named: Named) -> Result<Bodies, String> {
    let sphere = |word: &str| match word {
        "selected" => named.selected.ok_or_else(|| "No sphere is selected; Tab selects one.".to_owned()),
        word => number(word, "sphere", named.spheres),
    };
    match words {
        [] => Ok(Bodies::Any),
        [a] => Ok(Bodies::Sphere(sphere(a)?)),
        [a, "wall", b] => Ok(Bodies::Wall(sphere(a)?, number(b, "wall", named.walls)?)),
        [a, b] => match (sphere(a)?, sphere(b)?) {
            (a, b) if a == b => Err(format!("{a} {b} is no pair: it takes two spheres.")),
            (a, b) => Ok(Bodies::Pair(a, b)),
        },
        more => Err(format!("{} is not allowed: bodies are selected; 3; 3 5; 3 wall 0.", more.join(" "))),
    }
}

/// The number of a body, of which there are so many.
fn number(word: &str, what: &str, count: usize) -> Result<usize, String> {
    match (word.parse::<usize>(), count) {
        (Ok(index), count) if index < count => Ok(index),
        (_, 0) => Err(format!("{word} is not allowed: the scene has no {what}s.")),
        (_, 1) => Err(format!("{word} is not allowed: the scene has {what} 0 only.")),
        (_, count) => Err(format!("{word} is not allowed: the scene has {what}s 0 to {}.", count - 1)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMED: Named = Named { spheres: 6, walls: 2, selected: Some(4) };

    #[test]
    fn every_form_is_read() {
        let collides = |bodies| Ok(Stop::Event(Class::Collide, bodies));
        assert_eq!(read(" collision ", NAMED), collides(Bodies::Any));
        assert_eq!(read("collision 3", NAMED), collides(Bodies::Sphere(3)));
        assert_eq!(read("collision selected", NAMED), collides(Bodies::Sphere(4)));
        assert_eq!(read("collision selected 5", NAMED), collides(Bodies::Pair(4, 5)));
        assert_eq!(read("collision 3 wall 1", NAMED), collides(Bodies::Wall(3, 1)));
        assert_eq!(read("rest", NAMED), Ok(Stop::Event(Class::Rest, Bodies::Any)));
        assert_eq!(read("release 0", NAMED), Ok(Stop::Event(Class::Release, Bodies::Sphere(0))));
        assert_eq!(read("exit", NAMED), Ok(Stop::Exit));
        assert_eq!(read("t=3", NAMED), Ok(Stop::Time(3.0)));
        assert_eq!(read("speed > 2", NAMED), Ok(Stop::Speed(2.0)));
        assert_eq!(read("degree>1e-4", NAMED), Ok(Stop::Degree(1e-4)));
        assert_eq!(read("energy >1e-3", NAMED), Ok(Stop::Energy(1e-3)));
    }

    #[test]
    fn an_error_names_what_is_wrong_and_what_is_allowed() {
        for (text, said) in [
            ("", ":until needs what to wait for: collision, rest or release"),
            ("bounce", "bounce is not allowed: :until takes collision, rest or release"),
            ("collision 6", "6 is not allowed: the scene has spheres 0 to 5."),
            ("collision 1 wall 2", "2 is not allowed: the scene has walls 0 to 1."),
            ("collision 1 1", "1 1 is no pair"),
            ("collision 1 2 3", "1 2 3 is not allowed: bodies are selected; 3; 3 5; 3 wall 0."),
            ("exit 3", "exit takes nothing"),
            ("speed=2", "speed= is not allowed: :until takes speed>."),
            ("t>2", "t> is not allowed: :until takes t=."),
            ("speed>fast", "fast is not allowed: speed> takes m/s, 0 or more."),
            ("speed>-1", "-1 is not allowed"),
            ("mass>1", "mass is not allowed before >: :until takes collision"),
        ] {
            let error = read(text, NAMED).expect_err(text);
            assert!(error.starts_with(said), "{text}: {error}");
        }
        let none = Named { selected: None, walls: 0, ..NAMED };
        assert_eq!(read("rest selected", none), Err("No sphere is selected; Tab selects one.".into()));
        assert_eq!(read("rest 0 wall 0", none), Err("0 is not allowed: the scene has no walls.".into()));
    }
}
