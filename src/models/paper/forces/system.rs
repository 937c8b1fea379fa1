//! The eye and its load compiled into rows for the force kernel.
//!
//! The mesh stays a grid: row j holds the nodes of that row side by side, padded to whole groups of
//! eight, and every grid spring belongs to one of four directions (right, up, up-right, and from
//! above-left to below-right), stored with the node at its lower left. The kernel then needs no
//! index lists. Filaments live on the ring of shell nodes, which is gathered into a run of its own
//! with ghosts at both ends.
//!
//! A place of the grid that has no node, and a spring that has no moving end, has stiffness 0.
//!
//! When the load is symmetric about the visual axis, only the upper half is compiled. The row below
//! it is a ghost that mirrors the row above; each node then stands for itself and its image, which
//! the weights in the energy sums account for. The motion is the whole eye's to round-off.

use crate::models::paper::eye::Eye;
use crate::models::paper::eye::springs::SpringKind;
use crate::models::paper::forces::aligned::Aligned;
use crate::models::paper::forces::lanes;
use crate::models::paper::forces::load::ArcLoad;
use crate::models::paper::forces::ring;
use crate::models::paper::forces::ring::Ring;
use crate::models::paper::forces::sweep::Active;
use crate::models::paper::time::stability;
use crate::models::pulse::Pulse;
use fearless_simd::{Level, dispatch};

/// Nodes that the kernel handles at once.
pub const LANES: usize = 8;
/// Places by which the rows start late. At level 1 most rows then fill whole vectors of four. Where
/// no padding is left, the last place of a row is the first of the next, which is never used.
pub(crate) const SHIFT: usize = 1;
/// Grid directions a node owns springs in.
pub(crate) const DIRECTIONS: usize = 4;
/// A spring shorter than this share of the shortest rest length is treated as that long, so that
/// its direction stays defined: the force is continuous and no NaN can arise.
const SHORTEST_SHARE: f64 = 1e-6;

/// Eight neighbouring values.
pub(crate) type Lane = [f64; LANES];

/// What the kernel needs of eight neighbouring nodes.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(crate) struct Group {
    /// Stiffness of the springs in each direction, N/m.
    pub stiffness: [Lane; DIRECTIONS],
    /// Stiffness times rest length, N.
    pub tension: [Lane; DIRECTIONS],
    /// 1/mass of nodes that move, else 0.
    pub inverse_mass: Lane,
    /// 1 for fat, 0 for globe.
    pub fat: Lane,
    /// Half the mass times the number of nodes it stands for.
    pub half_mass: Lane,
}

/// What the survey needs beside a [`Group`].
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(crate) struct SurveyGroup {
    /// The number of springs it stands for over twice the stiffness, 0 where there is no spring.
    pub half_compliance: [Lane; DIRECTIONS],
    /// 1/(stiffness times rest length), 0 where there is no spring.
    pub inverse_tension: [Lane; DIRECTIONS],
    /// 1/(twice the rest area) of the quad at the upper right, 0 where there is none.
    pub inverse_area: Lane,
    /// 1 where there is no quad, else 0.
    pub no_quad: Lane,
}

/// Where a node of the eye is found in the rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Index into the rows.
    pub slot: usize,
    /// Whether the slot holds its mirror image.
    pub mirrored: bool,
}

impl Place {
    /// Sign of the y components read at the slot.
    pub fn sign(self) -> f64 {
        if self.mirrored { -1.0 } else { 1.0 }
    }
}

/// The load as the kernel applies it.
#[derive(Debug, Clone)]
pub struct NodeLoad {
    /// Force against time.
    pub pulse: Pulse,
    /// Slot, share along x, share along y.
    pub(crate) shares: Vec<(usize, f64, f64)>,
    /// Slot, weight along x, weight along y: gives the speed that does the load's work.
    pub(crate) work: Vec<(usize, f64, f64)>,
}

/// An eye and its load, ready to be moved.
#[derive(Debug, Clone)]
pub struct System {
    pub(crate) side: usize,
    pub(crate) stride: usize,
    /// First row whose springs are evaluated; a ghost when mirrored.
    pub(crate) first_row: usize,
    /// Row that the ghost mirrors.
    pub(crate) mirror_row: Option<usize>,
    pub(crate) groups: Vec<Group>,
    pub(crate) survey: Vec<SurveyGroup>,
    pub(crate) ring: Ring,
    pub(crate) shortest_squared: f64,
    pub(crate) rest_x: Aligned,
    pub(crate) rest_y: Aligned,
    /// Decay rate c/m of globe and fat, in 1/s.
    pub(crate) decay: [f64; 2],
    /// Use only operations that every machine rounds alike.
    pub(crate) portable: bool,
    /// The machine's vectors.
    pub(crate) level: Level,
    /// The vectors that hold anything that moves.
    pub(crate) active: Active,
    places: Vec<Place>,
    load: NodeLoad,
    omega_bound: f64,
    springs_per_evaluation: usize,
}

impl System {
    /// Compiles `eye` under `load`. The half is compiled if the load is symmetric, unless
    /// `whole` asks for all.
    pub fn new(eye: &Eye, pulse: Pulse, load: &ArcLoad, whole: bool, portable: bool) -> Self {
        let mirrored = !whole && load.direction.y == 0.0 && load.arc.0 == -load.arc.1;
        let side = eye.side;
        let stride = side.next_multiple_of(LANES);
        let rows = Rows::new(side, stride, mirrored);

        let mut system = Self {
            side,
            stride,
            first_row: rows.first,
            mirror_row: rows.mirror,
            groups: vec![EMPTY_GROUP; (side + 1) * stride / LANES],
            survey: vec![EMPTY_SURVEY; (side + 1) * stride / LANES],
            ring: Ring::default(),
            shortest_squared: shortest_squared(eye),
            rest_x: Aligned::zeros((side + 1) * stride + LANES),
            rest_y: Aligned::zeros((side + 1) * stride + LANES),
            decay: decay_rates(eye),
            portable,
            level: Level::new(),
            active: Active::default(),
            places: eye.nodes.iter().map(|n| rows.place(n.grid)).collect(),
            load: NodeLoad {
                pulse,
                shares: Vec::new(),
                work: Vec::new(),
            },
            omega_bound: stability::omega_bound(eye),
            springs_per_evaluation: 0,
        };
        system.put_nodes(eye, &rows);
        system.put_springs(eye, &rows);
        system.set_level(Level::new());
        system.put_quads(eye, &rows);
        system.ring = ring::compile(eye, &rows);
        system.springs_per_evaluation += system.ring.filaments();
        for &(node, share) in &load.shares {
            let place = rows.place(eye.nodes[node].grid);
            if !place.mirrored {
                let (fx, fy) = (share * load.direction.x, share * load.direction.y);
                let weight = rows.weight(eye.nodes[node].grid.1);
                system.load.shares.push((place.slot, fx, fy));
                system
                    .load
                    .work
                    .push((place.slot, weight * fx, weight * fy));
            }
        }
        system
    }

    fn put_nodes(&mut self, eye: &Eye, rows: &Rows) {
        // Places without a node get distinct positions too, so that no length there is zero.
        for j in 0..self.side {
            for i in 0..self.stride {
                self.rest_x[j * self.stride + i] = i as f64 * 1e-3;
                self.rest_y[j * self.stride + i] = j as f64 * 1e-3;
            }
        }
        for node in &eye.nodes {
            let (i, j) = node.grid;
            let slot = j * self.stride + i + SHIFT;
            self.rest_x[slot] = node.position.x;
            self.rest_y[slot] = node.position.y;
            if node.fixed() || !rows.owns(j) {
                continue;
            }
            let (group, lane) = (&mut self.groups[slot / LANES], slot % LANES);
            group.inverse_mass[lane] = 1.0 / node.mass;
            group.half_mass[lane] = 0.5 * node.mass * rows.weight(j);
            group.fat[lane] = if node.region.in_globe() { 0.0 } else { 1.0 };
        }
    }

    fn put_springs(&mut self, eye: &Eye, rows: &Rows) {
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
            let slot = row * self.stride + ai.min(bi) + SHIFT;
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

    fn put_quads(&mut self, eye: &Eye, rows: &Rows) {
        for quad in &eye.quads {
            let p = quad.map(|i| eye.nodes[i].position);
            let (i, j) = eye.nodes[quad[0]].grid;
            if j < rows.first {
                continue;
            }
            let slot = j * self.stride + i + SHIFT;
            let twice_area = (p[2] - p[0]).perp(&(p[3] - p[1]));
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
        let (first, last) = (self.first_row * self.stride, self.side * self.stride);
        let slots = (first..last).step_by(width);
        let busy = slots.filter(|&slot| (slot..slot + width).any(busy));
        self.active = Active::new(busy);
    }

    /// Where node `node` of the eye is found.
    pub fn place(&self, node: usize) -> Place {
        self.places[node]
    }

    /// The load.
    pub fn load(&self) -> &NodeLoad {
        &self.load
    }

    /// Upper bound of the highest angular frequency of the mesh in any shape it may take, in
    /// rad/s; see [`crate::models::paper::time::stability`].
    pub fn omega_bound(&self) -> f64 {
        self.omega_bound
    }

    /// Springs that one force evaluation computes.
    pub fn springs_per_evaluation(&self) -> usize {
        self.springs_per_evaluation
    }

    /// Whether only the upper half is moved.
    pub fn mirrored(&self) -> bool {
        self.mirror_row.is_some()
    }
}

const EMPTY_GROUP: Group = Group {
    stiffness: [[0.0; LANES]; DIRECTIONS],
    tension: [[0.0; LANES]; DIRECTIONS],
    inverse_mass: [0.0; LANES],
    fat: [0.0; LANES],
    half_mass: [0.0; LANES],
};

const EMPTY_SURVEY: SurveyGroup = SurveyGroup {
    half_compliance: [[0.0; LANES]; DIRECTIONS],
    inverse_tension: [[0.0; LANES]; DIRECTIONS],
    inverse_area: [0.0; LANES],
    no_quad: [1.0; LANES],
};

/// Which rows are moved, and what each stands for.
pub(crate) struct Rows {
    side: usize,
    stride: usize,
    first: usize,
    mirror: Option<usize>,
}

impl Rows {
    fn new(side: usize, stride: usize, mirrored: bool) -> Self {
        // An even side has the axis between two rows, an odd one has a row on the axis.
        let (first, mirror) = if mirrored {
            let ghost = side.div_ceil(2) - 1 - side % 2;
            (ghost, Some(side - 1 - ghost))
        } else {
            (0, None)
        };
        Self {
            side,
            stride,
            first,
            mirror,
        }
    }

    pub fn owns(&self, row: usize) -> bool {
        self.mirror.is_none() || row > self.first
    }

    /// How many rows of the whole eye row `row` stands for.
    pub fn weight(&self, row: usize) -> f64 {
        if self.mirror.is_none() {
            1.0
        } else if !self.owns(row) {
            0.0
        } else if 2 * row + 1 == self.side {
            1.0
        } else {
            2.0
        }
    }

    pub fn place(&self, (i, j): (usize, usize)) -> Place {
        let mirrored = !self.owns(j);
        let row = if mirrored { self.side - 1 - j } else { j };
        Place {
            slot: row * self.stride + i + SHIFT,
            mirrored,
        }
    }
}

fn shortest_squared(eye: &Eye) -> f64 {
    let shortest = eye
        .springs
        .iter()
        .map(|s| s.rest_length)
        .fold(f64::INFINITY, f64::min);
    (SHORTEST_SHARE * shortest).powi(2)
}

fn decay_rates(eye: &Eye) -> [f64; 2] {
    [true, false].map(|globe| {
        eye.nodes
            .iter()
            .find(|n| n.region.in_globe() == globe && !n.fixed())
            .map_or(0.0, |n| n.drag / n.mass)
    })
}
