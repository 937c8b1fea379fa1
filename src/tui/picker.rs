//! The list of everything that can be opened: what is shown for what is typed, in which order.

use crate::scenario::library::{self, Origin};
use crate::scenario::problem::{ALIKE, likeness, plain};
use crate::scenario::{Impact, Scenario};
use crate::tui::line::TextLine;

/// A preset, or a scenario that was given on the command line.
#[derive(Debug, Clone)]
pub struct Choice {
    /// What the list shows, and what opens it.
    pub name: String,
    /// What it holds, or why it cannot be used.
    pub scenario: Result<Scenario, String>,
    /// Where it comes from, in a word.
    pub origin: &'static str,
}

/// The origin of the last blow, as it was left: on top of the list at the start, and only then.
pub const LAST: &str = "last";
/// The most presets of a person's own that the app holds and saves.
pub const MAX_OWN: usize = 1000;

/// Every preset that can be opened; a broken one says why it cannot.
pub fn choices() -> Vec<Choice> {
    let (mut choices, mut own) = (Vec::new(), 0);
    for preset in library::list().unwrap_or_else(|_| library::built_in()) {
        let is_own = matches!(preset.origin, Origin::User(_));
        own += usize::from(is_own);
        if !is_own || own <= MAX_OWN {
            let scenario = preset.scenario().map_err(|error| error.to_string());
            let origin = if is_own { "own" } else { "" };
            choices.push(Choice { name: preset.name, scenario, origin });
        }
    }
    if own > MAX_OWN {
        let unlisted = "presets of your own; `contrecoup presets` lists all";
        let scenario = Err(format!("the app lists {MAX_OWN} {unlisted}"));
        let name = format!("({} more)", own - MAX_OWN);
        choices.push(Choice { name, scenario, origin: "own" });
    }
    choices
}

/// Rows of a page.
pub const PAGE: i16 = 10;

/// The list with what is typed to search it.
#[derive(Default)]
pub struct Picker {
    /// What is searched for.
    pub input: TextLine,
    /// The row with the cursor.
    pub row: usize,
    /// The places in the list of choices that are shown, the first on top.
    pub shown: Vec<usize>,
    /// Whether it asks what hit the eye, as it does at the start.
    pub first: bool,
    /// The names that are marked already, where it marks what it finds.
    pub marked: Option<Vec<String>>,
}

impl Picker {
    /// Everything, the cursor on the choice of this name.
    pub fn at(choices: &[Choice], name: &str) -> Self {
        let mut picker = Self::default();
        picker.search(choices);
        let here = picker.shown.iter().position(|at| choices[*at].name == name);
        Self { row: here.unwrap_or(0), ..picker }
    }

    /// Shows what fits to what is typed, the cursor on the first.
    pub fn search(&mut self, choices: &[Choice]) {
        self.row = 0;
        self.shown = (0..choices.len()).collect();
        self.shown.sort_by_key(|at| rank(&choices[*at]));
        let words: Vec<&str> = self.typed().0.split_whitespace().collect();
        if words.is_empty() {
            return;
        }
        let near = |at: &usize| Some((nearness(&words, &text(&choices[*at]))?, *at));
        // Who types a name wants the preset, not what was made of it.
        let presets = self.shown.iter().filter(|at| choices[**at].origin != LAST);
        let mut found: Vec<(f64, usize)> = presets.filter_map(near).collect();
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        self.shown = found.into_iter().map(|(_, at)| at).collect();
    }

    /// What is searched for, and the speed or force behind an `@`: of several the last.
    pub fn typed(&self) -> (&str, Option<&str>) {
        parts(self.input.value()).last().map_or(("", None), |part| named(part))
    }

    /// Several that are typed at once, as [`Self::typed`] has one: parted by commas, or by spaces
    /// where more than one has an `@`; nothing where it is one.
    pub fn several(&self) -> Vec<(&str, Option<&str>)> {
        let parts = parts(self.input.value());
        if parts.len() > 1 { parts.into_iter().map(named).collect() } else { Vec::new() }
    }

    /// The place of the choice that a name finds first.
    pub fn place(choices: &[Choice], name: &str) -> Option<usize> {
        let mut picker = Self { input: TextLine::of(name.to_owned()), ..Self::default() };
        picker.search(choices);
        picker.shown.first().copied()
    }

    /// The choice with the cursor.
    pub fn chosen<'a>(&self, choices: &'a [Choice]) -> Option<&'a Choice> {
        choices.get(*self.shown.get(self.row)?)
    }

    /// Moves the cursor by so many rows.
    pub fn move_cursor(&mut self, by: isize) {
        self.row = self.row.saturating_add_signed(by).min(self.shown.len().saturating_sub(1));
    }
}

/// The names in a text, each with what stands behind it.
fn parts(text: &str) -> Vec<&str> {
    let comma = |c: char| matches!(c, ',' | ';');
    let parts: Vec<&str> = match text.matches('@').count() {
        2.. if !text.contains(comma) => text.split_whitespace().collect(),
        _ => text.split(comma).collect(),
    };
    parts.into_iter().map(str::trim).filter(|part| !part.is_empty()).collect()
}

/// A name, and the speed or force behind an `@`.
fn named(text: &str) -> (&str, Option<&str>) {
    match text.split_once('@') {
        Some((name, strength)) => (name.trim(), Some(strength.trim()).filter(|it| !it.is_empty())),
        None => (text, None),
    }
}

/// What comes first.
fn rank(choice: &Choice) -> u8 {
    match (&choice.scenario, choice.origin) {
        (_, LAST) => 0,
        (_, "own") => 1,
        (_, "file") => 2,
        (Ok(scenario), _) if matches!(scenario.impact, Impact::Projectile(_)) => 3,
        _ => 4,
    }
}

/// What is searched.
fn text(choice: &Choice) -> String {
    let title = choice.scenario.as_ref().map_or("", |s| s.name.as_str());
    format!("{} {title}", choice.name)
}

/// How near a text is to all words that are typed; none where it has nothing like one of them.
fn nearness(words: &[&str], text: &str) -> Option<f64> {
    let text = text.to_lowercase();
    let near = |word: &&str| {
        let word = word.to_lowercase();
        let best = text.split([' ', '-']).map(|part| likeness(&word, part)).fold(0.0, f64::max);
        let score = if text.contains(&word) { 1.0 + best } else { best };
        (score > ALIKE).then_some(score)
    };
    words.iter().map(near).sum()
}

/// Mass, size and speed of what flies; of a force the force, nothing and how long it acts.
pub fn facts(scenario: &Scenario) -> [String; 3] {
    let with = |value: f64, unit: &str| format!("{} {unit}", plain(value));
    match &scenario.impact {
        Impact::Projectile(projectile) => [
            with(projectile.mass_g, "g"),
            with(projectile.diameter_mm, "mm"),
            with(projectile.speed_m_s, "m/s"),
        ],
        Impact::ForcePulse(pulse) => {
            [with(pulse.peak_n(), "N"), String::new(), with(pulse.duration_ms, "ms")]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> Vec<String> {
        let choices = choices();
        let mut picker = Picker { input: TextLine::of(text.to_owned()), ..Picker::default() };
        picker.search(&choices);
        picker.shown.iter().map(|at| choices[*at].name.clone()).collect()
    }

    #[test]
    fn what_is_typed_finds_its_preset_first() {
        for typed in ["squash", "squash ball", "SQUASH", "sqsh", "squish"] {
            assert_eq!(found(typed)[0], "squash-ball", "{typed}");
        }
        for (typed, first) in [
            ("paper 300", "paper-300n"),
            ("bb 92", "bb-92"),
            ("air soft 75", "airsoft-75"),
            ("cork", "champagne-cork"),
            ("cork@30", "champagne-cork"),
        ] {
            assert_eq!(found(typed)[0], first, "{typed}");
        }
        assert!(found("zzzqqq").is_empty());
    }

    #[test]
    fn several_names_are_parted_by_commas_or_by_their_speeds() {
        let typed = |text: &str| {
            let picker = Picker { input: TextLine::of(text.to_owned()), ..Picker::default() };
            let several = picker.several().into_iter();
            several.map(|(name, at)| format!("{name}/{}", at.unwrap_or("-"))).collect::<Vec<_>>()
        };
        let three = ["squash ball/30", "paintball/80", "bb/-"];
        assert_eq!(typed("squash ball@30, paintball@80 ; bb"), three);
        assert_eq!(typed("squash@30 paintball@80"), ["squash/30", "paintball/80"]);
        assert!(typed("squash ball@30").is_empty() && typed("squash@30,").is_empty());
    }

    #[test]
    fn objects_come_before_forces_and_ones_own_before_both() {
        let mut choices = choices();
        let mut own = choices[0].clone();
        own.origin = "own";
        own.name = "zebra".to_owned();
        choices.push(own);
        let picker = Picker::at(&choices, "nowhere");
        let ranks: Vec<u8> = picker.shown.iter().map(|at| rank(&choices[*at])).collect();
        assert!(ranks.is_sorted() && ranks[0] == 1 && ranks.contains(&3) && ranks.contains(&4));
        assert_eq!(picker.chosen(&choices).unwrap().name, "zebra");
    }

    #[test]
    fn the_last_blow_stands_on_top_and_is_not_what_a_name_finds() {
        let mut choices = choices();
        let squash = choices.iter().find(|choice| choice.name == "squash-ball").unwrap().clone();
        choices.insert(0, Choice { name: "squash-ball@30".to_owned(), origin: LAST, ..squash });
        let mut picker = Picker::at(&choices, "");
        assert_eq!(picker.chosen(&choices).unwrap().name, "squash-ball@30");
        picker.input = TextLine::of("squash".to_owned());
        picker.search(&choices);
        assert_eq!(picker.chosen(&choices).unwrap().name, "squash-ball");
    }
}
