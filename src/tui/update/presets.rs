//! Opening a preset, and saving one of the person's own.

use tui_input::Input;

use super::{Effect, change};
use crate::scenario::load::to_ron;
use crate::tui::model::{Choice, Model, Overlay, Question, Work};
use crate::tui::open::MAX_OWN;
use crate::tui::save::{SaveError, check_name, free_name};

pub(crate) fn next_preset(model: &mut Model, forward: bool) {
    let count = model.choices.len();
    if count == 0 {
        return;
    }
    let here = model
        .choices
        .iter()
        .position(|choice| choice.name == model.work.source);
    let next = match here {
        Some(here) if forward => (here + 1) % count,
        Some(here) => (here + count - 1) % count,
        None => 0,
    };
    open(model, next);
}

pub(crate) fn open(model: &mut Model, index: usize) {
    let Some(choice) = model.choices.get(index) else {
        return;
    };
    match &choice.scenario {
        Ok(scenario) => {
            let work = Work::fresh(&choice.name, scenario);
            change(model, work, "");
        }
        Err(why) => model.form.complaint = Some(format!("{}: {why}", choice.name)),
    }
}

pub(crate) fn open_picker(model: &mut Model) {
    let here = model
        .choices
        .iter()
        .position(|choice| choice.name == model.work.source);
    model.overlay = Some(Overlay::Picker(here.unwrap_or(0)));
}

pub(crate) fn ask_for_name(model: &mut Model) {
    if model.guest {
        model.notice = Some("a guest saves nothing".to_owned());
        return;
    }
    let own = |choice: &&Choice| choice.name == model.work.source;
    let is_own = model
        .choices
        .iter()
        .find(own)
        .is_some_and(|choice| choice.origin == "own");
    let name = if is_own {
        model.work.source.clone()
    } else {
        let stem = model.work.name().trim_end_matches(".ron");
        free_name(stem, |name| model.choices.iter().any(|c| c.name == name))
    };
    model.overlay = Some(Overlay::SaveAs(Input::new(name), None));
}

pub(crate) fn save(model: &mut Model, name: String, replace: bool) {
    if let Err(error) = check_name(&name) {
        if let Some(Overlay::SaveAs(_, shown)) = &mut model.overlay {
            *shown = Some(error.to_string());
        }
        return;
    }
    let other = model.choices.iter().find(|choice| choice.name == name);
    if let Some(other) = other.filter(|_| !replace) {
        let question = match other.origin {
            "" => Question::Hide(name),
            _ => Question::Replace(name),
        };
        model.overlay = Some(Overlay::Question(question));
        return;
    }
    let own = model.choices.iter().filter(|choice| choice.origin == "own");
    if !replace && own.count() >= MAX_OWN {
        let full = format!("{MAX_OWN} presets of your own are there: remove one first");
        model.overlay = Some(Overlay::SaveAs(Input::new(name), Some(full)));
        return;
    }
    let mut scenario = model.work.scenario.clone();
    // A title that a preset brought along says what the preset was.
    if scenario.name == model.work.original.name && model.is_edited() {
        scenario.name.clone_from(&name);
    }
    model
        .out
        .effects
        .push(Effect::Save(name, to_ron(&scenario), replace));
}

pub(crate) fn saved(model: &mut Model, name: String, outcome: Result<(), SaveError>) {
    match outcome {
        Ok(()) => {
            model.overlay = None;
            model.notice = Some(format!("saved as {name}"));
            if model.work.scenario.name == model.work.original.name && model.is_edited() {
                model.work.scenario.name.clone_from(&name);
                if let Some(shown) = &mut model.shown {
                    shown.scenario.name.clone_from(&name);
                }
            }
            model.work = Work::fresh(&name, &model.work.scenario);
            // Whatever was remembered of a preset of that name differs from what it now holds.
            let saved = model.work.original.clone();
            model.history.amend(|work| {
                if work.source == name {
                    work.original = saved.clone();
                }
            });
        }
        Err(SaveError::Exists(name)) => {
            model.overlay = Some(Overlay::Question(Question::Replace(name)));
        }
        Err(error) => {
            let input = Input::new(name);
            model.overlay = Some(Overlay::SaveAs(input, Some(error.to_string())));
        }
    }
}
