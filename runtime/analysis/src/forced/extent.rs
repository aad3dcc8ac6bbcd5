//! What of one or several complex amplitudes counts: a modulus, a semi-axis of an orbit, a sum over frequencies.

use crate::sensitivity::Slopes;
use crate::{Complex, Output};

/// What of a vibration counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Extent {
    /// The amplitude under all excitations that have one frequency, 0 to peak.
    #[default]
    Amplitude,
    /// Half of the longest diameter of the orbit with another output, which should be perpendicular to this one.
    Major(Output),
    /// Half of the shortest diameter of that orbit.
    Minor(Output),
    /// The sum of the amplitudes of all frequencies, which the output reaches if their peaks ever meet.
    Sum,
    /// The root of the mean square of the output under all excitations.
    Rms,
}

/// A linear combination of the outputs of one harmonic.
pub(crate) struct Part {
    pub(crate) harmonic: usize,
    pub(crate) terms: Vec<(Output, Complex)>,
}

/// Share of all that counts as zero where a modulus has a kink: rounding of amplitudes near a resonance.
const STILL: f64 = 1e-10;

impl Part {
    /// Its value, from that of an output.
    pub(crate) fn of(&self, output: impl Fn(Output) -> Option<Complex>) -> Option<Complex> {
        self.terms.iter().try_fold(Complex::ZERO, |sum, (own, factor)| Some(sum + factor * output(*own)?))
    }
}

/// Numbers that belong together, side by side.
pub(super) fn each<T: Copy + Default, R: Copy + Default>(all: &[Slopes<T>], f: impl Fn(&[T]) -> R) -> Slopes<R> {
    let row = |of: fn(&Slopes<T>) -> &[T]| {
        let one = |k: usize| f(&all.iter().map(|slopes| of(slopes)[k]).collect::<Vec<_>>());
        (0..all.first().map_or(0, |first| of(first).len())).map(one).collect()
    };
    Slopes { by_input: row(|slopes| &slopes.by_input), by_design: row(|slopes| &slopes.by_design) }
}

/// The value of an extent and its derivatives from those of its parts, which are not numbers where it has none: at a circle
/// or a straight line that a variable turns into an ellipse.
impl Extent {
    /// The sign of the modulus of each part; `None` where squares are summed.
    fn sign(self, part: usize, y: &[Complex]) -> Option<f64> {
        match self {
            Self::Rms => None,
            Self::Minor(_) => {
                let turn = if y[0].norm() < y[1].norm() { -1.0 } else { 1.0 };
                Some(if part == 0 { turn } else { -turn })
            }
            _ => Some(1.0),
        }
    }

    fn sum(self, y: &[Complex], modulus: impl Fn(usize) -> f64, product: impl Fn(usize) -> f64) -> f64 {
        let one = |k: usize| match self.sign(k, y) {
            Some(sign) => sign * modulus(k),
            None => product(k),
        };
        (0..y.len()).map(one).sum()
    }

    pub(crate) fn value(self, y: &[Complex]) -> f64 {
        let sum = self.sum(y, |k| y[k].norm(), |k| 0.5 * y[k].norm_sqr());
        if self == Self::Rms { sum.sqrt() } else { sum }
    }

    pub(crate) fn slope(self, y: &[Complex], dy: &[Complex]) -> f64 {
        let modulus = |k: usize| match (still(y, k), still(dy, k)) {
            (false, _) => y[k].norm() * (dy[k] / y[k]).re,
            (true, true) if y.len() > 1 => 0.0,
            _ => f64::NAN,
        };
        let sum = self.sum(y, modulus, |k| 0.5 * (y[k].conj() * dy[k]).re);
        match self {
            Self::Rms => sum / self.value(y),
            Self::Minor(_) if self.value(y) <= STILL * size(y) => {
                if sum.abs() <= STILL * size(dy) {
                    0.0
                } else {
                    f64::NAN
                }
            }
            _ => sum,
        }
    }

    pub(crate) fn curvature(self, y: &[Complex], [a, b]: [&[Complex]; 2], ab: &[Complex]) -> f64 {
        let product = |k: usize| (a[k].conj() * b[k] + y[k].conj() * ab[k]).re;
        let modulus = |k: usize| match still(y, k) {
            false => (product(k) - y[k].norm_sqr() * (a[k] / y[k]).re * (b[k] / y[k]).re) / y[k].norm(),
            true if y.len() > 1 && [a, b, ab].iter().all(|x| still(x, k)) => 0.0,
            true => f64::NAN,
        };
        let sum = self.sum(y, modulus, |k| 0.5 * product(k));
        match self {
            Self::Rms => (sum - self.slope(y, a) * self.slope(y, b)) / self.value(y),
            // Where first derivatives exist, on a straight line that stays one.
            Self::Minor(_) if self.value(y) <= STILL * size(y) => 0.0 * (self.slope(y, a) + self.slope(y, b)),
            _ => sum,
        }
    }

    /// The derivative of the square, which is smooth where an amplitude vanishes.
    pub(crate) fn square_slope(self, y: &[Complex], dy: &[Complex]) -> f64 {
        match self {
            Self::Amplitude => 2.0 * (y[0].conj() * dy[0]).re,
            _ => 2.0 * self.value(y) * self.slope(y, dy),
        }
    }

    /// The second derivative of the square.
    pub(crate) fn square_curvature(self, y: &[Complex], [a, b]: [&[Complex]; 2], ab: &[Complex]) -> f64 {
        match self {
            Self::Amplitude => 2.0 * (a[0].conj() * b[0] + y[0].conj() * ab[0]).re,
            _ => 2.0 * (self.slope(y, a) * self.slope(y, b) + self.value(y) * self.curvature(y, [a, b], ab)),
        }
    }

    /// The phase of an amplitude, rad; a sum of several has none.
    pub(crate) fn phase(self, y: &[Complex]) -> Option<f64> {
        (self == Self::Amplitude).then(|| y[0].arg())
    }
}

/// Whether one of these is nothing but rounding of the others.
fn still(y: &[Complex], k: usize) -> bool {
    y[k].norm() <= if y.len() > 1 { STILL * size(y) } else { 0.0 }
}

fn size(y: &[Complex]) -> f64 {
    y.iter().map(|y| y.norm()).sum()
}
