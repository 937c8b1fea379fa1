//! The half section in quads: a core, layers around it to the shell, and layers from there to the
//! wall.
//!
//! A square mapped to a disc would have corners near 180 degrees on its diagonals. Here only a
//! core of half the radius is mapped, and mildly; straight rays lead from its border to the shell
//! and on to the wall. Rays are counted from the front of the eye, and lie closer there.

use crate::models::axisymmetric::eye::parameters::Wall;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// How much of the core's border is a square's, and how much a circle's.
const SQUARE: f64 = 0.425;
const CIRCLE: f64 = 0.5;
/// How much closer rays lie in front.
const GRADING: f64 = 0.2;

/// Where cells lie thicker and where thinner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layers {
    /// Radius of the core's map as a share of the globe's.
    core: f64,
    /// By which share layers within the shell, and beyond it, are thinner at it than on average.
    within: f64,
    beyond: f64,
}

impl Layers {
    /// Thinner at the shell, whose waves are shorter than the cells of a coarse mesh are wide: a
    /// thick cell is more mass than moves with it, and the wave that meets itself at the back comes
    /// late and too high.
    pub const THIN: Self = Self { core: 0.6, within: 0.65, beyond: 0.3 };
    /// All alike, which takes twice as fine a mesh for the same pressures.
    pub const EVEN: Self = Self { core: 0.55, within: 0.0, beyond: 0.0 };
}

/// Layers of cells between core and shell, and between shell and wall, per half side of the core.
const GLOBE_LAYERS: f64 = 0.8;
const AROUND_LAYERS: f64 = 0.9;

/// Rows of nodes with the same number of nodes each; between four neighbours lies a cell.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Block {
    /// Nodes in a row.
    pub columns: usize,
    /// Node of each place, row by row.
    pub nodes: Vec<usize>,
}

impl Block {
    /// Corners of the cells in order, anticlockwise.
    pub fn cells(&self) -> impl Iterator<Item = [usize; 4]> + '_ {
        let columns = self.columns;
        (columns..self.nodes.len())
            .step_by(columns)
            .flat_map(move |up| (0..columns - 1).map(move |i| (up - columns + i, up + i)))
            .map(|(low, up)| [low, low + 1, up + 1, up].map(|place| self.nodes[place]))
    }
}

/// Nodes at rest, in m, and the blocks they lie in.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Place of each node along the line of the blow, towards the back, m.
    pub x: Vec<f64>,
    /// Distance of each node from that line, m.
    pub r: Vec<f64>,
    /// Core, layers to the shell, and layers to the wall if there is one.
    pub blocks: Vec<Block>,
    /// Nodes of the shell from the front to the back.
    pub shell: Vec<usize>,
    /// Nodes of the wall from its front edge to the back.
    pub wall: Vec<usize>,
}

/// Angle from the back of place (u, v) of the core, graded.
fn angle(u: i64, v: i64) -> f64 {
    let (uf, vf) = (u as f64, v as f64);
    let plain = if u.abs() >= v {
        let base = if u < 0 { PI } else { 0.0 };
        base + FRAC_PI_4 * vf / uf
    } else {
        FRAC_PI_2 - FRAC_PI_4 * uf / vf
    };
    plain + GRADING * libm::sin(plain)
}

/// Brings some of the graded angles onto others, and those between along with them.
struct Rays {
    /// From where to where, rising.
    knots: Vec<(f64, f64)>,
}

impl Rays {
    /// With one of the rising `rays` on each of the rising `marks`: those that stretch least.
    fn through(marks: &[f64], rays: &[f64]) -> Self {
        let mut best = (f64::INFINITY, vec![(0.0, 0.0), (PI, PI)]);
        let mut chosen = vec![0; marks.len()];
        // Every choice of rays, one for each mark, as the digits of a number.
        for mut choice in 0..rays.len().pow(marks.len() as u32) {
            for place in &mut chosen {
                (*place, choice) = (choice % rays.len(), choice / rays.len());
            }
            let inner = chosen.iter().map(|&i| rays[i]).zip(marks.iter().copied());
            let knots: Vec<_> =
                std::iter::once((0.0, 0.0)).chain(inner).chain([(PI, PI)]).collect();
            let worst = knots.windows(2).fold(0.0, |worst: f64, k| {
                let (from, to) = (k[1].0 - k[0].0, k[1].1 - k[0].1);
                worst.max(if from > 0.0 { libm::log(to / from).abs() } else { f64::INFINITY })
            });
            if worst < best.0 {
                best = (worst, knots);
            }
        }
        Self { knots: best.1 }
    }

    fn bring(&self, angle: f64) -> f64 {
        let above = self.knots.iter().position(|k| k.0 >= angle);
        let i = above.unwrap_or(self.knots.len() - 1).max(1);
        let ((x0, y0), (x1, y1)) = (self.knots[i - 1], self.knots[i]);
        // On a knot there is no rounding.
        if angle == x1 { y1 } else { y0 + (angle - x0) * ((y1 - y0) / (x1 - x0)) }
    }
}

/// The mesh of a core 2 `half` by `half` cells, with a limbus and an opening at front angles.
pub(crate) fn build(
    (half, spacing): (usize, Layers),
    radius: f64,
    limbus: f64,
    surround: Option<(Wall, f64)>,
) -> Mesh {
    let m = i64::try_from(half).expect("a mesh that fits in memory");
    let mut mesh = Mesh::default();
    // The border of the core from the front pole up, over the top, and down to the back pole.
    let border: Vec<(i64, i64)> = (0..m)
        .map(|v| (-m, v))
        .chain((-m..m).map(|u| (u, m)))
        .chain((0..=m).rev().map(|v| (m, v)))
        .collect();
    let plain: Vec<f64> = border.iter().map(|&(u, v)| angle(u, v)).collect();
    let opening = surround.map(|(_, opening)| PI - opening);
    let mut marks: Vec<f64> = opening.into_iter().chain([PI - limbus]).collect();
    marks.retain(|mark| *mark > 0.0 && *mark < PI);
    marks.sort_by(f64::total_cmp);
    marks.dedup();
    let rising: Vec<f64> = plain.iter().rev().copied().collect();
    let rays = Rays::through(&marks, &rising);
    for v in 0..=m {
        for u in -m..=m {
            let q = u.abs().max(v) as f64;
            let (t, over) =
                if q > 0.0 { (rays.bring(angle(u, v)), SQUARE / q) } else { (0.0, 0.0) };
            let scale = spacing.core * radius * q / m as f64;
            let out = scale * (over * v as f64 + CIRCLE * libm::sin(t));
            mesh.x.push(scale * (over * u as f64 + CIRCLE * libm::cos(t)));
            mesh.r.push(if v == 0 { 0.0 } else { out });
        }
    }
    let columns = 2 * half + 1;
    mesh.blocks.push(Block { columns, nodes: (0..mesh.x.len()).collect() });

    let place = |u: i64, v: i64| v as usize * columns + (u + m) as usize;
    let rays: Vec<f64> = plain.iter().map(|&t| rays.bring(t)).collect();
    let border: Vec<usize> = border.iter().map(|&(u, v)| place(u, v)).collect();
    let on_shell: Vec<(f64, f64)> =
        rays.iter().map(|t| (radius * libm::cos(*t), radius * libm::sin(*t))).collect();
    let layers = (GLOBE_LAYERS * half as f64).round() as usize;
    mesh.shell = mesh.layers(border, &on_shell, (layers, spacing.within));

    if let Some((wall, opening)) = surround {
        // A cell is kept if all of it lies behind the opening.
        if let Some(first) = (0..rays.len() - 1).find(|&i| rays[i] <= PI - opening) {
            let at = |&t: &f64| (wall.distance(t) * libm::cos(t), wall.distance(t) * libm::sin(t));
            let on_wall: Vec<_> = rays[first..].iter().map(at).collect();
            let layers = (AROUND_LAYERS * half as f64).round() as usize;
            let shell = mesh.shell[first..].to_vec();
            mesh.wall = mesh.layers(shell, &on_wall, (layers, -spacing.beyond));
        }
    }
    mesh
}

/// Share of the way of a layer, thinner by a share at the outer end.
pub(crate) fn graded(layer: usize, of: usize, thinner: f64) -> f64 {
    let even = layer as f64 / of as f64;
    even + thinner * even * (1.0 - even)
}

impl Mesh {
    /// Adds a block of so many [`graded`] layers from `inner` to `outer`; returns its last row.
    fn layers(
        &mut self,
        inner: Vec<usize>,
        outer: &[(f64, f64)],
        (layers, thinner): (usize, f64),
    ) -> Vec<usize> {
        let columns = inner.len();
        let mut nodes = inner;
        for layer in 1..=layers {
            let share = graded(layer, layers, thinner);
            for i in 0..columns {
                let (x, r) = (self.x[nodes[i]], self.r[nodes[i]]);
                // The rays at both ends of a whole row lie on the axis.
                let on_axis = r == 0.0;
                nodes.push(self.x.len());
                self.x.push(x + share * (outer[i].0 - x));
                self.r.push(if on_axis { 0.0 } else { r + share * (outer[i].1 - r) });
            }
        }
        let last = nodes[layers * columns..].to_vec();
        self.blocks.push(Block { columns, nodes });
        last
    }
}
