//! `carom methods [M]`: what each method is, its order, and when not to use it.

use std::io::{self, Write};

use super::arguments::Methods;
use super::failure::Failure;
use super::output::Output;
use crate::physics::{Description, describe, deviations};
use crate::scene::Method;

pub(super) fn methods(arguments: &Methods) -> Result<(), Failure> {
    let mut out = Output::stdout();
    match arguments.method {
        Some(method) => whole(describe(method), &mut out)?,
        None => all(&mut out)?,
    }
    out.finish()
}

fn all(out: &mut impl Write) -> io::Result<()> {
    for (index, method) in Method::ALL.iter().enumerate() {
        if index > 0 {
            writeln!(out)?;
        }
        whole(describe(*method), out)?;
    }
    Ok(())
}

fn whole(method: &Description, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "{}: {}", method.method.name(), method.summary)?;
    let lines =
        [("order", method.order), ("knobs", method.knobs), ("not for", method.avoid), ("source", method.source)];
    lines.iter().try_for_each(|(word, text)| writeln!(out, "  {word:8} {text}"))?;
    deviations(method.method).iter().try_for_each(|text| writeln!(out, "  {:8} {text}", "differs"))
}
