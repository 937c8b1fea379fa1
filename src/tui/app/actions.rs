//! What the keys do that belong to no single screen.

use crate::run::trace::Trace;
use crate::scenario::{Scenario, set::set};
use crate::tui::changes::{edit, presets, simulation, take_away, threshold, typing};
use crate::tui::form::{FormRow, strength};
use crate::tui::overlay::{Naming, Overlay, Prompt};
use crate::tui::{app::App, choices::Choice, clock::Moment, line::TextLine, outbox::Effect};

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
    let words = if model.idle {
        "idle work on: mesh error and bands are computed ahead"
    } else {
        "idle work off: nothing is computed ahead"
    };
    model.notice = Some(words.to_owned());
}

/// Leaves, after a question if work would be lost.
pub(crate) fn quit(app: &mut App) {
    let model = &mut app.model;
    if model.is_edited() {
        model.overlay = Some(Overlay::Prompt(Prompt::Quit { kept: model.goes_on }));
    } else {
        model.out.effects.push(Effect::Quit(0));
    }
}

/// Shows or hides the keys.
pub(crate) fn help(app: &mut App) {
    let model = &mut app.model;
    model.overlay = match model.overlay {
        Some(Overlay::Help(_)) => None,
        _ => Some(Overlay::Help(0)),
    };
}

/// Moves by so many rows through the list in front of the screen.
pub(crate) fn scroll(app: &mut App, by: i16) {
    let model = &mut app.model;
    if let Some(Overlay::Help(line)) = &mut model.overlay {
        *line = line.saturating_add_signed(by);
    }
    if let Some(Overlay::Change(what)) = &mut model.overlay {
        what.go(isize::from(by));
    }
    if let Some(Overlay::Picker(picker)) = &mut model.overlay {
        picker.move_cursor(isize::from(by));
    }
}

/// The scenario of a choice with another speed, or force.
fn with_strength(choice: &Choice, typed: &str) -> Result<Scenario, String> {
    let mut scenario = choice.scenario.clone()?;
    if let FormRow::Field(field) = strength(&scenario) {
        set(&mut scenario, field.path, typed).map_err(|why| why.to_string())?;
    }
    Ok(scenario)
}

/// Accepts what is chosen in front of the screen, or what is typed.
pub(crate) fn accept(app: &mut App) {
    let model = &mut app.model;
    match &model.overlay {
        Some(Overlay::Picker(picker)) => {
            let at = picker.shown.get(picker.row).copied();
            let marks = picker.marked.is_some();
            let stronger = picker.typed().1.zip(picker.chosen(&model.choices));
            let stronger = stronger.map(|(typed, choice)| {
                let scenario = with_strength(choice, typed)?;
                model.allows(&scenario).map(|()| (choice.name.clone(), scenario))
            });
            let stronger = match stronger.transpose() {
                Ok(stronger) => stronger,
                Err(why) => return model.notice = Some(why),
            };
            match at {
                Some(at) if marks => {
                    app.screens[app.screen].mark_choice(model, at);
                    if let Some((name, scenario)) = stronger {
                        app.screens[app.screen].take_changed(model, &name, &scenario);
                    }
                }
                Some(at) => {
                    model.overlay = None;
                    presets::open(model, at);
                    if let Some((_, scenario)) = stronger {
                        edit::change(model, model.work.with(scenario), "");
                    }
                    model.form.selected = strength(&model.work.scenario);
                    // The screen of the form is the first, its form the first pane.
                    app.screens[0].show_pane(0);
                }
                None => {}
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
            let outcome = what.changed();
            match outcome.and_then(|new| model.allows(&new).map(|()| new)) {
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
        None => {
            typing::accept(model);
        }
    }
}

/// Gives up what is nearest: what stands in front, what is typed, or what is being computed.
pub(crate) fn cancel(app: &mut App) {
    let model = &mut app.model;
    if threshold::stop(model) {
        return;
    }
    match model.overlay.take() {
        // Back to the list that it came from.
        Some(Overlay::Name(Naming::Rename(from), ..)) => {
            presets::open_picker_at(model, &from);
            return;
        }
        Some(_) => return,
        None => {}
    }
    if model.form.typing.take().is_some() {
        return;
    }
    if model.page.stop(None, &mut model.out) {
        model.notice = Some("no page is written".to_owned());
    } else if !app.screens[app.screen].cancel(model) {
        simulation::cancel(model);
    }
}

/// Answers yes or no to what is asked.
pub(crate) fn reply(app: &mut App, yes: bool) {
    let model = &mut app.model;
    match model.overlay.take() {
        Some(Overlay::Prompt(Prompt::Adopt(_, scenario))) if yes => {
            edit::adopt(model, *scenario);
        }
        Some(Overlay::Prompt(Prompt::Page(stem, text))) => {
            if yes {
                model.out.effects.push(Effect::Page(stem, text));
            } else {
                model.notice = Some("no page is written".to_owned());
            }
        }
        Some(Overlay::Prompt(Prompt::Quit { .. })) if yes => {
            model.out.effects.push(Effect::Quit(0));
        }
        Some(Overlay::Prompt(Prompt::Replace(name) | Prompt::Hide(name))) => {
            if yes {
                presets::save(model, name, true);
            } else {
                model.overlay = Some(Overlay::Name(Naming::Save, TextLine::of(name), None));
            }
        }
        Some(Overlay::Prompt(Prompt::Remove(name))) => {
            if yes {
                model.out.effects.push(Effect::Remove(name));
            } else {
                presets::open_picker_at(model, &name);
            }
        }
        _ => {}
    }
}

/// Has a page written of what is on show.
pub(crate) fn write_page(app: &mut App) {
    let answers = app.screens[app.screen].answers(&app.model);
    match take_away::page(&app.model, &answers) {
        Ok(page) => app.model.page.ask(page, &mut app.model.out),
        Err(why) => app.model.notice = Some(why.to_owned()),
    }
}

/// Copies a summary of what is on show.
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
        let on_show = |of| courses.is_empty() || courses.contains(&Trace::Of(of));
        clock.jump(answer, forward, on_show);
    }
    app.model.clock = clock;
}

/// Plays or pauses.
pub(crate) fn play(app: &mut App) {
    // Nobody has chosen a moment yet: begin at the beginning.
    let time = match app.model.clock.moment {
        Moment::Deepest => 0.0,
        Moment::At(_) => app.time(),
    };
    app.model.clock.moment = Moment::At(time);
    app.model.clock.playing = !app.model.clock.playing;
}
