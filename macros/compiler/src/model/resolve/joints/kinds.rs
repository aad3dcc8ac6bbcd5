//! The kinds of joint: one row each, nothing else knows their names.

use crate::model::mechanism::{Closing, CoordinateQuantity};

/// A kind of joint.
#[derive(Debug)]
pub(crate) struct Kind {
    /// The word it is declared with.
    pub(crate) word: &'static str,
    /// Its elementary motions, in order from the `from` side; each has a coordinate.
    pub(crate) motions: &'static [Elementary],
    /// What its axes must satisfy.
    pub(crate) conditions: &'static [Condition],
    /// How it closes a loop; not every kind can.
    pub(crate) closing: Option<Closing>,
    /// What to write, for messages.
    pub(crate) example: &'static str,
}

/// An elementary motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Elementary {
    Turn,
    Slide,
    Screw,
}

/// A relation between the axes of motions, by their places in the order.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Condition {
    /// The same line: what the name of the joint promises.
    Parallel(usize, usize),
    /// A right angle: what the name of the joint promises.
    Perpendicular(usize, usize),
    /// Not parallel: else two coordinates measure one motion.
    Distinct([usize; 2]),
    /// Not in one plane: else three coordinates measure two motions.
    Spanning([usize; 3]),
}

use Condition::{Distinct, Parallel, Perpendicular, Spanning};
use Elementary::{Screw, Slide, Turn};

const KINDS: &[Kind] = &[
    Kind {
        word: "fixed",
        motions: &[],
        conditions: &[],
        closing: Some(Closing::Fixed),
        example: "fixed",
    },
    Kind {
        word: "revolute",
        motions: &[Turn],
        conditions: &[],
        closing: Some(Closing::Revolute),
        example: "revolute(z)",
    },
    Kind {
        word: "prismatic",
        motions: &[Slide],
        conditions: &[],
        closing: Some(Closing::Prismatic),
        example: "prismatic(z)",
    },
    Kind {
        word: "screw",
        motions: &[Screw],
        conditions: &[],
        closing: None,
        example: "screw(z, lead: 5 mm)",
    },
    Kind {
        word: "cylindrical",
        motions: &[Slide, Turn],
        conditions: &[Parallel(0, 1)],
        closing: Some(Closing::Cylindrical),
        example: "cylindrical(lift: z, turn: z)",
    },
    Kind {
        word: "universal",
        motions: &[Turn, Turn],
        conditions: &[Distinct([0, 1])],
        closing: Some(Closing::Universal),
        example: "universal(flap: y, lag: z)",
    },
    Kind {
        word: "planar",
        motions: &[Slide, Slide, Turn],
        conditions: &[Distinct([0, 1]), Perpendicular(0, 2), Perpendicular(1, 2)],
        closing: Some(Closing::Planar),
        example: "planar(u: x, v: y, turn: z)",
    },
    Kind {
        word: "spherical",
        motions: &[Turn, Turn, Turn],
        conditions: &[Distinct([0, 1]), Distinct([1, 2])],
        closing: Some(Closing::Spherical),
        example: "spherical(yaw: z, pitch: y, roll: x)",
    },
    Kind {
        word: "free",
        motions: &[Slide, Slide, Slide, Turn, Turn, Turn],
        conditions: &[Spanning([0, 1, 2]), Distinct([3, 4]), Distinct([4, 5])],
        closing: None,
        example: "free(px: x, py: y, pz: z, yaw: z, pitch: y, roll: x)",
    },
];

/// What other tools call them.
pub(in crate::model::resolve) const SYNONYMS: [(&str, &str); 28] = [
    ("hinge", "revolute"),
    ("pin", "revolute"),
    ("rotational", "revolute"),
    ("rotary", "revolute"),
    ("continuous", "revolute"),
    ("slider", "prismatic"),
    ("slide", "prismatic"),
    ("translational", "prismatic"),
    ("linear", "prismatic"),
    ("helical", "screw"),
    ("ball_screw", "screw"),
    ("ball", "spherical"),
    ("socket", "spherical"),
    ("ball_and_socket", "spherical"),
    ("gimbal", "spherical"),
    ("cardan", "universal"),
    ("hooke", "universal"),
    ("u_joint", "universal"),
    ("plane", "planar"),
    ("sleeve", "cylindrical"),
    ("weld", "fixed"),
    ("rigid", "fixed"),
    ("lock", "fixed"),
    ("locked", "fixed"),
    ("floating", "free"),
    ("six_dof", "free"),
    ("freejoint", "free"),
    ("free6", "free"),
];

impl Kind {
    /// The kind that a word means.
    pub(crate) fn find(word: &str) -> Option<&'static Kind> {
        KINDS.iter().find(|kind| kind.word == word)
    }

    /// Every word.
    pub(in crate::model::resolve) fn words() -> impl Iterator<Item = &'static str> + Clone {
        KINDS.iter().map(|kind| kind.word)
    }

    /// The only coordinate has the name of the joint.
    pub(crate) fn has_one_coordinate(&self) -> bool {
        self.motions.len() == 1
    }

    /// It leaves all six motions.
    pub(super) fn is_free(&self) -> bool {
        self.motions.len() == 6
    }

    /// It needs `lead`.
    pub(super) fn is_screw(&self) -> bool {
        self.motions.contains(&Screw)
    }
}

impl Elementary {
    /// What its coordinate measures.
    pub(crate) fn quantity(self) -> CoordinateQuantity {
        match self {
            Turn | Screw => CoordinateQuantity::Angle,
            Slide => CoordinateQuantity::Displacement,
        }
    }
}
