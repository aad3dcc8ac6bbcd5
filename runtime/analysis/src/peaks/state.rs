//! One value of the input: the vibration there, its derivatives, and the poles around it.

use crate::algebra::Vector;
use crate::equilibrium::{Held, OperatingPoint, Policy, solve_into};
use crate::forced::{Line, Vibration, along_input};
use crate::kernels::CurvatureKernels;
use crate::modes::modes;
use crate::sweep::{Following, Range};
use crate::{Complex, Equilibrium, Error, Input};

/// Where a vibration is looked for.
pub(super) struct Along<'a> {
    pub(super) mechanism: &'a dyn CurvatureKernels,
    pub(super) inputs: &'a [f64],
    pub(super) design: &'a [f64],
    pub(super) policy: Policy,
    pub(super) held: Vec<Held>,
    pub(super) input: Input,
    pub(super) vibration: Vibration,
    pub(super) harmonic: usize,
}

/// The vibration at one value of the input.
pub(super) struct ResponsePoint {
    pub(super) value: f64,
    pub(super) equilibrium: Equilibrium,
    /// The eigenvalues of the modes, 1/s.
    pub(super) poles: Vec<Complex>,
    /// The equilibrium is stable, and no mode grows.
    pub(super) stable: bool,
    pub(super) line: Line,
    input: usize,
}

impl<'a> Along<'a> {
    pub(super) fn new(
        mechanism: &'a dyn CurvatureKernels,
        (inputs, design): (&'a [f64], &'a [f64]),
        following: Following,
        (range, vibration): (Range, Vibration),
    ) -> Result<Self, Error> {
        let description = mechanism.description();
        range.check(&description)?;
        vibration.check(&description)?;
        let harmonic = vibration.place(&description).ok_or(Error::NoExcitation {
            mechanism: description.name.clone(),
        })?;
        Ok(Self {
            mechanism,
            inputs,
            design,
            policy: following.policy,
            held: following.held,
            input: range.input,
            vibration,
            harmonic,
        })
    }

    /// The state at a value of the input, on the branch of the equilibrium `from`.
    pub(super) fn state(&self, value: f64, from: &[f64]) -> Result<ResponsePoint, Error> {
        let mut inputs = Vector::from(self.inputs);
        inputs[self.input.index()] = value;
        let point = OperatingPoint::new(self.mechanism, &inputs, self.design)?.held_by(&self.held);
        point.check_start(from)?;
        let mut at = Equilibrium::blank(&point.description, &inputs, self.design);
        solve_into(&point, from, self.policy, &mut at)
            .map_err(|failure| failure.explain(&point.description))?;
        let (output, measure) = (self.vibration.output, self.vibration.measure);
        let what = (self.harmonic, output, measure);
        let line = along_input(self.mechanism, &at, what, self.input.index())?;
        let modes = modes(&at)?;
        Ok(ResponsePoint {
            value,
            poles: modes.modes.iter().map(|mode| mode.s).collect(),
            stable: at.stability.holds() && modes.stable(),
            equilibrium: at,
            line,
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
    pub(super) fn square(&self) -> Square {
        let (y, u) = (self.line.amplitude.value, self.input);
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
        let along = amplitude.slopes.by_input[self.input].conj();
        let each = amplitude
            .slopes
            .by_design
            .iter()
            .zip(&amplitude.along.by_design);
        each.map(|(dy, ddy)| 2.0 * (along * dy + y * ddy).re)
            .collect()
    }

    /// The derivatives of the modulus by the design.
    pub(super) fn modulus_by_design(&self) -> Vector {
        let modulus = self.line.amplitude.value.norm();
        let square = self.square_by_design();
        square.map(|value| value / (2.0 * modulus))
    }

    /// How far a peak here moves with the design.
    pub(super) fn place_by_design(&self) -> Vector {
        let bend = self.square().bend;
        self.bend_by_design().map(|value| -value / bend)
    }

    /// `dw/du`.
    pub(super) fn frequency_slope(&self) -> f64 {
        self.line.frequency.slopes.by_input[self.input]
    }

    /// Distance between `i w` and the nearest pole.
    pub(super) fn distance(&self) -> f64 {
        let s = Complex::new(0.0, self.line.frequency.value);
        nearest(s, &self.poles)
    }

    /// How far the poles and `i w` move relative to each other on the way to another state.
    pub(super) fn moved(&self, other: &Self) -> f64 {
        let most = |from: &Self, to: &Self| {
            let each = from.poles.iter().map(|s| nearest(*s, &to.poles));
            each.fold(0.0, f64::max)
        };
        let poles = most(self, other).max(most(other, self));
        (self.line.frequency.value - other.line.frequency.value).abs() + poles
    }
}

fn nearest(s: Complex, poles: &[Complex]) -> f64 {
    let each = poles.iter().map(|pole| (s - pole).norm());
    each.fold(f64::INFINITY, f64::min)
}
