//! What is taken out of the app: a page as a file, and a summary on the clipboard.

use super::model::{Model, Shown};
use super::update::Effect;
use crate::report::command::{arguments, line};
use crate::report::page::{Form, write};
use crate::report::summary;
use crate::study::comparison::Entry;

/// Why there is nothing to take; nothing if there is.
fn obstacle(model: &Model) -> Option<&'static str> {
    let answers = (model.on_show().answers)(model);
    match model.stale() {
        _ if answers.is_empty() => Some("there is no answer yet"),
        Some(_) if answers.len() == 1 => Some("the answer to the last edit is not there yet"),
        _ => None,
    }
}

/// The arguments that repeat what is on show, if any do.
fn repeating(model: &Model, answers: &[(String, &Shown)]) -> Option<Vec<String>> {
    if let [(_, only)] = answers
        && only.scenario == model.work.scenario
    {
        let work = &model.work;
        return arguments(&work.source, &work.original, &work.scenario);
    }
    // Several are repeated by their names, where nothing was changed in them.
    let plain = |(name, shown): &(String, &Shown)| {
        let choice = model.choices.iter().find(|choice| choice.name == *name)?;
        (choice.scenario.as_ref().ok()? == &shown.scenario).then(|| name.clone())
    };
    answers.iter().map(plain).collect()
}

/// Writes what is on show as a page into the folder that the app was opened in.
pub(crate) fn page(model: &mut Model) {
    if model.guest {
        model.notice = Some("a guest writes no files".to_owned());
        return;
    }
    if let Some(why) = obstacle(model) {
        model.notice = Some(why.to_owned());
        return;
    }
    let answers = (model.on_show().answers)(model);
    let stem = if answers.len() > 1 {
        "comparison"
    } else {
        model.work.name()
    };
    let stem = stem.trim_end_matches(".ron").to_owned();
    let command = repeating(model, &answers).map(|mut words| {
        words.extend(["-o".to_owned(), format!("{stem}.html")]);
        line("report", &words)
    });
    let entries: Vec<Entry> = answers
        .iter()
        .filter_map(|(source, shown)| {
            Some(Entry {
                source: source.clone(),
                scenario: shown.scenario.check().ok()?,
                outcome: Ok((*shown.answer).clone()),
            })
        })
        .collect();
    let mut text = Vec::new();
    match write(Form::Html, &entries, command.as_deref(), &mut text) {
        Ok(()) => model.out.effects.push(Effect::Page(stem, text)),
        Err(error) => model.notice = Some(error.to_string()),
    }
}

/// Copies a summary and the command that repeats it.
pub(crate) fn copy(model: &mut Model) {
    if let Some(why) = obstacle(model) {
        model.notice = Some(why.to_owned());
        return;
    }
    let answers = (model.on_show().answers)(model);
    let one = |answer: &(String, &Shown)| {
        let command = repeating(model, std::slice::from_ref(answer));
        let command = command.map(|words| line("run", &words));
        summary::text(&answer.1.scenario, &answer.1.answer, command.as_deref())
    };
    let text = answers.iter().map(one).collect::<Vec<_>>().join("\n");
    model.out.effects.push(Effect::Copy(text));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::unwatched;
    use crate::tui::simulation::Simulate;
    use crate::tui::task::{Question, Report};
    use crate::tui::update::driven::{asked, letter, opened};
    use crate::tui::update::{Message, begin, update};

    /// Opened, and its answer there.
    fn answered() -> Model {
        let mut model = opened();
        let effects = begin(&mut model);
        let (ticket, question) = asked::<Simulate>(&effects).unwrap();
        let report = Report::done::<Simulate>(ticket, question.answer(&mut unwatched));
        update(&mut model, Message::News(report));
        model
    }

    #[test]
    fn a_page_and_a_summary_are_taken_of_an_answer_and_say_how_to_repeat_it() {
        let mut model = answered();
        let effects = letter(&mut model, 'w');
        let [Effect::Page(stem, text)] = &effects[..] else {
            panic!("{effects:?}")
        };
        let text = String::from_utf8(text.clone()).unwrap();
        assert_eq!(stem, "paper-300n");
        assert!(text.contains("contrecoup report paper-300n -o paper-300n.html"));
        let effects = letter(&mut model, 'y');
        let [Effect::Copy(text)] = &effects[..] else {
            panic!("{effects:?}")
        };
        assert!(text.ends_with("contrecoup run paper-300n\n"), "{text}");
    }

    #[test]
    fn nothing_is_taken_before_there_is_an_answer_and_no_file_by_a_guest() {
        let mut model = opened();
        assert!(letter(&mut model, 'w').is_empty());
        assert!(model.notice.as_ref().unwrap().contains("no answer yet"));
        let mut model = answered();
        model.guest = true;
        assert!(letter(&mut model, 'w').is_empty());
        assert!(model.notice.as_ref().unwrap().contains("guest"));
    }
}
