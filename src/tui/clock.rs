//! The one clock that every picture follows.

use crate::answer::solve::Answer;
use crate::report::figure::Figure;
use crate::run::kept::{Frame, nearest};
use crate::run::quantity::Quantity;
use crate::tui::step::Step;

/// Speeds in ms of impact a second.
const SPEEDS: [f64; 13] = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
/// How many times displacement may be shown.
const ZOOMS: [u32; 4] = [1, 2, 5, 10];

/// How the eye is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshDetail {
    /// The springs or the sides of cells.
    Edges,
    /// The nodes.
    Nodes,
    /// No mesh: filled anatomy.
    Anatomy,
}

impl MeshDetail {
    /// A word for the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Edges => "mesh",
            Self::Nodes => "nodes",
            Self::Anatomy => "anatomy",
        }
    }
}

/// Which moment is shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Moment {
    /// When the cornea stands deepest, wherever an edit moves that.
    Deepest,
    /// This time, in s.
    At(f64),
}

/// The moment shown and how it moves on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// The moment.
    pub moment: Moment,
    /// Whether it moves by itself.
    pub playing: bool,
    speed: usize,
    zoom: usize,
    /// How many forms of the eye before the one on show.
    detail: usize,
    /// How many fields before the one on show.
    field: usize,
}

impl Default for Clock {
    fn default() -> Self {
        Self { moment: Moment::Deepest, playing: false, speed: 5, zoom: 0, detail: 0, field: 0 }
    }
}

impl Clock {
    /// Speed in ms of impact a second.
    pub fn speed(&self) -> f64 {
        SPEEDS[self.speed]
    }

    /// How many times displacement is shown.
    pub fn zoom(&self) -> u32 {
        ZOOMS[self.zoom]
    }

    /// The time shown of an answer whose time ends then, in s; the beginning where there is none.
    pub fn time_in(&self, timed: Option<(&Answer, f64)>) -> f64 {
        timed.map_or(0.0, |(answer, window)| match self.moment {
            Moment::Deepest => answer.peak(Quantity::Apex).map_or(0.0, |apex| apex.time),
            Moment::At(time) => time.min(window),
        })
    }

    /// Moves on by so many seconds of the person's time. At the end it starts again.
    pub fn advance(&mut self, seconds: f64, from: f64, window: f64) {
        if self.playing {
            let next = from + seconds * self.speed() * 1e-3;
            self.moment = Moment::At(if next > window { 0.0 } else { next });
        }
    }

    /// Moves by one frame, or by ten. The last interval goes on to the end of the window.
    pub fn step(&mut self, step: Step, from: f64, frames: &[Frame], window: f64) {
        let [.., before, last] = frames else { return };
        let by = if step.coarse { 10 } else { 1 };
        let every = last.time - before.time;
        let beyond = ((from - last.time) / every).round().max(0.0);
        let here = nearest(frames, from) + beyond as usize;
        let next = if step.up { here + by } else { here.saturating_sub(by) };
        let later = || last.time + every * (next + 1 - frames.len()) as f64;
        let time = frames.get(next).map_or_else(later, |frame| frame.time);
        self.moment = Moment::At(time.clamp(0.0, window));
        self.playing = false;
    }

    /// Faster or slower.
    pub fn change_speed(&mut self, faster: bool) {
        let by = if faster { 1 } else { -1 };
        self.speed = self.speed.saturating_add_signed(by).min(SPEEDS.len() - 1);
    }

    /// The next exaggeration.
    pub fn change_zoom(&mut self) {
        self.zoom = (self.zoom + 1) % ZOOMS.len();
    }

    /// How an eye is drawn: of what an object hits the anatomy first, of others the mesh.
    pub fn detail(&self, is_hit: bool) -> MeshDetail {
        let forms = [MeshDetail::Anatomy, MeshDetail::Edges, MeshDetail::Nodes];
        forms[(self.detail + usize::from(!is_hit)) % forms.len()]
    }

    /// The next detail.
    pub fn change_detail(&mut self) {
        self.detail += 1;
    }

    /// What fills the eye, of several things.
    pub fn field<T: Copy>(&self, all: &[T]) -> Option<T> {
        all.get(self.field % all.len().max(1)).copied()
    }

    /// The next thing that fills the eye; of a mesh on show its anatomy comes first.
    pub fn change_field(&mut self, is_hit: bool) {
        if self.detail(is_hit) == MeshDetail::Anatomy {
            self.field += 1;
        }
        while self.detail(is_hit) != MeshDetail::Anatomy {
            self.change_detail();
        }
    }

    /// Jumps to the next peak of what is on show, or to the one before; goes round.
    pub fn jump(&mut self, answer: &Answer, forward: bool, on_show: impl Fn(Quantity) -> bool) {
        let now = self.time_in(Some((answer, answer.window())));
        let mut peaks = peaks(answer);
        // Where nothing on show has a peak, all are visited.
        if peaks.iter().any(|peak| on_show(peak.of)) {
            peaks.retain(|peak| on_show(peak.of));
        }
        // Peaks this close are told apart by no one.
        let near = 1e-9;
        let found = if forward {
            peaks.iter().find(|peak| peak.time > now + near).or(peaks.first())
        } else {
            peaks.iter().rfind(|peak| peak.time < now - near).or(peaks.last())
        };
        if let Some(peak) = found {
            self.moment = Moment::At(peak.time);
            self.playing = false;
        }
    }
}

/// A peak worth a visit.
#[derive(Debug, Clone, PartialEq)]
pub struct Visit {
    /// Of which result.
    pub of: Quantity,
    /// What and how much.
    pub label: String,
    /// When, in s.
    pub time: f64,
}

/// Every peak of an answer in the order of time.
pub fn peaks(answer: &Answer) -> Vec<Visit> {
    let visit = |of: &Quantity| {
        let (peak, figure) = (answer.peak(*of)?, Figure::of(answer, *of)?);
        Some(Visit { of: *of, label: format!("{} {figure}", of.row().short), time: peak.time })
    };
    let mut peaks: Vec<Visit> = Quantity::ALL.iter().filter_map(visit).collect();
    peaks.sort_by(|a, b| a.time.total_cmp(&b.time));
    peaks
}

/// The peaks at a time, if there are any, in the longest words that fit; no name without its value.
pub fn peak_said(answer: &Answer, time: f64, fits: impl Fn(&str) -> bool) -> Option<String> {
    let here = peaks(answer).into_iter();
    let here: Vec<Visit> = here.filter(|p| (p.time - time).abs() < 1e-9).collect();
    let whole: Vec<&str> = here.iter().map(|peak| &peak.label[..]).collect();
    let some = |said: &[&str], count: usize| match said.len() - count {
        0 => format!("peak {}", said.join(", ")),
        more => format!("peak {} and {more} more", said[..count].join(", ")),
    };
    let forms = (1..=here.len()).rev().map(|count| some(&whole, count));
    let many = (here.len() > 1).then(|| format!("{} peaks", here.len()));
    forms.chain(many).find(|text| fits(text))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::solve;
    use crate::run::kept::{Keep, Spacing};
    use crate::run::watch::unwatched;
    use crate::scenario::CheckedScenario;

    #[test]
    fn g_visits_every_peak_in_order_and_goes_round() {
        let answer = solve(&CheckedScenario::default(), Keep::default(), &mut unwatched).unwrap();
        let all = peaks(&answer);
        let mut clock = Clock { moment: Moment::At(0.0), ..Clock::default() };
        for peak in &all {
            clock.jump(&answer, true, |_| true);
            assert_eq!(clock.moment, Moment::At(peak.time));
            let said = |most: usize| peak_said(&answer, peak.time, |text| text.len() <= most);
            assert!(said(1000).unwrap().contains(&peak.label));
            assert_eq!(said(3), None);
        }
        clock.jump(&answer, true, |_| true);
        assert_eq!(clock.moment, Moment::At(all[0].time));
        clock.jump(&answer, false, |_| true);
        assert_eq!(clock.moment, Moment::At(all[all.len() - 1].time));
        for _ in 0..3 {
            clock.jump(&answer, true, |of| of == Quantity::ForceRight);
            assert_eq!(clock.moment, Moment::At(answer.peak(Quantity::ForceRight).unwrap().time));
        }
    }

    #[test]
    fn time_follows_the_wall_clock_and_starts_again_at_the_end() {
        let mut clock = Clock { playing: true, ..Clock::default() };
        clock.advance(2.0, 0.0, 3e-3);
        assert_eq!(clock.moment, Moment::At(1e-3));
        clock.advance(10.0, 1e-3, 3e-3);
        assert_eq!(clock.moment, Moment::At(0.0));
        let spacing = Spacing { early: 12, early_every: 1e-5, every: 1e-4, doubles: false };
        let keep = Keep { traces: false, frames: Some(spacing) };
        let answer = solve(&CheckedScenario::default(), keep, &mut unwatched).unwrap();
        let frames = &answer.run.frames;
        clock.step(Step::MUCH_MORE, 0.0, frames, 3e-3);
        assert!(!clock.playing);
        let time = |clock: &Clock| clock.time_in(Some((&answer, answer.window())));
        assert!((time(&clock) - 1e-4).abs() < 1e-12);
        clock.step(Step::MUCH_MORE, 1e-4, frames, 3e-3);
        assert!((time(&clock) - 9.2e-4).abs() < 1e-12, "two early, eight late");
        clock.step(Step::LESS, 9.2e-4, frames, 3e-3);
        assert!((time(&clock) - 8.2e-4).abs() < 1e-12);
    }
}
