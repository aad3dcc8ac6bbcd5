//! A mechanism as plain data: an open tree of bodies whose values are numbers or multiples of design variables.
//!
//! All values are SI. The meaning of every field is that of the language; see [`crate::declaration`] for its spelling.

/// A scalar value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// `factor * variable`, the variable by its index in [`Model::design`].
    Design {
        /// Index of the design variable.
        variable: usize,
        /// Pure number.
        factor: f64,
    },
}

/// Three values.
pub type Values = [Value; 3];

/// The value 0.
pub const ZERO: Value = Value::Number(0.0);

/// The vector 0.
pub const ORIGIN: Values = [ZERO; 3];

/// The unit of a declared value. A value in SI needs no scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Mass.
    Kilogram,
    /// Length or displacement.
    Metre,
    /// Angle.
    Radian,
    /// Moment of inertia.
    KilogramSquareMetre,
    /// Stiffness of a displacement.
    NewtonPerMetre,
    /// Stiffness of an angle.
    NewtonMetrePerRadian,
    /// Damping of a displacement.
    NewtonSecondPerMetre,
    /// Damping of an angle.
    NewtonMetreSecondPerRadian,
    /// Acceleration.
    MetrePerSquareSecond,
    /// Speed of a displacement.
    MetrePerSecond,
    /// Speed of an angle.
    RadianPerSecond,
}

/// An operating parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Declared name.
    pub name: String,
    /// Declared unit.
    pub unit: Unit,
}

/// A design variable.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignVariable {
    /// Declared name.
    pub name: String,
    /// Unit of the nominal value.
    pub unit: Unit,
    /// Nominal value.
    pub nominal: f64,
}

/// What a frame can be fixed in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// The inertial frame.
    Ground,
    /// A body, by its index in [`Model::bodies`].
    Body(usize),
}

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Declared name.
    pub name: String,
    /// Mass distribution.
    pub shape: Shape,
}

/// Mass distribution in the body frame. Directions need not be unit vectors.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// No mass.
    Massless,
    /// A point mass.
    Point {
        /// Mass.
        mass: Value,
        /// Position.
        center: Values,
    },
    /// A uniform slender bar.
    Rod {
        /// Mass.
        mass: Value,
        /// Length.
        length: Value,
        /// Direction.
        along: [f64; 3],
        /// Centre of mass; half the length along the bar when `None`.
        center: Option<Values>,
    },
    /// A uniform thin disk.
    Disk {
        /// Mass.
        mass: Value,
        /// Radius.
        radius: Value,
        /// Direction of its axis.
        axis: [f64; 3],
        /// Centre of mass.
        center: Values,
    },
    /// A uniform solid cylinder.
    Cylinder {
        /// Mass.
        mass: Value,
        /// Radius.
        radius: Value,
        /// Length.
        length: Value,
        /// Direction of its axis.
        axis: [f64; 3],
        /// Centre of mass.
        center: Values,
    },
    /// A uniform solid box with edges along the body axes.
    Cuboid {
        /// Mass.
        mass: Value,
        /// Edge lengths.
        size: Values,
        /// Centre of mass.
        center: Values,
    },
    /// A uniform solid sphere.
    Sphere {
        /// Mass.
        mass: Value,
        /// Radius.
        radius: Value,
        /// Centre of mass.
        center: Values,
    },
    /// Any rigid body.
    Rigid {
        /// Mass.
        mass: Value,
        /// Centre of mass.
        center: Values,
        /// Inertia tensor about the centre of mass: xx, yy, zz, xy, yz, xz.
        inertia: [Value; 6],
    },
}

/// A fixed placement: the offset first, then rotations (axis, angle), each about the axes left by the one before.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// Origin.
    pub offset: Values,
    /// Rotations in order; axes need not be unit vectors.
    pub rotations: Vec<([f64; 3], Value)>,
}

impl Placement {
    /// No displacement at all.
    pub const NONE: Self = Self {
        offset: ORIGIN,
        rotations: Vec::new(),
    };

    /// An offset without rotation.
    pub fn at(offset: Values) -> Self {
        Self {
            offset,
            rotations: Vec::new(),
        }
    }
}

/// Kinds of joint. Axes need not be unit vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointKind {
    /// No relative motion.
    Fixed,
    /// Rotation about an axis of the joint frame.
    Revolute([f64; 3]),
    /// Translation along an axis of the joint frame.
    Prismatic([f64; 3]),
}

/// A prescribed constant speed `factor * input`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Index of the input.
    pub input: usize,
    /// Pure number.
    pub factor: f64,
}

/// A joint: its frame in `from` turns or slides about the axis into its frame in `to`.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Declared name, also that of its coordinate.
    pub name: String,
    /// Kind and axis.
    pub kind: JointKind,
    /// One side; not necessarily the one nearer to the ground.
    pub from: Frame,
    /// The other side.
    pub to: Frame,
    /// Joint frame in `from`.
    pub from_placement: Placement,
    /// Joint frame in `to`.
    pub to_placement: Placement,
    /// How it is driven, if it is.
    pub drive: Option<Drive>,
}

/// A named point fixed in a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Declared name.
    pub name: String,
    /// The frame.
    pub frame: Frame,
    /// Its position there.
    pub position: Values,
}

/// A named force element.
#[derive(Clone, Debug, PartialEq)]
pub struct Force {
    /// Declared name.
    pub name: String,
    /// The law.
    pub law: ForceLaw,
}

/// Force laws.
#[derive(Clone, Debug, PartialEq)]
pub enum ForceLaw {
    /// `-stiffness (q - rest)` on the coordinate of a joint.
    Spring {
        /// Index of the joint.
        joint: usize,
        /// Stiffness.
        stiffness: Value,
        /// Coordinate without force.
        rest: Value,
    },
    /// `-damping qdot` on the coordinate of a joint.
    Damper {
        /// Index of the joint.
        joint: usize,
        /// Damping.
        damping: Value,
    },
    /// Tension `stiffness (distance - length) + damping d(distance)/dt` between two points.
    SpringDamper {
        /// Index of one point.
        from: usize,
        /// Index of the other point.
        to: usize,
        /// Stiffness.
        stiffness: Value,
        /// Damping.
        damping: Value,
        /// Free length.
        length: Value,
    },
}

/// A mechanism: an open tree of bodies rooted in the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Name of the declaration.
    pub name: String,
    /// Operating parameters.
    pub inputs: Vec<Input>,
    /// Design variables.
    pub design: Vec<DesignVariable>,
    /// Acceleration of gravity.
    pub gravity: Values,
    /// Bodies.
    pub bodies: Vec<Body>,
    /// Joints, one per body, in any order.
    pub joints: Vec<Joint>,
    /// Points.
    pub points: Vec<Point>,
    /// Force elements.
    pub forces: Vec<Force>,
}

/// How a body hangs on the frame nearer to the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Branch {
    /// The body.
    pub body: usize,
    /// Its parent.
    pub parent: Frame,
    /// The joint between them.
    pub joint: usize,
    /// The joint is declared from the body to its parent.
    pub reversed: bool,
}

impl Model {
    /// The bodies from the ground outwards, parents before children.
    ///
    /// # Panics
    /// When the joints do not make a tree.
    pub fn tree(&self) -> Vec<Branch> {
        let mut branches: Vec<Branch> = Vec::new();
        let mut used = vec![false; self.joints.len()];
        while branches.len() < self.bodies.len() {
            let reached = |frame: Frame, branches: &[Branch]| {
                frame == Frame::Ground || branches.iter().any(|b| Frame::Body(b.body) == frame)
            };
            let found = self
                .joints
                .iter()
                .enumerate()
                .find_map(|(joint, declared)| {
                    if used[joint] {
                        return None;
                    }
                    match (declared.from, declared.to) {
                        (parent, Frame::Body(body)) if reached(parent, &branches) => Some(Branch {
                            body,
                            parent,
                            joint,
                            reversed: false,
                        }),
                        (Frame::Body(body), parent) if reached(parent, &branches) => Some(Branch {
                            body,
                            parent,
                            joint,
                            reversed: true,
                        }),
                        _ => None,
                    }
                });
            let branch = found.expect("every body has a path to the ground");
            assert!(
                !reached(Frame::Body(branch.body), &branches),
                "the joints close no loop"
            );
            used[branch.joint] = true;
            branches.push(branch);
        }
        assert!(used.iter().all(|used| *used), "the joints close no loop");
        branches
    }

    /// The joints with a free coordinate, in order of declaration: the order of `q`.
    pub fn free(&self) -> Vec<usize> {
        self.moving(|joint| joint.drive.is_none())
    }

    /// The joints with a driven coordinate, in order of declaration.
    pub fn driven(&self) -> Vec<usize> {
        self.moving(|joint| joint.drive.is_some())
    }

    /// Nominal values of the design variables.
    pub fn nominal(&self) -> Vec<f64> {
        self.design
            .iter()
            .map(|variable| variable.nominal)
            .collect()
    }

    fn moving(&self, wanted: impl Fn(&Joint) -> bool) -> Vec<usize> {
        let moves = |joint: &Joint| joint.kind != JointKind::Fixed && wanted(joint);
        (0..self.joints.len())
            .filter(|&index| moves(&self.joints[index]))
            .collect()
    }
}
