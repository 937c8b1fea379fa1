//! That no key means two things, usual or chosen, and that every place can be left.

use super::*;
use crate::tui::app::tables::{clash, open_to_choice};
use crate::tui::keys::{Key, begins_value, chosen::Keys, press::Press};

/// The app with every pane in turn in focus, one of them on a row that takes numbers too.
fn every_pane() -> Vec<App> {
    let mut apps = vec![app()];
    for (index, screen) in opened().screens.iter().enumerate() {
        for pane in 0..screen.panes().len() {
            let mut app = opened();
            app.screen = index;
            app.screens[index].show_pane(pane);
            apps.push(app);
        }
    }
    apps
}

#[test]
fn no_key_means_two_things_in_one_table_and_each_reads_back_from_how_it_is_written() {
    for list in tables::all() {
        let mut seen = Vec::new();
        for key in list.keys {
            assert!(!key.help.is_empty());
            for press in key.presses {
                let name = press.name();
                assert!(!seen.contains(press), "{} {name}", list.title);
                assert_eq!(Press::read(&name), Ok(*press), "{name}");
                seen.push(*press);
            }
        }
        assert!(!seen.is_empty(), "{} has no keys", list.title);
    }
    for wrong in ["", "Ctrl-", "Hyper-x", "F13", "F0", "xy", "Ctrl-i", "Shift-a"] {
        assert!(Press::read(wrong).is_err(), "{wrong}");
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
    for (i, digit) in ('1'..='9').take(SCREENS.len()).enumerate() {
        let f = KeyEvent::from(KeyCode::F(1 + i as u8));
        let alt = KeyEvent::new(KeyCode::Char(digit), KeyModifiers::ALT);
        let digit = KeyEvent::from(KeyCode::Char(digit));
        for event in [f, alt, digit] {
            for mut app in every_pane() {
                // In the form a digit is a value, or nothing.
                let kept = begins_value(&tables::stack(&app)) && event == digit;
                let typed = kept && app.model.form.takes_numbers();
                let pane = app.focus().name;
                update(&mut app, Message::Key(event));
                assert_eq!(app.screen, if kept { 0 } else { i }, "{i} from {pane}");
                assert_eq!(app.model.form.typing.is_some(), typed);
            }
        }
    }
}

#[test]
fn every_place_can_be_left_and_stopped() {
    let overlays = [
        Overlay::Help(0),
        Overlay::Picker(Picker::default()),
        Overlay::Name(Naming::Save, crate::tui::line::TextLine::default(), None),
        Overlay::Prompt(Prompt::Quit(false)),
    ];
    let behind = overlays.map(|overlay| {
        let mut app = opened();
        app.model.overlay = Some(overlay);
        app
    });
    for mut app in every_pane().into_iter().chain(behind) {
        assert!(press(&mut app, "\x03").contains(&Effect::Quit(130)));
        assert!(press(&mut app, "\x1a").contains(&Effect::Suspend));
    }
}

fn binding(name: &str) -> &'static Key {
    open_to_choice().find(|b| b.name == name).unwrap()
}

/// What has one of these keys of one's own already.
fn taken(own: &[(&str, &str)]) -> Option<String> {
    let mut keys = Keys::default();
    for (name, key) in own {
        keys.choose(binding(name), vec![Press::read(key).unwrap()]);
    }
    clash(&keys).map(|(_, _, other)| other)
}

#[test]
fn names_differ() {
    let names: Vec<_> = open_to_choice().map(|b| b.name.to_lowercase()).collect();
    for (i, name) in names.iter().enumerate() {
        assert!(!names[..i].contains(name), "{name}");
    }
    assert!(names.len() > 20);
}

#[test]
fn a_key_that_is_taken_is_refused_by_the_name_of_what_has_it() {
    let undo = |key| taken(&[("undo", key)]);
    assert_eq!([undo("Ctrl-X"), undo("u")], [None, None]);
    assert_eq!(undo("Ctrl-S").unwrap(), "`save` (save as a preset of your own)");
    assert!(undo("Ctrl-C").unwrap().contains("leave at once"));
    assert!(undo("a").unwrap().contains("advanced fields\" (Form)"));
    assert!(undo("3").unwrap().starts_with("`forces`"));
    // What gave its key away may be followed.
    assert_eq!(taken(&[("save", "W"), ("undo", "Ctrl-S")]), None);
}

#[test]
fn a_chosen_key_does_it_and_is_shown_and_the_usual_one_no_longer() {
    let mut app = opened();
    app.model.keys.choose(binding("help"), vec![Press::read("Ctrl-X").unwrap()]);
    press(&mut app, "?");
    assert!(app.model.overlay.is_none());
    assert!(footer_keys(&app).contains(&("Ctrl-X".to_owned(), "keys")));
    press(&mut app, "\x18");
    assert!(app.model.overlay.is_some());
}
