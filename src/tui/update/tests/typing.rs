//! What typing a value does.

use crate::tui::update::tests::*;

#[test]
fn typing_simulates_what_makes_sense_and_escape_restores() {
    let mut model = model();
    let effects = press(&mut model, "\r\x1545");
    assert_eq!(effects.len(), 2, "4 and 45 are both forces");
    assert_eq!(force(&model), 45.0);
    press(&mut model, "-");
    let error = model.form.typing.as_ref().unwrap().error.clone();
    assert!(error.unwrap().contains("allowed"));
    assert_eq!(model.stale(), Some("last good result"));
    press(&mut model, "\x1b");
    assert_eq!(force(&model), 300.0);
    assert_eq!(model.history.depth(), (0, 0));
}

#[test]
fn what_is_typed_after_enter_replaces_the_value_and_a_doubt_goes_behind_it() {
    let mut model = model();
    press(&mut model, "\r45\r");
    assert_eq!(force(&model), 45.0);
    press(&mut model, "\r\x1b[D6\r");
    assert_eq!(force(&model), 465.0);
    press(&mut model, "\r +- 5\r");
    assert_eq!(force(&model), 465.0);
    assert_eq!(model.work.scenario.doubt["impact.force_n"], 5.0);
    press(&mut model, "\r\x1b[200~75\x1b[201~\r");
    assert_eq!(force(&model), 75.0);
    // A name that is offered is typed over as well.
    press(&mut model, "sm");
    assert_eq!(offered(&model), "m");
}

#[test]
fn a_doubt_that_is_typed_changes_no_answer_and_asks_for_none() {
    let mut model = model();
    answer(&mut model, 1);
    let effects = press(&mut model, "\r\x1545");
    let (ticket, _) = asked::<Simulate>(&effects[effects.len() - 1..]).unwrap();
    answer(&mut model, ticket);
    for typed in [" ", "+", "-", " ", "5"] {
        let effects = press(&mut model, typed);
        assert!(asked::<Simulate>(&effects).is_none(), "{typed}");
        assert_eq!((force(&model), model.stale()), (45.0, None), "{typed}");
        assert!(model.form.typing.as_ref().unwrap().error.is_none());
    }
    press(&mut model, "\r");
    assert_eq!(model.work.scenario.doubt["impact.force_n"], 5.0);
    assert!(asked::<Simulate>(&press(&mut model, "u")).is_some());
    assert!(model.work.scenario.doubt.is_empty());
    // Enter takes no half of a doubt.
    press(&mut model, "45 +-\r");
    let error = model.form.typing.as_ref().unwrap().error.clone();
    assert!(error.unwrap().contains("allowed"));
}

#[test]
fn enter_takes_the_next_of_a_few_choices() {
    let mut model = model();
    let shape = fields::find("impact.shape").unwrap();
    model.form.selected = Row::Field(shape);
    press(&mut model, "\r");
    assert_eq!(shape.text(&model.work.scenario).unwrap(), "Triangle");
    assert!(model.form.typing.is_none());
    // What is pasted is typed.
    let table = "Table([(0, 0), (0.1, 1), (0.3, 0)])";
    press(&mut model, &format!("\x1b[200~{table}\x1b[201~\r"));
    assert_eq!(shape.text(&model.work.scenario).unwrap(), "Table");
    press(&mut model, "\r");
    assert!(model.form.typing.is_some(), "a recorded curve is kept");
}

#[test]
fn enter_on_a_bad_value_stays_and_on_a_good_one_is_one_undo() {
    let mut model = model();
    press(&mut model, "\r\x15-1\r");
    assert!(model.form.typing.is_some());
    press(&mut model, "\x15450\r");
    assert!(model.form.typing.is_none());
    assert_eq!(model.history.depth(), (1, 0));
    press(&mut model, "u");
    assert_eq!(force(&model), 300.0);
}

#[test]
fn a_value_out_of_range_leaves_the_result_from_before_not_that_of_its_first_digits() {
    let mut model = model();
    answer(&mut model, 1);
    let effects = press(&mut model, "9999999");
    let (ticket, last) = asked::<Simulate>(&effects[effects.len() - 1..]).unwrap();
    assert_eq!(force(&model), 300.0);
    assert_eq!(last.0, model.work.scenario);
    answer(&mut model, ticket);
    assert_eq!(model.shown.as_ref().unwrap().scenario, last.0);
    assert_eq!(model.stale(), Some("last good result"));
    // Nor does Enter take any of it.
    press(&mut model, "\r");
    assert!(model.form.typing.is_some() && force(&model) == 300.0);
}

#[test]
fn a_letter_is_no_part_of_a_number_and_is_refused_in_words() {
    let mut model = model();
    press(&mut model, "7");
    assert_eq!(press(&mut model, "us?q"), []);
    let value = |model: &Model| {
        let typing = model.form.typing.as_ref().unwrap();
        typing.input.value().to_owned()
    };
    assert_eq!((value(&model), model.screen), ("7".to_owned(), 0));
    assert!(model.notice.as_ref().unwrap().contains("Enter accepts"));
    press(&mut model, ",5 ± 2e-1");
    assert_eq!(value(&model), "7.5 ± 2e-1");
    assert!(model.notice.is_none() && force(&model) == 7.5);
    // A pasted comma may stand for thousands: it is explained.
    press(&mut model, "\x15\x1b[200~1,000\x1b[201~");
    let error = model.form.typing.as_ref().unwrap().error.clone();
    assert!(error.unwrap().contains("not a comma"));
    press(&mut model, "\x15");
    let error = model.form.typing.as_ref().unwrap().error.clone();
    assert_eq!(error.unwrap(), "nothing is there: allowed 0 to 100000 N");
}

#[test]
fn what_the_form_shows_can_be_typed() {
    let mut model = model();
    let field = |path| Row::Field(fields::find(path).unwrap());
    press(&mut model, "a");
    model.form.selected = field("numerics.step_us");
    press(&mut model, "2\r");
    assert_eq!(model.work.scenario.numerics.step_us, Some(2.0));
    press(&mut model, "\r\x15Auto\r");
    assert_eq!(model.work.scenario.numerics.step_us, None);
    press(&mut model, "\r");
    assert_eq!(model.form.typing.as_ref().unwrap().input.value(), "auto");
    press(&mut model, "\x150");
    let error = model.form.typing.as_ref().unwrap().error.clone();
    assert!(error.unwrap().contains("allowed auto, or"));
    press(&mut model, "\x15auto");
    press(&mut model, "\r");
    model.form.selected = field("eye.lens");
    press(&mut model, "\x1b[200~soft\x1b[201~\r");
    assert_eq!(model.work.scenario.eye.lens, crate::scenario::Lens::Soft);
    model.form.selected = field("model");
    press(&mut model, "\x1b[200~physiological\x1b[201~\r");
    model.form.selected = field("model.species");
    press(&mut model, "\x1b[200~pig\x1b[201~\r");
    let crate::scenario::Model::Physiological(parts) = &model.work.scenario.model else {
        panic!()
    };
    assert_eq!(parts.species, crate::scenario::Species::Pig);
}

#[test]
fn a_digit_begins_a_value_where_a_number_is_wanted() {
    let mut model = model();
    press(&mut model, "450");
    assert_eq!((force(&model), model.screen), (450.0, 0));
    assert!(model.form.typing.is_some());
    // Escape restores all of it.
    press(&mut model, "\x1b");
    assert_eq!((force(&model), model.history.depth()), (300.0, (0, 0)));
    press(&mut model, "25\r");
    assert_eq!((force(&model), model.history.depth()), (25.0, (1, 0)));
    press(&mut model, "u.5\r");
    assert_eq!(force(&model), 0.5);
    // A force below nothing is explained, and the value before stays.
    press(&mut model, "-7");
    let typing = model.form.typing.as_ref().unwrap();
    assert!(typing.error.as_ref().unwrap().contains("allowed"));
    assert_eq!(
        (force(&model), model.stale()),
        (0.5, Some("last good result"))
    );
    press(&mut model, "\x1b\x1b[200~75\x1b[201~\r");
    assert_eq!(force(&model), 75.0);
}

#[test]
fn a_digit_never_leaves_the_form_and_switches_screens_elsewhere() {
    let mut model = model();
    let shape = Row::Field(fields::find("impact.shape").unwrap());
    for row in [Row::Preset, Row::Fold, shape] {
        model.form.selected = row;
        let before = model.work.clone();
        for digit in "0123456789".chars() {
            assert!(press(&mut model, &digit.to_string()).is_empty());
            assert!(model.screen == 0 && model.form.typing.is_none() && model.work == before);
        }
        press(&mut model, "4");
        assert!(
            model
                .notice
                .as_ref()
                .unwrap()
                .ends_with("F4 or Alt-4 shows Compare")
        );
        press(&mut model, "\x1b[200~12\x1b[201~");
        assert_eq!(model.form.typing.is_some(), row == shape);
        press(&mut model, "\x1b");
    }
    press(&mut model, "\x1b3");
    assert_eq!(model.screen, 2);
    press(&mut model, "2");
    assert_eq!(model.screen, 1);
    press(&mut model, "1\t3");
    assert_eq!(model.screen, 2, "the dial takes no digits");
    press(&mut model, "\x1b[11~");
    assert_eq!(model.screen, 0);
}
