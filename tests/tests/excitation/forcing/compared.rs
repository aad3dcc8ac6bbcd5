//! Forces and outputs of a machine with excitations, against the motion of its explicit twin.

use std::collections::HashMap;

use eigentol::Role;
use eigentol::kernels::{Extent, Kernel, Kernels, MotionKernels};
use eigentol_interpreter::Interpreted;

use crate::forcing::declared::{Check, Frequency, Machine, Motion};

/// Numbers between -1 and 1.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5555)
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    pub(crate) fn number(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn numbers(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.number()).collect()
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }

    pub(crate) fn one_of<T: Clone>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())].clone()
    }

    pub(crate) fn chance(&mut self, percent: u64) -> bool {
        self.bits() % 100 < percent
    }
}

/// The results of a kernel.
pub(crate) fn results(machine: &dyn Kernels, kernel: Kernel, arguments: &[&[f64]]) -> Vec<Vec<f64>> {
    let mut all = room(machine, kernel);
    let mut results: Vec<&mut [f64]> = all.iter_mut().map(Vec::as_mut_slice).collect();
    machine.evaluate(kernel, arguments, &mut results);
    all
}

/// Room for the results of a kernel; not a number, so that what is not written shows.
pub(crate) fn room(machine: &dyn Kernels, kernel: Kernel) -> Vec<Vec<f64>> {
    let shapes = kernel.results().iter();
    let length = |extent: &Extent| length(machine, *extent);
    shapes.map(|shape| vec![f64::NAN; shape.iter().map(length).product()]).collect()
}

pub(crate) fn length(machine: &dyn Kernels, extent: Extent) -> usize {
    let sizes = machine.sizes();
    match extent {
        Extent::Coordinates => sizes.coordinates,
        Extent::Inputs => sizes.inputs,
        Extent::Design => sizes.design,
        Extent::Outputs => sizes.outputs,
        Extent::Excitations => sizes.excitations,
        Extent::Fixed(count) => count,
    }
}

struct Twins<'a> {
    machine: &'a Machine,
    excited: Interpreted,
    explicit: Interpreted,
    /// The unknowns of the excited machine: value, and its change with two derivatives by time.
    state: HashMap<String, (f64, [f64; 3])>,
    time: f64,
}

/// How far the two differ.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Outcome {
    /// The largest difference, relative.
    pub(crate) worst: f64,
    /// Values compared.
    pub(crate) compared: usize,
    /// Values with a part of an excitation.
    pub(crate) excited: usize,
}

/// Compares both at a state and a time that a seed chooses; the mistakes of the declaration with excitations.
pub(crate) fn compare(machine: &Machine, seed: u64) -> Result<Outcome, String> {
    let excited = Interpreted::from_text(&machine.excited()).map_err(|error| error.to_string())?;
    let explicit = Interpreted::from_text(&machine.explicit())
        .unwrap_or_else(|error| panic!("{error}\n{}\n{}", machine.explicit(), machine.excited()));
    let mut random = Random::new(seed);
    let coordinates = excited.description().coordinates.iter();
    let state = coordinates
        .map(|coordinate| {
            let value = match coordinate.role {
                Role::Speed => 3.0 + 2.0 * random.number(),
                _ => 0.4 * random.number(),
            };
            let change = [random.number(), random.number(), random.number()];
            (coordinate.name.to_string(), (value, change))
        })
        .collect();
    let twins = Twins { machine, excited, explicit, state, time: 2.0 * random.number() };
    Ok(twins.compare())
}

impl Twins<'_> {
    fn speed(&self, drive: &str) -> f64 {
        match self.machine.coordinate(drive).map(|x| &x.motion) {
            Some(Motion::Driven(speed)) => *speed,
            Some(Motion::Coasting) => self.state[drive].0,
            other => panic!("{drive} is {other:?}"),
        }
    }

    fn frequency(&self, frequency: &Frequency) -> f64 {
        match frequency {
            Frequency::Own(value) => *value,
            Frequency::Order(order, drive) => order * self.speed(drive),
        }
    }

    /// Position, velocity and acceleration of a coordinate of the explicit machine.
    fn motion(&self, name: &str, eps: f64) -> [f64; 3] {
        let own = self.machine.coordinate(name);
        match own.map(|x| &x.motion) {
            None | Some(Motion::Free) => {
                let (value, change) = self.state.get(name).copied().unwrap_or_default();
                [value + eps * change[0], eps * change[1], eps * change[2]]
            }
            Some(Motion::Driven(speed)) => [speed * self.time, *speed, 0.0],
            Some(Motion::Coasting) => {
                let (speed, change) = self.state[name];
                [speed * self.time, speed + eps * change[0], eps * change[1]]
            }
            Some(Motion::Shaken(quantity, amplitude, frequency, phase)) => {
                let w = self.frequency(frequency);
                let size = eps
                    * amplitude
                    * match *quantity {
                        "amplitude" => 1.0,
                        "velocity" => 1.0 / w,
                        _ => -1.0 / (w * w),
                    };
                let lag = if *quantity == "velocity" { 90_f64.to_radians() } else { 0.0 };
                let (sine, cosine) = (w * self.time + phase - lag).sin_cos();
                [size * cosine, -size * w * sine, -size * w * w * cosine]
            }
        }
    }

    /// Rows and outputs of the explicit machine.
    fn explicit(&self, eps: f64) -> (Vec<f64>, Vec<f64>) {
        let description = self.explicit.description();
        let motions: Vec<[f64; 3]> =
            description.coordinates.iter().map(|coordinate| self.motion(&coordinate.name, eps)).collect();
        let [q, velocity, acceleration]: [Vec<f64>; 3] =
            [0, 1, 2].map(|k| motions.iter().map(|motion| motion[k]).collect());
        let input = |name: &str| {
            let excitation =
                self.machine.excitations.iter().find(|excitation| name == format!("{}_now", excitation.name));
            excitation.map_or(eps, |excitation| {
                eps * (self.frequency(&excitation.frequency) * self.time + excitation.phase).cos()
            })
        };
        let u: Vec<f64> = description.inputs.iter().map(|x| input(&x.name)).collect();
        let b: Vec<f64> = description.design.iter().map(|value| value.nominal).collect();
        let explicit: &dyn MotionKernels = &self.explicit;
        let residual = explicit.motion_residual(&acceleration, &velocity, &q, &u, &b);
        let outputs = results(explicit, Kernel::Outputs, &[&q, &u, &b]).swap_remove(0);
        (residual.to_vec(), outputs)
    }

    /// The derivative of rows and outputs of the explicit machine by `eps`.
    fn slopes(&self) -> (Vec<f64>, Vec<f64>) {
        const STEP: f64 = 4e-3;
        let difference = |step: f64| {
            let ((a, c), (b, d)) = (self.explicit(step), self.explicit(-step));
            let slope = |(up, down): (&f64, &f64)| (up - down) / (2.0 * step);
            let rows: Vec<f64> = a.iter().zip(&b).map(slope).collect();
            let outputs: Vec<f64> = c.iter().zip(&d).map(slope).collect();
            (rows, outputs)
        };
        let steps = [STEP, STEP / 2.0, STEP / 4.0].map(difference);
        let extrapolated = |values: [&[f64]; 3]| -> Vec<f64> {
            (0..values[0].len())
                .map(|k| {
                    let once = |coarse: f64, fine: f64| (4.0 * fine - coarse) / 3.0;
                    let coarse = once(values[0][k], values[1][k]);
                    let fine = once(values[1][k], values[2][k]);
                    (16.0 * fine - coarse) / 15.0
                })
                .collect()
        };
        (extrapolated([&steps[0].0, &steps[1].0, &steps[2].0]), extrapolated([&steps[0].1, &steps[1].1, &steps[2].1]))
    }

    /// What remains of the explicit machine's rows besides their first order falls with the square of `eps`.
    fn the_rest_is_of_second_order(&self, slopes: &[f64]) {
        let rest = |eps: f64| -> f64 {
            let (still, moved) = (self.explicit(0.0).0, self.explicit(eps).0);
            let rows = still.iter().zip(&moved).zip(slopes);
            rows.map(|((still, moved), slope)| (moved - still - eps * slope).powi(2)).sum::<f64>().sqrt()
        };
        let (coarse, fine) = (rest(2e-3), rest(1e-3));
        assert!(fine < coarse / 3.5 + 1e-11, "{coarse} {fine}\n{}", self.machine.excited());
    }

    fn compare(&self) -> Outcome {
        let description = self.excited.description();
        let states: Vec<_> = description.coordinates.iter().map(|coordinate| self.state[&*coordinate.name]).collect();
        let q: Vec<f64> = states.iter().map(|state| state.0).collect();
        let [z, z1, z2]: [Vec<f64>; 3] = [0, 1, 2].map(|k| states.iter().map(|state| state.1[k]).collect());
        let b: Vec<f64> = description.design.iter().map(|value| value.nominal).collect();
        let at: [&[f64]; 3] = [&q, &[], &b];
        let n = q.len();
        let outputs = description.outputs.len();

        let moved = |matrices: &[Vec<f64>], row: usize| -> f64 {
            let row = |matrix: &[f64], by: &[f64]| -> f64 {
                let entries = &matrix[row * n..(row + 1) * n];
                entries.iter().zip(by).map(|(a, b)| a * b).sum()
            };
            row(&matrices[0], &z2) + row(&matrices[1], &z1) + row(&matrices[2], &z)
        };
        let linear = results(&self.excited, Kernel::Linear, &at);
        let motion = results(&self.excited, Kernel::OutputMotion, &at);
        let forcing = results(&self.excited, Kernel::Forcing, &at);
        let forced = |[cosine, sine]: [usize; 2], width: usize, k: usize| -> f64 {
            forcing[1]
                .iter()
                .enumerate()
                .map(|(e, w)| {
                    let (s, c) = (w * self.time).sin_cos();
                    let place = e * width + k;
                    forcing[cosine][place] * c + forcing[sine][place] * s
                })
                .sum()
        };

        let (rows, explicit_outputs) = self.slopes();
        self.the_rest_is_of_second_order(&rows);
        let row_of = |name: &str| {
            let mut all = self.explicit.description().coordinates.iter();
            all.position(|x| *x.name == *name).unwrap_or_else(|| panic!("no row {name}\n{}", self.machine.explicit()))
        };
        let mut pairs = Vec::new();
        for (k, coordinate) in description.coordinates.iter().enumerate() {
            if self.machine.rates_coupled.iter().any(|name| *coordinate.name == *name) {
                continue;
            }
            let force = forced([0, 3], n, k);
            pairs.push((moved(&linear, k) - force, rows[row_of(&coordinate.name)], force, coordinate.name.to_string()));
        }
        let mut same = 0;
        for (k, (name, _, check)) in self.machine.outputs.iter().enumerate() {
            let expected = match check {
                Check::Row(name) => rows[row_of(name)],
                Check::Output => {
                    same += 1;
                    explicit_outputs[same - 1]
                }
            };
            let direct = forced([2, 4], outputs, k);
            pairs.push((moved(&motion, k) + direct, expected, direct, name.clone()));
        }
        let size = pairs.iter().fold(1.0_f64, |most, pair| most.max(pair.1.abs()));
        let mut outcome = Outcome::default();
        for (found, expected, force, name) in pairs {
            let difference = (found - expected).abs() / (size + expected.abs());
            assert!(
                difference < 1e-8,
                "{name}: {found} instead of {expected} of which {force} is forced\n{}\n{}",
                self.machine.excited(),
                self.machine.explicit()
            );
            outcome.worst = outcome.worst.max(difference);
            outcome.compared += 1;
            outcome.excited += usize::from(force.abs() > 1e-6 * size);
        }
        outcome
    }
}
