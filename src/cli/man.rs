//! `carom man`: one manual page for the program and all its commands.

use std::io::{self, Write};

use clap::CommandFactory;
use clap_mangen::Man;

use super::arguments::{AFTER, Arguments};
use super::failure::Failure;
use super::output::Output;

pub(super) fn man() -> Result<(), Failure> {
    let mut out = Output::stdout();
    page(&mut out)?;
    out.finish()
}

fn page(out: &mut impl Write) -> io::Result<()> {
    // Without the place of the configuration on the machine that prints the page.
    let mut command = Arguments::command().disable_help_subcommand(true).after_help(AFTER);
    command.build();
    let top = Man::new(command.clone());
    top.render_title(out)?;
    top.render_name_section(out)?;
    top.render_synopsis_section(out)?;
    top.render_description_section(out)?;
    top.render_options_section(out)?;
    for sub in command.get_subcommands() {
        section(sub.clone(), out)?;
    }
    let mut ending = Vec::new();
    top.render_extra_section(&mut ending)?;
    out.write_all(renamed(&ending, "EXTRA", "RESULTS AND EXIT STATUS").as_bytes())?;
    top.render_version_section(out)
}

/// clap_mangen writes a page for each command; here its synopsis becomes a section, the rest follows under it.
fn section(command: clap::Command, out: &mut impl Write) -> io::Result<()> {
    let heading = format!("\"carom {}\"", command.get_name()).to_uppercase();
    let options = command.get_arguments().next().is_some();
    let man = Man::new(command);
    let mut text = Vec::new();
    man.render_synopsis_section(&mut text)?;
    out.write_all(renamed(&text, "SYNOPSIS", &heading).as_bytes())?;
    text.clear();
    man.render_description_section(&mut text)?;
    out.write_all(renamed(&text, "DESCRIPTION", "").replace(".SH \n", ".PP\n").as_bytes())?;
    text.clear();
    if options {
        man.render_options_section(&mut text)?;
        out.write_all(renamed(&text, "OPTIONS", "").replace(".SH \n", "").as_bytes())?;
    }
    Ok(())
}

fn renamed(section: &[u8], from: &str, to: &str) -> String {
    let quoted = if to.contains(' ') && !to.starts_with('"') { format!("\"{to}\"") } else { to.to_string() };
    String::from_utf8_lossy(section).replacen(&format!(".SH {from}\n"), &format!(".SH {quoted}\n"), 1)
}
