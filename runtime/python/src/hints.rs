//! Python types where Rust's say nothing. The stub `eigentol.pyi` takes them from the documentation of the aliases here
//! and beside the functions that use them.

use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A number, SI, or a text with a unit. In Python `float | str`.
pub(crate) type Value<'py> = Bound<'py, PyAny>;

/// Numbers by name or in the order of arrays, SI or texts with units. In Python `ArrayLike | Mapping[str, Value]`.
pub(crate) type Numbers<'py> = Bound<'py, PyAny>;

/// Numbers, SI, or a range as in the command, "0..6000 rpm", for 51 values. In Python `ArrayLike`.
pub(crate) type ArrayLike<'py> = Bound<'py, PyAny>;

/// A whole number that is not negative. In Python `int`.
pub(crate) type Count<'py> = Bound<'py, PyAny>;

/// Least and greatest values by name. In Python `Mapping[str, tuple[Value, Value]]`.
pub(crate) type Ranges<'py> = Bound<'py, PyDict>;

/// In Python `dict[str, int]`.
pub(crate) type Counts<'py> = Bound<'py, PyDict>;

/// Columns by heading. In Python `dict[str, Any]`.
pub(crate) type Table<'py> = Bound<'py, PyDict>;

/// A quantity of a mode. In Python `Literal["frequency", "natural_frequency", "damping_ratio", "growth", "log_decrement"]`.
pub(crate) type Quantity = str;

/// In Python `Quantity | Literal["lambda"]`.
pub(crate) type QuantityOrLambda = str;

/// How a vibrating output is measured. In Python `Literal["displacement", "velocity", "acceleration"]`.
pub(crate) type Measure = str;

/// Which modes. In Python `Literal["undamped", "general"]`.
pub(crate) type Family = str;

/// A response, "frequency 1" with modes counted from 1. In Python `str`.
pub(crate) type ResponseText<'py> = Bound<'py, PyAny>;

/// A requirement, "frequency 1 >= 20 Hz". In Python `str`.
pub(crate) type RequirementText<'py> = Bound<'py, PyAny>;

/// Something of another library. In Python `Any`.
pub(crate) type Anything<'py> = Bound<'py, PyAny>;
