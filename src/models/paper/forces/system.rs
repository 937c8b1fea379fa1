//! The eye and its load compiled into rows for the force kernel.
//!
//! The mesh stays a grid: row j holds the nodes of that row side by side, padded to whole groups
//! of eight, and every grid spring belongs to one of four directions (right, up, up-right, and
//! from above-left to below-right), stored with the node at its lower left. The kernel then needs
//! no index lists. Filaments live on the ring of shell nodes, which is gathered into a run of its
//! own with ghosts at both ends.
//!
//! A place of the grid that has no node, and a spring that has no moving end, has stiffness 0.
//!
//! When the load is symmetric about the visual axis, only the upper half is compiled. The row
//! below it is a ghost that mirrors the row above; each node then stands for itself and its image,
//! which the weights in the energy sums account for. The motion is the whole eye's to round-off.

use crate::models::paper::eye::{Eye, crossed, frequency, springs::SpringKind};
use crate::models::paper::forces::layout::{LANES, MovedRows, RowPlace, SpringGroup, SurveyGroup};
use crate::models::paper::forces::{aligned::Pairs, lanes};
use crate::models::paper::forces::{load::ArcLoad, ring, ring::Ring};
use crate::models::pulse::Pulse;
use fearless_simd::{Level, dispatch};
use nalgebra::Vector2;
use std::ops::Range;

/// A spring shorter than this share of the shortest rest length is treated as that long, so that
/// its direction stays defined: the force is continuous and no NaN can arise.
const SHORTEST_SHARE: f64 = 1e-6;

/// An eye and its load, ready to be moved.
#[derive(Debug, Clone)]
pub struct System {
    pub(crate) rows: MovedRows,
    pub(crate) groups: Vec<SpringGroup>,
    pub(crate) survey: Vec<SurveyGroup>,
    pub(crate) ring: Ring,
    pub(crate) shortest_squared: f64,
    pub(crate) rest: Pairs,
    /// Decay rate c/m of globe and fat, in 1/s.
    pub(crate) decay: [f64; 2],
    /// Use only operations that every machine rounds alike.
    pub(crate) portable: bool,
    /// The machine's vectors.
    pub(crate) level: Level,
    /// First slots of the vectors that hold anything that moves, rising; the last one twice, as the
    /// sweep looks one ahead.
    pub(crate) active: Vec<u32>,
    places: Vec<RowPlace>,
    /// Force of the load against time.
    pub pulse: Pulse,
    /// Slot of a loaded node, how many nodes it stands for, and force per N of load.
    pub(crate) loaded: Vec<(usize, f64, Vector2<f64>)>,
    /// Upper bound of the highest angular frequency of the mesh in any shape it may take, in
    /// rad/s; see [`crate::models::paper::eye::frequency`].
    pub omega_bound: f64,
    /// Springs that one force evaluation computes.
    pub springs_per_evaluation: usize,
}

impl System {
    /// Compiles `eye` under `load`; of a symmetric load the half, unless `whole` asks for all.
    pub fn new(eye: &Eye, pulse: Pulse, load: &ArcLoad, whole: bool, portable: bool) -> Self {
        let mirrored = !whole && load.direction.y == 0.0 && load.arc.0 == -load.arc.1;
        let side = eye.side;
        let stride = side.next_multiple_of(LANES);
        let rows = MovedRows::new(side, stride, mirrored);

        let ring = ring::compile(eye, &rows);
        let filaments = ring.strips.iter().flat_map(|strip| strip.stiffness).filter(|&k| k > 0.0);
        let places: Vec<RowPlace> = eye.nodes.iter().map(|n| rows.place(n.grid)).collect();
        let loaded = load.shares.iter().filter(|(node, _)| !places[*node].mirrored);
        let loaded = loaded.map(|&(node, share)| {
            let weight = rows.weight(eye.nodes[node].grid.1);
            (places[node].slot, weight, load.direction * share)
        });
        let shortest = eye.springs.iter().map(|s| s.rest_length).fold(f64::INFINITY, f64::min);
        let no_quads = SurveyGroup { no_quad: [1.0; LANES], ..SurveyGroup::default() };
        let mut system = Self {
            groups: vec![SpringGroup::default(); (side + 1) * stride / LANES],
            survey: vec![no_quads; (side + 1) * stride / LANES],
            shortest_squared: (SHORTEST_SHARE * shortest).powi(2),
            rest: Pairs::zeros((side + 1) * stride + LANES),
            decay: decay_rates(eye),
            portable,
            level: Level::new(),
            active: Vec::new(),
            pulse,
            loaded: loaded.collect(),
            places,
            rows,
            omega_bound: frequency::omega_bound(eye),
            springs_per_evaluation: filaments.count(),
            ring,
        };
        system.put_nodes(eye);
        system.put_springs(eye);
        system.set_level(Level::new());
        system.put_quads(eye);
        system
    }

    fn put_nodes(&mut self, eye: &Eye) {
        let rows = self.rows;
        // Places without a node get distinct positions too, so that no length there is zero.
        for slot in 0..rows.side * rows.stride {
            self.rest.x[slot] = (slot % rows.stride) as f64 * 1e-3;
            self.rest.y[slot] = (slot / rows.stride) as f64 * 1e-3;
        }
        for node in &eye.nodes {
            let (slot, row) = (rows.slot(node.grid), node.grid.1);
            self.rest.x[slot] = node.position.x;
            self.rest.y[slot] = node.position.y;
            if node.fixed() || !rows.owns(row) {
                continue;
            }
            let (group, lane) = (&mut self.groups[slot / LANES], slot % LANES);
            group.inverse_mass[lane] = 1.0 / node.mass;
            group.half_mass[lane] = 0.5 * node.mass * rows.weight(row);
            group.fat[lane] = if node.region.in_globe() { 0.0 } else { 1.0 };
        }
    }

    fn put_springs(&mut self, eye: &Eye) {
        let rows = self.rows;
        for spring in &eye.springs {
            let (a, b) = (&eye.nodes[spring.a], &eye.nodes[spring.b]);
            if spring.kind == SpringKind::Filament || (a.fixed() && b.fixed()) {
                continue;
            }
            let ((ai, aj), (bi, bj)) = (a.grid, b.grid);
            let row = aj.min(bj);
            let direction = match (aj == bj, ai == bi) {
                (true, _) => 0,
                (_, true) => 1,
                _ if (ai < bi) == (aj < bj) => 2,
                _ => 3,
            };
            // The ghost row has no springs of its own, only those that reach up from it.
            if row < rows.first || (!rows.owns(row) && direction == 0) {
                continue;
            }
            let slot = rows.slot((ai.min(bi), row));
            let weight = 0.5 * (rows.weight(aj) + rows.weight(bj));
            let (k, l) = (spring.stiffness, spring.rest_length);
            let (g, lane) = (slot / LANES, slot % LANES);
            self.groups[g].stiffness[direction][lane] = k;
            self.groups[g].tension[direction][lane] = k * l;
            self.survey[g].half_compliance[direction][lane] = 0.5 * weight / k;
            self.survey[g].inverse_tension[direction][lane] = 1.0 / (k * l);
            self.springs_per_evaluation += 1;
        }
    }

    fn put_quads(&mut self, eye: &Eye) {
        let rows = self.rows;
        for quad in &eye.quads {
            let grid = eye.nodes[quad[0]].grid;
            if grid.1 < rows.first {
                continue;
            }
            let slot = rows.slot(grid);
            let twice_area = crossed(quad.map(|i| eye.nodes[i].position));
            let group = &mut self.survey[slot / LANES];
            group.inverse_area[slot % LANES] = 1.0 / twice_area;
            group.no_quad[slot % LANES] = 0.0;
        }
    }

    /// Takes a set of the machine's vectors and finds those that hold a moving node or a spring.
    pub fn set_level(&mut self, level: Level) {
        self.level = level;
        let width = dispatch!(level, simd => lanes::width(simd));
        let busy = |slot: usize| {
            let (group, lane) = (&self.groups[slot / LANES], slot % LANES);
            group.inverse_mass[lane] > 0.0 || group.stiffness.iter().any(|k| k[lane] > 0.0)
        };
        let rows = self.rows;
        let slots = (rows.first * rows.stride..rows.side * rows.stride).step_by(width);
        let active = slots.filter(|&slot| (slot..slot + width).any(busy));
        self.active = active.map(|slot| slot as u32).collect();
        self.active.extend(self.active.last().copied());
    }

    /// The slots of the rows that hold all moving nodes.
    pub(crate) fn moving(&self) -> Range<usize> {
        self.rows.first * self.rows.stride..(self.rows.side - 1) * self.rows.stride
    }

    /// Where node `node` of the eye is found.
    #[inline]
    pub fn place(&self, node: usize) -> RowPlace {
        self.places[node]
    }

    /// Whether only the upper half is moved.
    pub fn mirrored(&self) -> bool {
        self.rows.mirror.is_some()
    }
}

fn decay_rates(eye: &Eye) -> [f64; 2] {
    [true, false].map(|globe| {
        let mut moving = eye.nodes.iter().filter(|n| !n.fixed());
        let first = moving.find(|n| n.region.in_globe() == globe);
        first.map_or(0.0, |n| n.drag / n.mass)
    })
}
