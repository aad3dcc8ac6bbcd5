//! Kernels of the chain of bars against C that CasADi generates from closed forms.

use std::hint::black_box;

use eigentol::{Linear, LinearPartials, Mechanism};

use crate::casadi::CasadiWork;
use crate::tools::{Tools, newer, source};
use crate::work::{AGREEMENT, Closures, INPUTS, Random, Task, Work};

/// Sees every chain.
pub(crate) trait Visitor {
    fn visit<M, const N: usize, const P: usize>(&mut self, chain: M)
    where
        M: Mechanism<N, 1, P, 0> + 'static;
}

#[allow(unused_mut)]
mod generated {
    use super::Visitor;

    include!(concat!(env!("OUT_DIR"), "/chains.rs"));
}

pub(crate) use generated::{LONGEST, Longest, visit_short};

/// Functions that are timed, by the names of CasADi's side.
const FUNCTIONS: [&str; 4] = ["residual_and_stiffness", "linear", "mode_gradient", "all"];

/// Longer chains have no "all": C compilers take minutes for it.
const MOST_WITH_ALL: usize = 16;

/// The tasks whose name is wanted.
pub(crate) fn tasks(wanted: &dyn Fn(&str) -> bool, tools: &mut Tools) -> Vec<Task> {
    let mut collector = Collector {
        wanted,
        tools,
        tasks: Vec::new(),
    };
    generated::visit_all(&mut collector);
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
            let name = format!("chain{N}/{function}");
            if (function == "all" && N > MOST_WITH_ALL) || !(self.wanted)(&name) {
                continue;
            }
            self.tasks.push(Task {
                name,
                units: [1, 1],
                agreement: AGREEMENT,
                ours: ours(chain.clone(), function),
                peer: peer::<N, P>(self.tools, function),
            });
        }
    }
}

/// Arguments of an evaluation.
pub(crate) struct State<const N: usize, const P: usize> {
    pub(crate) q: [f64; N],
    pub(crate) u: [f64; 1],
    pub(crate) b: [f64; P],
    pub(crate) phi: [f64; N],
    pub(crate) lambda: f64,
}

pub(crate) fn states<const N: usize, const P: usize>() -> Vec<State<N, P>> {
    let mut random = Random(N as u64);
    let state = |_| State {
        q: random.array(-1.5, 1.5),
        u: random.array(0.5, 4.0),
        b: random.array(0.5, 2.0),
        phi: random.array(-1.0, 1.0),
        lambda: random.between(1.0, 20.0),
    };
    (0..INPUTS).map(state).collect()
}

fn ours<M, const N: usize, const P: usize>(chain: M, function: &str) -> Box<dyn Work>
where
    M: Mechanism<N, 1, P, 0> + 'static,
{
    let inputs = states::<N, P>();
    let again = chain.clone();
    let mut room = Box::new(LinearPartials::default());
    match function {
        "residual_and_stiffness" => Box::new(Closures {
            inputs,
            evaluate: move |s: &State<N, P>| {
                black_box(&chain.residual_and_stiffness(&s.q, &s.u, &s.b));
            },
            results: move |s: &State<N, P>| {
                let (residual, stiffness) = again.residual_and_stiffness(&s.q, &s.u, &s.b);
                vec![residual.to_vec(), stiffness.concat()]
            },
        }),
        "linear" => Box::new(Closures {
            inputs,
            evaluate: move |s: &State<N, P>| {
                black_box(&chain.linear(&s.q, &s.u, &s.b));
            },
            results: move |s: &State<N, P>| {
                let linear = again.linear(&s.q, &s.u, &s.b);
                vec![linear.mass.concat(), linear.stiffness.concat()]
            },
        }),
        "mode_gradient" => Box::new(Closures {
            inputs,
            evaluate: move |s: &State<N, P>| {
                black_box(&chain.mode_gradient(&s.q, &s.u, &s.b, &s.phi, s.lambda));
            },
            results: move |s: &State<N, P>| {
                let gradient = again.mode_gradient(&s.q, &s.u, &s.b, &s.phi, s.lambda);
                let by_coordinate = gradient.coordinates.to_vec();
                vec![
                    by_coordinate,
                    gradient.inputs.to_vec(),
                    gradient.design.to_vec(),
                ]
            },
        }),
        _ => Box::new(Closures {
            inputs,
            evaluate: move |s: &State<N, P>| {
                if N < 8 {
                    black_box(&chain.partials(&s.q, &s.u, &s.b));
                } else {
                    black_box(&chain.residual_partials(&s.q, &s.u, &s.b));
                    chain.linear_partials_into(&s.q, &s.u, &s.b, &mut room);
                    black_box(&room);
                }
            },
            results: move |s: &State<N, P>| all_partials(&again, s),
        }),
    }
}

/// Every explicit partial derivative in the order of CasADi's "all": one matrix after the other, by columns.
fn all_partials<M, const N: usize, const P: usize>(chain: &M, s: &State<N, P>) -> Vec<Vec<f64>>
where
    M: Mechanism<N, 1, P, 0>,
{
    let (by_input, by_design) = chain.residual_partials(&s.q, &s.u, &s.b);
    let columns = (0..P).flat_map(|k| by_design.map(|row| row[k])).collect();
    let partials = chain.linear_partials(&s.q, &s.u, &s.b);
    let mut results = vec![by_input.concat(), columns];
    for mass in [true, false] {
        let matrix = |x: &Linear<f64, N>| if mass { x.mass } else { x.stiffness };
        let flat = |all: &[Linear<f64, N>]| all.iter().flat_map(|x| matrix(x).concat()).collect();
        results.push(flat(&partials.by_coordinate));
        results.push(flat(&partials.by_input));
        results.push(flat(&partials.by_design));
    }
    results
}

pub(crate) fn peer<const N: usize, const P: usize>(
    tools: &mut Tools,
    function: &str,
) -> Result<Box<dyn Work>, String> {
    let (script, folder) = ("chain.py", tools.written()?);
    let name = format!("chain{N}_{function}");
    let file = folder.join(format!("{name}.c"));
    if !newer(&file, &source(script)) {
        let (size, folder) = (N.to_string(), folder.to_string_lossy());
        tools.casadi(script, &["emit", &size, &folder, function])?;
    }
    let library = tools.library(&file)?;
    let inputs = states::<N, P>().into_iter().map(|s| {
        let mut arguments = vec![s.q.to_vec(), s.u.to_vec(), s.b.to_vec()];
        if function == "mode_gradient" {
            arguments.extend([s.phi.to_vec(), vec![s.lambda]]);
        }
        arguments
    });
    Ok(Box::new(CasadiWork::load(
        &library,
        &name,
        inputs.collect(),
    )?))
}
