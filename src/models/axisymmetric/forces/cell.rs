//! One cell: a ring with the section of a quad and one pressure.
//!
//! * Pressure of the whole cell, p = K (1/J - 1) with J = V/V0, from the energy K V0 (J - 1 - ln
//!   J).
//! * Artificial viscosity q = -a rho l c D + (b rho l^2 D^2 where D < 0) with D = V'/V, which
//!   carries a shock over a few cells (von Neumann and Richtmyer 1950; the linear term is
//!   Landshoff's, 1955). l is the area of the section over its longest diagonal.
//! * Subzonal pressures (Caramana and Shashkov 1998): each corner with its two neighbours is a
//!   ring with a triangle for a section. As j = VT/VT0 comes to 0, pT = (Ks/3)(j^-3 - 1) grows
//!   without end and no corner can fold. The four triangles cover the quad twice, so each counts
//!   half. They have a viscosity of their own against changes of shape.
//! * Shear: (G/2) V0 (J^(-2/3) I1 - 3) on the gradient in the middle of the quad, where J is that
//!   gradient's, and a Newtonian viscosity.
//!
//! This is the plain form: [`crate::models::axisymmetric::forces::quads`] computes the same of
//! many cells at once and is tested against it.

use crate::models::axisymmetric::eye::{AxisymmetricEye, Cell, parameters::Material};
use nalgebra::Matrix2;
use std::f64::consts::FRAC_PI_3;

/// Linear and quadratic artificial viscosity.
pub(crate) const LINEAR: f64 = 0.1;
pub(crate) const QUADRATIC: f64 = 2.25;
/// Viscosity of the corner triangles, and the bulk modulus in Pa whose sound speed it takes.
pub(crate) const SUBZONAL_VISCOSITY: f64 = 0.05;
pub(crate) const SUBZONAL_BULK: f64 = 100e6;
/// Share of a triangle's volume at rest below which its pressure grows only linearly.
pub(crate) const SQUEEZED: f64 = 0.05;
/// What a corner triangle may lose of its volume in a step as long as the bound, as a share.
pub(crate) const LOSS_IN_STEP: f64 = 0.5;
/// How many times the least bound of its cells a mesh bears: its nodes carry the mass of all cells
/// around them, and neighbours do not swell at once. By the largest eigenvalue of whole meshes and
/// shells, 1.5 times at least (a paintball that is flat) and 2 in the middle, over 20 blows from
/// rest to crushed on levels 1 to 3; tests ask some again.
pub(crate) const ASSEMBLED: f64 = 1.4;
/// Where its most squeezed corner has this share of its volume or less, that corner's viscosity
/// bounds the step, and a cell counts as if by itself; from a tenth more on as one of many.
pub(crate) const PRESSED: f64 = 0.25;
/// How what counts of a cell's rate falls from the one to the other, per share of the corner.
pub(crate) const EASED: f64 = (1.0 - 1.0 / ASSEMBLED) / 0.1;
/// Share of area or volume that a folded cell is taken to have, so that all stays finite.
pub(crate) const FLAT: f64 = 1e-3;

type Point = (f64, f64);

/// What one cell is at rest.
pub(crate) struct Rest {
    pub volume: f64,
    pub triangles: [f64; 4],
    /// Inverse of the matrix whose columns are the diagonals, row by row.
    pub diagonals: [f64; 4],
    pub radius: f64,
    pub area: f64,
    pub material: Material,
    pub subzonal: f64,
}

/// What a cell does at some instant.
pub(crate) struct Response {
    /// On each corner, N.
    pub force: [Point; 4],
    /// Pa.
    pub pressure: f64,
    /// m3.
    pub volume: f64,
    /// Power lost to viscosity, W.
    pub loss: f64,
    /// Longest stable step, s.
    pub limit: f64,
    /// Smallest volume of a corner triangle over its volume at rest.
    pub least_triangle: f64,
}

/// A quad's section: its diagonals, twice its area (above 0), its length, and its mean radius.
struct Section {
    a: Point,
    b: Point,
    det: f64,
    length: f64,
    radius: f64,
}

/// The left Cauchy-Green tensor, and a third of its trace.
struct Strain {
    xx: f64,
    xr: f64,
    rr: f64,
    hh: f64,
    third: f64,
}

impl Response {
    fn push(&mut self, corner: usize, pressure: f64, gradient: Point) {
        self.force[corner].0 += pressure * gradient.0;
        self.force[corner].1 += pressure * gradient.1;
    }
}

fn squared((x, r): Point) -> f64 {
    x * x + r * r
}

/// The diagonals from the first corner to the third and from the second to the fourth.
fn diagonals(p: [Point; 4]) -> (Point, Point) {
    ((p[2].0 - p[0].0, p[2].1 - p[0].1), (p[3].0 - p[1].0, p[3].1 - p[1].1))
}

/// Volume of a ring whose section has corners anticlockwise, and its gradient.
pub(crate) fn volume<const N: usize>(p: [Point; N]) -> (f64, [Point; N]) {
    let mut sum = 0.0;
    let mut gradient = [(0.0, 0.0); N];
    for i in 0..N {
        let k = (i + 1) % N;
        let (a, b) = (p[i], p[k]);
        let square = a.1 * a.1 + a.1 * b.1 + b.1 * b.1;
        let along = b.0 - a.0;
        sum -= FRAC_PI_3 * along * square;
        gradient[i].0 += FRAC_PI_3 * square;
        gradient[k].0 -= FRAC_PI_3 * square;
        gradient[i].1 -= FRAC_PI_3 * along * (2.0 * a.1 + b.1);
        gradient[k].1 -= FRAC_PI_3 * along * (a.1 + 2.0 * b.1);
    }
    (sum, gradient)
}

/// The volume alone, for less work.
fn swept<const N: usize>(p: [Point; N]) -> f64 {
    let edge = |i: usize| {
        let (a, b) = (p[i], p[(i + 1) % N]);
        (b.0 - a.0) * (a.1 * a.1 + a.1 * b.1 + b.1 * b.1)
    };
    -FRAC_PI_3 * (0..N).map(edge).sum::<f64>()
}

/// The least volume of a corner triangle over that at rest, of a cell with its nodes `at` places.
pub(crate) fn least_triangle(
    eye: &AxisymmetricEye,
    corners: &[usize; 4],
    at: impl Fn(usize) -> Point,
) -> f64 {
    let ratio = |i: usize| {
        let nodes = triangle(i).map(|corner| corners[corner]);
        swept(nodes.map(&at)) / swept(nodes.map(|node| eye.at(node)))
    };
    (0..4).map(ratio).fold(f64::INFINITY, f64::min)
}

fn rate<const N: usize>(gradient: &[Point; N], v: &[Point; N]) -> f64 {
    gradient.iter().zip(v).map(|(g, v)| g.0 * v.0 + g.1 * v.1).sum()
}

/// The corner i and its neighbours, in order.
const fn triangle(i: usize) -> [usize; 3] {
    [(i + 3) % 4, i, (i + 1) % 4]
}

/// Pressure of a corner triangle over Ks, and the energy over Ks VT0 that it comes from.
fn subzonal(j: f64) -> (f64, f64) {
    let at = j.max(SQUEEZED);
    let below = at - j;
    let pressure = (at.powi(-3) - 1.0) / 3.0;
    let slope = at.powi(-4);
    let energy = (0.5 * at.powi(-2) + at - 1.5) / 3.0;
    (pressure + slope * below, energy + below * (pressure + 0.5 * slope * below))
}

impl Rest {
    pub fn new(eye: &AxisymmetricEye, cell: &Cell<4>) -> Self {
        let p = cell.corners.map(|node| eye.at(node));
        let (a, b) = diagonals(p);
        let det = a.0 * b.1 - b.0 * a.1;
        Self {
            volume: volume(p).0,
            triangles: std::array::from_fn(|i| volume(triangle(i).map(|k| p[k])).0),
            diagonals: [b.1 / det, -b.0 / det, -a.1 / det, a.0 / det],
            radius: 0.25 * p.iter().map(|p| p.1).sum::<f64>(),
            area: 0.5 * det,
            material: cell.material,
            subzonal: cell.subzonal,
        }
    }

    /// What a cell with its corners at `p` (m) and of velocities `v` (m/s) does.
    pub fn respond(&self, p: [Point; 4], v: [Point; 4]) -> Response {
        let section = self.section(p);
        let (true_volume, gradient) = volume(p);
        let now = true_volume.max(FLAT * self.volume);
        let j = now / self.volume;
        let expansion = rate(&gradient, &v) / now;
        let pressure = self.material.bulk * (1.0 / j - 1.0);
        let sound = (self.material.bulk / self.material.density).sqrt();
        let length = section.length;
        let mass_length = self.material.density * length;
        let quadratic = QUADRATIC * mass_length * length * expansion * expansion.min(0.0);
        let artificial = -LINEAR * mass_length * sound * expansion + quadratic;

        let mut response = Response {
            force: [(0.0, 0.0); 4],
            pressure,
            volume: true_volume,
            loss: -artificial * expansion * now,
            limit: f64::INFINITY,
            least_triangle: f64::INFINITY,
        };
        // Pressure on the whole quad, to which the corners' viscosity adds.
        let mut whole = pressure + artificial;
        let eta = SUBZONAL_VISCOSITY * mass_length * (SUBZONAL_BULK / self.material.density).sqrt();
        for (i, at_rest) in self.triangles.iter().enumerate() {
            let corners = triangle(i);
            let (vt, slope) = volume(corners.map(|k| p[k]));
            let jt = vt / at_rest;
            response.least_triangle = response.least_triangle.min(jt);
            let vt = vt.max(SQUEEZED * at_rest);
            let own_rate = rate(&slope, &corners.map(|k| v[k])) / vt;
            response.limit = response.limit.min(LOSS_IN_STEP / (-own_rate).max(f64::MIN_POSITIVE));
            let shape_rate = own_rate - expansion;
            let (over, _) = subzonal(jt);
            let viscous = 0.5 * eta * shape_rate;
            for (corner, slope) in corners.into_iter().zip(slope) {
                response.push(corner, 0.5 * self.subzonal * over - viscous, slope);
            }
            whole += viscous * vt / now;
            response.loss += viscous * shape_rate * vt;
        }
        let counts = 1.0 - EASED * (response.least_triangle - PRESSED);
        let alone = self.limit(j, length, expansion);
        response.limit = response.limit.min(alone / counts.clamp(1.0 / ASSEMBLED, 1.0));
        for (corner, slope) in gradient.into_iter().enumerate() {
            response.push(corner, whole, slope);
        }
        self.shear(&section, v, now, &mut response);
        response
    }

    /// Stored, J, with corners at `p`.
    pub fn energy(&self, p: [Point; 4]) -> f64 {
        let j = (swept(p) / self.volume).max(FLAT);
        let mut energy = self.material.bulk * self.volume * (j - 1.0 - libm::log(j));
        for (i, at_rest) in self.triangles.iter().enumerate() {
            let (_, stored) = subzonal(swept(triangle(i).map(|k| p[k])) / at_rest);
            energy += 0.5 * self.subzonal * at_rest * stored;
        }
        let (strain, isochoric) = self.strain(&self.section(p));
        energy + 1.5 * self.volume * self.material.shear * (isochoric * strain.third - 1.0)
    }

    fn section(&self, p: [Point; 4]) -> Section {
        let (a, b) = diagonals(p);
        let det = (a.0 * b.1 - b.0 * a.1).max(FLAT * 2.0 * self.area);
        Section {
            a,
            b,
            det,
            length: 0.5 * det / squared(a).max(squared(b)).sqrt(),
            radius: 0.25 * p.iter().map(|p| p.1).sum::<f64>(),
        }
    }

    /// Adds what resists shear, with the gradients of position and velocity in the middle of the
    /// quad: the diagonals are mapped exactly by them.
    fn shear(&self, section: &Section, v: [Point; 4], now: f64, response: &mut Response) {
        let Section { a, b, det, radius, .. } = *section;
        let (Strain { xx, xr, rr, hh, third }, isochoric) = self.strain(section);
        let g = self.material.shear * isochoric * self.volume;

        let (va, vb) = diagonals(v);
        let inverse = Matrix2::new(b.1, -b.0, -a.1, a.0) / det;
        let l = Matrix2::new(va.0, vb.0, va.1, vb.1) * inverse;
        let l_hh = 0.25 * v.iter().map(|v| v.1).sum::<f64>() / radius;
        let (one, mean) = (Matrix2::identity(), (l.trace() + l_hh) / 3.0);
        let (rates, d_hh) = ((l + l.transpose()) * 0.5 - one * mean, l_hh - mean);
        let n = 2.0 * self.material.viscosity * now;
        response.loss += n * (rates.norm_squared() + d_hh * d_hh);

        let stress = (Matrix2::new(xx, xr, xr, rr) - one * third) * g + rates * n;
        let on_diagonals = stress * inverse.transpose();
        let out = 0.25 * (g * (hh - third) + n * d_hh) / radius;
        for (i, force) in response.force.iter_mut().enumerate() {
            let on = on_diagonals.column(i % 2) * if i < 2 { 1.0 } else { -1.0 };
            force.0 += on.x;
            force.1 += on.y - out;
        }
    }

    /// The strain in the middle, and the factor that takes the change of volume out of it.
    fn strain(&self, section: &Section) -> (Strain, f64) {
        let Section { a, b, det, .. } = *section;
        let d = &self.diagonals;
        let f = [
            a.0 * d[0] + b.0 * d[2],
            a.0 * d[1] + b.0 * d[3],
            a.1 * d[0] + b.1 * d[2],
            a.1 * d[1] + b.1 * d[3],
        ];
        let hoop = section.radius / self.radius;
        let (xx, rr, hh) = (f[0] * f[0] + f[1] * f[1], f[2] * f[2] + f[3] * f[3], hoop * hoop);
        let strain =
            Strain { xx, xr: f[0] * f[2] + f[1] * f[3], rr, hh, third: (xx + rr + hh) / 3.0 };
        let change = det / (2.0 * self.area) * hoop;
        let root = libm::cbrt(change);
        (strain, 1.0 / (root * root))
    }

    /// The longest step of a leapfrog whose viscous forces lag half a step: with frequency w = 2
    /// c/l and damping ratio z = s/c it is stable up to (2/w)(sqrt(1 + z^2) - z), which is
    /// l/(sqrt(c^2 + s^2) + s) by itself.
    fn limit(&self, j: f64, length: f64, expansion: f64) -> f64 {
        let sound = (self.material.bulk / self.material.density).sqrt();
        let subzonal_sound = (SUBZONAL_BULK / self.material.density).sqrt();
        let stiffness =
            self.material.bulk / (j * j) + 4.0 / 3.0 * self.material.shear + self.subzonal;
        let kinematic = self.material.viscosity / self.material.density;
        let s = LINEAR * sound
            + 4.0 * SUBZONAL_VISCOSITY * subzonal_sound
            + 2.0 * kinematic / length
            + QUADRATIC * length * expansion.abs();
        let waves = length / ((stiffness / self.material.density + s * s).sqrt() + s);
        let diffusion =
            if kinematic > 0.0 { length * length / (4.0 * kinematic) } else { f64::INFINITY };
        waves.min(diffusion)
    }
}
