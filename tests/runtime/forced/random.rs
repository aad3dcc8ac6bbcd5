//! A family of dense nonlinear mechanisms with random numbers: responses against direct solutions in complex numbers,
//! derivatives against differences of the whole chain, in which equilibrium and frequency move.

use eigentol::equilibrium::equilibrium;
use eigentol::forced::{Measure, response, second_derivatives, sensitivities};
use eigentol::kernels::{Kernel, Kernels};
use eigentol::{Complex, Description, Equilibrium, Forcing, Output, Policy, Real, Shared};
use nalgebra::{DMatrix, DVector};

use super::models::{described, excitation, output};
use crate::common::derived::{Derived, Excited, Model};
use crate::common::{NUMBER, coordinate, design, input, sizes};

/// The random numbers of a family member, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Dense(u64);

impl Dense {
    /// A number between -1 and 1.
    fn number(self, what: u64, i: usize, j: usize) -> f64 {
        let mut z = self.0.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (what << 40) ^ ((i << 20 | j) as u64);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// A number that depends on the state, within `[1 - 0.6, 1 + 0.6]` times `size` near the origin.
    fn varied<T: Real>(self, what: u64, i: usize, q: &[T; 3], u: &[T; 2], b: &[T; 3]) -> T {
        let all = [q[0], q[1], q[2], u[0], b[0], b[1], b[2]];
        let each = all.iter().enumerate();
        let mut bend = T::constant(0.0);
        for (j, own) in each {
            bend = bend + T::constant(0.4 * self.number(what, i, 10 + j)) * *own;
        }
        T::constant(self.number(what, i, 0)) + bend.sin()
    }

    /// `sum_j (size delta_ij + varied) x_j`.
    fn product<T: Real>(self, (what, size): (u64, f64), x: &[T; 3], (q, u, b): (&[T; 3], &[T; 2], &[T; 3])) -> [T; 3] {
        [0, 1, 2].map(|i| {
            let mut sum = T::constant(size) * x[i];
            for (j, x) in x.iter().enumerate() {
                sum = sum + T::constant(0.4) * self.varied(what, 3 * i + j, q, u, b) * *x;
            }
            sum
        })
    }
}

impl Model for Dense {
    sizes!(3, 2, 3, 2, 3);

    const DESCRIPTION: Description = described!(
            "Dense",
            [
                coordinate("x", NUMBER),
                coordinate("y", NUMBER),
                coordinate("z", NUMBER),
            ],
            [input("load", NUMBER), input("rate", NUMBER)],
            [
                design("first", NUMBER, 0.3, 0.01),
                design("second", NUMBER, -0.2, 0.01),
                design("third", NUMBER, 0.4, 0.01),
            ],
            [output("one", NUMBER), output("two", NUMBER)],
            [
                excitation("ahead", 0),
                excitation("other", 1),
                excitation("back", 0),
            ]; false, 0
    );

    fn inertia<T: Real>(&self, a: &[T; 3], _: &[T; 3], q: &[T; 3], u: &[T; 2], b: &[T; 3]) -> [T; 3] {
        self.product((1, 2.0), a, (q, u, b))
    }

    fn applied<T: Real>(&self, v: &[T; 3], q: &[T; 3], u: &[T; 2], b: &[T; 3]) -> [T; 3] {
        let damping = self.product((2, 0.6), v, (q, u, b));
        let spring = self.product((3, 4.0), q, (q, u, b));
        [0, 1, 2].map(|i| {
            let load = T::constant(self.number(4, i, 0)) * u[0];
            load - damping[i] - spring[i] - q[i] * q[i] * q[i]
        })
    }

    fn outputs<T: Real>(&self, q: &[T; 3], u: &[T; 2], b: &[T; 3]) -> [T; 2] {
        let rest = [T::constant(0.0); 3];
        self.moving_outputs(&rest, &rest, q, u, b)
    }

    fn moving_outputs<T: Real>(&self, a: &[T; 3], v: &[T; 3], q: &[T; 3], u: &[T; 2], b: &[T; 3]) -> [T; 2] {
        let of = (q, u, b);
        let (a, v) = (self.product((5, 0.3), a, of), self.product((6, 0.3), v, of));
        [q[0] * q[1] + a[0] + v[1], (q[2] + u[0]).sin() + a[2] * b[0] + v[0]]
    }

    fn forcing<T: Real>(&self, q: &[T; 3], u: &[T; 2], b: &[T; 3]) -> Excited<Self, T> {
        let list = |what: u64, k: usize| [0, 1, 2].map(|i| self.varied(what, 3 * k + i, q, u, b));
        let direct = |what: u64, k: usize| [0, 1].map(|o| self.varied(what, 3 * k + o, q, u, b));
        let rate = u[1] * (T::constant(1.0) + T::constant(0.1) * q[0] + T::constant(0.2) * b[1]);
        let other = T::constant(1.7) + b[0] * b[0] + T::constant(0.2) * (q[1] * u[0]).sin();
        Forcing {
            cosine: [0, 1, 2].map(|k| list(7, k)),
            frequency: [rate, other, T::constant(0.0) - rate],
            direct_cosine: [0, 1, 2].map(|k| direct(8, k)),
            sine: [0, 1, 2].map(|k| list(9, k)),
            direct_sine: [0, 1, 2].map(|k| direct(10, k)),
        }
    }
}

const INPUTS: [f64; 2] = [0.7, 1.1];
const DESIGN: [f64; 3] = [0.3, -0.2, 0.4];

fn state(seed: u64, values: &[f64]) -> Equilibrium {
    let (u, b) = values.split_at(2);
    equilibrium(&Derived(Dense(seed)), u, b, &[0.0; 3], Policy::Nearest).unwrap()
}

fn values() -> Vec<f64> {
    INPUTS.into_iter().chain(DESIGN).collect()
}

/// `y` of both outputs for one excitation, by a direct solution at its own frequency, which may be negative.
fn direct(seed: u64, at: &Equilibrium, k: usize) -> [Complex; 2] {
    let (q, u, b) =
        (at.coordinates[..].try_into().unwrap(), at.inputs[..].try_into().unwrap(), at.design[..].try_into().unwrap());
    let model = Derived(Dense(seed));
    let forces = Dense(seed).forcing::<f64>(&q, &u, &b);
    let s = Complex::new(0.0, forces.frequency[k]);
    let linear = &at.linear;
    let stiffness =
        DMatrix::from_fn(3, 3, |i, j| s * s * linear.mass[i][j] + s * linear.damping[i][j] + linear.stiffness[i][j]);
    let force = |i: usize, _: usize| Complex::new(forces.cosine[k][i], -forces.sine[k][i]);
    let z = stiffness.lu().solve(&DVector::from_fn(3, force)).unwrap();
    let mut seen = [[0.0; 6]; 3];
    let [a, v, x] = &mut seen;
    let arguments: [&[f64]; 3] = [&at.coordinates, &at.inputs, &at.design];
    Kernels::evaluate(&model, Kernel::OutputMotion, &arguments, &mut [a, v, x]);
    [0, 1].map(|o| {
        let row = |i: usize| seen[0][3 * o + i] * s * s + s * seen[1][3 * o + i] + seen[2][3 * o + i];
        let complex: Complex = (0..3).map(|i| row(i) * z[i]).sum();
        complex + Complex::new(forces.direct_cosine[k][o], -forces.direct_sine[k][o])
    })
}

#[test]
fn responses_are_direct_solutions() {
    for seed in 0..200 {
        let at = state(seed, &values());
        let found = response(&Derived(Dense(seed)), &at).unwrap();
        let [both, one] = &found.harmonics[..] else { panic!("two harmonics") };
        assert_eq!(both.shares.len(), 2);
        assert!(both.shares[1].reversed && !both.shares[0].reversed && !one.shares[0].reversed);
        let [ahead, other, back] = [0, 1, 2].map(|k| direct(seed, &at, k));
        for o in 0..2 {
            let near = |amplitude: Option<Complex>, expected: Complex| {
                let complex = amplitude.expect("an amplitude");
                assert!((complex - expected).norm() <= 1e-12 * expected.norm(), "{seed}");
            };
            near(both.shares[0].outputs[o], ahead[o]);
            near(both.shares[1].outputs[o], back[o].conj());
            near(both.outputs[o], ahead[o] + back[o].conj());
            near(one.outputs[o], other[o]);
        }
    }
}

/// The derivative of `f` by each variable, by differences of fourth order.
fn differences(f: impl Fn(&[f64]) -> Vec<Complex>) -> Vec<Vec<Complex>> {
    let step = 2e-4;
    let one = |k: usize| {
        let at = |steps: f64| {
            let mut moved = values();
            moved[k] += steps * step;
            f(&moved)
        };
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(at);
        let slope = |i: usize| (a[i] - d[i] + 8.0 * (c[i] - b[i])) / (12.0 * step);
        (0..a.len()).map(slope).collect()
    };
    (0..5).map(one).collect()
}

/// The harmonic, the output and the measure of everything that vibrates.
fn all_vibrations() -> impl Iterator<Item = (usize, Output, Measure)> {
    let measures = [Measure::Displacement, Measure::Velocity, Measure::Acceleration];
    let each = move |(k, o)| measures.map(|measure| (k, Output::new(o), measure));
    [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().flat_map(each)
}

/// Numbers of one vibration: `y`, `|y|`, phase, frequency, and the five derivatives of each.
const EACH: usize = 24;

/// The numbers of every vibration, one after the other.
fn first(seed: u64, values: &[f64]) -> Vec<Complex> {
    let first = sensitivities(&Derived(Dense(seed)), &state(seed, values)).unwrap();
    let real = |value: f64| Complex::new(value, 0.0);
    let mut all = Vec::new();
    for (harmonic, output, measure) in all_vibrations() {
        let own = &first.response.harmonics[harmonic];
        let y = own.amplitude(output, measure).unwrap();
        let slopes = first.complex(harmonic, output, measure).unwrap();
        let modulus = first.modulus(harmonic, output, measure).unwrap();
        let phase = first.phase(harmonic, output, measure).unwrap();
        all.extend([y, real(y.norm()), real(y.arg()), real(own.frequency)]);
        all.extend(slopes.iter());
        all.extend(modulus.iter().map(real));
        all.extend(phase.iter().map(real));
        all.extend(first.harmonics[harmonic].frequency.iter().map(real));
    }
    all
}

#[test]
fn derivatives_are_those_of_the_whole_chain() {
    for seed in 0..2 {
        let of = second_derivatives(&Derived(Dense(seed)), &state(seed, &values())).unwrap();
        assert!(of.asymmetry < 1e-11, "{:e}", of.asymmetry);
        let (at, expected) = (first(seed, &values()), differences(|values| first(seed, values)));
        for (number, (harmonic, output, measure)) in all_vibrations().enumerate() {
            let start = EACH * number;
            let complex = of.complex(harmonic, output, measure).unwrap();
            let modulus = of.modulus(harmonic, output, measure).unwrap();
            let phase = of.phase(harmonic, output, measure).unwrap();
            let frequency = &of.harmonics[harmonic].frequency;
            for (j, expected) in expected.iter().enumerate() {
                let near = |complex: Complex, index: usize, tolerance: f64| {
                    let expected = expected[start + index];
                    let apart = (complex - expected).norm() / (1.0 + expected.norm());
                    assert!(apart <= tolerance, "{seed} {number} {j} {index}: {apart:e}");
                };
                for place in 0..4 {
                    near(at[start + 4 + 5 * place + j], place, 1e-8);
                }
                for k in 0..5 {
                    near(entry(&complex, j, k), 4 + k, 1e-7);
                    near(entry(&modulus, j, k).into(), 9 + k, 1e-7);
                    near(entry(&phase, j, k).into(), 14 + k, 1e-7);
                    near(entry(frequency, j, k).into(), 19 + k, 1e-7);
                }
            }
        }
    }
}

/// Of two of the inputs and design variables together.
fn entry<T: Copy>(second: &eigentol::second_order::SecondDerivatives<T>, i: usize, j: usize) -> T {
    match (i.checked_sub(2), j.checked_sub(2)) {
        (None, None) => second.by_input[i][j],
        (None, Some(j)) => second.by_input_and_design[i][j],
        (Some(i), None) => second.by_input_and_design[j][i],
        (Some(i), Some(j)) => second.by_design[i][j],
    }
}
