//! Tables: rows of one kind, written as they come.

use std::io::{self, Write};

use serde::Serialize;

/// How rows are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// A line of column names, then a line a row.
    Csv,
    /// A JSON object a line.
    JsonLines,
}

impl Format {
    /// JSON lines for names that end in `.jsonl`, else CSV.
    pub fn of(name: &str) -> Format {
        if name.ends_with(".jsonl") { Format::JsonLines } else { Format::Csv }
    }
}

/// What a table holds: the names of the fields of its rows, in their order.
pub trait Row: Serialize {
    /// The first line of a CSV file.
    const COLUMNS: &'static [&'static str];
}

/// A table under way: rows go out as they come, none is kept.
#[derive(Debug)]
pub struct Table<W: Write> {
    writer: Writer<W>,
}

#[derive(Debug)]
enum Writer<W: Write> {
    Csv(Box<csv::Writer<W>>),
    JsonLines(W),
}

impl<W: Write> Table<W> {
    /// A table of rows `R`; a CSV table has its column names even if no row follows.
    ///
    /// # Errors
    /// The writer's.
    pub fn new<R: Row>(format: Format, writer: W) -> io::Result<Table<W>> {
        let writer = match format {
            Format::JsonLines => Writer::JsonLines(writer),
            Format::Csv => {
                let mut csv = csv::WriterBuilder::new().has_headers(false).from_writer(writer);
                csv.write_record(R::COLUMNS).map_err(cause)?;
                Writer::Csv(Box::new(csv))
            }
        };
        Ok(Table { writer })
    }

    /// Writes one row.
    ///
    /// # Errors
    /// The writer's.
    pub fn write<R: Row>(&mut self, row: &R) -> io::Result<()> {
        match &mut self.writer {
            Writer::Csv(csv) => csv.serialize(row).map_err(cause),
            Writer::JsonLines(writer) => {
                serde_json::to_writer(&mut *writer, row)?;
                writer.write_all(b"\n")
            }
        }
    }

    /// Hands the writer back, with every row written to it.
    ///
    /// # Errors
    /// The writer's.
    pub fn finish(self) -> io::Result<W> {
        match self.writer {
            Writer::Csv(csv) => csv.into_inner().map_err(csv::IntoInnerError::into_error),
            Writer::JsonLines(writer) => Ok(writer),
        }
    }
}

/// The error of the writer itself, with its kind: a closed pipe must be told from a full disk.
fn cause(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::rows::{EventRow, StateRow};
    use super::*;
    use crate::physics::{Class, Contact, Kind};

    const HARD: [f64; 8] = [1e300, 5e-324, -0.0, 3.0, 0.1, f64::MAX, f64::MIN_POSITIVE, 0.30000000000000004];

    fn row(value: f64) -> StateRow {
        StateRow { time: value, sphere: 7, x: value, y: -value, z: 0.0, vx: 0.0, vy: 0.0, vz: 0.0 }
    }

    fn event() -> EventRow {
        EventRow::from(&Contact {
            time: 0.5,
            kind: Kind::Pair,
            a: 1,
            b: 2,
            point: DVec3::new(1.0, 2.0, 3.0),
            normal: DVec3::Y,
            velocity: DVec3::NEG_Y * 4.0,
            approach_speed: 4.0,
            separation_speed: 3.2,
            impulse: 3.6,
            degree: -1e-17,
            class: Class::Collide,
            impacts: 1,
        })
    }

    fn written<R: Row>(format: Format, rows: &[R]) -> String {
        let mut table = Table::new::<R>(format, Vec::new()).expect("memory takes every byte");
        rows.iter().for_each(|row| table.write(row).expect("memory takes every byte"));
        String::from_utf8(table.finish().expect("memory takes every byte")).expect("text")
    }

    fn bits_read_back(format: Format, time: impl Fn(&str) -> f64) {
        let text = written(format, &HARD.map(row));
        let lines = text.lines().skip(usize::from(format == Format::Csv));
        let back: Vec<u64> = lines.map(|line| time(line).to_bits()).collect();
        assert_eq!(back, HARD.map(f64::to_bits), "{text}");
    }

    #[test]
    fn every_number_reads_back_to_the_same_bits() {
        bits_read_back(Format::Csv, |line| line.split(',').next().and_then(|t| t.parse().ok()).expect("a number"));
        bits_read_back(Format::JsonLines, |line| {
            line.split([':', ',']).nth(1).and_then(|t| t.parse().ok()).expect("a number")
        });
    }

    #[test]
    fn no_number_has_more_digits_than_it_needs() {
        let text = written(Format::Csv, &HARD.map(row));
        let times: Vec<_> = text.lines().skip(1).filter_map(|line| line.split(',').next()).collect();
        let shortest = ["1e300", "5e-324", "-0.0", "3.0", "0.1", "1.7976931348623157e308", "2.2250738585072014e-308"];
        assert_eq!(times[..7], shortest);
    }

    #[test]
    fn an_empty_table_has_its_columns() {
        assert_eq!(written::<StateRow>(Format::Csv, &[]), "time,sphere,x,y,z,vx,vy,vz\n");
        assert_eq!(
            written::<EventRow>(Format::Csv, &[]),
            "time,kind,a,b,px,py,pz,nx,ny,nz,approach_speed,impulse,degree,class\n"
        );
        assert_eq!(written::<EventRow>(Format::JsonLines, &[]), "");
    }

    #[test]
    fn the_columns_are_the_fields_in_their_order() {
        fn names<R: Row>(row: R) -> Vec<String> {
            let text = written(Format::JsonLines, &[row]);
            let fields = text.trim_matches(['{', '}', '\n']).split(',');
            fields.map(|field| field.split(':').next().unwrap_or("").trim_matches('"').into()).collect()
        }
        assert_eq!(names(row(1.0)), StateRow::COLUMNS);
        assert_eq!(names(event()), EventRow::COLUMNS);
    }

    #[test]
    fn an_event_row_says_what_met_and_how() {
        let text = written(Format::Csv, &[event()]);
        let row = text.lines().nth(1).expect("a row");
        assert_eq!(row, "0.5,pair,1,2,1.0,2.0,3.0,0.0,1.0,0.0,4.0,3.6,-1e-17,collide");
    }

    #[test]
    fn the_ending_chooses_the_format() {
        assert_eq!(Format::of("a.jsonl"), Format::JsonLines);
        assert_eq!(Format::of("a.csv"), Format::Csv);
        assert_eq!(Format::of("jsonl"), Format::Csv);
        assert_eq!(Format::of("-"), Format::Csv);
    }
}
