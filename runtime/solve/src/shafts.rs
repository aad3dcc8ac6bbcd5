//! Shafts: what they add to the equations that are compiled.
//!
//! A compiled mechanism holds of a shaft what it does at rest and, at its stations, half the inertia of each neighbouring
//! span. Everything else follows here from the numbers of the sections: with `spans(s)` what remains of the spans when all
//! between the stations is eliminated, `T(s) = s^2 Mhat + s Chat + Khat + spans(s) - spans(0) - s^2 lumped`. Small motions and
//! vibrations of a mechanism with shafts are those of `T`; its equilibrium is that of the compiled equations.

use eigentol_contract::{LineKind, SpanInfo};
pub use eigentol_shafts::Form;
use eigentol_shafts::{Assembly, LUMPED, Line, Number, Section, Span, SpanForm, lumped};

mod along;

pub use self::along::ShaftsAlong;

use crate::algebra::{Matrix, Vector};
use crate::kernels::{Kernels, Second};
use crate::scalar::Dual;
use crate::{Complex, Description, Equilibrium, Error, Mode};

/// The degree of the polynomials in each element, and where sections do not shear: their deflection alone has both.
const DEGREE: usize = 4;
const SLENDER: usize = 7;

/// What the shafts of a mechanism add at one state.
#[doc(hidden)]
pub struct Shafts {
    /// Spans with everything that the compiled equations have of the stations.
    pub(crate) whole: Assembly,
    /// Spans alone.
    pub(crate) spans: Assembly,
}

/// Derivatives of `left^T T(s) right` for two vectors.
#[doc(hidden)]
pub struct FormGradient {
    /// By the numbers of the spans, at fixed compiled matrices.
    #[doc(hidden)]
    pub by_number: Vector<Complex>,
    /// By `s`.
    #[doc(hidden)]
    pub by_s: Complex,
}

/// The numbers of the spans of a mechanism; see [`Mechanism::spans`](eigentol_contract::Mechanism::spans).
pub(crate) fn numbers(mechanism: &dyn Kernels, description: &Description, u: &[f64], b: &[f64]) -> Vector {
    let numbers = numbers_along(mechanism, description, [u, b], [None; 2]);
    numbers.iter().map(|number| number.value.value).collect()
}

/// The same along a first and a second variable, inputs and then design variables.
fn numbers_along(
    mechanism: &dyn Kernels,
    description: &Description,
    [u, b]: [&[f64]; 2],
    along: [Option<usize>; 2],
) -> Vec<Second> {
    let value = |(k, value): (usize, &f64)| {
        let [first, next] = along.map(|own| f64::from(u8::from(own == Some(k))));
        let fixed = |value: f64| Dual { value, slope: 0.0 };
        Dual { value: Dual { value: *value, slope: first }, slope: fixed(next) }
    };
    let all: Vec<Second> = u.iter().chain(b).enumerate().map(value).collect();
    let mut numbers = vec![Second::default(); description.spans.iter().map(SpanInfo::count).sum()];
    if !numbers.is_empty() {
        let (u, b) = all.split_at(u.len());
        mechanism.spans_into(u, b, &mut numbers);
    }
    numbers
}

/// Derivatives of the numbers of the spans by inputs and design variables: a row for each variable.
#[must_use]
fn number_slopes(mechanism: &dyn Kernels, at: &Equilibrium) -> Matrix {
    let variables = at.inputs.len() + at.design.len();
    let mut slopes = Matrix::zeros(variables, at.spans.len());
    // Two variables at a time: the first and the second slope of a number with both.
    for first in (0..variables).step_by(2).filter(|_| !at.spans.is_empty()) {
        let next = (first + 1 < variables).then_some(first + 1);
        let numbers = numbers_along(mechanism, &at.description, [&at.inputs, &at.design], [Some(first), next]);
        slopes[first].iter_mut().zip(&numbers).for_each(|(to, number)| *to = number.value.slope);
        if let Some(next) = next {
            slopes[next].iter_mut().zip(&numbers).for_each(|(to, number)| *to = number.slope.value);
        }
    }
    slopes
}

impl Shafts {
    /// The shafts of a mechanism at a state; `None` if it has none.
    ///
    /// # Errors
    /// [`Error::Shaft`] for numbers that no shaft has.
    pub fn of(at: &Equilibrium) -> Result<Option<Self>, Error> {
        if at.description.spans.is_empty() {
            return Ok(None);
        }
        let wrong = |error: eigentol_shafts::Error| Error::Shaft { reason: error.to_string().into() };
        let n = at.coordinates.len();
        let expected = at.description.spans.iter().map(SpanInfo::count).sum();
        if at.spans.len() != expected {
            return Err(Error::WrongLength { kind: "numbers of shafts", found: at.spans.len(), expected });
        }
        let infos = at.description.spans.iter().zip(each_of(&at.description, &at.spans));
        let spans: Vec<Span> = infos.map(|(info, own)| span(info, own)).collect();
        let slender = spans.iter().any(|span| span.line == Line::Slender);
        let degree = if slender { SLENDER } else { DEGREE };
        let zeros = || [(); 3].map(|()| Matrix::zeros(n, n));
        let alone = Assembly::new(spans.clone(), zeros(), degree).map_err(wrong)?;
        let at_rest = alone.condensed(Complex::ZERO).matrix();
        let at_rest = Matrix::from_fn(n, n, |i, j| at_rest[i][j].re);
        let linear = &at.linear;
        let mut mass = linear.mass.clone();
        for (span, own) in spans.iter().zip(each_of(&at.description, &at.spans)) {
            let lumped = lumped(own);
            for (k, place) in span.ends.iter().flat_map(|end| end.iter().enumerate()) {
                if let Some((index, _)) = place {
                    mass[*index][*index] -= lumped[k % 2];
                }
            }
        }
        let stiffness = Matrix::from_fn(n, n, |i, j| linear.stiffness[i][j] - at_rest[i][j]);
        let whole = Assembly::new(spans, [mass, linear.damping.clone(), stiffness], degree).map_err(wrong)?;
        Ok(Some(Self { whole, spans: alone }))
    }

    /// `T(s)`.
    #[must_use]
    pub fn matrix(&self, s: Complex) -> Matrix<Complex> {
        self.whole.condensed(s).matrix()
    }

    /// `T'(s)`.
    #[must_use]
    pub fn slope(&self, s: Complex) -> Matrix<Complex> {
        self.whole.pencils(&[s]).swap_remove(0).slope
    }

    /// Derivatives of `left^T T(s) right` for each of these.
    #[must_use]
    pub fn gradients(&self, all: &[Form<'_>]) -> Vec<FormGradient> {
        let still = all.iter().map(|form| Form { s: Complex::ZERO, ..*form });
        let mut moving = self.spans.gradients(&all.iter().copied().chain(still).collect::<Vec<_>>());
        let still = moving.split_off(all.len());
        let gradient = |((form, moving), still): ((&Form<'_>, &Vec<SpanForm>), &Vec<SpanForm>)| {
            let Form { left, s, right } = *form;
            let mut by_number = Vec::new();
            for ((span, moving), still) in self.spans.spans().iter().zip(moving).zip(still) {
                by_number.extend(of_span(span, moving, still, |i| s * s * left[i] * right[i]));
            }
            let of_spans: Complex = moving.iter().map(|own| own.rate).sum();
            FormGradient { by_number: by_number.into(), by_s: self.whole.slope_of_stations(left, s, right) + of_spans }
        };
        all.iter().zip(&moving).zip(&still).map(gradient).collect()
    }
}

/// `psi_a^T T(s_b) phi_b` of two modes.
#[doc(hidden)]
#[must_use]
pub fn form<'a>(a: &'a Mode, b: &'a Mode) -> Form<'a> {
    Form { left: a.left(), s: b.place(), right: &b.shape }
}

/// Shafts with the derivatives of their numbers.
#[doc(hidden)]
pub struct ShaftSlopes {
    #[doc(hidden)]
    pub shafts: Shafts,
    /// A row for each input and design variable.
    slopes: Matrix,
}

impl ShaftSlopes {
    #[doc(hidden)]
    #[inline]
    pub fn of(mechanism: &dyn Kernels, at: &Equilibrium) -> Result<Option<Box<Self>>, Error> {
        if at.description.spans.is_empty() { Ok(None) } else { Self::with_slopes(mechanism, at) }
    }

    #[cold]
    fn with_slopes(mechanism: &dyn Kernels, at: &Equilibrium) -> Result<Option<Box<Self>>, Error> {
        let with_slopes = |shafts| Box::new(Self { shafts, slopes: number_slopes(mechanism, at) });
        Ok(Shafts::of(at)?.map(with_slopes))
    }

    /// A derivative by an input, or behind these by a design variable, from those by numbers, at fixed compiled matrices.
    #[doc(hidden)]
    #[must_use]
    pub fn along(&self, gradient: &[Complex], variable: usize) -> Complex {
        self.slopes[variable].iter().zip(gradient).map(|(slope, by_number)| by_number * slope).sum()
    }

    /// Derivatives of `psi^T T(s) phi` of each mode.
    #[doc(hidden)]
    #[must_use]
    pub fn of_modes(&self, modes: &[Mode]) -> Vec<FormGradient> {
        self.shafts.gradients(&modes.iter().map(|mode| form(mode, mode)).collect::<Vec<_>>())
    }
}

/// Refuses a question that takes all equations or all modes of a mechanism with shafts.
#[doc(hidden)]
pub fn refuse(of: &Description, what: &'static str) -> Result<(), Error> {
    if of.spans.is_empty() { Ok(()) } else { Err(Error::NotWithShafts { what: what.into() }) }
}

/// The numbers of each span.
fn each_of<'a, T>(description: &Description, mut numbers: &'a [T]) -> Vec<&'a [T]> {
    let own = |info: &SpanInfo| {
        let (own, rest) = numbers.split_at(info.count());
        numbers = rest;
        own
    };
    description.spans.iter().map(own).collect()
}

/// A span with these numbers.
fn span(info: &SpanInfo, own: &[f64]) -> Span {
    let line = match info.line {
        LineKind::Timoshenko => Line::Timoshenko,
        LineKind::Slender => Line::Slender,
        LineKind::Bar => Line::Bar,
    };
    let sections = own[1..].chunks_exact(SpanInfo::NUMBERS).zip(info.elements.iter());
    let section = |(row, elements): (&[f64], &usize)| {
        let mut section = Section {
            length: 0.0,
            stiffness: 0.0,
            shear: 0.0,
            mass: 0.0,
            rotary: 0.0,
            lag: 0.0,
            tension: 0.0,
            drag: 0.0,
        };
        Number::ALL.into_iter().zip(row).for_each(|(number, value)| *section.number_mut(number) = *value);
        (section, *elements)
    };
    let end = |motions: &[(usize, f64)]| core::array::from_fn(|k| motions.get(k).copied());
    Span { line, speed: own[0], sections: sections.map(section).collect(), ends: info.ends.each_ref().map(|x| end(x)) }
}

/// Derivatives by the numbers of a span: in motion, less those at rest and of the lumped inertia, whose `weight` at each
/// unknown is `s^2 left right`.
fn of_span(span: &Span, moving: &SpanForm, still: &SpanForm, weight: impl Fn(usize) -> Complex) -> Vec<Complex> {
    let sum = |of: fn(&Section) -> f64| span.sections.iter().map(|(own, _)| of(own)).sum::<f64>();
    let (length, mass) = (sum(|own| own.length), sum(|own| own.mass * own.length));
    let mut weights = [Complex::ZERO; 2];
    for (k, place) in span.ends.iter().flat_map(|end| end.iter().enumerate()) {
        if let Some((index, _)) = place {
            weights[k % 2] += 0.5 * weight(*index);
        }
    }
    let [along, across] = weights;
    let mut all = vec![moving.speed - still.speed];
    for ((section, _), (moving, still)) in span.sections.iter().zip(moving.sections.iter().zip(&still.sections)) {
        let Section { length: own, mass: line, rotary, .. } = *section;
        let mut slopes: Vec<Complex> = moving.iter().zip(still).map(|(a, b)| a - b).collect();
        slopes[Number::Mass as usize] -= own * (along + across * (LUMPED * length * length));
        slopes[Number::Rotary as usize] -= across * own;
        let by_length = LUMPED * (line * length * length + 2.0 * mass * length);
        slopes[Number::Length as usize] -= along * line + across * (rotary + by_length);
        all.extend(slopes);
    }
    all
}
