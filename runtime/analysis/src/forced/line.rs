//! Forced vibration of one output, with the derivatives that finding its peaks along an input takes.

use core::slice;

use super::adjoint::OutputAdjoint;
use super::curvature::{Along, Curved, frequency_rows};
use super::forces::Forces;
use super::measure::Measure;
use super::response::{Solved, add};
use crate::algebra::{Vector, dot_complex};
use crate::error::NoDerivative;
use crate::kernels::{CurvatureKernels, Linear};
use crate::modes::pencil_slope_times;
use crate::second_order::{Adjoint, joined};
use crate::sensitivity::{Slopes, directions};
use crate::{Complex, Equilibrium, Error, Mode, Output};

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
    /// By mode, the share of the displacement that its pole would have at a distance of 1/s: the size of its residue
    /// over that of the amplitude.
    pub(crate) residues: Vec<f64>,
}

/// Relative rounding that cancelling terms may leave.
const ROUNDING: f64 = 1e-12;

/// Outputs of harmonics, and their derivatives along an input. Without modes there are no residues.
pub(crate) fn along_input(
    mechanism: &dyn CurvatureKernels,
    (at, modes): (&Equilibrium, &[Mode]),
    wanted: &[(usize, Output, Measure)],
    input: usize,
) -> Result<Vec<Line>, Error> {
    let solved = Solved::new(mechanism, at)?;
    let adjoint = Adjoint::new(mechanism, at)?;
    let direction = directions(mechanism, at)?.nth(input);
    let direction = direction.ok_or(Error::NoSensitivity {
        reason: NoDerivative::UnknownInput,
    })?;
    let along = Along::new(mechanism, at, input, direction);
    let each = wanted.iter();
    each.map(|&what| line((mechanism, &solved), (&adjoint, &along, input), modes, what))
        .collect()
}

fn line(
    (mechanism, solved): (&dyn CurvatureKernels, &Solved<'_>),
    (adjoint, along, input): (&Adjoint<'_>, &Along, usize),
    modes: &[Mode],
    (harmonic, output, measure): (usize, Output, Measure),
) -> Result<Line, Error> {
    let at = solved.at;
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
    let along = slice::from_ref(along);
    let (slopes, rows) = frequency_rows(mechanism, at, adjoint, vibration, along);
    let frequency = Curving {
        value: vibration.harmonic.frequency,
        slopes,
        along: rows.into_iter().next().ok_or(none.clone())?,
    };
    let only = output.index()..output.index() + 1;
    let output_adjoint = OutputAdjoint::each(solved, vibration, only);
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
    let seen = &vibration.seen[output.index()];
    let (forces, mut force) = (
        Forces::of(mechanism, at),
        Vector::zeros(at.coordinates.len()),
    );
    for share in &vibration.harmonic.shares {
        add(&mut force, &forces.force(share.excitation, share.turn()));
    }
    let residue = |mode: &Mode| residue(&at.linear, mode, seen, &force) / y.norm();
    let residues = modes.iter().map(residue).collect();
    let (curved, total) = Curved::new(this_adjoint, adjoint);
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
        residues,
        frequency,
        amplitude,
    })
}

/// `|(c . phi) (psi . f) / psi^T (2 s M + C) phi|`: the size of the residue of `c . D^-1 f` at the pole of a mode; zero
/// where rounding alone makes it differ from that.
fn residue(linear: &Linear, mode: &Mode, seen: &[Complex], force: &[Complex]) -> f64 {
    let product = |x: &[Complex], y: &[Complex]| {
        let terms: f64 = x.iter().zip(y).map(|(x, y)| (x * y).norm()).sum();
        let product = dot_complex(x, y).norm();
        if product > ROUNDING * terms {
            product
        } else {
            0.0
        }
    };
    let (right, left) = (&mode.shape, mode.left());
    match product(seen, right) * product(left, force) {
        0.0 => 0.0,
        reached => {
            let slope = pencil_slope_times(linear, mode.s, right);
            reached / dot_complex(left, &slope).norm()
        }
    }
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
