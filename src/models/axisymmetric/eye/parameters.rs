//! What the axisymmetric eye is made of, in SI units, each default with its source.

use crate::models::axisymmetric::eye::mean;
use std::f64::consts::PI;

/// One degree, in rad.
const DEGREE: f64 = PI / 180.0;

/// What fills cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// kg/m3.
    pub density: f64,
    /// Bulk modulus K, in Pa.
    pub bulk: f64,
    /// Shear modulus G, in Pa.
    pub shear: f64,
    /// Newtonian viscosity, in Pa s.
    pub viscosity: f64,
}

impl Material {
    /// The gel inside the globe. G 10 Pa and 0.1 Pa s are in the range of rheometry of the vitreous
    /// (Nickerson et al. 2008). Its bulk modulus is that of water over 22, which costs a fifth of
    /// the time steps; from 30 `MPa` to 2.2 `GPa` deformed shapes change by 6 %.
    pub const VITREOUS: Self = Self { density: 1000.0, bulk: 100e6, shear: 10.0, viscosity: 0.1 };
    /// Lens: 10 kPa shear modulus (in the range of Fisher 1971 and of bubble tests of old lenses,
    /// Hollman et al. 2007).
    pub const LENS: Self = Self { density: 1050.0, bulk: 100e6, shear: 1e4, viscosity: 1.0 };
    /// Orbital fat: Young's modulus 47 kPa (Power et al. 2002) as a shear modulus of a third of it,
    /// and a bulk modulus of 50 G, a Poisson ratio of 0.49.
    pub const ORBITAL_FAT: Self =
        Self { density: 970.0, bulk: 0.78e6, shear: 1.57e4, viscosity: 1.0 };
    /// 10 % gelatin, in which enucleated eyes are held (Delori et al. 1969; Kennedy et al. 2007).
    pub const GELATIN: Self = Self { density: 1030.0, bulk: 100e6, shear: 3e4, viscosity: 1.0 };

    /// `share` of this and the rest of `other`.
    #[must_use]
    pub fn mixed(self, other: Self, share: f64) -> Self {
        let mix = |a: f64, b: f64| if share == 1.0 { a } else { b + share * (a - b) };
        Self {
            density: mix(self.density, other.density),
            bulk: mix(self.bulk, other.bulk),
            shear: mix(self.shear, other.shear),
            viscosity: mix(self.viscosity, other.viscosity),
        }
    }
}

/// A rigid wall around the globe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wall {
    /// The bone: r = `radius` - `slope` (x + `behind`), at most `farthest` from the centre.
    Cone {
        /// Radius at x = -`behind`, in m.
        radius: f64,
        /// Loss of radius per length towards the back.
        slope: f64,
        /// m.
        behind: f64,
        /// m.
        farthest: f64,
    },
    /// A holder of this radius, in m.
    Sphere(f64),
}

impl Wall {
    /// Whether it is bone and not a holder of a laboratory.
    pub fn is_bone(&self) -> bool {
        matches!(self, Self::Cone { .. })
    }

    /// Distance from the globe's centre to the wall along a ray at `angle` rad from the back.
    pub fn distance(&self, angle: f64) -> f64 {
        match *self {
            Self::Sphere(radius) => radius,
            Self::Cone { radius, slope, behind, farthest } => {
                let across = libm::sin(angle) + slope * libm::cos(angle);
                if across <= 0.0 {
                    farthest
                } else {
                    ((radius - slope * behind) / across).min(farthest)
                }
            }
        }
    }
}

/// Tissue or gelatin that holds the globe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surround {
    /// Rigid.
    pub wall: Wall,
    /// Front angle below which there is none, in rad.
    pub opening: f64,
    /// Between globe and wall.
    pub material: Material,
}

impl Surround {
    /// A bony orbit filled with fat: entrance 19 mm in radius, narrowing by 0.39 per length, the
    /// mean of a cone about 40 mm deep.
    pub fn orbit() -> Self {
        Self {
            wall: Wall::Cone { radius: 19e-3, slope: 0.39, behind: 4e-3, farthest: 30e-3 },
            opening: 72.0 * DEGREE,
            material: Material::ORBITAL_FAT,
        }
    }

    /// A stiff cup of 20 mm filled with gelatin.
    pub fn gelatin() -> Self {
        Self { wall: Wall::Sphere(20e-3), opening: 40.0 * DEGREE, material: Material::GELATIN }
    }

    /// The front edge of the wall: x and distance from the axis, in m.
    pub(crate) fn edge(&self) -> (f64, f64) {
        let angle = PI - self.opening;
        let distance = self.wall.distance(angle);
        (distance * libm::cos(angle), distance * libm::sin(angle))
    }
}

/// Stiffness against folding where the material is far stiffer in bulk, in Pa.
pub(crate) const SUBZONAL_PA: f64 = 0.3e6;

/// Cornea and sclera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShellParameters {
    /// kg/m3.
    pub density: f64,
    /// Poisson ratio, nearly incompressible.
    pub poisson: f64,
    /// Secant modulus of the cornea at failure, in Pa: 9.4 `MPa` at 18 % (Uchio et al. 1999).
    pub cornea_modulus: f64,
    /// Secant modulus of the sclera at failure, in Pa: 9.4 `MPa` at 6.8 % (Uchio et al. 1999).
    pub sclera_modulus: f64,
    /// Front angle of the limbus, in rad.
    pub limbus: f64,
    /// m.
    pub cornea_thickness: f64,
    /// Front angle in rad and thickness in m, linear between (human: Vurgese et al. 2012).
    pub sclera_thickness: [(f64, f64); 5],
}

impl ShellParameters {
    /// A human eye's.
    pub fn human() -> Self {
        Self {
            density: 1100.0,
            poisson: 0.49,
            cornea_modulus: 52e6,
            sclera_modulus: 138e6,
            limbus: 33.0 * DEGREE,
            cornea_thickness: 0.55e-3,
            sclera_thickness: [
                (33.0 * DEGREE, 0.50e-3),
                (62.0 * DEGREE, 0.43e-3),
                (90.0 * DEGREE, 0.42e-3),
                (135.0 * DEGREE, 0.65e-3),
                (180.0 * DEGREE, 0.94e-3),
            ],
        }
    }

    /// A pig's: sclera twice and cornea 1.6 times as thick. An assumption, from the ratio of the
    /// pressures at which eyes of the two species burst.
    pub fn pig() -> Self {
        let mut shell = Self::human();
        shell.cornea_thickness *= 1.6;
        for (_, thickness) in &mut shell.sclera_thickness {
            *thickness *= 2.0;
        }
        shell
    }

    /// Thickness in m and modulus in Pa at `angle` rad from the front of the eye.
    pub fn at(&self, angle: f64) -> (f64, f64) {
        if angle < self.limbus {
            return (self.cornea_thickness, self.cornea_modulus);
        }
        let points = &self.sclera_thickness;
        let thickness = match points.iter().position(|p| p.0 > angle) {
            None => points[points.len() - 1].1,
            Some(0) => points[0].1,
            Some(i) => {
                let ((a, ta), (b, tb)) = (points[i - 1], points[i]);
                ta + (tb - ta) * (angle - a) / (b - a)
            }
        };
        (thickness, self.sclera_modulus)
    }

    /// Means over such angles: thickness in m, the modulus in Pa that gives the mean of modulus
    /// times thickness, and the share of sclera.
    pub(crate) fn means(&self, angles: &[f64]) -> (f64, f64, f64) {
        let over = |of: &dyn Fn(f64) -> f64| mean(angles.iter().copied().map(of));
        let thickness = over(&|angle| self.at(angle).0);
        let stiffness = over(&|angle| self.at(angle).0 * self.at(angle).1);
        let sclera = over(&|angle| f64::from(angle >= self.limbus));
        (thickness, stiffness / thickness, sclera)
    }
}

/// An ellipse on the eye's axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LensParameters {
    /// x of its centre, in m.
    pub centre: f64,
    /// Half axes along and across the eye's axis, in m.
    pub half_axes: (f64, f64),
    /// What it is made of.
    pub material: Material,
}

/// The eye and what holds it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameters {
    /// m.
    pub radius: f64,
    /// Angle between the eye's own axis and the line of the blow, in rad.
    pub axis_angle: f64,
    /// Inside the globe.
    pub vitreous: Material,
    /// The lens.
    pub lens: LensParameters,
    /// Cornea and sclera.
    pub shell: ShellParameters,
    /// `None` leaves the globe free.
    pub surround: Option<Surround>,
}

impl Default for Parameters {
    /// A human eye in its orbit, hit from in front.
    fn default() -> Self {
        Self {
            radius: 12e-3,
            axis_angle: 0.0,
            vitreous: Material::VITREOUS,
            lens: LensParameters {
                centre: -6.4e-3,
                half_axes: (2.2e-3, 4.6e-3),
                material: Material::LENS,
            },
            shell: ShellParameters::human(),
            surround: Some(Surround::orbit()),
        }
    }
}
