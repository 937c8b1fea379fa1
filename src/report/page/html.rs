//! The page for a browser.

use std::ops::ControlFlow;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::answer::solve::Answer;
use crate::many::comparison::{Entry, leading};
use crate::plain_text::printable;
use crate::report::figure::{SCALE, here_and_in_the_limit, unusable};
use crate::report::format::{capital, percent};
use crate::report::page::content::{case, closing, inputs, mesh, rows, sources};
use crate::report::page::eye::{Picture, STYLE};
use crate::report::risks::{lines, silence};
use crate::report::sentence::{sentence, verdict};
use crate::report::{bone, look_for};
use crate::report::{compare::Table, page::charts, page::fundus};
use crate::run::{quantity::Quantity, watch::Watch};
use crate::scenario::{Scenario, load::to_ron};

/// Nothing is loaded from anywhere, whatever a name holds.
const RULES: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

pub fn page(entries: &[Entry], command: Option<&str>, watch: Watch) -> ControlFlow<(), String> {
    let mut blows = Vec::with_capacity(entries.len());
    for (done, entry) in entries.iter().enumerate() {
        watch(done as f64 / entries.len() as f64)?;
        blows.push(blow(entry));
    }
    let names: Vec<_> = entries.iter().map(|entry| printable(&entry.scenario.name)).collect();
    let whole = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(RULES);
                meta name="viewport" content="width=device-width";
                title { (names.join(", ")) " - contrecoup" }
                style { (PreEscaped(include_str!("page.css"))) (PreEscaped(STYLE)) }
            }
            body {
                @if entries.len() > 1 { (comparison(entries)) }
                @for blow in &blows { (blow) }
                footer {
                    @if let Some(command) = command { p { "The same again: " code { (command) } } }
                    ol { @for source in sources(entries) { li { (source) } } }
                    p { (closing()) }
                }
                script { (PreEscaped(include_str!("replay.js"))) }
            }
        }
    };
    ControlFlow::Continue(whole.into_string())
}

fn figure(caption: &str, chart: &charts::PageChart) -> Markup {
    html! {
        @if let Some(svg) = chart.svg() {
            figure {
                figcaption { (caption) }
                (PreEscaped(svg))
                @let names = chart.names();
                @if !names.is_empty() {
                    p.names { @for (name, colour) in names { span style=(colour) { "━ " (name) } " " } }
                }
            }
        }
    }
}

/// All blows in one table and one chart.
fn comparison(entries: &[Entry]) -> Markup {
    let table = Table::of(entries, &leading(entries, None));
    html! {
        section.comparison {
            h1 { "Side by side" }
            @for entry in entries {
                @if let Some(answer) = entry.answer() {
                    p.verdict {
                        strong { (printable(&entry.name)) } ": " (verdict(answer)) "."
                    }
                }
            }
            div.wide {
                table {
                    thead { tr {
                        th { "blow" }
                        @for (head, unit) in &table.heads {
                            th { (head) br; small { (unit) } }
                        }
                    } }
                    tbody { @for (name, cells) in &table.rows {
                        tr { th { (name) } @for cell in cells { td { (cell) } } }
                    } }
                }
            }
            @for note in &table.notes { p.note { (printable(note)) } }
            (figure("Force on the eye", &charts::drives(entries)))
        }
    }
}

/// One blow: what to believe, what moved, what came of it, and how far to trust that.
fn blow(entry: &Entry) -> Markup {
    let scenario = &entry.scenario;
    html! {
        section.blow {
            h1.sentence {
                @match entry.answer() {
                    None => (printable(&scenario.name)),
                    Some(answer) => (sentence(scenario, answer)),
                }
            }
            @match entry.answer() {
                None => p.flag { "No answer: " (printable(entry.refused().unwrap_or_default())) },
                Some(answer) => {
                    p.model { (mesh(answer, scenario)) }
                    p.case { (case(scenario)) }
                    @for (name, words) in lines(answer) { p.verdict { strong { (name) } ": " (words) } }
                    @if let Some(bone) = bone::line(answer) { p.verdict { (bone) } }
                    @if answer.silence().is_none() {
                        p.note { "In brackets: 8 of 10 of what it may be lie in it." }
                    }
                    @let look = look_for::lines(answer, &answer.risks(), scenario.eye_side());
                    @if !look.is_empty() {
                        h2 { "What to look for" }
                        @for (name, words) in look {
                            p.note { strong { (name) } ": " (words) }
                        }
                        p.note { (look_for::NOT_COMPUTED) }
                    }
                    @if let Some(why) = unusable(answer) { p.flag { (why) } }
                    @for flag in &answer.flags {
                        p.flag { strong { (flag.kind.name()) } ": " (flag.whole()) }
                    }
                    @let motion = charts::motion(answer);
                    div.columns {
                        div {
                            (eye(scenario, answer))
                            table.inputs { tbody { @for (label, text) in inputs(scenario) {
                                tr { th { (label) } td { (text) } }
                            } } }
                        }
                        div { (results(scenario, answer)) }
                    }
                    div.charts {
                        @if let (Some(sectors), Some(blow)) = (&answer.run.sectors, &answer.case.blow) {
                            (fundus::figure(sectors, &blow.points, scenario.eye_side()))
                        }
                        (figure("Forces", &charts::forces(answer)))
                        (figure(&capital(&motion.up), &motion))
                        (figure("Risk against what each tissue felt, and this blow on the curves",
                            &charts::injuries(answer)))
                    }
                    @if let Some(why) = silence(answer) { p.note { (why) } }
                }
            }
            details.screen { summary { "The scenario as a file" } pre { (to_ron(scenario)) } }
        }
    }
}

fn eye(scenario: &Scenario, answer: &Answer) -> Markup {
    let Some(picture) = Picture::of(answer) else { return html! {} };
    let time = format!("{:.3} ms", picture.time() * 1e3);
    let label = format!("The eye at {time}, when its apex is deepest");
    html! {
        figure.replay {
            figcaption {
                "The eye at " output { (time) }
                @if let Some(top) = scenario.top() { "; at the top: " (top) }
            }
            svg.eye viewBox=(picture.view_box()) role="img" aria-label=(label) { (picture.content()) }
            div.screen {
                button type="button" { "Play" }
                input type="range" min="0" aria-label="time";
            }
            script type="application/json" { (PreEscaped(picture.motion().to_string())) }
        }
    }
}

fn results(scenario: &Scenario, answer: &Answer) -> Markup {
    let balance = percent(answer.errors.energy_balance);
    html! {
        table {
            thead { tr {
                th { "result" } th { "value" } th {} th { "at" } th { "step ±" } th { "mesh ±" }
            } }
            tbody class=[answer.spoiled().map(|_| "raw")] { @for [name, value, unit, at, step, mesh] in rows(scenario, answer) {
                tr {
                    th { (name) } td { (value) } td.unit { (unit) } td.at { (at) }
                    td { (step) } td { (mesh) }
                }
            } }
        }
        @if let Some(limit) = here_and_in_the_limit(answer, Quantity::Damage) {
            p.note { "Damage index: " (limit) "." }
        }
        p.note { "Damage index: " (SCALE) "; no probability. Energy is balanced within " (balance) "; \
            - : no error is known." }
    }
}
