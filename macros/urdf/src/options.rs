//! What a user may choose.

/// How a file becomes a declaration.
///
/// # Examples
/// ```
/// use eigentol_urdf::{Base, Options, Resistance};
///
/// let options = Options::default()
///     .base(Base::Floating)
///     .resistance(Resistance::KernelsOnly);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// How the root of the robot is held.
    pub base: Base,
    /// What resists the joints.
    pub resistance: Resistance,
    /// Joints have the viscous damping of the file (`dynamics`).
    pub damping: bool,
    /// An inertia that no body can have is replaced by the nearest possible one; otherwise it is a mistake.
    pub nearest_inertias: bool,
    /// Name of the mechanism; otherwise that of the robot in `CamelCase`.
    pub name: Option<String>,
}

/// How the root of a robot is held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Base {
    /// Welded to the ground.
    #[default]
    Fixed,
    /// Free in space: `base_px`, `base_py`, `base_pz` in m along the axes of the ground, and the angles `base_yaw` about z,
    /// `base_pitch` about y, `base_roll` about x in rad, in this order.
    Floating,
    /// Free in the horizontal plane: `base_px`, `base_py` in m, `base_yaw` in rad.
    Planar,
}

/// What resists the joints, so that the robot has an equilibrium and modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Resistance {
    /// A spring and a damper on every coordinate, at rest where the coordinate is zero.
    Springs {
        /// Of angles, N m/rad.
        stiffness: f64,
        /// Of angles, N m s/rad.
        damping: f64,
        /// Of displacements, N/m.
        linear_stiffness: f64,
        /// Of displacements, N s/m.
        linear_damping: f64,
    },
    /// Joints that nothing resists, not even gravity, are driven at 0; so are those that move no mass.
    Drives,
    /// Nothing: the declaration is for its kernels alone.
    KernelsOnly,
}

impl Default for Resistance {
    /// 50 N m/rad, 0.5 N m s/rad, 50 N/m, 0.5 N s/m.
    fn default() -> Self {
        Self::Springs {
            stiffness: 50.0,
            damping: 0.5,
            linear_stiffness: 50.0,
            linear_damping: 0.5,
        }
    }
}

impl Default for Options {
    /// A fixed base, springs, the dampers of the file, inertias as they are.
    fn default() -> Self {
        Self {
            base: Base::default(),
            resistance: Resistance::default(),
            damping: true,
            nearest_inertias: false,
            name: None,
        }
    }
}

impl Options {
    /// How the root is held.
    #[must_use]
    pub fn base(mut self, base: Base) -> Self {
        self.base = base;
        self
    }

    /// What resists the joints.
    #[must_use]
    pub fn resistance(mut self, resistance: Resistance) -> Self {
        self.resistance = resistance;
        self
    }

    /// Whether joints have the viscous damping of the file.
    #[must_use]
    pub fn damping(mut self, damping: bool) -> Self {
        self.damping = damping;
        self
    }

    /// Whether impossible inertias are replaced.
    #[must_use]
    pub fn nearest_inertias(mut self, replace: bool) -> Self {
        self.nearest_inertias = replace;
        self
    }

    /// The name of the mechanism.
    #[must_use]
    pub fn name(mut self, name: impl Into<String>) -> Self {
        self.name = Some(name.into());
        self
    }
}
