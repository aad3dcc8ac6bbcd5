//! The complete workflow on the double pendulum: equilibrium, modes and exact derivatives along speeds, and Monte
//! Carlo, against hand-written C++.

use std::error::Error as StdError;
use std::ffi::c_int;
use std::hint::black_box;
use std::ops::ControlFlow;
use std::path::Path;

use eigentol::equilibrium::equilibrium;
use eigentol::modes::modes;
use eigentol::scalar::Instructions;
use eigentol::sweep::sensitivity_sweep;
use eigentol::sweep::{Following, SweepPoint};
use eigentol::tolerance::{Sampling, monte_carlo};
use eigentol::{Equilibrium, Error, Mechanism, Modes, MonteCarlo, Policy, Sensitivities, Tolerances, mechanism};
use libloading::Library;

use crate::tools::{Tools, source};
use crate::work::{AGREEMENT, Closures, INPUTS, Random, Task, Work};

mechanism! {
    /// Two bars on a spinning shaft, every dimension on its own.
    pub(crate) mechanism DoublePendulum {
        input  omega: rad/s;
        design l1 = 1.0 m  +/- 3%;
        design l2 = 1.0 m  +/- 3%;
        design m1 = 3.0 kg +/- 3%;
        design m2 = 3.0 kg +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: m1, length: l1, along: -z);
        body bar2: rod(mass: m2, length: l2, along: -z);
        joint spin:   revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
    }
}

/// The number of speeds in a sweep, all above the critical speed, and the number of samples in a Monte Carlo run.
const SPEEDS: usize = 100;
const SAMPLES: usize = 3000;

/// Start values near the equilibrium at the first speed, rad.
const START: [f64; 2] = [1.0, 0.1];

/// Numbers per speed written by the C++ side.
const WIDTH: usize = 12;

type State = Equilibrium;

/// Agreement required of finite differences, limited by their step.
const DIFFERENCE_ERROR: f64 = 1e-6;

/// The functions of the C++ side and the tasks they perform.
const TASKS: [(&str, &str, usize, f64); 6] = [
    ("pendulum/sweep", "sweep", SPEEDS, AGREEMENT),
    ("pendulum/sweep-one-by-one", "sweep", SPEEDS, AGREEMENT),
    ("pendulum/sweep-against-differences", "sweep_by_differences", SPEEDS, DIFFERENCE_ERROR),
    ("pendulum/sweep-against-differences-one-by-one", "sweep_by_differences", SPEEDS, DIFFERENCE_ERROR),
    ("pendulum/monte-carlo", "monte_carlo", SAMPLES, AGREEMENT),
    ("pendulum/monte-carlo-one-by-one", "monte_carlo", SAMPLES, AGREEMENT),
];

/// Suffix of the tasks in which our side solves one state at a time.
const SCALAR: &str = "-one-by-one";

/// The tasks with a selected name.
///
/// # Errors
/// When our side has no solution.
pub(crate) fn tasks(wanted: &dyn Fn(&str) -> bool, tools: &mut Tools) -> Result<Vec<Task>, Box<dyn StdError>> {
    let mut tasks = Vec::new();
    for (name, function, units, agreement) in TASKS {
        if !wanted(name) {
            continue;
        }
        let library = tools.library(&source("double_pendulum.cpp"));
        let vectors = (!name.ends_with(SCALAR)).then(Instructions::best);
        let (ours, peer) = match function {
            "monte_carlo" => {
                (sampling(samples()?, vectors), library.and_then(|library| MonteCarloByHand::load(&library)))
            }
            _ => (sweep(vectors), library.and_then(|library| SweepByHand::load(&library, function))),
        };
        tasks.push(Task { name: name.to_owned(), units: [units, units], agreement, ours, peer });
    }
    Ok(tasks)
}

/// One design and the speeds of a sweep.
struct Sweep {
    design: [f64; 4],
    speeds: [f64; SPEEDS],
}

fn sweeps() -> Vec<Sweep> {
    let mut random = Random(2);
    let sweep = |_| {
        let [l1, l2, m1, m2]: [f64; 4] = random.array(1.0, 1.1);
        let (low, high) = (random.between(3.2, 3.3), random.between(7.5, 8.0));
        let speed = |k| low + (high - low) * k as f64 / (SPEEDS - 1) as f64;
        Sweep { design: [l1, l2, 3.0 * m1, 3.0 * m2], speeds: std::array::from_fn(speed) }
    };
    (0..INPUTS).map(sweep).collect()
}

/// Solves every speed starting from the equilibria before it; `each` may use the results until the next call.
fn follow(
    sweep: &Sweep,
    vectors: Option<Instructions>,
    mut each: impl FnMut(&SweepPoint, &Result<Sensitivities, Error>),
) {
    let each = |point: &SweepPoint, slopes: &Result<Sensitivities, Error>| {
        each(point, slopes);
        ControlFlow::Continue(())
    };
    let following = Following::from(Policy::Stable).vectors(vectors);
    let along = (DoublePendulum::omega.any(), &sweep.speeds[..]);
    let values = (&[0.0][..], &sweep.design[..]);
    let done = sensitivity_sweep(&DoublePendulum, values, &START, following, along, each);
    debug_assert!(done.is_ok());
}

fn sweep(vectors: Option<Instructions>) -> Box<dyn Work> {
    Box::new(Closures {
        inputs: sweeps(),
        evaluate: move |sweep: &Sweep| {
            follow(sweep, vectors, |point, slopes| {
                black_box((point, slopes));
            });
        },
        results: move |sweep: &Sweep| {
            let mut arrays = Vec::new();
            follow(sweep, vectors, |point, slopes| {
                let (Ok(state), Ok(modes), Ok(slopes)) = (&point.equilibrium, &point.modes, slopes) else {
                    return;
                };
                arrays.push(state.coordinates.to_vec());
                arrays.push(modes.frequencies().iter().flatten().copied().collect());
                for mode in slopes.modes.iter() {
                    let slopes = mode.frequency().map(|slopes| slopes.by_design.to_vec());
                    arrays.push(slopes.unwrap_or_default());
                }
            });
            arrays
        },
    })
}

/// `int sweep(design, start, speeds, count, out)`.
type SweepFunction = unsafe extern "C" fn(*const f64, *const f64, *const f64, c_int, *mut f64) -> c_int;

struct SweepByHand {
    function: SweepFunction,
    inputs: Vec<Sweep>,
    out: Vec<f64>,
    _library: Library,
}

impl SweepByHand {
    fn load(library: &Path, name: &str) -> Result<Box<dyn Work>, String> {
        // SAFETY: the library is compiled from the C++ of this package: it runs no code when loaded, and the function
        // has this type.
        #[allow(unsafe_code)]
        let (library, function) = unsafe {
            let library = Library::new(library).map_err(|error| error.to_string())?;
            let function = library.get::<SweepFunction>(name.as_bytes());
            let function = *function.map_err(|error| error.to_string())?;
            (library, function)
        };
        Ok(Box::new(Self { function, inputs: sweeps(), out: vec![0.0; SPEEDS * WIDTH], _library: library }))
    }

    fn call(&mut self, input: usize) -> c_int {
        let sweep = black_box(&self.inputs[input]);
        // SAFETY: the arrays have the lengths that the function reads and writes.
        #[allow(unsafe_code)]
        let done = unsafe {
            (self.function)(
                sweep.design.as_ptr(),
                START.as_ptr(),
                sweep.speeds.as_ptr(),
                SPEEDS as c_int,
                self.out.as_mut_ptr(),
            )
        };
        black_box(&self.out);
        done
    }
}

impl Work for SweepByHand {
    fn inputs(&self) -> usize {
        self.inputs.len()
    }

    fn evaluate(&mut self, input: usize) {
        self.call(input);
    }

    fn results(&mut self, input: usize) -> Vec<Vec<f64>> {
        let done = self.call(input) as usize;
        let rows = self.out[..done * WIDTH].chunks(WIDTH);
        let arrays = |row: &[f64]| [&row[..2], &row[2..4], &row[4..8], &row[8..]].map(<[f64]>::to_vec);
        rows.flat_map(arrays).collect()
    }
}

/// One Monte Carlo run: nominal state and seed.
struct Samples {
    state: State,
    modes: Modes,
    tolerances: Tolerances,
    seed: u64,
}

/// Fewer than the inputs of other tasks: each is thousands of evaluations.
const SEEDS: usize = 8;

fn samples() -> Result<Vec<Samples>, Error> {
    let tolerances = Tolerances::declared(&DoublePendulum::DESCRIPTION)?;
    let set = |(seed, sweep): (usize, Sweep)| {
        let (inputs, design) = ([sweep.speeds[10 * seed]], &sweep.design);
        let state = equilibrium(&DoublePendulum, &inputs, design, &START, Policy::Stable)?;
        let modes = modes(&state)?;
        Ok(Samples { state, modes, tolerances: tolerances.clone(), seed: seed as u64 })
    };
    let sweeps = sweeps().into_iter().take(SEEDS);
    sweeps.enumerate().map(set).collect()
}

fn draw(samples: &Samples, vectors: Option<Instructions>, keep_samples: bool) -> Result<MonteCarlo, Error> {
    let sampling =
        Sampling::default().samples(SAMPLES).seed(samples.seed).threads(1).keep_samples(keep_samples).vectors(vectors);
    let Samples { state, modes, tolerances, .. } = samples;
    monte_carlo(&DoublePendulum, state, modes, tolerances, &sampling)
}

fn sampling(inputs: Vec<Samples>, vectors: Option<Instructions>) -> Box<dyn Work> {
    Box::new(Closures {
        inputs,
        evaluate: move |samples: &Samples| {
            let _ = black_box(&draw(samples, vectors, false));
        },
        results: move |samples: &Samples| {
            let statistics = draw(samples, vectors, false).map(|run| run.modes);
            let statistics = statistics.iter().flat_map(|modes| modes.iter().flatten());
            let flat = statistics.flat_map(|mode| [Some(mode.mean), mode.sigma]);
            vec![flat.flatten().collect()]
        },
    })
}

/// `int monte_carlo(start, speed, designs, count, out)`.
type MonteCarloFunction = unsafe extern "C" fn(*const f64, f64, *const f64, c_int, *mut f64) -> c_int;

/// Uses the samples of our side, drawn in advance: drawing them costs this side nothing.
struct MonteCarloByHand {
    function: MonteCarloFunction,
    inputs: Vec<(State, Vec<f64>)>,
    out: [f64; 4],
    _library: Library,
}

impl MonteCarloByHand {
    fn load(library: &Path) -> Result<Box<dyn Work>, String> {
        // SAFETY: the library is compiled from the C++ of this package: it runs no code when loaded, and the function
        // has this type.
        #[allow(unsafe_code)]
        let (library, function) = unsafe {
            let library = Library::new(library).map_err(|error| error.to_string())?;
            let function = library.get::<MonteCarloFunction>(b"monte_carlo");
            let function = *function.map_err(|error| error.to_string())?;
            (library, function)
        };
        let designs = |samples: Samples| {
            let all = draw(&samples, None, true)?.all.unwrap_or_default();
            let flat = all.iter().flat_map(|sample| &sample.design).copied().collect();
            Ok((samples.state, flat))
        };
        let samples = samples().map_err(|error| error.to_string())?.into_iter();
        let inputs: Result<_, Error> = samples.map(designs).collect();
        Ok(Box::new(Self {
            function,
            inputs: inputs.map_err(|error| error.to_string())?,
            out: [0.0; 4],
            _library: library,
        }))
    }
}

impl Work for MonteCarloByHand {
    fn inputs(&self) -> usize {
        self.inputs.len()
    }

    fn evaluate(&mut self, input: usize) {
        let (state, designs) = black_box(&self.inputs[input]);
        // SAFETY: four dimensions are read and four numbers written per sample.
        #[allow(unsafe_code)]
        unsafe {
            (self.function)(
                state.coordinates.as_ptr(),
                state.inputs[0],
                designs.as_ptr(),
                (designs.len() / 4) as c_int,
                self.out.as_mut_ptr(),
            );
        }
        black_box(&self.out);
    }

    fn results(&mut self, input: usize) -> Vec<Vec<f64>> {
        self.evaluate(input);
        vec![self.out.to_vec()]
    }
}
