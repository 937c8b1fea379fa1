//! Where a blow stands among known objects at the speeds at which they usually hit eyes: by what a
//! tissue felt, a mean of its logarithm over the six directions from which hits come.
//!
//! Kinds differ in their points of 50 % as well, so an equal measure is no equal risk.

use crate::answer::solve::Answer;
use crate::injury::{Injury, KINDS, PerInjury};
use crate::report::format::significant;
use crate::verify::clinics::felt::{FeltTable, stored};
use libm::{exp10, log10};
use std::sync::LazyLock;

/// An object on the ladder, or the blow itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Rung {
    /// Several of a kind with their speed; none of the blow itself.
    pub objects: Option<String>,
    /// What its tissue felt, in the unit of the measure.
    pub felt: f64,
}

/// What tissues feel of each kind at its usual speed, in the units of the measures.
static USUAL: LazyLock<Vec<PerInjury<f64>>> = LazyLock::new(|| {
    let rows = stored();
    let felt = |kind| {
        let (logs, _) = FeltTable::of(kind, &rows).at(log10(kind.usual_m_s));
        let mean = |j: usize| logs.iter().map(|log| log[j]).sum::<f64>() / logs.len() as f64;
        std::array::from_fn(|j| exp10(mean(j)))
    };
    KINDS.iter().map(felt).collect()
});

/// All kinds and the blow itself by what the injury's tissue felt, most first; none of an answer
/// without risks.
pub fn ladder(answer: &Answer, injury: Injury) -> Vec<Rung> {
    let felt = answer.felt();
    let j = injury as usize;
    let of = |felt: &[crate::injury::Felt]| {
        let logs = felt.iter().map(|felt| log10(felt.measures[j].max(f64::MIN_POSITIVE)));
        injury.measure().row().factor * exp10(logs.sum::<f64>() / felt.len() as f64)
    };
    if felt.is_empty() || answer.silence().is_some() {
        return Vec::new();
    }
    let kinds = KINDS.iter().zip(&*USUAL).map(|(kind, felt)| Rung {
        objects: Some(format!("{} at {} m/s", kind.name, kind.usual_m_s)),
        felt: felt[j],
    });
    let mut all: Vec<Rung> = kinds.chain([Rung { objects: None, felt: of(&felt) }]).collect();
    all.sort_by(|a, b| b.felt.total_cmp(&a.felt));
    all
}

/// Between which objects a blow stands, in a sentence; none where there is no ladder.
pub fn between(answer: &Answer, injury: Injury) -> Option<String> {
    let all = ladder(answer, injury);
    let own = all.iter().position(|rung| rung.objects.is_none())?;
    let row = injury.measure().row();
    let said = |rung: &Rung| {
        let felt = significant(format!("{:.1e}", rung.felt).parse().unwrap_or(rung.felt));
        let felt = felt.trim_end_matches('0').trim_end_matches('.');
        rung.objects.as_ref().map(|objects| format!("{objects} bring ({felt} {})", row.unit))
    };
    let less = all.get(own + 1).and_then(said).map(|of| format!("more than {of}"));
    let more = own.checked_sub(1).and_then(|i| said(&all[i])).map(|of| format!("less than {of}"));
    let both: Vec<String> = less.into_iter().chain(more).collect();
    Some(format!("{}: {}", row.label, both.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::tests::answered;
    use crate::scenario::library::tests::preset;

    #[test]
    fn a_blow_climbs_the_ladder_with_its_speed() {
        let place = |speed: &str| {
            let answer = answered(&preset("airsoft-75", &[("impact.speed_m_s", speed)]));
            let all = ladder(&answer, Injury::Hyphema);
            assert_eq!(all.len(), KINDS.len() + 1);
            assert!(all.is_sorted_by(|a, b| a.felt >= b.felt));
            all.iter().position(|rung| rung.objects.is_none()).unwrap()
        };
        assert!(place("120") < place("55") && place("55") < place("10"));
        let said = between(&answered(&preset("airsoft-75", &[])), Injury::Hyphema).unwrap();
        assert!(said.contains(": more than ") && said.contains(" m/s bring ("), "{said}");
        assert_eq!(between(&answered(&preset("paper-300n", &[])), Injury::Hyphema), None);
    }
}
