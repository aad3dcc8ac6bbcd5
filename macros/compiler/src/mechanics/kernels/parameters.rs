//! Lists of symbols as parameters of kernels.

use crate::algebra::Parameter;
use crate::mechanics::setup::{Pencil, SymbolList};

pub(crate) fn parameter(name: &'static str, list: &SymbolList) -> Parameter {
    Parameter { name, symbols: list.ids.clone(), scalar: false }
}

pub(crate) fn vectors(pencil: &Pencil) -> Vec<Parameter> {
    [
        ("left", &pencil.left),
        ("acceleration", &pencil.acceleration),
        ("velocity", &pencil.velocity),
        ("position", &pencil.position),
    ]
    .map(|(name, list)| parameter(name, list))
    .into()
}

pub(crate) fn scalar(name: &'static str, list: &SymbolList) -> Parameter {
    Parameter { name, symbols: list.ids.clone(), scalar: true }
}
