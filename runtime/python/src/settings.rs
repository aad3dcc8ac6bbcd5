//! The settings of a study: keyword arguments by name.

use eigentol::kernels::Kernels;
use eigentol::modes::Family;
use eigentol::tolerance::Distribution;
use eigentol::{Coordinate, DesignVariable, Input, Matrix, Parameter, Policy, Study, Unit};
use eigentol_interpreter::{Interpreted, meant, tolerance, tolerate};
use numpy::{AllowTypeChange, PyArrayLike2};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyString};

use crate::errors::{invalid, raise};
use crate::names::did_you_mean;
use crate::results::Equilibrium;
use crate::values::{List, number, numbers, refused, word, wrong_type};

type Set = fn(Study<Interpreted>, &Bound<'_, PyAny>) -> PyResult<Study<Interpreted>>;

/// Settings of a study.
///
/// In Python `keys of SETTINGS`.
pub(crate) type Settings<'py> = Bound<'py, PyDict>;

/// The settings by name, with their types in Python, in the order of application: those that depend on values come after
/// them.
const SETTINGS: [(&str, &str, Set); 20] = [
    ("inputs", "Mapping[str, Value]", |study, given| {
        let list = ("inputs", List::Inputs);
        values(study, given, list, |study, k, value| study.input(Input::new(k), value))
    }),
    ("design", "Mapping[str, Value]", |study, given| {
        let list = ("design", List::Design);
        values(study, given, list, |study, k, value| study.design(DesignVariable::new(k), value))
    }),
    ("start", "Mapping[str, Value]", |study, given| {
        let list = ("start", List::Coordinates);
        values(study, given, list, |study, k, value| study.start(Coordinate::new(k), value))
    }),
    ("guess", "Mapping[str, Value]", |study, given| {
        let list = ("guess", List::Coordinates);
        values(study, given, list, |study, k, value| study.guess(Coordinate::new(k), value))
    }),
    ("hold", "Mapping[str, Value]", |study, given| {
        let list = ("hold", List::Coordinates);
        values(study, given, list, |study, k, value| study.hold(Coordinate::new(k), value))
    }),
    ("sigma_level", "float", |study, given| Ok(study.sigma_level(real(given, "sigma_level")?))),
    ("tolerances", "Mapping[str, Value | tuple[Value, Value]]", tolerances),
    ("measured", "Mapping[str, ArrayLike]", measured),
    ("correlation", "ArrayLike", correlation),
    ("policy", "Literal[\"stable\", \"nearest\"]", |study, given| {
        let words = [("stable", Policy::Stable), ("nearest", Policy::Nearest)];
        Ok(study.policy(chosen(given, "policy", &words)?))
    }),
    ("stay", "bool", |study, given| {
        let wanted = given.extract::<bool>()?;
        Ok(if wanted { study.stay() } else { study })
    }),
    ("at", "Equilibrium", |study, given| {
        let state: PyRef<'_, Equilibrium> = given.extract()?;
        let count = study.description().coordinates.len();
        if state.0.coordinates.len() == count {
            return Ok(study.at(&state.0));
        }
        Err(invalid(given.py(), "`at`: this equilibrium belongs to another mechanism".to_owned()))
    }),
    ("family", "Family", |study, given| {
        let words = [("undamped", Family::Undamped), ("general", Family::General)];
        Ok(study.family(chosen(given, "family", &words)?))
    }),
    ("samples", "int", |study, given| match whole(given, "samples")? {
        0 => Err(invalid(given.py(), "`samples`: at least one is needed".to_owned())),
        samples => Ok(study.samples(samples)),
    }),
    ("seed", "int", |study, given| Ok(study.seed(whole(given, "seed")?))),
    ("stream", "int", |study, given| Ok(study.stream(whole(given, "stream")?))),
    ("threads", "int", |study, given| Ok(study.threads(whole(given, "threads")?))),
    ("keep_samples", "bool", |study, given| Ok(study.keep_samples(given.extract()?))),
    ("steps", "int", |study, given| Ok(study.steps(whole(given, "steps")?))),
    ("vectors", "bool", |study, given| {
        let wanted = given.extract::<bool>()?;
        Ok(if wanted { study } else { study.vectors(None) })
    }),
];

/// A study with these settings.
pub(crate) fn study(mechanism: Interpreted, settings: &Bound<'_, PyDict>) -> PyResult<Study<Interpreted>> {
    for key in settings.keys() {
        let key = key.extract::<String>()?;
        if SETTINGS.iter().all(|(name, ..)| *name != key) {
            let near = did_you_mean(&key, SETTINGS.iter().map(|(name, ..)| *name));
            let message = format!("Study has no setting `{key}`{near}");
            return Err(PyTypeError::new_err(message));
        }
    }
    let mut study = Study::new(mechanism);
    for (name, _, set) in SETTINGS {
        if let Some(given) = settings.get_item(name)?.filter(|given| !given.is_none()) {
            study = set(study, &given)?;
        }
    }
    // Inconsistent settings are rejected here, not at the first analysis.
    match study.tolerances() {
        Ok(_) => Ok(study),
        Err(error) => Err(raise(settings.py(), error)),
    }
}

/// Names of the inputs that are given no value.
pub(crate) fn unset_inputs(study: &Study<Interpreted>, settings: &Bound<'_, PyDict>) -> Vec<String> {
    let given = settings.get_item("inputs").ok().flatten();
    let named = match &given {
        None => None,
        Some(given) if given.is_none() => None,
        Some(given) => match given.cast::<PyDict>() {
            Ok(named) => Some(named),
            // A list has a value for each.
            Err(_) => return Vec::new(),
        },
    };
    let names = study.description().inputs.iter().map(|info| info.name.to_string());
    names.filter(|name: &String| !named.is_some_and(|named| named.contains(name).unwrap_or(true))).collect()
}

/// The settings of a study updated with others; dictionaries are merged by name.
pub(crate) fn merged<'py>(settings: &Bound<'py, PyDict>, others: &Bound<'py, PyDict>) -> PyResult<Bound<'py, PyDict>> {
    let all = copied(settings)?;
    for (key, value) in copied(others)? {
        let existing = all.get_item(&key)?;
        let inner = existing.as_ref().and_then(|x| x.cast::<PyDict>().ok());
        match (inner, value.cast::<PyDict>()) {
            (Some(nested), Ok(value)) => nested.update(value.as_mapping())?,
            _ => all.set_item(key, value)?,
        }
    }
    Ok(all)
}

/// A copy independent of the caller's dictionaries.
pub(crate) fn copied<'py>(settings: &Bound<'py, PyDict>) -> PyResult<Bound<'py, PyDict>> {
    let all = settings.copy()?;
    for (name, ..) in SETTINGS {
        let existing = all.get_item(name)?;
        if let Some(nested) = existing.as_ref().and_then(|x| x.cast::<PyDict>().ok()) {
            all.set_item(name, nested.copy()?)?;
        }
    }
    Ok(all)
}

fn real(given: &Bound<'_, PyAny>, name: &str) -> PyResult<f64> {
    given.extract().map_err(|_| PyTypeError::new_err(format!("`{name}`: a number is needed")))
}

pub(crate) fn whole<'py, T: FromPyObjectOwned<'py>>(given: &Bound<'py, PyAny>, name: &str) -> PyResult<T> {
    let extracted = if given.is_instance_of::<PyBool>() { None } else { given.extract().ok() };
    extracted.ok_or_else(|| PyTypeError::new_err(format!("`{name}`: a whole number that is not negative is needed")))
}

/// Each entry of a dictionary by name.
fn each(
    mut study: Study<Interpreted>,
    given: &Bound<'_, PyAny>,
    setting: &str,
    set: impl Fn(Study<Interpreted>, &str, &Bound<'_, PyAny>) -> PyResult<Study<Interpreted>>,
) -> PyResult<Study<Interpreted>> {
    let Ok(given) = given.cast::<PyDict>() else {
        let message = format!("`{setting}`: a dictionary is needed, a value for each name");
        return Err(PyTypeError::new_err(message));
    };
    for (name, value) in given {
        let Ok(name) = name.extract::<String>() else {
            let message = format!("`{setting}`: names are texts");
            return Err(PyTypeError::new_err(message));
        };
        for name in meant(&name, study.description()) {
            study = set(study, &name, &value)?;
        }
    }
    Ok(study)
}

/// Values of a list by name.
fn values(
    study: Study<Interpreted>,
    given: &Bound<'_, PyAny>,
    (setting, list): (&str, List),
    set: impl Fn(Study<Interpreted>, usize, f64) -> Study<Interpreted>,
) -> PyResult<Study<Interpreted>> {
    each(study, given, setting, |study, name, value| {
        let (index, unit) = list.find(value.py(), study.description(), name)?;
        Ok(set(study, index, number(value, &unit, name)?))
    })
}

/// A parameter that may have a tolerance, with its unit and value, SI.
fn parameter(study: &Study<Interpreted>, py: Python<'_>, name: &str) -> PyResult<(Parameter<Interpreted>, Unit, f64)> {
    let of = study.description();
    if let Ok((index, unit)) = List::Inputs.find(py, of, name) {
        return Ok((Input::new(index).into(), unit, study.input_values()[index]));
    }
    let (index, unit) = List::Design.find(py, of, name)?;
    let value = study.design_values()[index];
    Ok((DesignVariable::new(index).into(), unit, value))
}

/// A half-width (SI), a text ("3%", "+/- 0.1 mm uniform", "+0.2 -0.1 mm", "one of [1.9, 2.1] mm"), or both limits as
/// deviations.
fn tolerances(study: Study<Interpreted>, given: &Bound<'_, PyAny>) -> PyResult<Study<Interpreted>> {
    each(study, given, "tolerances", |study, name, given| {
        let py = given.py();
        let (parameter, unit, value) = parameter(&study, py, name)?;
        if let Ok(text) = given.cast::<PyString>() {
            let text = text.to_cow()?;
            let read = tolerance(&text, &unit, value);
            let read = read.map_err(|mistakes| refused(py, &text, &mistakes))?;
            let scale = if read.relative { value.abs() } else { 1.0 };
            let ends = [read.lower, read.upper].map(|end| scale * end);
            possible(py, &study, (name, parameter), ends)?;
            return Ok(tolerate(study, parameter, read, value));
        }
        if let Ok((lower, upper)) = given.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>() {
            let (lower, upper) = (number(&lower, &unit, name)?, number(&upper, &unit, name)?);
            possible(py, &study, (name, parameter), [lower, upper])?;
            return Ok(study.limits(parameter, lower, upper));
        }
        match given.extract::<f64>() {
            Ok(_) => {
                let wide = number(given, &unit, name)?;
                possible(py, &study, (name, parameter), [-wide, wide])?;
                Ok(study.tolerance(parameter, wide))
            }
            Err(_) => Err(wrong_type(given, name)),
        }
    })
}

/// Refuses a tolerance at whose ends a body cannot exist, as a declaration does.
fn possible(
    py: Python<'_>,
    study: &Study<Interpreted>,
    (name, parameter): (&str, Parameter<Interpreted>),
    ends: [f64; 2],
) -> PyResult<()> {
    let Parameter::Design(variable) = parameter else {
        return Ok(());
    };
    let violation = |change: f64| {
        let mut design = study.design_values().to_vec();
        design[variable.index()] += change;
        study.mechanism().violation(study.input_values(), &design)
    };
    if violation(0.0).is_some() {
        // Something else is to blame, such as an input that has no value yet.
        return Ok(());
    }
    for end in ends {
        if let Some(violation) = violation(end) {
            let (quantity, requirement) = (violation.quantity, violation.requirement);
            let message = format!("within the tolerance of `{name}`, {quantity} would not be {requirement}");
            return Err(invalid(py, message));
        }
    }
    Ok(())
}

/// Sets measured values of parameters, SI; they vary as measured.
fn measured(study: Study<Interpreted>, given: &Bound<'_, PyAny>) -> PyResult<Study<Interpreted>> {
    each(study, given, "measured", |study, name, given| {
        let py = given.py();
        let (parameter, ..) = parameter(&study, py, name)?;
        let values = numbers(given, name)?;
        let values = Distribution::empirical(&values).map_err(|error| raise(py, error.into()))?;
        Ok(study.distribution(parameter, values))
    })
}

fn correlation(study: Study<Interpreted>, given: &Bound<'_, PyAny>) -> PyResult<Study<Interpreted>> {
    let Ok(given) = given.extract::<PyArrayLike2<'_, f64, AllowTypeChange>>() else {
        let message = "`correlation`: a square array of numbers is needed";
        return Err(PyTypeError::new_err(message));
    };
    let given = given.as_array();
    let (rows, columns) = given.dim();
    let matrix = Matrix::from_fn(rows, columns, |i, j| given[[i, j]]);
    Ok(study.correlation(matrix))
}

/// One of several words.
fn chosen<T: Copy>(given: &Bound<'_, PyAny>, what: &str, words: &[(&'static str, T)]) -> PyResult<T> {
    word(given.py(), what, &given.extract::<String>()?, words)
}
