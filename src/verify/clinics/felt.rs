//! What tissues felt of each kind of object over speeds and directions: the table that the fit
//! reads.
//!
//! Each row is one run on level 1 as the preset stands, but for speed and direction. The table is
//! stored, since all of it takes some minutes; [`rerun`] computes it again, and a test a few of its
//! rows. Where a blow was refused, as through what it would go, the row says nothing, and log10 of
//! a measure goes on as a power of speed as it does between the others.

use crate::answer::brief::single;
use crate::injury::{Injury, KINDS, ObjectKind, PerInjury};
use crate::run::{ordered, refusal::Refusal, watch::unwatched};
use crate::scenario::direction::{AS_HITS_COME, Side};
use crate::scenario::{Impact, Scenario};
use libm::log10;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

/// The stored table.
const STORED: &str = include_str!("felt.csv");
/// log10 of what a tissue is taken to have felt that nothing touched, in the unit of its measure.
const NOTHING: f64 = -3.0;

/// What the tissues felt of one blow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FeltRow {
    /// The kind of object, by its key.
    pub kind: String,
    /// Speed, m/s.
    pub speed_m_s: f64,
    /// Which of [`AS_HITS_COME`].
    pub direction: usize,
    /// The measure of each injury in its unit; none of a blow that was refused.
    pub equator_percent: Option<f64>,
    /// Retina at the back.
    pub back_percent: Option<f64>,
    /// Retina's front edge.
    pub edge_percent: Option<f64>,
    /// Lens.
    pub lens_mm: Option<f64>,
    /// Root of the iris.
    pub iris_mm: Option<f64>,
    /// Cornea.
    pub cornea_kj_m2: Option<f64>,
}

impl FeltRow {
    /// The measure of each injury in its unit.
    pub fn measures(&self) -> PerInjury<Option<f64>> {
        [
            self.equator_percent,
            self.back_percent,
            self.edge_percent,
            self.lens_mm,
            self.iris_mm,
            self.cornea_kj_m2,
        ]
    }

    /// The blow that it tells of.
    fn scenario(&self) -> Option<Scenario> {
        Some(blow(ObjectKind::find(&self.kind)?, self.speed_m_s, self.direction))
    }

    /// Computes it again.
    #[must_use]
    pub fn rerun(&self) -> Self {
        let felt = self.scenario().map(|scenario| felt(&scenario));
        let [rupture, back, front, lens, hyphema, abrasion] =
            felt.and_then(Result::ok).unwrap_or_default();
        Self {
            equator_percent: rupture,
            back_percent: back,
            edge_percent: front,
            lens_mm: lens,
            iris_mm: hyphema,
            cornea_kj_m2: abrasion,
            ..self.clone()
        }
    }
}

/// A kind of object at a speed from one of the directions as hits come.
fn blow(kind: &ObjectKind, speed_m_s: f64, direction: usize) -> Scenario {
    let mut scenario = kind.scenario();
    if let Impact::Projectile(object) = &mut scenario.impact {
        object.speed_m_s = speed_m_s;
        object.turn_to(Side::Right, AS_HITS_COME[direction]);
    }
    scenario
}

/// What all tissues feel of a blow, to five digits.
fn felt(scenario: &Scenario) -> Result<PerInjury<Option<f64>>, Refusal> {
    let answer = single(&scenario.check()?, None, &mut unwatched)?;
    let rounded = |value: f64| format!("{value:.4e}").parse().unwrap_or(value);
    Ok(std::array::from_fn(|i| answer.values[Injury::ALL[i].measure()].map(rounded)))
}

/// The stored table.
///
/// # Panics
/// Never: a test reads it.
pub fn stored() -> Vec<FeltRow> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(STORED.as_bytes());
    reader.deserialize().map(|row| row.expect("the stored table can be read")).collect()
}

/// Computes the whole table, on all cores; `progress` is told the share done.
pub fn rerun(mut progress: impl FnMut(f64) + Send) -> Vec<FeltRow> {
    let mut rows: Vec<FeltRow> = Vec::new();
    for kind in &KINDS {
        for direction in (0..AS_HITS_COME.len()).rev() {
            rows.extend(kind.speeds.iter().map(|&speed_m_s| FeltRow {
                kind: kind.key.to_owned(),
                speed_m_s,
                direction,
                equator_percent: None,
                back_percent: None,
                edge_percent: None,
                lens_mm: None,
                iris_mm: None,
                cornea_kj_m2: None,
            }));
        }
    }
    let mut done = Vec::new();
    let job = |i: usize| Some(rows[i].rerun());
    ordered::run((0, rows.len()), &AtomicBool::new(false), job, |_, row| {
        done.push(row);
        progress(done.len() as f64 / rows.len() as f64);
        ControlFlow::Continue(())
    });
    done
}

/// log10 of the measures of one kind: by speed, direction and injury, nothing missing.
#[derive(Debug, Clone)]
pub struct FeltTable {
    /// log10 of the speeds, in m/s.
    speeds: Vec<f64>,
    /// By speed and direction.
    logs: Vec<[PerInjury<f64>; AS_HITS_COME.len()]>,
}

impl FeltTable {
    /// Of the rows of one kind.
    pub fn of(kind: &ObjectKind, rows: &[FeltRow]) -> Self {
        let speeds: Vec<f64> = kind.speeds.iter().map(|speed| log10(*speed)).collect();
        let mut logs = vec![[PerInjury::default(); AS_HITS_COME.len()]; speeds.len()];
        for direction in 0..AS_HITS_COME.len() {
            for injury in 0..Injury::ALL.len() {
                let value = |speed: &f64| {
                    let row = rows.iter().find(|row| {
                        row.kind == kind.key
                            && row.direction == direction
                            && row.speed_m_s == *speed
                    });
                    row?.measures()[injury]
                };
                let values: Vec<Option<f64>> = kind.speeds.iter().map(value).collect();
                for (log, filled) in logs.iter_mut().zip(filled(&speeds, &values)) {
                    log[direction][injury] = filled;
                }
            }
        }
        Self { speeds, logs }
    }

    /// log10 of the measures at log10 of a speed by direction, and how they rise with it; beyond
    /// the table as a power of speed.
    pub fn at(
        &self,
        speed: f64,
    ) -> ([PerInjury<f64>; AS_HITS_COME.len()], [PerInjury<f64>; AS_HITS_COME.len()]) {
        let last = self.speeds.len() - 2;
        let below = self.speeds.iter().take_while(|known| **known < speed).count();
        let i = below.saturating_sub(1).min(last);
        let apart = self.speeds[i + 1] - self.speeds[i];
        let (from, to) = (&self.logs[i], &self.logs[i + 1]);
        let each = |of: &dyn Fn(f64, f64) -> f64| {
            std::array::from_fn(|d| std::array::from_fn(|j| of(from[d][j], to[d][j])))
        };
        let share = (speed - self.speeds[i]) / apart;
        (each(&|a, b| a + (b - a) * share), each(&|a, b| (b - a) / apart))
    }
}

/// log10 of values along log10 of speed, those that are missing by the line through the others.
fn filled(speeds: &[f64], values: &[Option<f64>]) -> Vec<f64> {
    let known: Vec<(f64, f64)> = speeds
        .iter()
        .zip(values)
        .filter_map(|(speed, value)| Some((*speed, log10(value.filter(|value| *value > 0.0)?))))
        .collect();
    let (Some(first), Some(last)) = (known.first(), known.last()) else {
        return vec![NOTHING; speeds.len()];
    };
    let count = known.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| known.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|k| k.0), mean(|k| k.1));
    let square: f64 = known.iter().map(|k| (k.0 - x).powi(2)).sum();
    let product: f64 = known.iter().map(|k| (k.0 - x) * (k.1 - y)).sum();
    let slope = if square > 0.0 { product / square } else { 0.0 };
    let at = |speed: &f64| {
        let above = known.iter().position(|k| k.0 >= *speed);
        match above {
            Some(i) if known[i].0 == *speed => known[i].1,
            Some(0) => first.1 + slope * (speed - first.0),
            Some(i) => {
                let (a, b) = (known[i - 1], known[i]);
                a.1 + (b.1 - a.1) * (speed - a.0) / (b.0 - a.0)
            }
            None => last.1 + slope * (speed - last.0),
        }
    };
    speeds.iter().map(at).collect()
}
