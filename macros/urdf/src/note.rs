//! Differences between a declaration and its file.

use std::fmt;

use crate::error::{of_links, three};

/// A remark on an import.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// An element without meaning in a mechanism, such as a picture, a stop or a motor.
    Ignored {
        /// The element, such as `limit`.
        element: String,
        /// Its owners: `links`, `joints` or `the robot`.
        of: &'static str,
        /// The owners' names in the file.
        names: Vec<String>,
    },
    /// Links that fixed joints weld to a body or to the ground: they become points of it.
    Welded {
        /// The body, or `ground`.
        body: String,
        /// The links that become points, by their names in the file.
        links: Vec<String>,
    },
    /// An inertia that no body can have was replaced by the nearest possible one.
    Replaced {
        /// The links that are welded together.
        links: Vec<String>,
        /// Original principal moments, kg m^2.
        principal: [f64; 3],
        /// New principal moments, kg m^2.
        nearest: [f64; 3],
    },
    /// A joint that cannot move because the joint that it follows cannot, or because its multiplier is zero.
    Held {
        /// Its name in the file.
        joint: String,
    },
    /// The `mimic` of a fixed joint has no effect.
    FixedMimic {
        /// Its name in the file.
        joint: String,
    },
    /// What is written in another way, or left out, in words.
    Remark(String),
    /// A coordinate that nothing resists, or a joint that moves no mass, is driven at 0.
    Driven {
        /// The coordinate in the declaration.
        coordinate: String,
        /// The reason.
        why: &'static str,
    },
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Note::Ignored { element, of, names } => match (*of, names.as_slice()) {
                ("the robot", _) => write!(f, "`{element}` has no meaning in a mechanism"),
                (_, [only]) => write!(f, "`{element}` of `{only}` has no meaning in a mechanism"),
                (of, names) => {
                    write!(f, "`{element}` of {} {of} has no meaning in a mechanism: {}", names.len(), names.join(", "))
                }
            },
            Note::Welded { body, links } => {
                write!(f, "welded to `{body}`, and points of it: {}", links.join(", "))
            }
            Note::Replaced { links, principal, nearest } => write!(
                f,
                "the inertia of {} is replaced by the nearest that a body can have: principal moments {} kg*m^2 in place of {}",
                of_links(links),
                three(nearest),
                three(principal)
            ),
            Note::Held { joint } => write!(f, "`{joint}` follows what stands still: it is fixed"),
            Note::Remark(text) => f.write_str(text),
            Note::FixedMimic { joint } => write!(f, "`{joint}` is fixed: its `mimic` says nothing"),
            Note::Driven { coordinate, why } => write!(f, "`{coordinate}` is driven at 0: {why}"),
        }
    }
}
