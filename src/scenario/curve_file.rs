//! Reading a force curve from a CSV file.
//!
//! Two columns, time in ms and share, apart by commas, semicolons or tabs, whichever the first
//! line holds. A first line of words is a header; empty lines and those that begin with `#` are
//! passed over. A scenario file may come from anybody, so the curve it names must lie in its own
//! folder or below and be small. Left out: decimal commas, units and column names.

use crate::plain_text::quoted;
use crate::scenario::curve::{Curve, Growing};
use crate::scenario::{text_file, text_file::without_mark};
use csv::{ReaderBuilder, StringRecord, Trim};
use serde::de::Error;
use serde::{Deserialize, Deserializer};
use std::cell::RefCell;
use std::path::{Component, Path, PathBuf};

/// The folder that the name of a curve's file is relative to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum PathBase {
    /// None: the text has no place, so it can name no file.
    Nowhere,
    /// The folder of the scenario file that names it.
    Scenario(PathBuf),
    /// The working directory, where a person typed the name.
    Typed,
}

thread_local! {
    /// The base of the text that is being read: derived readers of serde take no context.
    static PATH_BASE: RefCell<PathBase> = const { RefCell::new(PathBase::Nowhere) };
}

/// Reads with names of files taken relative to `base`.
pub(super) fn with_files<T>(base: &PathBase, read: impl FnOnce() -> T) -> T {
    let before = PATH_BASE.replace(base.clone());
    let value = read();
    PATH_BASE.set(before);
    value
}

/// The curve that `Csv("file.csv")` means.
pub(super) struct CurveFile(pub Curve);

impl<'de> Deserialize<'de> for CurveFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        let curve = PATH_BASE.with_borrow(|base| load(&name, base));
        curve.map(Self).map_err(D::Error::custom)
    }
}

/// Reads the named file; a complaint begins with the name, and the line where there is one.
fn load(name: &str, base: &PathBase) -> Result<Curve, String> {
    let said = quoted(name);
    let path = match base {
        _ if name.is_empty() => return Err("the name of the file is missing".to_owned()),
        PathBase::Nowhere => {
            return Err(format!(
                "{said} cannot be found: only a scenario file can name a file beside it"
            ));
        }
        PathBase::Scenario(folder) => {
            let inside = |part: Component| matches!(part, Component::Normal(_));
            let path = folder.join(name);
            if !Path::new(name).components().all(inside) || links_out_of(folder, &path) {
                return Err(format!(
                    "{said} leaves the folder of the scenario: the file must stand beside it or below"
                ));
            }
            path
        }
        PathBase::Typed => PathBuf::from(name),
    };
    let text = text_file::read(&path).map_err(|why| format!("{said}: {why}"))?;
    read(&text).map_err(|(line, why)| match line {
        Some(line) => format!("{said}:{line}: {why}"),
        None => format!("{said}: {why}"),
    })
}

/// Whether a symbolic link on the way leads out of the folder. What does not exist leads nowhere.
fn links_out_of(folder: &Path, path: &Path) -> bool {
    // The folder of a bare file name is the empty path, which stands for the working directory.
    let folder = Path::new(".").join(folder);
    match (folder.canonicalize(), path.canonicalize()) {
        (Ok(folder), Ok(path)) => !path.starts_with(folder),
        _ => false,
    }
}

/// Reads the text of a file; a complaint comes with its line.
fn read(text: &str) -> Result<Curve, (Option<u64>, String)> {
    let text = without_mark(text);
    let mut rows = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(Trim::All)
        .comment(Some(b'#'))
        .delimiter(delimiter(text))
        .from_reader(text.as_bytes());
    let mut growing = Growing::default();
    let mut row = StringRecord::new();
    let mut first = true;
    while rows.read_record(&mut row).map_err(|error| (None, error.to_string()))? {
        let line = row.position().map(csv::Position::line);
        let refused = |why: String| (line, why);
        if row.iter().all(str::is_empty) {
            continue;
        }
        let [time, share] = two(&row).map_err(refused)?;
        let is_header = first && [time, share].iter().all(|cell| number(cell).is_err());
        first = false;
        if is_header {
            check_unit(time).map_err(refused)?;
            continue;
        }
        let knot = (number(time).map_err(refused)?, number(share).map_err(refused)?);
        growing.push(knot.0, knot.1).map_err(|error| refused(error.to_string()))?;
    }
    growing.finish().map_err(|error| (None, error.to_string()))
}

/// What stands between the columns, by the first line that holds anything.
fn delimiter(text: &str) -> u8 {
    let telling = |line: &&str| !line.trim().is_empty() && !line.starts_with('#');
    let line = text.lines().find(telling).unwrap_or_default();
    let found = [b'\t', b';'].into_iter().find(|mark| line.as_bytes().contains(mark));
    found.unwrap_or(b',')
}

fn two(row: &StringRecord) -> Result<[&str; 2], String> {
    match (row.get(0), row.get(1), row.len()) {
        (Some(time), Some(share), 2) => Ok([time, share]),
        (_, _, columns) => Err(format!(
            "{} has {columns} column{}, not 2: time in ms and share (decimals follow a point)",
            quoted(&row.iter().collect::<Vec<_>>().join(" ")),
            if columns == 1 { "" } else { "s" }
        )),
    }
}

fn number(cell: &str) -> Result<f64, String> {
    let comma = if cell.contains(',') { " (decimals follow a point, not a comma)" } else { "" };
    cell.parse().map_err(|_| match cell {
        "" => "a number is missing: time in ms and share".to_owned(),
        cell => format!("{} is not a number{comma}", quoted(cell)),
    })
}

/// A header that names another unit than ms would be off by a factor of a thousand.
fn check_unit(heading: &str) -> Result<(), String> {
    let others = ["s", "sec", "second", "seconds", "us", "µs", "μs", "ns"];
    let lower = heading.to_lowercase();
    let mut words = lower.split(|c: char| !c.is_alphabetic());
    match words.find(|word| others.contains(word)) {
        Some(_) => Err(format!("{} is another unit: times must be in ms", quoted(heading))),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    const KNOTS: &str = "0,0\n0.05,1\n0.2,-0.25\n";

    fn curve() -> Curve {
        Curve::new([(0.0, 0.0), (0.05, 1.0), (0.2, -0.25)]).unwrap()
    }

    /// A folder with these files.
    fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("in")).unwrap();
        for (name, text) in files {
            fs::write(folder.path().join(name), text).unwrap();
        }
        folder
    }

    fn complaint(text: &str) -> String {
        let (line, why) = read(text).unwrap_err();
        line.map_or_else(|| why.clone(), |line| format!("{line}: {why}"))
    }

    #[test]
    fn the_ways_in_which_programs_write_two_columns_are_all_read() {
        for text in [
            KNOTS,
            "\u{feff}t_ms,share\n0,0\n0.05,1\n0.2,-0.25",
            "\"time (ms)\";\"force\"\r\n\"0\";\"0\"\r\n5e-2;1.0\r\n.2;-2.5e-1\r\n\r\n",
            "# by the load cell of Monday, 10 N/V\n\n  \nt\ty\n0\t0\n# peak\n0.05\t+1\n0.2\t-0.25\n",
            " 0 , 0 \n 0.05 , 1 \n,\n 0.2 , -0.25 \n",
        ] {
            assert_eq!(read(text), Ok(curve()), "{text:?}");
        }
    }

    #[test]
    fn a_bad_line_and_the_first_too_many_are_named_with_their_number() {
        for (text, said) in [
            ("", "no knots"),
            ("# nothing\n", "no knots"),
            ("t,f\n", "no knots"),
            ("0,0\n", "one knot"),
            ("t,f\n0,0\n0.1,one\n", "3: one is not a number"),
            ("t,f\nms,N\n0,0\n", "2: ms is not a number"),
            ("0,x\n0.1,1\n", "1: x is not a number"),
            ("0,0\n0,1,0,5\n", "2: 0 1 0 5 has 4 columns, not 2"),
            ("0 0\n0.1 1\n", "1: 0 0 has 1 column, not 2"),
            ("0,0\n0.1\n", "2: 0.1 has 1 column, not 2"),
            ("0,0\n0.1,\n", "2: a number is missing"),
            ("0,0\n\n# x\r\n0.1,1\n0.1,0\n", "5: time 0.1 does not come after 0.1"),
            ("0,0\n0.1,nan\n", "2: share NaN is not a finite number"),
            ("0,0\ninf,1\n", "2: time inf is not a finite number"),
            ("0,0\n0.1,\"1\n0.2,0\n", "2: 1\\n0.2,0 is not a number"),
            ("t [µs],force\n0,0\n", "1: t [µs] is another unit"),
        ] {
            let complaint = complaint(text);
            assert!(complaint.starts_with(said), "{text:?}: {complaint}");
        }
        let rows = (0..5000).map(|i| format!("{},1\n", f64::from(i) * 1e-3));
        let text: String = std::iter::once("t_ms,share\n".to_owned()).chain(rows).collect();
        assert!(text.len() as u64 <= text_file::LIMIT);
        assert!(complaint(&text).starts_with("2002: more than 2000 knots"));
    }

    #[test]
    fn a_scenario_file_reaches_no_file_outside_its_folder() {
        let folder = folder(&[("out.csv", KNOTS), ("in/a.csv", KNOTS)]);
        let inner = PathBase::Scenario(folder.path().join("in"));
        let outer = PathBase::Scenario(folder.path().to_owned());
        let full = folder.path().join("out.csv");
        let full = full.to_str().unwrap();
        assert_eq!(load("a.csv", &inner), Ok(curve()));
        assert_eq!(load("in/a.csv", &outer), Ok(curve()));
        assert_eq!(load(full, &PathBase::Typed), Ok(curve()));
        for name in ["../out.csv", "x/../../out.csv", full] {
            let why = load(name, &inner).unwrap_err();
            assert!(why.contains("leaves the folder of the scenario"), "{why}");
        }
        assert!(load("a.csv", &PathBase::Nowhere).unwrap_err().contains("a.csv cannot be found"));
        let why = load("in", &outer).unwrap_err();
        assert!(why.contains("in: is a directory"), "{why}");
    }

    #[cfg(unix)]
    #[test]
    fn a_link_out_of_the_folder_is_not_followed() {
        use std::os::unix::fs::symlink;
        let folder = folder(&[("out.csv", "secret\n"), ("in/a.csv", KNOTS)]);
        symlink("../out.csv", folder.path().join("in/out.csv")).unwrap();
        symlink("a.csv", folder.path().join("in/b.csv")).unwrap();
        let inner = PathBase::Scenario(folder.path().join("in"));
        assert_eq!(load("b.csv", &inner), Ok(curve()));
        let why = load("out.csv", &inner).unwrap_err();
        assert!(why.contains("leaves the folder") && !why.contains("secret"), "{why}");
    }
}
