//! The result of `mechanics`: the functions to generate, and the properties established for them.

use crate::algebra::{Function, Graph};
use crate::base::ids::{CoordinateId, ExprId};

use super::picture::Picture;

/// The equations of a mechanism and everything derived from them, on one graph.
#[derive(Clone, Debug)]
pub struct Functions {
    /// The unknowns, in the order of `q`.
    pub unknowns: Vec<Unknown>,
    /// Holds every expression.
    pub graph: Graph,
    /// The kernels, in the order of the runtime's contract.
    pub functions: Vec<Function>,
    /// Physical requirements on inputs and design variables.
    pub requirements: Vec<Requirement>,
    /// Joints whose coordinates fail in some pose.
    pub poses: Vec<Pose>,
    /// What there is to see.
    pub picture: Picture,
    /// What holds for every design, input and position.
    pub properties: Properties,
    /// Coordinates that nothing resists, and the last of those that together move no mass: only where `kernels only` allows it.
    pub undetermined: Vec<CoordinateId>,
}

/// An unknown of the steady motion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unknown {
    /// Declared name; of a reaction the constraint's, with the component where it has several.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// What it is.
    pub role: Role,
}

/// What an unknown is: see the runtime's contract.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A free coordinate.
    Position(CoordinateId),
    /// The speed of a coasting coordinate.
    Speed(CoordinateId),
    /// The reaction of a constraint on positions.
    PositionReaction,
    /// The reaction of a constraint on velocities.
    VelocityReaction,
}

/// Bounds on what is generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Maximum number of entries, `3 n^2 (n + inputs + design)`, up to which the partial derivatives of the linearised matrices
    /// are written out. Larger mechanisms compute them column by column from directional derivatives, because the generated
    /// code would grow with the cube of their size.
    pub explicit_partials: usize,
    /// Maximum number of operations up to which the three matrices linearised along any motion are written out; a robot with 32
    /// joints takes 40,000. Above it they are differentiated one column at a time.
    pub motion_linear: usize,
}

impl Limits {
    /// Everything is written out.
    pub const NONE: Self = Self {
        explicit_partials: usize::MAX,
        motion_linear: usize::MAX,
    };
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            explicit_partials: 8192,
            motion_linear: 50_000,
        }
    }
}

/// A value that must be positive.
#[derive(Clone, Debug)]
pub struct Requirement {
    /// What it is, for example `mass of bar1`.
    pub quantity: String,
    /// What it has to be, in words.
    pub requirement: &'static str,
    /// The value.
    pub value: ExprId,
}

/// A joint of three turns. Where its axes lie in one plane, two of its coordinates describe the same motion.
#[derive(Clone, Debug)]
pub struct Pose {
    /// Name of the joint.
    pub joint: String,
    /// Volume spanned by the three unit axes, with either sign: zero in the singular pose, one when they are perpendicular.
    pub volume: ExprId,
}

/// What the compiler established: structurally, or at random states up to rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Properties {
    /// `Khat` is symmetric.
    pub symmetric_stiffness: bool,
    /// What `Chat` can be.
    pub damping: Damping,
}

/// What `Chat` can be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damping {
    /// Zero.
    Zero,
    /// Skew-symmetric.
    Gyroscopic,
    /// Anything else.
    General,
}
