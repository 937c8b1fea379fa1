//! The cells laid out in rows, so that their corners are neighbours in memory.
//!
//! Each block of the mesh is one run of places, row after row. The cell at place s has its corners
//! at s, s + 1, s + 1 + c and s + c, where c is the number of nodes in a row; so a vector of cells
//! loads vectors of nodes and no list of corners is needed. Where a row ends, the cell that would
//! span to the next is absent: all of its stiffness is zero. Cells store the forces on their
//! corners by place, and each node then adds what the four cells around it left.
//!
//! A node on the border of two blocks has a place in both. Its forces are added up, and both
//! places move alike.

use crate::models::axisymmetric::eye::{AxisymmetricEye, Tissue};
use crate::models::axisymmetric::forces::state::{CellSums, Cells, NodeState};
use crate::models::axisymmetric::forces::{cell, cell::Rest, quads};
use crate::models::axisymmetric::recording::sensor;
use crate::models::paper::forces::aligned::Aligned;
use crate::models::paper::forces::layout::{LANES, Lane};
use fearless_simd::{Level, dispatch};
use std::f64::consts::FRAC_PI_3;

/// What is constant of a cell.
pub(crate) mod field {
    pub const VOLUME: usize = 0; // m3 over pi/3.
    pub const TRIANGLE: usize = 1; // Volumes of the four corner triangles, m3 over pi/3.
    pub const INVERSE_TRIANGLE: usize = 5;
    pub const DIAGONAL: usize = 9; // Inverse of the matrix of the diagonals, row by row.
    pub const INVERSE_RADIUS: usize = 13;
    pub const INVERSE_DET: usize = 14; // 1/(2 area).
    pub const LEAST_DET: usize = 15; // Least 2 area that counts.
    pub const BULK: usize = 16;
    pub const SHEAR: usize = 17; // Shear modulus times volume, J.
    pub const VISCOSITY: usize = 18; // Twice the viscosity.
    pub const SUBZONAL: usize = 19; // A sixth of the stiffness against folding, Pa.
    pub const LINEAR: usize = 20; // Artificial viscosity per length and rate.
    pub const QUADRATIC: usize = 21; // Artificial viscosity per square of length and of rate.
    pub const CORNER: usize = 22; // Half the viscosity of the corners per length.
    pub const BULK_SPEED: usize = 23; // Squared speed of sound.
    pub const OTHER_SPEED: usize = 24; // What other stiffness adds to it.
    pub const CONSTANT_SPEED: usize = 25; // Viscous speed that does not depend on the state.
    pub const KINEMATIC: usize = 26; // Kinematic viscosity.
    pub const QUADRATIC_SPEED: usize = 27; // Part of the viscous speed per length and rate.
    pub const MEAN: usize = 28; // Weight in the mean pressure of the globe.
    pub const SENSOR: usize = 29; // Weight in the pressure at the back.
    pub const GLOBE: usize = 30; // 1 for a cell of the globe.
    pub const SHRINKING: usize = 31; // Longest steps over the time until a triangle would be gone.
    pub const ABSENT: usize = 32; // 0, or so much that a triangle is never the least.
    pub const COUNT: usize = 33;
}

/// The constants of one cell, by [`field`].
type Constants = [f64; field::COUNT];

/// The constants of eight neighbouring cells, by [`field`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(crate) struct CellGroup(pub [Lane; field::COUNT]);

/// A run of rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct RowRun {
    /// First place of the nodes.
    pub nodes: usize,
    /// First place of the cells in the constants and in the pressures.
    pub cells: usize,
    /// First place of the cells in the forces of corners, which have a row of zeros before them.
    pub corners: usize,
    /// Nodes in a row.
    pub columns: usize,
    /// Places of cells, whole groups.
    pub cell_places: usize,
    /// Places of nodes, whole groups.
    pub node_places: usize,
}

/// Forces on the corners of cells, by corner.
pub(crate) type Corners = [(Aligned, Aligned); 4];

/// The cells of an eye in rows.
pub(crate) struct CellRows {
    pub runs: Vec<RowRun>,
    pub groups: Vec<CellGroup>,
    pub corners: Corners,
    pub pressures: Aligned,
    /// The machine's vectors.
    level: Level,
    rest: NodeState,
    /// Place of each node, the last one where there are two.
    places: Vec<usize>,
    /// Place of each cell.
    cells: Vec<usize>,
    /// Pairs of places of one node; the second is the one found in `places`.
    twins: Vec<(usize, usize)>,
}

impl CellRows {
    pub fn new(eye: &AxisymmetricEye, level: Level) -> Self {
        let (mut runs, mut places, mut twins) =
            (Vec::new(), vec![usize::MAX; eye.mass.len()], Vec::new());
        let (mut nodes, mut cells, mut corners) = (0, 0, 0);
        let mut owners = Vec::new();
        for (index, block) in eye.mesh.blocks.iter().enumerate() {
            let columns = block.columns;
            let run = RowRun {
                nodes,
                cells,
                corners: corners + (columns + 1).next_multiple_of(LANES),
                columns,
                cell_places: (block.nodes.len() - columns).next_multiple_of(LANES),
                node_places: block.nodes.len().next_multiple_of(LANES),
            };
            for (i, &node) in block.nodes.iter().enumerate() {
                let place = nodes + i;
                if places[node] == usize::MAX {
                    places[node] = place;
                } else if index == 1 {
                    // The shell's and the globe's layers are the ones to be found.
                    twins.push((places[node], place));
                    places[node] = place;
                } else {
                    twins.push((place, places[node]));
                }
                owners.push(Some(node));
            }
            owners.resize(nodes + run.node_places, None);
            nodes += run.node_places;
            cells += run.cell_places;
            corners = run.corners + run.node_places + LANES;
            runs.push(run);
        }
        // Cells reach a row and a vector beyond the last node.
        let widest = runs.iter().map(|r| r.columns).max().unwrap_or(0);
        owners.resize((nodes + widest + 1 + LANES).next_multiple_of(LANES), None);

        let (groups, places_of_cells) = groups(eye, &runs, cells);
        Self {
            groups,
            corners: std::array::from_fn(|_| (Aligned::zeros(corners), Aligned::zeros(corners))),
            pressures: Aligned::zeros(cells),
            level,
            rest: NodeState::new(eye, &owners, places[eye.mesh.shell[0]]),
            places,
            cells: places_of_cells,
            twins,
            runs,
        }
    }

    /// Brings both places of a node together.
    #[cfg(test)]
    pub fn share(&self, state: &mut NodeState) {
        for &(twin, place) in &self.twins {
            for of in [&mut state.x, &mut state.r, &mut state.vx, &mut state.vr] {
                of[twin] = of[place];
            }
        }
    }
}

/// The constants of so many places of cells, and the place of each cell.
fn groups(eye: &AxisymmetricEye, runs: &[RowRun], count: usize) -> (Vec<CellGroup>, Vec<usize>) {
    // A place without a cell has the shape of some cell, so that all stays finite.
    let empty = absent(constants(&Rest::new(eye, &eye.cells[0])));
    let mut groups = vec![CellGroup(empty.map(|value| [value; LANES])); count / LANES];
    let places = runs.iter().zip(&eye.mesh.blocks).flat_map(|(run, block)| {
        let places = 0..block.nodes.len() - run.columns;
        // The last of a row spans to the next one.
        places.filter(|low| (low + 1) % run.columns > 0).map(|low| run.cells + low)
    });
    let places: Vec<usize> = places.collect();
    for ((cell, weights), place) in eye.cells.iter().zip(sensor::weights(eye)).zip(&places) {
        let mut one = constants(&Rest::new(eye, cell));
        (one[field::MEAN], one[field::SENSOR]) = weights;
        if cell.region == Tissue::Globe {
            one[field::GLOBE] = FRAC_PI_3;
        }
        for (lanes, value) in groups[place / LANES].0.iter_mut().zip(one) {
            lanes[place % LANES] = value;
        }
    }
    (groups, places)
}

fn constants(rest: &Rest) -> Constants {
    let mut c = [0.0; field::COUNT];
    let density = rest.material.density;
    let sound = (rest.material.bulk / density).sqrt();
    let corner_sound = (cell::SUBZONAL_BULK / density).sqrt();
    c[field::VOLUME] = rest.volume / FRAC_PI_3;
    for i in 0..4 {
        c[field::TRIANGLE + i] = rest.triangles[i] / FRAC_PI_3;
        c[field::INVERSE_TRIANGLE + i] = 1.0 / c[field::TRIANGLE + i];
        c[field::DIAGONAL + i] = rest.diagonals[i];
    }
    c[field::INVERSE_RADIUS] = 1.0 / rest.radius;
    c[field::INVERSE_DET] = 0.5 / rest.area;
    c[field::LEAST_DET] = cell::FLAT * 2.0 * rest.area;
    c[field::BULK] = rest.material.bulk;
    c[field::SHEAR] = rest.material.shear * rest.volume;
    c[field::VISCOSITY] = 2.0 * rest.material.viscosity;
    c[field::SUBZONAL] = rest.subzonal / 6.0;
    c[field::LINEAR] = cell::LINEAR * density * sound;
    c[field::QUADRATIC] = cell::QUADRATIC * density;
    c[field::CORNER] = 0.5 * cell::SUBZONAL_VISCOSITY * density * corner_sound;
    c[field::BULK_SPEED] = rest.material.bulk / density;
    c[field::OTHER_SPEED] = (4.0 / 3.0 * rest.material.shear + rest.subzonal) / density;
    c[field::CONSTANT_SPEED] = cell::LINEAR * sound + 4.0 * cell::SUBZONAL_VISCOSITY * corner_sound;
    c[field::KINEMATIC] = rest.material.viscosity / density;
    c[field::QUADRATIC_SPEED] = cell::QUADRATIC;
    c[field::SHRINKING] = 1.0 / cell::LOSS_IN_STEP;
    c
}

/// Constants of a place without a cell: the given shape without stiffness.
fn absent(mut c: Constants) -> Constants {
    c[field::BULK..].fill(0.0);
    c[field::INVERSE_TRIANGLE..field::INVERSE_TRIANGLE + 4].fill(0.0);
    c[field::ABSENT] = f64::MAX;
    c
}

impl Cells for CellRows {
    fn rest(&self) -> NodeState {
        self.rest.clone()
    }

    fn place(&self, node: usize) -> usize {
        self.places[node]
    }

    fn forces(&mut self, state: &mut NodeState) -> CellSums {
        let level = self.level;
        let sums = dispatch!(level, simd => quads::forces(simd, self, state));
        for &(twin, place) in &self.twins {
            state.fx[place] += state.fx[twin];
            state.fr[place] += state.fr[twin];
        }
        sums
    }

    fn advance(&self, state: &mut NodeState, kick: f64, drift: f64) {
        for &(twin, place) in &self.twins {
            state.fx[twin] = state.fx[place];
            state.fr[twin] = state.fr[place];
        }
        let level = self.level;
        dispatch!(level, simd => quads::advance(simd, state, kick, drift));
    }

    fn pressures(&self) -> Vec<f64> {
        self.cells.iter().map(|&place| self.pressures[place]).collect()
    }
}
