//! Robots from URDF files, models from MuJoCo's.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use eigentol_urdf::{Base, Options, Resistance, import};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

use crate::errors;
use crate::mechanism::Mechanism;
use crate::names::did_you_mean;
use crate::values::word;

/// A robot as a declaration; numbers are SI.
#[pyclass(frozen, get_all, new = "from_fields", module = "eigentol")]
pub(crate) struct Import {
    /// Text in the language of eigentol.
    declaration: String,
    /// By the name in the declaration, that in the file: of every link and joint that had to be renamed.
    names: BTreeMap<String, String>,
    /// What the declaration does not say, or says in another way than the file.
    notes: Vec<String>,
}

/// How a URDF file becomes a declaration.
///
/// In Python `keys of OPTIONS`.
pub(crate) type UrdfOptions<'py> = Bound<'py, PyDict>;

/// The options by name, with their types in Python.
const OPTIONS: [(&str, &str); 9] = [
    ("base", "Literal[\"fixed\", \"floating\", \"planar\"]"),
    ("resistance", "Literal[\"springs\", \"drives\", \"file\", \"none\"]"),
    ("stiffness", "float"),
    ("damping", "float"),
    ("linear_stiffness", "float"),
    ("linear_damping", "float"),
    ("file_damping", "bool"),
    ("nearest_inertias", "bool"),
    ("name", "str | None"),
];

fn options(py: Python<'_>, given: Option<&UrdfOptions<'_>>) -> PyResult<Options> {
    let mut options = Options::default();
    let Some(given) = given else {
        return Ok(options);
    };
    for key in given.keys() {
        let key = key.extract::<String>()?;
        let known = OPTIONS.iter().map(|(name, _)| *name);
        if !known.clone().any(|name| name == key) {
            let message = format!("there is no option `{key}`{}", did_you_mean(&key, known));
            return Err(PyTypeError::new_err(message));
        }
    }
    if let Some(base) = given.get_item("base")? {
        let words = [("fixed", Base::Fixed), ("floating", Base::Floating), ("planar", Base::Planar)];
        options.base = word(py, "base", &base.extract::<String>()?, &words)?;
    }
    if let Some(resistance) = given.get_item("resistance")? {
        let words = [
            ("springs", Resistance::default()),
            ("drives", Resistance::Drives),
            ("file", Resistance::File),
            ("none", Resistance::KernelsOnly),
        ];
        options.resistance = word(py, "resistance", &resistance.extract::<String>()?, &words)?;
    }
    if let Resistance::Springs { stiffness, damping, linear_stiffness, linear_damping } = &mut options.resistance {
        for (name, slot) in [
            ("stiffness", stiffness),
            ("damping", damping),
            ("linear_stiffness", linear_stiffness),
            ("linear_damping", linear_damping),
        ] {
            let Some(value) = given.get_item(name)? else {
                continue;
            };
            *slot = value.extract()?;
            if !(slot.is_finite() && *slot >= 0.0) {
                let message = format!("`{name}` is {slot}: give a finite value that is not negative");
                return Err(errors::invalid(py, message));
            }
        }
    }
    if let Some(damping) = given.get_item("file_damping")? {
        options.damping = damping.extract()?;
    }
    if let Some(nearest) = given.get_item("nearest_inertias")? {
        options.nearest_inertias = nearest.extract()?;
    }
    if let Some(name) = given.get_item("name")?.filter(|name| !name.is_none()) {
        options.name = Some(name.extract()?);
    }
    Ok(options)
}

fn read(py: Python<'_>, path: &Path, given: Option<&UrdfOptions<'_>>) -> PyResult<eigentol_urdf::Import> {
    let options = options(py, given)?;
    let text = std::fs::read_to_string(path).map_err(|source| errors::unreadable(path, &source))?;
    py.detach(|| import(&text, &options)).map_err(|error| errors::urdf(py, &error, path))
}

/// The declaration of a robot from its URDF file.
///
/// Options: `base`, "fixed", "floating" or "planar"; `resistance` of the joints, "springs" on every coordinate,
/// "drives" that hold at 0 the joints that nothing resists, or "none" for a mechanism of kernels alone; of springs
/// `stiffness` (50 N m/rad), `damping` (0.5 N m s/rad), `linear_stiffness` (50 N/m), `linear_damping` (0.5 N s/m);
/// `file_damping`, whether the damping of the file is taken (True); `nearest_inertias`, whether impossible inertias are
/// replaced by the nearest possible ones (False); `name` of the mechanism.
///
/// Raises OSError when the file cannot be read, DeclarationError with line and column of every mistake.
#[pyfunction]
#[pyo3(signature = (path, **options))]
pub(crate) fn import_urdf(py: Python<'_>, path: PathBuf, options: Option<&UrdfOptions<'_>>) -> PyResult<Import> {
    Ok(as_import(read(py, &path, options)?))
}

/// The declaration of a model from its MuJoCo file (MJCF), with defaults and included files. Bodies and coordinates keep their names; coordinates
/// are zero at the reference (`qpos` less `ref`). Joined bodies and coupled joints are exact, not soft. `notes` tells what a mechanism cannot
/// express, such as contacts, motors and limits.
///
/// Options as of `import_urdf`, of which `name` and `resistance` matter: unless given, what the file says resists its joints; "none" gives a
/// mechanism of kernels alone, for a machine that nothing holds.
///
/// Raises OSError when the file cannot be read, DeclarationError with line and column of every mistake.
#[pyfunction]
#[pyo3(signature = (path, **options))]
pub(crate) fn import_mjcf(py: Python<'_>, path: PathBuf, options: Option<&UrdfOptions<'_>>) -> PyResult<Import> {
    let text = std::fs::read_to_string(&path).map_err(|source| errors::unreadable(&path, &source))?;
    let says = options.is_some_and(|given| given.contains("resistance").unwrap_or(false));
    let mut options = self::options(py, options)?;
    if !says {
        options.resistance = Resistance::File;
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    let read = |name: &str| std::fs::read(folder.join(name));
    let imported = py.detach(|| eigentol_urdf::import_mjcf(&text, &options, &read));
    Ok(as_import(imported.map_err(|error| errors::urdf(py, &error, &path))?))
}

fn as_import(imported: eigentol_urdf::Import) -> Import {
    let notes = imported.notes.iter().map(ToString::to_string).collect();
    Import { declaration: imported.declaration, names: imported.names, notes }
}

#[pymethods]
impl Import {
    fn __getnewargs__(&self) -> (&str, BTreeMap<String, String>, Vec<String>) {
        (&self.declaration, self.names.clone(), self.notes.clone())
    }

    /// The mechanism.
    fn mechanism(&self, py: Python<'_>) -> PyResult<Mechanism> {
        Mechanism::read(py, self.declaration.clone())
    }

    fn __repr__(&self) -> &str {
        &self.declaration
    }
}

#[pymethods]
impl Mechanism {
    /// The robot that a URDF file describes; options as of `import_urdf`, which also tells names and remarks.
    #[classmethod]
    #[pyo3(signature = (path, **options))]
    fn from_urdf(class: &Bound<'_, PyType>, path: PathBuf, options: Option<&UrdfOptions<'_>>) -> PyResult<Self> {
        Self::read(class.py(), read(class.py(), &path, options)?.declaration)
    }

    /// The model that a MuJoCo file describes; `import_mjcf` also tells names and remarks.
    #[classmethod]
    #[pyo3(signature = (path, **options))]
    fn from_mjcf(class: &Bound<'_, PyType>, path: PathBuf, options: Option<&UrdfOptions<'_>>) -> PyResult<Self> {
        Self::read(class.py(), import_mjcf(class.py(), path, options)?.declaration)
    }
}
