//! What the command line prints, as a person reads it: help, results, lists and refusals.
//!
//! Every number is written `#`, so that no text changes when the physics does, only when its words
//! do.
//!
//! `INSTA_UPDATE=always cargo test --release --test program cli_text` takes what is printed now for
//! right.

use crate::program::program;
use clap::CommandFactory;
use contrecoup::cli::Cli;

/// What a command says: how it was called, how it ended, and what it printed where.
fn said(arguments: &[&str]) -> String {
    // The width of what is read is that of a terminal of 80 columns.
    let output = program(arguments).env("COLUMNS", "80").output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    let mut said = text(output.stdout);
    let complaint = text(output.stderr);
    if !complaint.is_empty() {
        said.extend(["--- to standard error\n", &complaint]);
    }
    if let Some(code) = output.status.code().filter(|code| *code != 0) {
        said.extend([format!("--- ends with {code}\n")]);
    }
    said
}

/// The text in which lines that go on are one, since how long numbers are decides where they break.
fn unbroken(text: &str) -> String {
    let goes_on = |line: &str| {
        let deep = line.len() - line.trim_start_matches(' ').len();
        deep == 4 || line.starts_with("stable up to")
    };
    let mut whole = String::new();
    for line in text.lines() {
        whole.push_str(if goes_on(line) { " " } else { "\n" });
        whole.push_str(if goes_on(line) { line.trim_start() } else { line });
    }
    whole.trim_start().to_owned() + "\n"
}

/// The text with every number as `#`, and gaps beside numbers as wide whatever the number.
fn without_figures(text: &str) -> String {
    let text = unbroken(text);
    let mut plain = String::new();
    let mut at = 0;
    while let Some(next) = text[at..].chars().next() {
        let gap = text[at..].len() - text[at..].trim_start_matches(' ').len();
        let number = figure(&text, at);
        if number > 0 {
            plain.push('#');
            at += number;
        } else if gap > 1 && (plain.ends_with('#') || figure(&text, at + gap) > 0) {
            plain += "  ";
            at += gap;
        } else {
            plain.push(next);
            at += next.len_utf8();
        }
    }
    // Whether an error is below what is worth a number is a figure too, and so is how wide it is.
    let mut plain = plain.replace("< #", "#").replace("<#", "#");
    for (gap, space) in [("  ±#", " ±#"), ("±# %  ", "±# % ")] {
        while plain.contains(gap) {
            plain = plain.replace(gap, space);
        }
    }
    plain
}

/// How long the number is that stands here: none within a word, as in `rk4` and `paper-300n`.
fn figure(text: &str, at: usize) -> usize {
    let digits = |at: usize| {
        let rest = &text[at..];
        rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len()
    };
    let after_digit = text[..at].ends_with(|c: char| c.is_ascii_digit());
    let sign = usize::from(text[at..].starts_with('-') && !after_digit);
    let mut before = text[..at].trim_end_matches(|c: char| c.is_ascii_digit()).chars().rev();
    let word = match before.next() {
        Some('-') => before.next().is_some_and(char::is_alphabetic),
        Some(before) => before.is_alphabetic(),
        None => false,
    };
    let mut end = at + sign;
    if word || digits(end) == 0 {
        return 0;
    }
    end += digits(end);
    for sign in [".", "e-", "e"] {
        if text[end..].starts_with(sign) {
            let more = digits(end + sign.len());
            end += if more > 0 { sign.len() + more } else { 0 };
        }
    }
    end - at
}

/// Compares what a command says with the file of this name.
fn compare(name: &str, arguments: &[&str], text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_omit_expression(true);
    settings.set_prepend_module_to_snapshot(false);
    settings.set_description(format!("contrecoup {}", arguments.join(" ")));
    settings.bind(|| insta::assert_snapshot!(name.to_owned(), text));
}

/// The same with what a command says, figures left out.
fn says(name: &str, arguments: &[&str]) {
    compare(name, arguments, &without_figures(&said(arguments)));
}

#[test]
fn figures_are_left_out_and_words_stay() {
    let text = "centre   12.40 N at 0.362 ms, step < 1.5e-4 %, -3 to 45-95 of\n    7 kJ/m2 by rk4";
    let plain = "centre  # N at # ms, step # %, # to #-# of # kJ/m2 by rk4\n";
    assert_eq!(without_figures(text), plain);
}

/// Help has no figures but those of its own: it is compared as it stands.
#[test]
fn help_of_the_program_and_of_every_command() {
    compare("help", &["--help"], &said(&["--help"]));
    for command in Cli::command().get_subcommands() {
        let name = command.get_name();
        let arguments = [name, "--help"];
        compare(&format!("help_{name}"), &arguments, &said(&arguments));
    }
}

#[test]
fn the_results_of_a_blow() {
    says("run_pulse", &["run", "paper-300n"]);
    says("run_projectile", &["run", "bb-56"]);
    says("run_pulse_all", &["run", "paper-300n", "--all"]);
    says("run_projectile_all", &["run", "bb-56", "--all"]);
    says("refused_one_alone", &["compare", "bb-56"]);
    says("refused_object_at_paper", &["run", "bb-56", "--set", "model=Paper"]);
}

#[test]
fn blows_side_by_side() {
    let of = ["compare", "paper-300n", "bb-56", "soccer-ball", "--set", "window_ms=0.3"];
    let risk = ["--sort", "globe_rupture_percent"];
    says("compare", &[&of[..], &risk].concat());
    says("compare_md", &[&of[..], &["--md"]].concat());
}

#[test]
fn thresholds() {
    let until = ["--until", "apex_displacement_mm = 2"];
    let of = ["threshold", "paper-300n", "--set", "window_ms=0.3", "--vary"];
    for (name, vary) in [
        ("threshold", "impact.force_n=50:800"),
        ("threshold_twice", "impact.angle_deg"),
        ("threshold_never", "impact.force_n=50:200"),
    ] {
        says(name, &[&of[..], &[vary], &until].concat());
    }
}

#[test]
fn what_is_not_allowed_is_refused_in_words() {
    let refused: [(&str, &[&str]); 8] = [
        ("nothing", &[]),
        ("unknown_command", &["jump"]),
        ("renamed_command", &["coverage"]),
        ("unknown_preset", &["run", "paper-30n"]),
        ("unknown_field", &["run", "paper-300n", "--set", "farce_n=1"]),
        ("out_of_range", &["run", "paper-300n", "--set", "impact.force_n=-1", "--level", "9"]),
        ("two_at_once", &["run", "paper-300n", "--tolerance", "1", "--level", "2"]),
        ("unfit_integrator", &["run", "bb-56", "--integrator", "rk4"]),
    ];
    for (name, arguments) in refused {
        compare(&format!("refused_{name}"), arguments, &said(arguments));
    }
    // How long a step may be comes from the mesh.
    says("refused_unstable_step", &["run", "paper-300n", "--step-us", "900"]);
}

#[test]
fn lists() {
    compare("presets", &["presets"], &said(&["presets"]));
    compare("guide", &["guide"], &said(&["guide"]));
}

/// What drives a result, strongest first, is a figure as well: the lines are sorted and have no
/// bars.
fn without_ranks(text: &str) -> String {
    let paragraphs = text.split("\n\n").map(|paragraph| {
        let mut lines: Vec<&str> = paragraph.lines().collect();
        if paragraph.starts_with("What drives") {
            lines[1..].sort_unstable();
        }
        let lines: Vec<&str> =
            lines.iter().map(|line| line.trim_end_matches(['█', '│', ' '])).collect();
        lines.join("\n")
    });
    paragraphs.collect::<Vec<String>>().join("\n\n")
}

#[test]
fn many_runs() {
    let short = ["--set", "window_ms=0.3"];
    let arguments = [&["ensemble", "paper-300n", "--samples", "8"], &short[..]].concat();
    let text = without_figures(&without_ranks(&said(&arguments)));
    compare("ensemble", &arguments, &text);
    let vary = ["--vary", "impact.force_n=100,300"];
    let arguments = [&["sweep", "paper-300n"], &vary[..], &short[..]].concat();
    let text = said(&arguments);
    let (mark, table) = text.split_once(" of ").unwrap();
    assert!(mark.starts_with("# contrecoup sweep "), "the hash of the command");
    // A sum of figures is a figure: the last cell of each row below the heading.
    let (heading, rows) = table.split_at(table.find("\n0,").unwrap());
    let rows = rows.lines().map(|row| row.rsplit_once(',').map_or(row, |(row, _)| row));
    let table = format!("{heading}{}", rows.collect::<Vec<_>>().join("\n"));
    compare("sweep", &arguments, &without_figures(&table));
}
