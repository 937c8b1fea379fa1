//! What fills the globe: pressure, strain or the forces on its nodes, from low to high.

use nalgebra::{Matrix2, Point2};

use crate::report::picture::globe_cells;
use crate::run::drawing::{Drawing, DrawnCell};
use crate::run::kept::Frame;

pub const STEPS: usize = 11;
/// Share of all values that the scale holds.
const HELD: f64 = 0.997;
/// Largest strain of a scale.
const MOST_STRAIN: f64 = 0.5;
/// Frames that a scale is made from, at most, and a globe's radius above which pressure says more
/// of an object than strain.
const FRAMES: usize = 100;
const LARGE_M: f64 = 6e-3;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TissueField {
    /// Pressure in its cells, Pa.
    Pressure,
    /// The largest stretch of its cells, as a share.
    Strain,
    /// Forces on its nodes, N.
    Force,
}

impl TissueField {
    /// All that an eye has, what tells most of a blow first.
    pub fn all(drawing: &Drawing, frames: &[Frame]) -> Vec<Self> {
        let pressures = frames.iter().any(|frame| !frame.cells.is_empty());
        match drawing.object {
            _ if !pressures => vec![Self::Force, Self::Strain],
            None => vec![Self::Force, Self::Pressure, Self::Strain],
            Some(object) if object.radius < LARGE_M => {
                vec![Self::Strain, Self::Pressure, Self::Force]
            }
            Some(_) => vec![Self::Pressure, Self::Strain, Self::Force],
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Pressure => "pressure",
            Self::Strain => "strain",
            Self::Force => "node force",
        }
    }

    /// A value with its unit; of a strain that is the end of its scale, that there is more.
    pub fn figure(self, value: f64) -> String {
        match self {
            Self::Pressure if value < 1e5 => format!("{} kPa", rounded(value * 1e-3)),
            Self::Pressure => format!("{} MPa", rounded(value * 1e-6)),
            Self::Strain if value >= MOST_STRAIN => "50 %+".to_owned(),
            Self::Strain => format!("{} %", rounded(value * 100.0)),
            Self::Force => format!("{} N", rounded(value)),
        }
    }

    /// The value of each cell of the globe in a frame.
    fn of_cells(self, drawing: &Drawing, frame: &Frame) -> Vec<(DrawnCell, f64)> {
        let value = |cell: &DrawnCell| match self {
            Self::Pressure => drawing.pressure(frame, cell),
            Self::Strain => strain(drawing, frame, cell),
            Self::Force => {
                cell.corners.map(|node| drawing.force(frame, node)).iter().sum::<f64>() / 4.0
            }
        };
        globe_cells(drawing).map(|cell| (*cell, value(cell))).collect()
    }

    /// The value at each node in a frame: the mean of the cells around it.
    pub fn of_nodes(self, drawing: &Drawing, frame: &Frame) -> Vec<f64> {
        if self == Self::Force {
            return (0..drawing.nodes.len()).map(|node| drawing.force(frame, node)).collect();
        }
        let mut sums = vec![(0.0, 0.0); drawing.nodes.len()];
        for (cell, value) in self.of_cells(drawing, frame) {
            for node in cell.corners {
                sums[node].0 += value;
                sums[node].1 += 1.0;
            }
        }
        sums.into_iter().map(|(sum, count)| sum / f64::max(count, 1.0)).collect()
    }

    /// The end of its scale over all frames.
    pub fn largest(self, drawing: &Drawing, frames: &[Frame]) -> f64 {
        let some = frames.iter().step_by(frames.len().div_ceil(FRAMES).max(1));
        let values = some.flat_map(|frame| self.of_cells(drawing, frame)).map(|(_, value)| value);
        let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        if values.is_empty() {
            return 1.0;
        }
        let place = ((values.len() - 1) as f64 * HELD) as usize;
        let (_, value, _) = values.select_nth_unstable_by(place, f64::total_cmp);
        match self {
            Self::Strain => value.clamp(1e-3, MOST_STRAIN),
            _ => value.max(1e-9),
        }
    }
}

/// Two digits.
fn rounded(value: f64) -> f64 {
    let scale = 10_f64.powf(1.0 - value.abs().max(1e-12).log10().floor());
    (value * scale).round() / scale
}

/// The step of a value on a scale to `largest`.
pub fn step(value: f64, largest: f64) -> usize {
    ((value / largest * STEPS as f64).max(0.0) as usize).min(STEPS - 1)
}

/// The largest stretch of a cell: in the plane, or around the axis of an axisymmetric eye.
fn strain(drawing: &Drawing, frame: &Frame, cell: &DrawnCell) -> f64 {
    let nodes = cell.corners.map(|node| &drawing.nodes[node]);
    let rest = nodes.map(|node| node.rest);
    let now = nodes.map(|node| frame.positions[node.of]);
    let diagonals = |p: [Point2<f64>; 4]| Matrix2::from_columns(&[p[2] - p[0], p[3] - p[1]]);
    let Some(inverse) = diagonals(rest).try_inverse() else { return 0.0 };
    let gradient = diagonals(now) * inverse;
    let (sum, product) = (gradient.norm_squared(), gradient.determinant());
    let stretch = (0.5 * (sum + (sum * sum - 4.0 * product * product).max(0.0).sqrt())).sqrt();
    let radius = |p: [Point2<f64>; 4]| p.iter().map(|p| p.y).sum::<f64>();
    let around = if drawing.along.is_some() { radius(now) / radius(rest) } else { 1.0 };
    stretch.max(around) - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_written_in_two_digits_with_its_unit() {
        assert_eq!(TissueField::Pressure.figure(871_000.0), "0.87 MPa");
        assert_eq!(TissueField::Pressure.figure(48_700.0), "49 kPa");
        assert_eq!(TissueField::Strain.figure(0.5), "50 %+");
        assert_eq!(TissueField::Force.figure(11.3), "11 N");
        assert_eq!([step(-1.0, 2.0), step(1.0, 2.0), step(9.0, 2.0)], [0, 5, 10]);
    }
}
