//! The same kernels at several states at once, against CasADi's C at one state at a time.

use std::hint::black_box;

use eigentol::kernels::{BatchGradient, BatchKernels, BatchLinear, BatchPoint, Gradient, Linear};
use eigentol::scalar::{Batch, Instructions, WIDTH};
use eigentol::{Matrix, Mechanism, Vector};

use crate::chains::{self, State, Visitor, visit_short};
use crate::tools::Tools;
use crate::work::{AGREEMENT, Task, Work};

/// Timed functions, by CasADi's names.
pub(crate) const FUNCTIONS: [&str; 3] = ["residual_and_stiffness", "linear", "mode_gradient"];

/// Vectors of four and eight numbers, if this processor supports them.
pub(crate) fn vectors() -> impl Iterator<Item = (&'static str, Instructions)> {
    let sets = Instructions::available().skip(1);
    ["lanes4", "lanes8"].into_iter().zip(sets)
}

/// The tasks with a selected name.
pub(crate) fn tasks(wanted: &dyn Fn(&str) -> bool, tools: &mut Tools) -> Vec<Task> {
    let mut collector = Collector { wanted, tools, tasks: Vec::new() };
    visit_short(&mut collector);
    collector.tasks
}

struct Collector<'a> {
    wanted: &'a dyn Fn(&str) -> bool,
    tools: &'a mut Tools,
    tasks: Vec<Task>,
}

impl Visitor for Collector<'_> {
    fn visit<M: Mechanism + 'static>(&mut self, chain: M) {
        let bars = chains::bars::<M>();
        for function in FUNCTIONS {
            for (lanes, instructions) in vectors() {
                let name = format!("chain{bars}/{function}-{lanes}");
                if !(self.wanted)(&name) {
                    continue;
                }
                self.tasks.push(Task {
                    name,
                    units: [WIDTH, 1],
                    agreement: AGREEMENT,
                    ours: ours(Box::new(chain.clone()), states::<M>(), function, instructions),
                    peer: chains::peer::<M>(self.tools, function),
                });
            }
        }
    }
}

/// A batch full of states.
pub(crate) struct States {
    q: Vec<Batch>,
    u: Vec<Batch>,
    b: Vec<Batch>,
    phi: Vec<Batch>,
    lambda: Batch,
}

impl States {
    fn point(&self) -> BatchPoint<'_> {
        let Self { q, u, b, .. } = self;
        BatchPoint { q, u, b }
    }
}

pub(crate) fn states<M: Mechanism>() -> Vec<States> {
    fn gather<M: Mechanism>(states: &[State<M>], field: fn(&State<M>) -> &[f64]) -> Vec<Batch> {
        let count = field(&states[0]).len();
        let batch = |k| Batch::from_fn(|lane| field(&states[lane])[k]);
        (0..count).map(batch).collect()
    }
    let all = chains::states::<M>();
    let batches = all.chunks_exact(WIDTH).map(|states| States {
        q: gather(states, |s| s.q.as_ref()),
        u: gather(states, |s| s.u.as_ref()),
        b: gather(states, |s| s.b.as_ref()),
        phi: gather(states, |s| s.phi.as_ref()),
        lambda: Batch::from_fn(|lane| states[lane].lambda),
    });
    batches.collect()
}

/// Extracts the numbers of one lane.
type OfLane<'a> = &'a dyn Fn(&[Batch]) -> Vec<f64>;

/// A kernel on batches: the result it fills, and a way to read the numbers of one lane.
struct Lanes<R, E, F> {
    inputs: Vec<States>,
    out: R,
    evaluate: E,
    lane: F,
}

impl<R, E, F> Work for Lanes<R, E, F>
where
    E: FnMut(&States, &mut R),
    F: Fn(&R, OfLane<'_>) -> Vec<Vec<f64>>,
{
    fn inputs(&self) -> usize {
        self.inputs.len()
    }

    fn evaluate(&mut self, input: usize) {
        (self.evaluate)(black_box(&self.inputs[input]), &mut self.out);
        black_box(&self.out);
    }

    /// `input` counts states, not batches.
    fn results(&mut self, input: usize) -> Vec<Vec<f64>> {
        self.evaluate(input / WIDTH);
        let of_lane = |batches: &[Batch]| batches.iter().map(|x| x.0[input % WIDTH]).collect();
        (self.lane)(&self.out, &of_lane)
    }
}

pub(crate) fn ours(
    chain: Box<dyn BatchKernels>,
    inputs: Vec<States>,
    function: &str,
    instructions: Instructions,
) -> Box<dyn Work> {
    let sizes = chain.sizes();
    let n = sizes.coordinates;
    match function {
        "residual_and_stiffness" => Box::new(Lanes {
            inputs,
            out: (Vector::zeros(n), Matrix::zeros(n, n)),
            evaluate: move |s: &States, (residual, stiffness): &mut (Vector<Batch>, Matrix<Batch>)| {
                chain.residual_and_stiffness_batch(instructions, s.point(), residual, stiffness.as_flattened_mut());
            },
            lane: |out: &(Vector<Batch>, Matrix<Batch>), of_lane: OfLane<'_>| {
                vec![of_lane(&out.0), of_lane(out.1.as_flattened())]
            },
        }),
        "linear" => Box::new(Lanes {
            inputs,
            out: Linear::zeros(n),
            evaluate: move |s: &States, out: &mut Linear<Batch>| {
                let mut to = BatchLinear {
                    mass: out.mass.as_flattened_mut(),
                    damping: out.damping.as_flattened_mut(),
                    stiffness: out.stiffness.as_flattened_mut(),
                };
                chain.linear_batch(instructions, s.point(), &mut to);
            },
            lane: |out: &Linear<Batch>, of_lane: OfLane<'_>| {
                let matrices = [&out.mass, &out.stiffness];
                matrices.map(|x| of_lane(x.as_flattened())).to_vec()
            },
        }),
        _ => Box::new(Lanes {
            inputs,
            out: Gradient::zeros(sizes),
            evaluate: move |s: &States, out: &mut Gradient<Batch>| {
                let mut to = BatchGradient {
                    coordinates: &mut out.coordinates,
                    inputs: &mut out.inputs,
                    design: &mut out.design,
                };
                chain.mode_gradient_batch(instructions, s.point(), &s.phi, &s.lambda, &mut to);
            },
            lane: |out: &Gradient<Batch>, of_lane: OfLane<'_>| {
                vec![of_lane(&out.coordinates), of_lane(&out.inputs), of_lane(&out.design)]
            },
        }),
    }
}
