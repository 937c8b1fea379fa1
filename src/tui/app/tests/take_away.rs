//! What is taken out of the app.

use super::*;
use crate::tui::page::{WritePage, writing};

#[test]
fn a_page_and_a_summary_are_taken_of_an_answer_and_say_how_to_repeat_it() {
    let mut app = answered();
    let effects = press(&mut app, "w");
    let (ticket, question) = asked::<WritePage>(&effects).unwrap();
    assert_eq!(writing(&app.model.page).unwrap(), "writing a page");
    let page = question.answer(&mut unwatched);
    let effects = done::<WritePage>(&mut app, ticket, page);
    assert_eq!(writing(&app.model.page), None);
    assert!(!effects.iter().any(|e| matches!(e, Effect::Page(..))), "a letter writes no file");
    let effects = press(&mut app, "\r");
    let Some(Effect::Page(stem, text)) = effects.first() else { panic!("{effects:?}") };
    let text = String::from_utf8(text.clone()).unwrap();
    assert_eq!(stem, "paper-300n");
    assert!(text.contains("contrecoup report paper-300n -o paper-300n.html"));
    let effects = press(&mut app, "y");
    let [Effect::Copy(text)] = &effects[..] else { panic!("{effects:?}") };
    assert!(text.ends_with("contrecoup run paper-300n\n"), "{text}");
}

#[test]
fn a_page_is_written_after_a_question_that_says_where_and_how_large() {
    for (reply, written) in [("y", true), ("n", false)] {
        let mut app = answered();
        let effects = press(&mut app, "w");
        let (ticket, _) = asked::<WritePage>(&effects).unwrap();
        let effects = done::<WritePage>(&mut app, ticket, Ok("x".repeat(1_200_000)));
        assert!(!effects.iter().any(|e| matches!(e, Effect::Page(..))));
        let Some(Overlay::Prompt(question)) = &app.model.overlay else {
            panic!("nothing is asked")
        };
        let folder = std::env::current_dir().unwrap();
        let text = question.text();
        assert!(text.contains("paper-300n.html of 1.2 MB"), "{text}");
        assert!(text.contains(folder.to_str().unwrap()), "{text}");
        let page = press(&mut app, reply).iter().any(|e| matches!(e, Effect::Page(..)));
        assert_eq!(page, written);
    }
}

#[test]
fn nothing_is_taken_before_there_is_an_answer_and_no_file_by_a_guest() {
    let mut app = opened();
    assert!(press(&mut app, "w").is_empty());
    assert!(notice(&app).contains("no answer yet"));
    let mut app = answered();
    app.model.guest = true;
    assert!(press(&mut app, "w").is_empty());
    assert!(notice(&app).contains("guest"));
}
