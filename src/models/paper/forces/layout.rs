//! How an eye lies in the rows of the force kernel: groups of eight nodes, row by row.
//!
//! [`system`](super::system) tells how an eye is compiled into them.

/// Nodes that the kernel handles at once.
pub const LANES: usize = 8;
/// Places by which the rows start late: at level 1 most rows then fill whole vectors of four.
/// Without padding the last place of a row is the first of the next, which is never used.
pub(crate) const SHIFT: usize = 1;
/// Grid directions a node owns springs in.
pub(crate) const DIRECTIONS: usize = 4;

/// Eight neighbouring values.
pub(crate) type Lane = [f64; LANES];

/// What the kernel needs of eight neighbouring nodes.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
pub(crate) struct SpringGroup {
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

/// What the survey needs beside a [`SpringGroup`].
#[derive(Debug, Clone, Copy, Default)]
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
pub struct RowPlace {
    /// Index into the rows.
    pub slot: usize,
    /// Whether the slot holds its mirror image.
    pub mirrored: bool,
}

impl RowPlace {
    /// Sign of the y components read at the slot.
    pub fn sign(self) -> f64 {
        if self.mirrored { -1.0 } else { 1.0 }
    }
}

/// Which rows are moved, and what each stands for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MovedRows {
    pub side: usize,
    pub stride: usize,
    /// First row whose springs are evaluated; a ghost when mirrored.
    pub first: usize,
    /// Row that the ghost mirrors.
    pub mirror: Option<usize>,
}

impl MovedRows {
    pub fn new(side: usize, stride: usize, mirrored: bool) -> Self {
        // An even side has the axis between two rows, an odd one has a row on the axis.
        let (first, mirror) = if mirrored {
            let ghost = side.div_ceil(2) - 1 - side % 2;
            (ghost, Some(side - 1 - ghost))
        } else {
            (0, None)
        };
        Self { side, stride, first, mirror }
    }

    pub fn owns(&self, row: usize) -> bool {
        self.mirror.is_none() || row > self.first
    }

    /// How many rows of the whole eye row `row` stands for.
    pub fn weight(&self, row: usize) -> f64 {
        if self.mirror.is_none() || 2 * row + 1 == self.side {
            1.0
        } else if self.owns(row) {
            2.0
        } else {
            0.0
        }
    }

    /// Where the node at a column and a row of the mesh would lie if all rows were moved.
    pub fn slot(&self, (i, j): (usize, usize)) -> usize {
        j * self.stride + i + SHIFT
    }

    pub fn place(&self, (i, j): (usize, usize)) -> RowPlace {
        let mirrored = !self.owns(j);
        let row = if mirrored { self.side - 1 - j } else { j };
        RowPlace { slot: self.slot((i, row)), mirrored }
    }
}
