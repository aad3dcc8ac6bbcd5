//! The mechanism: tables of everything declared.
//!
//! # Joints are sequences of elementary motions
//!
//! Every joint is a list of turns, slides and screws about axes of the frame left by the motions before
//! (`model/mechanism.rs`). One table row gives the motions of each kind and the equations by which it closes a loop
//! (`model/resolve/joints/kinds.rs`); no later stage knows the kinds. A joint declared from the body to its parent is
//! traversed backwards with opposite axes.

use std::f64::consts::TAU;

use proc_macro2::Ident;

pub use super::beam::{Beam, Section, Station};
pub use super::constraint::{Constraint, ConstraintLaw};
pub use super::excitation::{Deviation, Excitation, ExcitationLaw, Frequency, ShakenBy};
use super::expression::{Expr, Matrix, Vector};
pub use super::shaft::{CrossSection, LUMPED, Line, NUMBERS, Shaft, ShaftStation, Span};
pub use super::shape::Shape;
pub use super::superelement::Superelement;
pub use super::tolerance::{Law, Tolerance};
pub use super::unit::Unit;
use crate::base::dimension::Dimension;
use crate::base::ids::{BeamId, BodyId, CoordinateId, DesignId, JointId, PointId};
use eigentol_symbolic::base::spline::{Piece, Spline};

/// A declared mechanism. Every `Ident` keeps the span of its declaration.
#[derive(Clone, Debug)]
pub struct Mechanism {
    /// Name of the generated type.
    pub name: Ident,
    /// Visibility of the generated type.
    pub visibility: syn::Visibility,
    /// Doc comments and other attributes on the declaration.
    pub attributes: Vec<syn::Attribute>,
    /// Inputs.
    pub inputs: Vec<Input>,
    /// Design variables.
    pub design: Vec<DesignVariable>,
    /// Correlations of them.
    pub correlations: Vec<Correlation>,
    /// Equal instances around axes.
    pub rings: Vec<Ring>,
    /// Named constants, each using only earlier ones.
    pub constants: Vec<Constant>,
    /// Curves through points.
    pub curves: Vec<Curve>,
    /// Arguments of curves that can be checked before the motion is known.
    pub curve_arguments: Vec<CurveArgument>,
    /// Acceleration of gravity in the ground frame, m/s^2; zero when not declared.
    pub gravity: Vector,
    /// A length typical of it, m: the geometric mean of the shortest and the longest that are declared.
    pub length: f64,
    /// Whether only the equations are wanted, so that they need not determine a steady motion.
    pub kernels_only: bool,
    /// Bodies.
    pub bodies: Vec<Body>,
    /// Flexible bodies.
    pub beams: Vec<Beam>,
    /// Shafts of many sections.
    pub shafts: Vec<Shaft>,
    /// Superelements.
    pub superelements: Vec<Superelement>,
    /// Joints.
    pub joints: Vec<Joint>,
    /// Joint coordinates, in the order of their joints.
    pub coordinates: Vec<Coordinate>,
    /// Named points.
    pub points: Vec<Point>,
    /// Force elements.
    pub forces: Vec<Force>,
    /// Harmonic excitations.
    pub excitations: Vec<Excitation>,
    /// Constraints, besides those of joints that close loops.
    pub constraints: Vec<Constraint>,
    /// Values that select one of a family of steady motions.
    pub steady: Vec<Steady>,
    /// Outputs.
    pub outputs: Vec<Output>,
}

/// The correlation of two design variables.
#[derive(Clone, Debug)]
pub struct Correlation {
    /// The variables.
    pub variables: [DesignId; 2],
    /// The linear correlation, between -1 and 1.
    pub correlation: f64,
}

/// Equal instances around an axis.
#[derive(Clone, Debug)]
pub struct Ring {
    /// Their name without index.
    pub name: Ident,
    /// How many they are.
    pub members: usize,
    /// The axis, in the frame that carries them.
    pub about: Vector,
    /// What the instances have in common, by its name in an instance: coordinates, one of each instance.
    pub coordinates: Vec<(String, Vec<CoordinateId>)>,
    /// Design variables of the instances, one of each.
    pub design: Vec<Vec<DesignId>>,
}

impl Mechanism {
    /// Removes the forces that were declared for every coordinate but belong to a cut joint, which has no coordinates.
    pub fn forget_forces_of(&mut self, cut: &[JointId]) {
        let joint_of = |id: CoordinateId| self.coordinates[id.index()].joint;
        self.forces.retain(|force| match force.law {
            ForceLaw::CoordinateSpring { coordinate, .. }
            | ForceLaw::CoordinateDamper { coordinate, .. }
            | ForceLaw::CoordinateInerter { coordinates: [coordinate, _], .. } => {
                !force.of_every || !cut.contains(&joint_of(coordinate))
            }
            _ => true,
        });
    }

    /// Whether a joint is planar and coasting, so that its speeds are those along its turned axes.
    pub fn glides(&self, joint: &Joint) -> bool {
        let coasts = |step: &JointStep| self.coordinates[step.coordinate.index()].motion == Motion::Coasting;
        joint.closing == Some(Closing::Planar) && joint.steps.iter().all(coasts)
    }

    /// The stations of shafts and superelements.
    pub fn stations(&self) -> impl Iterator<Item = &ShaftStation> {
        let of_superelements = self.superelements.iter().flat_map(|own| &own.stations);
        self.shafts.iter().flat_map(|shaft| &shaft.stations).chain(of_superelements)
    }

    /// The spans of all shafts.
    pub fn spans(&self) -> impl Iterator<Item = &Span> {
        self.shafts.iter().flat_map(|shaft| &shaft.spans)
    }

    /// Whether a body has a mass of its own.
    pub fn has_mass(&self, body: BodyId) -> bool {
        let is_station = self.stations().any(|station| station.body == body);
        !self.bodies[body.index()].parts.is_empty() || self.beam(body).is_some() || is_station
    }

    /// Whether a coordinate is a strain of a beam.
    pub fn strains(&self, id: CoordinateId) -> bool {
        self.beams.iter().flat_map(|beam| beam.strains.iter().flatten()).into_iter().any(|x| *x == id)
    }

    /// The beam on which a point lies, its place there as a fraction of the length, and the section.
    pub fn section_at(&self, point: PointId) -> Option<(&Beam, f64, &Section)> {
        let Frame::Body(body) = self.points[point.index()].frame else {
            return None;
        };
        self.beams.iter().find_map(|beam| {
            let station = beam.stations.iter().find(|station| station.body == body);
            let root = (beam.body == body).then_some((beam, 0.0, &beam.root));
            station.map(|station| (beam, station.place, &station.section)).or(root)
        })
    }

    /// The beam that a body is.
    pub fn beam(&self, body: BodyId) -> Option<BeamId> {
        self.beams.iter().position(|beam| beam.body == body).map(BeamId::new)
    }

    /// The unit of frequencies in answers: Hz where an input turns something by the minute or the second, else rad/s.
    pub fn frequency_unit(&self) -> Unit {
        let turns = |input: &Input| matches!(input.unit.symbol.as_str(), "rpm" | "rps" | "Hz");
        if self.inputs.iter().any(turns) { Unit { symbol: "Hz".to_owned(), scale: TAU } } else { Unit::one("rad/s") }
    }

    /// Inputs and design variables that nothing refers to.
    pub fn unused(&self) -> impl Iterator<Item = &Ident> {
        self.inputs
            .iter()
            .filter(|input| !input.is_used)
            .map(|input| &input.name)
            .chain(self.design.iter().filter(|variable| !variable.is_used).map(|variable| &variable.name))
    }
}

/// An operating parameter chosen at run time.
#[derive(Clone, Debug)]
pub struct Input {
    /// Declared name.
    pub name: Ident,
    /// Doc comments.
    pub docs: Vec<String>,
    /// Declared unit.
    pub unit: Unit,
    /// Tolerance about the value given at run time.
    pub tolerance: Tolerance,
    /// Whether anything refers to it.
    pub is_used: bool,
}

/// A design variable.
#[derive(Clone, Debug)]
pub struct DesignVariable {
    /// Declared name.
    pub name: Ident,
    /// Doc comments.
    pub docs: Vec<String>,
    /// Unit of the nominal value.
    pub unit: Unit,
    /// Nominal value, SI.
    pub nominal: f64,
    /// Tolerance about the nominal value, SI.
    pub tolerance: Tolerance,
    /// Whether anything refers to it.
    pub is_used: bool,
}

/// A named constant: an expression of numbers, design variables, inputs and earlier constants.
#[derive(Clone, Debug)]
pub struct Constant {
    /// Declared name.
    pub name: Ident,
    /// Its value.
    pub value: Expr,
}

/// The value of an unknown in the steady motion, where steady motions come in a family.
#[derive(Clone, Debug)]
pub struct Steady {
    /// A free coordinate, or a coasting one, of which the speed is given.
    pub coordinate: CoordinateId,
    /// Its name as referred to.
    pub name: Ident,
    /// The value.
    pub value: Expr,
}

/// A curve through points.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its pieces, with arguments and values in SI; it carries the declared name.
    pub spline: Spline,
    /// Dimension of its arguments.
    pub argument: Dimension,
    /// Unit in which its arguments are declared.
    pub unit: Unit,
    /// Dimension of its values.
    pub value: Dimension,
}

impl Curve {
    /// The arguments of its first and its last point, SI.
    pub fn range(&self) -> [f64; 2] {
        let start = |piece: Option<&Piece>| piece.map_or(f64::NAN, |piece| piece[0]);
        let pieces = self.spline.pieces();
        [start(pieces.first()), start(pieces.last())]
    }

    /// The range, slightly extended so that rounding does not exclude its ends.
    pub fn range_with_ends(&self) -> [f64; 2] {
        let [first, last] = self.range();
        let slack = 1e-9 * (last - first);
        [first - slack, last + slack]
    }

    /// An SI argument, in the declared unit with its symbol.
    pub fn with_unit(&self, argument: f64) -> String {
        let number = self.in_unit(argument);
        match self.unit.symbol.as_str() {
            "" => number,
            symbol => format!("{number} {symbol}"),
        }
    }

    /// The number before the declared unit, to nine digits: these survive rounding.
    pub fn in_unit(&self, argument: f64) -> String {
        let number = argument / self.unit.scale;
        format!("{number:.8e}").parse::<f64>().unwrap_or(number).to_string()
    }

    /// Whether the curve covers an SI argument.
    pub fn reaches(&self, argument: f64) -> bool {
        let [low, high] = self.range_with_ends();
        low < argument && argument < high
    }
}

/// An argument of a curve that depends on inputs and design variables only.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveArgument {
    /// The curve.
    pub curve: Curve,
    /// Its argument, SI.
    pub argument: Expr,
}

/// Frames that points and joints can be fixed in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Frame {
    /// The inertial frame.
    Ground,
    /// The frame fixed in a body.
    Body(BodyId),
}

/// A rigid body.
#[derive(Clone, Debug)]
pub struct Body {
    /// Declared name.
    pub name: Ident,
    /// The pieces that make up its rigid mass; none if massless or a beam.
    pub parts: Vec<Part>,
}

/// One piece of a body's mass.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Whether the piece is a hole, cut out of the others.
    pub hole: bool,
    /// Its mass distribution in the frame of the piece.
    pub shape: Shape,
    /// Placement of that frame in the body frame.
    pub placement: Placement,
}

/// A fixed placement in a body frame: first the offset, then the rotations, each about the axes left by the previous
/// one.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// Origin.
    pub offset: Vector,
    /// Rotations in order: unit axis, angle in rad.
    pub rotations: Vec<(Vector, Expr)>,
}

/// A joint between two frames: a sequence of elementary motions takes its frame on the `from` side into its frame on
/// the `to` side.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Declared name.
    pub name: Ident,
    /// The keyword it was declared with, for example `universal`.
    pub word: &'static str,
    /// How it is written as equations if it closes a loop; `None` if it cannot be.
    pub closing: Option<Closing>,
    /// Elementary motions from the `from` side to the `to` side, each about or along an axis of the frame left by the
    /// previous ones; none for a fixed joint.
    pub steps: Vec<JointStep>,
    /// Inboard side as declared.
    pub from: Frame,
    /// Outboard side as declared.
    pub to: Frame,
    /// Joint frame in `from`.
    pub from_placement: Placement,
    /// Joint frame in `to`.
    pub to_placement: Placement,
    /// Whether it is declared as the joint that closes a loop: it has no coordinates, and its motions become equations.
    pub cut: bool,
    /// The beam between its sides, and the number of the station on the `to` side; `None` for all declared joints.
    pub flexure: Option<(BeamId, usize)>,
}

/// Joints that can be written as equations, by the motions they leave free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Closing {
    /// Nothing.
    Fixed,
    /// A turn.
    Revolute,
    /// A slide.
    Prismatic,
    /// A slide and a turn about one axis.
    Cylindrical,
    /// Turns about two axes.
    Universal,
    /// Slides in a plane, and a turn about its normal.
    Planar,
    /// All turns.
    Spherical,
}

/// An elementary motion.
#[derive(Clone, Debug, PartialEq)]
pub struct JointStep {
    /// Its kind.
    pub motion: StepMotion,
    /// Unit vector.
    pub axis: Vector,
    /// The amount of motion.
    pub coordinate: CoordinateId,
}

/// Kinds of elementary motion.
#[derive(Clone, Debug, PartialEq)]
pub enum StepMotion {
    /// Rotation about the axis; the coordinate is an angle.
    Turn,
    /// Translation along the axis; the coordinate is a displacement.
    Slide,
    /// Rotation about the axis and translation along it; the coordinate is the angle.
    Screw {
        /// Translation per radian, m.
        lead: Expr,
    },
}

/// A joint coordinate.
#[derive(Clone, Debug)]
pub struct Coordinate {
    /// Name: the joint's if it is the only one, otherwise its own.
    pub name: Ident,
    /// The joint it belongs to.
    pub joint: JointId,
    /// Angle or displacement.
    pub quantity: CoordinateQuantity,
    /// Free, driven or coasting.
    pub motion: Motion,
}

/// The quantity that a coordinate measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoordinateQuantity {
    /// An angle, rad.
    Angle,
    /// A displacement, m.
    Displacement,
}

impl CoordinateQuantity {
    /// The first of an angle, the second of a displacement.
    pub fn either<T>(self, angle: T, displacement: T) -> T {
        match self {
            Self::Angle => angle,
            Self::Displacement => displacement,
        }
    }
}

impl CoordinateQuantity {
    /// SI unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Angle => "rad",
            Self::Displacement => "m",
        }
    }
}

/// How a coordinate moves.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Found by the equations of motion.
    Free,
    /// Prescribed constant speed, rad/s or m/s: an expression of inputs and design variables.
    Driven(Expr),
    /// Constant speed that the equations of motion determine; nothing depends on the coordinate itself.
    Coasting,
}

impl Motion {
    /// Whether the coordinate keeps moving in steady motion: coasting, or driven and not held at zero.
    pub fn runs(&self) -> bool {
        match self {
            Motion::Free => false,
            Motion::Driven(speed) => *speed != Expr::Number(0.0),
            Motion::Coasting => true,
        }
    }
}

/// A named point, with axes, fixed in a frame.
#[derive(Clone, Debug)]
pub struct Point {
    /// Declared name.
    pub name: Ident,
    /// The frame it is fixed in.
    pub frame: Frame,
    /// Its position and the rotation of its axes in that frame.
    pub placement: Placement,
}

/// A force element.
#[derive(Clone, Debug)]
pub struct Force {
    /// Declared name.
    pub name: Ident,
    /// The law.
    pub law: ForceLaw,
    /// Whether it was declared for every coordinate: it does not keep its joint from being cut, and disappears if that
    /// happens.
    pub of_every: bool,
}

/// Force laws.
#[derive(Clone, Debug, PartialEq)]
pub enum ForceLaw {
    /// `-stiffness (q - rest)` on a coordinate.
    CoordinateSpring {
        /// The coordinate.
        coordinate: CoordinateId,
        /// N m/rad or N/m.
        stiffness: Expr,
        /// rad or m.
        rest: Expr,
    },
    /// `-damping qdot` on a coordinate.
    CoordinateDamper {
        /// The coordinate.
        coordinate: CoordinateId,
        /// N m s/rad or N s/m.
        damping: Expr,
    },
    /// `-inertance qddot` of each of two coordinates on the other, which are the same for the inertia of one.
    CoordinateInerter {
        /// The coordinates.
        coordinates: [CoordinateId; 2],
        /// kg m^2, kg, or kg m between a turn and a displacement.
        inertance: Expr,
    },
    /// Tension `stiffness (distance - length) + damping d(distance)/dt` between two points.
    SpringDamper {
        /// One end.
        from: PointId,
        /// The other end.
        to: PointId,
        /// N/m.
        stiffness: Expr,
        /// N s/m.
        damping: Expr,
        /// Free length, m.
        length: Expr,
    },
    /// Tension between two points by an expression of `Expr::Length` and `Expr::LengthRate`, N.
    Tension {
        /// One end.
        from: PointId,
        /// The other end.
        to: PointId,
        /// Positive when it pulls the ends together.
        tension: Expr,
    },
    /// A generalised force along a coordinate by an expression of coordinates, rates and points, N m or N.
    Generalized {
        /// The coordinate.
        coordinate: CoordinateId,
        /// Positive in the direction of the coordinate.
        value: Expr,
    },
    /// Forces from a potential energy, an expression of coordinates and points, J.
    Potential {
        /// The energy.
        energy: Expr,
    },
    /// Elastic connection between two frames, in the axes of `from`: force `-stiffness d - damping d'` and moment
    /// `-turning_stiffness r - turning_damping r'` on `to`, opposite on `from` at the place of `to`, where `d` is the
    /// displacement of `to` and `r` half the antisymmetric part of its rotation (the rotation vector while small).
    Bushing {
        /// One frame.
        from: PointId,
        /// The other.
        to: PointId,
        /// N/m, rows and columns along x, y, z.
        stiffness: Box<Matrix>,
        /// N s/m, rows and columns along x, y, z.
        damping: Box<Matrix>,
        /// N m/rad, rows and columns about x, y, z.
        turning_stiffness: Box<Matrix>,
        /// N m s/rad, rows and columns about x, y, z.
        turning_damping: Box<Matrix>,
    },
    /// A force and a moment on a body at a point.
    Load {
        /// The point of application.
        point: PointId,
        /// N.
        force: Vector,
        /// N m.
        moment: Vector,
        /// Whether the components are in the axes of the point and follow it; otherwise they are in the ground's axes.
        following: bool,
    },
    /// Forces per length along a beam.
    Distributed {
        /// The declared name of the beam.
        on: Ident,
        /// In the ground's axes, N/m.
        force: Vector,
        /// Along the axes of the sections, which it follows, N/m.
        follower: Vector,
        /// Resistance of a medium at rest, N s/m^2.
        damping: Expr,
    },
    /// Resistance of a medium at rest: force `-damping v` and moment `-turning_damping omega`, absolute velocities. The
    /// external, non-rotating damping of rotor dynamics.
    Drag {
        /// The point of application.
        point: PointId,
        /// N s/m.
        damping: Expr,
        /// N m s/rad.
        turning_damping: Expr,
    },
}

/// A declared output: an expression of coordinates, points, inputs and design variables at the equilibrium.
#[derive(Clone, Debug)]
pub struct Output {
    /// Declared name.
    pub name: Ident,
    /// Doc comments.
    pub docs: Vec<String>,
    /// SI unit of the value.
    pub unit: Unit,
    /// The value.
    pub value: Expr,
}
