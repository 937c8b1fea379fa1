//! What of a scenario decides how its risks are read: how much its object is like those that were
//! counted, whose eye it is, and what the person doubts.

use crate::injury::kind::{Injury, PerInjury};
use crate::injury::object_kind::{Features, KINDS, features};
use crate::injury::outcomes::{Outcome, counted};
use crate::injury::points::{self, Point};
use crate::injury::way_in::{self, WayIn};
use crate::scenario::{Model, Scenario, Species, Support};
use libm::{hypot, log10};
use std::f64::consts::FRAC_PI_4;

/// Whose eyes an answer speaks of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Population {
    /// Living eyes in their orbits.
    #[default]
    Living,
    /// Eyes of donors and animals in gelatin or free, as in laboratories.
    Laboratory,
}

/// The square of how far apart a counted kind may be to stand beside an object.
const NEAR_ENOUGH: f64 = 0.35;
/// What a decade of speed beyond the usual adds to what is known: a deviation of log10.
const PER_DECADE: f64 = 0.1;
/// By how much log10 of the measures, and of the energy, go with log10 of an input of the object:
/// the first read off the kinds' own tables. What an object is made of stands in its kind's point.
const POWERS: [(&str, f64, f64); 3] =
    [("impact.speed_m_s", 1.2, 2.0), ("impact.mass_g", 0.6, 1.0), ("impact.diameter_mm", 0.8, 2.0)];

/// What of a scenario its risks are read with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blow {
    /// What makes its object like others; none of a pulse.
    pub features: Option<Features>,
    /// Whose eye it is.
    pub population: Population,
    /// Points of 50 % in that population.
    pub points: PerInjury<Point>,
    /// Those of laboratories, where the eye is a living one.
    pub laboratory: Option<PerInjury<Point>>,
    /// Whether it flies faster than its likes hit eyes.
    pub unusual: bool,
    /// Kinetic energy over the object's area, J/m2; none of a pulse.
    pub energy: Option<f64>,
    /// Whether it may go in.
    pub way_in: Option<WayIn>,
    /// What of log10 of a measure the person doubts, and of log10 of its energy.
    pub doubted: (f64, f64),
    /// What was counted of a kind near enough.
    pub counted: PerInjury<Option<&'static Outcome>>,
    /// That kind, as it is named for people.
    pub near: Option<&'static str>,
}

impl Blow {
    /// What `scenario` says.
    pub fn of(scenario: &Scenario) -> Self {
        let object = scenario.projectile();
        let features = object.map(features);
        let beyond = object
            .zip(features.as_ref())
            .map_or(0.0, |(object, of)| PER_DECADE * points::beyond_usual(of, object.speed_m_s));
        let [points, in_laboratory] = [false, true].map(|laboratory| {
            points::points(features.as_ref(), laboratory)
                .map(|point| Point { known: hypot(point.known, beyond), ..point })
        });
        let living = scenario.model.species() == Species::Human
            && scenario.physiological().is_none_or(|model| model.support == Support::Orbit);
        let population = if living { Population::Living } else { Population::Laboratory };
        let near = features.as_ref().map(points::nearest);
        let near = near.filter(|(_, apart)| living && *apart < NEAR_ENOUGH).map(|(kind, _)| kind);
        Self {
            features,
            population,
            points: if living { points } else { in_laboratory },
            laboratory: living.then_some(in_laboratory),
            unusual: beyond > 0.0,
            energy: object.map(|object| {
                object.energy_j() / (FRAC_PI_4 * object.diameter_m() * object.diameter_m())
            }),
            way_in: object.and_then(WayIn::of),
            doubted: doubted(scenario),
            counted: near.map_or_else(Default::default, counted),
            near: near.map(|kind| KINDS[kind].name),
        }
    }

    /// The one of a scenario; none of the Paper model, which has no tissues to read.
    pub fn of_tissues(scenario: &Scenario) -> Option<Self> {
        (scenario.model != Model::Paper).then(|| Self::of(scenario))
    }

    /// Of which energy over area the object brings how many spreads more, for one deviation of
    /// doubt.
    pub(super) fn doubted_way_in(&self) -> f64 {
        self.doubted.1 / way_in::SPREAD
    }

    /// The point of an injury.
    pub fn point(&self, injury: Injury) -> &Point {
        &self.points[injury as usize]
    }
}

/// Deviations of log10 of measures and of energy by what a person doubts of the object.
fn doubted(scenario: &Scenario) -> (f64, f64) {
    let Some(object) = scenario.projectile() else { return (0.0, 0.0) };
    let values = [object.speed_m_s, object.mass_g, object.diameter_mm];
    let each = POWERS.iter().zip(values).map(|((path, measure, energy), value)| {
        let doubt = scenario.doubt.get(*path).copied().unwrap_or_default();
        let off = log10(1.0 + doubt / value);
        (measure * off, energy * off)
    });
    each.fold((0.0, 0.0), |sum, each| (hypot(sum.0, each.0), hypot(sum.1, each.1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::library::tests::preset;

    #[test]
    fn an_object_is_read_beside_its_likes_and_an_eye_in_gelatin_beside_those_of_laboratories() {
        let squash = Blow::of(&preset("squash-ball", &[]));
        assert_eq!((squash.near, squash.population), (Some("squash balls"), Population::Living));
        assert_eq!(squash.counted[Injury::Hyphema as usize].unwrap().count(), "12 of 71");
        let held = Blow::of(&preset("squash-ball", &[("model.support", "Gelatin")]));
        assert_eq!(
            (held.population, held.laboratory, held.near),
            (Population::Laboratory, None, None)
        );
        assert_eq!(Some(held.points), squash.laboratory);
        assert_eq!(Blow::of(&preset("fist", &[])).near, None);
    }

    #[test]
    fn a_doubted_speed_widens_and_what_flies_faster_than_its_likes_is_less_known() {
        let of = |changes: &[(&str, &str)]| Blow::of(&preset("bb-62", changes));
        let (sure, unsure) = (of(&[]), of(&[("impact.speed_m_s", "62.5 ± 10")]));
        assert!(unsure.doubted.0 > sure.doubted.0 && unsure.doubted.1 > sure.doubted.1);
        let fast = of(&[("impact.speed_m_s", "199")]);
        assert!(fast.points.iter().zip(&sure.points).all(|(fast, sure)| fast.known >= sure.known));
    }
}
