//! The risk of each injury after one blow: a share of eyes, and the range that it may have.
//!
//! With L the object's point of 50 % (log10, known to s) and eyes that differ by sigma, an eye
//! whose tissue felt m is hurt with z = (log10 m - L)/sigma: told is Phi(z/sqrt(1 + s^2/sigma^2)),
//! its 80 % range Phi((log10 m -+ 1.28 s - L)/sigma); where that lies all to one side of what is
//! told, the range of the same 80 % that begins, or ends, half as far out as what is told. To s
//! come, in quadrature, the error of the step and what the person doubts of the object. Of a globe
//! it is 1 - (1 - that) (1 - the chance of a way in). Where a blow may come from several directions
//! all are means over them.
//!
//! Of those who come to a clinic after such a blow the share follows [`crate::injury::clinic`]. It
//! hangs on all injuries at once, so it is the mean, and its range the middle 80 %, over draws of
//! all points, of what the person doubts, and of how much is found and written down.
//!
//! Left out: that injuries hang together, but for what the words say of an open globe.

use crate::injury::blow::{Blow, Population};
use crate::injury::clinic::{Coming, Setting};
use crate::injury::kind::{Injury, PerInjury};
use crate::injury::outcomes::Outcome;
use crate::injury::points::Point;
use crate::injury::way_in::WayIn;
use crate::normal;
use libm::{hypot, log10};
use std::sync::LazyLock;

/// The share of what it may be that a range holds.
const HELD: f64 = 0.8;
/// Standard deviations out to which what is told is looked for, and how often that is halved.
const FARTHEST: f64 = 8.0;
const HALVINGS: u32 = 40;
/// Laboratories and clinics differ where one tells more than so many times the other.
const DIFFER: f64 = 3.0;
/// Below this share a difference is of no account.
const OF_ACCOUNT: f64 = 0.05;
/// A range so wide that nobody counted says nothing as a figure.
const WIDE: f64 = 0.7;
/// A lower end from which on it says something, whatever the upper one.
const LITTLE: f64 = 0.1;
/// Draws that the share of those who come is a mean over, each with its mirror image.
const DRAWS: usize = 128;
/// Numbers of one draw: the point and what is found of each injury, and what the person doubts.
const DRAWN: usize = 2 * Injury::ALL.len() + 1;
/// How far the judged share that is found and written down is known: a deviation of its log odds.
const FOUND_KNOWN: f64 = 0.5;

/// What the tissues felt of one direction of a blow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Felt {
    /// The measure of each injury, SI.
    pub measures: PerInjury<f64>,
    /// The share of each by which the run may be wrong.
    pub errors: PerInjury<f64>,
    /// Whether the object may go in from there.
    pub way_in: Option<WayIn>,
    /// How likely this direction is against the others.
    pub weight: f64,
}

/// A share of eyes with its range, 0 to 1: 80 % of what it may be lie in it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Share {
    /// The middle of what is believed.
    pub told: f64,
    /// One in ten is less, or fewer where that would leave out what is told.
    pub low: f64,
    /// One in ten is more, or fewer.
    pub high: f64,
}

/// The risk of one injury.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Risk {
    /// The injury.
    pub injury: Injury,
    /// Of eyes that are hit so.
    pub hit: Share,
    /// Of those that come to a clinic after it; none of a laboratory's eyes.
    pub clinic: Option<Share>,
    /// Of eyes of donors in laboratories, where that is another answer.
    pub laboratory: Option<Share>,
    /// What was counted of objects near enough, and their name.
    pub counted: Option<(&'static Outcome, &'static str)>,
    /// Whether anything was counted of objects near enough.
    pub of_counted_kind: bool,
    /// What the tissue felt over what hurts half of all eyes, a mean over directions.
    pub of_half: f64,
    /// Whether the run can be believed at all.
    pub usable: bool,
    /// Whether the run ended while the measure may still grow.
    pub cut: bool,
}

/// Which part of what is believed is asked for.
#[derive(Clone, Copy)]
enum Part {
    /// The middle.
    Told,
    /// So many standard deviations to the side of more.
    Off(f64),
}

impl Point {
    /// Told of eyes whose tissue felt so many times what hurts half of them.
    pub fn share(&self, times: f64) -> f64 {
        if times > 0.0 { self.chance(times * libm::exp10(self.log), 0.0, Part::Told) } else { 0.0 }
    }

    /// The chance that an eye is hurt whose tissue felt `measure`, known to `more` beside the
    /// point.
    fn chance(&self, measure: f64, more: f64, part: Part) -> f64 {
        let s = hypot(self.known, more);
        let z = (log10(measure) - self.log) / self.eyes;
        normal::below(match part {
            Part::Told => z / hypot(1.0, s / self.eyes),
            Part::Off(by) => z + by * s / self.eyes,
        })
    }
}

/// The chance of one injury from one direction.
fn chance(blow: &Blow, points: &PerInjury<Point>, injury: usize, felt: &Felt, part: Part) -> f64 {
    let step = log10(1.0 + felt.errors[injury]);
    let more = hypot(step, blow.doubted.0);
    let measure = felt.measures[injury];
    let torn = if measure > 0.0 { points[injury].chance(measure, more, part) } else { 0.0 };
    let way_in = felt.way_in.filter(|_| injury == Injury::GlobeRupture as usize);
    let Some(way_in) = way_in else { return torn };
    let doubted = blow.doubted_way_in();
    let more = match part {
        Part::Told => way_in.z * (1.0 / hypot(1.0, doubted) - 1.0),
        Part::Off(by) => by * doubted,
    };
    1.0 - (1.0 - torn) * (1.0 - way_in.chance(more))
}

/// The mean over directions.
fn mean(felt: &[Felt], of: impl Fn(&Felt) -> f64) -> f64 {
    let all: f64 = felt.iter().map(|felt| felt.weight).sum();
    felt.iter().map(|felt| felt.weight * of(felt)).sum::<f64>() / all
}

impl Share {
    /// What is told and the middle of what it may be, which has the share `p` of it below `at(p)`.
    /// Where what is told lies beyond an end of that, and `below()` of it all is less, the range
    /// goes on to half as far out and holds as much.
    fn around(told: f64, at: impl Fn(f64) -> f64, below: impl FnOnce() -> f64) -> Self {
        let tail = 0.5 * (1.0 - HELD);
        let (low, high) = (at(tail), at(1.0 - tail));
        if (low..=high).contains(&told) {
            return Self { told, low, high };
        }
        let below = below();
        let from = if told < low { 0.5 * below } else { 1.0 - HELD - 0.5 * (1.0 - below) };
        Self { told, low: at(from).min(told), high: at(from + HELD).max(told) }
    }

    /// Of what rises with its [`Part::Off`].
    fn of(each: impl Fn(Part) -> f64) -> Self {
        let told = each(Part::Told);
        // The whole of a distribution would lie infinitely far out.
        let at = |below: f64| each(Part::Off(normal::quantile(below.clamp(1e-15, 1.0 - 1e-15))));
        Self::around(told, at, || {
            let (mut less, mut more) = (-FARTHEST, FARTHEST);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (less + more);
                *if each(Part::Off(middle)) < told { &mut less } else { &mut more } = middle;
            }
            normal::below(less)
        })
    }

    /// Both ends of its range.
    pub fn ends(&self) -> (f64, f64) {
        (self.low, self.high)
    }
}

/// The share of all eyes that were hit so, by these points.
fn by_points(blow: &Blow, points: &PerInjury<Point>, injury: usize, felt: &[Felt]) -> Share {
    Share::of(|part| mean(felt, |felt| chance(blow, points, injury, felt, part)))
}

/// The share of all eyes that were hit so.
pub fn hit(blow: &Blow, injury: Injury, felt: &[Felt]) -> Share {
    by_points(blow, &blow.points, injury as usize, felt)
}

/// Numbers of a standard normal distribution, a row a draw.
static NORMAL: LazyLock<Vec<[f64; DRAWN]>> = LazyLock::new(|| {
    let row = |draw| std::array::from_fn(|dimension| normal::draw(draw as u32, dimension as u32));
    (0..DRAWS).map(row).flat_map(|row| [row, row.map(|x: f64| -x)]).collect()
});

/// The chance of each injury from one direction, of points that lie off by a draw.
fn drawn(blow: &Blow, felt: &Felt, draw: &[f64; DRAWN]) -> PerInjury<f64> {
    let doubted = draw[DRAWN - 1];
    std::array::from_fn(|j| {
        let point = &blow.points[j];
        let step = log10(1.0 + felt.errors[j]);
        let off = hypot(point.known, step) * draw[j] + blow.doubted.0 * doubted;
        let measure = felt.measures[j];
        let z = (log10(measure) - point.log + off) / point.eyes;
        let torn = if measure > 0.0 { normal::below(z) } else { 0.0 };
        let way_in = felt.way_in.filter(|_| j == Injury::GlobeRupture as usize);
        let enters = way_in.map_or(0.0, |way| way.chance(blow.doubted_way_in() * doubted));
        1.0 - (1.0 - torn) * (1.0 - enters)
    })
}

/// The share of each injury among those who come.
fn coming(blow: &Blow, felt: &[Felt]) -> PerInjury<Share> {
    let setting = Setting::WalkIn;
    let of = |draw: &[f64; DRAWN]| -> PerInjury<f64> {
        let mut sum = Coming::default();
        for felt in felt {
            let each = setting.coming(&drawn(blow, felt, draw));
            sum.all += felt.weight * each.all;
            for (sum, with) in sum.with.iter_mut().zip(each.with) {
                *sum += felt.weight * with;
            }
        }
        std::array::from_fn(|j| {
            let off = libm::exp(FOUND_KNOWN * draw[Injury::ALL.len() + j]);
            let seen = setting.seen()[j];
            seen * off / (1.0 - seen + seen * off) * sum.with[j] / sum.all
        })
    };
    let all: Vec<PerInjury<f64>> = NORMAL.iter().map(of).collect();
    std::array::from_fn(|j| {
        let mut shares: Vec<f64> = all.iter().map(|shares| shares[j]).collect();
        shares.sort_unstable_by(f64::total_cmp);
        let told = shares.iter().sum::<f64>() / shares.len() as f64;
        let count = shares.len() as f64;
        let at = |below: f64| shares[((below * count) as usize).min(shares.len() - 1)];
        Share::around(told, at, || shares.partition_point(|share| *share < told) as f64 / count)
    })
}

/// The chance that an eye is hurt, told, of one direction that was computed without its error.
pub fn told(blow: &Blow, injury: Injury, felt: &Felt) -> f64 {
    chance(blow, &blow.points, injury as usize, felt, Part::Told)
}

/// All that is believed of each injury after a blow that tissues felt so; `cut` where it may grow.
pub fn assess(blow: &Blow, felt: &[Felt], cut: &PerInjury<bool>) -> PerInjury<Risk> {
    let living = blow.population == Population::Living;
    let coming = living.then(|| coming(blow, felt));
    std::array::from_fn(|j| {
        let mut own = by_points(blow, &blow.points, j, felt);
        let mut clinic = coming.map(|coming| coming[j]);
        if cut[j] {
            own.high = 1.0;
            clinic = clinic.map(|clinic| Share { high: 1.0, ..clinic });
        }
        let laboratory = blow.laboratory.as_ref().map(|points| by_points(blow, points, j, felt));
        let differs = |other: &Share| {
            let (less, more) = (own.told.min(other.told), own.told.max(other.told));
            let says_something = other.high - other.low <= WIDE;
            says_something && more > OF_ACCOUNT && more > DIFFER * less
        };
        let half = |felt: &Felt| felt.measures[j] / libm::exp10(blow.points[j].log);
        Risk {
            injury: Injury::ALL[j],
            hit: own,
            clinic,
            laboratory: laboratory.filter(differs),
            counted: blow.counted[j].zip(blow.near),
            of_counted_kind: blow.near.is_some(),
            of_half: mean(felt, half),
            usable: true,
            cut: cut[j],
        }
    })
}

impl Risk {
    /// The share that counts for a reader: of those who came, or of eyes hit on purpose.
    pub fn share(&self) -> Share {
        self.clinic.unwrap_or(self.hit)
    }

    /// Whether nobody counted objects near enough and the range is too wide to be a figure.
    pub fn is_open(&self) -> bool {
        let Some(Share { low, high, .. }) = self.clinic else { return false };
        self.usable && self.counted.is_none() && high - low > WIDE && low < LITTLE
    }
}

/// The chance that one blow is worse for an injury than another, with what both share taken out.
pub fn worse(injury: Injury, a: (&Blow, &[Felt]), b: (&Blow, &[Felt])) -> f64 {
    let j = injury as usize;
    let known = crate::injury::points::apart_known(a.0.features.as_ref(), b.0.features.as_ref())[j];
    let z = |(blow, felt): (&Blow, &[Felt])| {
        let share = mean(felt, |felt| chance(blow, &blow.points, j, felt, Part::Told));
        let point = &blow.points[j];
        // As a single direction that tells the same would have it.
        let spread = hypot(1.0, hypot(point.known, blow.doubted.0) / point.eyes);
        normal::quantile(share.clamp(1e-12, 1.0 - 1e-12)) * spread
    };
    let eyes = a.0.points[j].eyes;
    let doubt = hypot(a.0.doubted.0, b.0.doubted.0);
    let step = |felt: &[Felt]| mean(felt, |felt| log10(1.0 + felt.errors[j]));
    let error = hypot(step(a.1), step(b.1));
    let sd = hypot(hypot(known, doubt), error).max(1e-6);
    normal::below(eyes * (z(a) - z(b)) / sd)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::library::tests::preset;

    const HYPHEMA: usize = Injury::Hyphema as usize;

    fn felt(blow: &Blow, times: f64, error: f64) -> Felt {
        let measures = blow.points.map(|point| times * libm::exp10(point.log));
        let none = PerInjury::default();
        Felt { measures, errors: none.map(|_: f64| error), way_in: None, weight: 1.0 }
    }

    #[test]
    fn half_of_the_eyes_are_hurt_at_the_point_of_50_percent_and_ranges_hold_what_is_told() {
        let blow = Blow::of(&preset("squash-ball", &[]));
        let of = |felt: &[Felt]| assess(&blow, felt, &PerInjury::default());
        for injury in Injury::ALL {
            let mut before = 0.0;
            for times in [0.01, 0.3, 1.0, 3.0, 100.0] {
                let risk = of(&[felt(&blow, times, 0.0)])[*injury as usize];
                for share in [risk.hit, risk.clinic.unwrap()] {
                    assert!(share.low <= share.told && share.told <= share.high, "{risk:?}");
                }
                assert!(risk.hit.told >= before && risk.clinic.unwrap().told <= 1.0);
                assert!((risk.of_half / times - 1.0).abs() < 1e-9);
                before = risk.hit.told;
            }
            let half = of(&[felt(&blow, 1.0, 0.0)])[*injury as usize];
            assert!((half.hit.told - 0.5).abs() < 1e-12, "{half:?}");
        }
    }

    #[test]
    fn what_is_told_lies_inside_its_range_and_not_at_its_end() {
        let blow = Blow::of(&preset("squash-ball", &[]));
        let wide = |times: f64| {
            let felt = Felt { errors: [1.0; Injury::ALL.len()], ..felt(&blow, times, 0.0) };
            assess(&blow, &[felt], &PerInjury::default())[Injury::Hyphema as usize].hit
        };
        for times in [0.02, 0.2, 1.0, 5.0, 50.0] {
            let Share { told, low, high } = wide(times);
            assert!(low < told && told < high, "{times}: {low} {told} {high}");
        }
        // Of what is skewed one in ten may lie above what is told, but the range holds as much.
        let share = Share::of(|part| match part {
            Part::Told => normal::below(-2.0),
            Part::Off(by) => normal::below(by),
        });
        let held = |end: f64| normal::quantile(end);
        let (low, high) = (held(share.low), held(share.high));
        assert!((normal::below(high) - normal::below(low) - HELD).abs() < 1e-6);
        assert!(share.low < share.told && (share.low / share.told - 0.5).abs() < 1e-6);
    }

    #[test]
    fn an_error_of_the_step_widens_and_directions_are_averaged() {
        let blow = Blow::of(&preset("paintball", &[]));
        let wide = |error: f64| {
            let risk = assess(&blow, &[felt(&blow, 1.0, error)], &PerInjury::default());
            let [hit, clinic] = [risk[HYPHEMA].hit, risk[HYPHEMA].clinic.unwrap()];
            (hit.high - hit.low).min(clinic.high - clinic.low)
        };
        assert!(wide(0.0) < wide(0.2) && wide(0.2) < wide(0.5));
        let of = |felt: &[Felt]| assess(&blow, felt, &PerInjury::default())[HYPHEMA].hit.told;
        let (one, other) = (felt(&blow, 0.5, 0.0), felt(&blow, 2.0, 0.0));
        assert!((of(&[one, other]) - 0.5 * (of(&[one]) + of(&[other]))).abs() < 1e-12);
    }

    #[test]
    fn a_harder_blow_of_the_same_ball_is_surely_worse_and_an_equal_one_as_likely_as_not() {
        let blow = Blow::of(&preset("squash-ball", &[]));
        let (soft, hard) = (felt(&blow, 0.8, 0.01), felt(&blow, 1.2, 0.01));
        let worse =
            |a: &Felt, b: &Felt| worse(Injury::Hyphema, (&blow, &[*a][..]), (&blow, &[*b][..]));
        assert!(worse(&hard, &soft) > 0.999 && worse(&soft, &hard) < 1e-3);
        assert!((worse(&soft, &soft) - 0.5).abs() < 1e-9);
    }
}
