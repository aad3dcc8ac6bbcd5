//! A mechanism read at run time.

use std::fmt;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use eigentol::kernels::{Kernel, MotionKernel};
use eigentol::{Description, PictureInfo, Shared, Text};
use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::program::Program;
use eigentol_compiler::{Compilation, compile_refined, compile_text, tokens, with_included};

use crate::description::{description, text};
use crate::mistakes::{Mistakes, ReadError, RefineError};
use crate::picture::picture;
use crate::tape::Tape;

/// A mechanism whose kernels are interpreted. A clone shares everything with the original.
///
/// It implements the kernel tables required by [`Study`](eigentol::Study) and the functions behind it. Handles are
/// looked up by name with [`Study::find_input`](eigentol::Study::find_input) and similar methods. They fit every
/// interpreted mechanism; a study rejects a handle whose index it does not have.
#[derive(Clone)]
pub struct Interpreted {
    pub(crate) shared: Arc<Tables>,
    pub(crate) description: Shared<Description>,
}

pub(crate) struct Tables {
    pub(crate) picture: Shared<PictureInfo>,
    pub(crate) tapes: Tapes,
    /// Quantity and requirement of each value of the violation kernel.
    pub(crate) requirements: Vec<(Text, Text)>,
    /// The joint or beam, and its least margin, of each value of the pose kernel.
    pub(crate) poses: Vec<(Text, f64)>,
}

/// The kernels; `None` if the compiler generated none.
pub(crate) struct Tapes {
    /// In the order of [`Kernel::ALL`].
    pub(crate) at_rest: Vec<Option<Tape>>,
    /// In the order of [`MotionKernel::ALL`].
    pub(crate) in_motion: Vec<Option<Tape>>,
    pub(crate) linear_partials: Option<Tape>,
    pub(crate) picture: Option<Tape>,
    pub(crate) violation: Option<Tape>,
    pub(crate) pose_margin: Option<Tape>,
    pub(crate) held_values: Option<Tape>,
    pub(crate) spans: Option<Tape>,
}

impl Tapes {
    fn new(program: &Program) -> Self {
        let tape = |name: &str| program.kernel(name).map(Tape::new);
        let at_rest = Kernel::ALL.iter().map(|kernel| tape(kernel.name()));
        let in_motion = MotionKernel::ALL.iter().map(|kernel| tape(kernel.name()));
        Self {
            at_rest: at_rest.collect(),
            in_motion: in_motion.collect(),
            linear_partials: tape("linear_partials"),
            picture: tape("picture"),
            violation: tape("violation"),
            pose_margin: tape("pose_margin"),
            held_values: tape("held_values"),
            spans: tape("spans"),
        }
    }
}

impl Interpreted {
    pub(crate) fn tape(&self, kernel: Kernel) -> &Option<Tape> {
        &self.shared.tapes.at_rest[kernel as usize]
    }

    /// Reads the mechanism declared by a text: the contents of the braces of `mechanism! { .. }`.
    ///
    /// # Errors
    /// All mistakes in the declaration, with line and column.
    pub fn from_text(text: &str) -> Result<Self, Mistakes> {
        Ok(Self::new(&compile_text(text, Limits::default())?))
    }

    /// Reads the mechanism declared by a file.
    ///
    /// # Errors
    /// [`ReadError`]: the file cannot be read, or its declaration is invalid.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        let path = path.as_ref();
        let text = fs::read_to_string(path).map_err(|source| ReadError::File { path: path.to_owned(), source })?;
        let read = with_included(&text, path).and_then(|(text, _)| Self::from_text(&text));
        read.map_err(|mistakes| ReadError::Mistakes { path: path.to_owned(), mistakes })
    }

    /// Reads the mechanism declared by a text, with this many `more` coordinates of each component of its beams: bending,
    /// torsion, stretch and shear. A component without coordinates stays rigid.
    ///
    /// ```
    /// use eigentol::Study;
    /// use eigentol_interpreter::Interpreted;
    ///
    /// const TEXT: &str = "mechanism Cantilever {
    ///     body arm: beam(length: 1 m, along: x, up: z, bending_y: 4, stiffness_y: 1 N*m^2, mass_per_length: 1 kg/m);
    ///     joint clamp: fixed from ground to arm;
    /// }";
    /// let study = Study::new(Interpreted::from_text(TEXT)?);
    /// let refined = [Interpreted::refined(TEXT, 1)?, Interpreted::refined(TEXT, 2)?];
    /// println!("{}", study.convergence(refined)?);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`RefineError`]: there is no beam, or the declaration is invalid.
    pub fn refined(text: &str, more: usize) -> Result<Self, RefineError> {
        let tokens = tokens(text)?;
        let compilation = compile_refined(tokens, Limits::default(), more).map_err(Mistakes::from)?;
        if compilation.mechanism.beams.is_empty() {
            Err(RefineError::NoBeam { mechanism: compilation.mechanism.name.to_string() })
        } else {
            Ok(Self::new(&compilation))
        }
    }

    /// Creates the mechanism of a compiled declaration.
    pub fn new(compilation: &Compilation) -> Self {
        let functions = &compilation.functions;
        let requirements = functions.requirements.iter().map(|requirement| {
            let quantity = text(requirement.quantity.as_str());
            (quantity, Text::Static(requirement.requirement))
        });
        let poses = functions.poses.iter();
        let tables = Tables {
            picture: Shared::Counted(Arc::new(picture(&functions.picture))),
            tapes: Tapes::new(&compilation.program),
            requirements: requirements.collect(),
            poses: poses.map(|pose| (text(pose.joint.as_str()), pose.least)).collect(),
        };
        Self { shared: Arc::new(tables), description: Shared::Counted(Arc::new(description(compilation))) }
    }

    /// Names, units, nominal values and properties proved by the compiler.
    pub fn description(&self) -> &Description {
        &self.description
    }
}

impl fmt::Debug for Interpreted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Interpreted").field("description", &self.description).finish_non_exhaustive()
    }
}

impl PartialEq for Interpreted {
    /// Whether both share the same data and state it in the same units.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.shared, &other.shared) && self.description == other.description
    }
}
