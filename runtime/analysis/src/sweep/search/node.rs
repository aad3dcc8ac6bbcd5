//! A state of a step with its modes, and how its eigenvalues change along the step.

use std::rc::Rc;

use super::spectrum::{Root, Spectrum};
use crate::algebra::{Matrix, Vector, dot, dot_complex, times};
use crate::branches::CurvePoint;
use crate::constraints::Structure;
use crate::eigenproblem::eigenvalues;
use crate::kernels::{DirectionalKernels, Linear};
use crate::modes::{Family, free_pairs, pencil_slope_times, pencil_times};
use crate::sensitivity::Direction;
use crate::shafts::{Form, ShaftSlopes, form};
use crate::{Behaviour, Complex, Equilibrium, Error, Mode, Modes};

/// Eigenvalues closer than this, relative to the larger, are derived together: rounding mixes their shapes.
const MIXED: f64 = 1e-9;

/// A state with its modes.
pub(super) struct Node {
    pub(super) spectrum: Rc<Spectrum>,
    pub(super) point: CurvePoint,
    pub(super) modes: Modes,
}

/// What is asked about a state.
pub(super) struct Question<'a> {
    pub(super) mechanism: &'a dyn DirectionalKernels,
    pub(super) family: Family,
    /// Position of the varied input.
    pub(super) input: usize,
    /// What acts in addition to its set value.
    pub(super) deviation: f64,
    /// The stiffness has eigenvalues of its own, and these are wanted too.
    pub(super) stiffness: bool,
}

impl Question<'_> {
    /// The state at place `t` of a step; `rate` is the length of the step's parameter per unit of the local tangent.
    pub(super) fn node(&self, point: CurvePoint, t: f64, rate: f64) -> Result<Node, Error> {
        let state = &point.equilibrium;
        let mut modes = Modes::empty(self.family, &state.description);
        modes.solve_at(state, point.judged.clone())?;
        let along = point.direction().scaled(rate);
        let mut inputs = Vector::zeros(state.inputs.len());
        inputs[self.input] = along.p;
        let direction = Direction { coordinates: along.q, inputs, design: Vector::zeros(state.design.len()) };
        let change = direction.linear(self.mechanism, state);
        let roots = match self.family {
            Family::Undamped => undamped(&modes.modes, &change),
            Family::General => {
                let shafts = ShaftSlopes::of(self.mechanism, state)?;
                let along_input = (self.input, along.p);
                general(&modes.modes, &state.linear, &change, shafts.as_deref().map(|own| (own, along_input)))
            }
        };
        let stiffness = if self.stiffness { stiffness(state, &change)? } else { Vec::new() };
        let input = [point.place.p + self.deviation, along.p];
        Ok(Node { spectrum: Rc::new(Spectrum { t, input, roots, stiffness }), point, modes })
    }
}

/// Whether the stiffness has eigenvalues of its own.
pub(super) fn has_stiffness(state: &Equilibrium) -> bool {
    state.description.symmetric_stiffness && Structure::of(&state.description).holonomic()
}

fn undamped(modes: &[Mode], change: &Linear) -> Vec<Root> {
    let values: Vec<f64> = modes.iter().map(|mode| mode.lambda).collect();
    let shapes: Vec<Vector> = modes.iter().map(Mode::real_shape).collect();
    let error = |r: usize| modes[r].error * values[r].abs().sqrt().max(modes[r].error);
    let neutral = |r: usize| modes[r].behaviour == Behaviour::Neutral;
    real_roots(&values, &shapes, change, error, neutral)
}

/// The eigenvalues of a symmetric `Khat` relative to `Mhat`.
fn stiffness(state: &Equilibrium, change: &Linear) -> Result<Vec<Root>, Error> {
    let pairs = free_pairs(&state.linear, &state.description)
        .map_err(|trouble| crate::equilibrium::Failure::from(trouble).explain(&state.description))?;
    let shapes: Vec<Vector> = pairs.shapes.iter().map(Vector::from).collect();
    let error = |r: usize| f64::max(pairs.errors[r], state.rounding);
    let neutral = |r: usize| pairs.lambda[r].abs() <= error(r);
    Ok(real_roots(&pairs.lambda, &shapes, change, error, neutral))
}

/// Eigenvalues `lambda` with their derivatives `phi^T (dK - lambda dM) phi`.
fn real_roots(
    values: &[f64],
    shapes: &[Vector],
    change: &Linear,
    error: impl Fn(usize) -> f64,
    neutral: impl Fn(usize) -> bool,
) -> Vec<Root> {
    let near = |r: usize, k: usize| {
        let apart = (values[r] - values[k]).abs();
        apart <= MIXED * values[r].abs().max(values[k].abs()) + error(r).min(error(k))
    };
    let slopes = slopes(values.len(), near, |clusters| {
        let of_cluster = |cluster: &Vec<usize>| {
            let lambda = values[cluster[0]];
            Matrix::from_fn(cluster.len(), cluster.len(), |i, j| {
                let (left, right) = (&shapes[cluster[i]], &shapes[cluster[j]]);
                let forces = times(&change.stiffness, right);
                let inertia = times(&change.mass, right);
                Complex::from(dot(left, &forces) - lambda * dot(left, &inertia))
            })
        };
        clusters.iter().map(of_cluster).collect()
    });
    let root = |r: usize| Root {
        value: values[r].into(),
        slope: slopes[r].re.into(),
        error: error(r),
        paired: false,
        neutral: neutral(r),
        grows: values[r] < -error(r),
    };
    (0..values.len()).map(root).collect()
}

/// Eigenvalues with their derivatives; shafts with the input that varies and how fast.
fn general(
    modes: &[Mode],
    linear: &Linear,
    change: &Linear,
    shafts: Option<(&ShaftSlopes, (usize, f64))>,
) -> Vec<Root> {
    let near = |r: usize, k: usize| {
        let (a, b) = (&modes[r], &modes[k]);
        let size = a.s.norm().max(b.s.norm());
        (a.s - b.s).norm() <= MIXED * size + a.error.min(b.error)
    };
    let slopes = slopes(modes.len(), near, |clusters| {
        let of_shafts = shafts.map(|(shafts, (input, rate))| {
            let pairs =
                clusters.iter().flat_map(|cluster| cluster.iter().flat_map(|i| cluster.iter().map(move |j| (i, j))));
            let forms: Vec<Form<'_>> = pairs.map(|(&i, &j)| form(&modes[i], &modes[j])).collect();
            let each = shafts.shafts.gradients(&forms).into_iter();
            each.map(|own| [own.by_s, shafts.along(&own.by_number, input) * rate]).collect::<Vec<_>>()
        });
        let mut of_shafts = of_shafts.iter().flatten();
        let of_cluster = |cluster: &Vec<usize>| {
            let (count, s) = (cluster.len(), modes[cluster[0]].place());
            let products = |matrix: &dyn Fn(&[Complex]) -> Vector<Complex>| {
                let images: Vec<_> = cluster.iter().map(|&j| matrix(&modes[j].shape)).collect();
                Matrix::from_fn(count, count, |i, j| dot_complex(modes[cluster[i]].left(), &images[j]))
            };
            let mut changes = products(&|x| pencil_times(change, s, x));
            let mut moved = products(&|x| pencil_slope_times(linear, s, x));
            let entries = changes.as_flattened_mut().iter_mut().zip(moved.as_flattened_mut());
            for ((change, moved), [by_s, along]) in entries.zip(of_shafts.by_ref()) {
                *change += along;
                *moved = *by_s;
            }
            quotient(moved, changes)
        };
        clusters.iter().map(of_cluster).collect()
    });
    let roots = modes.iter().zip(slopes);
    let root = |(mode, slope): (&Mode, Complex)| Root {
        value: mode.s,
        slope,
        error: mode.error,
        paired: mode.s.im > 0.0,
        neutral: matches!(mode.behaviour, Behaviour::Neutral | Behaviour::Free),
        grows: mode.behaviour.grows(),
    };
    roots.map(root).collect()
}

/// `-A^-1 B`, by elimination with row exchanges.
fn quotient(mut a: Matrix<Complex>, mut b: Matrix<Complex>) -> Matrix<Complex> {
    let m = a.row_count();
    for k in 0..m {
        let best = (k..m).max_by(|&i, &j| a[i][k].norm().total_cmp(&a[j][k].norm()));
        let best = best.unwrap_or(k);
        for j in 0..m {
            (a[k][j], a[best][j]) = (a[best][j], a[k][j]);
            (b[k][j], b[best][j]) = (b[best][j], b[k][j]);
        }
        for i in (0..m).filter(|&i| i != k) {
            let factor = a[i][k] / a[k][k];
            for j in 0..m {
                let (above, right) = (a[k][j], b[k][j]);
                a[i][j] -= factor * above;
                b[i][j] -= factor * right;
            }
        }
    }
    Matrix::from_fn(m, m, |i, j| -b[i][j] / a[i][i])
}

/// The derivatives of eigenvalues: those of eigenvalues that are equal to rounding are the eigenvalues of the matrix
/// that `of` returns for the positions of each such cluster.
fn slopes(
    count: usize,
    near: impl Fn(usize, usize) -> bool,
    of: impl FnOnce(&[Vec<usize>]) -> Vec<Matrix<Complex>>,
) -> Vec<Complex> {
    let mut done = vec![false; count];
    let mut clusters = Vec::new();
    for first in 0..count {
        if done[first] {
            continue;
        }
        let mut cluster = vec![first];
        let mut next = 0;
        while let Some(&member) = cluster.get(next) {
            let new: Vec<usize> =
                (first..count).filter(|&r| !done[r] && near(member, r)).filter(|r| !cluster.contains(r)).collect();
            cluster.extend(new);
            next += 1;
        }
        cluster.iter().for_each(|&r| done[r] = true);
        clusters.push(cluster);
    }
    let mut slopes = vec![Complex::ZERO; count];
    for (cluster, matrix) in clusters.iter().zip(of(&clusters)) {
        let mut elements: Vec<Complex> = matrix.as_flattened().to_vec();
        let mut values = vec![Complex::new(f64::NAN, 0.0); cluster.len()];
        match (&cluster[..], elements.iter().all(|value| value.is_finite())) {
            ([_], _) => values[0] = elements[0],
            (_, true) if eigenvalues(&mut elements, &mut values) => {}
            _ => values.fill(Complex::new(f64::NAN, 0.0)),
        }
        for (&r, value) in cluster.iter().zip(values) {
            slopes[r] = value;
        }
    }
    slopes
}
