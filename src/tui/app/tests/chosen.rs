//! What keys of a person's own choice do.

use super::*;
use crate::tui::app::tables::{clash, open_to_choice};
use crate::tui::keys::{Key, chosen::Keys, press::Press};

fn binding(name: &str) -> &'static Key {
    open_to_choice().find(|b| b.name == name).unwrap()
}

fn chosen(name: &str, key: &str) -> Option<String> {
    let mut keys = Keys::default();
    keys.choose(binding(name), vec![Press::read(key).unwrap()]);
    clash(&keys).map(|(_, _, other)| other)
}

#[test]
fn every_key_reads_back_from_how_it_is_written() {
    let named = |press: &Press| {
        let name = press.name();
        assert_eq!(Press::read(&name), Ok(*press), "{name}");
    };
    for list in tables::all() {
        let presses = list.keys.iter().flat_map(|key| key.presses);
        presses.for_each(named);
    }
    for wrong in ["", "Ctrl-", "Hyper-x", "F13", "F0", "xy", "Ctrl-i", "Shift-a"] {
        assert!(Press::read(wrong).is_err(), "{wrong}");
    }
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
    assert_eq!(chosen("undo", "Ctrl-X"), None);
    assert_eq!(chosen("undo", "u"), None);
    assert_eq!(chosen("undo", "s").unwrap(), "`save` (save as a preset of your own)");
    assert!(chosen("undo", "Ctrl-C").unwrap().contains("leave at once"));
    assert!(chosen("undo", "a").unwrap().contains("advanced fields\" (Form)"));
    assert!(chosen("undo", "3").unwrap().starts_with("`forces`"));
}

#[test]
fn a_chosen_key_does_it_and_is_shown_and_the_usual_one_no_longer() {
    let mut app = opened();
    app.model.keys.choose(binding("help"), vec![Press::read("Ctrl-X").unwrap()]);
    press(&mut app, "?");
    assert!(app.model.overlay.is_none());
    assert!(footer_keys(&app).contains(&("Ctrl-X".to_owned(), "keys")));
    let press = KeyEvent::new(KeyCode::Char('x'), KeyModifiers::CONTROL);
    update(&mut app, Message::Key(press));
    assert!(app.model.overlay.is_some());
}

#[test]
fn what_gave_its_key_away_may_be_followed() {
    let mut keys = Keys::default();
    keys.choose(binding("save"), vec![Press::read("W").unwrap()]);
    keys.choose(binding("undo"), vec![Press::read("s").unwrap()]);
    assert_eq!(clash(&keys), None);
}
