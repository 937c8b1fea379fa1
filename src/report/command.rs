//! The command that repeats a blow: what it began as, and every field that is not as it was there.

use std::borrow::Cow;

use crate::scenario::{Scenario, fields::FIELDS, set::set};

/// The arguments after the subcommand: the source, and `--set` for each field that differs from it.
/// `None` where no such list gives the scenario, as for a curve that was recorded.
pub fn arguments(source: &str, original: &Scenario, scenario: &Scenario) -> Option<Vec<String>> {
    let mut arguments = vec![source.to_owned()];
    let mut built = original.clone();
    for field in FIELDS.iter().filter(|field| field.path != "name") {
        let wanted = field.text(scenario);
        let Some(text) = wanted.filter(|text| field.text(&built).as_ref() != Some(text)) else {
            continue;
        };
        set(&mut built, field.path, &text).ok()?;
        arguments.extend(["--set".to_owned(), format!("{}={text}", field.path)]);
    }
    // The name says what was set, and nothing follows from it.
    let named = Scenario { name: scenario.name.clone(), ..built };
    let checked = |scenario: &Scenario| scenario.check().map(Scenario::from).ok();
    (named == *scenario || checked(&named) == Some(scenario.clone())).then_some(arguments)
}

/// The whole command as a shell takes it.
pub fn line(subcommand: &str, arguments: &[String]) -> String {
    let words = ["contrecoup", subcommand].into_iter().chain(arguments.iter().map(String::as_str));
    words.map(quoted).collect::<Vec<_>>().join(" ")
}

/// A word as a shell takes it: braces, which some of them expand, are quoted too.
fn quoted(word: &str) -> Cow<'_, str> {
    match shell_words::quote(word) {
        bare if bare == word && word.contains(['{', '}', '~', '!', '^']) => {
            format!("'{word}'").into()
        }
        quoted => quoted,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::library::{built_in, tests::preset};

    #[test]
    fn what_was_set_on_any_preset_is_said_and_set_again_gives_the_same() {
        let sets = [
            ("impact.angle_deg", "12"),
            ("model", "Physiological"),
            ("model.sclera_mpa", "20 +- 3"),
            ("window_ms", "2"),
        ];
        for built_in in built_in() {
            let scenario = preset(&built_in.name, &sets);
            let said = arguments(&built_in.name, &preset(&built_in.name, &[]), &scenario).unwrap();
            let pairs = said[1..].chunks(2).map(|pair| pair[1].split_once('=').unwrap());
            let again = preset(&built_in.name, &pairs.collect::<Vec<_>>());
            assert_eq!(again, scenario, "{said:?}");
        }
    }

    #[test]
    fn an_unchanged_preset_is_its_name_alone_and_odd_words_are_quoted() {
        let bb = preset("bb-56", &[]);
        let said = arguments("my blow.ron", &bb, &bb).unwrap();
        assert_eq!(line("run", &said), "contrecoup run 'my blow.ron'");
        assert_eq!(line("run", &["{a,b}.ron".to_owned()]), "contrecoup run '{a,b}.ron'");
        // From another preset it is said whole or not at all.
        let said = arguments("paper-300n", &preset("paper-300n", &[]), &bb);
        assert!(said.is_none_or(|said| said.contains(&"impact=Projectile".to_owned())));
    }
}
