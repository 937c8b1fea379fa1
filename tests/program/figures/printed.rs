//! Where the figures of the README and the guide come from, and what of an output is its form.

use std::process::Command;

use contrecoup::verify::experiments::EXPERIMENTS;
use contrecoup::verify::hard_cases::cases;

/// A block of figures that stands in the README or in the guide.
pub struct Figures {
    /// What the block is called there.
    pub name: &'static str,
    /// What prints it.
    pub command: &'static str,
    /// What its form is compared with.
    pub form: Form,
    /// What of the output is shown.
    pub excerpt: fn(&str) -> String,
}

/// What a form is compared with.
pub enum Form {
    /// The output of a command of less work.
    Of(&'static str),
    /// How some of its lines begin, where running the command would take long.
    Rows(fn() -> Vec<&'static str>),
}

const COVERAGE: &str = "contrecoup verify steps";
const FEW: Form = Form::Of("contrecoup verify steps --scenes 8");
const ACCURACY: &str = "contrecoup accuracy paper-300n";
const SHORT: Form = Form::Of("contrecoup accuracy paper-300n --set window_ms=0.2");
const ACCURACY_OF_AXISYMMETRIC: &str = "contrecoup accuracy bb-62";
const SHORT_OF_AXISYMMETRIC: Form = Form::Of("contrecoup accuracy bb-62 --set window_ms=0.1");
/// To run them again takes half a minute, which tests/experiments.rs does.
const EXPERIMENT_ROWS: fn() -> Vec<&'static str> = || EXPERIMENTS.iter().map(|e| e.what).collect();
const VALIDATE: &str = "contrecoup verify experiments";
const CLINICS: &str = "contrecoup verify fit";
const BENCH: &str = "cargo bench --bench speed";

/// Rows of the benchmark that answer how long one waits.
const ANSWERS: [&str; 3] = [
    "one answer with its step error, wall",
    "plain Verlet within 0.1 %",
    "process start to end, median",
];

/// Targets of the benchmark that every machine has.
const TARGETS: [&str; 8] = [
    "a spring at level 1 against 5, whole eye",
    "a spring at level 1 against 5, mirrored half",
    "plain within 0.1 % against one run alone",
    "plain within 0.1 % against the run of an answer",
    "plain at its limit against one run alone",
    "a scene among many, throughput per core against an answer",
    "a scene among many, throughput per core against one run alone",
    "process start to printed result against the solve",
];

const WIRE: [&str; 5] = [
    "screen 1, 16 colours",
    "screen 2, 16 colours",
    "ssh, replay, colours never",
    "ssh, replay, colours 16",
    "ssh, replay, colours 256",
];

/// All of them.
pub static FIGURES: &[Figures] = &[
    Figures {
        name: "run",
        command: "contrecoup run squash-ball",
        form: Form::Of("contrecoup run squash-ball"),
        excerpt: |text| {
            only(text, |line| !line.starts_with("Pain, ") && !line.starts_with("today; "))
        },
    },
    Figures { name: "coverage", command: COVERAGE, form: FEW, excerpt: str::to_owned },
    Figures {
        name: "coverage-in-short",
        command: COVERAGE,
        form: FEW,
        excerpt: |text| before(&from(text, "      "), "\nClaims"),
    },
    Figures {
        name: "mesh-coverage",
        command: "contrecoup verify meshes",
        form: Form::Rows(|| vec!["result ", "damage index ", "peak force, top ", "scene "]),
        excerpt: str::to_owned,
    },
    Figures {
        name: "object-coverage",
        command: "contrecoup verify objects",
        form: Form::Rows(|| vec!["result ", "damage index ", "rebound speed ", "scene "]),
        excerpt: str::to_owned,
    },
    Figures {
        name: "clinic-points",
        command: CLINICS,
        form: Form::Rows(|| vec!["all ", "airsoft ", "rubber-round ", "eyes differ "]),
        excerpt: |text| before(text, "\nseries "),
    },
    Figures {
        name: "clinic-scores",
        command: CLINICS,
        form: Form::Rows(|| vec!["Mean ln ", "first rows, ", "more rows, "]),
        excerpt: |text| from(text, "Mean ln "),
    },
    Figures {
        name: "laboratory-fit",
        command: "contrecoup verify fit laboratory",
        form: Form::Rows(|| vec!["globe rupture ", "hyphema ", "  BB 4.5 mm ", "  foam 12.4 mm "]),
        excerpt: str::to_owned,
    },
    Figures {
        name: "tolerance",
        command: "contrecoup verify tolerance",
        form: Form::Rows(|| vec!["asked for ", "50 % ", "20 % ", "10 % ", "5.0 % ", "2.0 % "]),
        excerpt: str::to_owned,
    },
    Figures { name: "methods", command: ACCURACY, form: SHORT, excerpt: methods },
    Figures { name: "meshes", command: ACCURACY, form: SHORT, excerpt: meshes },
    Figures {
        name: "axisymmetric-methods",
        command: ACCURACY_OF_AXISYMMETRIC,
        form: SHORT_OF_AXISYMMETRIC,
        excerpt: methods,
    },
    Figures {
        name: "axisymmetric-meshes",
        command: ACCURACY_OF_AXISYMMETRIC,
        form: SHORT_OF_AXISYMMETRIC,
        excerpt: meshes,
    },
    Figures {
        name: "hard-cases",
        command: "contrecoup verify hard-cases",
        form: Form::Rows(|| cases().iter().map(|case| case.name).collect()),
        excerpt: str::to_owned,
    },
    Figures {
        name: "evidence",
        command: VALIDATE,
        form: Form::Rows(EXPERIMENT_ROWS),
        excerpt: |text| before(text, "Research"),
    },
    Figures {
        name: "evidence-in-short",
        command: VALIDATE,
        form: Form::Rows(EXPERIMENT_ROWS),
        excerpt: |text| only(&before(text, "\nEach row"), |line| !is_note(line)),
    },
    Figures {
        name: "doubt",
        command: "contrecoup ensemble paper-300n --set 'impact.force_n=300 +- 20' --samples 1000",
        form: Form::Of(
            "contrecoup ensemble paper-300n --set 'impact.force_n=300 +- 20' --samples 16",
        ),
        excerpt: |text| before(text, "\nDrawn from"),
    },
    Figures {
        name: "speed",
        command: BENCH,
        form: Form::Rows(|| TARGETS.to_vec()),
        excerpt: bench,
    },
    Figures {
        name: "speed-in-short",
        command: BENCH,
        form: Form::Rows(|| ANSWERS.to_vec()),
        excerpt: answers,
    },
    Figures {
        name: "wire",
        command: "cargo test --release --test app budget -- --nocapture",
        form: Form::Rows(|| WIRE.to_vec()),
        excerpt: wire,
    },
];

/// What a command prints, run in the folder of the project.
pub fn printed(command: &str) -> String {
    let words = shell_words::split(command).unwrap();
    let program = match words[0].as_str() {
        "contrecoup" => env!("CARGO_BIN_EXE_contrecoup"),
        "cargo" => env!("CARGO"),
        other => panic!("{other} is not run here"),
    };
    let output = Command::new(program)
        .args(&words[1..])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .env("XDG_CONFIG_HOME", "/nonexistent")
        // Figures are renewed by one process alone.
        .env_remove("FIGURES")
        .output()
        .unwrap();
    assert!(output.status.success(), "{command}: {output:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// What stands before the first line that begins with `end`, which is led by a line break.
fn before(text: &str, end: &str) -> String {
    let at = text.find(end).unwrap_or_else(|| panic!("no {end:?} in\n{text}"));
    format!("{}\n", text[..at].trim_end())
}

/// From the first line on that begins with `begin`.
fn from(text: &str, begin: &str) -> String {
    let lines: Vec<&str> = text.lines().skip_while(|line| !line.starts_with(begin)).collect();
    assert!(!lines.is_empty(), "no {begin:?} in\n{text}");
    lines.join("\n") + "\n"
}

/// Of a measured accuracy the integrators over their steps, at level 1.
fn methods(text: &str) -> String {
    let rows = before(&from(text, "  level "), "\nThe cheapest");
    only(&rows, |line| {
        line.starts_with("  level")
            || line.starts_with("* no")
            || line[1..].trim().starts_with("1 ")
    })
}

/// And the mesh levels.
fn meshes(text: &str) -> String {
    before(&from(text, "level "), "\n  level ")
}

fn only(text: &str, keep: impl Fn(&&str) -> bool) -> String {
    text.lines().filter(keep).map(|line| line.to_owned() + "\n").collect()
}

/// Where the benchmark begins its figures.
const NAMES: usize = 62;

/// The rows of the benchmark that answer how long one waits.
fn answers(text: &str) -> String {
    let rows = ANSWERS.iter().map(|name| {
        let row = text.lines().find(|line| line.starts_with(name));
        let row = row.unwrap_or_else(|| panic!("no {name} in\n{text}"));
        format!("{name:<40}{}\n", &row[NAMES..])
    });
    rows.collect()
}

/// What the benchmark prints, in 80 columns; `!` where a target is missed.
fn bench(text: &str) -> String {
    let line = |line: &str| match line.split('|').map(str::trim).collect::<Vec<_>>()[..] {
        [_, name, ratio, wanted, met, _] => {
            let wanted = wanted.replace("at most", "<=").replace("at least", ">=");
            let missed = if met == "no" { " !" } else { "" };
            let line = format!("{name:<NAMES$}{ratio:>6} {wanted}{missed}");
            // What divides the head of a table in Markdown is not needed here.
            if name.starts_with("--") { None } else { Some(line) }
        }
        _ if line.ends_with(['s', '%']) && line.len() > NAMES => {
            let (name, figures) = line.split_at(NAMES);
            Some(format!("{:<52}{figures}", name.trim_end()))
        }
        _ => Some(line.to_owned()),
    };
    let lines: Vec<String> = text.lines().filter_map(line).collect();
    lines.join("\n") + "\n"
}

/// What the tests of the wire print; other tests end on the same line.
fn wire(text: &str) -> String {
    let row = |line: &str| {
        let begin = WIRE.iter().find_map(|row| line.find(row))?;
        Some(line[begin..].replace(", 80x24:", ":").replace("on the wire with -C", "with ssh -C"))
    };
    let mut lines: Vec<String> = text.lines().filter_map(row).collect();
    lines.sort_by_key(|line| WIRE.iter().position(|row| line.starts_with(row)));
    lines.join("\n") + "\n"
}

/// Whether a line says more of those above it, or remarks on their figures.
fn is_note(line: &str) -> bool {
    let more = line.strip_prefix("    ");
    more.is_some_and(|rest| rest.starts_with(char::is_alphabetic)) || line.starts_with("! ")
}

/// The lines of a table, in any order, since some are ordered by their figures: words and units as
/// they are, `#` for a number or a verdict. Notes and the list of claims that did not hold depend
/// on the figures and are left out.
pub fn form(text: &str) -> Vec<String> {
    let is_list = |line: &&str| line.starts_with("Claims that") || line.starts_with("Every claim");
    let lines = text.lines().take_while(|line| !is_list(line));
    let lines = lines.filter(|line| !line.trim().is_empty() && !is_note(line));
    let mut forms: Vec<String> = lines.map(line_form).collect();
    forms.sort_unstable();
    forms
}

fn line_form(line: &str) -> String {
    const VERDICTS: [&str; 5] = ["accurate", "flagged", "refused", "yes", "NO"];
    let line = line.replace("not predictable", "refused");
    let is_number = |word: &str| {
        let bare = word.trim_start_matches('<').trim_end_matches([',', ':', '!', '/']);
        bare.parse::<f64>().is_ok() || word == "-" || VERDICTS.contains(&word)
    };
    let is_mark = |word: &str| word.chars().all(|c| "*<█│".contains(c));
    let words = line.split_whitespace().filter(|word| !is_mark(word));
    let words = words.map(|word| if is_number(word) { "#" } else { word });
    words.collect::<Vec<&str>>().join(" ")
}
