//! Rows of a sweep as CSV or as JSON lines, and what tells one table from another.

use crate::injury::Injury;
use crate::many::sweep::{Sweep, SweepRow};
use crate::plain_text::cell;
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

/// The columns of the range of a risk.
fn range_keys(injury: Injury) -> [String; 2] {
    ["low", "high"].map(|end| format!("{}_{end}_percent", injury.key()))
}

/// Columns after the results and the ranges of risks.
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
                columns.extend(Injury::ALL.iter().flat_map(|injury| range_keys(*injury)));
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
        let range = |injury: Injury| match point.and_then(|point| point.ranges) {
            Some(ranges) => {
                let (low, high) = ranges[injury as usize];
                [Some(100.0 * low), Some(100.0 * high)]
            }
            None => [None; 2],
        };
        match self {
            Self::Csv => {
                let number = |v: Option<f64>| v.map_or_else(String::new, |v| v.to_string());
                let mut cells = vec![row.number.to_string()];
                cells.extend(row.values.iter().map(|value| cell(value)));
                cells.extend(Quantity::ALL.iter().map(|of| number(value(*of))));
                cells.extend(Injury::ALL.iter().flat_map(|of| range(*of).map(number)));
                cells.extend([number(error), flags.join(";")]);
                // A message of several lines would break the row.
                cells.push(refused.map_or_else(String::new, |why| cell(&why.replace('\n', "; "))));
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
                for &injury in Injury::ALL {
                    for (key, end) in range_keys(injury).into_iter().zip(range(injury)) {
                        results.insert(key, json!(end));
                    }
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

    /// The number of the row that a line holds; none of a line that is damaged: its columns, varied
    /// values and figures must be those of such a row.
    pub fn number(self, sweep: &Sweep, line: &str) -> Option<usize> {
        match self {
            Self::Csv => {
                let mut reader = csv::ReaderBuilder::new();
                let reader = reader.has_headers(false).from_reader(line.as_bytes());
                let [record] = &reader.into_records().collect::<Result<Vec<_>, _>>().ok()?[..]
                else {
                    return None;
                };
                let varied = sweep.axes().len();
                let figures = Quantity::ALL.len() + 2 * Injury::ALL.len();
                let number = record
                    .get(0)?
                    .parse()
                    .ok()
                    .filter(|row| *row < sweep.rows())?;
                let same = |(text, value): (&str, &str)| text == cell(value);
                let values = record.iter().skip(1).zip(sweep.values(number));
                let is_figure =
                    |text: &str| text.is_empty() || text.parse::<f64>().is_ok_and(f64::is_finite);
                // Of a run whose step error is not known it is not finite.
                let error = record.get(1 + varied + figures)?;
                let whole = record.len() == 1 + varied + figures + LAST.len()
                    && values.into_iter().all(same)
                    && record.iter().skip(1 + varied).take(figures).all(is_figure)
                    && (error.is_empty() || error.parse::<f64>().is_ok());
                whole.then_some(number)
            }
            Self::Json => {
                let object: Value = serde_json::from_str(line).ok()?;
                let number = usize::try_from(object.get("row")?.as_u64()?).ok();
                let number = number.filter(|row| *row < sweep.rows())?;
                let axes = sweep.axes().iter().zip(sweep.values(number));
                let varied = axes.map(|(axis, text)| (axis.path.clone(), typed(&axis.path, text)));
                let figure = |value: &Value| value.is_null() || value.is_number();
                let results = match object.get("results")? {
                    Value::Object(results) => {
                        results.len() == Quantity::ALL.len() + 2 * Injury::ALL.len()
                            && results.values().all(figure)
                    }
                    other => other.is_null() && object.get("refused")?.is_string(),
                };
                let same = object.get("varied")? == &Value::Object(varied.collect());
                (same && results).then_some(number)
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
