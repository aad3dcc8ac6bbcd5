//! Rejects values that no real part can have, at the nominal design and at the ends of every tolerance.

use std::rc::Rc;

use super::composite::{self, Welded};
use super::violation::{Violation, digits};
use crate::base::diagnostics::{Diagnostic, Diagnostics};
use crate::base::dimension::Dimension;
use crate::base::span::Extent;
use crate::model::evaluate::{Dependence, Values};
use crate::model::expression::Expr;
use crate::model::mechanism::{Constant, Curve, Part};

/// A requirement on values.
#[derive(Clone, Debug)]
pub(crate) struct Requirement {
    /// The quantity, for messages: "the mass of `bar`".
    pub(crate) what: String,
    /// Its values.
    pub(crate) values: Vec<Expr>,
    /// The condition on the values.
    pub(crate) demand: Demand,
    /// Where it was declared.
    pub(crate) extent: Extent,
}

/// A condition on values.
#[derive(Clone, Debug)]
pub(crate) enum Demand {
    /// Finite numbers.
    Finite,
    /// Numbers above zero.
    Positive(Dimension),
    /// Numbers not below zero at the nominal design; within its tolerance, an amplitude below zero is one in the opposite
    /// direction.
    Amplitude(Dimension),
    /// A vector longer than zero.
    Direction,
    /// Given inertias that are possible for bodies welded together; the values are those about the centres of mass.
    Inertia(Rc<Welded>),
    /// Two radii, the first below the second.
    BelowOuter,
    /// The travel of a screw per turn.
    Lead,
    /// The ratio of a coupling.
    Ratio,
    /// Two unit vectors that are not parallel.
    Distinct,
    /// Three unit vectors that are not in one plane.
    Spanning,
    /// An argument between the ends of a curve.
    OnCurve(Curve),
    /// No values: the holes of a body must leave something of it.
    Holes(Rc<[Part]>),
}

/// A design variable, as far as the rules need it.
#[derive(Clone, Debug)]
pub(crate) struct DesignPoint {
    /// Name.
    pub(crate) name: String,
    /// Nominal value, SI.
    pub(crate) nominal: f64,
    /// Lower and upper limit minus the nominal value, SI.
    pub(crate) limits: [f64; 2],
    /// The declared tolerance.
    pub(crate) extent: Option<Extent>,
}

/// Checks all requirements. Inputs have no nominal values: requirements that depend on them are checked at run time.
pub(crate) fn check(
    requirements: &[Requirement],
    constants: &[Constant],
    design: &[DesignPoint],
    inputs: usize,
    diagnostics: &mut Diagnostics,
) {
    let unknown = vec![f64::NAN; inputs];
    let (met, violated) = at_nominal(requirements, constants, design, &unknown);
    for violation in violated {
        let message = format!("{} {}", violation.what, violation.problem);
        diagnostics.push(Diagnostic { help: violation.help, ..Diagnostic::new(violation.extent, message) });
    }
    for index in 0..design.len() {
        check_tolerance(&met, constants, design, index, &unknown, diagnostics);
    }
}

/// Checks one tolerance, given outside the declaration. What is violated at the nominal design is not its fault.
pub(crate) fn check_given(
    requirements: &[Requirement],
    constants: &[Constant],
    design: &[DesignPoint],
    index: usize,
    inputs: usize,
    diagnostics: &mut Diagnostics,
) {
    let unknown = vec![f64::NAN; inputs];
    let (met, _) = at_nominal(requirements, constants, design, &unknown);
    check_tolerance(&met, constants, design, index, &unknown, diagnostics);
}

/// The requirements that are met at the nominal design, and the violations of others.
fn at_nominal<'a>(
    requirements: &'a [Requirement],
    constants: &[Constant],
    design: &[DesignPoint],
    inputs: &[f64],
) -> (Vec<&'a Requirement>, Vec<Violation>) {
    let nominal: Vec<f64> = design.iter().map(|variable| variable.nominal).collect();
    let values = Values::new(constants, inputs, &nominal);
    let on_inputs = Dependence::on_inputs(constants);
    // A constant without a value is reported once, not wherever it is used.
    let on_mistakes = Dependence::on_constants_without_value(&values);
    let (mut met, mut violated) = (Vec::new(), Vec::new());
    for requirement in requirements {
        let depends = |expr: &Expr| on_inputs.of(expr) || on_mistakes.of(expr);
        if requirement.values.iter().any(depends) {
            continue;
        }
        match violation(requirement, &values) {
            None => met.push(requirement),
            Some(violation) => violated.push(violation),
        }
    }
    (met, violated)
}

/// Checks that both ends of a tolerance are physically possible, with all other variables at their nominal values;
/// reports the first violated requirement.
fn check_tolerance(
    requirements: &[&Requirement],
    constants: &[Constant],
    design: &[DesignPoint],
    index: usize,
    inputs: &[f64],
    diagnostics: &mut Diagnostics,
) {
    let variable = &design[index];
    let Some(extent) = variable.extent else {
        return;
    };
    for deviation in variable.limits {
        if deviation == 0.0 {
            continue;
        }
        let mut shifted: Vec<f64> = design.iter().map(|variable| variable.nominal).collect();
        shifted[index] += deviation;
        let values = Values::new(constants, inputs, &shifted);
        let in_tolerance = |requirement: &&&Requirement| !matches!(requirement.demand, Demand::Amplitude(_));
        for requirement in requirements.iter().filter(in_tolerance) {
            if let Some(Violation { what, problem, .. }) = violation(requirement, &values) {
                let name = &variable.name;
                let message = format!("within the tolerance of `{name}`, {what} {problem}");
                let help = "narrow the tolerance, or change the nominal value";
                diagnostics.error_with_help(extent, message, help);
                return;
            }
        }
    }
}

fn violation(requirement: &Requirement, at: &Values) -> Option<Violation> {
    if let Demand::Inertia(welded) = &requirement.demand {
        return composite::impossible(welded, at);
    }
    Some(Violation {
        problem: problem(requirement, at)?,
        what: requirement.what.clone(),
        extent: requirement.extent,
        help: None,
    })
}

fn in_unit(value: f64, dimension: Dimension) -> String {
    if dimension.is_none() {
        rounded(value).to_string()
    } else {
        format!("{} {}", rounded(value), dimension.si_symbol())
    }
}

/// The problem with the values, as the end of a sentence.
fn problem(requirement: &Requirement, at: &Values) -> Option<String> {
    let values: Vec<f64> = requirement.values.iter().map(|expr| at.of(expr)).collect();
    if values.iter().any(|value| !value.is_finite()) {
        return Some("is not a finite real number".to_string());
    }
    match (&requirement.demand, values.as_slice()) {
        (Demand::Positive(dimension), values) => {
            let value = values.iter().find(|&&value| value <= 0.0)?;
            let value = in_unit(*value, *dimension);
            Some(format!("is {value}; it must be positive"))
        }
        (Demand::Amplitude(dimension), values) => {
            let value = values.iter().find(|&&value| value < 0.0)?;
            let value = in_unit(*value, *dimension);
            Some(format!("is {value}; the opposite direction is a phase or an angle of 180 deg"))
        }
        (Demand::Direction, vector) if vector.iter().all(|&value| value == 0.0) => Some("has no length".to_string()),
        (Demand::BelowOuter, &[inner, outer]) if inner >= outer => {
            Some(format!("is {} m; it must be smaller than the outer, {} m", rounded(inner), rounded(outer)))
        }
        (Demand::Lead, [0.0]) => Some("is zero; a joint that turns without travel is `revolute`".to_string()),
        (Demand::Ratio, [0.0]) => {
            Some("is zero; a coordinate is held in its place by an `equation`, or by a drive at 0".to_string())
        }
        (Demand::Distinct, axes) => {
            parallel(axes).then(|| "are parallel: the second motion would repeat the first".to_string())
        }
        (Demand::Spanning, axes) => {
            in_one_plane(axes).then(|| "lie in one plane: together they do not reach every place".to_string())
        }
        (Demand::OnCurve(curve), &[argument]) if !curve.reaches(argument) => {
            let [first, last] = curve.range();
            let (first, last) = (curve.in_unit(first), curve.with_unit(last));
            let argument = curve.with_unit(argument);
            Some(format!("is {argument}; this curve goes from {first} to {last}"))
        }
        (Demand::Holes(parts), _) => composite::holes(parts, at),
        _ => None,
    }
}

/// A sine of an angle, or a volume between unit vectors, up to which it counts as zero.
const NEARLY: f64 = 1e-9;

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    let [[ax, ay, az], [bx, by, bz]] = [a, b];
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

fn parallel(axes: &[f64]) -> bool {
    let &[ax, ay, az, bx, by, bz] = axes else {
        return false;
    };
    cross([ax, ay, az], [bx, by, bz]).iter().all(|component| component.abs() < NEARLY)
}

fn in_one_plane(axes: &[f64]) -> bool {
    let &[ax, ay, az, bx, by, bz, cx, cy, cz] = axes else {
        return false;
    };
    let [x, y, z] = cross([ax, ay, az], [bx, by, bz]);
    (x * cx + y * cy + z * cz).abs() < NEARLY
}

/// Six digits are enough for a message.
fn rounded(value: f64) -> f64 {
    digits(value, 6)
}
