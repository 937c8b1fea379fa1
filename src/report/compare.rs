//! A comparison as text of 80 columns, Markdown, CSV and JSON: a row for each blow, a column for
//! each result.
//!
//! Numbers for people have no digit finer than their errors of step and mesh allow; CSV and JSON
//! have all digits and every result, with the errors beside them.

use std::io::{self, Write};

use serde_json::{Value, json};

use crate::answer::solve::{Answer, Cut};
use crate::injury::SIGNS;
use crate::many::comparison::Entry;
use crate::plain_text::{cell as cell_text, markdown, printable};
use crate::report::figure::{Figure, cut_signs};
use crate::report::format::{WIDTH, paragraph, percent, wrapped};
use crate::report::json::cut;
use crate::report::risks::{first_line, legend, range};
use crate::run::quantity::Quantity;

/// Narrowest column of a result.
const NARROWEST: usize = 8;
/// Widest name of a blow.
const WIDEST_NAME: usize = 20;

/// A comparison as people read it: heads of two lines, and rows of cells.
pub struct Table {
    /// The short name of each result.
    pub heads: Vec<String>,
    /// The unit of each result.
    pub units: Vec<&'static str>,
    /// A name, and a cell for each head.
    pub rows: Vec<(String, Vec<String>)>,
    /// Notes on the whole table.
    pub notes: Vec<String>,
    /// Flags, gravest injury or refusal of each row, in words.
    pub remarks: Vec<String>,
}

/// A result with as many digits as its errors allow, a risk as a range.
fn cell(answer: &Answer, of: Quantity) -> String {
    let figure = || Figure::of(answer, of).map(|figure| figure.cell());
    let cell = range(answer, of).or_else(figure);
    cell.unwrap_or_else(|| "-".to_owned())
}

impl Table {
    /// The table of these columns.
    pub fn of(entries: &[Entry], columns: &[Quantity]) -> Self {
        let mut heads: Vec<String> = columns.iter().map(|of| of.row().short.to_owned()).collect();
        heads.extend(["step".to_owned(), "mesh".to_owned()]);
        let mut units: Vec<&'static str> = columns.iter().map(|of| of.row().unit).collect();
        units.extend(["error", "error"]);
        let row = |entry: &Entry| {
            let cells = match entry.answer() {
                None => vec!["-".to_owned(); heads.len()],
                Some(answer) => {
                    let mut cells: Vec<String> =
                        columns.iter().map(|of| cell(answer, *of)).collect();
                    let errors = &answer.errors;
                    for error in [errors.time_step_percent(), errors.mesh_percent()] {
                        cells.push(error.map_or_else(|| "?".to_owned(), percent));
                    }
                    cells
                }
            };
            (printable(&entry.name).into_owned(), cells)
        };
        let remark = |entry: &Entry| {
            let remarks = match entry.answer() {
                None => entry.refused().map(str::to_owned).into_iter().collect(),
                Some(answer) => {
                    // The gravest injury comes first.
                    let first = first_line(answer);
                    let flags = answer.flags.iter();
                    let flags = flags.map(|f| format!("FLAG {}: {}", f.kind.name(), f.whole()));
                    std::iter::once(first).chain(flags).collect::<Vec<_>>()
                }
            };
            let name = printable(&entry.name).into_owned();
            remarks.into_iter().map(move |remark| format!("{name}: {remark}"))
        };
        let answers: Vec<(&str, &Answer)> = entries
            .iter()
            .filter_map(|entry| Some((entry.name.as_str(), entry.answer()?)))
            .collect();
        let is_cut = |answer: &&Answer| columns.iter().any(|of| answer.cut(*of).is_some());
        let cut = || answers.iter().map(|(_, answer)| *answer).filter(is_cut);
        let cut = cut().next().map(|_| cut_signs(cut()).to_owned());
        let bb = legend(answers.iter().map(|(_, answer)| *answer)).map(str::to_owned);
        Self {
            rows: entries.iter().map(row).collect(),
            notes: cut.into_iter().chain(bb).collect(),
            remarks: entries.iter().flat_map(remark).collect(),
            units,
            heads,
        }
    }

    /// Prints it in blocks that fit into 80 columns.
    pub fn text(&self, out: &mut dyn Write) -> io::Result<()> {
        let longest = self.rows.iter().map(|(name, _)| name.chars().count()).max();
        let name = longest.unwrap_or(0).min(WIDEST_NAME);
        let width = |at: usize| {
            let cells = self.rows.iter().map(|(_, cells)| cells[at].chars().count());
            let heads = [self.heads[at].chars().count(), self.units[at].len()];
            cells.chain(heads).max().unwrap_or(0).max(NARROWEST) + 1
        };
        let mut first = 0;
        while first < self.heads.len() {
            let mut last = first;
            let mut wide = name;
            while last < self.heads.len() && (last == first || wide + width(last) <= WIDTH) {
                wide += width(last);
                last += 1;
            }
            let line = |name_cell: &str, cell: &dyn Fn(usize) -> String| {
                let short: String = name_cell.chars().take(name).collect();
                let cells = (first..last).map(|at| format!("{:>1$}", cell(at), width(at)));
                format!("{short:<name$}{}", cells.collect::<String>())
            };
            if first > 0 {
                writeln!(out)?;
            }
            writeln!(out, "{}", line("", &|at| self.heads[at].clone()))?;
            writeln!(out, "{}", line("", &|at| self.units[at].to_owned()))?;
            for (name, cells) in &self.rows {
                writeln!(out, "{}", line(name, &|at| cells[at].clone()))?;
            }
            first = last;
        }
        if !(self.notes.is_empty() && self.remarks.is_empty()) {
            writeln!(out)?;
        }
        for remark in self.notes.iter().chain(&self.remarks) {
            paragraph(&printable(remark), out)?;
        }
        writeln!(out)?;
        wrapped(SIGNS, WIDTH).iter().try_for_each(|line| writeln!(out, "{line}"))
    }

    /// Prints it as Markdown.
    pub fn markdown(&self, out: &mut dyn Write) -> io::Result<()> {
        let units = self.heads.iter().zip(&self.units);
        let heads: Vec<String> = units
            .map(|(head, unit)| match *unit {
                "" => head.clone(),
                unit => format!("{head}, {unit}"),
            })
            .collect();
        writeln!(out, "| blow | {} |", heads.join(" | "))?;
        writeln!(out, "|---|{}", "---:|".repeat(heads.len()))?;
        for (name, cells) in &self.rows {
            let cells: Vec<String> = cells.iter().map(|cell| markdown(cell)).collect();
            writeln!(out, "| {} | {} |", markdown(name), cells.join(" | "))?;
        }
        writeln!(out)?;
        for remark in self.notes.iter().chain(&self.remarks) {
            writeln!(out, "- {}", markdown(remark))?;
        }
        writeln!(out, "\n{SIGNS}")
    }
}

/// Prints it as CSV: every result with its errors in %, then those that are at least so large,
/// flags and refusal.
pub fn csv(entries: &[Entry], out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    let mut head = vec!["preset".to_owned(), "name".to_owned()];
    for of in Quantity::ALL {
        let key = of.key();
        head.extend([
            key.to_owned(),
            format!("{key}_step_error_percent"),
            format!("{key}_mesh_error_percent"),
        ]);
    }
    head.extend(["at_least", "not_final", "flags", "refused"].map(str::to_owned));
    writer.write_record(&head)?;
    for entry in entries {
        let mut record = vec![cell_text(&entry.name), cell_text(&entry.scenario.name)];
        let plain = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
        let answer = entry.answer();
        for &of in Quantity::ALL {
            let errors = answer.map(|answer| &answer.errors);
            record.push(plain(answer.and_then(|answer| answer.result(of))));
            record.push(plain(errors.and_then(|errors| errors.time_step[of])));
            record.push(plain(errors.and_then(|errors| errors.mesh.as_ref()?[of])));
        }
        for how in [Cut::AtLeast, Cut::NotFinal] {
            record.push(answer.map_or_else(String::new, |answer| cut(answer, how).join(" ")));
        }
        let flags = answer.map_or(&[][..], |answer| &answer.flags);
        let flags: Vec<&str> = flags.iter().map(|flag| flag.kind.name()).collect();
        record.push(flags.join(" "));
        record.push(cell_text(entry.refused().unwrap_or_default()));
        writer.write_record(&record)?;
    }
    writer.flush()
}

/// The blows as JSON: the object of `run --json` for each.
pub fn json(entries: &[Entry]) -> Value {
    let one = |entry: &Entry| {
        let mut object = match entry.answer() {
            None => json!({ "scenario": entry.scenario, "refused": entry.refused() }),
            Some(answer) => crate::report::json::answer(&entry.scenario, answer, &[]),
        };
        object["preset"] = json!(entry.name);
        object
    };
    entries.iter().map(one).collect()
}
