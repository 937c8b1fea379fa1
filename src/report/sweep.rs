//! Rows of a sweep as CSV or as JSON lines, and what tells one table from another.

use crate::answer::brief::BriefAnswer;
use crate::injury::{Injury, whole};
use crate::many::falling::FallingRows;
use crate::many::sweep::{Sweep, SweepRow, fnv1a};
use crate::plain_text::cell;
use crate::run::{flags::FlagKind, quantity::Quantity};
use crate::scenario::fields;
use serde_json::{Value, json};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SweepFormat {
    /// Comma-separated values below a comment and a heading.
    Csv,
    Json,
}

/// Each result of a row by its key, then the ends of the range of each risk.
fn figures(point: Option<&BriefAnswer>) -> impl Iterator<Item = (String, Option<f64>)> {
    let value = move |of: Quantity| point?.values[of].filter(|v| v.is_finite());
    let results = Quantity::ALL.iter().map(move |of| (of.key().to_owned(), value(*of)));
    let ranges = Injury::ALL.iter().flat_map(move |injury| {
        let range = point.and_then(|point| point.ranges).map(|ranges| ranges[*injury as usize]);
        let ends = [("low", range.map(|(low, _)| low)), ("high", range.map(|(_, high)| high))];
        ends.map(|(end, share)| {
            (format!("{}_{end}_percent", injury.key()), share.map(|share| 100.0 * share))
        })
    });
    results.chain(ranges)
}

/// Whether the rows of a sweep differ in where an object comes from.
fn turns(sweep: &Sweep) -> bool {
    let fields = ["model", "model.eye_side", "impact", "impact.from"];
    let of_direction = |path: &str| fields.contains(&path) || path.starts_with("impact.angle");
    sweep.axes().iter().any(|axis| of_direction(&axis.path))
}

/// Which eye of a row it is, the side that the object comes from, and the hour: what an axis holds
/// may be an angle below 0, or a side alone. Nothing of a row that is refused.
fn direction(sweep: &Sweep, row: usize) -> [(&'static str, Option<String>); 3] {
    let scenario = sweep.scenario(row).ok();
    let text = |path: &str| fields::find(path)?.text(scenario.as_deref()?);
    let straight = ["StraightOn", "NotKnown"];
    let from = text("impact.from");
    let turned = from.as_ref().is_some_and(|from| !straight.contains(&from.as_str()));
    let hour = scenario.as_ref().filter(|_| turned).and_then(|scenario| scenario.projectile());
    let hour = hour.map(|object| object.angle_clock.to_string());
    [("eye_side", text("model.eye_side")), ("from", from), ("hour", hour)]
}

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
                if turns(sweep) {
                    columns.extend(["eye_side", "from", "hour"].map(str::to_owned));
                }
                columns.extend(figures(None).map(|(key, _)| key));
                columns
                    .extend(["step_error_percent", "flags", "refused", "sum"].map(str::to_owned));
                let rows = sweep.rows();
                format!("# contrecoup sweep {mark} of {rows} rows\n{}", csv(&columns))
            }
            Self::Json => {
                let (rows, program) = (sweep.rows(), crate::report::program());
                let head =
                    json!({ "sweep": mark, "rows": rows, "varied": paths, "program": program });
                format!("{head}\n")
            }
        }
    }

    pub fn row(self, sweep: &Sweep, row: &SweepRow) -> String {
        let (point, refused) = (row.outcome.as_ref().ok(), row.outcome.as_ref().err());
        let flags: Vec<&str> =
            point.iter().flat_map(|p| p.flags.iter()).map(FlagKind::name).collect();
        let error = point.and_then(|p| p.check).map(|check| check.last);
        match self {
            Self::Csv => {
                let number = |v: Option<f64>| v.map_or_else(String::new, |v| v.to_string());
                let mut cells = vec![row.number.to_string()];
                cells.extend(row.values.iter().map(|value| cell(value)));
                if turns(sweep) {
                    cells.extend(
                        direction(sweep, row.number).map(|(_, text)| text.unwrap_or_default()),
                    );
                }
                cells.extend(figures(point).map(|(_, value)| number(value)));
                cells.extend([number(error), flags.join(";")]);
                // A message of several lines would break the row.
                cells.push(refused.map_or_else(String::new, |why| cell(&why.replace('\n', "; "))));
                self.summed(sweep, csv(&cells).trim_end())
            }
            Self::Json => {
                let varied = sweep.axes().iter().zip(&row.values);
                let varied =
                    varied.map(|(axis, text)| (axis.path.as_str(), typed(&axis.path, text)));
                let mut object = json!({
                    "row": row.number,
                    "varied": varied.collect::<Value>(),
                    "results": point.map(|_| figures(point).collect::<Value>()),
                    "step_error_percent": error,
                    "flags": flags,
                    "refused": refused,
                });
                if turns(sweep) {
                    object["direction"] = direction(sweep, row.number).into_iter().collect();
                }
                self.summed(sweep, object.to_string().strip_suffix('}').unwrap_or_default())
            }
        }
    }

    /// The number of a line's row; none if its sum tells that it was changed since it was written.
    pub fn number(self, sweep: &Sweep, line: &str) -> Option<usize> {
        let body = line.get(..line.len().checked_sub(self.ending(0).len())?)?;
        let number = match self {
            Self::Csv => body,
            Self::Json => body.strip_prefix("{\"row\":")?,
        };
        let number = number.split(',').next()?.parse().ok()?;
        (self.summed(sweep, body) == line && number < sweep.rows()).then_some(number)
    }

    /// A row with its sum, which hangs on the sweep too.
    fn summed(self, sweep: &Sweep, body: &str) -> String {
        let sum = fnv1a(&format!("{:016x}{body}", sweep.fingerprint()));
        format!("{body}{}", self.ending(sum))
    }

    fn ending(self, sum: u64) -> String {
        match self {
            Self::Csv => format!(",{sum:016x}\n"),
            Self::Json => format!(",\"sum\":\"{sum:016x}\"}}\n"),
        }
    }
}

/// In how many rows a harder blow does less, in a line; none where in none.
pub fn falling(rows: &FallingRows) -> Option<String> {
    let (harder, weaker, fall) = rows.first?;
    let (count, name) = (rows.count, fall.injury.name());
    let [from, to] = [fall.risks.0, fall.risks.1].map(|risk| whole(0.01 * risk));
    Some(format!(
        "in {count} of the rows a blow does less than a weaker one beside it, by more than the step \
         errors; first in row {harder}: {name} {to}, {from} in row {weaker}"
    ))
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
