//! Kernels of the chain of bars against C code that CasADi generates from closed forms.

use std::hint::black_box;
use std::path::PathBuf;

use eigentol::{Array, Linear, LinearPartials, Mechanism, PartialsOf, Square};

use crate::casadi::CasadiWork;
use crate::tools::{Tools, newer, source};
use crate::work::{AGREEMENT, Closures, INPUTS, Random, Task, Work, flat};

/// Visits every chain.
pub(crate) trait Visitor {
    fn visit<M: Mechanism + 'static>(&mut self, chain: M);
}

#[allow(unused_mut)]
mod generated {
    use super::Visitor;

    include!(concat!(env!("OUT_DIR"), "/chains.rs"));
}

pub(crate) use generated::{LONGEST, Longest, visit_short};

/// Timed functions, by CasADi's names.
const FUNCTIONS: [&str; 4] = ["residual_and_stiffness", "linear", "mode_gradient", "all"];

/// The longest chain with the set "all": C compilers take minutes for it.
const MOST_WITH_ALL: usize = 16;

/// The tasks with a selected name.
pub(crate) fn tasks(wanted: &dyn Fn(&str) -> bool, tools: &mut Tools) -> Vec<Task> {
    let mut collector = Collector { wanted, tools, tasks: Vec::new() };
    generated::visit_all(&mut collector);
    collector.tasks
}

struct Collector<'a> {
    wanted: &'a dyn Fn(&str) -> bool,
    tools: &'a mut Tools,
    tasks: Vec<Task>,
}

impl Visitor for Collector<'_> {
    fn visit<M: Mechanism + 'static>(&mut self, chain: M) {
        let bars = bars::<M>();
        for function in FUNCTIONS {
            let name = format!("chain{bars}/{function}");
            if (function == "all" && bars > MOST_WITH_ALL) || !(self.wanted)(&name) {
                continue;
            }
            self.tasks.push(Task {
                name,
                units: [1, 1],
                agreement: AGREEMENT,
                ours: ours(chain.clone(), function),
                peer: peer::<M>(self.tools, function),
            });
        }
    }
}

/// The number of bars of a chain.
pub(crate) fn bars<M: Mechanism>() -> usize {
    M::Coordinates::<f64>::LEN
}

/// Arguments of one evaluation.
pub(crate) struct State<M: Mechanism> {
    pub(crate) q: M::Coordinates<f64>,
    pub(crate) u: M::Inputs<f64>,
    pub(crate) b: M::Design<f64>,
    pub(crate) phi: M::Coordinates<f64>,
    pub(crate) lambda: f64,
}

pub(crate) fn states<M: Mechanism>() -> Vec<State<M>> {
    let mut random = Random(bars::<M>() as u64);
    let state = |_| State {
        q: random.array(-1.5, 1.5),
        u: random.array(0.5, 4.0),
        b: random.array(0.5, 2.0),
        phi: random.array(-1.0, 1.0),
        lambda: random.between(1.0, 20.0),
    };
    (0..INPUTS).map(state).collect()
}

pub(crate) fn ours<M: Mechanism + 'static>(chain: M, function: &str) -> Box<dyn Work> {
    let inputs = states();
    let again = chain.clone();
    match function {
        "residual_and_stiffness" => Box::new(Closures {
            inputs,
            evaluate: move |s: &State<M>| {
                black_box(&chain.residual_and_stiffness(&s.q, &s.u, &s.b));
            },
            results: move |s: &State<M>| {
                let (residual, stiffness) = again.residual_and_stiffness(&s.q, &s.u, &s.b);
                vec![residual.as_ref().to_vec(), flat(stiffness)]
            },
        }),
        "linear" => Box::new(Closures {
            inputs,
            evaluate: move |s: &State<M>| {
                black_box(&chain.linear(&s.q, &s.u, &s.b));
            },
            results: move |s: &State<M>| {
                let linear = again.linear(&s.q, &s.u, &s.b);
                vec![flat(linear.mass), flat(linear.stiffness)]
            },
        }),
        "mode_gradient" => Box::new(Closures {
            inputs,
            evaluate: move |s: &State<M>| {
                black_box(&chain.mode_gradient(&s.q, &s.u, &s.b, &s.phi, s.lambda));
            },
            results: move |s: &State<M>| {
                let gradient = again.mode_gradient(&s.q, &s.u, &s.b, &s.phi, s.lambda);
                vec![
                    gradient.coordinates.as_ref().to_vec(),
                    gradient.inputs.as_ref().to_vec(),
                    gradient.design.as_ref().to_vec(),
                ]
            },
        }),
        _ => {
            let mut room = Box::new(zeros::<M>());
            Box::new(Closures {
                inputs,
                evaluate: move |s: &State<M>| {
                    if bars::<M>() < 8 {
                        black_box(&chain.partials(&s.q, &s.u, &s.b));
                    } else {
                        black_box(&chain.residual_partials(&s.q, &s.u, &s.b));
                        chain.linear_partials_into(&s.q, &s.u, &s.b, &mut room);
                        black_box(&room);
                    }
                },
                results: move |s: &State<M>| all_partials(&again, s),
            })
        }
    }
}

/// Every explicit partial derivative in the order of CasADi's "all": one matrix after another, by columns.
fn all_partials<M: Mechanism>(chain: &M, s: &State<M>) -> Vec<Vec<f64>> {
    let (by_input, by_design) = chain.residual_partials(&s.q, &s.u, &s.b);
    let rows = by_design.as_ref();
    let column = |k: usize| rows.iter().map(move |row| row.as_ref()[k]);
    let columns = (0..M::Design::<f64>::LEN).flat_map(column).collect();
    let partials = chain.linear_partials(&s.q, &s.u, &s.b);
    let mut results = vec![flat(by_input), columns];
    let lists = [partials.by_coordinate.as_ref(), partials.by_input.as_ref(), partials.by_design.as_ref()];
    for matrix in [|x: &Linear<Square<M, f64>>| flat(x.mass), |x: &Linear<Square<M, f64>>| flat(x.stiffness)] {
        results.extend(lists.map(|list| list.iter().flat_map(matrix).collect()));
    }
    results
}

/// A zeroed buffer for [`Mechanism::linear_partials_into`].
fn zeros<M: Mechanism>() -> PartialsOf<M, f64> {
    let zeros: Square<M, f64> = Array::filled(Array::filled(0.0));
    let zeros = Linear { mass: zeros, damping: zeros, stiffness: zeros };
    LinearPartials {
        by_coordinate: Array::filled(zeros),
        by_input: Array::filled(zeros),
        by_design: Array::filled(zeros),
    }
}

/// The name of CasADi's function, and its C.
pub(crate) fn emitted<M: Mechanism>(tools: &mut Tools, function: &str) -> Result<(String, PathBuf), String> {
    let bars = bars::<M>();
    let (script, folder) = ("chain.py", tools.written()?);
    let name = format!("chain{bars}_{function}");
    let file = folder.join(format!("{name}.c"));
    if !newer(&file, &source(script)) {
        let (size, folder) = (bars.to_string(), folder.to_string_lossy());
        tools.casadi(script, &["emit", &size, &folder, function])?;
    }
    Ok((name, file))
}

fn peer<M: Mechanism>(tools: &mut Tools, function: &str) -> Result<Box<dyn Work>, String> {
    let (name, file) = emitted::<M>(tools, function)?;
    let library = tools.library(&file)?;
    let inputs = states::<M>().into_iter().map(|s| {
        let mut arguments = [s.q.as_ref(), s.u.as_ref(), s.b.as_ref()].map(<[f64]>::to_vec).to_vec();
        if function == "mode_gradient" {
            arguments.extend([s.phi.as_ref().to_vec(), vec![s.lambda]]);
        }
        arguments
    });
    Ok(Box::new(CasadiWork::load(&library, &name, inputs.collect())?))
}
