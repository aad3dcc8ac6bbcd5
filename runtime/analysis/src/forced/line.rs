//! Forced vibration of one output, with the derivatives that finding its peaks along an input takes.

use super::adjoint::OutputAdjoint;
use super::curvature::{Along, Curved, frequency_rows};
use super::measure::Measure;
use super::response::Solved;
use crate::error::NoDerivative;
use crate::kernels::{CurvatureKernels, Linear};
use crate::second_order::{Adjoint, joined};
use crate::sensitivity::{Slopes, directions};
use crate::{Complex, Equilibrium, Error, Output};

/// A number, its total derivatives by every variable, and the derivatives of these along one input.
pub(crate) struct Curving<T> {
    pub(crate) value: T,
    pub(crate) slopes: Slopes<T>,
    pub(crate) along: Slopes<T>,
}

/// One output of a harmonic near one value of an input.
pub(crate) struct Line {
    /// The frequency, rad/s.
    pub(crate) frequency: Curving<f64>,
    /// The complex amplitude as displacement, velocity or acceleration.
    pub(crate) amplitude: Curving<Complex>,
    /// It is more than what rounding leaves of the terms that cancel in it.
    pub(crate) audible: bool,
}

/// Relative rounding that cancelling terms may leave.
const ROUNDING: f64 = 1e-12;

/// An output of a harmonic, and its derivatives along an input.
pub(crate) fn along_input(
    mechanism: &dyn CurvatureKernels,
    at: &Equilibrium,
    (harmonic, output, measure): (usize, Output, Measure),
    input: usize,
) -> Result<Line, Error> {
    let solved = Solved::new(mechanism, at)?;
    let (Some(vibration), true) = (
        solved.vibrations.get(harmonic),
        output.index() < mechanism.sizes().outputs,
    ) else {
        return Err(Error::UnknownHandle {
            kind: "output",
            index: output.index(),
            mechanism: at.description.name.clone(),
            count: mechanism.sizes().outputs,
        });
    };
    if !solved.smooth[output.index()] {
        let output = at.description.outputs[output.index()].name.clone();
        return Err(Error::NotSmooth { output });
    }
    let none = Error::NoSensitivity {
        reason: NoDerivative::NotSmooth,
    };
    let adjoint = Adjoint::new(mechanism, at)?;
    let direction = directions(mechanism, at)?.nth(input);
    let direction = direction.ok_or(Error::NoSensitivity {
        reason: NoDerivative::UnknownInput,
    })?;
    let along = [Along::new(mechanism, at, input, direction)];
    let (slopes, rows) = frequency_rows(mechanism, at, &adjoint, vibration, &along);
    let frequency = Curving {
        value: vibration.harmonic.frequency,
        slopes,
        along: rows.into_iter().next().ok_or(none.clone())?,
    };
    let only = output.index()..output.index() + 1;
    let output_adjoint = OutputAdjoint::each(&solved, vibration, only);
    let this_adjoint = output_adjoint
        .into_iter()
        .flatten()
        .next()
        .ok_or(none.clone())?;
    let y = vibration.harmonic.outputs[output.index()].ok_or(none.clone())?;
    let terms = terms(
        &at.linear,
        frequency.value,
        &this_adjoint.factors.left,
        &vibration.harmonic.unknowns,
    );
    let (curved, total) = Curved::new(this_adjoint, &adjoint);
    let moved = along[0].of(vibration, &frequency.slopes);
    let row = curved.along(mechanism, &moved).ok_or(none)?;
    let slopes = joined(&total).map(|value| -value);
    if !(slopes.iter().chain(row.iter())).all(|value| value.is_finite()) {
        return Err(solved.not_finite());
    }
    let w = &frequency;
    let by_input = (w.slopes.by_input[input], slopes.by_input[input]);
    let first = w.slopes.zip(&slopes);
    let second = w.along.zip(&row);
    let value = (w.value, y);
    let curvature = |(item, second)| measure.curvature(value, [by_input, item], second);
    let amplitude = Curving {
        value: measure.of(w.value, y),
        along: first.zip(&second).map(curvature),
        slopes: first.map(|(dw, dy)| measure.slope(value, dw, dy)),
    };
    Ok(Line {
        audible: y.norm() > ROUNDING * terms,
        frequency,
        amplitude,
    })
}

/// The sizes of the terms in `p . D z`, whose rounding an output sees.
fn terms(linear: &Linear, w: f64, p: &[Complex], z: &[Complex]) -> f64 {
    let row = |i: usize| {
        let each = z.iter().enumerate();
        let (k, c, m) = (&linear.stiffness[i], &linear.damping[i], &linear.mass[i]);
        each.fold(0.0, |sum, (j, z)| {
            sum + (k[j].abs() + w * (c[j].abs() + w * m[j].abs())) * z.norm()
        })
    };
    let each = p.iter().enumerate();
    each.map(|(i, p)| p.norm() * row(i)).sum()
}
