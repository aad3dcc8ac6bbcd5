//! Flexible bodies: rods whose sections turn by polynomials of the place along them.

use proc_macro2::Ident;

use super::expression::{Expr, Vector};
use crate::base::ids::{BodyId, CoordinateId, JointId};
use crate::base::legendre::Gauss;

/// A geometrically exact rod. Its sections turn relative to the root by the Rodrigues vector
/// `psi(x) = sum_j q_j I_j(x)`, with `I_j` the integrals of the shifted Legendre polynomials from 0 to `x`; their places
/// follow by integration.
#[derive(Clone, Debug)]
pub struct Beam {
    /// Its name: of the declared beam, with a number if loads split this into several.
    pub name: String,
    /// The declared name.
    pub whole: Ident,
    /// The body whose frame is fixed in the section at the root.
    pub body: BodyId,
    /// Length, m.
    pub length: Expr,
    /// Unit vectors in the frame of the root: along the beam there, and across it, by which its sections are described.
    pub axes: [Vector; 3],
    /// For each axis, the coordinates by which sections turn about it.
    pub coordinates: [Vec<CoordinateId>; 3],
    /// Coordinates of the strain along the beam, and of shear along the second and the third axis.
    pub strains: [Vec<CoordinateId>; 3],
    /// Whether sections shear as the change of the bending moments requires.
    pub static_shear: bool,
    /// Places of quadrature as fractions of the length, their weights, and the sections there.
    pub sections: Vec<(f64, f64, Section)>,
    /// The section at the root.
    pub root: Section,
    /// Whether its sections are circles or tubes.
    pub round: bool,
    /// Sections to which something is attached.
    pub stations: Vec<Station>,
    /// Speed at which its material turns about the bent axis, rad/s, beside the sections' own motion.
    pub spin: Expr,
    /// What must be positive in any design, and its values.
    pub positive: Vec<(String, Expr)>,
    /// Time that the rate of strain is multiplied by, s: moments are proportional to the strain and to this.
    pub lag: Expr,
}

impl Beam {
    /// The number of its coordinates.
    pub fn size(&self) -> usize {
        self.coordinates.iter().chain(&self.strains).map(Vec::len).sum()
    }

    /// How many modes its coordinates resolve by the rule: `m` modes of a plane take `n = 1.5 m + 2` coordinates.
    pub fn resolved_modes(&self) -> usize {
        let [_, about_y, about_z] = &self.coordinates;
        let of_plane = |plane: &Vec<CoordinateId>| plane.len().saturating_sub(2) * 2 / 3;
        of_plane(about_y) + of_plane(about_z)
    }

    /// The rule of its quadrature, on the length as a fraction.
    pub fn quadrature(&self) -> Gauss {
        let (points, weights) = self.sections.iter().map(|(fraction, weight, _)| (fraction, weight)).unzip();
        Gauss { points, weights }
    }
}

/// A cross-section, per unit of length.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Mass, kg/m.
    pub mass: Expr,
    /// Mass times squared distance from the second and from the third axis through its centre, kg m.
    pub inertia: [Expr; 2],
    /// Centre of mass along the second and the third axis, m.
    pub center: [Expr; 2],
    /// Stiffness against twist, and against bending about the second and the third axis, N m^2.
    pub stiffness: [Expr; 3],
    /// Stiffness against stretch, and against shear along the second and the third axis, N; zero if not known.
    pub against_strain: [Expr; 3],
    /// What couples the strains of two numbers, lower first: twist, bending about the second and the third axis,
    /// stretch and shear along the second and the third axis are 0 to 5. In N m^2, N m and N.
    pub coupling: Vec<(usize, usize, Expr)>,
    /// The angle by which its axes are turned about the beam before it bends, rad.
    pub twist: Expr,
    /// The angles by which the axis of the beam is turned about the second and the third axis before it bends, rad.
    pub prebend: [Expr; 2],
    /// Extent along the second and along the third axis, m; zero if only numbers are known.
    pub size: [Expr; 2],
}

/// A section with a frame of its own.
#[derive(Clone, Debug)]
pub struct Station {
    /// Its place as a fraction of the length.
    pub place: f64,
    /// Its cross-section.
    pub section: Section,
    /// The massless body that moves with it.
    pub body: BodyId,
    /// What connects this to the root.
    pub joint: JointId,
}
