//! The screens. A new one is a module here and a line in [`SCREENS`]; nothing else in the app asks
//! for a screen by its name.

pub mod accuracy;
pub mod compare;
pub mod doubt;
pub mod forces;
pub mod injury;
pub mod main;
pub mod map;
pub mod replay;
pub mod screen;

use accuracy::Measurement;
use compare::comparison::Comparison;
use doubt::Doubt;
use forces::Forces;
use injury::Injuries;
use main::Main;
use map::Map;
use replay::Replay;
use screen::About;

/// Every screen, in the order of its number key; the first is shown first.
pub const SCREENS: &[About] = &[
    About::new::<Main>("Main", main::QUESTION, "form, injuries, eye, curves"),
    About::new::<Replay>("Replay", "What moved?", "the replay in full size"),
    About::new::<Forces>("Forces", "When and how hard?", "the force profiles"),
    About::new::<Comparison>("Compare", "Which is worse?", "compare presets"),
    About::new::<Measurement>(
        "Accuracy",
        "How exact, at what cost?",
        "how much less error costs how much time",
    ),
    About::new::<Doubt>("Doubt", "How sure?", "what the doubt in the inputs does"),
    About::new::<Map>("Map", "What if?", "a result over two inputs"),
    About::new::<Injuries>(
        "Injury",
        injury::QUESTION,
        "the risk of each injury and what it rests on",
    ),
];
