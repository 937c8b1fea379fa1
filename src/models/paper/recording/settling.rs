//! When a result is final: what the energy that is left could still do.
//!
//! After the load, the energy E = kinetic + elastic only falls. At any later time
//!
//! * by Cauchy-Schwarz the springs at a node pull with at most `sqrt(sum k) sqrt(2 E_elastic)` and
//!   its drag with `c sqrt(2 E_kinetic / m)`, together at most `sqrt(sum k + c^2/m) sqrt(2 E)`;
//! * the shell is longer than at rest by at most `sqrt(sum 1/k) sqrt(2 E)` over the springs along
//!   it;
//! * no spring is strained by more than `sqrt(2 E / (k l0^2))`.
//!
//! Of a hat with weights w the force is at most `sqrt(sum k d^2 + sum w^2 c^2/m) sqrt(2 E)`, with
//! d the difference of the weights at the ends of a spring.
//!
//! Drag takes the integral of c v^2 from that energy, so over the time T that is left the weighted
//! sum of some displacements changes by at most the integral of sum w |v| <= `sqrt(sum w^2/c)
//! sqrt(T E)`. The line through the hats along the shell can grow without any spring along the
//! shell being stretched, where bends straighten out. Its rate of growth is the sum over its
//! corners of v . (e - e'), with e and e' the directions of the sides before and after; |e - e'|
//! is now at most some b, and with every corner moving by less than D it stays below b + 8 D over
//! the shortest side. This holds in any shape, without linearising.
//!
//! Once all of it stays below what has been recorded, the rest of the window need not be computed.
//! The proof is of the equations of motion; it says nothing of a solution that is chaotic.

use crate::models::paper::eye::{Eye, hats::Hat, landmarks::along, springs::SpringKind};
use crate::models::paper::recording::dense::tugs;
use std::collections::BTreeMap;

/// A bound that grows with the root of the energy.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bound(f64);

impl Bound {
    /// The largest value that `energy` J can still cause: this times `sqrt(2 E)`.
    pub fn reach(self, energy: f64) -> f64 {
        self.0 * (2.0 * energy).sqrt()
    }

    /// The farthest that `energy` J can move it in `time` s, in m: this times `sqrt(E T)`.
    pub fn travel(self, energy: f64, time: f64) -> f64 {
        self.0 * (energy * time.max(0.0)).sqrt()
    }
}

/// A bound of the growth of the shell.
#[derive(Debug, Clone, Copy)]
pub(crate) enum ShellBound {
    /// Bound of its growth over its length at rest, where every node is a corner.
    Stretch(Bound),
    /// From now on, where its corners are hats: of the sum of all their ways, and of any one way.
    Change(Bound, Bound),
}

/// How sharply a closed line bends.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bend {
    /// Largest |e - e'| of the directions of two neighbouring sides.
    pub sharpest: f64,
    /// Length of the shortest side, in m.
    pub shortest: f64,
}

impl Bend {
    /// Any bend at all.
    pub const UNKNOWN: Self = Self { sharpest: 2.0, shortest: 0.0 };

    /// How much a line that bends like this can still grow, in m, by the two bounds of its corners.
    pub fn growth(self, all: Bound, one: Bound, energy: f64, left: f64) -> f64 {
        let later = self.sharpest + 8.0 * one.travel(energy, left) / self.shortest;
        // Two directions never differ by more than 2. A side of no length says nothing.
        (if later < 2.0 { later } else { 2.0 }) * all.travel(energy, left)
    }
}

/// The bounds of all results of one eye.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RiseBounds {
    /// Force at each monitored node, N.
    pub force: [Bound; 4],
    /// Growth of the shell, m.
    pub shell: ShellBound,
    /// Strain of any spring.
    pub strain: Bound,
    /// Mean displacement of the two nodes at the apex, m.
    pub apex: Bound,
    /// Growth of the vertical diameter, m.
    pub meridian: Bound,
}

impl RiseBounds {
    pub fn new(eye: &Eye) -> Self {
        let marks = &eye.landmarks;
        let weakest = eye
            .springs
            .iter()
            .filter(|s| !(eye.nodes[s.a].fixed() && eye.nodes[s.b].fixed()))
            .map(|s| s.stiffness * s.rest_length * s.rest_length)
            .fold(f64::INFINITY, f64::min);
        Self {
            force: std::array::from_fn(|m| force(eye, &marks.monitor_hats[m])),
            shell: shell(eye),
            strain: Bound((1.0 / weakest).sqrt()),
            apex: travel(eye, marks.apex_hats.iter().flatten(), 0.5),
            meridian: travel(eye, marks.meridian_hats.iter().flatten(), 1.0),
        }
    }
}

fn force(eye: &Eye, hat: &Hat) -> Bound {
    let stiffness: f64 = tugs(eye, hat).iter().map(|tug| tug.squared).sum();
    let drag = |&(n, weight): &(usize, f64)| {
        let node = &eye.nodes[n];
        weight * weight * (node.drag * node.drag / node.mass)
    };
    Bound((stiffness + hat.iter().map(drag).sum::<f64>()).sqrt())
}

/// Of the sum of the mean displacements over some hats, each times `weight`.
fn travel<'a>(eye: &Eye, hats: impl Iterator<Item = &'a (usize, f64)>, weight: f64) -> Bound {
    let mut weights: BTreeMap<usize, f64> = BTreeMap::new();
    for &(node, share) in hats {
        *weights.entry(node).or_default() += weight * share;
    }
    let sum: f64 = weights.iter().map(|(&n, w)| w * w / eye.nodes[n].drag).sum();
    Bound(sum.sqrt())
}

fn shell(eye: &Eye) -> ShellBound {
    let hats = &eye.landmarks.shell_hats;
    if hats.len() < eye.landmarks.shell.len() {
        let each = hats.iter().map(|hat| travel(eye, hat.iter(), 1.0).0);
        let one = Bound(each.fold(0.0, f64::max));
        return ShellBound::Change(travel(eye, hats.iter().flatten(), 1.0), one);
    }
    let along = along(&eye.landmarks.shell);
    let sclera = eye.springs.iter().filter(|s| s.kind == SpringKind::Sclera);
    let sides = sclera.filter(|s| along(s.a, s.b).is_some_and(|(hop, _)| hop == 1));
    let compliance: f64 = sides.map(|s| 1.0 / s.stiffness).sum();
    ShellBound::Stretch(Bound(compliance.sqrt()))
}
