//! The eye in filled anatomy, of answers that were computed: what a playing replay sends, and the
//! picture of six moments of the README.

use crate::renew;
use std::sync::Mutex;

use super::drawn::{app_by, cells, look, press};
use contrecoup::answer::solve::Answer;
use contrecoup::run::watch::unwatched;
use contrecoup::scenario::Scenario;
use contrecoup::scenario::library::find;
use contrecoup::tui::app::App;
use contrecoup::tui::clock::{MeshDetail, Moment};
use contrecoup::tui::request::TaskQuestion;
use contrecoup::tui::shown::ShownAnswer;
use contrecoup::tui::simulation::Simulate;
use contrecoup::tui::terminal::caps::Depth;
use contrecoup::tui::terminal::paint::Pen;
use contrecoup::tui::view::eye::EyePicture;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::svg;

/// The answer to a scenario, as the app has it, computed once for all tests.
pub fn solved(scenario: &Scenario) -> Answer {
    static KNOWN: Mutex<Vec<(Scenario, Answer)>> = Mutex::new(Vec::new());
    let mut known = KNOWN.lock().unwrap();
    if let Some((_, answer)) = known.iter().find(|(asked, _)| asked == scenario) {
        return answer.clone();
    }
    let answer = Simulate(scenario.clone()).answer(&mut unwatched).unwrap();
    known.push((scenario.clone(), answer.clone()));
    answer
}

/// Bytes a frame, mean and largest, of so many frames of 25 us of a replay that plays.
fn bytes(app: &mut App, size: (u16, u16), frames: u32) -> (usize, usize) {
    app.model.clock.playing = true;
    let mut pen = Pen::default();
    let mut screens = (0..=frames).map(|i| {
        app.model.clock.moment = Moment::At(0.05e-3 + 0.025e-3 * f64::from(i));
        cells(app, size)
    });
    let mut before = screens.next().unwrap();
    let sent: Vec<usize> = screens
        .map(|after| {
            let mut out = Vec::new();
            pen.draw(&before, &after, &mut out);
            before = after;
            out.len()
        })
        .collect();
    (sent.iter().sum::<usize>() / sent.len(), *sent.iter().max().unwrap())
}

#[test]
fn a_playing_replay_keeps_to_its_bytes() {
    for preset in ["squash-ball", "bb-56"] {
        for (screen, size, most) in
            [("\x1b1", (80, 24), 1000), ("\x1b2", (80, 24), 1100), ("\x1b2", (120, 40), 3500)]
        {
            for depth in [Depth::TwoFiveSix, Depth::Sixteen, Depth::Mono] {
                let mut app = app_by(&[preset], depth, solved);
                press(&mut app, screen);
                let (first, largest) = bytes(&mut app, size, 40);
                let (whole, _) = bytes(&mut app, size, 200);
                println!(
                    "{preset}, screen {}, {depth:?}, {size:?}: {first} bytes a frame in the first \
                     ms, {largest} at most, {whole} in 5 ms",
                    &screen[1..]
                );
                assert!(first.max(whole) <= most, "{preset} {size:?} {depth:?}: {first}");
            }
        }
    }
}

/// The six moments of a squash ball, side by side.
#[test]
fn the_picture_of_the_readme_shows_six_moments_of_a_squash_ball() {
    const SIZE: (u16, u16) = (55, 24);
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/pictures/moments.svg");
    let scenario = find("squash-ball").unwrap().scenario().unwrap();
    let shown = ShownAnswer::new(scenario.clone(), solved(&scenario));
    let mut buffer = Buffer::empty(Rect::new(0, 0, 3 * SIZE.0 + 2, 2 * SIZE.1 + 1));
    for (i, ms) in [0.0, 0.35, 0.8, 1.55, 2.75, 4.65].into_iter().enumerate() {
        let i = i as u16;
        let place = Rect::new(i % 3 * (SIZE.0 + 1), i / 3 * (SIZE.1 + 1), SIZE.0, SIZE.1);
        let picture = EyePicture {
            front: false,
            shown: &shown,
            time: ms * 1e-3,
            largest: shown.hottest,
            field: shown.fields.first().copied(),
            zoom: 1,
            detail: MeshDetail::Anatomy,
            blow: Some(&scenario),
            aiming: false,
            playing: false,
            lean: false,
            look: look(Depth::TwoFiveSix),
        };
        picture.draw(place, &mut buffer);
    }
    let drawn = svg::svg(&buffer, "Six moments of a squash ball that hits an eye");
    if renew::is_asked("moments") {
        std::fs::write(file, &drawn).unwrap();
    }
    let kept = std::fs::read_to_string(file).unwrap_or_default();
    let renew = "FIGURES=moments cargo test --release --test app six_moments";
    assert!(kept == drawn, "the eye is drawn otherwise; `{renew}` draws it again");
}
