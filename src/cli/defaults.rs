//! `carom config`: the default configuration, a file to start one's own from.

use std::io::Write;

use super::failure::Failure;
use super::output::Output;
use crate::config;

pub(super) fn defaults() -> Result<(), Failure> {
    let mut out = Output::stdout();
    out.write_all(config::defaults().as_bytes())?;
    out.finish()
}
