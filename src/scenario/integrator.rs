//! The integrators that a scenario may name, or `Auto`; see `models::paper::time::method`.

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

impl Integrator {
    /// All integrators.
    pub const ALL: &'static [Self] = <Self as strum::VariantArray>::VARIANTS;

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
