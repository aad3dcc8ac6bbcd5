//! Options of an import.

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
    /// Resistance of the joints.
    pub resistance: Resistance,
    /// Whether joints get the viscous damping of the file (`dynamics`).
    pub damping: bool,
    /// Whether an inertia that no body can have is replaced by the nearest possible one; otherwise it is a mistake.
    pub nearest_inertias: bool,
    /// Name of the mechanism; by default, the robot's name in `CamelCase`.
    pub name: Option<String>,
}

/// How the root of a robot is held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Base {
    /// Welded to the ground.
    #[default]
    Fixed,
    /// Free in space: `base_px`, `base_py`, `base_pz` in m along the axes of the ground, and the angles `base_yaw`
    /// about z, `base_pitch` about y, `base_roll` about x in rad, in this order.
    Floating,
    /// Free in the horizontal plane: `base_px`, `base_py` in m, `base_yaw` in rad.
    Planar,
}

/// Resistance of the joints, so that the robot has an equilibrium and modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Resistance {
    /// A spring and a damper on every coordinate, relaxed where it is zero; joints that move no mass are driven at 0
    /// instead.
    Springs {
        /// For angles, N m/rad.
        stiffness: f64,
        /// For angles, N m s/rad.
        damping: f64,
        /// For displacements, N/m.
        linear_stiffness: f64,
        /// For displacements, N s/m.
        linear_damping: f64,
    },
    /// What the file says, and nothing else.
    File,
    /// Joints that nothing resists, not even gravity, are driven at 0; so are those that move no mass. Of a MuJoCo file the same as `File`.
    Drives,
    /// No resistance: the declaration is only for its kernels.
    KernelsOnly,
}

impl Default for Resistance {
    /// Defaults: 50 N m/rad, 0.5 N m s/rad, 50 N/m, 0.5 N s/m.
    fn default() -> Self {
        Self::Springs { stiffness: 50.0, damping: 0.5, linear_stiffness: 50.0, linear_damping: 0.5 }
    }
}

impl Default for Options {
    /// Defaults: a fixed base, springs, the dampers of the file, and unchanged inertias.
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
    /// Sets how the root is held.
    #[must_use]
    pub fn base(mut self, base: Base) -> Self {
        self.base = base;
        self
    }

    /// Sets the resistance of the joints.
    #[must_use]
    pub fn resistance(mut self, resistance: Resistance) -> Self {
        self.resistance = resistance;
        self
    }

    /// Sets whether joints get the viscous damping of the file.
    #[must_use]
    pub fn damping(mut self, damping: bool) -> Self {
        self.damping = damping;
        self
    }

    /// Sets whether impossible inertias are replaced.
    #[must_use]
    pub fn nearest_inertias(mut self, replace: bool) -> Self {
        self.nearest_inertias = replace;
        self
    }

    /// Sets the name of the mechanism.
    #[must_use]
    pub fn name(mut self, name: impl Into<String>) -> Self {
        self.name = Some(name.into());
        self
    }
}
