//! What keys and the wheel do to the clock that every picture follows.

use crate::run::course::Course;
use crate::tui::clock::Moment;
use crate::tui::model::Model;
use crate::tui::step::Step;

/// A step from frame to frame.
pub(crate) fn step(model: &mut Model, step: Step) {
    if let Some((answer, window)) = model.timed() {
        let mut clock = model.clock;
        clock.step(step, model.time(), &answer.run.frames, window);
        model.clock = clock;
    }
}

/// Stops at a time in s.
pub(crate) fn stay_at(model: &mut Model, time: f64) {
    model.clock.moment = Moment::At(time);
    model.clock.playing = false;
}

/// Goes to the time of the next peak of what is on show, or to that of the one before.
pub(crate) fn jump(model: &mut Model, forward: bool) {
    let mut clock = model.clock;
    if let Some((answer, _)) = model.timed() {
        let courses = (model.on_show().courses)(model);
        let on_show = |of| courses.is_empty() || courses.contains(&Course::Of(of));
        clock.jump(answer, forward, on_show);
    }
    model.clock = clock;
}

/// Plays or pauses.
pub(crate) fn play(model: &mut Model) {
    // Nobody has chosen a moment yet: begin at the beginning.
    let time = match model.clock.moment {
        Moment::Deepest => 0.0,
        Moment::At(_) => model.time(),
    };
    model.clock.moment = Moment::At(time);
    model.clock.playing = !model.clock.playing;
}
