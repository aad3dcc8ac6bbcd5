//! The kinds of joint, one row each; no other module knows their names.

use crate::model::mechanism::{Closing, CoordinateQuantity};

/// A kind of joint.
#[derive(Debug)]
pub(crate) struct Kind {
    /// The keyword it is declared with.
    pub(crate) word: &'static str,
    /// Its elementary motions, in order from the `from` side; each has a coordinate.
    pub(crate) motions: &'static [Elementary],
    /// Conditions on its axes.
    pub(crate) conditions: &'static [Condition],
    /// How it closes a loop, if it can.
    pub(crate) closing: Option<Closing>,
    /// An example for messages.
    pub(crate) example: &'static str,
}

/// An elementary motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Elementary {
    Turn,
    Slide,
    Screw,
}

/// A relation between the axes of motions, given by their indices.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Condition {
    /// Parallel, as the name of the joint promises.
    Parallel(usize, usize),
    /// Perpendicular, as the name of the joint promises.
    Perpendicular(usize, usize),
    /// Not parallel: otherwise two coordinates would measure one motion.
    Distinct([usize; 2]),
    /// Not in one plane: otherwise three coordinates would measure two motions.
    Spanning([usize; 3]),
}

use Condition::{Distinct, Parallel, Perpendicular, Spanning};
use Elementary::{Screw, Slide, Turn};

const KINDS: &[Kind] = &[
    Kind { word: "fixed", motions: &[], conditions: &[], closing: Some(Closing::Fixed), example: "fixed" },
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
    Kind { word: "screw", motions: &[Screw], conditions: &[], closing: None, example: "screw(z, lead: 5 mm)" },
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

/// Names of the kinds in other tools.
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
    /// The kind with the given keyword.
    pub(crate) fn find(word: &str) -> Option<&'static Kind> {
        KINDS.iter().find(|kind| kind.word == word)
    }

    /// All keywords.
    pub(in crate::model::resolve) fn words() -> impl Iterator<Item = &'static str> + Clone {
        KINDS.iter().map(|kind| kind.word)
    }

    /// Whether it has a single coordinate, which has the name of the joint.
    pub(crate) fn has_one_coordinate(&self) -> bool {
        self.motions.len() == 1
    }

    /// Whether it leaves all six motions free.
    pub(super) fn is_free(&self) -> bool {
        self.motions.len() == 6
    }

    /// Whether it needs `lead`.
    pub(super) fn is_screw(&self) -> bool {
        self.motions.contains(&Screw)
    }
}

impl Elementary {
    /// The quantity that its coordinate measures.
    pub(crate) fn quantity(self) -> CoordinateQuantity {
        match self {
            Turn | Screw => CoordinateQuantity::Angle,
            Slide => CoordinateQuantity::Displacement,
        }
    }
}
