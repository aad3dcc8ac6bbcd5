//! Tolerances: checks limits and converts them to SI, and reads laws with their shape parameters.

use super::bare::bare_number;
use super::expected::Expected;
use super::lists::Listed;
use super::resolver::Resolver;
use super::typed::{Quantity, ValueContext};
use crate::base::dimension::Dimension;
use crate::base::span::Extent;
use crate::model::mechanism::{Law, Tolerance};
use crate::syntax::ast::{self, Deviation, Deviations, LawKind, Measure, Value, ValueKind};
use crate::syntax::print;

/// The limits of a tolerance, minus the value.
#[derive(Clone, Copy)]
struct Limits {
    lower: f64,
    upper: f64,
    /// Whether they are fractions of the value instead of SI values.
    relative: bool,
}

impl Limits {
    fn half_width(half_width: f64, relative: bool) -> Self {
        Self { lower: -half_width, upper: half_width, relative }
    }

    fn with(self, law: Law) -> Tolerance {
        Tolerance {
            // Removes the sign of zero.
            lower: self.lower + 0.0,
            upper: self.upper + 0.0,
            relative: self.relative,
            law,
        }
    }
}

/// All functions below return `None` for a mistake that has been reported.
impl Resolver<'_> {
    /// The tolerance of a design variable, in SI.
    pub(super) fn design_tolerance(
        &mut self,
        tolerance: Option<&ast::Tolerance>,
        nominal: Option<(f64, Expected)>,
    ) -> Option<Tolerance> {
        let Some(declared) = tolerance else {
            return Some(Tolerance::NONE);
        };
        if let ast::Limits::Values(of) = &declared.limits {
            return self.values(of, declared.extent, nominal?);
        }
        let expected = nominal.as_ref().map(|(_, expected)| expected);
        let help = "; a sum as the nominal value needs parentheses";
        let limits = self.limits(declared, expected, help);
        let law = self.distribution(declared.law.as_ref());
        let (value, Expected { dimension, .. }) = nominal?;
        let tolerance = self.at(value, limits?, declared.extent)?.with(law?);
        let mean = value + tolerance.middle();
        self.positive_mean(declared, &tolerance.law, mean, &dimension.si_symbol())?;
        Some(tolerance)
    }

    /// The tolerance of an input: percentages refer to its current value.
    pub(super) fn input_tolerance(
        &mut self,
        tolerance: Option<&ast::Tolerance>,
        expected: Option<Expected>,
    ) -> Option<Tolerance> {
        let Some(declared) = tolerance else {
            return Some(Tolerance::NONE);
        };
        let limits = self.limits(declared, expected.as_ref(), "");
        let law = self.distribution(declared.law.as_ref());
        let tolerance = limits?.with(law?);
        self.representable(&[tolerance.upper - tolerance.lower], declared.extent)?;
        if tolerance.relative {
            let mean = 1.0 + tolerance.middle();
            self.positive_mean(declared, &tolerance.law, mean, "times the value")?;
        }
        Some(tolerance)
    }

    /// Limits as declared; the upper one must not be below the lower one.
    fn limits(&mut self, tolerance: &ast::Tolerance, expected: Option<&Expected>, more_help: &str) -> Option<Limits> {
        match &tolerance.limits {
            ast::Limits::Percent(percent) => {
                self.not_negative(*percent, tolerance.extent)?;
                Some(Limits::half_width(percent / 100.0, true))
            }
            ast::Limits::HalfWidth(width) => {
                let (half_width, quantity) = self.plain_number(width)?;
                self.expect_deviation(quantity, expected?, "this tolerance", width)?;
                self.not_negative(half_width, width.extent)?;
                Some(Limits::half_width(half_width, false))
            }
            ast::Limits::Deviations(deviations) => {
                let limits = self.deviations(deviations, tolerance.extent, expected)?;
                if limits.upper < limits.lower {
                    let right = print::deviations(&exchanged(deviations));
                    return self.refuse_with_help(
                        tolerance.extent,
                        "the upper limit is below the lower one",
                        format!("the upper limit stands first: `{right}`{more_help}"),
                    );
                }
                Some(limits)
            }
            ast::Limits::Values(_) => self.refuse_with_help(
                tolerance.extent,
                "an input has no value of its own, so it has no list of them",
                "give limits about the value that it will have: `+/- 1% uniform`",
            ),
        }
    }

    /// The tolerance of a quantity that takes one of several values.
    fn values(&mut self, of: &ast::Values, extent: Extent, (value, expected): (f64, Expected)) -> Option<Tolerance> {
        let Listed { numbers, quantity, .. } = self.listed(&of.values, ValueContext::Values)?;
        self.expect(quantity, expected, "a value that it may have", &of.values)?;
        if numbers.is_empty() {
            let message = "no value is listed";
            return self.refuse(of.values.extent, message);
        }
        let weights = match &of.weights {
            None => vec![1.0; numbers.len()],
            Some(list) => self.weights(list, numbers.len())?,
        };
        let least = numbers.iter().copied().fold(f64::INFINITY, f64::min);
        let greatest = numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (lower, upper) = (least - value, greatest - value);
        self.representable(&[lower, upper, greatest - least], extent)?;
        let fraction = |number: f64| if greatest > least { (number - least) / (greatest - least) } else { 0.0 };
        let limits = Limits { lower, upper, relative: false };
        Some(limits.with(Law::OneOf(numbers.into_iter().map(fraction).zip(weights).collect())))
    }

    /// The relative frequency of each of `count` values.
    fn weights(&mut self, list: &Value, count: usize) -> Option<Vec<f64>> {
        let Listed { numbers, quantity, .. } = self.listed(list, ValueContext::Values)?;
        self.expect(quantity, Dimension::NONE, "a weight", list)?;
        let message = if numbers.len() != count {
            format!("{} weights for {count} values: each has one", numbers.len())
        } else if numbers.iter().any(|weight| *weight < 0.0) {
            "a weight is not negative".to_owned()
        } else if numbers.iter().all(|weight| *weight == 0.0) {
            "all weights are zero, so that no value occurs".to_owned()
        } else {
            return Some(numbers);
        };
        self.refuse(list.extent, message)
    }

    /// Requires a deviation to have the dimension of its quantity; a bare number may also be meant in percent.
    fn expect_deviation(&mut self, quantity: Quantity, expected: &Expected, what: &str, value: &Value) -> Option<()> {
        match bare_number(value) {
            Some(written) if !expected.admits(quantity, value) => {
                let message = expected.needs_unit(&written);
                let help = format!("or in per cent: `{written}%`");
                self.refuse_with_help(value.extent, message, help)
            }
            _ => self.expect(quantity, expected.clone(), what, value),
        }
    }

    /// Rejects a negative half-width.
    fn not_negative(&mut self, half_width: f64, extent: Extent) -> Option<()> {
        if half_width < 0.0 {
            let message = "a tolerance is a half-width and cannot be negative";
            return self.refuse(extent, message);
        }
        Some(())
    }

    fn deviations(&mut self, deviations: &Deviations, extent: Extent, expected: Option<&Expected>) -> Option<Limits> {
        let Deviations { upper, lower } = deviations;
        let low = self.deviation(lower, &lower.measure, expected);
        // A wrong unit shared by both is reported once.
        if low.is_none() && deviations.shares_measure() {
            return None;
        }
        let high = self.deviation(upper, deviations.upper_measure(), expected);
        let ((low, low_kind), (high, high_kind)) = (low?, high?);
        let relative = match (low_kind, high_kind) {
            (DeviationKind::Zero, kind) | (kind, DeviationKind::Zero) => kind == DeviationKind::Fraction,
            (low, high) if low == high => low == DeviationKind::Fraction,
            _ => {
                return self.refuse_with_help(
                    extent,
                    "one of these limits is in percent, the other is not",
                    "give both in percent, or both in units",
                );
            }
        };
        Some(Limits { lower: low, upper: high, relative })
    }

    fn deviation(
        &mut self,
        deviation: &Deviation,
        measure: &Measure,
        expected: Option<&Expected>,
    ) -> Option<(f64, DeviationKind)> {
        let Deviation { number, extent, .. } = *deviation;
        let unit = match measure {
            Measure::Percent => return Some((number / 100.0, DeviationKind::Fraction)),
            Measure::Bare if number == 0.0 => return Some((0.0, DeviationKind::Zero)),
            Measure::Bare => None,
            Measure::Unit(unit) => Some(unit.clone()),
        };
        let value = Value::new(ValueKind::Number(number, unit), extent);
        let (number, quantity) = self.plain_number(&value)?;
        self.expect_deviation(quantity, expected?, "this limit", &value)?;
        Some((number, DeviationKind::Quantity))
    }

    /// Limits of a design variable, with percentages taken of its value.
    fn at(&mut self, value: f64, limits: Limits, extent: Extent) -> Option<Limits> {
        if limits.relative && value == 0.0 {
            return self.refuse_with_help(
                extent,
                "a percentage of a nominal value of zero is zero",
                "give an absolute tolerance, such as `+/- 1 mm`",
            );
        }
        let unit = if limits.relative { value.abs() } else { 1.0 };
        let (lower, upper) = (unit * limits.lower, unit * limits.upper);
        self.representable(&[value + lower, value + upper, upper - lower], extent)?;
        Some(Limits { lower, upper, relative: false })
    }

    fn representable(&mut self, limits: &[f64], extent: Extent) -> Option<()> {
        if limits.iter().all(|limit| limit.is_finite()) {
            return Some(());
        }
        let message = "the limits of this tolerance are outside the range of a 64-bit number";
        self.refuse(extent, message)
    }

    fn distribution(&mut self, law: Option<&ast::Law>) -> Option<Law> {
        Some(match law.map(|law| &law.kind) {
            None | Some(LawKind::Normal) => Law::Normal,
            Some(LawKind::TruncatedNormal) => Law::TruncatedNormal,
            Some(LawKind::Uniform) => Law::Uniform,
            Some(LawKind::Triangular) => Law::Triangular,
            Some(LawKind::Lognormal) => Law::Lognormal,
            Some(LawKind::Weibull) => Law::Weibull,
            Some(LawKind::Beta(shapes)) => {
                let [alpha, beta] = [&shapes[0], &shapes[1]].map(|shape| self.shape(shape));
                Law::Beta { alpha: alpha?, beta: beta? }
            }
        })
    }

    /// A shape parameter of a beta distribution.
    fn shape(&mut self, value: &Value) -> Option<f64> {
        let (shape, quantity) = self.plain_number(value)?;
        self.expect(quantity, Dimension::NONE, "a shape of `beta`", value)?;
        if shape <= 0.0 {
            let message = format!("a shape of `beta` is positive, this one is {shape}");
            return self.refuse(value.extent, message);
        }
        Some(shape)
    }

    /// Checks that the mean, midway between the limits, is positive, for laws of positive values.
    fn positive_mean(&mut self, declared: &ast::Tolerance, law: &Law, mean: f64, unit: &str) -> Option<()> {
        let demands = matches!(law, Law::Lognormal | Law::Weibull);
        if !demands || mean > 0.0 {
            return Some(());
        }
        let extent = declared.law.as_ref().map_or(declared.extent, |law| law.extent);
        let message = format!("a `{law}` value is positive, but its mean, midway between the limits, is {mean} {unit}");
        let help = "choose another law, or declare the amount and write the sign where it is used";
        self.refuse_with_help(extent, message, help)
    }
}

/// The measure of a deviation.
#[derive(Clone, Copy, PartialEq)]
enum DeviationKind {
    /// A zero without a unit, which fits everything.
    Zero,
    /// A fraction of the value.
    Fraction,
    /// A quantity in SI.
    Quantity,
}

/// The same limits in the other order.
fn exchanged(deviations: &Deviations) -> Deviations {
    let Deviations { upper, lower } = deviations;
    let (mut first, mut second) = (lower.clone(), upper.clone());
    if deviations.shares_measure() {
        std::mem::swap(&mut first.measure, &mut second.measure);
    }
    Deviations { upper: first, lower: second }
}
