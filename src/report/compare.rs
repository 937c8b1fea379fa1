//! A comparison as text of 80 columns, Markdown, CSV and JSON: a row for each blow, a column for
//! each result.
//!
//! Numbers for people have no digit finer than their errors of step and mesh allow; CSV and JSON
//! have all digits and every result, with the errors beside them.

use std::borrow::Borrow;
use std::cmp::Ordering;
use std::io::{self, Write};

use serde_json::{Value, json};

use crate::answer::solve::{Answer, Cut};
use crate::injury::{Injury, SIGNS, whole};
use crate::many::comparison::Entry;
use crate::many::falling::{Fall, falls, is_alike, strength};
use crate::plain_text::{cell as cell_text, markdown, printable};
use crate::report::figure::{Figure, cut_signs};
use crate::report::format::{WIDTH, block, paragraph, percent};
use crate::report::json::cut;
use crate::report::risks::cell as risk_cell;
use crate::report::sentence::verdict;
use crate::run::quantity::Quantity;

/// Narrowest column of a result.
const NARROWEST: usize = 8;
/// Widest name of a blow.
const WIDEST_NAME: usize = 20;

/// A comparison as people read it: heads of two lines, and rows of cells.
pub struct Table {
    /// The short name of each result and its unit.
    pub heads: Vec<(&'static str, &'static str)>,
    /// A name, and a cell for each head.
    pub rows: Vec<(String, Vec<String>)>,
    pub notes: Vec<String>,
    /// Flags, gravest injury or refusal of each row, in words.
    remarks: Vec<String>,
}

impl Table {
    pub fn of(entries: &[Entry], columns: &[Quantity]) -> Self {
        let results = columns.iter().map(|of| (of.row().short, of.row().unit));
        let heads: Vec<_> = results.chain([("step", "error"), ("mesh", "error")]).collect();
        let cells = |answer: &Answer| -> Vec<String> {
            let errors = [answer.errors.time_step_percent(), answer.errors.mesh_percent()];
            let errors = errors.map(|error| error.map_or_else(|| "?".to_owned(), percent));
            // A result with as many digits as its errors allow, a risk with its range.
            let cell = |of: &Quantity| {
                let figure = || Some(Figure::of(answer, *of)?.cell());
                risk_cell(answer, *of).or_else(figure).unwrap_or_else(|| "-".to_owned())
            };
            columns.iter().map(cell).chain(errors).collect()
        };
        let row = |entry: &Entry| {
            let none = || vec!["-".to_owned(); heads.len()];
            (printable(&entry.name).into_owned(), entry.answer().map_or_else(none, cells))
        };
        let remarks = |entry: &Entry| {
            let name = printable(&entry.name).into_owned();
            let refused = || entry.refused().map(str::to_owned);
            let flags = entry.answer().map_or(&[][..], |answer| &answer.flags).iter();
            let flags = flags.map(|f| format!("FLAG {}: {}", f.kind.name(), f.whole()));
            let first = entry.answer().map(verdict).or_else(refused);
            let all: Vec<String> = first.into_iter().chain(flags).collect();
            all.into_iter().map(move |remark| format!("{name}: {remark}"))
        };
        let answers = || entries.iter().filter_map(Entry::answer);
        let is_cut = |answer: &&Answer| columns.iter().any(|of| answer.cut(*of).is_some());
        let cut = answers().find(is_cut).map(|_| cut_signs(answers().filter(is_cut)));
        let notes = cut
            .into_iter()
            .map(str::to_owned)
            .chain(which_is_worse(entries))
            .chain(falling(entries))
            .collect();
        let rows = entries.iter().map(row).collect();
        Self { heads, rows, notes, remarks: entries.iter().flat_map(remarks).collect() }
    }

    /// Prints it in blocks that fit into 80 columns.
    pub fn text(&self, out: &mut dyn Write) -> io::Result<()> {
        let (shorts, units) = self.heads.iter().copied().unzip();
        let rows = self.rows.iter().map(|(name, cells)| {
            (name.as_str(), cells.iter().map(String::as_str).collect::<Vec<_>>())
        });
        let lines: Vec<_> = [("", shorts), ("", units)].into_iter().chain(rows).collect();
        let longest = lines.iter().map(|(name, _)| name.chars().count()).max();
        let name = longest.unwrap_or(0).min(WIDEST_NAME);
        let width = |at: usize| {
            let cells = lines.iter().map(|(_, cells)| cells[at].chars().count());
            cells.max().unwrap_or(0).max(NARROWEST) + 1
        };
        let widths: Vec<usize> = (0..self.heads.len()).map(width).collect();
        let mut first = 0;
        while first < widths.len() {
            let fits = |last: &usize| name + widths[first..*last].iter().sum::<usize>() <= WIDTH;
            let fitting = (first + 2..=widths.len()).take_while(fits).last();
            let last = fitting.unwrap_or(first + 1);
            if first > 0 {
                writeln!(out)?;
            }
            for (whole, cells) in &lines {
                let short: String = whole.chars().take(name).collect();
                write!(out, "{short:<name$}")?;
                for (cell, &wide) in cells[first..last].iter().zip(&widths[first..last]) {
                    write!(out, "{cell:>wide$}")?;
                }
                writeln!(out)?;
            }
            first = last;
        }
        if !(self.notes.is_empty() && self.remarks.is_empty()) {
            writeln!(out)?;
        }
        let mut remarks = self.notes.iter().chain(&self.remarks);
        remarks.try_for_each(|remark| paragraph(&printable(remark), out))?;
        writeln!(out)?;
        block(SIGNS, "", "", out)
    }

    pub fn markdown(&self, out: &mut dyn Write) -> io::Result<()> {
        let head = |(head, unit): &(&str, &str)| match *unit {
            "" => (*head).to_owned(),
            unit => format!("{head}, {unit}"),
        };
        let heads: Vec<String> = self.heads.iter().map(head).collect();
        writeln!(out, "| blow | {} |", heads.join(" | "))?;
        writeln!(out, "|---|{}", "---:|".repeat(heads.len()))?;
        for (name, cells) in &self.rows {
            let cells: Vec<String> = cells.iter().map(|cell| markdown(cell)).collect();
            writeln!(out, "| {} | {} |", markdown(name), cells.join(" | "))?;
        }
        writeln!(out)?;
        let mut remarks = self.notes.iter().chain(&self.remarks);
        remarks.try_for_each(|remark| writeln!(out, "- {}", markdown(remark)))?;
        writeln!(out, "\n{SIGNS}")
    }
}

/// From which chance on one is worse almost surely, and from which on probably; below it they are
/// as good as alike.
const SURELY: f64 = 0.9;
const PROBABLY: f64 = 0.7;

/// Which of several blows is worse, in words: the worst for each injury, and how sure that is
/// against the next; none where fewer than two tell any risk.
pub fn which_is_worse<A: Borrow<Answer>>(entries: &[Entry<A>]) -> Option<String> {
    let told = |entry: &&Entry<A>| entry.answer().is_some_and(|a| a.worse(a).is_some());
    let entries: Vec<&Entry<A>> = entries.iter().filter(told).collect();
    if entries.len() < 2 {
        return None;
    }
    // What is said, and of which injuries.
    let mut said: Vec<(String, Vec<&str>)> = Vec::new();
    for (at, injury) in Injury::ALL.iter().enumerate() {
        let told = |entry: &Entry<A>| Some(entry.answer()?.risk(*injury)?.hit.told);
        let mut sorted = entries.clone();
        sorted.sort_by(|a, b| told(b).partial_cmp(&told(a)).unwrap_or(Ordering::Equal));
        let [worst, next] = [0, 1].map(|place| sorted[place]);
        let chance = worst.answer()?.worse(next.answer()?)?[at];
        let [worst, next] = [worst, next].map(|entry| printable(brief(&entry.name)));
        let words = match chance {
            c if c >= SURELY => format!("{worst} is almost surely worst for "),
            c if c >= PROBABLY => format!("{worst} is probably worst for "),
            _ => {
                let two = if worst < next { [worst, next] } else { [next, worst] };
                format!("{} are about as bad for ", two.join(" and "))
            }
        };
        match said.iter_mut().find(|(known, _)| *known == words) {
            Some((_, injuries)) => injuries.push(injury.word()),
            None => said.push((words, vec![injury.word()])),
        }
    }
    let clause = |(words, injuries): &(String, Vec<&str>)| match injuries.as_slice() {
        all if all.len() == Injury::ALL.len() => format!("{words}all {} injuries", all.len()),
        [rest @ .., last] if !rest.is_empty() => format!("{words}{} and {last}", rest.join(", ")),
        one => format!("{words}{}", one.concat()),
    };
    Some(said.iter().map(clause).collect::<Vec<_>>().join("; ") + ".")
}

/// The name of a preset, or the last part of a file's path.
pub fn brief(source: &str) -> &str {
    source.rsplit(['/', '\\']).find(|part| !part.is_empty()).unwrap_or("")
}

/// Which blows do less than a weaker one that is the same otherwise, a line each.
fn falling(entries: &[Entry]) -> Vec<String> {
    let all: Vec<(&Entry, &Answer, f64)> = entries
        .iter()
        .filter_map(|entry| Some((entry, entry.answer()?, strength(&entry.scenario)?)))
        .collect();
    let of = |(entry, answer, most): &(&Entry, &Answer, f64)| {
        let is_weaker = |(other, _, less): &&(&Entry, &Answer, f64)| {
            less < most && is_alike(&other.scenario, &entry.scenario)
        };
        let (other, weaker, _) = all.iter().filter(is_weaker).max_by(|a, b| a.2.total_cmp(&b.2))?;
        let error = |of| Some(weaker.errors.time_step[of]? + answer.errors.time_step[of]?);
        let falls = falls((&weaker.results(), &answer.results()), error);
        let one = |fall: &Fall| {
            let [from, to] = [fall.risks.0, fall.risks.1].map(|risk| whole(0.01 * risk));
            format!("{} {to} after {from}", fall.injury.name())
        };
        let said: Vec<String> = falls.iter().map(one).collect();
        let [harder, weaker] = [&entry.name, &other.name].map(|name| printable(name));
        let said = said.join(", ");
        (!falls.is_empty()).then(|| {
            format!("{harder} is harder than {weaker} and does less to eyes hit so: {said}")
        })
    };
    all.iter().filter_map(of).collect()
}

/// Prints every result as CSV with its errors in %, then which were cut off, flags and refusal.
pub fn csv(entries: &[Entry], out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    let mut head = vec!["preset".to_owned(), "name".to_owned()];
    for key in Quantity::ALL.iter().map(|of| of.key()) {
        let errors = ["step", "mesh"].map(|of| format!("{key}_{of}_error_percent"));
        head.push(key.to_owned());
        head.extend(errors);
    }
    head.extend(["at_least", "not_final", "flags", "refused"].map(str::to_owned));
    writer.write_record(&head)?;
    for entry in entries {
        let mut record = vec![cell_text(&entry.name), cell_text(&entry.scenario.name)];
        let plain = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
        let answer = entry.answer();
        let errors = answer.map(|answer| &answer.errors);
        for &of in Quantity::ALL {
            let step = errors.and_then(|errors| errors.time_step[of]);
            let mesh = errors.and_then(|errors| errors.mesh.as_ref()?[of]);
            record.extend([answer.and_then(|answer| answer.result(of)), step, mesh].map(plain));
        }
        let cut = |how| answer.map_or_else(String::new, |answer| cut(answer, how).join(" "));
        record.extend([Cut::AtLeast, Cut::NotFinal].map(cut));
        let flags = answer.into_iter().flat_map(|answer| &answer.flags);
        let flags: Vec<&str> = flags.map(|flag| flag.kind.name()).collect();
        record.extend([flags.join(" "), cell_text(entry.refused().unwrap_or_default())]);
        writer.write_record(&record)?;
    }
    writer.flush()
}

/// The blows as JSON: the object of `run --json` for each.
pub fn json(entries: &[Entry]) -> Value {
    let one = |entry: &Entry| {
        let mut object = match entry.answer() {
            None => {
                json!({ "program": crate::report::program(), "scenario": entry.scenario, "refused": entry.refused() })
            }
            Some(answer) => crate::report::json::answer(&entry.scenario, answer, &[]),
        };
        object["preset"] = json!(entry.name);
        object
    };
    entries.iter().map(one).collect()
}
