//! What the keys do that belong to no single screen.

use crate::plain_text::quoted;
use crate::run::trace::Trace;
use crate::scenario::{Scenario, set::set};
use crate::tui::changes::{edit, presets, simulation, take_away, threshold, typing};
use crate::tui::outbox::Effect;
use crate::tui::overlay::{Naming, Overlay, Prompt};
use crate::tui::picker::{Choice, LAST, Picker};
use crate::tui::{app::App, clock::Moment, form::strength, model::AppModel};

/// Queues an effect for the disk, the clipboard, the terminal or a worker.
pub(crate) fn push(app: &mut App, effect: Effect) {
    app.model.out.effects.push(effect);
}

/// Listens to the mouse, or no longer.
pub(crate) fn toggle_mouse(app: &mut App) {
    let model = &mut app.model;
    model.mouse = !model.mouse;
    app.dragging = false;
    let word = if model.mouse { "on" } else { "off" };
    model.notice = Some(format!("mouse {word}"));
    model.out.effects.push(Effect::Mouse(model.mouse));
}

/// Computes ahead while nothing else is wanted, or no longer.
pub(crate) fn toggle_idle(app: &mut App) {
    let model = &mut app.model;
    model.idle = !model.idle;
    let ahead = ["off: nothing is", "on: mesh error and bands are"][usize::from(model.idle)];
    model.notice = Some(format!("idle work {ahead} computed ahead"));
}

/// Leaves, after a question if work would be lost.
pub(crate) fn quit(app: &mut App) {
    let model = &mut app.model;
    if model.is_edited() {
        model.overlay = Some(Overlay::Prompt(Prompt::Quit(model.goes_on)));
    } else {
        model.out.effects.push(Effect::Quit(0));
    }
}

pub(crate) fn help(app: &mut App) {
    let model = &mut app.model;
    let is_shown = matches!(model.overlay, Some(Overlay::Help(_)));
    model.overlay = (!is_shown).then_some(Overlay::Help(0));
}

/// Moves by so many rows through the list in front of the screen.
pub(crate) fn scroll(app: &mut App, by: i16) {
    match &mut app.model.overlay {
        Some(Overlay::Help(line)) => *line = line.saturating_add_signed(by),
        Some(Overlay::Change(what)) => what.go(isize::from(by)),
        Some(Overlay::Picker(picker)) => picker.move_cursor(isize::from(by)),
        _ => {}
    }
}

/// The scenario of a choice with another speed, or force.
fn with_strength(model: &AppModel, choice: &Choice, typed: &str) -> Result<Scenario, String> {
    let mut scenario = choice.scenario.clone()?;
    if let Some(field) = strength(&scenario).field() {
        set(&mut scenario, field.path, typed).map_err(|why| why.to_string())?;
    }
    model.allows(&scenario).map(|()| scenario)
}

/// The choices that several typed names find first, each with its place and its scenario; an error
/// names the one that finds nothing, or may not be so fast.
fn several(model: &AppModel, picker: &Picker) -> Result<Vec<(usize, Scenario)>, String> {
    let one = |(name, strength): (&str, Option<&str>)| {
        let nothing = || format!("nothing is called {}", quoted(name));
        let at = Picker::place(&model.choices, name).ok_or_else(nothing)?;
        let choice = &model.choices[at];
        let scenario = match strength {
            Some(typed) => with_strength(model, choice, typed),
            None => choice.scenario.clone(),
        };
        scenario.map(|scenario| (at, scenario)).map_err(|why| format!("{name}: {why}"))
    };
    picker.several().into_iter().map(one).collect()
}

/// Accepts what is chosen in front of the screen, or what is typed.
pub(crate) fn accept(app: &mut App) {
    let model = &mut app.model;
    match &model.overlay {
        Some(Overlay::Picker(picker))
            if picker.marked.is_some() && !picker.several().is_empty() =>
        {
            match several(model, picker) {
                Ok(chosen) => {
                    model.overlay = None;
                    app.screens[app.screen].mark_several(model, chosen);
                }
                Err(why) => model.notice = Some(why),
            }
        }
        Some(Overlay::Picker(picker)) => {
            let Some(at) = picker.shown.get(picker.row).copied() else { return };
            let choice = &model.choices[at];
            let stronger = picker.typed().1.map(|typed| with_strength(model, choice, typed));
            let stronger = match stronger.transpose() {
                Ok(stronger) => stronger,
                Err(why) => return model.notice = Some(why),
            };
            if picker.marked.is_some() {
                let name = choice.name.clone();
                app.screens[app.screen].mark_choice(model, at);
                if let Some(scenario) = stronger {
                    app.screens[app.screen].take_changed(model, &name, &scenario);
                }
            } else if choice.origin == LAST {
                // What is worked on already is that.
                model.overlay = None;
                presets::forget_last(model);
            } else {
                model.overlay = None;
                presets::open(model, at);
                presets::forget_last(model);
                if let Some(scenario) = stronger {
                    edit::change(model, model.work.with(scenario), "");
                }
                model.form.selected = strength(&model.work.scenario);
                // The screen of the form is the first, its form the first pane.
                app.screens[0].show_pane(0);
            }
        }
        Some(Overlay::Name(naming, input, _)) => {
            let (naming, name) = (naming.clone(), input.value().trim().to_owned());
            match naming {
                Naming::Save => presets::save(model, name, false),
                Naming::Rename(from) => presets::rename(model, from, name),
            }
        }
        Some(Overlay::Threshold(_)) => threshold::accept(model),
        Some(Overlay::Change(what)) => {
            let name = what.name.clone();
            match what.changed().and_then(|new| model.allows(&new).map(|()| new)) {
                Ok(scenario) => {
                    model.overlay = None;
                    app.screens[app.screen].take_changed(model, &name, &scenario);
                }
                Err(why) => {
                    if let Some(Overlay::Change(what)) = &mut model.overlay {
                        what.error = Some(why);
                    }
                }
            }
        }
        Some(_) => {}
        None => _ = typing::accept(model),
    }
}

/// Gives up what is nearest: what stands in front, what is typed, or what is being computed.
pub(crate) fn cancel(app: &mut App) {
    let model = &mut app.model;
    if threshold::stop(model) {
        return;
    }
    if let Some(left) = model.overlay.take() {
        // Back to the list that it came from.
        if let Overlay::Name(Naming::Rename(from), ..) = left {
            presets::open_picker_at(model, &from);
        } else {
            presets::forget_last(model);
        }
    } else if model.form.typing.take().is_some() {
        // Nothing is typed any more.
    } else if model.page.stop(None, &mut model.out) {
        model.notice = Some("no page is written".to_owned());
    } else if !app.screens[app.screen].cancel(model) {
        simulation::cancel(model);
    }
}

/// Answers yes or no to what is asked.
pub(crate) fn reply(app: &mut App, yes: bool) {
    let model = &mut app.model;
    let Some(Overlay::Prompt(question)) = model.overlay.take() else { return };
    match question {
        Prompt::Adopt(_, scenario) if yes => edit::adopt(model, *scenario),
        Prompt::Page(stem, text) if yes => model.out.effects.push(Effect::Page(stem, text)),
        Prompt::Page(..) => model.notice = Some("no page is written".to_owned()),
        Prompt::Quit(_) if yes => model.out.effects.push(Effect::Quit(0)),
        Prompt::Replace(name) | Prompt::Hide(name) if yes => presets::save(model, name, true),
        Prompt::Replace(name) | Prompt::Hide(name) => {
            presets::ask_name(model, Naming::Save, name, None);
        }
        Prompt::Remove(name) if yes => model.out.effects.push(Effect::Remove(name)),
        Prompt::Remove(name) => presets::open_picker_at(model, &name),
        Prompt::Adopt(..) | Prompt::Quit(_) => {}
    }
}

pub(crate) fn write_page(app: &mut App) {
    let answers = app.screens[app.screen].answers(&app.model);
    match take_away::page(&app.model, &answers) {
        Ok(page) => app.model.page.ask(page, &mut app.model.out),
        Err(why) => app.model.notice = Some(why.to_owned()),
    }
}

pub(crate) fn copy_summary(app: &mut App) {
    let answers = app.screens[app.screen].answers(&app.model);
    match take_away::summary(&app.model, &answers) {
        Ok(text) => push(app, Effect::Copy(text)),
        Err(why) => app.model.notice = Some(why.to_owned()),
    }
}

/// Proposes what is more exact, or faster; shows the screen that must find that out first.
pub(crate) fn propose(app: &mut App, exact: bool) {
    for place in 0..app.screens.len() {
        match app.screens[place].propose(&mut app.model, exact) {
            Some(true) => return app.show(place),
            Some(false) => return,
            None => {}
        }
    }
}

/// Stops the clock at a time in s.
pub(crate) fn stay_at(app: &mut App, time: f64) {
    app.model.clock.moment = Moment::At(time);
    app.model.clock.playing = false;
}

/// Goes to the time of the next peak of what is on show, or to that of the one before.
pub(crate) fn jump_to_peak(app: &mut App, forward: bool) {
    let mut clock = app.model.clock;
    if let Some((answer, _)) = app.timed() {
        let courses = app.on_show().courses(&app.model);
        clock.jump(answer, forward, |of| courses.is_empty() || courses.contains(&Trace::Of(of)));
    }
    app.model.clock = clock;
}

pub(crate) fn play(app: &mut App) {
    // Where nobody has chosen a moment yet, it begins at the beginning.
    let is_chosen = app.model.clock.moment != Moment::Deepest;
    app.model.clock.moment = Moment::At(if is_chosen { app.time() } else { 0.0 });
    app.model.clock.playing = !app.model.clock.playing;
}
