//! The result of `mechanics`: the functions to generate, and the properties established for them.

use crate::algebra::{ExprId, Function, Graph};
use crate::base::ids::CoordinateId;
use crate::model::mechanism::Line;

use super::picture::Picture;

/// The equations of a mechanism and everything derived from them, on one graph.
#[derive(Clone, Debug)]
pub struct Functions {
    /// The unknowns, in the order of `q`.
    pub unknowns: Vec<Unknown>,
    /// The graph that holds every expression.
    pub graph: Graph,
    /// The kernels, in the order of the runtime's contract.
    pub functions: Vec<Function>,
    /// Physical requirements on inputs and design variables.
    pub requirements: Vec<Requirement>,
    /// Joints whose coordinates become singular in some pose.
    pub poses: Vec<Pose>,
    /// The visible parts of the mechanism.
    pub picture: Picture,
    /// Properties that hold for every design, input and position.
    pub properties: Properties,
    /// Coordinates that nothing resists, and the last coordinate of a motion that moves no mass; empty unless the
    /// declaration says `kernels only`.
    pub undetermined: Vec<CoordinateId>,
    /// The directions in which nothing determines where the mechanism stands.
    pub free: FreeDirections,
    /// Positions of the unknowns whose values select a steady motion, in the order of the kernel `held_values`.
    pub held: Vec<usize>,
    /// Spans of shafts.
    pub spans: Vec<SpanPlaces>,
    /// Rings of equal instances.
    pub rings: Vec<RingPlaces>,
    /// Multiples of the speed of the rings with which the unknowns vibrate in steady motion; the unknowns are the means of
    /// all coordinates, then for each of these the cosines and the sines.
    pub harmonics: Vec<usize>,
    /// The excitations in the order of the mechanism.
    pub excitations: Vec<Excitation>,
}

/// Where a ring of equal instances is among the unknowns and the design variables: one thing of all instances after the
/// other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RingPlaces {
    /// Declared name.
    pub name: String,
    /// How many instances there are.
    pub members: usize,
    /// Unknowns: the coordinates of the instances, or their patterns.
    pub coordinates: Vec<usize>,
    /// Whether the unknowns are patterns of all instances, seen from where the drive stands.
    pub patterns: bool,
    /// Design variables.
    pub design: Vec<usize>,
}

/// A span of a shaft: see the model.
#[derive(Clone, Debug, PartialEq)]
pub struct SpanPlaces {
    /// What it does.
    pub line: Line,
    /// Into how many elements each section is divided.
    pub elements: Vec<usize>,
    /// The unknowns of its two ends, each with the factor that makes it a motion of the span.
    pub ends: [Vec<(usize, f64)>; 2],
}

/// What the derivation found out about an excitation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excitation {
    /// Declared name.
    pub name: String,
    /// The word it was declared with.
    pub kind: &'static str,
    /// The first excitation with the same frequency, or its negative.
    pub with: usize,
    /// The frequency as a sum of speeds, as in `2 spin`; empty if it has a value of its own.
    pub order: String,
}

/// The directions in which nothing determines where a mechanism stands: it can be moved along them in every design.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FreeDirections {
    /// How many there are: null vectors of `Khat` at every equilibrium, apart from those of redundant constraints.
    pub count: usize,
    /// What can be said about them.
    pub notes: Vec<String>,
    /// Where there is no equilibrium, because nothing balances the loads along them.
    pub unbalanced: Option<String>,
}

/// An unknown of the steady motion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unknown {
    /// Declared name; for a reaction the name of the constraint, with the component if it has several.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// The kind of unknown.
    pub role: Role,
}

/// The kind of an unknown: see the runtime's contract.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A free coordinate.
    Position(CoordinateId),
    /// The amplitude of a harmonic of a free coordinate.
    Harmonic(CoordinateId),
    /// The speed of a coasting coordinate.
    Speed(CoordinateId),
    /// The reaction of a constraint on positions.
    PositionReaction,
    /// The reaction of a constraint on velocities.
    VelocityReaction,
}

/// Limits on the size of the generated code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Maximum number of entries, `3 n^2 (n + inputs + design)`, up to which the partial derivatives of the linearised
    /// matrices are written out. Larger mechanisms compute them column by column from directional derivatives, because
    /// the generated code would grow with the cube of their size.
    pub explicit_partials: usize,
    /// Maximum number of operations of these, for the same reason: a beam with ten coordinates in space takes 160,000, a
    /// chain of 16 bodies 16,000.
    pub partial_operations: usize,
    /// Maximum number of operations up to which the three matrices linearised along any motion are written out; a robot
    /// with 32 joints takes 40,000. Above this limit they are differentiated one column at a time.
    pub motion_linear: usize,
}

impl Limits {
    /// No limit: everything is written out.
    pub const NONE: Self =
        Self { explicit_partials: usize::MAX, partial_operations: usize::MAX, motion_linear: usize::MAX };
}

impl Default for Limits {
    fn default() -> Self {
        Self { explicit_partials: 8192, partial_operations: 30_000, motion_linear: 50_000 }
    }
}

/// A value that must be positive.
#[derive(Clone, Debug)]
pub struct Requirement {
    /// The quantity, for example `mass of bar1`.
    pub quantity: String,
    /// The requirement in words.
    pub requirement: &'static str,
    /// The value.
    pub value: ExprId,
}

/// A joint with three turns, or a section of a beam that turns about more than one axis. Where the axes of the joint lie
/// in one plane, two of its coordinates describe the same motion.
#[derive(Clone, Debug)]
pub struct Pose {
    /// Name of the joint or the beam.
    pub joint: String,
    /// Zero in the singular pose. Of a joint, the signed volume spanned by its three unit axes: one in magnitude when
    /// they are perpendicular; of a section, the squared cosine of half the angle by which it has turned.
    pub margin: ExprId,
    /// The margin below which there is no result.
    pub least: f64,
}

/// Properties established by the compiler: structurally, or up to rounding at random states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Properties {
    /// `Khat` is symmetric.
    pub symmetric_stiffness: bool,
    /// The form of `Chat`.
    pub damping: Damping,
}

impl Properties {
    /// Nothing is known: shafts damp and turn what the equations of a mechanism do not show.
    pub const GENERAL: Self = Self { symmetric_stiffness: false, damping: Damping::General };
}

/// The form of `Chat`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damping {
    /// Zero.
    Zero,
    /// Skew-symmetric.
    Gyroscopic,
    /// Anything else.
    General,
}
