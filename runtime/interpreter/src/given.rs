//! Parses values and tolerances given as text, with the units and words of the language.

use eigentol::{Law, Parameter, Study, ToleranceInfo, Unit};
use eigentol_compiler::model::resolve::given;
use eigentol_compiler::syntax::ast::Ast;
use eigentol_compiler::syntax::parse::parse;
use eigentol_compiler::tokens;
use proc_macro2::TokenStream;

use crate::description;
use crate::mechanism::Interpreted;
use crate::mistakes::Mistakes;

/// What a declaration without mistakes in its syntax says.
///
/// # Errors
/// The mistakes in the text.
pub fn declaration(text: &str) -> Result<Ast, Mistakes> {
    Ok(parse(tokens(text)?)?)
}

/// Parses the value (SI) of a quantity in this unit: `3000rpm`, `-2.5 mm`, `pi / 3`. `what` names the quantity in
/// messages.
///
/// ```
/// use eigentol::Unit;
/// use eigentol_interpreter::value;
///
/// let rpm = Unit { symbol: "rpm".to_owned().into(), scale: std::f64::consts::PI / 30.0 };
/// assert!((value("50 Hz", &rpm, "`speed`")? - 314.159_265_358_979_3).abs() < 1e-12);
///
/// let error = value("3000", &rpm, "`speed`").unwrap_err().to_string();
/// assert_eq!(error, "1:1: `3000` has no unit; an angular speed is expected, for example `3000 rpm`");
/// # Ok::<(), eigentol_interpreter::Mistakes>(())
/// ```
///
/// # Errors
/// The mistakes in the text; lines and columns refer to it.
pub fn value(text: &str, unit: &Unit, what: &str) -> Result<f64, Mistakes> {
    Ok(given::value(tokens(text)?, declared(unit)?, what)?)
}

/// Parses the tolerance of a quantity in this unit: `3%`, `0.1 mm uniform`, `+0.2 -0.1 mm`, with or without the `+/-`
/// sign of a half-width, or `one of [1.9, 2.1] mm`. `nominal` is the value (SI) about which it varies.
///
/// ```
/// use eigentol::{Law, Unit};
/// use eigentol_interpreter::tolerance;
///
/// let mm = Unit { symbol: "mm".to_owned().into(), scale: 1e-3 };
/// let found = tolerance("+0.2 0 mm uniform", &mm, 0.02)?;
/// assert_eq!((found.lower, found.upper, found.law), (0.0, 2e-4, Law::Uniform));
/// # Ok::<(), eigentol_interpreter::Mistakes>(())
/// ```
///
/// # Errors
/// The mistakes in the text; lines and columns refer to it.
pub fn tolerance(text: &str, unit: &Unit, nominal: f64) -> Result<ToleranceInfo, Mistakes> {
    let parsed = given::tolerance(tokens(text)?, declared(unit)?, nominal)?;
    Ok(description::tolerance(&parsed))
}

/// Parses the tolerance of a design variable like [`tolerance`], and checks it like a declared one: its ends must be
/// possible where the design variables have these values (SI).
///
/// ```
/// use eigentol_compiler::{compile_text, mechanics::Limits};
/// use eigentol_interpreter::{Interpreted, design_tolerance};
///
/// let compilation = compile_text(
///     "mechanism A { design l = 1 m; gravity 9.81 m/s^2 along -z; body bar: rod(mass: 1 kg, length: l, along: -z);
///         joint t: revolute(y) from ground to bar; }",
///     Limits::default(),
/// )?;
/// assert!(design_tolerance(&compilation.ast, "3%", 0, &[1.0])?.relative);
/// let error = design_tolerance(&compilation.ast, "3 m", 0, &[1.0]).unwrap_err().to_string();
/// assert!(error.contains("within the tolerance of `l`, the length of `bar` is -2 m; it must be positive"));
/// # Ok::<(), eigentol_interpreter::Mistakes>(())
/// ```
///
/// # Errors
/// The mistakes in the text.
///
/// # Panics
/// If the declaration has no such design variable, or another number of them.
pub fn design_tolerance(of: &Ast, text: &str, variable: usize, design: &[f64]) -> Result<ToleranceInfo, Mistakes> {
    let tolerance = given::design_tolerance(of, tokens(text)?, variable, design)?;
    Ok(description::tolerance(&tolerance))
}

/// Gives a parameter of this value (SI) a tolerance. Where no law is said, the declared one stays.
pub fn tolerate(
    study: Study<Interpreted>,
    parameter: Parameter<Interpreted>,
    tolerance: ToleranceInfo,
    value: f64,
) -> Study<Interpreted> {
    let ToleranceInfo { lower, upper, relative, law } = tolerance;
    let study = if !relative {
        study.limits(parameter, lower, upper)
    } else if lower == -upper {
        study.relative_tolerance(parameter, upper)
    } else {
        study.limits(parameter, value.abs() * lower, value.abs() * upper)
    };
    match law {
        Law::Normal => study,
        law => study.law(parameter, law),
    }
}

/// The tokens of a unit, as in a declaration.
fn declared(unit: &Unit) -> Result<TokenStream, Mistakes> {
    match &*unit.symbol {
        "" => tokens("1"),
        symbol => tokens(symbol),
    }
}
