//! Peaks of a forced vibration along an input: where, how high, how wide, with exact derivatives by the design.
//!
//! At a peak of `A(u, b) = |y|^2` along the input `u`, `A_u = 0`, so `du/db = -A_ub / A_uu`; its height follows the
//! design as if the place were fixed. Half-power points, `A = A_peak / 2`, move by `(dA_peak / 2 - A_b) / A_u`. All
//! derivatives are total: equilibrium and frequency follow the variables.

mod answer;
mod highest;
mod scan;
mod separation;
mod state;

pub use highest::PeakQuantity;
pub(crate) use highest::highest;
pub use separation::{Separation, SeparationMargin};

use scan::{Scan, scan};
use state::{Along, Curve, Heard, Square};

use crate::algebra::Vector;
use crate::forced::Vibration;
use crate::kernels::CurvatureKernels;
use crate::sweep::{Following, Gap, Range};
use crate::tolerance::{Spread, Tolerances};
use crate::{Description, Equilibrium, Error, Shared, Watch};

/// The peaks of a vibration along an input.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Peaks {
    /// The vibration.
    pub vibration: Vibration,
    /// The range that was searched.
    pub range: Range,
    /// The peaks, in the order in which the range passes them.
    pub peaks: Vec<Peak>,
    /// Stretches without an equilibrium or a vibration.
    pub gaps: Vec<Gap>,
    /// Number of states solved to find them.
    pub states: usize,
    /// Number of standard deviations that a tolerance and a band represent; `None` without tolerances.
    pub sigma_level: Option<f64>,
    /// The inputs, SI; all but the varied one keep their values.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

/// A local maximum of the modulus of a vibration along an input.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Peak {
    /// The value of the input, SI.
    pub place: Moving,
    /// The frequency there, of several that which is loudest, rad/s.
    pub frequency: Moving,
    /// The modulus, 0 to peak, or what of the vibration counts, in the unit of the measured output (SI).
    pub height: Moving,
    /// The phase of an amplitude, rad; `None` for what is made of several.
    pub phase: Option<f64>,
    /// Where the modulus is `1/sqrt 2` of the height, before and after the peak.
    pub half_power: [HalfPower; 2],
    /// Amplification factor: the frequency at the peak over the difference of those at the half-power points. `None`
    /// if one of these is missing, or the frequency does not follow the input.
    pub amplification: Option<Moving>,
    /// The equilibrium there.
    pub equilibrium: Equilibrium,
    /// Whether that is stable. Elsewhere no machine stays in this vibration.
    pub stable: bool,
}

/// A point beside a peak at which the power is half of that at the peak.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum HalfPower {
    /// The value of the input, SI.
    At(Box<Moving>),
    /// The range, or the stretch without gaps, ends before.
    EndOfRange,
    /// The amplitude rises again before.
    RisesAgain,
}

/// Values on either side of a peak between which its curve is drawn.
const BENDS: u32 = 16;

impl Peaks {
    /// Values of the input, SI, about each peak that has half-power points: in equal steps of the angle about the centre of
    /// the circle that the complex amplitude of a single mode runs through.
    #[must_use]
    pub fn bends(&self) -> Vec<f64> {
        let ends = [self.range.low.min(self.range.high), self.range.low.max(self.range.high)];
        let about = self.peaks.iter().flat_map(|peak| {
            let top = peak.place.value;
            let widths = peak.half_power.iter().filter_map(|half| Some((half.place()?.value - top).abs()));
            let width = widths.reduce(f64::min).unwrap_or(0.0);
            (1..=BENDS).flat_map(move |k| {
                let step = width * (f64::from(k) * core::f64::consts::FRAC_PI_2 / f64::from(BENDS + 1)).tan();
                [top - step, top + step]
            })
        });
        about.filter(|value| (ends[0]..=ends[1]).contains(value)).collect()
    }
}

impl HalfPower {
    /// The value of the input, if there is one.
    #[must_use]
    pub fn place(&self) -> Option<&Moving> {
        match self {
            Self::At(at) => Some(at),
            Self::EndOfRange | Self::RisesAgain => None,
        }
    }
}

/// A number that moves with the design.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Moving {
    /// Its value, SI.
    pub value: f64,
    /// Its total derivatives by the design variables, per SI unit; empty if the peak is so narrow that rounding decides
    /// them, or has none, as a circle that a variable makes an ellipse.
    pub by_design: Vector,
    /// Its spread to first order, if tolerances were given and the derivatives are known.
    pub spread: Option<Spread>,
}

impl Moving {
    /// `value`, which moves `slope` times as far.
    fn scaled(&self, slope: f64, value: f64) -> Self {
        let mean = |x: f64| value + slope * (x - self.value);
        let spread = self.spread.as_ref();
        Self {
            value,
            by_design: self.by_design.map(|x| slope * x),
            spread: spread.map(|spread| spread.scaled(slope, mean(spread.mean))),
        }
    }

    fn new(value: f64, by_design: Vector, tolerances: Option<&Tolerances>) -> Self {
        if !by_design.iter().all(|slope| slope.is_finite()) {
            return Self { value, by_design: Vector::default(), spread: None };
        }
        let spread = tolerances.map(|tolerance| Spread::new(value, by_design.clone(), tolerance));
        Self { value, by_design, spread }
    }

    /// Without derivatives if rounding decides them: `doubt` is an error of relative changes of this number with the design.
    fn unless_rounding(self, doubt: f64, design: &[f64]) -> Self {
        let change =
            self.by_design.iter().zip(design).map(|(slope, value)| slope * value).map(|x| x * x).sum::<f64>().sqrt();
        if doubt * self.value.abs() <= KNOWN * change + STILL * self.value.abs() {
            self
        } else {
            Self { value: self.value, by_design: Vector::default(), spread: None }
        }
    }
}

/// Finds every peak of some vibrations in a range of an input, along the followed equilibria, from one at `start`. Progress
/// counts states.
///
/// Peaks do not depend on the steps of the range: it is divided according to the distance of the poles from the
/// frequency, until no peak can hide.
///
/// # Errors
/// [`Error::UnknownHandle`], [`Error::Setting`], [`Error::NoExcitation`], [`Error::WrongLength`] for tolerances of another
/// mechanism, [`Error::Stopped`], and the reason why there is no vibration in the whole range. A stretch without one is a
/// gap, such as where an undamped mode is driven at its natural frequency ([`Error::Resonance`]): the peak there is
/// infinite.
pub fn peaks(
    mechanism: &dyn CurvatureKernels,
    (u, b): (&[f64], &[f64]),
    start: &[f64],
    following: impl Into<Following>,
    (range, vibrations): (Range, &[Vibration]),
    tolerances: Option<&Tolerances>,
    watch: Watch<'_>,
) -> Result<Vec<Peaks>, Error> {
    if let Some(tolerances) = tolerances {
        tolerances.check_count(b.len())?;
    }
    let of = (&range, vibrations);
    let along = Along::new(mechanism, (u, b), following.into(), of, watch)?;
    let scanned = scan(&along, &range, start)?;
    let each = vibrations.iter().enumerate().map(|(which, vibration)| {
        let search = Search { along: &along, scan: &scanned, ascending: range.high > range.low, tolerances, which };
        let peaks = search.tops()?.into_iter().map(|(k, top)| search.peak(k, top));
        Ok(Peaks {
            vibration: *vibration,
            range,
            peaks: peaks.collect::<Result<_, Error>>()?,
            states: scanned.states.len(),
            gaps: scanned.gaps.clone(),
            sigma_level: tolerances.map(Tolerances::sigma_level),
            inputs: u.into(),
            description: mechanism.description(),
        })
    });
    each.collect()
}

/// The search for what lies between the states of a scan.
struct Search<'a> {
    along: &'a Along<'a>,
    scan: &'a Scan,
    ascending: bool,
    tolerances: Option<&'a Tolerances>,
    /// The vibration.
    which: usize,
}

/// A half-power point, and its frequency with the derivatives by the design.
struct Half {
    place: Moving,
    frequency: (f64, Vector),
}

/// Share of the length of its features below which a step of Newton's method leaves nothing but rounding.
const EXACT: f64 = 1e-8;
/// Most steps of a search for a zero.
const STEPS: usize = 80;
/// Relative error of the derivatives of height and width up to which they are known.
const KNOWN: f64 = 0.05;
/// Relative change of a number that is none: one that does not depend on the design is known not to.
const STILL: f64 = 1e-9;

impl Search<'_> {
    /// Whether the amplitude rises along the range.
    fn rises(&self, state: Heard<'_>) -> bool {
        let slope = state.square().slope;
        if self.ascending { slope > 0.0 } else { slope < 0.0 }
    }

    /// A state of the scan.
    fn state(&self, k: usize) -> Heard<'_> {
        self.scan.states[k].heard(self.which)
    }

    /// The peaks, and the number of the state after each.
    fn tops(&self) -> Result<Vec<(usize, Curve)>, Error> {
        let mut tops = Vec::new();
        for k in 1..self.scan.states.len() {
            let [a, b] = [k - 1, k].map(|k| self.state(k));
            let rises = self.rises(a) && !self.rises(b);
            if rises && !self.scan.after_gap.contains(&k) && a.line.is_audible() {
                tops.push((k, self.level([a, b])?));
            }
        }
        Ok(tops)
    }

    /// Where the amplitude is stationary between two states with opposite slopes.
    fn level(&self, ends: [Heard<'_>; 2]) -> Result<Curve, Error> {
        let slopes = ends.map(|end| end.square().slope);
        self.zero(ends, slopes, |value, from| {
            let curve = self.along.curve(value, from, self.which)?;
            let Square { value, slope } = curve.heard().square();
            let jet = [slope, curve.bend(), (value / curve.bend()).abs().sqrt()];
            let coordinates = curve.point.equilibrium.coordinates.clone();
            Ok((curve, jet, coordinates))
        })
    }

    /// The zero of a function between two states at which it has opposite signs; `solve` returns a state, the function
    /// with its derivative and the length of its features, and the coordinates: Newton's steps as long as they stay
    /// between the signs and shrink, else halves.
    fn zero<P>(
        &self,
        ends: [Heard<'_>; 2],
        at_ends: [f64; 2],
        solve: impl Fn(f64, &[f64]) -> Result<(P, [f64; 3], Vector), Error>,
    ) -> Result<P, Error> {
        let [mut low, mut high] = ends.map(|end| end.point.value);
        let positive = at_ends[0] > 0.0;
        let (mut last, mut newton_led) = (high - low, false);
        let mut value = low + (high - low) * at_ends[0] / (at_ends[0] - at_ends[1]);
        let mut from = ends[0].point.equilibrium.coordinates.clone();
        for left in (0..STEPS).rev() {
            let (state, [f, df, length], coordinates) = solve(value, &from)?;
            if (f > 0.0) == positive {
                low = value;
            } else {
                high = value;
            }
            let enough = 4.0 * f64::EPSILON * value.abs();
            let newton = value - f / df;
            let exact = newton_led && last.abs() <= EXACT * length.abs();
            let narrow = (f / df).abs().min((high - low).abs()) <= enough;
            let found = f == 0.0 || exact || narrow;
            if found || left == 0 {
                return Ok(state);
            }
            let between = (newton - low) * (high - newton) > 0.0;
            newton_led = between && (newton - value).abs() <= 0.5 * last.abs();
            let next = if newton_led { newton } else { 0.5 * (low + high) };
            (last, value, from) = (next - value, next, coordinates);
        }
        solve(value, &from).map(|found| found.0)
    }

    /// The peak in the stretch before state `k`.
    fn peak(&self, k: usize, top: Curve) -> Result<Peak, Error> {
        let at = self.along.judged(&top.point)?;
        let stable = at.stability.holds();
        let line = top.heard().line;
        let place = top.place_by_design();
        let (frequency, by_design) = top.frequency(line.loudest(), &place);
        let before = self.half_power(&top, (0..k).rev())?;
        let after = self.half_power(&top, k..self.scan.states.len())?;
        let moving = |value, by_design| Moving::new(value, by_design, self.tolerances);
        let doubt = top.doubt(&at.design);
        let height = moving(top.heard().height(), top.height_by_design(&top.top_by_design()));
        let factor = match (&before, &after) {
            (Ok(a), Ok(b)) => amplification((frequency, &by_design), [a, b]),
            _ => None,
        };
        let amplification = factor.map(|(value, slopes)| moving(value, slopes).unless_rounding(doubt, &at.design));
        let half_power = [before, after].map(|side| match side {
            Ok(half) => HalfPower::At(half.place.into()),
            Err(missing) => missing,
        });
        Ok(Peak {
            place: moving(top.point.value, place),
            height: height.unless_rounding(doubt, &at.design),
            frequency: moving(frequency, by_design),
            phase: line.extent.phase(&line.amplitudes[0]),
            half_power,
            amplification,
            stable,
            equilibrium: at,
        })
    }

    /// The half-power point on the way from a peak along these states, or why there is none.
    fn half_power(&self, top: &Curve, way: impl Iterator<Item = usize>) -> Result<Result<Half, HalfPower>, Error> {
        let half = 0.5 * top.heard().square().value;
        let mut last = top.heard();
        for (count, k) in way.enumerate() {
            let next = self.state(k);
            let [from, to, at] = [last.point, next.point, &top.point].map(|point| point.value);
            let up = (to - at) * next.square().slope > 0.0;
            let onwards = (to > from) == self.ascending;
            let gap = if onwards { k } else { k + 1 };
            if count > 0 && self.scan.after_gap.contains(&gap) {
                break;
            }
            if next.square().value <= half {
                return self.half(top, half, [last, next]).map(Ok);
            }
            if up {
                let lowest = self.level([last, next])?;
                if lowest.heard().square().value > half {
                    return Ok(Err(HalfPower::RisesAgain));
                }
                return self.half(top, half, [last, lowest.heard()]).map(Ok);
            }
            last = next;
        }
        Ok(Err(HalfPower::EndOfRange))
    }

    fn half(&self, top: &Curve, half: f64, ends: [Heard<'_>; 2]) -> Result<Half, Error> {
        let off = ends.map(|end| end.square().value - half);
        let zero = self.zero(ends, off, |value, from| {
            let state = self.along.vibration(value, from, self.which)?;
            let Square { value, slope } = state.heard(0).square();
            let coordinates = state.equilibrium.coordinates.clone();
            Ok((state, [value - half, slope, value / slope], coordinates))
        })?;
        let zero = self.along.curve(zero.value, &zero.equilibrium.coordinates, self.which)?;
        let slope = zero.heard().square().slope;
        let (at_peak, at_half) = (top.top_by_design(), zero.square_by_design());
        let by_design: Vector = at_peak.iter().zip(&at_half).map(|(peak, half)| (0.5 * peak - half) / slope).collect();
        Ok(Half {
            frequency: zero.frequency(top.heard().line.loudest(), &by_design),
            place: Moving::new(zero.point.value, by_design, self.tolerances),
        })
    }
}

/// The amplification factor and its derivatives; `None` if the frequency does not follow the input.
fn amplification(peak: (f64, &Vector), [a, b]: [&Half; 2]) -> Option<(f64, Vector)> {
    let (w, dw) = peak;
    let width = b.frequency.0 - a.frequency.0;
    let (sign, width) = (width.signum(), width.abs());
    let factor = w / width;
    let slopes = a.frequency.1.iter().zip(&b.frequency.1).zip(dw);
    let slopes = slopes.map(|((da, db), dw)| (dw - factor * sign * (db - da)) / width);
    (width > 1e-12 * w).then(|| (factor, slopes.collect()))
}
