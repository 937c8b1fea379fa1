//! The integrators that a scenario may name, or `Auto`, with what is asked of them without a step.
//!
//! Left out: how each makes a step, which is with the model whose springs it moves.

use crate::scenario::auto::AUTO;
use serde::{Deserializer, Serializer, de};
use std::fmt;
use std::sync::LazyLock;

/// A method that moves the eye through time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, strum::VariantArray, strum::IntoStaticStr)]
pub enum Integrator {
    /// The paper's scheme, first order.
    SemiImplicitEuler,
    /// Second order, drag solved exactly.
    VelocityVerlet,
    /// Fourth order, six force evaluations a step.
    Srkn6b,
    /// Sixth order, eleven force evaluations a step.
    Srkn11b,
    /// The classical Runge-Kutta method.
    Rk4,
    /// The Dormand-Prince pair, which chooses its own steps.
    Dopri5,
}

struct IntegratorFacts {
    name: &'static str,
    letter: char,
    about: &'static str,
    order: i32,
    evaluations: usize,
    chooses_its_steps: bool,
}

impl Integrator {
    /// All integrators.
    pub const ALL: &'static [Self] = <Self as strum::VariantArray>::VARIANTS;

    /// All that is known of it without a step, from the one table.
    const fn facts(self) -> IntegratorFacts {
        match self {
            Self::SemiImplicitEuler => IntegratorFacts {
                name: "semi-implicit-euler",
                letter: 'E',
                about: "The paper's scheme: v += a dt, x += v dt.",
                order: 1,
                evaluations: 1,
                chooses_its_steps: false,
            },
            Self::VelocityVerlet => IntegratorFacts {
                name: "velocity-verlet",
                letter: 'A',
                about: "Half a kick, a drift, half a kick: the cheapest where 1 % will do.",
                order: 2,
                evaluations: 1,
                chooses_its_steps: false,
            },
            Self::Srkn6b => IntegratorFacts {
                name: "srkn6b",
                letter: 'B',
                about: "Blanes and Moan's symmetric composition of six stages: takes most answers.",
                order: 4,
                evaluations: 6,
                chooses_its_steps: false,
            },
            Self::Srkn11b => IntegratorFacts {
                name: "srkn11b",
                letter: 'N',
                about: "Blanes and Moan's symmetric composition of eleven stages: the most accurate.",
                order: 6,
                evaluations: 11,
                chooses_its_steps: false,
            },
            Self::Rk4 => IntegratorFacts {
                name: "rk4",
                letter: 'R',
                about: "The classical Runge-Kutta method, in equal steps.",
                order: 4,
                evaluations: 4,
                chooses_its_steps: false,
            },
            Self::Dopri5 => IntegratorFacts {
                name: "dopri5",
                letter: 'D',
                about: "The Dormand-Prince pair 5(4), which chooses its own steps.",
                order: 5,
                evaluations: 6,
                chooses_its_steps: true,
            },
        }
    }

    /// Name as typed on the command line.
    pub const fn name(self) -> &'static str {
        self.facts().name
    }

    /// The capital that stands for it on plots.
    pub const fn letter(self) -> char {
        self.facts().letter
    }

    /// What it is, for people, in one sentence.
    pub const fn about(self) -> &'static str {
        self.facts().about
    }

    /// Order of convergence: the error falls with this power of the step.
    pub const fn order(self) -> i32 {
        self.facts().order
    }

    /// Force evaluations a step, with one that consecutive steps share counted once.
    pub const fn evaluations(self) -> usize {
        self.facts().evaluations
    }

    /// Whether it chooses its own step lengths.
    pub const fn chooses_its_steps(self) -> bool {
        self.facts().chooses_its_steps
    }

    /// Its name as a scenario spells it, as in `VelocityVerlet`.
    pub fn spelling(self) -> &'static str {
        self.into()
    }
}

/// How a scenario spells a choice of integrator.
pub(super) fn spelling(choice: Option<Integrator>) -> &'static str {
    choice.map_or(AUTO, Integrator::spelling)
}

/// Every choice that a scenario may spell.
pub(super) fn choices() -> impl Iterator<Item = Option<Integrator>> {
    let named = Integrator::ALL.iter().copied().map(Some);
    [None].into_iter().chain(named)
}

static SPELLINGS: LazyLock<Vec<&'static str>> = LazyLock::new(|| choices().map(spelling).collect());

/// Writes a choice as if `Auto` were one more variant.
#[expect(clippy::trivially_copy_pass_by_ref, clippy::ref_option, reason = "serde lends the field")]
pub(super) fn serialize<S: Serializer>(
    choice: &Option<Integrator>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let index = choices().take_while(|c| c != choice).count();
    serializer.serialize_unit_variant("Integrator", index as u32, spelling(*choice))
}

/// Reads what [`serialize`] writes.
pub(super) fn deserialize<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Integrator>, D::Error> {
    deserializer.deserialize_identifier(ChoiceVisitor)
}

struct ChoiceVisitor;

impl de::Visitor<'_> for ChoiceVisitor {
    type Value = Option<Integrator>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("an integrator")
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Self::Value, E> {
        let named = choices().find(|choice| spelling(*choice) == name);
        named.ok_or_else(|| E::unknown_variant(name, &SPELLINGS))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrators_are_told_apart_by_name_and_letter() {
        for (i, one) in Integrator::ALL.iter().enumerate() {
            for other in &Integrator::ALL[..i] {
                assert!(one.name() != other.name() && one.letter() != other.letter());
            }
        }
    }
}
