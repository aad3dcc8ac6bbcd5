//! A forced vibration along an input, as finding its peaks takes it, with its derivatives where they are wanted.

use core::slice;

use super::adjoint::OutputAdjoint;
use super::curvature::{Along, Curved, frequency_along, frequency_rows};
use super::extent::{Extent, Part, each};
use super::forces::Forces;
use super::measure::Measure;
use super::response::{Solved, Vibration as Harmonics, add};
use super::vibration::Vibration;
use crate::algebra::{Vector, dot_complex};
use crate::error::NoDerivative;
use crate::kernels::{CurvatureKernels, Linear};
use crate::second_order::{Adjoint, joined};
use crate::sensitivity::{Slopes, directions, normaliser};
use crate::shafts::ShaftsAlong;
use crate::{Complex, Description, Equilibrium, Error, Mode, Output};

/// A vibration at one value of an input.
pub(crate) struct Line {
    pub(crate) extent: Extent,
    pub(crate) tones: Vec<Tone>,
    /// The complex amplitudes of its parts as displacements, velocities or accelerations, and their derivatives along the
    /// input.
    pub(crate) amplitudes: [Vec<Complex>; 2],
    /// Relative rounding, of the terms that cancel in it.
    pub(crate) rounding: f64,
    /// Whether a mode that is excited and seen is among these, whatever rounding leaves next to its pole.
    reached: bool,
}

/// What a vibration contains of one frequency.
pub(crate) struct Tone {
    /// The frequency, rad/s, and its derivative along the input.
    pub(crate) frequency: [f64; 2],
    /// By mode, the share of the vibration that its pole would have at a distance of 1/s: the size of its residue over all.
    pub(crate) residues: Vec<f64>,
}

impl Line {
    /// Whether it is more than what rounding leaves of an output that sees nothing.
    pub(crate) fn is_audible(&self) -> bool {
        self.reached || self.rounding * ROUNDING < f64::EPSILON
    }

    /// The position of the tone that is loudest.
    pub(crate) fn loudest(&self) -> usize {
        let (k, _) = self.amplitudes[0]
            .iter()
            .map(|y| y.norm())
            .enumerate()
            .fold((0, 0.0), |most, own| if own.1 > most.1 { own } else { most });
        k.min(self.tones.len() - 1)
    }
}

/// Total derivatives of a number by every variable, and the derivatives of these along one input.
pub(crate) struct Curving<T> {
    pub(crate) slopes: Slopes<T>,
    pub(crate) along: Slopes<T>,
}

/// How a vibration changes near one value of an input: its frequencies, by tone, and its parts.
pub(crate) struct CurvingLine {
    pub(crate) frequencies: Vec<Curving<f64>>,
    pub(crate) amplitudes: Vec<Curving<Complex>>,
}

/// Relative rounding that cancelling terms may leave.
const ROUNDING: f64 = 1e-12;
/// Share of the terms in a product with a shape that is more than an error of the shape.
const REACHED: f64 = 1e-6;

/// Vibrations near one value of an input.
pub(crate) struct Lines<'a> {
    mechanism: &'a dyn CurvatureKernels,
    solved: Solved<'a>,
    along: Along<'a>,
    input: usize,
    /// What shafts add to each harmonic.
    shafts: Vec<Option<ShaftsAlong<'a>>>,
}

/// A vibration, what it is made of, and the harmonics and outputs in that.
pub(crate) struct Wanted {
    pub(crate) vibration: Vibration,
    parts: Vec<Part>,
    terms: Vec<(usize, Output)>,
}

impl Wanted {
    pub(crate) fn new(vibration: Vibration, of: &Description) -> Result<Self, Error> {
        vibration.check(of)?;
        let parts = vibration.parts(of).ok_or_else(|| Error::NoExcitation { mechanism: of.name.clone() })?;
        let mut terms = Vec::new();
        for part in &parts {
            let new = part.terms.iter().map(|(output, _)| (part.harmonic, *output));
            terms.extend(new.filter(|own| !terms.contains(own)).collect::<Vec<_>>());
        }
        Ok(Self { vibration, parts, terms })
    }

    /// The parts, from the values of the terms.
    fn parts<T>(&self, values: &[T], of: impl Fn(&T) -> Complex) -> Vec<Complex> {
        let part = |part: &Part| {
            let place = |output| self.terms.iter().position(|own| *own == (part.harmonic, output));
            part.of(|output| place(output).map(|k| of(&values[k]))).unwrap_or_default()
        };
        self.parts.iter().map(part).collect()
    }
}

/// One output of a harmonic at one value of an input.
struct Term {
    frequency: [f64; 2],
    amplitude: [Complex; 2],
    /// The terms whose rounding it sees.
    terms: f64,
    /// The size of its residue at the pole of each mode, and how much of it is more than an error of the shape.
    residues: Vec<(f64, f64)>,
}

impl<'a> Lines<'a> {
    pub(crate) fn new(mechanism: &'a dyn CurvatureKernels, at: &'a Equilibrium, input: usize) -> Result<Self, Error> {
        let direction = directions(mechanism, at)?.nth(input);
        let direction = direction.ok_or(Error::NoSensitivity { reason: NoDerivative::UnknownInput })?;
        let solved = Solved::new(mechanism, at)?;
        let of_shafts = |own: &Harmonics| ShaftsAlong::of(mechanism, at, own.harmonic.s());
        let shafts = solved.vibrations.iter().map(of_shafts).collect::<Result<_, Error>>()?;
        Ok(Self { solved, along: Along::new(mechanism, at, (input, direction)), mechanism, input, shafts })
    }

    /// The vibration that an output is asked of, and its adjoint.
    fn of(&self, (harmonic, output): (usize, Output)) -> Result<(&Harmonics, OutputAdjoint<'_>), Error> {
        let (solved, at) = (&self.solved, self.solved.at);
        let vibration = solved.vibrations.get(harmonic).ok_or(NOT_SMOOTH)?;
        if !solved.smooth[output.index()] {
            let output = at.description.outputs[output.index()].name.clone();
            return Err(Error::NotSmooth { output });
        }
        let only = output.index()..output.index() + 1;
        let mut output_adjoint = OutputAdjoint::each(solved, vibration, only).into_iter();
        let output_adjoint = output_adjoint.next().flatten().ok_or(NOT_SMOOTH)?;
        Ok((vibration, output_adjoint))
    }

    /// A vibration. Without modes there are no residues.
    pub(crate) fn line(&self, wanted: &Wanted, modes: &[Mode]) -> Result<Line, Error> {
        let extent = wanted.vibration.extent;
        let terms = wanted.terms.iter().map(|term| self.term(*term, wanted.vibration.measure, modes));
        let terms = terms.collect::<Result<Vec<_>, Error>>()?;
        let amplitudes = [0, 1].map(|k| wanted.parts(&terms, |term| term.amplitude[k]));
        let all = extent.value(&amplitudes[0]);
        let mut tones: Vec<Tone> = Vec::new();
        for (k, ((harmonic, _), term)) in wanted.terms.iter().zip(&terms).enumerate() {
            let residues = term.residues.iter().map(|(size, _)| size / all);
            match tones.last_mut() {
                Some(tone) if wanted.terms[k - 1].0 == *harmonic => {
                    tone.residues.iter_mut().zip(residues).for_each(|(sum, size)| *sum += size);
                }
                _ => tones.push(Tone { frequency: term.frequency, residues: residues.collect() }),
            }
        }
        Ok(Line {
            rounding: f64::EPSILON * terms.iter().map(|term| term.terms).sum::<f64>() / all,
            reached: terms.iter().flat_map(|term| &term.residues).any(|(_, share)| *share > REACHED),
            tones,
            amplitudes,
            extent,
        })
    }

    fn term(&self, (harmonic, output): (usize, Output), measure: Measure, modes: &[Mode]) -> Result<Term, Error> {
        let (mechanism, at, shafts) = (self.mechanism, self.solved.at, self.shafts[harmonic].as_ref());
        let (vibration, output_adjoint) = self.of((harmonic, output))?;
        let (harmonic, output) = (&vibration.harmonic, output.index());
        let y = harmonic.outputs[output].ok_or(NOT_SMOOTH)?;
        let w = harmonic.frequency;
        let dw = frequency_along(mechanism, at, vibration, &self.along);
        let dy = self.along.of((vibration, shafts), dw).output(&self.solved, output).ok_or(NOT_SMOOTH)?;
        let seen = &vibration.seen[output];
        let (forces, mut force) = (Forces::of(mechanism, at), Vector::zeros(at.coordinates.len()));
        for share in &harmonic.shares {
            add(&mut force, &forces.force(share.excitation, share.turn()));
        }
        let scale = measure.of(w, Complex::new(1.0, 0.0)).norm();
        let residues = modes.iter().map(|mode| {
            let (size, share) = residue(&self.solved, mode, seen, &force);
            (scale * size, share)
        });
        let amplitude = [measure.of(w, y), measure.slope((w, y), dw, dy)];
        if amplitude.iter().all(|value| value.is_finite()) && dw.is_finite() {
            Ok(Term {
                terms: scale * terms(&at.linear, w, &output_adjoint.factors.left, &harmonic.unknowns),
                residues: residues.collect(),
                frequency: [w, dw],
                amplitude,
            })
        } else {
            Err(self.solved.not_finite())
        }
    }

    /// How a vibration changes.
    pub(crate) fn curving(&self, wanted: &Wanted) -> Result<CurvingLine, Error> {
        let all = wanted.terms.iter().map(|term| self.curving_term(*term, wanted.vibration.measure));
        let (frequencies, all): (Vec<_>, Vec<_>) = all.collect::<Result<Vec<_>, Error>>()?.into_iter().unzip();
        let (slopes, along): (Vec<_>, Vec<_>) = all.into_iter().map(|own| (own.slopes, own.along)).unzip();
        let part = |k: usize, all: &[Slopes<Complex>]| each(all, |values| wanted.parts(values, |y| *y)[k]);
        let amplitudes = (0..wanted.parts.len()).map(|k| Curving { slopes: part(k, &slopes), along: part(k, &along) });
        let first = |(k, _): &(usize, _)| *k == 0 || wanted.terms[*k].0 != wanted.terms[*k - 1].0;
        let tones = frequencies.into_iter().enumerate().filter(first);
        Ok(CurvingLine { amplitudes: amplitudes.collect(), frequencies: tones.map(|(_, own)| own).collect() })
    }

    fn curving_term(&self, term: (usize, Output), measure: Measure) -> Result<(Curving<f64>, Curving<Complex>), Error> {
        let (mechanism, at) = (self.mechanism, self.solved.at);
        let adjoint = Adjoint::new(mechanism, at)?;
        let (vibration, output_adjoint) = self.of(term)?;
        let shafts = self.shafts[term.0].as_ref();
        let harmonic = &vibration.harmonic;
        let y = harmonic.outputs[term.1.index()].ok_or(NOT_SMOOTH)?;
        let along = slice::from_ref(&self.along);
        let (slopes, rows) = frequency_rows(mechanism, at, &adjoint, vibration, along);
        let w = Curving { slopes, along: rows.into_iter().next().ok_or(NOT_SMOOTH)? };
        let (curved, total) = Curved::new((output_adjoint, shafts), &adjoint);
        let moved = self.along.of((vibration, shafts), w.slopes.by_input[self.input]);
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
        let amplitude = Curving {
            along: first.zip(&second).map(curvature),
            slopes: first.map(|(dw, dy)| measure.slope(value, dw, dy)),
        };
        Ok((w, amplitude))
    }
}

/// What depends on a place that nothing determines, or is infinite.
const NOT_SMOOTH: Error = Error::NoSensitivity { reason: NoDerivative::NotSmooth };

/// `|(c . phi) (psi . f) / psi^T (2 s M + C) phi|`: the size of the residue of `c . D^-1 f` at the pole of a mode; zero
/// where rounding alone makes it differ from that. And the lesser of what is left of the terms in both products, as a share.
fn residue(solved: &Solved<'_>, mode: &Mode, seen: &[Complex], force: &[Complex]) -> (f64, f64) {
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
    let below = normaliser(solved.at, solved.shafts.as_deref(), mode);
    (seen.0 * force.0 / below.norm(), share)
}

/// The sizes of the terms in `p . D z`, whose rounding an output sees.
fn terms(linear: &Linear, w: f64, p: &[Complex], z: &[Complex]) -> f64 {
    let row = |i: usize| {
        let each = z.iter().enumerate();
        let (k, c, m) = (&linear.stiffness[i], &linear.damping[i], &linear.mass[i]);
        each.fold(0.0, |sum, (j, z)| sum + (k[j].abs() + w * (c[j].abs() + w * m[j].abs())) * z.norm())
    };
    p.iter().enumerate().map(|(i, p)| p.norm() * row(i)).sum()
}
