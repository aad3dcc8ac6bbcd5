#![doc = include_str!("../README.md")]

mod assemble;
mod error;
mod geometry;
mod mjcf;
mod names;
mod note;
mod options;
mod read;
mod robot;
mod undetermined;
mod weld;
mod write;

use std::collections::BTreeMap;

pub use error::{ImportError, Mistake, Reason};
pub use mjcf::{Include, import_mjcf, is_mjcf};
pub use note::Note;
pub use options::{Base, Options, Resistance};

/// A robot converted to a declaration.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Import {
    /// Text in the language of `mechanism!`; numbers in SI.
    pub declaration: String,
    /// Original names of all links and joints that had to be renamed, by their names in the declaration.
    pub names: BTreeMap<String, String>,
    /// Differences between the declaration and the file.
    pub notes: Vec<Note>,
}

/// Translates the text of a URDF file.
///
/// Files that it refers to, such as meshes, are never opened.
///
/// # Errors
/// All mistakes in the file, each with its line and column. A robot without moving joints also counts as a mistake.
///
/// # Examples
/// ```
/// use eigentol_urdf::{Options, import};
///
/// let text = r#"
/// <robot name="pendulum-1">
///   <link name="world"/>
///   <link name="bar">
///     <inertial>
///       <origin xyz="0 0 -0.5"/>
///       <mass value="3"/>
///       <inertia ixx="0.25" iyy="0.25" izz="0" ixy="0" ixz="0" iyz="0"/>
///     </inertial>
///   </link>
///   <joint name="hinge.1" type="continuous">
///     <parent link="world"/>
///     <child link="bar"/>
///     <axis xyz="0 1 0"/>
///   </joint>
/// </robot>"#;
/// let robot = import(text, &Options::default())?;
/// assert!(robot.declaration.starts_with("/// The robot `pendulum-1`"));
/// assert!(robot.declaration.contains("joint hinge_1: revolute(y) from ground to bar;"));
/// assert_eq!(robot.names["hinge_1"], "hinge.1");
/// # Ok::<(), eigentol_urdf::ImportError>(())
/// ```
pub fn import(text: &str, options: &Options) -> Result<Import, ImportError> {
    let robot = read::read(text)?;
    let tree = weld::weld(&robot)?;
    let mut assembly = assemble::assemble(&robot, &tree, options)?;
    if options.resistance == Resistance::Drives {
        undetermined::drive(&mut assembly)?;
    }
    Ok(write::write(&assembly))
}
