//! One blow has one answer: whoever asks, wherever it is shown, the risks are the same words.

use std::fs;

use contrecoup::answer::solve::Answer;
use contrecoup::run::watch::unwatched;
use contrecoup::scenario::{library, set::set};
use contrecoup::tui::request::TaskQuestion;
use contrecoup::tui::simulation::Simulate;

use crate::program::{json, program};

/// Cheap blows of every kind: from the front, from the side, of a free eye, in gelatin, of a pig,
/// with doubts, cut off, missed, and of the Paper model.
const BLOWS: [(&str, &[&str]); 20] = [
    ("bb-62", &[]),
    ("bb-62", &["speed=8"]),
    ("bb-62", &["speed=20"]),
    ("bb-62", &["speed=35"]),
    ("bb-62", &["speed=50 +- 5"]),
    ("bb-62", &["speed=110"]),
    ("bb-56", &["window_ms=0.2"]),
    ("bb-56", &["support=Gelatin"]),
    ("bb-56", &["support=Free"]),
    ("bb-56", &["species=Pig", "support=Gelatin"]),
    ("paintball", &["speed=40"]),
    ("paintball", &["speed=90", "mass_g=3 +- 0.3"]),
    ("airsoft-75", &[]),
    ("gel-ball", &["window_ms=0.5"]),
    ("bb-62", &["support=Free", "angle_deg=20", "window_ms=0.1"]),
    ("bb-62", &["support=Free", "angle_deg=20 +- 10", "window_ms=0.05"]),
    ("bb-62", &["support=Free", "from=NotKnown", "window_ms=0.05"]),
    ("bb-62", &["support=Free", "offset_mm=10", "angle_deg=60", "angle_clock=6", "window_ms=0.1"]),
    ("paper-300n", &[]),
    ("paper-300n", &["model=Physiological", "window_ms=0.3"]),
];

/// The words of each risk, or why there is none.
fn said(answer: &Answer) -> Vec<(&'static str, String)> {
    if let Some(silence) = answer.silence() {
        return vec![("injuries", silence.to_owned())];
    }
    answer.risks().iter().map(|risk| (risk.injury.name(), risk.words())).collect()
}

#[test]
fn run_quick_page_app_and_guest_tell_the_same_risks() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page.md");
    for (name, changes) in BLOWS {
        let mut scenario = library::find(name).unwrap().scenario().unwrap();
        for change in changes {
            let (path, text) = change.split_once('=').unwrap();
            set(&mut scenario, path, text).unwrap();
        }
        // The app and a guest in it show the first answer, which is the last.
        let wanted = said(&Simulate(scenario).answer(&mut unwatched).unwrap());
        let sets: Vec<&str> = changes.iter().flat_map(|change| ["--set", change]).collect();
        let whole = json(&[&["run", name], &sets[..]].concat());
        let quick = json(&[&["run", name, "--quick"], &sets[..]].concat());
        assert_eq!(whole["risks"], quick["risks"], "{name} {changes:?}");
        assert_eq!(whole["no_risks_because"], quick["no_risks_because"]);
        let mut texts: Vec<&str> = whole["no_risks_because"].as_str().into_iter().collect();
        let risks = whole["risks"].as_object().unwrap().values();
        texts.extend(risks.filter_map(|risk| risk["text"].as_str()));
        let file = ["-o", page.to_str().unwrap()];
        program(&[&["report", name], &sets[..], &file].concat()).assert().success();
        let page = fs::read_to_string(&page).unwrap().replace('\\', "");
        for (injury, words) in &wanted {
            // Why there are none stands last, by itself.
            let line = match *injury {
                "injuries" => format!("Injuries: {words}."),
                injury => format!("**{injury}**: {words}"),
            };
            assert!(page.contains(&line), "{line}\n{page}");
            assert!(texts.contains(&words.as_str()), "{words}\n{texts:?}");
        }
    }
}
