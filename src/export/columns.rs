//! What a file of states calls its columns.

use std::fmt;

use super::rows::StateRow;
use super::table::Row;

/// How many columns there are: time, sphere, three of place, three of velocity.
pub(super) const COLUMNS: usize = 8;

/// What a file calls the columns `time,sphere,x,y,z,vx,vy,vz`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Columns {
    /// Names that the file has for our columns, in our order.
    pub(super) names: [String; COLUMNS],
}

impl Default for Columns {
    fn default() -> Columns {
        Columns { names: std::array::from_fn(|k| StateRow::COLUMNS[k].into()) }
    }
}

/// Why a mapping of columns is refused.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ColumnsError {
    /// A part is not two names with `=` between them.
    NoPair,
    /// The name behind `=` is none of ours.
    Unknown(String),
    /// One of our names stands behind `=` twice.
    Twice(String),
}

impl fmt::Display for ColumnsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ColumnsError::NoPair => f.write_str("must be THEIRS=OURS, such as t=time,px=x"),
            ColumnsError::Unknown(ours) => write!(f, "{ours:?} is none of {}", StateRow::COLUMNS.join(",")),
            ColumnsError::Twice(ours) => write!(f, "{ours:?} is named twice"),
        }
    }
}

impl std::error::Error for ColumnsError {}

impl Columns {
    /// Reads `t=time,px=x`: the file's column `t` holds our `time`, and so on; what is not named is called as ours. Where a
    /// row has all spheres, `p#=x` says that `p0`, `p1`, … are their x.
    ///
    /// # Errors
    /// A part without `=`, a name that is none of ours, one of ours named twice.
    pub fn parse(text: &str) -> Result<Columns, ColumnsError> {
        let (mut columns, mut named) = (Columns::default(), [false; COLUMNS]);
        for part in text.split(',') {
            let pair = part.split_once('=').map(|(theirs, ours)| (theirs.trim(), ours.trim()));
            let (theirs, ours) = pair.filter(|pair| !pair.0.is_empty()).ok_or(ColumnsError::NoPair)?;
            let k = StateRow::COLUMNS.iter().position(|name| *name == ours);
            let k = k.ok_or_else(|| ColumnsError::Unknown(ours.into()))?;
            if std::mem::replace(&mut named[k], true) {
                return Err(ColumnsError::Twice(ours.into()));
            }
            columns.names[k] = theirs.into();
        }
        Ok(columns)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mapping_names_each_of_our_columns_once() {
        let unknown = ColumnsError::Unknown("when".into());
        for (text, error) in [
            ("t", ColumnsError::NoPair),
            ("=time", ColumnsError::NoPair),
            ("t=when", unknown),
            ("a=x,b=x", ColumnsError::Twice("x".into())),
        ] {
            assert_eq!(Columns::parse(text), Err(error), "{text}");
        }
    }
}
