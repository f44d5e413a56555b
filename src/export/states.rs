//! States of any program, read from CSV: a moment at a time, so that a file of any length takes the memory of one moment.

use std::io::{self, BufRead, BufReader, Read};

use glam::DVec3;

use super::columns::{COLUMNS, Columns};
use super::rows::StateRow;
use super::table::Row;
use super::trade::{CELL, ReadError, explain};
use super::wide::{Wide, wide};
use crate::printable;

/// Longest line that is read, bytes, and more for each sphere, whose six numbers may stand in it: a file without line ends
/// must not fill the memory.
const LINE: (usize, usize) = (1 << 16, 6 * 32);

/// What stands between two cells: the first of these that comes most often in the first line.
const DELIMITERS: [u8; 3] = [b',', b';', b'\t'];

/// All spheres at one time, as a file has them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Moment {
    /// Time of the moment, s.
    pub time: f64,
    /// Line of the moment's first row, from 1.
    pub line: u64,
    /// Centres, m, by sphere index.
    pub x: Vec<DVec3>,
    /// Velocities, m/s, by sphere index; empty if the file has none.
    pub v: Vec<DVec3>,
}

/// A file of states, read moment by moment.
#[derive(Debug)]
pub struct States<R: Read> {
    csv: csv::Reader<Lines<BufReader<R>>>,
    record: csv::StringRecord,
    /// Which cell of a row holds each of our columns.
    cells: [Option<usize>; COLUMNS],
    /// Which cell of a row holds which number of which sphere, if a row has all spheres; else none.
    wide: Option<Wide>,
    /// Number of cells of a row.
    width: usize,
    spheres: usize,
    /// The first row of the next moment.
    ahead: Option<Found>,
    /// The next moment, if a row has all spheres.
    next: Option<Moment>,
    last: Option<f64>,
}

/// A row of a file: one sphere at one time.
#[derive(Debug, Clone, Copy)]
struct Found {
    line: u64,
    time: f64,
    sphere: usize,
    x: DVec3,
    v: DVec3,
}

impl<R: Read> States<R> {
    /// Reads the first line. The file has rows of so many spheres; without a column `sphere` of one, or of all in columns
    /// that are numbered.
    ///
    /// # Errors
    /// A reader that fails, an empty file, a column that is missing.
    pub fn new(reader: R, columns: &Columns, spheres: usize) -> Result<States<R>, ReadError> {
        let most = LINE.0 + LINE.1.saturating_mul(spheres);
        let mut lines = Lines { inner: BufReader::new(reader), length: 0, most };
        let first = lines.inner.fill_buf().map_err(|error| ReadError(format!(" {}", printable::cause(&error))))?;
        let first = first.split(|byte| *byte == b'\n').next().unwrap_or_default();
        let count = |delimiter: u8| first.iter().filter(|byte| **byte == delimiter).count();
        let delimiter = DELIMITERS.into_iter().rev().max_by_key(|delimiter| count(*delimiter)).unwrap_or(b',');
        let mut csv = csv::ReaderBuilder::new();
        let csv = csv.has_headers(false).flexible(true).trim(csv::Trim::All).delimiter(delimiter).from_reader(lines);
        let mut states = States {
            csv,
            record: csv::StringRecord::new(),
            cells: [None; COLUMNS],
            wide: None,
            width: 0,
            spheres,
            ahead: None,
            next: None,
            last: None,
        };
        states.header(columns)?;
        match states.wide.take() {
            Some(wide) => {
                states.next = states.wide_row(&wide)?;
                states.wide = Some(wide);
            }
            None => states.ahead = states.row()?,
        }
        match (&states.ahead, &states.next) {
            (None, None) => Err(ReadError("2: the file ends after its column names; wanted are rows".into())),
            _ => Ok(states),
        }
    }

    fn header(&mut self, columns: &Columns) -> Result<(), ReadError> {
        let ours = || columns.names.join(",");
        if !self.csv.read_record(&mut self.record).map_err(|error| ReadError(explain(&error)))? {
            return Err(ReadError(format!("1: the file is empty; wanted are rows under the names {}", ours())));
        }
        self.width = self.record.len();
        for (k, name) in columns.names.iter().enumerate() {
            self.cells[k] = self.record.iter().position(|cell| cell == name);
        }
        if self.cells[1].is_none() && self.cells[2].is_none() {
            self.wide = wide(&self.record, &columns.names, self.spheres)?;
            if self.wide.is_some() {
                return Ok(());
            }
        }
        let moves = self.cells[5..].iter().any(Option::is_some);
        let needed = |k: usize| match k {
            1 => self.spheres > 1,
            5.. => moves,
            _ => true,
        };
        if let Some(k) = (0..COLUMNS).find(|&k| self.cells[k].is_none() && needed(k)) {
            let found = self.record.iter().collect::<Vec<_>>().join(",");
            return Err(ReadError(format!(
                "1: there is no column {}; the first line is \"{}\"; say with --columns what the file calls {}",
                columns.names[k],
                printable::shortened(&found, CELL),
                StateRow::COLUMNS[k],
            )));
        }
        Ok(())
    }

    /// The next moment; none at the end of the file.
    ///
    /// # Errors
    /// A row that is none, a time that goes back, a sphere that is missing at a time or comes twice.
    pub fn moment(&mut self) -> Result<Option<Moment>, ReadError> {
        if let Some(wide) = self.wide.take() {
            let Some(moment) = self.next.take() else { return Ok(None) };
            self.in_order(moment.line, moment.time)?;
            self.next = self.wide_row(&wide)?;
            self.wide = Some(wide);
            return Ok(Some(moment));
        }
        let Some(first) = self.ahead.take() else { return Ok(None) };
        self.in_order(first.line, first.time)?;
        let moves = self.cells[5].is_some();
        let mut moment = Moment { time: first.time, line: first.line, ..Moment::default() };
        moment.x.resize(self.spheres, DVec3::NAN);
        moment.v.resize(if moves { self.spheres } else { 0 }, DVec3::ZERO);
        let mut row = Some(first);
        while let Some(found) = row.filter(|found| found.time == first.time) {
            let complete = || moment.x.iter().all(|x| !x.is_nan());
            if !moment.x[found.sphere].is_nan() && complete() {
                break; // the same time again, as before and after an impact
            }
            if !moment.x[found.sphere].is_nan() {
                let (line, time, sphere) = (found.line, found.time, found.sphere);
                return Err(ReadError(format!("{line}: sphere {sphere} comes twice at the time {time:?}")));
            }
            moment.x[found.sphere] = found.x;
            if moves {
                moment.v[found.sphere] = found.v;
            }
            row = self.row()?;
        }
        self.ahead = row;
        match moment.x.iter().position(|x| x.is_nan()) {
            None => Ok(Some(moment)),
            Some(sphere) => Err(self.lacks(&moment, sphere)),
        }
    }

    fn in_order(&mut self, line: u64, time: f64) -> Result<(), ReadError> {
        match self.last.replace(time).filter(|last| time < *last) {
            Some(last) => {
                Err(ReadError(format!("{line}: time is {time:?} after {last:?}; wanted are rows in the order of time")))
            }
            None => Ok(()),
        }
    }

    fn lacks(&self, moment: &Moment, sphere: usize) -> ReadError {
        let (line, time) = (moment.line, moment.time);
        let end = if self.ahead.is_none() { ", where the file ends" } else { "" };
        ReadError(format!("{line}: there is no row of sphere {sphere} at the time {time:?}{end}"))
    }

    /// Reads a row; its line, none at the end of the file.
    fn cells(&mut self) -> Result<Option<u64>, ReadError> {
        let more = self.csv.read_record(&mut self.record);
        if !more.map_err(|error| ReadError(self.explained(&error)))? {
            return Ok(None);
        }
        let (line, found) = (self.line(), self.record.len());
        match found == self.width {
            true => Ok(Some(line)),
            false => Err(ReadError(format!("{line}: {found} cells, where {} are wanted", self.width))),
        }
    }

    /// Reads a row of all spheres; none at the end of the file.
    fn wide_row(&mut self, wide: &Wide) -> Result<Option<Moment>, ReadError> {
        let Some(line) = self.cells()? else { return Ok(None) };
        let time = in_time(line, self.finite(line, wide.time, StateRow::COLUMNS[0])?)?;
        let all = |cells: &[[usize; 3]], columns: &[&str]| -> Result<Vec<DVec3>, ReadError> {
            let of = |cells: &[usize; 3]| -> Result<DVec3, ReadError> {
                let number = |axis: usize| self.finite(line, cells[axis], columns[axis]);
                Ok(DVec3::new(number(0)?, number(1)?, number(2)?))
            };
            cells.iter().map(of).collect()
        };
        let (x, v) = (all(&wide.places, &StateRow::COLUMNS[2..])?, all(&wide.velocities, &StateRow::COLUMNS[5..])?);
        Ok(Some(Moment { time, line, x, v }))
    }

    fn row(&mut self) -> Result<Option<Found>, ReadError> {
        let Some(line) = self.cells()? else { return Ok(None) };
        let sphere = self.sphere(line)?;
        let mut values = [0.0; COLUMNS];
        for (k, value) in values.iter_mut().enumerate().filter(|(k, _)| *k != 1) {
            *value = self.number(line, k)?;
        }
        let [time, _, x, y, z, vx, vy, vz] = values;
        let time = in_time(line, time)?;
        Ok(Some(Found { line, time, sphere, x: DVec3::new(x, y, z), v: DVec3::new(vx, vy, vz) }))
    }

    /// The line of the row read last: a row begins for the reader where the one before ended, which may be an empty line.
    fn line(&self) -> u64 {
        let begins = self.record.position().map_or(0, csv::Position::line);
        self.csv.position().line().saturating_sub(1).max(begins)
    }

    fn explained(&self, error: &csv::Error) -> String {
        let line = self.csv.position().line();
        match error.kind() {
            csv::ErrorKind::Io(cause) if cause.kind() == io::ErrorKind::InvalidData => format!("{line}: {cause}"),
            _ => explain(error),
        }
    }

    fn sphere(&self, line: u64) -> Result<usize, ReadError> {
        let Some(index) = self.cells[1] else { return Ok(0) };
        let cell = self.record.get(index).unwrap_or_default();
        let number = cell.parse::<f64>().ok().filter(|number| number.fract() == 0.0 && *number >= 0.0);
        match number.map(|number| number as usize).filter(|sphere| *sphere < self.spheres) {
            Some(sphere) => Ok(sphere),
            None => Err(ReadError(format!(
                "{line}: sphere (column {}) is \"{}\"; the scene's spheres are 0 to {}",
                index + 1,
                printable::shortened(cell, CELL),
                self.spheres.saturating_sub(1),
            ))),
        }
    }

    /// The number of our column `k`; 0 if the file has none.
    fn number(&self, line: u64, k: usize) -> Result<f64, ReadError> {
        self.cells[k].map_or(Ok(0.0), |index| self.finite(line, index, StateRow::COLUMNS[k]))
    }

    /// The number of a cell that holds our column `name`.
    fn finite(&self, line: u64, index: usize, name: &str) -> Result<f64, ReadError> {
        let cell = self.record.get(index).unwrap_or_default();
        match cell.parse::<f64>().ok().filter(|number| number.is_finite()) {
            Some(number) => Ok(number),
            None => Err(ReadError(format!(
                "{line}: {name} (column {}) is \"{}\"; wanted is a finite number",
                index + 1,
                printable::shortened(cell, CELL),
            ))),
        }
    }
}

fn in_time(line: u64, time: f64) -> Result<f64, ReadError> {
    match time < 0.0 {
        true => Err(ReadError(format!("{line}: time is {time:?}; wanted is a number from 0"))),
        false => Ok(time),
    }
}

/// A reader that refuses lines longer than `most`.
#[derive(Debug)]
struct Lines<R> {
    inner: R,
    /// Bytes since the last line end.
    length: usize,
    /// Longest line, bytes.
    most: usize,
}

impl<R: Read> Read for Lines<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let mut read = self.inner.read(buffer)?;
        while read > 0 && buffer[..read].iter().all(|byte| *byte == b'\r') {
            read = self.inner.read(buffer)?;
        }
        // Lines that end as on Windows would be counted one behind.
        let mut kept = 0;
        for index in 0..read {
            if buffer[index] != b'\r' {
                buffer[kept] = buffer[index];
                kept += 1;
            }
        }
        read = kept;
        for line in buffer[..read].split_inclusive(|byte| *byte == b'\n') {
            self.length += line.len();
            if self.length > self.most {
                let message = format!("a line of more than {} bytes; wanted are rows of numbers", self.most);
                return Err(io::Error::new(io::ErrorKind::InvalidData, message));
            }
            if line.ends_with(b"\n") {
                self.length = 0;
            }
        }
        Ok(read)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "time,sphere,x,y,z,vx,vy,vz\n";

    fn all(text: &str, columns: &Columns, spheres: usize) -> Result<Vec<Moment>, String> {
        let mut states = States::new(text.as_bytes(), columns, spheres).map_err(|error| error.to_string())?;
        let mut moments = Vec::new();
        while let Some(moment) = states.moment().map_err(|error| error.to_string())? {
            moments.push(moment);
        }
        Ok(moments)
    }

    #[test]
    fn moments_are_read_whatever_the_order_of_spheres_and_the_names_of_columns() {
        let text = "vx;t;ball;px;y;z;vy;vz;extra\n1;0;1;2;3;4;5;6;a\n0;0;0;7;0;0;0;0;b\n\n0;0.5;0;0;0;0;0;0;c\n0;0.5;1;0;0;0;0;0;d\n";
        let columns = Columns::parse("t=time, ball=sphere,px=x").expect("a mapping");
        let moments = all(text, &columns, 2).expect("a file");
        assert_eq!((moments.len(), moments[1].time, moments[1].line), (2, 0.5, 5));
        assert_eq!((moments[0].x[1], moments[0].v[1]), (DVec3::new(2.0, 3.0, 4.0), DVec3::new(1.0, 5.0, 6.0)));
        assert_eq!(moments[0].x[0], DVec3::new(7.0, 0.0, 0.0));
    }

    #[test]
    fn lines_are_counted_whatever_ends_them() {
        for end in ["\n", "\r\n"] {
            let text = "time,x,y,z\n0,1,2,3\n1,1,2,3\n2,1,2,3".replace('\n', end);
            let moments = all(&text, &Columns::default(), 1).expect("a file");
            assert_eq!(moments.iter().map(|moment| moment.line).collect::<Vec<_>>(), [2, 3, 4], "{end:?}");
        }
    }

    #[test]
    fn a_time_may_come_again_as_before_and_after_an_impact() {
        let moments = all("time,x,y,z\n0,1,2,3\n1,1,2,3\n1,4,5,6\n2,0,0,0\n", &Columns::default(), 1).expect("a file");
        assert_eq!(moments.iter().map(|moment| moment.time).collect::<Vec<_>>(), [0.0, 1.0, 1.0, 2.0]);
        assert_eq!(moments[2].x, [DVec3::new(4.0, 5.0, 6.0)]);
    }

    #[test]
    fn one_sphere_needs_no_index_and_a_file_of_places_no_velocities() {
        let moments = all("time,x,y,z\n0,1,2,3\n1,1,2,3\n", &Columns::default(), 1).expect("a file");
        assert_eq!((moments.len(), moments[0].v.len()), (2, 0));
        assert!(all("time,x,y,z\n0,1,2,3\n", &Columns::default(), 2).expect_err("two spheres").contains("sphere"));
    }

    #[test]
    fn a_broken_file_is_refused_with_its_line_and_column() {
        let row = |text: &str| format!("{HEAD}0,0,1,2,3,4,5,6\n0,1,1,2,3,4,5,6\n{text}\n");
        for (text, words) in [
            (String::new(), &["1: ", "empty", "time,sphere"][..]),
            (HEAD.into(), &["2: ", "ends"]),
            ("a,b\n1,2\n".into(), &["1: ", "no column time", "\"a,b\"", "--columns"]),
            ("time,sphere,x,y,z,vx,vy\n".into(), &["1: ", "no column vz"]),
            (row("1,0,1,2,soon,4,5,6"), &["4: ", "z (column 5) is \"soon\""]),
            (row("1,0,1,2,NaN,4,5,6"), &["4: ", "z (column 5)", "finite"]),
            (row("1,0,1,2,3,4,5"), &["4: ", "7 cells", "8"]),
            (row("1,2,1,2,3,4,5,6"), &["4: ", "sphere (column 2) is \"2\"", "0 to 1"]),
            (row("1,0.5,1,2,3,4,5,6"), &["4: ", "sphere", "0.5"]),
            (row("-1,0,1,2,3,4,5,6"), &["4: ", "time is -1"]),
            (row("1,0,1,2,3,4,5,6"), &["4: ", "no row of sphere 1 at the time 1.0, where the file ends"]),
            (row("1,0,1,2,3,4,5,6\n1,0,1,2,3,4,5,6"), &["5: ", "sphere 0 comes twice at the time 1.0"]),
            (row("1,0,1,2,3,4,5,6\n1,1,1,2,3,4,5,6\n1,0,0,0,0,0,0,0"), &["6: ", "no row of sphere 1", "file ends"]),
            (row("1,0,1,2,3,4,5,6\n2,0,1,2,3,4,5,6"), &["4: ", "no row of sphere 1 at the time 1.0"]),
            (
                row("1,0,1,2,3,4,5,6\n1,1,1,2,3,4,5,6\n0.5,0,1,2,3,4,5,6\n0.5,1,1,2,3,4,5,6"),
                &["6: ", "time is 0.5 after 1.0", "order"],
            ),
            (row("1,0,\u{1b}[2J,2,3,4,5,6"), &["4: ", "x (column 3)", "\\u{1b}"]),
        ] {
            let error = all(&text, &Columns::default(), 2).expect_err(&text);
            assert!(words.iter().all(|word| error.contains(word)), "{error}");
        }
    }

    #[test]
    fn a_line_without_end_is_refused_before_it_fills_the_memory() {
        let endless = std::io::repeat(b'1').take(1 << 30);
        let error = States::new(endless, &Columns::default(), 1).expect_err("no line end").to_string();
        assert!(error.contains("a line of more than 65728 bytes"), "{error}");
        let late = HEAD.as_bytes().chain(b"0,0,1,2,3,4,5,6\n".chain(std::io::repeat(b'1').take(1 << 30)));
        let mut states = States::new(late, &Columns::default(), 1).expect("a first row");
        let error = states.moment().expect_err("no line end").to_string();
        assert!(error.starts_with("3: a line of more"), "{error}");
    }

    #[test]
    fn a_row_may_hold_all_spheres_in_columns_that_are_numbered() {
        let long = all("time,sphere,x,y,z\n0,0,1,2,3\n0,1,4,5,6\n1,0,7,8,9\n1,1,0,0,0\n", &Columns::default(), 2);
        for (head, columns) in [
            ("time,x0,y0,z0,x1,y1,z1", ""),
            ("time,x_1,y_1,z_1,x_2,y_2,z_2", ""),
            ("t,x[0],y[0],z[0],x[1],y[1],z[1]", "t=time"),
            ("t,p0x,y0,z0,p1x,y1,z1", "t=time,p#x=x"),
        ] {
            let columns = if columns.is_empty() { Columns::default() } else { Columns::parse(columns).expect(columns) };
            let found = all(&format!("{head}\n0,1,2,3,4,5,6\n1,7,8,9,0,0,0\n"), &columns, 2).expect(head);
            let places = |moments: &[Moment]| moments.iter().map(|moment| moment.x.clone()).collect::<Vec<_>>();
            assert_eq!(places(&found), places(long.as_ref().expect("rows")), "{head}");
            assert_eq!((found[1].time, found[1].line, found[1].v.len()), (1.0, 3, 0), "{head}");
        }
        let moves = all("vx0,vy0,vz0,time,x0,y0,z0\n1,2,3,0,4,5,6\n", &Columns::default(), 1).expect("velocities");
        assert_eq!((moves[0].x[0], moves[0].v[0]), (DVec3::new(4.0, 5.0, 6.0), DVec3::new(1.0, 2.0, 3.0)));
    }

    #[test]
    fn a_row_of_all_spheres_that_is_broken_is_refused_with_its_line_and_column() {
        let head = "time,x0,y0,z0,x1,y1,z1\n";
        for (text, words) in [
            ("time,x0,y0,z0\n0,1,2,3\n".to_owned(), &["1: ", "no column x1", "each sphere, 0 to 1"][..]),
            ("time,x0,y0,z0,x1,y1,z1,x2,y2,z2\n".into(), &["1: ", "column x2 is of a sphere more", "2"]),
            ("x0,y0,z0,x1,y1,z1\n".into(), &["1: ", "no column time"]),
            ("time,x0,y0,z0,x1,y1,z1,vx0\n".into(), &["1: ", "no column vy0"]),
            (head.into(), &["2: ", "ends"]),
            (format!("{head}0,1,2,3,4,5\n"), &["2: ", "6 cells", "7"]),
            (format!("{head}0,1,2,3,4,soon,6\n"), &["2: ", "y (column 6) is \"soon\""]),
            (format!("{head}1,1,2,3,4,5,6\n0.5,1,2,3,4,5,6\n"), &["3: ", "0.5 after 1.0"]),
            (format!("{head}-1,1,2,3,4,5,6\n"), &["2: ", "time is -1"]),
        ] {
            let error = all(&text, &Columns::default(), 2).expect_err(&text);
            assert!(words.iter().all(|word| error.contains(word)), "{error}");
        }
    }

    #[test]
    fn a_row_may_be_as_long_as_its_spheres_need() {
        let numbers = |of: &dyn Fn(usize) -> String| (0..1000).map(of).collect::<Vec<_>>().join(",");
        let head = numbers(&|i| format!("x{i},y{i},z{i},vx{i},vy{i},vz{i}"));
        let row = numbers(&|_| "-1.2345678901234567e-10,2,3,-1.2345678901234567e-10,-1.2345678901234567e-10,3".into());
        let moments = all(&format!("time,{head}\n0,{row}\n"), &Columns::default(), 1000).expect("a long row");
        assert_eq!((moments[0].x.len(), moments[0].v[999].z), (1000, 3.0));
    }
}
