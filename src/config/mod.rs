//! The user's configuration: a RON file, read once at the start, whose every value has a default.
//!
//! `place` says which file, `file` how it is written, `values` what each value may be; what comes out is a [`Config`].
//! `carom config` prints `defaults`. Begin with `settings`.
//!
//! | file | owns |
//! |---|---|
//! | `settings` | what can be configured, and the defaults |
//! | `place` | which file is read |
//! | `open` | from a file to a configuration, or a refusal with file, line and field |
//! | `file`, `values` | the shape of the file; the range of each value, as a type |
//! | `keys` | the keys of the file, and which of them clash |
//! | `defaults` | the defaults as a file with comments |

mod defaults;
mod file;
mod keys;
mod open;
mod place;
mod settings;
mod values;

pub use defaults::defaults;
pub use open::{open, parse};
pub use place::{VARIABLE, default_path};
pub use settings::{Config, FIRST};
pub use values::{NoBandwidth, bandwidth};
