//! One value of the input: the vibrations there, their derivatives, and the poles around them.

use crate::algebra::Vector;
use crate::equilibrium::{OperatingPoint, solve_into};
use crate::forced::{Line, Measure, Vibration, along_input, resonance};
use crate::kernels::CurvatureKernels;
use crate::modes::{Family, Modes};
use crate::sweep::{Following, Range};
use crate::{Complex, Equilibrium, Error, Input, Output, Watch};

/// Where vibrations are looked for.
pub(super) struct Along<'a> {
    mechanism: &'a dyn CurvatureKernels,
    inputs: &'a [f64],
    design: &'a [f64],
    following: Following,
    input: Input,
    vibrations: &'a [Vibration],
    /// Harmonic, output and measure of each vibration.
    wanted: Vec<(usize, Output, Measure)>,
    pub(super) watch: Watch<'a>,
}

/// The vibrations at one value of the input.
pub(super) struct ResponsePoint {
    pub(super) value: f64,
    pub(super) equilibrium: Equilibrium,
    /// The eigenvalues of the modes, 1/s; empty if only the vibrations were wanted.
    poles: Vec<Complex>,
    pub(super) lines: Vec<Line>,
    pub(super) input: usize,
}

/// One vibration at one value of the input.
#[derive(Clone, Copy)]
pub(super) struct Heard<'a> {
    pub(super) point: &'a ResponsePoint,
    pub(super) line: &'a Line,
}

impl<'a> Along<'a> {
    pub(super) fn new(
        mechanism: &'a dyn CurvatureKernels,
        (inputs, design): (&'a [f64], &'a [f64]),
        following: Following,
        (range, vibrations): (&Range, &'a [Vibration]),
        watch: Watch<'a>,
    ) -> Result<Self, Error> {
        let description = mechanism.description();
        range.check(&description)?;
        let wanted = vibrations.iter().map(|vibration| {
            vibration.check(&description)?;
            let harmonic = vibration.place(&description).ok_or(Error::NoExcitation {
                mechanism: description.name.clone(),
            })?;
            Ok((harmonic, vibration.output, vibration.measure))
        });
        Ok(Self {
            wanted: wanted.collect::<Result<_, Error>>()?,
            input: range.input,
            vibrations,
            mechanism,
            inputs,
            design,
            following,
            watch,
        })
    }

    /// The state at a value of the input, on the branch of the equilibrium `from`, with its poles.
    pub(super) fn state(&self, value: f64, from: &[f64]) -> Result<ResponsePoint, Error> {
        self.solved(value, from, (&self.wanted, true))
    }

    /// Like [`Self::state`], with one vibration and without poles.
    pub(super) fn vibration(
        &self,
        value: f64,
        from: &[f64],
        which: usize,
    ) -> Result<ResponsePoint, Error> {
        self.solved(value, from, (&self.wanted[which..=which], false))
    }

    /// The error for a vibration whose amplitude is infinite next to a state.
    pub(super) fn resonance(&self, which: usize, state: &ResponsePoint) -> Error {
        let with = self.vibrations[which].excitation.index();
        let frequency = state.lines[which].frequency.value;
        resonance(&state.equilibrium, with, frequency)
    }

    fn solved(
        &self,
        value: f64,
        from: &[f64],
        (wanted, poles): (&[(usize, Output, Measure)], bool),
    ) -> Result<ResponsePoint, Error> {
        if self.watch.stopped() {
            return Err(Error::Stopped);
        }
        let mut inputs = Vector::from(self.inputs);
        inputs[self.input.index()] = value;
        let point = OperatingPoint::new(self.mechanism, &inputs, self.design)?;
        let point = point.held_by(&self.following.held);
        point.check_start(from)?;
        let mut at = Equilibrium::blank(&point.description, &inputs, self.design);
        let judged = solve_into(&point, from, self.following.policy, &mut at)
            .map_err(|failure| failure.explain(&point.description))?;
        at.regular()?;
        let mut modes = Modes::empty(Family::of(&at.description), &at.description);
        if poles {
            modes.solve_at(&at, judged)?;
        }
        let of_state = (&at, &modes.modes[..]);
        let lines = along_input(self.mechanism, of_state, wanted, self.input.index())?;
        self.watch.advance(1);
        Ok(ResponsePoint {
            value,
            poles: modes.modes.iter().map(|mode| mode.s).collect(),
            equilibrium: at,
            lines,
            input: self.input.index(),
        })
    }
}

/// The square of the modulus of the amplitude and its derivatives: `A`, `dA/du`, `d2A/du2` with the input `u`.
pub(super) struct Square {
    pub(super) value: f64,
    pub(super) slope: f64,
    pub(super) bend: f64,
}

impl ResponsePoint {
    /// One of its vibrations.
    pub(super) fn heard(&self, which: usize) -> Heard<'_> {
        Heard {
            point: self,
            line: &self.lines[which],
        }
    }
}

impl<'a> Heard<'a> {
    pub(super) fn square(&self) -> Square {
        let (y, u) = (self.line.amplitude.value, self.point.input);
        let dy = self.line.amplitude.slopes.by_input[u];
        let ddy = self.line.amplitude.along.by_input[u];
        Square {
            value: y.norm_sqr(),
            slope: 2.0 * (y.conj() * dy).re,
            bend: 2.0 * (dy.norm_sqr() + (y.conj() * ddy).re),
        }
    }

    /// `dA/db` for each design variable.
    pub(super) fn square_by_design(&self) -> Vector {
        let y = self.line.amplitude.value.conj();
        let slopes = self.line.amplitude.slopes.by_design.iter();
        slopes.map(|dy| 2.0 * (y * dy).re).collect()
    }

    /// `d2A/(du db)` for each design variable.
    pub(super) fn bend_by_design(&self) -> Vector {
        let (y, amplitude) = (self.line.amplitude.value.conj(), &self.line.amplitude);
        let along = amplitude.slopes.by_input[self.point.input].conj();
        let each = amplitude
            .slopes
            .by_design
            .iter()
            .zip(&amplitude.along.by_design);
        each.map(|(dy, ddy)| 2.0 * (along * dy + y * ddy).re)
            .collect()
    }

    /// The derivatives of the modulus by the design, of those of its square.
    pub(super) fn modulus_by_design(&self, square: &Vector) -> Vector {
        let modulus = self.line.amplitude.value.norm();
        square.map(|value| value / (2.0 * modulus))
    }

    /// The derivatives by the design of the square at the peak next to here: as if its place were exact, where a sharp
    /// peak leaves nothing of the digits of its place.
    pub(super) fn top_by_design(&self) -> Vector {
        let square = self.square();
        let off = square.slope / square.bend;
        let pairs = self
            .square_by_design()
            .into_iter()
            .zip(self.bend_by_design());
        pairs.map(|(here, bend)| here - off * bend).collect()
    }

    /// How far a peak here moves with the design.
    pub(super) fn place_by_design(&self) -> Vector {
        let bend = self.square().bend;
        self.bend_by_design().map(|value| -value / bend)
    }

    /// `dw/du`.
    pub(super) fn frequency_slope(&self) -> f64 {
        self.line.frequency.slopes.by_input[self.point.input]
    }

    /// How the poles that are heard here pass `i w` on the way to another state.
    pub(super) fn passages(self, to: Self) -> impl Iterator<Item = Passage> + 'a {
        let [w, w_there] = [self, to].map(|state| state.line.frequency.value);
        let poles = self.point.poles.iter().zip(&self.line.residues);
        let heard = poles.filter(|(s, residue)| **residue > QUIET * s.re.abs());
        heard.map(move |(&s, _)| {
            let there = nearest(s, &to.point.poles);
            let moved = (w - w_there).abs() + (s - there).norm();
            Passage {
                holds: moved <= PART * (Complex::new(0.0, w) - s).norm(),
                known: nearest(there, &self.point.poles) == s,
                off: [w - s.im, w_there - there.im],
                width: s.re.abs().max(there.re.abs()),
            }
        })
    }
}

/// How a pole passes `i w` along a stretch.
pub(super) struct Passage {
    /// The two move relative to each other by a part of their distance only.
    pub(super) holds: bool,
    /// It is the same pole at both ends.
    pub(super) known: bool,
    /// `w - Im s` at both ends.
    pub(super) off: [f64; 2],
    /// The larger `|Re s|`.
    pub(super) width: f64,
}

/// Part of its distance by which a pole may move along a stretch on which it holds.
const PART: f64 = 0.35;
/// Height of a peak, relative to the amplitude beside it, that is none.
const QUIET: f64 = 1e-6;

fn nearest(s: Complex, poles: &[Complex]) -> Complex {
    let mut poles = poles.iter().copied();
    let first = poles.next().unwrap_or(s);
    poles.fold(first, |best, pole| {
        match (pole - s).norm() < (best - s).norm() {
            true => pole,
            false => best,
        }
    })
}
