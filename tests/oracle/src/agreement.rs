//! Compares any [`Kernels`] of a model with the oracle at a random state.
//!
//! A result that is a small difference of large terms cannot be compared relative to itself, so the size of its terms
//! is measured. The oracle evaluates the mechanism a second time with the whole ground rotated, which changes only the
//! rounding; rounding errors are about 2^-52 of the terms.

use std::fmt::Write;

use crate::declaration::declaration;
use crate::kernels::{At, Kernels, Pencil};
use crate::matrices::{Linear, Oracle};
use crate::model::Model;
use crate::random::{Random, position};

/// Allowed difference, relative to the size of the terms.
pub const TOLERANCE: f64 = 1e-9;

/// All arguments of all kernels.
#[derive(Clone, Debug)]
pub struct Case {
    /// `q`, `u`, `b`.
    pub at: [Vec<f64>; 3],
    /// `dq`, `du`, `db`.
    pub along: [Vec<f64>; 3],
    /// `qddot`.
    pub acceleration: Vec<f64>,
    /// `qdot`.
    pub velocity: Vec<f64>,
    /// `phi`, `lambda`.
    pub mode: (Vec<f64>, f64),
    /// `dphi`, `dlambda`.
    pub mode_along: (Vec<f64>, f64),
    /// `w`.
    pub weight: Vec<f64>,
    /// `dw`.
    pub weight_along: Vec<f64>,
    /// `left`, `acceleration`, `velocity`, `position`.
    pub pencil: [Vec<f64>; 4],
    /// `dleft`, `dacceleration`, `dvelocity`, `dposition`.
    pub pencil_along: [Vec<f64>; 4],
}

impl Case {
    /// A random state of a model: not near any equilibrium, every drive on, every design variable off its nominal
    /// value, no zero component in any direction.
    pub fn random(model: &Model, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let n = model.free().len();
        let mut full =
            |count: usize, limit: f64| -> Vec<f64> { (0..count).map(|_| random.between(-limit, limit)).collect() };
        let (inputs, design) = (model.inputs.len(), model.design.len());
        let along = [full(n, 1.0), full(inputs, 1.0), full(design, 1.0)];
        let (acceleration, velocity) = (full(n, 3.0), full(n, 2.0));
        let (mode, mode_along) = ((full(n, 1.0), 7.3), (full(n, 1.0), -0.6));
        let (weight, weight_along) = (full(n, 1.0), full(n, 1.0));
        let q = position(model, &mut random);
        let u = (0..inputs).map(|_| random.between(0.5, 4.0)).collect();
        let b = model.design.iter().map(|b| b.nominal * random.between(0.9, 1.1)).collect();
        let mut vectors = || std::array::from_fn(|_| (0..n).map(|_| random.between(-1.0, 1.0)).collect());
        let (pencil, pencil_along) = (vectors(), vectors());
        let at = [q, u, b];
        Self { at, along, acceleration, velocity, mode, mode_along, weight, weight_along, pencil, pencil_along }
    }
}

/// One array that a kernel returns.
struct Array {
    kernel: &'static str,
    name: &'static str,
    shape: Vec<usize>,
    /// Entries with equal indices here are of one kind and share a term size; `None` if all entries are of one kind.
    kind: Option<usize>,
    values: Vec<f64>,
}

impl Array {
    fn indices(&self, mut flat: usize) -> Vec<usize> {
        let mut indices = vec![0; self.shape.len()];
        for (index, &extent) in indices.iter_mut().zip(&self.shape).rev() {
            *index = flat % extent;
            flat /= extent;
        }
        indices
    }

    fn kind_of(&self, flat: usize) -> usize {
        self.kind.map_or(0, |axis| self.indices(flat)[axis])
    }
}

/// Every array that every kernel returns.
fn arrays(kernels: &dyn Kernels, case: &Case) -> Vec<Array> {
    let at: At = [&case.at[0], &case.at[1], &case.at[2]];
    let along: At = [&case.along[0], &case.along[1], &case.along[2]];
    let [n, inputs, design] = at.map(<[f64]>::len);
    let mode = (&case.mode.0[..], case.mode.1);
    let mode_along = (&case.mode_along.0[..], case.mode_along.1);
    let pencil: Pencil = case.pencil.each_ref().map(Vec::as_slice);
    let pencil_along: Pencil = case.pencil_along.each_ref().map(Vec::as_slice);
    let mut list = Vec::new();
    let mut add = |kernel, name, shape: &[usize], kind, values| {
        list.push(Array { kernel, name, shape: shape.to_vec(), kind, values });
    };

    add("residual", "residual", &[n], None, kernels.residual(at));

    let [inertia, applied] = kernels.residual_parts(at);
    add("residual_parts", "inertia", &[n], None, inertia);
    add("residual_parts", "applied", &[n], None, applied);

    let residual = kernels.motion_residual(&case.acceleration, &case.velocity, at);
    add("motion_residual", "residual", &[n], None, residual);

    let [mass, right] = kernels.motion(&case.velocity, at);
    add("motion", "mass matrix", &[n, n], None, mass);
    add("motion", "right-hand side", &[n], None, right);

    let [residual, stiffness] = kernels.residual_and_stiffness(at);
    add("residual_and_stiffness", "residual", &[n], None, residual);
    add("residual_and_stiffness", "stiffness", &[n, n], None, stiffness);

    for (kernel, linear) in [("linear", kernels.linear(at)), ("linear_along", kernels.linear_along(at, along))] {
        add(kernel, "mass", &[n, n], None, linear.mass);
        add(kernel, "damping", &[n, n], None, linear.damping);
        add(kernel, "stiffness", &[n, n], None, linear.stiffness);
    }

    let [by_input, by_design] = kernels.residual_partials(at);
    add("residual_partials", "by_input", &[n, inputs], Some(1), by_input);
    add("residual_partials", "by_design", &[n, design], Some(1), by_design);

    let partials = kernels.linear_partials(at);
    let join = |list: &[Linear<f64>], part: fn(&Linear<f64>) -> &Vec<f64>| {
        list.iter().flat_map(|linear| part(linear).iter().copied()).collect::<Vec<_>>()
    };
    for ([mass, damping, stiffness], list, count) in [
        (["by_coordinate.mass", "by_coordinate.damping", "by_coordinate.stiffness"], &partials.by_coordinate, n),
        (["by_input.mass", "by_input.damping", "by_input.stiffness"], &partials.by_input, inputs),
        (["by_design.mass", "by_design.damping", "by_design.stiffness"], &partials.by_design, design),
    ] {
        let shape = [count, n, n];
        add("linear_partials", mass, &shape, Some(0), join(list, |linear| &linear.mass));
        add("linear_partials", damping, &shape, Some(0), join(list, |linear| &linear.damping));
        add("linear_partials", stiffness, &shape, Some(0), join(list, |linear| &linear.stiffness));
    }

    let whirl = kernels.whirl(at, &case.mode.0, &case.weight);
    add("whirl", "sums", &[7], Some(0), whirl);

    for (kernel, gradient) in [
        ("mode_gradient", kernels.mode_gradient(at, mode.0, mode.1)),
        ("pencil_gradient", kernels.pencil_gradient(at, pencil)),
        ("residual_gradient", kernels.residual_gradient(at, &case.weight)),
        ("mode_gradient_along", kernels.mode_gradient_along(at, mode, along, mode_along)),
        ("pencil_gradient_along", kernels.pencil_gradient_along(at, pencil, along, pencil_along)),
        ("residual_gradient_along", kernels.residual_gradient_along(at, &case.weight, along, &case.weight_along)),
    ] {
        let [coordinates, inputs_part, design_part] = gradient;
        add(kernel, "coordinates", &[n], Some(0), coordinates);
        add(kernel, "inputs", &[inputs], Some(0), inputs_part);
        add(kernel, "design", &[design], Some(0), design_part);
    }
    list
}

/// A lower bound on the size of terms, relative to the largest of all kernels. A result can be zero because all its
/// terms vanish in one particular ground frame; it need not be more accurate than the rounding of everything else.
const FLOOR: f64 = 1e-4;

/// For each entry of an array, the size of the terms summed in the entries of its kind.
fn sizes(value: &Array, turned: &Array) -> Vec<f64> {
    let terms = |(a, b): (&f64, &f64)| a.abs().max((a - b).abs() / f64::EPSILON);
    let single: Vec<f64> = value.values.iter().zip(&turned.values).map(terms).collect();
    // The rounding error of a single entry may happen to vanish, but not those of all entries of its kind.
    let of_kind = |kind: usize| {
        let kin = (0..single.len()).filter(|&flat| value.kind_of(flat) == kind);
        kin.map(|flat| single[flat]).fold(0.0, f64::max)
    };
    (0..single.len()).map(|flat| of_kind(value.kind_of(flat))).collect()
}

/// The oracle's results at one random state of a model.
pub struct Reference<'a> {
    model: &'a Model,
    seed: u64,
    case: Case,
    arrays: Vec<Array>,
    /// Term size of each entry of each array.
    sizes: Vec<Vec<f64>>,
}

impl<'a> Reference<'a> {
    /// Evaluates the oracle.
    pub fn new(model: &'a Model, seed: u64) -> Self {
        let case = Case::random(model, seed);
        let oracle = Oracle::new(model);
        let expected = arrays(&oracle, &case);
        let turned = arrays(&oracle.turned([0.4, -0.7, 0.5], 0.9), &case);
        let mut sizes: Vec<Vec<f64>> = expected.iter().zip(&turned).map(|(one, other)| sizes(one, other)).collect();
        let floor = FLOOR * sizes.iter().flatten().copied().fold(0.0, f64::max);
        for size in sizes.iter_mut().flatten() {
            *size = size.max(floor);
        }
        Self { model, seed, case, arrays: expected, sizes }
    }

    /// Compares every kernel with the oracle.
    ///
    /// # Errors
    /// Lists every entry that differs, and the declaration.
    pub fn compare(&self, kernels: &dyn Kernels) -> Result<(), String> {
        let mut report = String::new();
        let found = arrays(kernels, &self.case);
        for ((expected, sizes), found) in self.arrays.iter().zip(&self.sizes).zip(&found) {
            compare_array(&mut report, expected, sizes, &found.values);
        }
        if report.is_empty() {
            return Ok(());
        }
        let (seed, case) = (self.seed, &self.case);
        Err(format!("{report}\nseed {seed}, {case:?}\n\n{}", declaration(self.model)))
    }
}

fn compare_array(report: &mut String, expected: &Array, sizes: &[f64], found: &[f64]) {
    let Array { kernel, name, shape, values, .. } = expected;
    if found.len() != values.len() {
        let (found, expected) = (found.len(), values.len());
        let _ = writeln!(report, "{kernel}: {name} has {found} entries, not {expected} {shape:?}");
        return;
    }
    for (flat, size) in sizes.iter().enumerate() {
        let (right, value) = (values[flat], found[flat]);
        let difference = (value - right).abs();
        // NaN is not agreement.
        let agrees = difference <= TOLERANCE * size;
        if !agrees {
            let indices = expected.indices(flat);
            let _ = writeln!(
                report,
                "{kernel}: {name}{indices:?} is {value:e}, the oracle says {right:e} \
                 (difference {difference:.1e}, terms up to {size:.1e})"
            );
        }
    }
}

/// Panics unless every kernel agrees with the oracle at a random state.
///
/// # Panics
/// With every entry that differs, and the declaration.
pub fn assert_agrees(model: &Model, kernels: &dyn Kernels, seed: u64) {
    if let Err(report) = Reference::new(model, seed).compare(kernels) {
        panic!("{report}");
    }
}
