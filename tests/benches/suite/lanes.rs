//! The same kernels at several states at once, against CasADi's C at one state after the other.

use std::hint::black_box;

use eigentol::lanes::{self, Batch, Instructions, WIDTH};
use eigentol::{Gradient, Linear, Mechanism};

use crate::chains::{self, State, Visitor, visit_short};
use crate::tools::Tools;
use crate::work::{AGREEMENT, Task, Work};

/// Functions that are timed, by the names of CasADi's side.
const FUNCTIONS: [&str; 3] = ["residual_and_stiffness", "linear", "mode_gradient"];

/// Vectors with four and eight numbers, where this processor has them.
fn vectors() -> impl Iterator<Item = (&'static str, Instructions)> {
    let sets = Instructions::available().skip(1);
    ["lanes4", "lanes8"].into_iter().zip(sets)
}

/// The tasks whose name is wanted.
pub(crate) fn tasks(wanted: &dyn Fn(&str) -> bool, tools: &mut Tools) -> Vec<Task> {
    let mut collector = Collector {
        wanted,
        tools,
        tasks: Vec::new(),
    };
    visit_short(&mut collector);
    collector.tasks
}

struct Collector<'a> {
    wanted: &'a dyn Fn(&str) -> bool,
    tools: &'a mut Tools,
    tasks: Vec<Task>,
}

impl Visitor for Collector<'_> {
    fn visit<M, const N: usize, const P: usize>(&mut self, chain: M)
    where
        M: Mechanism<N, 1, P, 0> + 'static,
    {
        for function in FUNCTIONS {
            for (lanes, instructions) in vectors() {
                let name = format!("chain{N}/{function}-{lanes}");
                if !(self.wanted)(&name) {
                    continue;
                }
                self.tasks.push(Task {
                    name,
                    units: [WIDTH, 1],
                    agreement: AGREEMENT,
                    ours: ours(chain.clone(), function, instructions),
                    peer: chains::peer::<N, P>(self.tools, function),
                });
            }
        }
    }
}

/// As many states as a batch holds.
struct States<const N: usize, const P: usize> {
    q: [Batch; N],
    u: [Batch; 1],
    b: [Batch; P],
    phi: [Batch; N],
    lambda: Batch,
}

fn states<const N: usize, const P: usize>() -> Vec<States<N, P>> {
    fn gather<const N: usize, const P: usize, const K: usize>(
        states: &[State<N, P>],
        field: fn(&State<N, P>) -> &[f64; K],
    ) -> [Batch; K] {
        std::array::from_fn(|k| Batch::from_fn(|lane| field(&states[lane])[k]))
    }
    let all = chains::states::<N, P>();
    let batches = all.chunks_exact(WIDTH).map(|states| States {
        q: gather(states, |s| &s.q),
        u: gather(states, |s| &s.u),
        b: gather(states, |s| &s.b),
        phi: gather(states, |s| &s.phi),
        lambda: Batch::from_fn(|lane| states[lane].lambda),
    });
    batches.collect()
}

/// Takes the numbers of one lane.
type OfLane<'a> = &'a dyn Fn(&[Batch]) -> Vec<f64>;

/// A kernel on batches: what it fills, and how the numbers of one lane are read from that.
struct Lanes<S, R, E, F> {
    inputs: Vec<S>,
    out: R,
    evaluate: E,
    lane: F,
}

impl<S, R, E, F> Work for Lanes<S, R, E, F>
where
    E: FnMut(&S, &mut R),
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

fn ours<M, const N: usize, const P: usize>(
    chain: M,
    function: &str,
    instructions: Instructions,
) -> Box<dyn Work>
where
    M: Mechanism<N, 1, P, 0> + 'static,
{
    let inputs = states::<N, P>();
    let zero = Batch::default();
    match function {
        "residual_and_stiffness" => Box::new(Lanes {
            inputs,
            out: ([zero; N], [[zero; N]; N]),
            evaluate: move |s: &States<N, P>, out: &mut _| {
                lanes::residual_and_stiffness(instructions, &chain, &s.q, &s.u, &s.b, out);
            },
            lane: |out: &([Batch; N], [[Batch; N]; N]), of_lane: OfLane<'_>| {
                vec![of_lane(&out.0), of_lane(out.1.as_flattened())]
            },
        }),
        "linear" => Box::new(Lanes {
            inputs,
            out: Linear::<Batch, N>::default(),
            evaluate: move |s: &States<N, P>, out: &mut _| {
                lanes::linear(instructions, &chain, &s.q, &s.u, &s.b, out);
            },
            lane: |out: &Linear<Batch, N>, of_lane: OfLane<'_>| {
                let matrices = [&out.mass, &out.stiffness];
                matrices.map(|x| of_lane(x.as_flattened())).to_vec()
            },
        }),
        _ => Box::new(Lanes {
            inputs,
            out: Gradient::<Batch, N, 1, P>::default(),
            evaluate: move |s: &States<N, P>, out: &mut _| {
                let (phi, lambda) = (&s.phi, &s.lambda);
                lanes::mode_gradient(instructions, &chain, &s.q, &s.u, &s.b, phi, lambda, out);
            },
            lane: |out: &Gradient<Batch, N, 1, P>, of_lane: OfLane<'_>| {
                vec![
                    of_lane(&out.coordinates),
                    of_lane(&out.inputs),
                    of_lane(&out.design),
                ]
            },
        }),
    }
}
