//! Why a file cannot be imported.

use std::fmt;

use thiserror::Error;

/// All mistakes of a file.
#[derive(Clone, Debug, PartialEq, Error)]
pub struct ImportError {
    /// In the order of their places in the file; never empty.
    pub mistakes: Vec<Mistake>,
}

/// A mistake and its place.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Mistake {
    /// From 1.
    pub line: u32,
    /// From 1, in characters.
    pub column: u32,
    /// What is wrong.
    pub reason: Reason,
}

/// What is wrong with a file.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Reason {
    /// It is no XML.
    #[error("this is not XML: {0}")]
    Xml(String),
    /// The outermost element is another one.
    #[error("this is `{0}`, not a `robot`")]
    NotARobot(String),
    /// It is a template.
    #[error("this is a xacro template, not a robot")]
    Template,
    /// An attribute is missing.
    #[error("`{element}` has no `{attribute}`")]
    MissingAttribute {
        /// The element.
        element: String,
        /// What it lacks.
        attribute: &'static str,
    },
    /// An element is missing.
    #[error("{of} has no `{element}`")]
    MissingElement {
        /// What lacks it.
        of: String,
        /// The element.
        element: &'static str,
    },
    /// A value is not what it has to be.
    #[error("`{attribute}` is `{found}`; {expected} is expected")]
    Value {
        /// The attribute.
        attribute: String,
        /// Its text.
        found: String,
        /// What it should be.
        expected: &'static str,
    },
    /// A joint is of no kind that exists.
    #[error("`{found}` is no type of a joint")]
    JointType {
        /// As it is written.
        found: String,
        /// The nearest one.
        near: Option<&'static str>,
    },
    /// Two links, or two joints, have one name.
    #[error("the {what} `{name}` is there twice")]
    Twice {
        /// `link` or `joint`.
        what: &'static str,
        /// Its name.
        name: String,
    },
    /// A link or joint is named that is not there.
    #[error("there is no {what} `{name}`")]
    Unknown {
        /// `link` or `joint`.
        what: &'static str,
        /// The name.
        name: String,
        /// The nearest one.
        near: Option<String>,
    },
    /// Nothing is there.
    #[error("the robot has no link")]
    NoLink,
    /// A link hangs on two others.
    #[error("the link `{link}` is the child of both `{first}` and `{second}`")]
    TwoParents {
        /// The link.
        link: String,
        /// A joint.
        first: String,
        /// Another joint.
        second: String,
    },
    /// Several links hang on nothing.
    #[error("nothing leads from the root `{root}` to the link `{link}`")]
    TwoRoots {
        /// The first link without a parent.
        root: String,
        /// Another one.
        link: String,
    },
    /// Links hang on each other in a circle.
    #[error("the link `{0}` hangs on itself, through others")]
    Circle(String),
    /// A joint that moves has no direction.
    #[error("the axis of the joint `{0}` has no length")]
    NoAxis(String),
    /// A joint with several coordinates, or a chain of them that bites its tail, cannot follow another.
    #[error("the joint `{joint}` cannot mimic `{of}`: {why}")]
    Mimic {
        /// The joint that follows.
        joint: String,
        /// The joint that leads.
        of: String,
        /// Why not.
        why: &'static str,
    },
    /// A mass below zero.
    #[error("the mass of the link `{link}` is {mass} kg")]
    NegativeMass {
        /// The link.
        link: String,
        /// kg.
        mass: f64,
    },
    /// Inertia without mass.
    #[error("the link `{0}` has an inertia but no mass, and no link welded to it has one")]
    InertiaWithoutMass(String),
    /// No body has such an inertia.
    #[error("the inertia of {} is that of no body: its principal moments about the centre of mass are {} kg*m^2, and no one may exceed the sum of the others", of_links(.links), three(.principal))]
    Inertia {
        /// The links that are welded together, the one that moves them first.
        links: Vec<String>,
        /// Principal moments about the centre of mass, ascending, kg m^2.
        principal: [f64; 3],
        /// The principal moments of the nearest inertia that a body can have, kg m^2.
        nearest: [f64; 3],
        /// That inertia about the centre of mass along the axes of the first link: xx, yy, zz, xy, yz, xz, kg m^2.
        replacement: [f64; 6],
    },
    /// All is fixed.
    #[error("nothing moves: {0}")]
    NothingMoves(&'static str),
    /// The declaration does not compile: a limit of the compiler.
    #[error("the declaration that this file gives does not compile: {0}")]
    Refused(String),
}

impl Reason {
    /// What to do about it.
    pub fn help(&self) -> String {
        let did_you_mean = |near: Option<&str>| near.map(|near| format!("did you mean `{near}`?"));
        match self {
            Reason::Xml(_) => "export the robot again; the file may be cut off".to_owned(),
            Reason::NotARobot(_) => "give a URDF file; SDF and MJCF have to be converted to it".to_owned(),
            Reason::Template => "expand it first: `xacro robot.xacro > robot.urdf`".to_owned(),
            Reason::MissingAttribute { attribute, .. } => format!("add `{attribute}=\"...\"`"),
            Reason::MissingElement { element, .. } => format!("add `<{element} .../>`"),
            Reason::Value { .. } => "correct the value".to_owned(),
            Reason::JointType { near, .. } => did_you_mean(*near).unwrap_or_else(|| {
                "known are revolute, continuous, prismatic, fixed, floating, planar".to_owned()
            }),
            Reason::Twice { .. } => "rename one of them".to_owned(),
            Reason::Unknown { what, near, .. } => did_you_mean(near.as_deref())
                .unwrap_or_else(|| format!("declare the {what}, or name another")),
            Reason::NoLink => "a robot needs a link and a joint that moves it".to_owned(),
            Reason::TwoParents { .. } => {
                "a URDF file has no loops: remove one of the joints, and close the loop in the declaration by a `joint`".to_owned()
            }
            Reason::TwoRoots { root, link } => {
                format!("connect it by a joint, for example a fixed one from `{root}` to `{link}`")
            }
            Reason::Circle(_) => "one of its joints has parent and child exchanged".to_owned(),
            Reason::NoAxis(_) => "give it a direction such as `<axis xyz=\"0 0 1\"/>`".to_owned(),
            Reason::Mimic { .. } => "name a joint with one coordinate that does not follow this one".to_owned(),
            Reason::NegativeMass { .. } => "a mass is positive, or zero".to_owned(),
            Reason::InertiaWithoutMass(_) => "give it a mass".to_owned(),
            Reason::Inertia { nearest, replacement: [xx, yy, zz, xy, yz, xz], .. } => format!(
                "the nearest inertia of a body has the moments {}: ixx={xx:?} iyy={yy:?} izz={zz:?} ixy={xy:?} iyz={yz:?} ixz={xz:?}, of all these links together; it is taken with the option `nearest_inertias`",
                three(nearest)
            ),
            Reason::NothingMoves(_) => {
                "a floating or planar base makes the whole robot move, and springs hold what nothing resists".to_owned()
            },
            Reason::Refused(_) => "choose another resistance, or correct what it names".to_owned(),
        }
    }
}

/// Six digits tell enough in a message.
pub(crate) fn three(values: &[f64; 3]) -> String {
    values.map(|value| format!("{value:.5e}")).join(", ")
}

pub(crate) fn of_links(links: &[String]) -> String {
    match links {
        [only] => format!("the link `{only}`"),
        [first, rest @ ..] => format!(
            "the link `{first}` with {} welded to it (`{}`)",
            rest.len(),
            rest.join("`, `")
        ),
        [] => "a link".to_owned(),
    }
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            line,
            column,
            reason,
        } = self;
        write!(
            f,
            "{line}:{column}: error: {reason}\nhelp: {}",
            reason.help()
        )
    }
}

/// One paragraph per mistake.
impl fmt::Display for ImportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let texts: Vec<String> = self.mistakes.iter().map(Mistake::to_string).collect();
        f.write_str(&texts.join("\n"))
    }
}
