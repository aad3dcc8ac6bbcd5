//! Errors that prevent the import of a file.

use std::fmt;

use thiserror::Error;

/// All mistakes in a file.
#[derive(Clone, Debug, PartialEq, Error)]
pub struct ImportError {
    /// The mistakes, in the order of their positions in the file; never empty.
    pub mistakes: Vec<Mistake>,
}

/// A mistake and its position.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Mistake {
    /// Line, from 1.
    pub line: u32,
    /// Column, from 1, in characters.
    pub column: u32,
    /// The problem.
    pub reason: Reason,
}

/// Most links and joints of a robot: the time grows with the square, and the equations of so many bodies are out of reach.
pub(crate) const MOST: usize = 10_000;

/// The problem with a file.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Reason {
    /// The file is not XML.
    #[error("this is not XML: {0}")]
    Xml(String),
    /// The outermost element is not a robot.
    #[error("this is `{0}`, not a `robot`")]
    NotARobot(String),
    /// The file is a template.
    #[error("this is a xacro template, not a robot")]
    Template,
    /// An attribute is missing.
    #[error("`{element}` has no `{attribute}`")]
    MissingAttribute {
        /// The element.
        element: String,
        /// The missing attribute.
        attribute: &'static str,
    },
    /// An element is missing.
    #[error("{of} has no `{element}`")]
    MissingElement {
        /// The element that lacks it.
        of: String,
        /// The missing element.
        element: &'static str,
    },
    /// A value is invalid.
    #[error("`{attribute}` is `{found}`; {expected} is expected")]
    Value {
        /// The attribute.
        attribute: String,
        /// Its text as found.
        found: String,
        /// The expected value.
        expected: &'static str,
    },
    /// The type of a joint is unknown.
    #[error("`{found}` is not a type of joint")]
    JointType {
        /// The type as written.
        found: String,
        /// The nearest known type.
        near: Option<&'static str>,
    },
    /// Two links, or two joints, have the same name.
    #[error("the {what} `{name}` is there twice")]
    Twice {
        /// `link` or `joint`.
        what: &'static str,
        /// Its name.
        name: String,
    },
    /// A link or joint is referred to that does not exist.
    #[error("there is no {what} `{name}`")]
    Unknown {
        /// `link` or `joint`.
        what: &'static str,
        /// The name.
        name: String,
        /// The nearest existing name.
        near: Option<String>,
    },
    /// The file contains no link.
    #[error("the robot has no link")]
    NoLink,
    /// More links and joints than any declaration can have.
    #[error("the robot has {0} links and joints, and at most {MOST} can be converted")]
    TooLarge(usize),
    /// A link has two parents.
    #[error("the link `{link}` is the child of both `{first}` and `{second}`")]
    TwoParents {
        /// The link.
        link: String,
        /// One joint that leads to it.
        first: String,
        /// The other joint.
        second: String,
    },
    /// Several links have no parent.
    #[error("nothing leads from the root `{root}` to the link `{link}`")]
    TwoRoots {
        /// The first link without a parent.
        root: String,
        /// Another link without a parent.
        link: String,
    },
    /// Links form a loop of parents.
    #[error("the link `{0}` hangs on itself, through others")]
    Circle(String),
    /// The axis of a moving joint has no direction.
    #[error("the axis of the joint `{0}` has no length")]
    NoAxis(String),
    /// A joint cannot mimic another: one of them has several coordinates, or the chain of mimics is closed.
    #[error("the joint `{joint}` cannot mimic `{of}`: {why}")]
    Mimic {
        /// The joint that follows.
        joint: String,
        /// The joint that leads.
        of: String,
        /// The reason.
        why: &'static str,
    },
    /// A mass is negative.
    #[error("the mass of the link `{link}` is {mass} kg")]
    NegativeMass {
        /// The link.
        link: String,
        /// The mass, kg.
        mass: f64,
    },
    /// A link has an inertia but no mass.
    #[error("the link `{0}` has an inertia but no mass, and no link welded to it has one")]
    InertiaWithoutMass(String),
    /// No body can have this inertia.
    #[error("the inertia of {} is that of no body: its principal moments about the centre of mass are {} kg*m^2, and no one may exceed the sum of the others", of_links(.links), three(.principal))]
    Inertia {
        /// The links that are welded together, starting with the one that moves them.
        links: Vec<String>,
        /// Principal moments about the centre of mass, ascending, kg m^2.
        principal: [f64; 3],
        /// The principal moments of the nearest inertia that a body can have, kg m^2.
        nearest: [f64; 3],
        /// The nearest inertia about the centre of mass, in the axes of the first link: xx, yy, zz, xy, yz, xz, kg m^2.
        replacement: [f64; 6],
    },
    /// A mistake of a MuJoCo file.
    #[error("{message}")]
    Model {
        /// The problem.
        message: String,
        /// Advice.
        help: String,
    },
    /// Nothing in the robot moves.
    #[error("nothing moves: {0}")]
    NothingMoves(&'static str),
    /// The declaration does not compile, because of a limit of the compiler.
    #[error("the declaration that this file gives does not compile: {0}")]
    Refused(String),
}

impl Reason {
    /// Advice on how to fix it.
    pub fn help(&self) -> String {
        let did_you_mean = |near: Option<&str>| near.map(|near| format!("did you mean `{near}`?"));
        match self {
            Reason::Xml(_) => "export the robot again; the file may be cut off".to_owned(),
            Reason::NotARobot(_) => "give a URDF file or one of MuJoCo; SDF has to be converted".to_owned(),
            Reason::Model { help, .. } => help.clone(),
            Reason::Template => "expand it first: `xacro robot.xacro > robot.urdf`".to_owned(),
            Reason::MissingAttribute { attribute, .. } => format!("add `{attribute}=\"...\"`"),
            Reason::MissingElement { element, .. } => format!("add `<{element} .../>`"),
            Reason::Value { .. } => "correct the value".to_owned(),
            Reason::JointType { near, .. } => did_you_mean(*near)
                .unwrap_or_else(|| "known are revolute, continuous, prismatic, fixed, floating, planar".to_owned()),
            Reason::Twice { .. } => "rename one of them".to_owned(),
            Reason::Unknown { what, near, .. } => {
                did_you_mean(near.as_deref()).unwrap_or_else(|| format!("declare the {what}, or name another"))
            }
            Reason::TooLarge(_) => "convert its limbs one by one".to_owned(),
            Reason::NoLink => "a robot needs a link and a joint that moves it".to_owned(),
            Reason::TwoParents { .. } => {
                "a URDF file has no loops: remove one of the joints, and close the loop in the declaration by a `joint`"
                    .to_owned()
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
            }
            Reason::Refused(_) => "choose another resistance, or correct what it names".to_owned(),
        }
    }
}

/// Six digits are enough for a message.
pub(crate) fn three(values: &[f64; 3]) -> String {
    values.map(|value| format!("{value:.5e}")).join(", ")
}

pub(crate) fn of_links(links: &[String]) -> String {
    match links {
        [only] => format!("the link `{only}`"),
        [first, rest @ ..] => format!("the link `{first}` with {} welded to it (`{}`)", rest.len(), rest.join("`, `")),
        [] => "a link".to_owned(),
    }
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, column, reason } = self;
        write!(f, "{line}:{column}: error: {reason}\nhelp: {}", reason.help())
    }
}

/// One paragraph per mistake.
impl fmt::Display for ImportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let texts: Vec<String> = self.mistakes.iter().map(Mistake::to_string).collect();
        f.write_str(&texts.join("\n"))
    }
}
