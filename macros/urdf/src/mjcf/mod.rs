//! MuJoCo's files, MJCF, as declarations.
//!
//! Bodies keep their frames and joints their coordinates, which are zero at the reference (`qpos` less `ref`). What MuJoCo makes soft, joined
//! bodies and coupled joints, is exact here. Defaults are written into the elements that they are for (`defaults.rs`), so that nothing behind
//! it knows of classes.

mod attributes;
mod constraints;
mod defaults;
mod element;
mod meshes;
mod model;
mod solids;
mod tendons;
mod whole;

use std::io;

use crate::error::{ImportError, Reason};
use crate::options::Options;
use crate::{Import, Note};

/// Reads a file that another one names, an included one or a mesh, by the name that it has there.
pub type Include<'a> = &'a dyn Fn(&str) -> io::Result<Vec<u8>>;

/// Translates the text of a MuJoCo file. Of [`Options`], name and resistance matter; such a file says itself what resists its joints, with
/// [`Resistance::File`](crate::Resistance::File).
///
/// Of meshes only the mass counts: those are read that give a body its mass.
///
/// # Errors
/// All mistakes in the file, each with its line and column.
///
/// # Examples
/// ```
/// use eigentol_urdf::{Options, Resistance, import_mjcf};
///
/// let text = r#"
/// <mujoco model="swing">
///   <compiler angle="radian"/>
///   <worldbody>
///     <body name="bar" pos="0 0 2">
///       <joint name="hinge" axis="0 1 0" stiffness="3" springref="0.1" damping="0.2" armature="0.05"/>
///       <geom type="box" size="0.05 0.05 0.5" pos="0 0 -0.5" mass="2"/>
///     </body>
///   </worldbody>
/// </mujoco>"#;
/// let swing = import_mjcf(text, &Options::default().resistance(Resistance::File), &|_| Err(std::io::ErrorKind::NotFound.into()))?;
/// assert!(swing.declaration.contains("joint hinge: revolute(y) from ground to bar at [0.0, 0.0, 2.0] m;"));
/// assert!(swing.declaration.contains("inerter(on: hinge, inertance: 0.05 kg*m^2)"));
/// # Ok::<(), eigentol_urdf::ImportError>(())
/// ```
pub fn import_mjcf(text: &str, options: &Options, include: Include<'_>) -> Result<Import, ImportError> {
    let root = element::read(text, include)?;
    if root.tag != "mujoco" {
        return Err(root.mistake(Reason::NotARobot(root.tag.clone())));
    }
    let root = defaults::written_out(root)?;
    model::Translation::new(&root, include)?.import(&root, options)
}

/// Whether a text is a MuJoCo file.
#[must_use]
pub fn is_mjcf(text: &str) -> bool {
    roxmltree::Document::parse(text).is_ok_and(|document| document.root_element().has_tag_name("mujoco"))
}

/// A remark.
fn remark(text: impl Into<String>) -> Note {
    Note::Remark(text.into())
}
