//! Rows of a sweep as CSV or as JSON lines, and what tells one table from another.

use crate::many::sweep::{Sweep, SweepRow};
use crate::run::quantity::Quantity;
use crate::scenario::fields;
use serde_json::{Map, Value, json};

/// How rows are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SweepFormat {
    /// Comma-separated values below a comment and a heading.
    Csv,
    /// One JSON object a line.
    Json,
}

/// Columns after the results.
const LAST: [&str; 3] = ["step_error_percent", "flags", "refused"];

fn csv(cells: &[String]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let written = writer.write_record(cells);
    debug_assert!(written.is_ok(), "a record into memory cannot fail");
    String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
}

impl SweepFormat {
    /// What stands before the rows, the same for every shard of a sweep.
    pub fn heading(self, sweep: &Sweep) -> String {
        let mark = format!("{:016x}", sweep.fingerprint());
        let paths: Vec<&str> = sweep.axes().iter().map(|axis| axis.path.as_str()).collect();
        match self {
            Self::Csv => {
                let mut columns = vec!["row".to_owned()];
                columns.extend(paths.iter().map(|path| (*path).to_owned()));
                columns.extend(Quantity::ALL.iter().map(|of| of.key().to_owned()));
                columns.extend(LAST.map(str::to_owned));
                let rows = sweep.rows();
                format!(
                    "# contrecoup sweep {mark} of {rows} rows\n{}",
                    csv(&columns)
                )
            }
            Self::Json => format!(
                "{}\n",
                json!({ "sweep": mark, "rows": sweep.rows(), "varied": paths })
            ),
        }
    }

    /// One line for a row of the sweep.
    pub fn row(self, sweep: &Sweep, row: &SweepRow) -> String {
        let point = row.outcome.as_ref().ok();
        let flags: Vec<&str> =
            point.map_or(Vec::new(), |p| p.flags.iter().map(|f| f.name()).collect());
        let error = point.and_then(|p| p.check).map(|check| check.last);
        let value = |of: Quantity| point?.values[of].filter(|v| v.is_finite());
        let refused = row.outcome.as_ref().err();
        match self {
            Self::Csv => {
                let number = |v: Option<f64>| v.map_or_else(String::new, |v| v.to_string());
                let mut cells = vec![row.number.to_string()];
                cells.extend(row.values.iter().cloned());
                cells.extend(Quantity::ALL.iter().map(|of| number(value(*of))));
                cells.extend([number(error), flags.join(";")]);
                // A message of several lines would break the row.
                cells.push(refused.map_or_else(String::new, |why| why.replace('\n', "; ")));
                csv(&cells)
            }
            Self::Json => {
                let mut varied = Map::new();
                for (axis, text) in sweep.axes().iter().zip(&row.values) {
                    varied.insert(axis.path.clone(), typed(&axis.path, text));
                }
                let mut results = Map::new();
                for &quantity in Quantity::ALL {
                    results.insert(quantity.key().to_owned(), json!(value(quantity)));
                }
                let object = json!({
                    "row": row.number,
                    "varied": varied,
                    "results": point.map(|_| results),
                    "step_error_percent": error,
                    "flags": flags,
                    "refused": refused,
                });
                format!("{object}\n")
            }
        }
    }

    /// The number of the row that a complete line holds.
    pub fn number(self, line: &str) -> Option<usize> {
        match self {
            Self::Csv => line.split(',').next()?.parse().ok(),
            Self::Json => {
                let object: Value = serde_json::from_str(line).ok()?;
                usize::try_from(object.get("row")?.as_u64()?).ok()
            }
        }
    }
}

/// A varied value as JSON: a number where the field holds one.
fn typed(path: &str, text: &str) -> Value {
    use fields::Kind::{Integer, Number, OptionalNumber};
    let kind = fields::find(path).map(|field| &field.kind);
    match (kind, text.parse::<f64>()) {
        (Some(Number(..) | OptionalNumber(..) | Integer(..)), Ok(number)) => json!(number),
        _ => json!(text),
    }
}
