//! The RON shape of a configuration as written. What is left out has its default.

use serde::Deserialize;

use super::{
    keys::KeysFile,
    values::{Bandwidth, ColorDepth, Dots, InkName, InkNames, Rate, Word},
};
use crate::view::Inks;

/// A configuration.
#[derive(Debug, Deserialize)]
#[serde(rename = "Config", deny_unknown_fields)]
pub(super) struct ConfigFile {
    pub(super) scene: Option<Word>,
    pub(super) marker: Option<Dots>,
    pub(super) color: Option<ColorDepth>,
    pub(super) frame_rate: Option<Rate>,
    pub(super) bandwidth: Option<Bandwidth>,
    #[serde(default)]
    pub(super) colors: ColorsFile,
    #[serde(default)]
    pub(super) keys: KeysFile,
}

/// Colours by role.
#[derive(Debug, Default, Deserialize)]
#[serde(rename = "Colors", deny_unknown_fields)]
pub(super) struct ColorsFile {
    heading: Option<InkName>,
    good: Option<InkName>,
    notice: Option<InkName>,
    alarm: Option<InkName>,
    velocity: Option<InkName>,
    ghost: Option<InkName>,
    normal: Option<InkName>,
    spheres: Option<InkNames>,
}

impl ColorsFile {
    pub(super) fn inks(&self) -> Inks {
        let ink = |name: Option<InkName>| name.and_then(|name| name.0);
        Inks {
            heading: ink(self.heading),
            good: ink(self.good),
            notice: ink(self.notice),
            alarm: ink(self.alarm),
            velocity: ink(self.velocity),
            ghost: ink(self.ghost),
            normal: ink(self.normal),
            spheres: self.spheres.map_or_else(Default::default, |names| names.0),
        }
    }
}
