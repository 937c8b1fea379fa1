//! What a run reads off the eye, under the public names.

use crate::run::{kept::Peak, quantity::Quantity};
use std::ops::{Index, IndexMut};
use strum::EnumCount;

/// One `T` for each [`Quantity`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PerQuantity<T>([T; Quantity::COUNT]);

impl<T> PerQuantity<T> {
    /// The values that `of` gives for each quantity.
    pub fn from_fn(mut of: impl FnMut(Quantity) -> T) -> Self {
        Self(std::array::from_fn(|i| of(Quantity::ALL[i])))
    }

    /// Each result with what belongs to it, in the order of the table.
    pub fn iter(&self) -> impl Iterator<Item = (Quantity, &T)> {
        Quantity::ALL.iter().copied().zip(&self.0)
    }

    /// What `of` makes of each.
    pub fn map<U>(&self, mut of: impl FnMut(Quantity, &T) -> U) -> PerQuantity<U> {
        PerQuantity::from_fn(|quantity| of(quantity, &self[quantity]))
    }
}

impl<T> Index<Quantity> for PerQuantity<T> {
    type Output = T;

    fn index(&self, quantity: Quantity) -> &T {
        &self.0[quantity as usize]
    }
}

impl<T> IndexMut<Quantity> for PerQuantity<T> {
    fn index_mut(&mut self, quantity: Quantity) -> &mut T {
        &mut self.0[quantity as usize]
    }
}

/// One reading of a run, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// The largest value over time, or the last one.
    pub value: f64,
    /// When it was largest, in s; none of a number without a time.
    pub time: Option<f64>,
}

impl From<Peak> for Reading {
    fn from(peak: Peak) -> Self {
        Self { value: peak.value, time: Some(peak.time) }
    }
}

impl From<f64> for Reading {
    fn from(value: f64) -> Self {
        Self { value, time: None }
    }
}

/// All readings of a run; `None` where the model or the scene has no such reading.
pub type Readings = PerQuantity<Option<Reading>>;

impl Readings {
    /// The value of one, SI.
    pub fn value(&self, of: Quantity) -> Option<f64> {
        self[of].map(|reading| reading.value)
    }

    /// The largest value of one over time, SI; none of a number without a time.
    pub fn peak(&self, of: Quantity) -> Option<Peak> {
        let Reading { value, time } = self[of]?;
        time.map(|time| Peak { value, time })
    }

    /// When the last of them was largest, in s.
    pub fn last_peak(&self) -> f64 {
        let times = self.iter().filter_map(|(_, reading)| (*reading)?.time);
        times.fold(0.0, f64::max)
    }
}
