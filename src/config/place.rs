//! Which file is read.

use std::{
    env,
    path::{Path, PathBuf},
};

use etcetera::BaseStrategy;

/// The variable that names another file.
pub const VARIABLE: &str = "CAROM_CONFIG";

/// The file in the platform's usual place (under `$XDG_CONFIG_HOME` or `~/.config`); none without a home folder.
pub fn default_path() -> Option<PathBuf> {
    let folders = etcetera::choose_base_strategy().ok()?;
    Some(folders.config_dir().join("carom").join("config.ron"))
}

/// A file to read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Place {
    pub(super) path: PathBuf,
    /// Whether it was asked for, so that it must be there.
    pub(super) named: bool,
}

/// The file named by the option, else by the variable, else the usual one.
pub(super) fn place(option: Option<&Path>) -> Option<Place> {
    let variable = || env::var_os(VARIABLE).filter(|value| !value.is_empty()).map(PathBuf::from);
    let named = option.map(Path::to_path_buf).or_else(variable).map(|path| Place { path, named: true });
    named.or_else(|| default_path().map(|path| Place { path, named: false }))
}
