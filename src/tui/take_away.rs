//! What is taken out of the app: a page as a file, and a summary on the clipboard.

use std::fmt;
use std::ops::ControlFlow;
use std::sync::Arc;

use crate::answer::solve::Answer;
use crate::many::comparison::Entry;
use crate::many::comparison::Found;
use crate::report::command::{arguments, line};
use crate::report::page::html;
use crate::report::summary;
use crate::run::refusal::Refusal;
use crate::run::watch::Watch;
use crate::scenario::Scenario;
use crate::tui::model::{Model, Shown};
use crate::tui::task::{Question, Report};
use crate::tui::update::Effect;

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
        return arguments(&work.source, work.original.as_ref()?, &work.scenario);
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
    let blows = answers
        .iter()
        .map(|(source, shown)| (source.clone(), shown.scenario.clone(), shown.answer.clone()))
        .collect();
    let question = WritePage {
        stem,
        blows,
        command,
    };
    model.page.ask(question, &mut model.out);
}

/// Asks for a page for a browser.
pub struct WritePage {
    /// What its file's name begins with.
    pub stem: String,
    /// Each blow: its source, what was simulated, and what came of it.
    pub blows: Vec<(String, Scenario, Arc<Answer>)>,
    /// What repeats the page, if anything does.
    pub command: Option<String>,
}

impl fmt::Debug for WritePage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a page {} of {} blows", self.stem, self.blows.len())
    }
}

impl Question for WritePage {
    type Answer = String;

    fn answer(&self, watch: Watch) -> Result<String, Refusal> {
        let mut entries = Vec::with_capacity(self.blows.len());
        for (source, scenario, answer) in &self.blows {
            entries.push(Entry {
                found: Found::Answer((**answer).clone()),
                ..Entry::new(source, scenario)
            });
        }
        match html::page(&entries, self.command.as_deref(), watch) {
            ControlFlow::Continue(page) => Ok(page),
            ControlFlow::Break(()) => Err(Refusal::Cancelled),
        }
    }
}

/// Has a page that is done put on the disk.
pub(super) fn hear(model: &mut Model, report: &mut Option<Report>) {
    if let Some((asked, outcome)) = model.page.hear(report) {
        match outcome {
            Some(page) => {
                let effect = Effect::Page(asked.stem.clone(), page.into_bytes());
                model.out.effects.push(effect);
            }
            None => model.notice = model.page.complaint.take().map(|(_, why)| why),
        }
    }
}

/// How far the page is, while one is being written.
pub(super) fn writing(model: &Model) -> Option<String> {
    let job = model.page.job.as_ref()?;
    Some(match job.question.blows.len() {
        1 => "writing a page".to_owned(),
        count => format!(
            "writing a page: blow {} of {count}",
            1 + (job.pace.unwrap_or_default().share() * count as f64).round() as usize
        ),
    })
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
    use crate::run::watch::unwatched;
    use crate::tui::simulation::Simulate;
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
        let (ticket, question) = asked::<WritePage>(&effects).unwrap();
        assert_eq!(writing(&model).unwrap(), "writing a page");
        let report = Report::done::<WritePage>(ticket, question.answer(&mut unwatched));
        let effects = update(&mut model, Message::News(report));
        assert_eq!(writing(&model), None);
        let Some(Effect::Page(stem, text)) = effects.first() else {
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
