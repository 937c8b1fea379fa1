//! That no key means two things, and that every place can be left.

use super::*;
use crate::tui::{keys::begins_value, picker::Picker};

/// A model for every pane, one on a row that takes numbers, and one for every overlay.
fn every_place() -> Vec<App> {
    let mut models = Vec::new();
    for (index, screen) in opened().screens.iter().enumerate() {
        for pane in 0..screen.panes().len() {
            let mut app = opened();
            app.screen = index;
            app.screens[index].show_pane(pane);
            models.push(app);
        }
    }
    let mut app = opened();
    app.model.form.selected = row("impact.force_n");
    models.push(app);
    for overlay in [
        Overlay::Help(0),
        Overlay::Picker(Picker::default()),
        Overlay::Name(Naming::Save, crate::tui::line::TextLine::default(), None),
        Overlay::Prompt(Prompt::Quit { kept: false }),
    ] {
        let mut app = opened();
        app.model.overlay = Some(overlay);
        models.push(app);
    }
    models
}

#[test]
fn no_key_means_two_things_in_one_table() {
    for list in tables::all() {
        let mut seen = Vec::new();
        for key in list.keys {
            assert!(!key.help.is_empty());
            for press in key.presses {
                assert!(!seen.contains(press), "{} {}", list.title, press.name());
                seen.push(*press);
            }
        }
        assert!(!seen.is_empty(), "{} has no keys", list.title);
    }
}

#[test]
fn no_pane_hides_a_key_that_works_everywhere() {
    let shared = [tables::EVERYWHERE.list(), tables::SHOW.list()];
    let shared = || shared.iter().flat_map(|list| &list.keys);
    let mut lists = vec![tables::TIME.list()];
    for screen in opened().screens {
        lists.extend(tables::of_panes(screen.as_ref()));
    }
    for list in lists {
        for own in list.keys {
            for press in own.presses {
                // A digit is typed where a number is wanted; Alt and F keys do its work.
                let hidden = !own.begins_value && shared().any(|key| key.presses.contains(press));
                assert!(!hidden, "{} {}", list.title, press.name());
            }
        }
    }
}

#[test]
fn every_screen_can_be_reached_from_every_pane_by_one_press() {
    for place in 0..every_place().len() {
        for (i, number) in (1..=SCREENS.len()).enumerate() {
            let f = KeyEvent::from(KeyCode::F(u8::try_from(number).unwrap()));
            let digit = KeyCode::Char(char::from_digit(number as u32, 10).unwrap());
            let alt = KeyEvent::new(digit, KeyModifiers::ALT);
            for event in [f, alt, KeyEvent::from(digit)] {
                let mut app = every_place().swap_remove(place);
                if app.model.overlay.is_some() {
                    continue;
                }
                // In the form a digit is a value, or nothing.
                let kept = begins_value(&tables::stack(&app)) && event == KeyEvent::from(digit);
                let typed = kept && app.model.form.takes_numbers();
                update(&mut app, Message::Key(event));
                assert_eq!(app.screen, if kept { 0 } else { i }, "{i} from {place}");
                assert_eq!(app.model.form.typing.is_some(), typed);
            }
        }
    }
}

#[test]
fn every_place_can_be_left_and_stopped() {
    let press = |letter| KeyEvent::new(KeyCode::Char(letter), KeyModifiers::CONTROL);
    for mut app in every_place() {
        let effects = update(&mut app, Message::Key(press('c')));
        assert!(effects.contains(&Effect::Quit(130)));
        let effects = update(&mut app, Message::Key(press('z')));
        assert!(effects.contains(&Effect::Suspend));
    }
}
