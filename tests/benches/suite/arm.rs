//! The seven-joint arm of `tests/truth/panda_arm.json`: equations of motion against C code that CasADi generates from
//! recursive Newton-Euler in each body's own frame.

use std::hint::black_box;
use std::path::PathBuf;

use eigentol::kernels::lanes::{self, LaneKernel};
use eigentol::scalar::{Batch, Instructions, WIDTH};
use eigentol::{Mechanism, mechanism};

use crate::casadi::CasadiWork;
use crate::lanes::vectors;
use crate::tools::{Tools, newer, source};
use crate::work::{AGREEMENT, Closures, INPUTS, Random, Task, Work};

macro_rules! arm {
    ($($tokens:tt)*) => {
        mechanism! { $($tokens)* }
        /// The declaration, for counting its operations.
        pub(crate) const DECLARATION: &str = stringify!($($tokens)*);
    };
}

arm! {
    /// The arm, and a spring that turns the first joint back, which nothing else does.
    pub(crate) mechanism Arm {
        gravity 9.81 m/s^2 along -z;
        body link1: rigid(mass: 4.970684 kg, center: [0.003875, 0.002081, -0.04762] m,
            inertia: [0.70337, 0.70661, 0.009117, -0.000139, 0.019169, 0.006772] kg*m^2);
        joint q1: revolute(z) from ground to link1 at [0.0, 0.0, 0.333] m;
        force spring1: spring(on: q1, stiffness: 1 N*m/rad);
        body link2: rigid(mass: 0.646926 kg, center: [-0.003141, -0.02872, 0.003495] m,
            inertia: [0.007962, 0.02811, 0.025995, -0.003925, 0.000704, 0.010254] kg*m^2);
        joint q2: revolute(z) from link1 to link2 rotated(x, -90 deg);
        body link3: rigid(mass: 3.228604 kg, center: [0.027518, 0.039252, -0.066502] m,
            inertia: [0.037242, 0.036155, 0.01083, -0.004761, -0.012805, -0.011396] kg*m^2);
        joint q3: revolute(z) from link2 to link3 at [0.0, -0.316, 0.0] m rotated(x, 90 deg);
        body link4: rigid(mass: 3.587895 kg, center: [-0.05316999999999998, 0.10441899999999996, 0.02745399999999999] m,
            inertia: [0.025853, 0.019552, 0.028323, 0.007796, 0.008641, -0.001332] kg*m^2);
        joint q4: revolute(z) from link3 to link4 at [0.0825, 0.0, 0.0] m rotated(x, 90 deg);
        body link5: rigid(mass: 1.225946 kg, center: [-0.011953, 0.041065, -0.038437] m,
            inertia: [0.035549, 0.029474, 0.008627, -0.002117, 0.000229, -0.004037] kg*m^2);
        joint q5: revolute(z) from link4 to link5 at [-0.0825, 0.384, 0.0] m rotated(x, -90 deg);
        body link6: rigid(mass: 1.666555 kg, center: [0.060149, -0.014117, -0.010517] m,
            inertia: [0.0019640000000000005, 0.004354, 0.005433, 0.000109, 0.000341, -0.001158] kg*m^2);
        joint q6: revolute(z) from link5 to link6 rotated(x, 90 deg);
        body link7: rigid(mass: 1.4955219999999998 kg, center: [0.0017208742976286579, 0.00136035441716123, 0.1004852811486558] m,
            inertia: [0.016529853712634626, 0.014107248642161839, 0.006676955556640956, 0.0003948922971191777, -0.001051105327046708, -0.0007066957106145017] kg*m^2);
        joint q7: revolute(z) from link6 to link7 at [0.088, 0.0, 0.0] m rotated(x, 90 deg);
    }
}

/// Timed functions, by CasADi's names.
const FUNCTIONS: [&str; 4] = ["motion_residual", "motion", "residual_and_stiffness", "motion_linear"];

/// The numerical data of the arm.
pub(crate) fn numbers() -> String {
    source("../../truth/panda_arm.json").to_string_lossy().into_owned()
}

/// Functions of eight states at once.
const IN_LANES: [&str; 3] = ["motion_residual", "motion", "motion_linear"];

/// The tasks with a selected name.
pub(crate) fn tasks(wanted: &dyn Fn(&str) -> bool, tools: &mut Tools) -> Vec<Task> {
    let mut tasks = one_by_one(wanted, tools);
    for function in IN_LANES {
        for (lanes, instructions) in vectors() {
            let name = format!("arm/{function}-{lanes}");
            if wanted(&name) {
                tasks.push(Task {
                    name,
                    units: [WIDTH, WIDTH],
                    agreement: AGREEMENT,
                    ours: ours_in_lanes(function, instructions),
                    peer: peer_in_lanes(tools, function, lanes),
                });
            }
        }
    }
    tasks
}

fn one_by_one(wanted: &dyn Fn(&str) -> bool, tools: &mut Tools) -> Vec<Task> {
    let named = FUNCTIONS.map(|function| (format!("arm/{function}"), function));
    let named = named.into_iter().filter(|(name, _)| wanted(name));
    let task = |(name, function)| Task {
        name,
        units: [1, 1],
        agreement: AGREEMENT,
        ours: ours(function),
        peer: peer(tools, function),
    };
    named.map(task).collect()
}

/// Arguments of one evaluation.
struct State {
    acceleration: [f64; 7],
    velocity: [f64; 7],
    q: [f64; 7],
}

fn states() -> Vec<State> {
    let mut random = Random(7);
    let state = |_| State {
        acceleration: random.array(-3.0, 3.0),
        velocity: random.array(-2.0, 2.0),
        q: random.array(-1.5, 1.5),
    };
    (0..INPUTS).map(state).collect()
}

fn ours(function: &str) -> Box<dyn Work> {
    let inputs = states();
    let none = [];
    match function {
        "motion_residual" => Box::new(Closures {
            inputs,
            evaluate: move |s: &State| {
                black_box(&Arm.motion_residual(&s.acceleration, &s.velocity, &s.q, &none, &none));
            },
            results: move |s: &State| {
                let torques = Arm.motion_residual(&s.acceleration, &s.velocity, &s.q, &none, &none);
                vec![torques.to_vec()]
            },
        }),
        "motion_linear" => Box::new(Closures {
            inputs,
            evaluate: move |s: &State| {
                black_box(&Arm.motion_linear(&s.acceleration, &s.velocity, &s.q, &none, &none));
            },
            results: move |s: &State| {
                let all = Arm.motion_linear(&s.acceleration, &s.velocity, &s.q, &none, &none);
                [all.mass, all.damping, all.stiffness].map(|x| x.concat()).into()
            },
        }),
        "motion" => Box::new(Closures {
            inputs,
            evaluate: move |s: &State| {
                black_box(&Arm.motion(&s.velocity, &s.q, &none, &none));
            },
            results: move |s: &State| {
                let (mass, force) = Arm.motion(&s.velocity, &s.q, &none, &none);
                vec![mass.concat(), force.to_vec()]
            },
        }),
        _ => Box::new(Closures {
            inputs,
            evaluate: move |s: &State| {
                black_box(&Arm.residual_and_stiffness(&s.q, &none, &none));
            },
            results: move |s: &State| {
                let (residual, stiffness) = Arm.residual_and_stiffness(&s.q, &none, &none);
                vec![residual.to_vec(), stiffness.concat()]
            },
        }),
    }
}

/// States side by side: acceleration, velocity and position.
type Lanes = [Vec<Batch>; 3];

fn states_in_lanes() -> Vec<Lanes> {
    let all = states();
    let lanes = all.chunks_exact(WIDTH).map(|states| {
        let gather = |list: fn(&State) -> &[f64; 7]| {
            let batch = |k| Batch::from_fn(|lane| list(&states[lane])[k]);
            (0..7).map(batch).collect()
        };
        [gather(|s| &s.acceleration), gather(|s| &s.velocity), gather(|s| &s.q)]
    });
    lanes.collect()
}

fn ours_in_lanes(function: &str, instructions: Instructions) -> Box<dyn Work> {
    let all: fn(&Lanes) -> [&[Batch]; 5] = |[a, v, q]| [a, v, q, &[], &[]];
    match function {
        "motion_residual" => Box::new(InLanes::new(lanes::MotionResidual, instructions, all, [7])),
        "motion_linear" => Box::new(InLanes::new(lanes::MotionLinear, instructions, all, [49; 3])),
        _ => Box::new(InLanes::new(lanes::Motion, instructions, |[_, v, q]| [v, q, &[], &[]], [49, 7])),
    }
}

/// A kernel on batches of states.
struct InLanes<K, const N: usize, const R: usize> {
    kernel: K,
    instructions: Instructions,
    inputs: Vec<Lanes>,
    arguments: fn(&Lanes) -> [&[Batch]; N],
    results: [Vec<Batch>; R],
}

impl<K, const N: usize, const R: usize> InLanes<K, N, R> {
    fn new(kernel: K, instructions: Instructions, arguments: fn(&Lanes) -> [&[Batch]; N], entries: [usize; R]) -> Self {
        let results = entries.map(|count| vec![Batch::default(); count]);
        Self { kernel, instructions, inputs: states_in_lanes(), arguments, results }
    }
}

impl<K: LaneKernel + Copy, const N: usize, const R: usize> Work for InLanes<K, N, R> {
    fn inputs(&self) -> usize {
        self.inputs.len()
    }

    fn evaluate(&mut self, input: usize) {
        let arguments = (self.arguments)(black_box(&self.inputs[input]));
        let mut results = self.results.each_mut().map(Vec::as_mut_slice);
        lanes::evaluate(self.kernel, &Arm, self.instructions, &arguments, &mut results);
        black_box(&self.results);
    }

    fn states(&self) -> usize {
        self.inputs() * WIDTH
    }

    fn results(&mut self, state: usize) -> Vec<Vec<f64>> {
        self.evaluate(state / WIDTH);
        self.results.iter().map(|list| list.iter().map(|batch| batch.0[state % WIDTH]).collect()).collect()
    }
}

/// CasADi's C of a function.
fn generated(tools: &mut Tools, function: &str) -> Result<PathBuf, String> {
    let (script, folder) = ("arm.py", tools.written()?);
    let file = folder.join(format!("arm_{function}.c"));
    if !newer(&file, &source(script)) {
        let folder = folder.to_string_lossy();
        tools.casadi(script, &["emit", &numbers(), &folder, function])?;
    }
    Ok(file)
}

/// CasADi's C with vectors of eight numbers in place of its numbers.
fn peer_in_lanes(tools: &mut Tools, function: &str, lanes: &str) -> Result<Box<dyn Work>, String> {
    let c = generated(tools, function)?;
    let library = tools.eight_wide(&c, lanes)?;
    let arguments = |[a, v, q]: Lanes| if function == "motion" { vec![v, q] } else { vec![a, v, q] };
    let inputs = states_in_lanes().into_iter().map(arguments).collect();
    Ok(Box::new(CasadiWork::load(&library, &format!("arm_{function}"), inputs)?))
}

fn peer(tools: &mut Tools, function: &str) -> Result<Box<dyn Work>, String> {
    let file = generated(tools, function)?;
    let library = tools.library(&file)?;
    let inputs = states().into_iter().map(|s| {
        let (a, v, q) = (s.acceleration.to_vec(), s.velocity.to_vec(), s.q.to_vec());
        match function {
            "motion_residual" | "motion_linear" => vec![a, v, q],
            "motion" => vec![v, q],
            _ => vec![q],
        }
    });
    Ok(Box::new(CasadiWork::load(&library, &format!("arm_{function}"), inputs.collect())?))
}
