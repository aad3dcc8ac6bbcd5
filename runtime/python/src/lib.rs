#![doc = include_str!("../README.md")]

mod allocation;
mod arrays;
mod clusters;
mod errors;
mod figures;
mod hints;
mod kernels;
mod live;
mod mechanism;
mod motion;
mod names;
mod parts;
mod questions;
mod report;
mod requirements;
mod response;
mod results;
mod robots;
mod settings;
mod study;
mod values;

use pyo3::prelude::*;

/// Natural frequencies of mechanisms in steady motion, and how manufacturing tolerances move them.
///
/// A `Mechanism` is read from a file or a text; a `Study` of it is asked questions. Numbers are SI, texts have a unit
/// ("3000 rpm"); modes are counted from 0, as arrays are. Where a result has no number, its array has NaN.
#[pymodule(name = "eigentol")]
mod module {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::clusters::Clusters;
    #[pymodule_export]
    use crate::errors::Mistake;
    #[pymodule_export]
    use crate::live::Live;
    #[pymodule_export]
    use crate::mechanism::Mechanism;
    #[pymodule_export]
    use crate::motion::Motion;
    #[pymodule_export]
    use crate::parts::Part;
    #[pymodule_export]
    use crate::response::Response;
    #[pymodule_export]
    use crate::results::{Answer, Equilibrium, ForcedResponse, Modes, MonteCarlo, Sensitivities, Sweep, json_schema};
    #[pymodule_export]
    use crate::robots::{Import, import_mjcf, import_urdf};
    #[pymodule_export]
    use crate::study::Study;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        // Without numpy the first array would abort the interpreter; importing it here reports what is missing.
        module.py().import("numpy")?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        crate::errors::add_to(module)
    }
}
