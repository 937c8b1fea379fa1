//! The cells in groups of eight along their rows, as many at once as the machine's vectors hold.
//!
//! Constants lie group by group. Along a row of the mesh the corners of neighbouring cells are
//! mostly neighbours in memory: such a group loads its corners and adds its forces by vectors,
//! another by a list. A place of the last group that has no cell stands for the last one, with no
//! stiffness.

#![allow(clippy::needless_range_loop, reason = "corners, components and lanes go together")]

use crate::models::axisymmetric::forces::state::{CellSums, Totals};
use crate::models::paper::forces::aligned::Aligned;
use crate::models::paper::forces::layout::{LANES, Lane};
use crate::models::spatial::forces::cell::{self, Constants, Eight, Fields, field};
use crate::models::spatial::forces::math::{Math, Wide, by_component, eight};
use crate::models::spatial::forces::state::{Cells, NodeState};
use crate::models::spatial::{eye::SpatialEye, eye::point::Nodes, forces::plain};
use fearless_simd::{Level, Simd, dispatch};

/// The nodes of a corner of eight cells.
#[derive(Debug, Clone, Copy)]
enum CornerNodes {
    /// This one and those after it.
    From(usize),
    /// These.
    List([u32; LANES]),
}

/// Eight cells.
struct Group {
    corners: [CornerNodes; 8],
    /// How many of them are cells.
    present: usize,
}

/// The cells of an eye in groups.
pub(crate) struct CellRows {
    groups: Vec<Group>,
    /// Group by group, by [`field`].
    constants: Aligned,
    pressures: Vec<f64>,
    cells: usize,
    /// The machine's vectors.
    level: Level,
}

/// Eight values of each component of each corner.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct Gathered([[Lane; 3]; 8]);

impl CellRows {
    pub fn new(eye: &SpatialEye, level: Level) -> Self {
        let one: Vec<Constants> = plain::constants(eye);
        let count = eye.cells.len().div_ceil(LANES);
        let mut constants = Aligned::zeros(count * field::COUNT * LANES);
        let mut groups = Vec::new();
        for group in 0..count {
            let first = group * LANES;
            let present = (eye.cells.len() - first).min(LANES);
            let cell = |lane: usize| first + lane.min(present - 1);
            for lane in 0..LANES {
                let mut own = one[cell(lane)];
                if lane >= present {
                    own[field::BULK..].fill(0.0);
                }
                for (f, value) in own.into_iter().enumerate() {
                    constants[(group * field::COUNT + f) * LANES + lane] = value;
                }
            }
            let corners = std::array::from_fn(|corner| {
                let node = |lane: usize| eye.cells[cell(lane)].corners[corner];
                let first = node(0);
                if (0..LANES).all(|lane| node(lane) == first + lane) {
                    CornerNodes::From(first)
                } else {
                    CornerNodes::List(std::array::from_fn(|lane| node(lane) as u32))
                }
            });
            groups.push(Group { corners, present });
        }
        Self {
            groups,
            constants,
            pressures: vec![0.0; count * LANES],
            cells: eye.cells.len(),
            level,
        }
    }
}

/// Brings the corners of a group that are lists together.
#[inline(always)]
fn gather(group: &Group, of: &Nodes, to: &mut Gathered) {
    for corner in 0..8 {
        if let CornerNodes::List(nodes) = &group.corners[corner] {
            for k in 0..3 {
                let (of, to) = (&of[k][..], &mut to.0[corner][k]);
                for lane in 0..LANES {
                    to[lane] = of[nodes[lane] as usize];
                }
            }
        }
    }
}

/// What some cells of a group have at their corners.
#[inline(always)]
fn read<M: Math>(m: M, group: &Group, lane: usize, of: &Nodes, lists: &Gathered) -> Eight<M::N> {
    eight!(corner => by_component!(k => match group.corners[corner] {
        CornerNodes::From(first) => m.load(&of[k], first + lane),
        CornerNodes::List(_) => m.load(&lists.0[corner][k], lane),
    }))
}

#[inline(always)]
fn add<M: Math>(m: M, to: &mut Lane, lane: usize, value: M::N) {
    let sum = m.load(to, lane) + value;
    m.store(sum, to, lane);
}

#[inline(always)]
fn forces<S: Simd>(simd: S, rows: &mut CellRows, state: &mut NodeState) -> CellSums {
    let m = Wide(simd);
    let mut totals = Totals::new();
    let zero = Gathered([[[0.0; LANES]; 3]; 8]);
    let (mut at, mut speed, mut on) = (zero, zero, zero);
    let mut over_regular: Lane = [0.0; LANES];
    for (number, group) in rows.groups.iter().enumerate() {
        gather(group, &state.at, &mut at);
        gather(group, &state.speed, &mut speed);
        let constants =
            &rows.constants[number * field::COUNT * LANES..(number + 1) * field::COUNT * LANES];
        for lane in (0..LANES).step_by(<Wide<S> as Math>::WIDTH) {
            let p = read(m, group, lane, &state.at, &at);
            let v = read(m, group, lane, &state.speed, &speed);
            let fields = Fields { of: constants, stride: LANES, lane };
            let response = cell::respond(m, fields, &p, &v);
            for corner in 0..8 {
                for k in 0..3 {
                    m.store(response.force[corner][k], &mut on.0[corner][k], lane);
                }
            }
            m.store(response.pressure, &mut rows.pressures, number * LANES + lane);
            let weighted = |f: usize| fields.get(m, f);
            add(m, &mut totals.loss, lane, weighted(field::PRESENT) * response.loss);
            let pressure = response.pressure;
            add(m, &mut totals.mean, lane, weighted(field::MEAN) * pressure);
            add(m, &mut totals.sensor, lane, weighted(field::SENSOR) * pressure);
            let volume = weighted(field::GLOBE) * response.volume;
            add(m, &mut totals.volume, lane, volume);
            let shrinking = m.most(m.load(&totals.shrinking, lane), response.shrinking);
            m.store(shrinking, &mut totals.shrinking, lane);
            let rate = m.most(response.rate, response.shrinking);
            let rate = m.most(m.load(&totals.rate, lane), rate);
            m.store(rate, &mut totals.rate, lane);
            let over = response.rate * response.rate - m.number(state.regular[0]);
            let stiff = weighted(field::STIFF) * m.most(over, m.number(0.0));
            m.store(stiff, &mut over_regular, lane);
            let corner = m.least(m.load(&totals.corner, lane), response.least_corner);
            m.store(corner, &mut totals.corner, lane);
        }
        scatter(simd, group, &on, state);
        stiffen(group, &over_regular, &mut state.stiff);
    }
    totals.sums()
}

/// Adds what is stiff to the nodes of the cells that are.
#[inline(always)]
fn stiffen(group: &Group, over: &Lane, stiff: &mut [f64]) {
    for (lane, over) in over.iter().enumerate().take(group.present) {
        if *over > 0.0 {
            for corner in &group.corners {
                let node = match corner {
                    CornerNodes::From(first) => first + lane,
                    CornerNodes::List(nodes) => nodes[lane] as usize,
                };
                stiff[node] += over;
            }
        }
    }
}

/// Adds what acts on the corners of a group to the nodes.
#[inline(always)]
fn scatter<S: Simd>(simd: S, group: &Group, on: &Gathered, state: &mut NodeState) {
    let m = Wide(simd);
    for corner in 0..8 {
        for k in 0..3 {
            let (force, on) = (&mut state.force[k][..], &on.0[corner][k]);
            match &group.corners[corner] {
                CornerNodes::From(first) => {
                    for lane in (0..LANES).step_by(<Wide<S> as Math>::WIDTH) {
                        let sum = m.load(force, first + lane) + m.load(on, lane);
                        m.store(sum, force, first + lane);
                    }
                }
                CornerNodes::List(nodes) => {
                    for lane in 0..group.present {
                        force[nodes[lane] as usize] += on[lane];
                    }
                }
            }
        }
    }
}

impl Cells for CellRows {
    fn forces(&mut self, state: &mut NodeState) -> CellSums {
        let level = self.level;
        dispatch!(level, simd => forces(simd, self, state))
    }

    fn pressures(&self) -> Vec<f64> {
        self.pressures[..self.cells].to_vec()
    }
}
