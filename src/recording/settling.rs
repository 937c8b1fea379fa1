//! When a result is final: what the energy that is left could still do.
//!
//! After the load, the energy E = kinetic + elastic only falls. At any later time
//!
//! * by Cauchy-Schwarz the springs at a node pull with at most `sqrt(sum k) sqrt(2 E_elastic)` and
//!   its drag with `c sqrt(2 E_kinetic / m)`, together at most `sqrt(sum k + c^2/m) sqrt(2 E)`;
//! * the shell is longer than at rest by at most `sqrt(sum 1/k) sqrt(2 E)` over the springs along it;
//! * no spring is strained by more than `sqrt(2 E / (k l0^2))`.
//!
//! Drag takes the integral of c v^2 from that energy, so over the time T that is left a node moves
//! by at most the integral of |v| <= `sqrt(T) sqrt(E / c)`; two nodes together by `sqrt(2 T E / c)`.
//! This holds in any shape, without linearising.
//!
//! Once all of it stays below what has been recorded, the rest of the window need not be computed.
//! The proof is of the equations of motion; it says nothing of a solution that is chaotic.

use crate::eye::{Eye, SpringKind};

/// A bound that grows with the root of the energy: this times `sqrt(2 E)`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach(f64);

impl Reach {
    /// The largest value that `energy` J can still cause.
    pub fn reach(self, energy: f64) -> f64 {
        self.0 * (2.0 * energy).sqrt()
    }
}

/// A bound of the way that remains: this times `sqrt(E T)`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Travel(f64);

impl Travel {
    /// The farthest that `energy` J can move it in `time` s, in m.
    pub fn travel(self, energy: f64, time: f64) -> f64 {
        self.0 * (energy * time.max(0.0)).sqrt()
    }
}

/// The bounds of all results of one eye.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    /// Force at each monitored node, N.
    pub force: [Reach; 4],
    /// Growth of the shell, m.
    pub shell: Reach,
    /// Strain of any spring.
    pub strain: Reach,
    /// Mean displacement of the two nodes at the apex, m.
    pub apex: Travel,
    /// Growth of the vertical diameter, m.
    pub meridian: Travel,
}

impl Bounds {
    pub fn new(eye: &Eye) -> Self {
        let marks = &eye.landmarks;
        let drag = |nodes: [usize; 2]| {
            nodes
                .map(|n| eye.nodes[n].drag)
                .into_iter()
                .fold(f64::INFINITY, f64::min)
        };
        let weakest = eye
            .springs
            .iter()
            .filter(|s| !(eye.nodes[s.a].fixed() && eye.nodes[s.b].fixed()))
            .map(|s| s.stiffness * s.rest_length * s.rest_length)
            .fold(f64::INFINITY, f64::min);
        Self {
            force: marks.monitors.map(|n| force(eye, n)),
            shell: shell(eye),
            strain: Reach((1.0 / weakest).sqrt()),
            apex: Travel((0.5 / drag(marks.apex)).sqrt()),
            meridian: Travel((2.0 / drag(marks.meridian)).sqrt()),
        }
    }
}

fn force(eye: &Eye, node: usize) -> Reach {
    let springs = eye.springs.iter().filter(|s| s.a == node || s.b == node);
    let stiffness: f64 = springs.map(|s| s.stiffness).sum();
    let node = &eye.nodes[node];
    Reach((stiffness + node.drag * node.drag / node.mass).sqrt())
}

fn shell(eye: &Eye) -> Reach {
    let count = eye.landmarks.shell.len();
    let mut order = vec![usize::MAX; eye.nodes.len()];
    for (i, &n) in eye.landmarks.shell.iter().enumerate() {
        order[n] = i;
    }
    let compliance: f64 = eye
        .springs
        .iter()
        .filter(|s| {
            let (a, b) = (order[s.a], order[s.b]);
            s.kind == SpringKind::Sclera && matches!(a.abs_diff(b), d if d == 1 || d + 1 == count)
        })
        .map(|s| 1.0 / s.stiffness)
        .sum();
    Reach(compliance.sqrt())
}
