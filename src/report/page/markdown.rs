//! The page as Markdown: words and tables.

use std::io::{self, Write};

use crate::many::comparison::{Entry, leading};
use crate::plain_text::markdown;
use crate::report::figure::{SCALE, here_and_in_the_limit, unusable};
use crate::report::page::content::{closing, inputs, mesh, rows, sources};
use crate::report::risks::{lines, silence};
use crate::report::{compare::Table, sentence::sentence};
use crate::run::quantity::Quantity;

pub fn write(entries: &[Entry], command: Option<&str>, out: &mut dyn Write) -> io::Result<()> {
    if entries.len() > 1 {
        writeln!(out, "# Side by side\n")?;
        Table::of(entries, &leading(entries, None)).markdown(out)?;
        writeln!(out)?;
    }
    entries.iter().try_for_each(|entry| blow(entry, out))?;
    writeln!(out, "## Sources\n")?;
    sources(entries).iter().try_for_each(|source| writeln!(out, "- {}", markdown(source)))?;
    if let Some(command) = command {
        writeln!(out, "\nThe same again:\n\n    {command}")?;
    }
    writeln!(out, "\n{}", closing())
}

fn blow(entry: &Entry, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "# {}\n", markdown(&entry.scenario.name))?;
    let Some(answer) = entry.answer() else {
        let why = markdown(entry.refused().unwrap_or_default());
        return writeln!(out, "No answer: {why}\n");
    };
    writeln!(out, "{}\n", markdown(&sentence(&entry.scenario, answer)))?;
    writeln!(out, "{}\n", mesh(answer, &entry.scenario))?;
    for (name, words) in lines(answer) {
        writeln!(out, "- **{name}**: {}", markdown(&words))?;
    }
    if let Some(why) = unusable(answer) {
        writeln!(out, "- {}", markdown(&why))?;
    }
    for flag in &answer.flags {
        writeln!(out, "- FLAG `{}`: {}", flag.kind.name(), markdown(&flag.whole()))?;
    }
    writeln!(out, "\n| result | value | | at | step ± | mesh ± |\n|---|---:|---|---:|---:|---:|")?;
    for [name, value, unit, at, step, mesh] in rows(&entry.scenario, answer) {
        let [step, mesh] = [step, mesh].map(|error| markdown(&error));
        writeln!(out, "| {name} | {value} | {unit} | {at} | {step} | {mesh} |")?;
    }
    writeln!(out, "\nDamage index: {SCALE}; no probability.")?;
    if let Some(limit) = here_and_in_the_limit(answer, Quantity::Damage) {
        writeln!(out, "\nDamage index: {}.", markdown(&limit))?;
    }
    writeln!(out, "\n| input | value |\n|---|---|")?;
    for (label, text) in inputs(&entry.scenario) {
        writeln!(out, "| {label} | {} |", markdown(&text))?;
    }
    if let Some(why) = silence(answer) {
        writeln!(out, "\n{why}")?;
    }
    writeln!(out)
}
