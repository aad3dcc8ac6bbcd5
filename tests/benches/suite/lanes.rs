//! The same kernels at several states at once, against CasADi's C at eight.

use std::hint::black_box;

use eigentol::kernels::{BatchGradient, BatchKernels, BatchLinear, BatchPartials, BatchPoint, Gradient, Linear, Sizes};
use eigentol::scalar::{Batch, Instructions, WIDTH};
use eigentol::{Matrix, Mechanism, Vector};

use crate::casadi::CasadiWork;
use crate::chains::{self, State, Visitor, visit_short};
use crate::tools::Tools;
use crate::work::{AGREEMENT, Task, Work};

/// Timed functions, by CasADi's names.
pub(crate) const FUNCTIONS: [&str; 3] = ["residual_and_stiffness", "linear", "mode_gradient"];

/// The longest chain with all partial derivatives: they are generated for larger ones only here.
const MOST_WITH_ALL: usize = 8;

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
        let all = (bars <= MOST_WITH_ALL).then_some("all");
        for function in FUNCTIONS.into_iter().chain(all) {
            for (lanes, instructions) in vectors() {
                let name = format!("chain{bars}/{function}-{lanes}");
                if !(self.wanted)(&name) {
                    continue;
                }
                self.tasks.push(Task {
                    name,
                    units: [WIDTH, WIDTH],
                    agreement: AGREEMENT,
                    ours: ours(Box::new(chain.clone()), states::<M>(), function, instructions),
                    peer: peer::<M>(self.tools, function, lanes),
                });
            }
        }
    }
}

fn peer<M: Mechanism>(tools: &mut Tools, function: &str, lanes: &str) -> Result<Box<dyn Work>, String> {
    let (name, file) = chains::emitted::<M>(tools, function)?;
    let library = tools.eight_wide(&file, lanes)?;
    let inputs = states::<M>().into_iter().map(|States { q, u, b, phi, lambda }| match function {
        "mode_gradient" => vec![q, u, b, phi, vec![lambda]],
        _ => vec![q, u, b],
    });
    Ok(Box::new(CasadiWork::load(&library, &name, inputs.collect())?))
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

/// Room for partial derivatives: of mass, damping and stiffness by coordinates, inputs and design variables; of the residual by
/// the last two.
struct All {
    matrices: [[Vec<Batch>; 3]; 3],
    residual: [Vec<Batch>; 2],
}

impl All {
    fn zeros(sizes: Sizes) -> Self {
        let n = sizes.coordinates;
        let zeros = |count| vec![Batch::default(); count];
        let [inputs, design] = [sizes.inputs, sizes.design].map(|count| count * n);
        let matrices = [n * n, inputs, design].map(|count| [(); 3].map(|()| zeros(count * n)));
        Self { matrices, residual: [zeros(inputs), zeros(design)] }
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
        "all" => Box::new(Lanes {
            inputs,
            out: All::zeros(sizes),
            evaluate: move |s: &States, out: &mut All| {
                let [by_coordinate, by_input, by_design] =
                    out.matrices.each_mut().map(|[mass, damping, stiffness]| BatchLinear { mass, damping, stiffness });
                let mut matrices = BatchPartials { by_coordinate, by_input, by_design };
                let residual = out.residual.each_mut().map(Vec::as_mut_slice);
                chain.partials_batch(instructions, s.point(), &mut matrices, residual);
            },
            lane: move |out: &All, of_lane: OfLane<'_>| {
                let (count, rows) = (sizes.design, of_lane(&out.residual[1]));
                let columns = (0..count).flat_map(|k| rows.iter().copied().skip(k).step_by(count)).collect();
                let mut results = vec![of_lane(&out.residual[0]), columns];
                results.extend([0, 2].iter().flat_map(|&kind| out.matrices.each_ref().map(|by| of_lane(&by[kind]))));
                results
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
