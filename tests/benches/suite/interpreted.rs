//! Kernels of a chain read at run time, against the compiled ones, one state at a time.

use std::hint::black_box;

use eigentol::kernels::{Gradient, Kernels, Linear};
use eigentol::{Matrix, Mechanism, Vector};
use eigentol_interpreter::Interpreted;

use crate::chains::{self, State, Visitor, visit_short};
use crate::declaration::declaration;
use crate::lanes::{self, vectors};
use crate::work::{AGREEMENT, Closures, Task, Work};

/// The tasks with a selected name.
pub(crate) fn tasks(wanted: &dyn Fn(&str) -> bool) -> Vec<Task> {
    let mut collector = Collector { wanted, tasks: Vec::new() };
    visit_short(&mut collector);
    collector.tasks
}

struct Collector<'a> {
    wanted: &'a dyn Fn(&str) -> bool,
    tasks: Vec<Task>,
}

impl Visitor for Collector<'_> {
    fn visit<M: Mechanism + 'static>(&mut self, chain: M) {
        let bars = chains::bars::<M>();
        let read = || Interpreted::from_text(&declaration("Chain", bars)).expect("a chain");
        for function in lanes::FUNCTIONS {
            let compiled = || Ok(chains::ours(chain.clone(), function));
            let name = format!("interpreted{bars}/{function}");
            if (self.wanted)(&name) {
                self.tasks.push(Task {
                    name: name.clone(),
                    units: [1, 1],
                    agreement: AGREEMENT,
                    ours: one_by_one::<M>(read(), function),
                    peer: compiled(),
                });
            }
            for (width, instructions) in vectors() {
                let name = format!("{name}-{width}");
                if (self.wanted)(&name) {
                    self.tasks.push(Task {
                        name,
                        units: [eigentol::scalar::WIDTH, 1],
                        agreement: AGREEMENT,
                        ours: lanes::ours(Box::new(read()), lanes::states::<M>(), function, instructions),
                        peer: compiled(),
                    });
                }
            }
        }
    }
}

fn one_by_one<M: Mechanism + 'static>(chain: Interpreted, function: &str) -> Box<dyn Work> {
    let inputs = chains::states::<M>();
    let again = chain.clone();
    let sizes = chain.sizes();
    let n = sizes.coordinates;
    match function {
        "residual_and_stiffness" => {
            let mut out = (Vector::zeros(n), Matrix::zeros(n, n));
            Box::new(Closures {
                inputs,
                evaluate: move |s: &State<M>| {
                    let (q, u, b) = (s.q.as_ref(), s.u.as_ref(), s.b.as_ref());
                    chain.residual_and_stiffness_into(q, u, b, &mut out.0, out.1.as_flattened_mut());
                    black_box(&out);
                },
                results: move |s: &State<M>| {
                    let again: &dyn Kernels = &again;
                    let (q, u, b) = (s.q.as_ref(), s.u.as_ref(), s.b.as_ref());
                    let (residual, stiffness) = again.residual_and_stiffness(q, u, b);
                    vec![residual.to_vec(), stiffness.as_flattened().to_vec()]
                },
            })
        }
        "linear" => {
            let mut out = Linear::zeros(n);
            Box::new(Closures {
                inputs,
                evaluate: move |s: &State<M>| {
                    chain.linear_into(s.q.as_ref(), s.u.as_ref(), s.b.as_ref(), &mut out);
                    black_box(&out);
                },
                results: move |s: &State<M>| {
                    let again: &dyn Kernels = &again;
                    let linear = again.linear(s.q.as_ref(), s.u.as_ref(), s.b.as_ref());
                    [linear.mass, linear.stiffness].map(|matrix| matrix.as_flattened().to_vec()).to_vec()
                },
            })
        }
        _ => {
            let mut out = Gradient::zeros(sizes);
            let gradient = move |chain: &Interpreted, s: &State<M>, out: &mut Gradient| {
                let (q, u, b) = (s.q.as_ref(), s.u.as_ref(), s.b.as_ref());
                chain.mode_gradient_into(q, u, b, s.phi.as_ref(), s.lambda, out);
            };
            Box::new(Closures {
                inputs,
                evaluate: move |s: &State<M>| {
                    gradient(&chain, s, &mut out);
                    black_box(&out);
                },
                results: move |s: &State<M>| {
                    let mut out = Gradient::zeros(sizes);
                    gradient(&again, s, &mut out);
                    [out.coordinates, out.inputs, out.design].map(|numbers| numbers.to_vec()).to_vec()
                },
            })
        }
    }
}
