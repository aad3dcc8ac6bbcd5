//! How cost grows with the number of bars: operations, text and time of the kernels that have to be linear.

use std::hint::black_box;

use eigentol::{Description, Dual, Gradient, Real};

use crate::work::{Closures, INPUTS, Random, Work};

/// The contract cut down to the kernels that have to grow linearly.
pub(crate) trait Kernels<const N: usize, const P: usize> {
    const DESCRIPTION: Description;

    fn residual<T: Real>(&self, q: &[T; N], u: &[T; 1], b: &[T; P]) -> [T; N];

    fn mode_gradient<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; 1],
        b: &[T; P],
        phi: &[T; N],
        lambda: T,
    ) -> Gradient<T, N, 1, P>;

    fn mode_gradient_inlined<T: Real>(
        &self,
        q: &[T; N],
        u: &[T; 1],
        b: &[T; P],
        phi: &[T; N],
        lambda: T,
    ) -> Gradient<T, N, 1, P>;
}

/// Sees every chain, with the bytes of its emitted text.
pub(crate) trait Visitor {
    fn visit<M, const N: usize, const P: usize>(&mut self, chain: M, bytes: usize)
    where
        M: Kernels<N, P> + Copy + 'static;
}

mod generated {
    use super::{Kernels, Visitor};

    include!(concat!(env!("OUT_DIR"), "/growing.rs"));
}

/// A kernel of one chain.
pub(crate) struct Grown {
    pub(crate) kernel: &'static str,
    pub(crate) bars: usize,
    /// Operations and function calls; in dual numbers each is about three.
    pub(crate) operations: usize,
    /// Bytes of the text of both growing kernels of this chain.
    pub(crate) bytes: usize,
    pub(crate) work: Box<dyn Work>,
}

impl Grown {
    pub(crate) fn name(&self) -> String {
        format!("growth{}/{}", self.bars, self.kernel)
    }
}

/// Every growing kernel of every chain.
pub(crate) fn kernels() -> Vec<Grown> {
    let mut collector = Collector(Vec::new());
    generated::visit_all(&mut collector);
    collector.0
}

struct Collector(Vec<Grown>);

impl Visitor for Collector {
    fn visit<M, const N: usize, const P: usize>(&mut self, chain: M, bytes: usize)
    where
        M: Kernels<N, P> + Copy + 'static,
    {
        let mut add = |kernel, name: &str| {
            let info = M::DESCRIPTION.kernels.iter().find(|info| info.name == name);
            let operations = info.map_or(0, |info| info.operations + info.functions);
            self.0.push(Grown {
                kernel,
                bars: N,
                operations,
                bytes,
                work: work(chain, kernel),
            });
        };
        add("residual", "residual");
        add("mode_gradient", "mode_gradient");
        add("mode_gradient_along", "mode_gradient");
    }
}

/// A point and a direction.
struct State<const N: usize, const P: usize> {
    q: [f64; N],
    u: [f64; 1],
    b: [f64; P],
    phi: [f64; N],
    dq: [f64; N],
    du: [f64; 1],
    db: [f64; P],
    dphi: [f64; N],
    lambda: [f64; 2],
}

fn work<M, const N: usize, const P: usize>(chain: M, kernel: &str) -> Box<dyn Work>
where
    M: Kernels<N, P> + Copy + 'static,
{
    let mut random = Random(N as u64);
    let state = |_| State::<N, P> {
        q: random.array(-1.5, 1.5),
        u: random.array(0.5, 4.0),
        b: random.array(0.5, 2.0),
        phi: random.array(-1.0, 1.0),
        dq: random.array(-1.0, 1.0),
        du: random.array(-1.0, 1.0),
        db: random.array(-1.0, 1.0),
        dphi: random.array(-1.0, 1.0),
        lambda: random.array(1.0, 20.0),
    };
    let inputs = (0..INPUTS).map(state).collect();
    let results = |_: &State<N, P>| Vec::new();
    match kernel {
        "residual" => Box::new(Closures {
            inputs,
            evaluate: move |s: &State<N, P>| {
                black_box(&chain.residual(&s.q, &s.u, &s.b));
            },
            results,
        }),
        "mode_gradient" => Box::new(Closures {
            inputs,
            evaluate: move |s: &State<N, P>| {
                black_box(&chain.mode_gradient(&s.q, &s.u, &s.b, &s.phi, s.lambda[0]));
            },
            results,
        }),
        _ => Box::new(Closures {
            inputs,
            evaluate: move |s: &State<N, P>| {
                let [value, slope] = s.lambda;
                black_box(&chain.mode_gradient(
                    &Dual::along(&s.q, &s.dq),
                    &Dual::along(&s.u, &s.du),
                    &Dual::along(&s.b, &s.db),
                    &Dual::along(&s.phi, &s.dphi),
                    Dual { value, slope },
                ));
            },
            results,
        }),
    }
}
