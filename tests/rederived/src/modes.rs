//! Undamped modes and modes of the whole pencil, with all their derivatives.

use core::f64::consts::TAU;

use nalgebra::{Complex, DMatrix};

use super::Derived;
use super::complex::HyperComplex;
use super::machine::{Solution, State};
use super::pair::Pair;
use super::spectrum::{eigenvalues, upper_half};
use crate::hyper::Hyper;
use eigentol::Real;

/// A complex number with all its derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct ComplexDerived {
    /// Real part.
    pub re: Derived,
    /// Imaginary part.
    pub im: Derived,
}

/// `Khat phi = lambda Mhat phi`, `phi^T Mhat phi = 1`.
#[derive(Clone, Debug, PartialEq)]
pub struct UndampedMode {
    /// The eigenvalue.
    pub lambda: Derived,
    /// The square root of the eigenvalue, the frequency, if it is positive.
    pub omega: Option<Derived>,
    /// `phi`, with its lead component positive.
    pub shape: Vec<Derived>,
    /// The component of largest magnitude.
    pub lead: usize,
}

/// `(s^2 Mhat + s Chat + Khat) phi = 0` and `psi^T (s^2 Mhat + s Chat + Khat) = 0`, not conjugated;
/// `phi^H Mhat phi = psi^H Mhat psi = 1`.
#[derive(Clone, Debug, PartialEq)]
pub struct GeneralMode {
    /// The eigenvalue.
    pub s: ComplexDerived,
    /// `|s|`, the natural frequency.
    pub magnitude: Derived,
    /// `-Re s / |s|`, the damping ratio.
    pub damping_ratio: Derived,
    /// Logarithmic decrement `-2 pi Re s / Im s`; not a number without oscillation.
    pub log_decrement: Derived,
    /// `phi`, with its lead component real and positive.
    pub right: Vec<ComplexDerived>,
    /// `psi`, with its lead component real and positive.
    pub left: Vec<ComplexDerived>,
    /// The components of largest magnitude of `phi` and `psi`; in case of a tie, the first.
    pub leads: [usize; 2],
}

/// A matrix polynomial in hyper-dual numbers, lowest coefficient first, each by rows.
type Polynomial = Vec<Vec<Hyper>>;

fn transposed(matrix: &[Hyper], n: usize) -> Vec<Hyper> {
    (0..n * n).map(|k| matrix[k % n * n + k / n]).collect()
}

/// `x / sqrt(x^H M x)`.
fn normalised(shape: &[HyperComplex], mass: &[Hyper]) -> Vec<HyperComplex> {
    let n = shape.len();
    let mut form = Hyper::constant(0.0);
    for (i, x) in shape.iter().enumerate() {
        for (j, y) in shape.iter().enumerate() {
            form = form + mass[i * n + j] * (x.re * y.re + x.im * y.im);
        }
    }
    let factor = Hyper::constant(1.0) / form.sqrt();
    shape.iter().map(|x| x.scaled(factor)).collect()
}

fn separate(s: Complex<f64>, all: &[Complex<f64>]) -> bool {
    let most = all.iter().map(|s| s.norm()).fold(0.0, f64::max);
    let near = |other: &&Complex<f64>| (s - **other).norm() <= 1e-6 * s.norm().max(other.norm()) + 1e-12 * most;
    all.iter().filter(near).count() == 1
}

impl State {
    fn order(&self) -> usize {
        self.coordinates.len()
    }

    fn values(&self, polynomial: &[Vec<Hyper>]) -> Vec<DMatrix<Complex<f64>>> {
        let n = self.order();
        let values =
            |matrix: &Vec<Hyper>| DMatrix::from_row_iterator(n, n, matrix.iter().map(|x| Complex::from(x.value())));
        polynomial.iter().map(values).collect()
    }

    /// An eigenpair refined in every solution, with normalised shape; `None` where it is not simple.
    #[allow(clippy::type_complexity)]
    fn refined(
        &self,
        s: Complex<f64>,
        polynomial: impl Fn(&Solution) -> Polynomial,
        lead: Option<usize>,
    ) -> Option<(usize, Vec<(HyperComplex, Vec<HyperComplex>)>)> {
        let values = self.values(&polynomial(&self.solutions[0]));
        let pair = Pair::near(&values, s, lead)?;
        let refine = |solution: &Solution| {
            let polynomial = polynomial(solution);
            let coefficients: Vec<&[Hyper]> = polynomial.iter().map(Vec::as_slice).collect();
            let (s, shape) = pair.refine(&coefficients);
            let shape = match self.holonomic {
                true => normalised(&shape, &solution.mass),
                false => shape,
            };
            (s, shape)
        };
        Some((pair.lead, self.solutions.iter().map(refine).collect()))
    }

    fn undamped(solution: &Solution) -> Polynomial {
        let mass = solution.mass.iter().map(|&entry| -entry).collect();
        vec![solution.stiffness.clone(), mass]
    }

    fn general(solution: &Solution) -> Polynomial {
        vec![solution.stiffness.clone(), solution.damping.clone(), solution.mass.clone()]
    }

    /// Eigenvalues of `Khat` and `Mhat`, ordered by real part.
    pub fn undamped_eigenvalues(&self) -> Vec<Complex<f64>> {
        let mut all = eigenvalues(&self.values(&Self::undamped(&self.solutions[0])));
        all.sort_by(|a, b| a.re.total_cmp(&b.re));
        all
    }

    /// Eigenvalues of the whole pencil with `Im s >= 0`, by magnitude. The sum of all eigenvalues is checked: it must
    /// be `-tr(Mhat^-1 Chat)`.
    ///
    /// # Panics
    /// When the sum differs.
    pub fn eigenvalues(&self) -> Vec<Complex<f64>> {
        upper_half(&self.values(&Self::general(&self.solutions[0])))
    }

    /// All undamped modes, ascending in `lambda`; `None` for a repeated eigenvalue, which has no derivative of its own.
    pub fn undamped_modes(&self) -> Vec<Option<UndampedMode>> {
        let all = self.undamped_eigenvalues();
        let mode = |s: &Complex<f64>| separate(*s, &all).then(|| self.undamped_mode(s.re))?;
        all.iter().map(mode).collect()
    }

    /// The undamped mode near `lambda`.
    pub fn undamped_mode(&self, lambda: f64) -> Option<UndampedMode> {
        let (lead, pairs) = self.refined(Complex::from(lambda), Self::undamped, None)?;
        let lambda = self.derived(|k, _| pairs[k].0.re);
        let omega = (lambda.value > 0.0).then(|| self.derived(|k, _| pairs[k].0.re.sqrt()));
        let component = |i: usize| self.derived(|k, _| pairs[k].1[i].re);
        Some(UndampedMode { lambda, omega, shape: (0..self.order()).map(component).collect(), lead })
    }

    /// All modes of the whole pencil in the order of [`State::eigenvalues`]; `None` for a repeated eigenvalue, which
    /// has no derivative of its own.
    pub fn general_modes(&self) -> Vec<Option<GeneralMode>> {
        let all = self.eigenvalues();
        let mode = |s: &Complex<f64>| separate(*s, &all).then(|| self.general_mode(*s, [None; 2]))?;
        all.iter().map(mode).collect()
    }

    /// The mode near the eigenvalue `s`, with the given lead components of `phi` and `psi`, or their largest ones.
    ///
    /// # Panics
    /// When the right and left pairs, solved independently, disagree about the eigenvalue.
    pub fn general_mode(&self, s: Complex<f64>, leads: [Option<usize>; 2]) -> Option<GeneralMode> {
        let n = self.order();
        let adjoint = |solution: &Solution| {
            let general = Self::general(solution);
            general.iter().map(|matrix| transposed(matrix, n)).collect()
        };
        let (right_lead, right) = self.refined(s, Self::general, leads[0])?;
        let (left_lead, left) = self.refined(s, adjoint, leads[1])?;
        for ((one, _), (other, _)) in right.iter().zip(&left) {
            for (one, other) in one.parts().iter().zip(other.parts()) {
                let scale = 1e-7 * one.norm() + 1e-6 * s.norm();
                assert!((one - other).norm() <= scale, "{one} and {other} of {s}");
            }
        }
        let of = |number: &dyn Fn(HyperComplex) -> Hyper| self.derived(|k, _| number(right[k].0));
        let shape = |pairs: &[(HyperComplex, Vec<HyperComplex>)]| {
            let component = |i: usize| ComplexDerived {
                re: self.derived(|k, _| pairs[k].1[i].re),
                im: self.derived(|k, _| pairs[k].1[i].im),
            };
            (0..n).map(component).collect()
        };
        Some(GeneralMode {
            s: ComplexDerived { re: of(&|s| s.re), im: of(&|s| s.im) },
            magnitude: of(&HyperComplex::modulus),
            damping_ratio: of(&|s| -s.re / s.modulus()),
            log_decrement: of(&|s| -s.re / s.im * Hyper::constant(TAU)),
            right: shape(&right),
            left: shape(&left),
            leads: [right_lead, left_lead],
        })
    }
}
