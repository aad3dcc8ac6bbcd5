//! Description of a mechanism: names, units, properties proved by the compiler, and costs of its kernels.

#[cfg(feature = "std")]
use super::shared::Shared;
use super::shared::{List, Text};
use super::tolerance::ToleranceInfo;

/// The parts of a mechanism, and what the compiler proved about it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Description {
    /// Name of the declared type.
    pub name: Text,
    /// Unknowns, in the order of `q`: the free coordinates, followed by speeds and reactions, if any.
    pub coordinates: List<CoordinateInfo>,
    /// Inputs, in the order of `u`.
    pub inputs: List<InputInfo>,
    /// Design variables, in the order of `b`.
    pub design: List<DesignInfo>,
    /// Outputs, in the order of [`Mechanism::outputs`](crate::Mechanism::outputs).
    pub outputs: List<OutputInfo>,
    /// Harmonic excitations, in the order of [`Mechanism::forcing`](crate::Mechanism::forcing).
    #[cfg_attr(feature = "serde", serde(default = "no_excitations"))]
    pub excitations: List<ExcitationInfo>,
    /// `Khat` is symmetric for every design, input and position.
    pub symmetric_stiffness: bool,
    /// Number of directions in which nothing determines where the mechanism stands: null vectors of `Khat` that exist at
    /// every equilibrium of every design, apart from those of redundant constraints. A train of gears that nothing holds
    /// has one, a free body in space six. An equilibrium may be moved along them.
    #[cfg_attr(feature = "serde", serde(default))]
    pub free_directions: usize,
    /// Positions of the unknowns that the declaration gives a value in the steady motion, in the order of
    /// [`Mechanism::held_values`](crate::Mechanism::held_values).
    #[cfg_attr(feature = "serde", serde(default = "none"))]
    pub held: List<usize>,
    /// A length typical of the mechanism, m: the geometric mean of the shortest and the longest that are declared, one
    /// metre if there are none.
    #[cfg_attr(feature = "serde", serde(default = "one_metre"))]
    pub length: f64,
    /// The unit of frequencies in texts and figures: Hz where an input is in rpm or Hz, rad/s otherwise. Data are in rad/s.
    #[cfg_attr(feature = "serde", serde(default = "radians_per_second"))]
    pub frequency: Unit,
    /// How many of the first modes the coordinates of its beams resolve, by the rule that `m` modes of a plane of bending
    /// take `1.5 m + 2` coordinates; `None` without beams.
    #[cfg_attr(feature = "serde", serde(default))]
    pub resolved_modes: Option<usize>,
    /// The kind of `Chat`.
    pub damping: DampingKind,
    /// Design variables that the declaration correlates.
    #[cfg_attr(feature = "serde", serde(default = "none"))]
    pub correlations: List<CorrelationInfo>,
    /// Equal instances around axes.
    #[cfg_attr(feature = "serde", serde(default = "none"))]
    pub rings: List<RingInfo>,
    /// Spans of shafts, whose numbers are those of [`Mechanism::spans`](crate::Mechanism::spans).
    #[cfg_attr(feature = "serde", serde(default = "none"))]
    pub spans: List<SpanInfo>,
    /// Multiples of the speed of the rings with which the mechanism vibrates in steady motion. The unknowns are then the
    /// means of all coordinates, followed, for each of these multiples, by the amplitudes of the cosines and of the sines.
    #[cfg_attr(feature = "serde", serde(default = "none"))]
    pub harmonics: List<usize>,
    /// The generated functions and their costs.
    pub kernels: List<KernelInfo>,
}

impl Description {
    /// The cost of a generated function; `None` if the compiler did not generate one of this name.
    #[must_use]
    pub fn kernel(&self, name: &str) -> Option<&KernelInfo> {
        self.kernels.iter().find(|kernel| kernel.name == *name)
    }

    /// [`Self::kernel`] of a constant description, evaluated at compile time where possible.
    #[cfg(feature = "std")]
    #[doc(hidden)]
    pub const fn static_kernel(&self, name: &str) -> Option<&KernelInfo> {
        let Shared::Static(kernels) = &self.kernels else {
            return None;
        };
        let mut k = 0;
        while k < kernels.len() {
            if let Shared::Static(kernel_name) = &kernels[k].name
                && same(kernel_name.as_bytes(), name.as_bytes())
            {
                return Some(&kernels[k]);
            }
            k += 1;
        }
        None
    }

    /// A change of a coordinate that counts as large, SI: the typical length, or a radian. For speeds and reactions, one
    /// SI unit.
    #[cfg(feature = "std")]
    #[doc(hidden)]
    pub fn large(&self, unknown: usize) -> f64 {
        match self.coordinates.get(unknown) {
            Some(info) if info.role == Role::Position && *info.unit.symbol == *"m" => self.length,
            _ => 1.0,
        }
    }

    /// The name of a coordinate, speed or reaction.
    #[cfg(feature = "std")]
    #[doc(hidden)]
    pub fn unknown_name(&self, index: usize) -> Text {
        self.coordinates.get(index).map_or(Text::Static("?"), |info| info.name.clone())
    }
}

#[cfg(feature = "serde")]
const fn none<T>() -> List<T> {
    List::Static(&[])
}

#[cfg(feature = "serde")]
const fn no_excitations() -> List<ExcitationInfo> {
    List::Static(&[])
}

#[cfg(feature = "serde")]
const fn one_metre() -> f64 {
    1.0
}

#[cfg(feature = "serde")]
const fn radians_per_second() -> Unit {
    Unit::si("rad/s")
}

#[cfg(feature = "std")]
const fn same(a: &[u8], b: &[u8]) -> bool {
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    i == a.len() && i == b.len()
}

/// What the compiler proved about `Chat`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum DampingKind {
    /// Zero for every design, input and position.
    Zero,
    /// Skew-symmetric: gyroscopic coupling without dissipation.
    Gyroscopic,
    /// Anything else.
    General,
}

/// A unit of measure: a value in SI is the value in this unit times `scale`.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Unit {
    /// As declared, for example `mm` or `N*m/rad`; empty for a dimensionless number.
    pub symbol: Text,
    /// SI value of one unit.
    pub scale: f64,
}

impl Unit {
    /// A unit of the SI, or none: `Unit::si("rad/s")`, `Unit::si("")`.
    #[must_use]
    pub const fn si(symbol: &'static str) -> Self {
        Self { symbol: Text::Static(symbol), scale: 1.0 }
    }

    /// Converts a value from this unit to SI.
    #[must_use]
    pub fn to_si(&self, value: f64) -> f64 {
        value * self.scale
    }

    /// Converts a value from SI to this unit.
    #[must_use]
    pub fn from_si(&self, value: f64) -> f64 {
        value / self.scale
    }
}

/// An unknown of the steady motion.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CoordinateInfo {
    /// Declared name. A reaction has the name of its constraint, with the component if there are several: `pin.x`.
    pub name: Text,
    /// `rad` or `m` for a coordinate, `rad/s` or `m/s` for a speed, `N` or `N*m` for a reaction.
    pub unit: Unit,
    /// Its role.
    pub role: Role,
}

/// The kind of an unknown, and of the equation at the same position of the residual.
///
/// The unknowns are in this order: coordinates, speeds, reactions of constraints on positions, reactions of constraints
/// on velocities. With the coordinates `q`, the speeds `v` and the reactions `mu`, the residual is
///
/// ```text
/// g(qddot, vdot, qdot, q, v) + Phi_q^T mu_1 + A_q^T mu_2     by coordinate
/// g_v(qddot, vdot, qdot, q, v) + A_v^T mu_2                  by speed
/// Phi(q)                                                     by constraint on positions
/// A_q(q) qdot + A_v(q) v + a(q)                              by constraint on velocities
/// ```
///
/// so that constraints exert `-Phi_q^T mu_1` and `-A_q^T mu_2` on the coordinates. The sign of a constraint equation is
/// chosen so that its reaction is what the `from` side exerts on the `to` side:
///
/// - for a displacement of `to` from `from`, `Phi` is the negative displacement;
/// - for a distance, `Phi` is the excess, so that the reaction is a tension;
/// - for a coupling or an equation, `Phi` is the negative of the expression that is to be zero, so that the reaction
///   acts in the direction in which that expression grows.
///
/// A reaction in outputs is the same number or, for a constraint with several equations, the force or moment that these
/// add up to.
///
/// In the arguments `velocity` and `acceleration` of [`Mechanism::motion_residual`](crate::Mechanism::motion_residual),
/// the position of a speed `v` holds `vdot` in `velocity` and is unused in `acceleration`; that of a reaction is unused
/// in both. `Mhat`, `Chat`, `Khat` are therefore the derivatives of the whole residual with respect to the second,
/// first and zeroth time derivative of all unknowns. Without speeds and constraints on velocities
/// `Khat = [[K_c, Phi_q^T], [Phi_q, 0]]`, `K_c = d(g + Phi_q^T mu)/dq`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Role {
    /// A coordinate that is constant in steady motion; the equation is its equation of motion.
    Position,
    /// The speed of a coordinate that runs at a constant rate and on which nothing depends; the equation is its
    /// equation of motion.
    Speed,
    /// The multiplier of a constraint `Phi(q) = 0` on positions; the equation is the constraint.
    PositionReaction,
    /// The multiplier of a constraint on velocities (rolling, or a coupling of running coordinates); the equation is
    /// the constraint.
    VelocityReaction,
}

/// An input: an operating parameter chosen at run time.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct InputInfo {
    /// Declared name.
    pub name: Text,
    /// Declared unit; kernels take SI.
    pub unit: Unit,
    /// The declared tolerance.
    pub tolerance: ToleranceInfo,
}

/// A design variable.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DesignInfo {
    /// Declared name.
    pub name: Text,
    /// Declared unit; kernels take SI.
    pub unit: Unit,
    /// Nominal value, SI.
    pub nominal: f64,
    /// The declared tolerance.
    pub tolerance: ToleranceInfo,
}

/// A declared output.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OutputInfo {
    /// Declared name.
    pub name: Text,
    /// Declared unit, or the SI unit of the value; kernels give SI.
    pub unit: Unit,
}

/// A harmonic excitation.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ExcitationInfo {
    /// Declared name.
    pub name: Text,
    /// The word it was declared with: `unbalance`, `harmonic` or `shaken`.
    pub kind: Text,
    /// Number of the first excitation with the same frequency, or its negative, in every design: these act together.
    pub with: usize,
    /// The frequency in terms of the speeds of running coordinates, as in `1 spin`; empty for a frequency of its own.
    pub order: Text,
}

/// Two design variables that the declaration correlates.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CorrelationInfo {
    /// Their indices.
    pub variables: [usize; 2],
    /// The linear correlation, between -1 and 1.
    pub correlation: f64,
}

/// Equal instances around an axis.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RingInfo {
    /// Declared name, without index.
    pub name: Text,
    /// How many instances there are.
    pub members: usize,
    /// Positions of its unknowns: of one coordinate after the other, those of all instances, or its patterns
    /// (`patterns`).
    pub coordinates: List<usize>,
    /// Whether the unknowns are multiblade coordinates, seen from what does not turn. With instance `i` of `N` at
    /// `psi_i`, its coordinate is `a_0 + sum_n (c_n cos n psi_i + s_n sin n psi_i) + d (-1)^i`; the unknowns are `a_0`,
    /// `c_1`, `s_1`, `c_2`, .., and for even `N` `d`.
    pub patterns: bool,
    /// Positions of the design variables of the instances: of one after the other, those of all instances.
    pub design: List<usize>,
}

/// The cost of one generated function.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct KernelInfo {
    /// Method name.
    pub name: Text,
    /// Additions, subtractions and multiplications.
    pub operations: usize,
    /// Divisions, roots and elementary functions.
    pub functions: usize,
}

/// A part of a shaft between two stations. Linear in small motions, it is not in the equations that are compiled, but for what
/// it does at rest.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SpanInfo {
    /// What it does.
    pub line: LineKind,
    /// Into how many equal elements each of its sections is divided.
    pub elements: List<usize>,
    /// Unknowns of its two ends, each with the factor that makes it a motion of the span: along `y`, slope towards it, along
    /// `z`, slope; of a bar one.
    pub ends: [List<(usize, f64)>; 2],
}

/// What a part of a shaft does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum LineKind {
    /// It bends and shears (Timoshenko).
    Timoshenko,
    /// It bends without shear (Rayleigh).
    Slender,
    /// It twists or stretches.
    Bar,
}

impl SpanInfo {
    /// The numbers of a section.
    pub const NUMBERS: usize = 8;

    /// How many numbers it has in [`Mechanism::spans`](crate::Mechanism::spans).
    #[must_use]
    pub fn count(&self) -> usize {
        1 + Self::NUMBERS * self.elements.len()
    }
}
