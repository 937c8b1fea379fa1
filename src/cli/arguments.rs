//! The arguments that say what to simulate, shared by the commands that simulate.
//!
//! Values stay text here. The registry of fields reads them, so a flag, `--set` and a file refuse
//! the same values with the same words.

use std::io::{self, Write};
use std::mem::discriminant;
use std::path::Path;

use clap::Args;
use clap::error::{ContextKind, ContextValue};

use crate::cli::CliError;
use crate::many::threshold::usual;
use crate::plain_text::{self, printable, quoted};
use crate::scenario::{CheckedScenario, Impact, Integrator, Scenario, fields::LONGEST_NAME};
use crate::scenario::{library::resolve, load::read_text, locate::locate, problem::Problem};
use crate::scenario::{problem::ScenarioError, set::full_path, set::in_order};
use crate::scenario::{set::set_one_of_several, set::settle};

/// What to simulate: a preset or a file, and changes to it.
#[derive(Debug, Args)]
pub struct ScenarioArgs {
    /// A preset's name, or a file if it ends in .ron or holds a path separator; changed as in
    /// bb-62@40 (speed) or bb-62,offset_mm=3
    #[arg(value_name = "PRESET|FILE.ron")]
    pub source: String,
    #[command(flatten)]
    pub changes: Changes,
}

/// What to simulate: several presets or files, all changed alike.
#[derive(Debug, Args)]
pub struct ScenariosArgs {
    /// Presets' names, or files if they end in .ron or hold a path separator; each changed as in
    /// bb-62@40 (speed) or bb-62,offset_mm=3
    #[arg(value_name = "PRESET|FILE.ron", required = true)]
    pub sources: Vec<String>,
    #[command(flatten)]
    pub changes: Changes,
}

#[derive(Debug, Default, Args)]
pub struct Changes {
    /// Change one field, as in `impact.force_n=450`, or with its doubt, as in
    /// `impact.force_n="450 +- 20"`; may be repeated, the last one wins
    #[arg(long = "set", value_name = "FIELD=VALUE", value_parser = assignment)]
    pub assignments: Vec<(String, String)>,
    /// Mesh level, 1 to 8, of the Physiological model 1 to 5; short for `--set eye.level=K`
    #[arg(long, value_name = "K", allow_hyphen_values = true)]
    pub level: Option<String>,
    /// Integrator, as in velocity-verlet; short for `--set numerics.integrator=NAME`
    #[arg(long, value_name = "NAME", long_help = integrators())]
    pub integrator: Option<String>,
    /// Time step in microseconds; short for `--set numerics.step_us=X`
    #[arg(long, value_name = "X", allow_hyphen_values = true)]
    pub step_us: Option<String>,
}

fn integrators() -> String {
    let mut text = "Integrator; short for `--set numerics.integrator=NAME`\n".to_owned();
    for method in Integrator::ALL {
        let (name, about, order) = (method.name(), method.about(), method.order());
        let each = method.evaluations();
        let line = format!("{name}: {about} Order {order}; force evaluations a step: {each}.");
        text.extend(["\n- ", &line]);
    }
    text + "\n- auto: the program chooses."
}

/// Reads `FIELD=VALUE`; the value stays as typed.
fn assignment(typed: &str) -> Result<(String, String), &'static str> {
    let (path, text) =
        typed.split_once('=').ok_or("expected FIELD=VALUE, as in impact.force_n=450")?;
    Ok((path.trim().to_owned(), text.to_owned()))
}

impl ScenarioArgs {
    /// Loaded, then changed by every `--set` in order, then by the short flags; named for it.
    pub fn scenario(&self) -> Result<CheckedScenario, CliError> {
        self.changes.made_to(&self.source)
    }

    /// Where the scenario's file gives `field`, as `file:line:column`; nothing if a flag does.
    pub fn place_of(&self, field: &str) -> Option<String> {
        let by_flag = field == "numerics.step_us" && self.changes.step_us.is_some()
            || self.changes.assignments.iter().any(|(path, _)| field.contains(path));
        let source = with_own_changes(&self.source).0;
        let path = Path::new(source);
        if by_flag || !path.is_file() {
            return None;
        }
        let (line, column) = locate(&read_text(path).ok()?, field);
        Some(format!("{}:{line}:{column}", printable(source)))
    }
}

impl ScenariosArgs {
    /// Each scenario with what it was asked for by.
    pub fn scenarios(&self) -> Result<Vec<(String, CheckedScenario)>, CliError> {
        let one = |source: &String| Ok((source.clone(), self.changes.made_to(source)?));
        self.sources.iter().map(one).collect()
    }
}

impl Changes {
    /// The short flags that were given, each with the field that it changes and the value.
    pub fn short(&self) -> impl Iterator<Item = (&'static str, &'static str, &String)> {
        let all = [
            ("--level", "eye.level", &self.level),
            ("--integrator", "numerics.integrator", &self.integrator),
            ("--step-us", "numerics.step_us", &self.step_us),
        ];
        all.into_iter().filter_map(|(flag, path, text)| Some((flag, path, text.as_ref()?)))
    }

    fn made_to(&self, typed: &str) -> Result<CheckedScenario, CliError> {
        let (source, own) = with_own_changes(typed);
        let mut scenario = resolve(source)?;
        let set = self.assignments.iter();
        let set = set.map(|(path, text)| (format!("--set {path}={text}"), &path[..], &text[..]));
        let own = own.into_iter().map(|(path, text)| {
            let path = if path == AT { usual(&scenario).0 } else { path };
            (typed.to_owned(), path, text)
        });
        let before = discriminant(&scenario.impact);
        let mut asked: Vec<(String, &str, &str)> = set.chain(own).collect();
        in_order(&scenario, &mut asked, |(_, path, _)| path);
        let mut changes = Vec::new();
        for (flag, path, text) in &asked {
            let (full, before) = (full_path(&scenario, path), scenario.name.clone());
            assign(&mut scenario, flag, path, text)?;
            // A name that follows the change tells of it.
            if full == "name" || scenario.name == before {
                changes.push((full, text.trim()));
            }
        }
        for (flag, path, text) in self.short() {
            assign(&mut scenario, &format!("{flag} {text}"), path, text)?;
        }
        settle(&mut scenario);
        // The file by itself was sound, so what is wrong now comes from the flags together.
        let changed = format!("{source}, as the flags change it, cannot be computed");
        let scenario = scenario.check().map_err(|error| complaint(&changed, "", &error))?;
        // The name tells of the values as they were, so what was changed stands beside it.
        if changes.iter().any(|(path, _)| *path == "name") {
            return Ok(scenario);
        }
        let kind = discriminant(&scenario.impact);
        let name = match &scenario.impact {
            _ if kind == before => &scenario.name,
            // Nothing of what the name tells of hits the eye.
            Impact::ForcePulse(_) => "Force pulse",
            Impact::Projectile(_) => "Object",
        };
        let name = with_changes(name, &changes);
        Ok(scenario.renamed(name))
    }
}

/// Stands for the speed of an object, or the force of a pulse.
const AT: &str = "@";

/// A source and its own changes, as in `bb-62@40,offset_mm=3`; a file by its whole name has none.
fn with_own_changes(typed: &str) -> (&str, Vec<(&str, &str)>) {
    if Path::new(typed).is_file() {
        return (typed, Vec::new());
    }
    // A comma begins a change where a field and its value follow; else it is part of a value.
    let is_field = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | ' ');
    let begins =
        |rest: &str| rest.split_once('=').is_some_and(|(field, _)| field.chars().all(is_field));
    let commas = typed.match_indices(',').map(|(at, _)| at);
    let mut ends: Vec<usize> = commas.filter(|at| begins(&typed[at + 1..])).collect();
    ends.push(typed.len());
    let parts = ends.windows(2).filter_map(|at| typed[at[0] + 1..at[1]].split_once('='));
    let head = &typed[..ends[0]];
    let begins_speed = |text: &str| text.starts_with(|c: char| c.is_ascii_digit());
    match head.rsplit_once(AT).filter(|(name, text)| !name.is_empty() && begins_speed(text)) {
        Some((name, speed)) => (name, std::iter::once((AT, speed)).chain(parts).collect()),
        None => (head, parts.collect()),
    }
}

/// A name with what was set; only with how much, where that is too long for a name.
fn with_changes(name: &str, changes: &[(&str, &str)]) -> String {
    let each = changes.iter().map(|(path, text)| format!("; {path}={text}"));
    let all = name.to_owned() + &each.collect::<String>();
    if all.chars().count() <= LONGEST_NAME {
        return all;
    }
    let count = format!("; {} fields set", changes.len());
    let room = LONGEST_NAME - count.chars().count();
    name.chars().take(room).chain(count.chars()).collect()
}

fn assign(scenario: &mut Scenario, flag: &str, path: &str, text: &str) -> Result<(), CliError> {
    set_one_of_several(scenario, path, text).map_err(|error| complaint(flag, path, &error))
}

/// Led by the flag; the flag names its own field already.
fn complaint(flag: &str, path: &str, error: &ScenarioError) -> CliError {
    let flag = quoted(flag);
    complaints(error, |problem| match &problem.field {
        field if field == path => flag.clone(),
        field => format!("{flag}: {}", quoted(field)),
    })
}

/// One line a problem, led by what asked for it.
pub(super) fn complaints(error: &ScenarioError, lead: impl Fn(&Problem) -> String) -> CliError {
    let line = |p: &Problem| format!("{}: {}", lead(p), plain_text::message(&p.message));
    CliError::Input(plain_text::lines(error.problems.iter().map(line)))
}

/// Commands by the names that they had once.
const RENAMED: [(&str, &str); 6] = [
    ("coverage", "verify steps"),
    ("stability", "verify hard-cases"),
    ("validate", "verify experiments"),
    ("calibrate", "verify fit"),
    ("completions", "generate completions"),
    ("man", "generate man"),
];

/// Prints why arguments, which may hold anything, were refused, or the help that was asked for.
pub(super) fn explain(mut error: clap::Error) -> io::Result<()> {
    if let Some(ContextValue::String(typed)) = error.get(ContextKind::InvalidSubcommand)
        && let Some((_, now)) = RENAMED.iter().find(|(old, _)| old == typed)
    {
        let tip = format!("it is `contrecoup {now}` now");
        error.remove(ContextKind::SuggestedSubcommand);
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
    }
    let text = error.to_string();
    let lines = text.lines().map(plain_text::message);
    let safe = lines.collect::<Vec<_>>().join("\n") + "\n";
    // Only clap's own printing has its colours.
    if !error.use_stderr() || safe == text {
        return error.print();
    }
    io::stderr().write_all(safe.as_bytes())
}

/// A whole number from `low` to `high`.
pub(super) fn whole(low: u32, high: u32) -> impl Fn(&str) -> Result<u32, String> + Clone {
    move |text| {
        let number = text.parse().ok().filter(|number| (low..=high).contains(number));
        number.ok_or_else(|| format!("allowed {low} to {high}"))
    }
}

pub(super) fn positive(text: &str) -> Result<f64, &'static str> {
    let number = text.parse().ok().filter(|number: &f64| number.is_normal() && *number > 0.0);
    number.ok_or("expected a number of microseconds above 0")
}

pub(super) fn percent(text: &str) -> Result<f64, &'static str> {
    let number = positive(text.trim_end_matches('%').trim_end()).ok();
    number.filter(|number| *number <= 100.0).ok_or("expected a percentage above 0, up to 100")
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;
    use crate::cli::{Cli, Command};
    fn scenario(flags: &[&str]) -> Result<CheckedScenario, CliError> {
        changed("paper-300n", flags)
    }

    fn changed(source: &str, flags: &[&str]) -> Result<CheckedScenario, CliError> {
        let typed = ["contrecoup", "run", source];
        let cli = Cli::try_parse_from(typed.iter().chain(flags)).unwrap();
        let Some(Command::Run(args)) = cli.command else { panic!("run was asked for") };
        args.scenario.scenario()
    }

    #[test]
    fn settings_apply_in_order_and_short_flags_last() {
        let changed = scenario(&[
            "--level=3",
            "--set=eye.level=2",
            "--set=impact.force_n=1",
            "--set=impact.force_n=450",
            "--integrator=velocity-verlet",
            "--step-us=1.5",
            "--set=name=a = b",
        ])
        .unwrap();
        let pulse = changed.pulse().unwrap();
        assert_eq!((changed.eye.level, pulse.force_n), (3, 450.0));
        assert_eq!(changed.numerics.integrator, Some(Integrator::VelocityVerlet));
        assert_eq!(changed.numerics.step_us, Some(1.5));
        assert_eq!(changed.name, "a = b");
    }

    #[test]
    fn a_name_says_what_was_set_beside_it_and_stays_a_name() {
        let name = |set| scenario(&["--set", set]).unwrap().name.clone();
        assert_eq!(name("impact.force_n=450"), "450 N for 0.2 ms");
        assert_eq!(name("impact.angle_deg=5"), "300 N for 0.2 ms; impact.angle_deg=5");
        let many: Vec<String> = (0..9).map(|i| format!("--set=eye.lens_kpa={i}1")).collect();
        let many: Vec<&str> = many.iter().map(String::as_str).collect();
        let changed = scenario(&many).unwrap();
        assert_eq!(changed.name, "300 N for 0.2 ms; 9 fields set");
        changed.check().unwrap();
    }

    #[test]
    fn a_source_may_carry_its_speed_and_changes_of_its_own() {
        let both = ("bb-62", vec![("@", "40"), ("offset_mm", "3")]);
        assert_eq!(with_own_changes("bb-62@40,offset_mm=3"), both);
        let group = ("a.ron", vec![("impact.surface", "Inflated(kpa:1, modulus_mpa:2)")]);
        let typed = "a.ron,impact.surface=Inflated(kpa:1, modulus_mpa:2)";
        assert_eq!(with_own_changes(typed), group);
        for whole in ["bb-62", "@3", "me@home", "a,b", "a,b,c@d"] {
            assert_eq!(with_own_changes(whole), (whole, vec![]));
        }
        let of = |source| Changes::default().made_to(source);
        assert_eq!(of("squash-ball@30").unwrap().projectile().unwrap().speed_m_s, 30.0);
        assert_eq!(of("paper-300n@90").unwrap().pulse().unwrap().force_n, 90.0);
        let refused = of("squash-ball@900").unwrap_err();
        assert!(refused.to_string().starts_with("squash-ball@900: "), "{refused}");
    }

    #[test]
    fn two_settings_that_need_each_other_may_come_in_any_order() {
        // A word for a side means that of the eye.
        let (from, side) = ("--set=impact.from=Nose", "--set=eye_side=Left");
        for sets in [[from, side], [side, from]] {
            let bb = changed("bb-62", &sets).unwrap();
            assert_eq!(bb.projectile().unwrap().angle_clock, 9.0, "{sets:?}");
        }
        let (angle, opening) = ("--set=impact.angle_deg=60", "--set=eye.opening_deg=70");
        assert!(scenario(&[angle, opening]).is_ok() && scenario(&[opening, angle]).is_ok());
        assert!(scenario(&[angle]).is_err());
    }
}
