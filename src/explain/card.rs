//! One contact taken apart.

use glam::DVec3;

use super::approach;
use super::line::Line;
use super::support;
use crate::format::{digits, number, setting, significant};
use crate::snapshot::{Class, Contact, Kind, Snapshot};

/// Digits after the first of what is measured.
const DIGITS: usize = 4;

/// A formula's result may differ from what the method did by this part, which is rounding.
const ROUNDING: f64 = 1e-9;

/// One contact taken apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Card {
    /// The two bodies, e.g. `#0 left – wall 2`.
    pub bodies: String,
    /// What the impact law made of the contact.
    pub class: Class,
    /// What there is to say, the most asked for first.
    pub lines: Vec<Line>,
}

/// The card of a snapshot's contact of this index, if it has one. `between` stands between the bodies.
pub fn card(snapshot: &Snapshot, index: usize, between: &str) -> Option<Card> {
    let contact = snapshot.contacts.get(index)?;
    let of = Of { snapshot, contact, index };
    let lines = [of.why(), of.place(), of.speeds(), of.impulse(), of.energy(), of.depth(), of.acts(), of.approach()];
    Some(Card { bodies: of.bodies(between), class: contact.class, lines: lines.into_iter().flatten().collect() })
}

/// What acts over a snapshot's frame from the one before, a line each. `between` stands between the bodies.
pub fn acting(snapshot: &Snapshot, between: &str) -> Vec<Line> {
    let line = |contact: &Contact| {
        let bodies = Of { snapshot, contact, index: 0 }.bodies(between);
        let (impulse, step) = (contact.impulse, snapshot.step);
        let force = if step > 0.0 { format!(", that is {} N", measured(impulse / step)) } else { String::new() };
        let (impulse, step) = (measured(impulse), significant(step, DIGITS));
        Line::new("acts", format!("{bodies} of the frame before: {impulse} N s over this frame of {step} s{force}"))
    };
    snapshot.acting.iter().map(line).collect()
}

/// A contact and the snapshot it is of.
struct Of<'a> {
    snapshot: &'a Snapshot,
    contact: &'a Contact,
    index: usize,
}

impl Of<'_> {
    fn bodies(&self, between: &str) -> String {
        let Contact { kind, a, b, .. } = *self.contact;
        match kind {
            Kind::Wall => format!("{}{between}wall {b}", self.sphere(a)),
            Kind::Pair => format!("{}{between}{}", self.sphere(a), self.sphere(b)),
        }
    }

    fn sphere(&self, i: usize) -> String {
        match self.snapshot.stage.names.get(i) {
            Some(Some(name)) => format!("#{i} {name}"),
            _ => format!("#{i}"),
        }
    }

    fn mass(&self, i: usize) -> f64 {
        self.snapshot.stage.masses.get(i).copied().unwrap_or(f64::NAN)
    }

    /// Effective mass, kg: an impulse along the normal over the change of v_n, m or m₁ m₂ / (m₁ + m₂).
    fn effective_mass(&self) -> f64 {
        support::effective_mass(self.snapshot, self.contact)
    }

    fn restitution(&self) -> f64 {
        let law = &self.snapshot.stage.law;
        if self.contact.kind == Kind::Wall { law.wall_restitution } else { law.restitution }
    }

    /// Share of the tangential velocity that the response leaves.
    fn tangential(&self) -> f64 {
        let rubs = self.contact.class == Class::Collide && self.contact.kind == Kind::Wall;
        if rubs { self.snapshot.stage.law.tangential } else { 1.0 }
    }

    /// The relative velocity across the normal before the response, m/s.
    fn slip(&self) -> f64 {
        let Contact { velocity, normal, .. } = *self.contact;
        (velocity - normal * velocity.dot(normal)).length()
    }

    /// Which rule gave the class.
    fn why(&self) -> Vec<Line> {
        let (v_n, slow) = (-self.contact.approach_speed, self.snapshot.stage.law.rest_speed);
        let (speed, limit) = (measured(v_n), number(0.0 - slow)); // without the sign of −0
        let reason = self.snapshot.rest_reasons.get(self.index).copied().flatten();
        let text = match (self.contact.class, reason) {
            (Class::Collide, _) if self.contact.impacts > 1 => {
                format!("{} impacts that repeat themselves, summed up", self.contact.impacts)
            }
            (Class::Collide, _) => format!("v_n = {speed} m/s < −rest_speed = {limit} m/s"),
            (Class::Rest, Some(reason)) => format!("it rests: {}", reason.words()),
            (Class::Rest, None) if v_n.abs() <= slow => {
                let (speed, slow) = (measured(v_n.abs()), number(slow));
                format!("|v_n| = {speed} m/s ≤ rest_speed = {slow} m/s, and it is pressed or approaches: it rests")
            }
            (Class::Rest, None) => "it rested for a moment that is over: why is kept no longer".into(),
            (Class::Leave, _) => format!("v_n = {speed} m/s: it leaves, nothing is done"),
            (Class::Release, _) => format!("v_n = {speed} m/s, and nothing presses it: its rest ends"),
        };
        vec![Line::new("why", text)]
    }

    fn place(&self) -> Vec<Line> {
        let Contact { time, point, normal, .. } = *self.contact;
        vec![
            Line::new("time", format!("{} s", number(time))),
            Line::new("point", format!("{} m", vector(point))),
            Line::new("normal", vector(normal)),
        ]
    }

    fn speeds(&self) -> Vec<Line> {
        let Contact { class, approach_speed, separation_speed, .. } = *self.contact;
        let slip = self.slip();
        let change = |before: f64, after: f64| format!("{} → {} m/s", measured(before), measured(after));
        let across = match class == Class::Collide && self.formula().is_none() {
            true => format!("{} m/s before", measured(slip)),
            false => change(slip, slip * self.tangential()),
        };
        vec![Line::new("v_n", change(-approach_speed, separation_speed)), Line::new("v_t", across)]
    }

    /// The impulse: of an impact the formula with its numbers, of a rest what stops it and the force that it stands for.
    fn impulse(&self) -> Vec<Line> {
        let result = format!("{} N s", measured(self.contact.impulse));
        match self.contact.class {
            Class::Collide => {
                let formula =
                    self.formula().unwrap_or_else(|| "solved for the whole frame, forces and contacts together".into());
                vec![Line::new("J", format!("{formula} = {result}"))]
            }
            Class::Rest => self.support(&result),
            Class::Leave | Class::Release => Vec::new(),
        }
    }

    /// What holds a contact at rest, or stops it there: `result` is its impulse.
    fn support(&self, result: &str) -> Vec<Line> {
        let Contact { approach_speed, impulse, .. } = *self.contact;
        let Snapshot { step, slack, method, .. } = *self.snapshot;
        // A frame's method has stopped it and held it in one; one that follows events does either.
        let stop = if slack.is_some() { self.effective_mass() * approach_speed } else { 0.0 };
        if slack.is_none() && approach_speed != 0.0 {
            let does = if method == "moreau" { "stop it and hold it for the frame" } else { "stop it" };
            return vec![Line::new("J", format!("{result}, which {does}"))];
        }
        let held = impulse - stop;
        let mut lines = Vec::new();
        if stop != 0.0 {
            lines.push(Line::new("J", format!("{} N s, which stop it", measured(stop))));
        }
        lines.push(Line::new(
            "support",
            match held > ROUNDING * impulse.abs() && step > 0.0 {
                true => {
                    let (force, held) = (measured(held / step), measured(held));
                    format!("{force} N, that is {held} N s in this frame of {} s", number(step))
                }
                false => "none: it touches and carries nothing".into(),
            },
        ));
        lines
    }

    /// J as the law has it, with its numbers; none where the method's J is another, solved with other contacts.
    fn formula(&self) -> Option<String> {
        let Contact { kind, a, b, approach_speed, separation_speed, impulse, .. } = *self.contact;
        let (e, mass) = (self.restitution(), self.effective_mass());
        let is = |one: f64, other: f64| (one - other).abs() <= ROUNDING * one.abs().max(other.abs());
        let masses = match kind {
            Kind::Wall => format!("{} kg", number(mass)),
            Kind::Pair => format!("1/(1/{} + 1/{}) kg", number(self.mass(a)), number(self.mass(b))),
        };
        let (before, after) = (measured(approach_speed), measured(separation_speed));
        if is(impulse, (1.0 + e) * mass * approach_speed) {
            Some(format!("(1 + {}) × {masses} × {before} m/s", number(e)))
        } else if is(impulse, mass * (approach_speed + separation_speed)) {
            Some(format!("{masses} × ({before} + {after}) m/s"))
        } else {
            None
        }
    }

    /// What the contact takes from the kinetic energy, where no other has a part in it.
    fn energy(&self) -> Vec<Line> {
        let Contact { class, approach_speed, separation_speed, .. } = *self.contact;
        if class != Class::Collide || self.formula().is_none() {
            return Vec::new();
        }
        let (slip, left) = (self.slip(), self.tangential());
        let normal =
            0.5 * self.effective_mass() * (approach_speed * approach_speed - separation_speed * separation_speed);
        let across = 0.5 * self.mass(self.contact.a) * slip * slip * (1.0 - left * left);
        let rubbed = if across > 0.0 { format!(", {} J along the wall", measured(across)) } else { String::new() };
        vec![Line::new("lost", format!("{} J along the normal{rubbed}", measured(normal)))]
    }

    /// How deep, and why that was accepted.
    fn depth(&self) -> Vec<Line> {
        let degree = self.contact.degree;
        let (Some(slack), tolerance) = (self.snapshot.slack, self.snapshot.tolerance.min(0.5)) else {
            return vec![Line::new("overlap", format!("{} of the radius", digits(degree, 2)))];
        };
        let limit = format!("tolerance + slack = {} + {}", setting(tolerance), setting(slack));
        let text = if degree <= tolerance + slack {
            format!("{} of the radius ≤ {limit}: accepted", digits(degree, 2))
        } else {
            format!(
                "{} of the radius > {limit}: it began the frame as deep, or no time is left to halve",
                digits(degree, 2)
            )
        };
        vec![Line::new("overlap", text)]
    }

    /// The polynomial whose root is the contact's time, where the method solves one.
    fn approach(&self) -> Vec<Line> {
        let approach = self.snapshot.approaches.get(self.index).copied().flatten();
        approach
            .filter(|_| self.snapshot.method == "exact")
            .map(|approach| approach::lines(&approach))
            .unwrap_or_default()
    }

    /// When the response acts, if not at once.
    fn acts(&self) -> Vec<Line> {
        let answered = matches!(self.contact.class, Class::Collide | Class::Rest);
        if self.snapshot.slack.is_none() || !answered {
            return Vec::new();
        }
        vec![Line::new("acts", "over the next frame: the velocities shown are still those before it")]
    }
}

fn measured(value: f64) -> String {
    significant(if value == 0.0 { 0.0 } else { value }, DIGITS)
}

fn vector(v: DVec3) -> String {
    let [x, y, z] = [v.x, v.y, v.z].map(|value| significant(if value == 0.0 { 0.0 } else { value }, DIGITS));
    format!("({x}, {y}, {z})")
}
