//! Dashpots along the springs: they resist a change of length and let a whole eye move freely.
//!
//! The force on a is `c ((v_b - v_a) . e) e` along the unit vector e from a to b, with
//! c = 2 xi sqrt(k m) and m the reduced mass of the two ends, or the mass of the free one.
//! The drag of the paper acts on absolute velocity instead; at 8.2 m/s it would hold a whole eye back
//! with 578 N, twice the force that was measured.

use super::system::System;
use crate::eye::{Eye, SpringKind};
use nalgebra::Vector2;

/// One dashpot between two slots of the rows.
#[derive(Debug, Clone, Copy)]
struct Dashpot {
    a: u32,
    b: u32,
    damping: f64,
}

/// All dashpots of an eye.
#[derive(Debug, Clone)]
pub struct Dashpots {
    list: Vec<Dashpot>,
    shortest_squared: f64,
    /// Bound of the largest decay rate, in 1/s: twice the sum of c at a node over its mass.
    pub rate: f64,
}

impl Dashpots {
    /// Dashpots along the springs of `eye`, compiled whole as `system`, with the given damping ratios
    /// in globe and fat.
    pub fn new(eye: &Eye, system: &System, globe: f64, fat: f64) -> Self {
        let mut sums = vec![0.0; eye.nodes.len()];
        let mut list = Vec::with_capacity(eye.springs.len());
        for spring in &eye.springs {
            let (a, b) = (&eye.nodes[spring.a], &eye.nodes[spring.b]);
            let mass = match (a.fixed(), b.fixed()) {
                (true, true) => continue,
                (true, false) => b.mass,
                (false, true) => a.mass,
                (false, false) => a.mass * b.mass / (a.mass + b.mass),
            };
            let ratio = if spring.kind == SpringKind::Fat {
                fat
            } else {
                globe
            };
            let damping = 2.0 * ratio * (spring.stiffness * mass).sqrt();
            if damping > 0.0 {
                let slot = |node| system.place(node).slot as u32;
                list.push(Dashpot {
                    a: slot(spring.a),
                    b: slot(spring.b),
                    damping,
                });
                sums[spring.a] += damping;
                sums[spring.b] += damping;
            }
        }
        let free = eye.nodes.iter().zip(&sums).filter(|(n, _)| !n.fixed());
        Self {
            list,
            shortest_squared: system.shortest_squared,
            rate: 2.0 * free.map(|(n, sum)| sum / n.mass).fold(0.0, f64::max),
        }
    }

    /// Number of dashpots.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Adds the forces at positions `x`, `y` and velocities `vx`, `vy`; returns the power that they
    /// take, in W.
    pub fn apply(
        &self,
        (x, y): (&[f64], &[f64]),
        (vx, vy): (&[f64], &[f64]),
        (fx, fy): (&mut [f64], &mut [f64]),
    ) -> f64 {
        // All of one length: a bound checked for one is checked for all.
        let len = x.len();
        let (y, vx, vy) = (&y[..len], &vx[..len], &vy[..len]);
        let (fx, fy) = (&mut fx[..len], &mut fy[..len]);
        let mut power = 0.0;
        for dashpot in &self.list {
            let (a, b) = (dashpot.a as usize, dashpot.b as usize);
            let d = Vector2::new(x[b] - x[a], y[b] - y[a]);
            let v = Vector2::new(vx[b] - vx[a], vy[b] - vy[a]);
            let along = v.dot(&d);
            let pull = dashpot.damping * along / d.norm_squared().max(self.shortest_squared);
            power += pull * along;
            fx[a] += pull * d.x;
            fy[a] += pull * d.y;
            fx[b] -= pull * d.x;
            fy[b] -= pull * d.y;
        }
        power
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::State;
    use crate::scenario::{Model, Physiological, Scenario};
    use crate::study::Case;

    #[test]
    fn an_eye_that_moves_as_a_whole_is_not_held_back() {
        let scenario = Scenario {
            model: Model::Physiological(Physiological::default()),
            ..Scenario::default()
        };
        let case = Case::new(&scenario.check().unwrap());
        let state = State::at_rest(&case.system);
        let dashpots = Dashpots::new(&case.eye, &case.system, 0.1, 0.22);
        let len = state.x.len();
        let apply = |vx: &[f64], vy: &[f64]| {
            let (mut fx, mut fy) = (vec![0.0; len], vec![0.0; len]);
            let power = dashpots.apply((&state.x, &state.y), (vx, vy), (&mut fx, &mut fy));
            (power, fx, fy)
        };
        let (power, fx, _) = apply(&vec![8.2; len], &vec![0.0; len]);
        assert_eq!((power, fx), (0.0, vec![0.0; len]));
        let spin: (Vec<f64>, Vec<f64>) = (0..len).map(|i| (-state.y[i], state.x[i])).unzip();
        assert!(apply(&spin.0, &spin.1).0 < 1e-25);
        // Stretching takes power, and the forces add up to nothing.
        let (power, fx, fy) = apply(&state.x, &vec![0.0; len]);
        assert!(power > 0.0);
        assert!(fx.iter().sum::<f64>().abs() < 1e-12 && fy.iter().sum::<f64>().abs() < 1e-12);
    }
}
