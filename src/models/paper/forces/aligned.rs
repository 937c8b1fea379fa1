//! A vector of `f64` that starts on a cache line, so that eight-lane loads never straddle two.
//!
//! Plain `Vec` guarantees 8 bytes; the allocation is made a little larger and entered at the first
//! aligned element.

use crate::models::paper::forces::layout::RowPlace;
use nalgebra::Vector2;
use std::ops::{Deref, DerefMut};

const LINE_BYTES: usize = 64;

/// A fixed-length run of `f64`, aligned to 64 bytes.
#[derive(Debug, Default)]
pub struct Aligned {
    data: Vec<f64>,
    start: usize,
    len: usize,
}

impl Aligned {
    /// `len` zeros.
    pub fn zeros(len: usize) -> Self {
        let spare = LINE_BYTES / size_of::<f64>();
        let data = vec![0.0; len + spare];
        // `align_offset` may decline to answer; then the run is merely unaligned.
        let start = data.as_ptr().align_offset(LINE_BYTES).min(spare);
        Self { data, start, len }
    }
}

impl Clone for Aligned {
    fn clone(&self) -> Self {
        let mut copy = Self::zeros(self.len);
        copy.copy_from_slice(self);
        copy
    }
}

impl Deref for Aligned {
    type Target = [f64];
    #[inline]
    fn deref(&self) -> &[f64] {
        &self.data[self.start..self.start + self.len]
    }
}

impl DerefMut for Aligned {
    #[inline]
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.data[self.start..self.start + self.len]
    }
}

/// x and y of every place of the rows.
#[derive(Debug, Clone, Default)]
pub(crate) struct Pairs {
    pub x: Aligned,
    pub y: Aligned,
}

impl Pairs {
    pub fn zeros(len: usize) -> Self {
        Self { x: Aligned::zeros(len), y: Aligned::zeros(len) }
    }

    /// Both as plain slices, for loops to borrow once.
    #[inline]
    pub fn slices(&self) -> (&[f64], &[f64]) {
        (&self.x, &self.y)
    }

    #[inline]
    pub fn slices_mut(&mut self) -> (&mut [f64], &mut [f64]) {
        (&mut self.x, &mut self.y)
    }

    /// The vector at `place`.
    #[inline]
    pub fn at(&self, place: RowPlace) -> Vector2<f64> {
        Vector2::new(self.x[place.slot], place.sign() * self.y[place.slot])
    }

    pub fn put(&mut self, place: RowPlace, of: Vector2<f64>) {
        self.x[place.slot] = of.x;
        self.y[place.slot] = place.sign() * of.y;
    }
}
