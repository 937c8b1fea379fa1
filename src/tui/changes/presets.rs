//! Opening a preset, and saving, renaming and removing one of the person's own.

use crate::scenario::load::to_ron;
use crate::tui::overlay::{Naming, Overlay, Prompt};
use crate::tui::picker::{Choice, LAST, MAX_OWN, Picker};
use crate::tui::save::{SaveError, check_name, free_name};
use crate::tui::work::Work;
use crate::tui::{changes::edit::change, line::TextLine, model::AppModel, outbox::Effect};

pub(crate) fn next_preset(model: &mut AppModel, forward: bool) {
    let count = model.choices.len();
    let here = model.choices.iter().position(|choice| choice.name == model.work.source);
    let next = |here: usize| (here + if forward { 1 } else { count - 1 }) % count;
    open(model, here.map_or(0, next));
}

pub(crate) fn open(model: &mut AppModel, index: usize) {
    let Some(choice) = model.choices.get(index) else { return };
    match &choice.scenario {
        Ok(scenario) => {
            let work = Work::fresh(&choice.name, scenario);
            let left = model.is_edited().then(|| model.work.name().to_owned());
            change(model, work, "");
            if let Some(left) = left.filter(|_| !model.is_edited()) {
                model.notice = Some(format!("u brings back your changes to {left}"));
            }
        }
        Err(why) => model.form.complaint = Some(format!("{}: {why}", choice.name)),
    }
}

pub(crate) fn open_picker(model: &mut AppModel) {
    open_picker_at(model, &model.work.source.clone());
}

/// The last blow is on the list at the start only: from then on it is what is worked on.
pub(crate) fn forget_last(model: &mut AppModel) {
    model.choices.retain(|choice| choice.origin != LAST);
}

/// Opens the list with the cursor on the preset of this name.
pub(crate) fn open_picker_at(model: &mut AppModel, name: &str) {
    model.overlay = Some(Overlay::Picker(Picker::at(&model.choices, name)));
}

/// The presets that can be opened are these now.
pub(crate) fn replace_choices(model: &mut AppModel, choices: Vec<Choice>) {
    model.choices = choices;
    if let Some(Overlay::Picker(picker)) = &mut model.overlay {
        let row = picker.row;
        picker.search(&model.choices);
        picker.row = row.min(picker.shown.len().saturating_sub(1));
    }
}

/// The name of the preset with the cursor, if it is the person's own; else says that it stays.
fn own_chosen(model: &mut AppModel) -> Option<String> {
    let Some(Overlay::Picker(picker)) = &model.overlay else { return None };
    let choice = picker.chosen(&model.choices)?;
    let name = choice.name.clone();
    if choice.origin == "own" && check_name(&name).is_ok() {
        return Some(name);
    }
    model.notice = Some(format!("{name} is no preset of your own: it stays as it is"));
    None
}

pub(crate) fn ask_to_remove(model: &mut AppModel) {
    if let Some(name) = own_chosen(model) {
        model.overlay = Some(Overlay::Prompt(Prompt::Remove(name)));
    }
}

pub(crate) fn ask_to_rename(model: &mut AppModel) {
    if let Some(name) = own_chosen(model) {
        ask_name(model, Naming::Rename(name.clone()), name, None);
    }
}

/// Asks for a name: with one that is offered, and what is wrong with it.
pub(crate) fn ask_name(model: &mut AppModel, naming: Naming, name: String, error: Option<String>) {
    model.overlay = Some(Overlay::Name(naming, TextLine::of(name), error));
}

pub(crate) fn rename(model: &mut AppModel, from: String, to: String) {
    if to == from {
        open_picker_at(model, &from);
        return;
    }
    let is_there = model.choices.iter().any(|choice| choice.name == to);
    let taken = is_there.then(|| format!("there is a preset {to} already"));
    match check_name(&to).err().map(|error| error.to_string()).or(taken) {
        None => model.out.effects.push(Effect::Rename(from, to)),
        error => ask_name(model, Naming::Rename(from), to, error),
    }
}

pub(crate) fn renamed(
    model: &mut AppModel,
    from: &str,
    to: String,
    outcome: Result<(), SaveError>,
) {
    if let Err(error) = outcome {
        return ask_name(model, Naming::Rename(from.to_owned()), to, Some(error.to_string()));
    }
    let follow = |work: &mut Work| {
        if work.source == from {
            work.source.clone_from(&to);
            for scenario in std::iter::once(&mut work.scenario).chain(&mut work.original) {
                if scenario.name == from {
                    scenario.name.clone_from(&to);
                }
            }
        }
    };
    follow(&mut model.work);
    model.answered.iter_mut().for_each(follow);
    model.history.amend(follow);
    if let Some(choice) = model.choices.iter_mut().find(|choice| choice.name == from) {
        choice.name.clone_from(&to);
    }
    if let Some(shown) = model.shown.as_mut().filter(|shown| shown.scenario.name == from) {
        shown.scenario.name.clone_from(&to);
    }
    model.notice = Some(format!("renamed to {to}"));
    open_picker_at(model, &to);
}

pub(crate) fn removed(model: &mut AppModel, name: String, outcome: Result<String, SaveError>) {
    match outcome {
        Ok(text) => {
            // What is worked on keeps its name, and is saved nowhere.
            let leave = |work: &mut Work| {
                if work.source == name {
                    work.original = None;
                }
            };
            leave(&mut model.work);
            model.answered.iter_mut().for_each(leave);
            model.history.amend(leave);
            model.choices.retain(|choice| choice.name != name);
            model.notice = Some(format!("removed {name}: Esc, then u brings it back"));
            model.removed.push((model.history.depth().0, name, text));
        }
        Err(error) => model.notice = Some(error.to_string()),
    }
    open_picker(model);
}

pub(crate) fn ask_for_name(model: &mut AppModel) {
    if model.guest {
        model.notice = Some("a guest saves nothing".to_owned());
        return;
    }
    // What is one's own already is offered in its own place.
    let is_other = |c: &Choice| c.origin != "own" || c.name != model.work.source;
    let others = model.choices.iter().filter(|choice| is_other(choice));
    let stem = model.work.name().trim_end_matches(".ron");
    let name = free_name(stem, |name| others.clone().any(|c| c.name == name));
    ask_name(model, Naming::Save, name, None);
}

pub(crate) fn save(model: &mut AppModel, name: String, replace: bool) {
    if let Err(error) = check_name(&name) {
        if let Some(Overlay::Name(_, _, shown)) = &mut model.overlay {
            *shown = Some(error.to_string());
        }
        return;
    }
    if !replace {
        if let Some(other) = model.choices.iter().find(|choice| choice.name == name) {
            let question = if other.origin.is_empty() { Prompt::Hide } else { Prompt::Replace };
            model.overlay = Some(Overlay::Prompt(question(name)));
            return;
        }
        if model.choices.iter().filter(|choice| choice.origin == "own").count() >= MAX_OWN {
            let full = format!("{MAX_OWN} presets of your own are there: remove one first");
            return ask_name(model, Naming::Save, name, Some(full));
        }
    }
    let mut scenario = model.work.scenario.clone();
    if model.work.is_outgrown() {
        scenario.name.clone_from(&name);
    }
    model.out.effects.push(Effect::Save(name, to_ron(&scenario), replace));
}

pub(crate) fn saved(model: &mut AppModel, name: String, outcome: Result<(), SaveError>) {
    match outcome {
        Ok(()) => {
            model.overlay = None;
            model.notice = Some(format!("saved as {name}; p lists, renames and removes it"));
            if model.work.is_outgrown() {
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
                    work.original.clone_from(&saved);
                }
            });
        }
        Err(SaveError::Exists(name)) => {
            model.overlay = Some(Overlay::Prompt(Prompt::Replace(name)));
        }
        Err(error) => ask_name(model, Naming::Save, name, Some(error.to_string())),
    }
}
