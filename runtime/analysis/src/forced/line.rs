//! Forced vibration of one output along an input, as finding its peaks takes it, with its derivatives where they are
//! wanted.

use core::slice;

use super::adjoint::OutputAdjoint;
use super::curvature::{Along, Curved, frequency_along, frequency_rows};
use super::forces::Forces;
use super::measure::Measure;
use super::response::{Solved, Vibration, add};
use crate::algebra::{Vector, dot_complex};
use crate::error::NoDerivative;
use crate::kernels::{CurvatureKernels, Linear};
use crate::modes::pencil_slope_times;
use crate::second_order::{Adjoint, joined};
use crate::sensitivity::{Slopes, directions};
use crate::{Complex, Equilibrium, Error, Mode, Output};

/// One output of a harmonic at one value of an input.
pub(crate) struct Line {
    /// The frequency, rad/s, and its derivative along the input.
    pub(crate) frequency: [f64; 2],
    /// The complex amplitude as displacement, velocity or acceleration, and its derivative along the input.
    pub(crate) amplitude: [Complex; 2],
    /// Relative rounding of the amplitude, of the terms that cancel in it.
    pub(crate) rounding: f64,
    /// By mode, the share of the displacement that its pole would have at a distance of 1/s: the size of its residue
    /// over that of the amplitude.
    pub(crate) residues: Vec<f64>,
    /// Whether a mode that is excited and seen is among these, whatever rounding leaves next to its pole.
    reached: bool,
}

impl Line {
    /// Whether it is more than what rounding leaves of an output that sees nothing.
    pub(crate) fn is_audible(&self) -> bool {
        self.reached || self.rounding * ROUNDING < f64::EPSILON
    }
}

/// Total derivatives of a number by every variable, and the derivatives of these along one input.
pub(crate) struct Curving<T> {
    pub(crate) slopes: Slopes<T>,
    pub(crate) along: Slopes<T>,
}

/// How one output of a harmonic changes near one value of an input.
pub(crate) struct CurvingLine {
    pub(crate) frequency: Curving<f64>,
    pub(crate) amplitude: Curving<Complex>,
}

/// Relative rounding that cancelling terms may leave.
const ROUNDING: f64 = 1e-12;
/// Share of the terms in a product with a shape that is more than an error of the shape.
const REACHED: f64 = 1e-6;

/// Outputs of harmonics near one value of an input.
pub(crate) struct Lines<'a> {
    mechanism: &'a dyn CurvatureKernels,
    solved: Solved<'a>,
    along: Along<'a>,
    input: usize,
}

/// A harmonic, an output, and as what it is measured.
pub(crate) type Wanted = (usize, Output, Measure);

impl<'a> Lines<'a> {
    pub(crate) fn new(mechanism: &'a dyn CurvatureKernels, at: &'a Equilibrium, input: usize) -> Result<Self, Error> {
        let direction = directions(mechanism, at)?.nth(input);
        let direction = direction.ok_or(Error::NoSensitivity { reason: NoDerivative::UnknownInput })?;
        Ok(Self { solved: Solved::new(mechanism, at)?, along: Along::new(mechanism, at, direction), mechanism, input })
    }

    /// The vibration that an output is asked of, and its adjoint.
    fn of(&self, (harmonic, output, _): Wanted) -> Result<(&Vibration, OutputAdjoint<'_>), Error> {
        let (solved, at) = (&self.solved, self.solved.at);
        let (Some(vibration), true) =
            (solved.vibrations.get(harmonic), output.index() < self.mechanism.sizes().outputs)
        else {
            return Err(Error::UnknownHandle {
                kind: "output",
                index: output.index(),
                mechanism: at.description.name.clone(),
                count: self.mechanism.sizes().outputs,
            });
        };
        if !solved.smooth[output.index()] {
            let output = at.description.outputs[output.index()].name.clone();
            return Err(Error::NotSmooth { output });
        }
        let only = output.index()..output.index() + 1;
        let mut output_adjoint = OutputAdjoint::each(solved, vibration, only).into_iter();
        let output_adjoint = output_adjoint.next().flatten().ok_or(NOT_SMOOTH)?;
        Ok((vibration, output_adjoint))
    }

    /// One output. Without modes there are no residues.
    pub(crate) fn line(&self, wanted: Wanted, modes: &[Mode]) -> Result<Line, Error> {
        let (mechanism, at) = (self.mechanism, self.solved.at);
        let (vibration, output_adjoint) = self.of(wanted)?;
        let (harmonic, output, measure) = (&vibration.harmonic, wanted.1.index(), wanted.2);
        let y = harmonic.outputs[output].ok_or(NOT_SMOOTH)?;
        let w = harmonic.frequency;
        let dw = frequency_along(mechanism, at, vibration, &self.along);
        let moved = self.along.of(vibration, dw);
        let dy = moved.output(&self.solved, output).ok_or(NOT_SMOOTH)?;
        let terms = terms(&at.linear, w, &output_adjoint.factors.left, &harmonic.unknowns);
        let seen = &vibration.seen[output];
        let (forces, mut force) = (Forces::of(mechanism, at), Vector::zeros(at.coordinates.len()));
        for share in &harmonic.shares {
            add(&mut force, &forces.force(share.excitation, share.turn()));
        }
        let residues: Vec<_> = modes.iter().map(|mode| residue(&at.linear, mode, seen, &force)).collect();
        let amplitude = [measure.of(w, y), measure.slope((w, y), dw, dy)];
        match amplitude.iter().all(|value| value.is_finite()) && dw.is_finite() {
            true => Ok(Line {
                rounding: f64::EPSILON * terms / y.norm(),
                reached: residues.iter().any(|(_, share)| *share > REACHED),
                residues: residues.into_iter().map(|(size, _)| size / y.norm()).collect(),
                frequency: [w, dw],
                amplitude,
            }),
            false => Err(self.solved.not_finite()),
        }
    }

    /// How one output changes.
    pub(crate) fn curving(&self, wanted: Wanted) -> Result<CurvingLine, Error> {
        let (mechanism, at) = (self.mechanism, self.solved.at);
        let adjoint = Adjoint::new(mechanism, at)?;
        let (vibration, output_adjoint) = self.of(wanted)?;
        let (harmonic, measure) = (&vibration.harmonic, wanted.2);
        let y = harmonic.outputs[wanted.1.index()].ok_or(NOT_SMOOTH)?;
        let along = slice::from_ref(&self.along);
        let (slopes, rows) = frequency_rows(mechanism, at, &adjoint, vibration, along);
        let w = Curving { slopes, along: rows.into_iter().next().ok_or(NOT_SMOOTH)? };
        let (curved, total) = Curved::new(output_adjoint, &adjoint);
        let moved = self.along.of(vibration, w.slopes.by_input[self.input]);
        let row = curved.along(mechanism, &moved).ok_or(NOT_SMOOTH)?;
        let slopes = joined(&total).map(|value| -value);
        if !(slopes.iter().chain(row.iter())).all(|value| value.is_finite()) {
            return Err(self.solved.not_finite());
        }
        let by_input = (w.slopes.by_input[self.input], slopes.by_input[self.input]);
        let first = w.slopes.zip(&slopes);
        let second = w.along.zip(&row);
        let value = (harmonic.frequency, y);
        let curvature = |(item, second)| measure.curvature(value, [by_input, item], second);
        Ok(CurvingLine {
            amplitude: Curving {
                along: first.zip(&second).map(curvature),
                slopes: first.map(|(dw, dy)| measure.slope(value, dw, dy)),
            },
            frequency: w,
        })
    }
}

/// What depends on a place that nothing determines, or is infinite.
const NOT_SMOOTH: Error = Error::NoSensitivity { reason: NoDerivative::NotSmooth };

/// `|(c . phi) (psi . f) / psi^T (2 s M + C) phi|`: the size of the residue of `c . D^-1 f` at the pole of a mode; zero
/// where rounding alone makes it differ from that. And the lesser of what is left of the terms in both products, as a share.
fn residue(linear: &Linear, mode: &Mode, seen: &[Complex], force: &[Complex]) -> (f64, f64) {
    let product = |x: &[Complex], y: &[Complex]| {
        let terms: f64 = x.iter().zip(y).map(|(x, y)| (x * y).norm()).sum();
        let product = dot_complex(x, y).norm();
        if product > ROUNDING * terms { (product, product / terms) } else { (0.0, 0.0) }
    };
    let (right, left) = (&mode.shape, mode.left());
    let (seen, force) = (product(seen, right), product(left, force));
    let share = seen.1.min(force.1);
    if share == 0.0 {
        return (0.0, 0.0);
    }
    let slope = pencil_slope_times(linear, mode.s, right);
    (seen.0 * force.0 / dot_complex(left, &slope).norm(), share)
}

/// The sizes of the terms in `p . D z`, whose rounding an output sees.
fn terms(linear: &Linear, w: f64, p: &[Complex], z: &[Complex]) -> f64 {
    let row = |i: usize| {
        let each = z.iter().enumerate();
        let (k, c, m) = (&linear.stiffness[i], &linear.damping[i], &linear.mass[i]);
        each.fold(0.0, |sum, (j, z)| sum + (k[j].abs() + w * (c[j].abs() + w * m[j].abs())) * z.norm())
    };
    let each = p.iter().enumerate();
    each.map(|(i, p)| p.norm() * row(i)).sum()
}
