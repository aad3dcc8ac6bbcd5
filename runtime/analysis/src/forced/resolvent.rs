//! A model of forced vibration near one design that stays right at a resonance.
//!
//! # Why not the amplitude to first order
//!
//! Near a resonance `|y|` bends within a fraction of a tolerance. What is smooth is `D = Khat + s Chat + s^2 Mhat` itself,
//! and its inverse bordered by vectors near its null space,
//!
//! ```text
//! [ D    P ]^-1   [ G   R ]
//! [ Q^H  0 ]    = [ L  -E ],      D^-1 = G + R E^-1 L,
//! ```
//!
//! where `E` has a row for each vector and is singular where `D` is. A change `dD` gives `dE = L dD R`, `dR = -G dD R`,
//! `dL = -L dD G`, `dG = -G dD G`. These four are taken to first order, with total derivatives that include the shift of
//! the equilibrium; the small system is solved and the forces are evaluated anew for every design. Simple poles and
//! residues to first order amount to the same, but here equal modes need no care, and with as many vectors as unknowns
//! `E` is `D`.

use super::dynamic_stiffness::{Scaled, factored, times};
use super::forces::{Forces, Seen};
use super::response::add;
use crate::algebra::{Lu, Matrix, Vector, product_complex};
use crate::kernels::{CurvatureKernels, Linear};
use crate::sensitivity::{Direction, equilibrium_shift, outside_domain};
use crate::shafts::ShaftsAlong;
use crate::{Complex, Equilibrium, Error};

/// Most vectors that border `D`.
const MOST: usize = 6;
/// Steps of inverse iteration for them; near a resonance, where they matter, one suffices.
const STEPS: usize = 3;

/// The vibration of all outputs at one harmonic, for designs near that of an equilibrium.
#[doc(hidden)]
pub struct Resolvent<'a> {
    mechanism: &'a dyn CurvatureKernels,
    at: &'a Equilibrium,
    /// The excitations that act together, each with the sign of its frequency.
    members: Vec<(usize, f64)>,
    /// The design variables that vary, and the shift of the coordinates with each, one column each.
    variables: Vec<usize>,
    shift: Matrix,
    small: Linearised,
    left: Linearised,
    right: Linearised,
    rest: Linearised,
}

/// A matrix and its derivatives by the varying design variables.
struct Linearised {
    value: Matrix<Complex>,
    slopes: Vec<Matrix<Complex>>,
}

impl Linearised {
    fn at(&self, changes: &[f64]) -> Matrix<Complex> {
        let mut sum = self.value.clone();
        for (slope, &change) in self.slopes.iter().zip(changes) {
            let entries = sum.as_flattened_mut().iter_mut();
            for (entry, slope) in entries.zip(slope.as_flattened()) {
                *entry += slope * change;
            }
        }
        sum
    }
}

impl<'a> Resolvent<'a> {
    /// The model about an equilibrium for the harmonic of an excitation, in the design variables that vary.
    ///
    /// # Errors
    /// Those of the shift of the equilibrium; [`Error::NoFrequency`], [`Error::OutsideDomain`].
    pub fn new(
        mechanism: &'a dyn CurvatureKernels,
        at: &'a Equilibrium,
        excitation: usize,
        variables: Vec<usize>,
    ) -> Result<Self, Error> {
        let infos = &at.description.excitations;
        let first = infos.get(excitation).map_or(excitation, |info| info.with);
        let shift = equilibrium_shift(mechanism, at)?.by_design;
        let forces = Forces::of(mechanism, at);
        let turn = forces.frequency(first).signum();
        let s = Complex::new(0.0, forces.frequency(first).abs());
        if s == Complex::ZERO {
            return Err(Error::NoFrequency { excitation: infos[first].name.clone() });
        }
        let shafts = ShaftsAlong::of(mechanism, at, s)?;
        let scaled = match &shafts {
            None => Scaled::new(&at.linear, s),
            Some(own) => Scaled::of_matrix(own.whole(&at.linear)),
        };
        let bordered = Bordered::new(&scaled.matrix).ok_or_else(|| outside_domain(at))?;
        let seen = Seen::of(mechanism, at);
        let outputs = mechanism.sizes().outputs;
        let rows = |row: &dyn Fn(usize) -> Vector<Complex>| scaled.outputs(outputs, row);
        let c = rows(&|o| seen.row(o, s));
        let Bordered { g, r, l, e } = &bordered;
        let [mut small, mut left, mut right, mut rest] =
            [e.clone(), scaled.forced(l.clone()), product_complex(&c, r), scaled.forced(product_complex(&c, g))]
                .map(|value| Linearised { value, slopes: Vec::new() });
        for &variable in &variables {
            let along = Direction {
                coordinates: shift.column(variable),
                inputs: Vector::zeros(at.inputs.len()),
                design: Vector::from_fn(at.design.len(), |k| f64::from(u8::from(k == variable))),
            };
            let rate = turn * Forces::along(mechanism, at, &along).frequency(first);
            let ds = Complex::new(0.0, rate);
            let number = at.inputs.len() + variable;
            let of_shafts = |i: usize, j: usize| {
                shafts.as_ref().map_or(Complex::ZERO, |own| own.by[number][0][i][j] + own.slope[i][j] * ds)
            };
            let change = scaled.change((&at.linear, &along.linear(mechanism, at)), of_shafts, s, ds);
            let (changed_right, changed_left) = (product_complex(&change, r), product_complex(l, &change));
            let moved = Seen::along(mechanism, at, &along);
            let dc = rows(&|o| {
                let (row, slope) = (moved.row(o, s), seen.row_slope(o, s));
                Vector::from_fn(row.len(), |i| row[i] + slope[i] * ds)
            });
            small.slopes.push(product_complex(l, &changed_right));
            left.slopes.push(scaled.forced(negated(product_complex(&changed_left, g))));
            let cg = product_complex(&c, g);
            right.slopes.push(difference(product_complex(&dc, r), &product_complex(&cg, &changed_right)));
            let through = product_complex(&product_complex(&cg, &change), g);
            rest.slopes.push(scaled.forced(difference(product_complex(&dc, g), &through)));
        }
        Ok(Self {
            mechanism,
            at,
            members: (first..infos.len())
                .filter(|&k| infos[k].with == first)
                .map(|k| (k, forces.frequency(k).signum()))
                .collect(),
            shift: Matrix::from_fn(shift.row_count(), variables.len(), |i, k| shift[i][variables[k]]),
            variables,
            small,
            left,
            right,
            rest,
        })
    }

    /// The frequency, rad/s, and the amplitude of every output at a design, SI; `None` where there is no response, and
    /// for an output that has no derivative.
    pub fn amplitudes(&self, design: &[f64]) -> Option<(f64, Vec<Option<Complex>>)> {
        let changes: Vector = self.variables.iter().map(|&k| design[k] - self.at.design[k]).collect();
        let mut coordinates = self.at.coordinates.clone();
        for (coordinate, row) in coordinates.iter_mut().zip(self.shift.iter()) {
            *coordinate += row.iter().zip(&changes).map(|(a, b)| a * b).sum::<f64>();
        }
        let forces = Forces::at(self.mechanism, &coordinates, &self.at.inputs, design);
        let (mut force, mut amplitudes): (Vector<Complex>, Vector<Complex>) =
            (Vector::zeros(coordinates.len()), Vector::zeros(self.mechanism.sizes().outputs));
        for &(member, turn) in &self.members {
            add(&mut force, &forces.force(member, turn));
            add(&mut amplitudes, &forces.direct(member, turn));
        }
        let driven = times(&self.left.at(&changes), &force);
        let small = Lu::of(self.small.at(&changes))?.solve(&driven);
        add(&mut amplitudes, &times(&self.right.at(&changes), &small));
        add(&mut amplitudes, &times(&self.rest.at(&changes), &force));
        let (first, turn) = *self.members.first()?;
        let frequency = turn * forces.frequency(first);
        Some((frequency, amplitudes.iter().map(|y| y.is_finite().then_some(*y)).collect()))
    }
}

impl Scaled {
    /// The change of `D` with the matrices and with `s`.
    fn change(
        &self,
        (linear, by): (&Linear, &Linear),
        of_shafts: impl Fn(usize, usize) -> Complex,
        s: Complex,
        ds: Complex,
    ) -> Matrix<Complex> {
        let n = self.rows.len();
        Matrix::from_fn(n, n, |i, j| {
            let (m, c) = (linear.mass[i][j], linear.damping[i][j]);
            let matrices = s * (s * by.mass[i][j] + by.damping[i][j]) + by.stiffness[i][j];
            (matrices + (2.0 * s * m + c) * ds + of_shafts(i, j)) * (self.rows[i] * self.columns[j])
        })
    }

    /// Rows of outputs, in terms of scaled unknowns.
    fn outputs(&self, count: usize, row: &dyn Fn(usize) -> Vector<Complex>) -> Matrix<Complex> {
        let rows: Vec<Vector<Complex>> = (0..count).map(row).collect();
        Matrix::from_fn(count, self.columns.len(), |o, i| rows[o][i] * self.columns[i])
    }

    /// A matrix that acts on forces, in terms of forces that are not scaled.
    fn forced(&self, mut matrix: Matrix<Complex>) -> Matrix<Complex> {
        for row in matrix.iter_mut() {
            for (entry, scale) in row.iter_mut().zip(&self.rows) {
                *entry *= scale;
            }
        }
        matrix
    }
}

/// The parts of the inverse of the bordered matrix.
struct Bordered {
    g: Matrix<Complex>,
    r: Matrix<Complex>,
    l: Matrix<Complex>,
    e: Matrix<Complex>,
}

impl Bordered {
    fn new(stiffness: &Matrix<Complex>) -> Option<Self> {
        let n = stiffness.row_count();
        let (left, right) = near_null_space(stiffness)?;
        let k = right.len();
        let matrix = Matrix::from_fn(n + k, n + k, |i, j| match (i < n, j < n) {
            (true, true) => stiffness[i][j],
            (true, false) => left[j - n][i],
            (false, true) => right[i - n][j].conj(),
            (false, false) => Complex::ZERO,
        });
        let unit = Matrix::from_fn(n + k, n + k, |i, j| if i == j { Complex::ONE } else { Complex::ZERO });
        let inverse = Lu::of(matrix)?.solve_columns(&unit);
        Some(Self {
            g: Matrix::from_fn(n, n, |i, j| inverse[i][j]),
            r: Matrix::from_fn(n, k, |i, j| inverse[i][n + j]),
            l: Matrix::from_fn(k, n, |i, j| inverse[n + i][j]),
            e: Matrix::from_fn(k, k, |i, j| -inverse[n + i][n + j]),
        })
    }
}

/// Orthonormal left and right singular vectors of the smallest singular values, by inverse iteration; all unit vectors
/// of a small matrix.
#[expect(clippy::type_complexity, reason = "two lists of vectors")]
fn near_null_space(matrix: &Matrix<Complex>) -> Option<(Vec<Vector<Complex>>, Vec<Vector<Complex>>)> {
    let n = matrix.row_count();
    let unit = |k: usize| Vector::from_fn(n, |i| Complex::from(f64::from(u8::from(i == k))));
    if n <= MOST {
        let units: Vec<_> = (0..n).map(unit).collect();
        return Some((units.clone(), units));
    }
    let (factors, _) = factored(matrix)?;
    // Start vectors without symmetry: the sum of one cosine and a unit vector for each.
    let mut right: Vec<Vector<Complex>> =
        (0..MOST).map(|k| Vector::from_fn(n, |i| Complex::from(((i * (k + 1)) as f64 + 0.5).cos()))).collect();
    let mut left = right.clone();
    for _ in 0..STEPS {
        let adjoint = right
            .iter()
            .map(|vector| factors.solve_transposed(&vector.map(|value| value.conj())).map(|value| value.conj()));
        left = orthonormal(adjoint.collect())?;
        right = orthonormal(left.iter().map(|vector| factors.solve(vector)).collect())?;
    }
    Some((left, right))
}

/// Gram and Schmidt's process, twice for each vector.
fn orthonormal(mut vectors: Vec<Vector<Complex>>) -> Option<Vec<Vector<Complex>>> {
    for k in 0..vectors.len() {
        let (done, rest) = vectors.split_at_mut(k);
        let vector = rest.first_mut()?;
        for _ in 0..2 {
            for other in &*done {
                let along: Complex = other.iter().zip(&**vector).map(|(a, b)| a.conj() * b).sum();
                for (value, other) in vector.iter_mut().zip(other) {
                    *value -= along * other;
                }
            }
            let length = vector.iter().map(Complex::norm_sqr).sum::<f64>().sqrt();
            if !(length > 0.0 && length.is_finite()) {
                return None;
            }
            vector.iter_mut().for_each(|value| *value /= length);
        }
    }
    Some(vectors)
}

fn negated(mut matrix: Matrix<Complex>) -> Matrix<Complex> {
    matrix.as_flattened_mut().iter_mut().for_each(|entry| *entry = -*entry);
    matrix
}

fn difference(mut a: Matrix<Complex>, b: &Matrix<Complex>) -> Matrix<Complex> {
    let entries = a.as_flattened_mut().iter_mut();
    for (entry, other) in entries.zip(b.as_flattened()) {
        *entry -= other;
    }
    a
}
