//! Growth of cost with the number of bars: operations, text size and time of the kernels that must grow linearly.

use std::hint::black_box;

use eigentol::{Array, Description, Dual, Gradient, PictureInfo, Real};

use crate::work::{Closures, INPUTS, Random, Work};

/// The contract reduced to the kernels that must grow linearly.
pub(crate) trait Kernels: Copy + 'static {
    type Coordinates<T: Copy>: Array<T>;
    type Inputs<T: Copy>: Array<T>;
    type Design<T: Copy>: Array<T>;
    type Outputs<T: Copy>: Array<T>;
    type Excitations<T: Copy>: Array<T>;
    type Picture<T: Copy>: Array<T>;

    const DESCRIPTION: Description;
    #[allow(dead_code, reason = "emitted with the kernels")]
    const PICTURE: PictureInfo;

    fn residual<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
    ) -> Self::Coordinates<T>;

    fn residual_inlined<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
    ) -> Self::Coordinates<T>;

    fn mode_gradient<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
        phi: &Self::Coordinates<T>,
        lambda: T,
    ) -> Gradient<Self::Coordinates<T>, Self::Inputs<T>, Self::Design<T>>;

    fn mode_gradient_inlined<T: Real>(
        &self,
        q: &Self::Coordinates<T>,
        u: &Self::Inputs<T>,
        b: &Self::Design<T>,
        phi: &Self::Coordinates<T>,
        lambda: T,
    ) -> Gradient<Self::Coordinates<T>, Self::Inputs<T>, Self::Design<T>>;
}

/// Visits every chain, with the size of its emitted text.
pub(crate) trait Visitor {
    fn visit<M: Kernels>(&mut self, chain: M, bytes: usize);
}

mod generated {
    use super::{Kernels, Visitor};

    include!(concat!(env!("OUT_DIR"), "/growing.rs"));
}

/// A kernel of one chain.
pub(crate) struct Grown {
    pub(crate) kernel: &'static str,
    pub(crate) bars: usize,
    /// Operations and function calls; in dual numbers each costs about three.
    pub(crate) operations: usize,
    /// Text size of both growing kernels of this chain.
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
    fn visit<M: Kernels>(&mut self, chain: M, bytes: usize) {
        let description = M::DESCRIPTION;
        let mut add = |kernel, name: &str| {
            let info = description.kernel(name);
            let operations = info.map_or(0, |info| info.operations + info.functions);
            self.0.push(Grown { kernel, bars: bars::<M>(), operations, bytes, work: work(chain, kernel) });
        };
        add("residual", "residual");
        add("mode_gradient", "mode_gradient");
        add("mode_gradient_along", "mode_gradient");
    }
}

/// The number of bars of a chain.
fn bars<M: Kernels>() -> usize {
    M::Coordinates::<f64>::LEN
}

/// A point and a direction.
struct State<M: Kernels> {
    q: M::Coordinates<f64>,
    u: M::Inputs<f64>,
    b: M::Design<f64>,
    phi: M::Coordinates<f64>,
    dq: M::Coordinates<f64>,
    du: M::Inputs<f64>,
    db: M::Design<f64>,
    dphi: M::Coordinates<f64>,
    lambda: [f64; 2],
}

/// Values with derivatives along a direction.
fn along<A: Array<f64>, D: Array<Dual<f64>>>(values: &A, direction: &A) -> D {
    D::from_fn(|k| Dual { value: values.as_ref()[k], slope: direction.as_ref()[k] })
}

fn work<M: Kernels>(chain: M, kernel: &str) -> Box<dyn Work> {
    let mut random = Random(bars::<M>() as u64);
    let state = |_| State::<M> {
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
    let results = |_: &State<M>| Vec::new();
    match kernel {
        "residual" => Box::new(Closures {
            inputs,
            evaluate: move |s: &State<M>| {
                black_box(&chain.residual(&s.q, &s.u, &s.b));
            },
            results,
        }),
        "mode_gradient" => Box::new(Closures {
            inputs,
            evaluate: move |s: &State<M>| {
                black_box(&chain.mode_gradient(&s.q, &s.u, &s.b, &s.phi, s.lambda[0]));
            },
            results,
        }),
        _ => Box::new(Closures {
            inputs,
            evaluate: move |s: &State<M>| {
                let [value, slope] = s.lambda;
                black_box(&chain.mode_gradient(
                    &along(&s.q, &s.dq),
                    &along(&s.u, &s.du),
                    &along(&s.b, &s.db),
                    &along(&s.phi, &s.dphi),
                    Dual { value, slope },
                ));
            },
            results,
        }),
    }
}
