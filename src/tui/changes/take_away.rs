//! What is taken out of the app: a page as a file, and a summary on the clipboard.

use crate::report::command::{arguments, line};
use crate::report::first_page::in_three_lines;
use crate::tui::overlay::{Overlay, Prompt};
use crate::tui::shown::ShownAnswer;
use crate::tui::{model::AppModel, page::WritePage, request::Report};

/// An answer by the name of its source.
pub(crate) type Named<'a> = (String, &'a ShownAnswer);

/// Says why there is nothing to take, if so.
fn check(model: &AppModel, answers: &[Named]) -> Result<(), &'static str> {
    match model.stale() {
        _ if answers.is_empty() => Err("there is no answer yet"),
        Some(_) if answers.len() == 1 => Err("the answer to the last edit is not there yet"),
        _ => Ok(()),
    }
}

/// The arguments that repeat what is on show, if any do.
fn repeating(model: &AppModel, answers: &[Named]) -> Option<Vec<String>> {
    if let [(_, only)] = answers
        && only.scenario == model.work.scenario
    {
        let work = &model.work;
        return arguments(&work.source, work.original.as_ref()?, &work.scenario);
    }
    // Several are repeated by their names, where nothing was changed in them.
    let plain = |(name, shown): &Named| {
        let choice = model.choices.iter().find(|choice| choice.name == *name)?;
        (choice.scenario.as_ref().ok()? == &shown.scenario).then(|| name.clone())
    };
    answers.iter().map(plain).collect()
}

/// The question for a page of what is on show, into the folder that the app was opened in.
pub(crate) fn page(model: &AppModel, answers: &[Named]) -> Result<WritePage, &'static str> {
    if model.guest {
        return Err("a guest writes no files");
    }
    check(model, answers)?;
    let stem = if answers.len() > 1 { "comparison" } else { model.work.name() };
    let stem = stem.trim_end_matches(".ron").to_owned();
    let command = repeating(model, answers).map(|mut words| {
        words.extend(["-o".to_owned(), format!("{stem}.html")]);
        line("report", &words)
    });
    let blow =
        |(source, shown): &Named| (source.clone(), shown.scenario.clone(), shown.answer.clone());
    Ok(WritePage { stem, blows: answers.iter().map(blow).collect(), command })
}

/// Has a page that is done put on the disk.
pub(crate) fn take_report(model: &mut AppModel, report: &mut Option<Report>) {
    if let Some((asked, outcome)) = model.page.take_report(report) {
        match outcome {
            Some(page) => {
                let (stem, text) = (asked.stem.clone(), page.into_bytes());
                // A letter alone writes no file.
                model.overlay = Some(Overlay::Prompt(Prompt::Page(stem, text)));
            }
            None => model.notice = model.page.complaint.take().map(|(_, why)| why),
        }
    }
}

/// A summary of what is on show, and the command that repeats it.
pub(crate) fn summary(model: &AppModel, answers: &[Named]) -> Result<String, &'static str> {
    check(model, answers)?;
    let one = |answer: &Named| {
        let command = repeating(model, std::slice::from_ref(answer));
        let command = command.map(|words| line("run", &words));
        in_three_lines(&answer.1.scenario, &answer.1.answer, command.as_deref())
    };
    Ok(answers.iter().map(one).collect::<Vec<_>>().join("\n"))
}
