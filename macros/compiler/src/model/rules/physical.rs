//! Values that no real part can have: at the nominal values, and at the ends of every tolerance.

use std::rc::Rc;

use super::composite;
use crate::base::diagnostics::Diagnostics;
use crate::base::dimension::Dimension;
use crate::base::span::Extent;
use crate::model::evaluate::{InputDependence, Values};
use crate::model::expression::Expr;
use crate::model::mechanism::{Constant, Part};

/// Something that values must satisfy.
#[derive(Clone, Debug)]
pub(crate) struct Requirement {
    /// The quantity, for messages: "the mass of `bar`".
    pub(crate) what: String,
    /// Its values.
    pub(crate) values: Vec<Expr>,
    /// What they must satisfy.
    pub(crate) demand: Demand,
    /// Where it was declared.
    pub(crate) extent: Extent,
}

/// What values must satisfy.
#[derive(Clone, Debug)]
pub(crate) enum Demand {
    /// Finite numbers.
    Finite,
    /// Numbers above zero.
    Positive(Dimension),
    /// A vector longer than zero.
    Direction,
    /// Six tensor entries about the centre of mass that a body can have: xx, yy, zz, xy, yz, xz.
    Inertia,
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
    /// No values: a body that its holes leave something of.
    Holes(Rc<[Part]>),
}

/// A design variable as far as the rules need it.
#[derive(Clone, Debug)]
pub(crate) struct DesignPoint {
    /// Name.
    pub(crate) name: String,
    /// Nominal value, SI.
    pub(crate) nominal: f64,
    /// Half-width of the tolerance, SI.
    pub(crate) tolerance: f64,
    /// The declared tolerance.
    pub(crate) extent: Option<Extent>,
}

/// Checks all requirements. Inputs have no nominal values: what depends on them is left to the run.
pub(crate) fn check(
    requirements: &[Requirement],
    constants: &[Constant],
    design: &[DesignPoint],
    inputs: usize,
    diagnostics: &mut Diagnostics,
) {
    let unknown = vec![f64::NAN; inputs];
    let nominal: Vec<f64> = design.iter().map(|variable| variable.nominal).collect();
    let dependence = InputDependence::new(constants);
    let values = Values::new(constants, &unknown, &nominal);
    let mut met = Vec::new();
    for requirement in requirements {
        if requirement.values.iter().any(|expr| dependence.of(expr)) {
            continue;
        }
        match violation(requirement, &values) {
            None => met.push(requirement),
            Some(problem) => {
                let message = format!("{} {problem}", requirement.what);
                diagnostics.error(requirement.extent, message);
            }
        }
    }
    for index in 0..design.len() {
        check_tolerance(&met, constants, design, index, &unknown, diagnostics);
    }
}

/// A tolerance may not reach what no part can have: the first requirement that it breaks is reported.
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
    if variable.tolerance == 0.0 {
        return;
    }
    for sign in [-1.0, 1.0] {
        let mut shifted: Vec<f64> = design.iter().map(|variable| variable.nominal).collect();
        shifted[index] += sign * variable.tolerance;
        let values = Values::new(constants, inputs, &shifted);
        for requirement in requirements {
            if let Some(problem) = violation(requirement, &values) {
                let Requirement { what, .. } = requirement;
                let name = &variable.name;
                let message = format!("within the tolerance of `{name}`, {what} {problem}");
                let help = "narrow the tolerance, or change the nominal value";
                diagnostics.error_with_help(extent, message, help);
                return;
            }
        }
    }
}

/// What is wrong with the values, as the end of a sentence.
fn violation(requirement: &Requirement, at: &Values) -> Option<String> {
    let values: Vec<f64> = requirement.values.iter().map(|expr| at.of(expr)).collect();
    if values.iter().any(|value| !value.is_finite()) {
        return Some("is not a finite real number".to_string());
    }
    match (&requirement.demand, values.as_slice()) {
        (Demand::Positive(dimension), values) => {
            let value = values.iter().find(|&&value| value <= 0.0)?;
            let (value, unit) = (rounded(*value), dimension.si_symbol());
            Some(format!("is {value} {unit}; it must be positive"))
        }
        (Demand::Direction, vector) if vector.iter().all(|&value| value == 0.0) => {
            Some("has no length".to_string())
        }
        (Demand::Inertia, &[xx, yy, zz, xy, yz, xz]) => inertia([xx, yy, zz, xy, yz, xz]),
        (Demand::BelowOuter, &[inner, outer]) if inner >= outer => Some(format!(
            "is {} m; it must be smaller than the outer, {} m",
            rounded(inner),
            rounded(outer)
        )),
        (Demand::Lead, [0.0]) => {
            Some("is zero; a joint that turns without travel is `revolute`".to_string())
        }
        (Demand::Ratio, [0.0]) => Some(
            "is zero; a coordinate is held in its place by an `equation`, or by a drive at 0"
                .to_string(),
        ),
        (Demand::Distinct, axes) => parallel(axes)
            .then(|| "are parallel: the second motion would repeat the first".to_string()),
        (Demand::Spanning, axes) => in_one_plane(axes)
            .then(|| "lie in one plane: together they do not reach every place".to_string()),
        (Demand::Holes(parts), _) => composite::holes(parts, at),
        _ => None,
    }
}

/// Sine of an angle, or volume between unit vectors, that counts as zero.
const NEARLY: f64 = 1e-9;

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    let [[ax, ay, az], [bx, by, bz]] = [a, b];
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

fn parallel(axes: &[f64]) -> bool {
    let &[ax, ay, az, bx, by, bz] = axes else {
        return false;
    };
    let normal = cross([ax, ay, az], [bx, by, bz]);
    normal.iter().all(|component| component.abs() < NEARLY)
}

fn in_one_plane(axes: &[f64]) -> bool {
    let &[ax, ay, az, bx, by, bz, cx, cy, cz] = axes else {
        return false;
    };
    let [x, y, z] = cross([ax, ay, az], [bx, by, bz]);
    (x * cx + y * cy + z * cz).abs() < NEARLY
}

/// Six digits tell enough in a message.
fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// `D = tr(J)/2 I - J` is the integral of `r r^T dm` about the centre of mass. Mass is nowhere negative, so `D` is
/// positive semidefinite; that is the triangle inequality of the principal moments, and makes `J` so too.
fn inertia([xx, yy, zz, xy, yz, xz]: [f64; 6]) -> Option<String> {
    if xx < 0.0 || yy < 0.0 || zz < 0.0 {
        return Some("has a negative moment".to_string());
    }
    let half = (xx + yy + zz) / 2.0;
    let moments = [half - xx, half - yy, half - zz, -xy, -yz, -xz];
    (!positive_semidefinite(moments, half)).then(|| {
        "belongs to no body: each principal moment is at most the sum of the other two".to_string()
    })
}

/// The symmetric matrix xx, yy, zz, xy, yz, xz has no negative eigenvalue, up to rounding errors of entries of size
/// `scale`: all its principal minors are positive or zero.
pub(super) fn positive_semidefinite([a, b, c, d, e, f]: [f64; 6], scale: f64) -> bool {
    // Rounding may leave a flat body a little below zero.
    let scale = scale.max(f64::MIN_POSITIVE);
    let slack = -1e-9;
    let first = [a, b, c].map(|entry| entry / scale);
    let second = [a * b - d * d, b * c - e * e, a * c - f * f].map(|minor| minor / scale / scale);
    let determinant = a * (b * c - e * e) - d * (d * c - e * f) + f * (d * e - b * f);
    let third = determinant / scale / scale / scale;
    let mut minors = first.into_iter().chain(second).chain([third]);
    minors.all(|minor| minor >= slack)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inertias_of_bodies() {
        assert_eq!(inertia([1.0, 1.0, 2.0, 0.0, 0.0, 0.0]), None);
        assert_eq!(inertia([1.0, 1.0, 0.0, 0.0, 0.0, 0.0]), None);
        assert_eq!(inertia([0.0; 6]), None);
        // A slender bar along (1, 1, 1): J = I - n n^T.
        let third = 1.0 / 3.0;
        assert_eq!(
            inertia([
                1.0 - third,
                1.0 - third,
                1.0 - third,
                -third,
                -third,
                -third
            ]),
            None
        );
    }

    #[test]
    fn inertias_of_no_body() {
        assert!(inertia([1.0, 1.0, 2.1, 0.0, 0.0, 0.0]).is_some());
        assert!(inertia([-1.0, 1.0, 1.0, 0.0, 0.0, 0.0]).is_some());
        assert!(inertia([1.0, 1.0, 1.0, 0.6, 0.6, 0.6]).is_some());
        assert!(inertia([1.0, 1.0, 1.0, 0.0, 0.0, 0.9]).is_some());
        assert!(inertia([0.0, 0.0, 0.0, 0.1, 0.0, 0.0]).is_some());
    }
}
