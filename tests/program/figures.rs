//! The figures in the README and in the guide are what the program prints.
//!
//! `FIGURES=all cargo test --release --test program figures` runs every command again and rewrites
//! its figures in place; names in place of `all`, as in `FIGURES=coverage,evidence`, rewrite only
//! those. Without `FIGURES` the tables are compared in form with what the program prints: the same
//! lines but for their numbers, which differ between machines.
//!
//! Left out: commands that take minutes or need a quiet machine are not run to compare; their rows
//! are named here, and rewriting fails if they are no longer printed.

use crate::renew;
use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use self::printed::{FIGURES, Figures, Form, form, printed};
use contrecoup::guide::{TOPICS, holds_here};
use contrecoup::scenario::fields::FIELDS;
use contrecoup::tui::app::tables;
use contrecoup::tui::keys;

mod printed;

const BEGIN: &str = "<!-- figures: ";
const END: &str = "<!-- end of figures -->\n";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every page with figures in it.
fn pages() -> Vec<PathBuf> {
    let guide = root().join("src/guide");
    let pages = TOPICS.iter().map(|topic| guide.join(topic.name).with_extension("md"));
    [root().join("README.md")].into_iter().chain(pages).collect()
}

fn read(page: &Path) -> String {
    fs::read_to_string(page).unwrap_or_else(|error| panic!("{}: {error}", page.display()))
}

/// The names of the blocks of a page, each with where its content begins and ends.
fn blocks(text: &str) -> Vec<(&str, std::ops::Range<usize>)> {
    let begins = text.match_indices(BEGIN);
    let block = |(at, _): (usize, &str)| {
        let name = &text[at + BEGIN.len()..];
        let (name, content) = name.split_once(" -->\n").expect("a name");
        let begin = text.len() - content.len();
        let end = begin + content.find(END).unwrap_or_else(|| panic!("{name} has no end"));
        (name, begin..end)
    };
    begins.map(block).collect()
}

/// The figures in the content of a block.
fn inner(content: &str) -> &str {
    let inside = content.strip_prefix("\n```text\n").and_then(|c| c.strip_suffix("```\n\n"));
    inside.unwrap_or_else(|| panic!("no block of text in\n{content}"))
}

fn find(name: &str) -> &'static Figures {
    let found = FIGURES.iter().find(|figures| figures.name == name);
    found.unwrap_or_else(|| panic!("nothing makes the figures {name}"))
}

/// The content of a block that is no figures but a list of the program's own, the same to the
/// letter.
fn list(name: &str) -> Option<String> {
    match name {
        "keys" => Some(keys::markdown(&tables::all()) + "\n"),
        "fields" => Some(format!("\n```text\n{}```\n\n", fields())),
        _ => None,
    }
}

/// Every field of a scenario, what it means and what it accepts, in 80 columns.
fn fields() -> String {
    const NAMES: usize = 30;
    let mut text = String::new();
    for field in FIELDS {
        let mut line = format!("{:<NAMES$}", field.path);
        for word in format!("{}: {}", field.help, field.allowed()).split(' ') {
            if line.chars().count() + 1 + word.chars().count() > 80 {
                text += &(line + "\n");
                line = " ".repeat(NAMES);
            }
            line = line + " " + word;
        }
        text += &(line + "\n");
    }
    text
}

/// Puts what the program prints now in the place of the figures that are asked for.
fn write_again(page: &Path, outputs: &mut Outputs) {
    let mut text = read(page);
    // From the end, so that the places before stay where they are.
    for (name, at) in blocks(&text.clone()).into_iter().rev() {
        if renew::is_asked(name) {
            let content = list(name).unwrap_or_else(|| {
                let figures = find(name);
                let found = (figures.excerpt)(outputs.of(figures.command));
                format!("\n```text\n{found}```\n\n")
            });
            text.replace_range(at, &content);
        }
    }
    if text != read(page) {
        fs::write(page, text).unwrap();
    }
}

/// What commands print, each of which is run once.
#[derive(Default)]
struct Outputs(HashMap<&'static str, String>);

impl Outputs {
    fn of(&mut self, command: &'static str) -> &str {
        self.0.entry(command).or_insert_with(|| printed(command))
    }
}

#[test]
fn figures_have_the_form_of_what_their_command_prints() {
    let mut outputs = Outputs::default();
    for page in pages() {
        write_again(&page, &mut outputs);
    }
    for page in pages() {
        let text = read(&page);
        for (name, at) in blocks(&text) {
            if let Some(list) = list(name) {
                let here = text[at].split_inclusive('\n').filter(|l| holds_here(l));
                assert_eq!(here.collect::<String>(), list, "the {name} are others now");
                continue;
            }
            let (figures, shown) = (find(name), inner(&text[at]));
            match figures.form {
                Form::Of(command) => {
                    let now = (figures.excerpt)(outputs.of(command));
                    assert_eq!(form(shown), form(&now), "{name} in {}", page.display());
                }
                Form::Rows(rows) => {
                    for row in rows() {
                        let found = shown.lines().any(|line| line.starts_with(row));
                        assert!(found, "{name} in {} lacks {row}", page.display());
                    }
                }
            }
        }
    }
}

#[test]
fn all_figures_stand_somewhere() {
    let texts: Vec<String> = pages().iter().map(|page| read(page)).collect();
    let shown = |figures: &&Figures| {
        let mut names = texts.iter().flat_map(|text| blocks(text));
        !names.any(|(name, _)| name == figures.name)
    };
    let left_over: Vec<&str> = FIGURES.iter().filter(shown).map(|f| f.name).collect();
    assert_eq!(left_over, [] as [&str; 0]);
}

#[test]
fn a_form_keeps_words_and_units_but_no_digits() {
    let rows = "apex   2.157 mm  at 0.2 ms\nindex  26 %";
    assert_eq!(form(rows), form("apex 0.1 mm at < 1.5e-3 ms\nindex - %"));
    for other in [
        "apex 2.157 m at 0.2 ms\nindex 26 %",
        "apex 2.157 mm\nindex 26 %",
        "apex 2.157 mm at 0.2 ms",
    ] {
        assert_ne!(form(rows), form(other));
    }
}

#[test]
fn what_the_benchmark_prints_is_read_without_running_it() {
    let name = "one answer with its step error, wall";
    let others = "plain Verlet within 0.1 %: 0.755 us, the same";
    let end = "process start to end, median";
    let printed = format!(
        "{name:<62}{:>9.3} ms\n{others:<62}{:>9.3} ms{:>12.4} %\n{end:<62}{:>9.3} ms\n\n\
         | target | ratio | wanted | met |\n|---|---|---|---|\n\
         | a run | 15.151 | at least 12.0 | yes |\n| another | 1.500 | at most 1.250 | no |\n",
        1.5, 12.672, 0.0887, 3.9
    );
    let whole = (find("speed").excerpt)(&printed);
    let lines: Vec<&str> = whole.lines().collect();
    assert!(lines.iter().all(|line| line.len() <= 80), "{whole}");
    assert_eq!(lines.len(), 7);
    assert!(lines[1].starts_with(others) && lines[1].ends_with("12.672 ms      0.0887 %"));
    assert!(lines[5].ends_with("15.151 >= 12.0") && lines[6].ends_with("1.500 <= 1.250 !"));
    let short = (find("speed-in-short").excerpt)(&printed);
    assert_eq!(short.lines().count(), 3);
    assert!(short.contains("plain Verlet within 0.1 %  "));
}

#[test]
fn the_readme_is_short_and_its_links_lead_somewhere() {
    let text = read(&root().join("README.md"));
    assert!(text.lines().count() <= 250, "{} lines", text.lines().count());
    let links = text.match_indices("](").map(|(at, _)| {
        let rest = &text[at + 2..];
        &rest[..rest.find(')').expect("a link ends")]
    });
    for link in links.filter(|link| !link.contains("://")) {
        assert!(root().join(link).exists(), "{link}");
    }
}

#[test]
fn caution_is_said_once() {
    let text = read(&root().join("README.md"));
    let words: Vec<&str> = text.split_whitespace().collect();
    assert_eq!(words.join(" ").matches("not diagnosis").count(), 1);
}

#[test]
fn every_command_that_the_readme_names_is_one() {
    let text = read(&root().join("README.md"));
    let help = printed("contrecoup --help");
    let known: Vec<&str> = help.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let named = text.split('`').filter_map(|code| code.strip_prefix("contrecoup "));
    for command in named.filter_map(|code| code.split_whitespace().next()) {
        assert!(command.starts_with('-') || known.contains(&command), "{command}");
    }
}
