//! What a mechanism is made of: names, units, what the compiler proved, what its kernels cost.

/// What a mechanism is made of, and what the compiler proved about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Description {
    /// Name of the declared type.
    pub name: &'static str,
    /// Unknowns, in the order of `q`: the free coordinates and, where there are any, speeds and reactions.
    pub coordinates: &'static [CoordinateInfo],
    /// Inputs, in the order of `u`.
    pub inputs: &'static [InputInfo],
    /// Design variables, in the order of `b`.
    pub design: &'static [DesignInfo],
    /// Outputs, in the order of [`Mechanism::outputs`](crate::Mechanism::outputs).
    pub outputs: &'static [OutputInfo],
    /// `Khat` is symmetric for every design, input and position.
    pub symmetric_stiffness: bool,
    /// What `Chat` can be.
    pub damping: DampingKind,
    /// The generated functions and their cost.
    pub kernels: &'static [KernelInfo],
}

#[cfg(any(feature = "std", feature = "libm"))]
impl Description {
    /// The cost of a generated function; `None` where the compiler wrote none of this name.
    pub(crate) const fn kernel(&self, name: &str) -> Option<&KernelInfo> {
        let mut k = 0;
        while k < self.kernels.len() {
            if same(self.kernels[k].name.as_bytes(), name.as_bytes()) {
                return Some(&self.kernels[k]);
            }
            k += 1;
        }
        None
    }
}

#[cfg(any(feature = "std", feature = "libm"))]
const fn same(a: &[u8], b: &[u8]) -> bool {
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    i == a.len() && i == b.len()
}

/// What the compiler proved about `Chat`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DampingKind {
    /// Zero for every design, input and position.
    Zero,
    /// Skew-symmetric: gyroscopic coupling without dissipation.
    Gyroscopic,
    /// Anything else.
    General,
}

/// A unit of measure: a value in SI is the value in this unit times `scale`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// As declared, for example `mm` or `N*m/rad`; empty for a pure number.
    pub symbol: &'static str,
    /// SI value of one unit.
    pub scale: f64,
}

/// An unknown of the steady motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoordinateInfo {
    /// Declared name; of a reaction the constraint's, with the component where it has several: `pin.x`.
    pub name: &'static str,
    /// Of a coordinate `rad` or `m`, of a speed `rad/s` or `m/s`, of a reaction `N` or `N*m`.
    pub unit: Unit,
    /// What it is.
    pub role: Role,
}

/// What an unknown is, and with it the equation in the same place of the residual.
///
/// The unknowns stand in this order: coordinates, speeds, reactions of constraints on positions, reactions of
/// constraints on velocities. With `q` the coordinates, `v` the speeds, `mu` the reactions the residual is
///
/// ```text
/// g(qddot, vdot, qdot, q, v) + Phi_q^T mu_1 + A_q^T mu_2     by coordinate
/// g_v(qddot, vdot, qdot, q, v) + A_v^T mu_2                  by speed
/// Phi(q)                                                     by constraint on positions
/// A_q(q) qdot + A_v(q) v + a(q)                              by constraint on velocities
/// ```
///
/// so that constraints exert `-Phi_q^T mu_1` and `-A_q^T mu_2` on the coordinates. Their equations have the sign that makes a
/// reaction what the `from` side exerts on the `to` side: `Phi` of a displacement of `to` from `from` is its negative, that of a
/// distance its excess, so that the reaction is a tension, that of a coupling or an equation the negative of what is to be
/// zero, so that the reaction acts in the direction in which that grows. What outputs call a reaction is the same number, or, of
/// a constraint with several equations, the force or moment that these sum up to.
///
/// In the arguments `velocity` and `acceleration` of [`Mechanism::motion_residual`](crate::Mechanism::motion_residual) the place of a speed `v` holds `vdot`
/// and nothing, that of a reaction nothing; so `Mhat`, `Chat`, `Khat` are the derivatives of the whole by the second, first
/// and no time derivative of all unknowns. Without speeds and constraints on velocities
/// `Khat = [[K_c, Phi_q^T], [Phi_q, 0]]`, `K_c = d(g + Phi_q^T mu)/dq`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A coordinate that rests in steady motion; the equation is that of its motion.
    Position,
    /// The speed of a coordinate that runs at a constant rate, on which nothing depends; the equation is that of its motion.
    Speed,
    /// The multiplier of a constraint `Phi(q) = 0` on positions, which is the equation.
    PositionReaction,
    /// The multiplier of a constraint on velocities, which is the equation: rolling, or the coupling of running coordinates.
    VelocityReaction,
}

/// An input: an operating parameter chosen at run time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InputInfo {
    /// Declared name.
    pub name: &'static str,
    /// Declared unit; kernels take SI.
    pub unit: Unit,
}

/// A design variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesignInfo {
    /// Declared name.
    pub name: &'static str,
    /// Declared unit; kernels take SI.
    pub unit: Unit,
    /// Nominal value, SI.
    pub nominal: f64,
    /// Half-width of the declared tolerance, SI; zero when none is declared.
    pub tolerance: f64,
}

/// A declared output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutputInfo {
    /// Declared name.
    pub name: &'static str,
    /// SI unit of the value.
    pub unit: Unit,
}

/// The cost of one generated function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KernelInfo {
    /// Method name.
    pub name: &'static str,
    /// Additions, subtractions and multiplications.
    pub operations: usize,
    /// Divisions, roots and elementary functions.
    pub functions: usize,
}

/// Index of a free coordinate of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Coordinate(pub usize);

/// Index of an input of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Input(pub usize);

/// Index of a design variable of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct DesignVariable(pub usize);

/// Index of an output of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Output(pub usize);
