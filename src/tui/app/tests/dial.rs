//! The dial, by which an object is turned about the eye.

use super::*;
use crate::scenario::set::set;

fn turned(app: &mut App, keys: &str) -> Vec<(f64, f64)> {
    let mut turn = |key: char| {
        press(app, &key.to_string());
        let object = app.model.work.scenario.projectile().unwrap();
        (object.angle_deg, object.angle_clock)
    };
    keys.chars().map(&mut turn).collect()
}

#[test]
fn an_object_turns_on_through_straight_on_to_the_other_side_and_round_the_clock() {
    let mut app = opened();
    app.model.work.scenario = find("bb-62").unwrap().scenario().unwrap();
    set(&mut app.model.work.scenario, "impact.angle_deg", "1").unwrap();
    press(&mut app, "\t");
    assert_eq!(app.focus().name, "dial");
    assert_eq!(turned(&mut app, "jjj"), [(0.0, 12.0), (1.0, 6.0), (2.0, 6.0)]);
    assert_eq!(turned(&mut app, "kkk"), [(1.0, 6.0), (0.0, 6.0), (1.0, 12.0)]);
    assert_eq!(turned(&mut app, "lhh"), [(1.0, 0.5), (1.0, 0.0), (1.0, 11.5)]);
}

#[test]
fn the_dial_looks_from_the_front_only_where_something_is_seen_from_there() {
    let mut app = answered();
    press(&mut app, "\tf");
    assert_eq!(notice(&app), "a section has no front: hit the eye with an object");
}
