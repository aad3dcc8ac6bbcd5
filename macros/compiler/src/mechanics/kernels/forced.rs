//! What a vibration forced by excitations needs besides the three matrices.

use crate::algebra::{
    Array, ExprId, Function, Graph, Node, Operator, Parameter, Stage, SymbolId, Unary, rough, substitute,
};
use crate::base::ids::CoordinateId;
use crate::mechanics::checks::Turning;
use crate::mechanics::equations::{Equations, Response};
use crate::mechanics::functions::Excitation as Facts;
use crate::mechanics::inertia::size;
use crate::mechanics::kernel_name::KernelName;
use crate::mechanics::setup::{Context, SymbolList, Symbols, at_rest, columns, weighted_sum};
use crate::model::mechanism::{Excitation, ExcitationLaw, Frequency, Motion, ShakenBy};

use super::adjoint::{at_rest_along_motion, state_gradient};
use super::parameters::parameter;

/// The excitations as expressions, and facts about them.
pub(crate) struct Excitations {
    /// By excitation.
    pub(crate) facts: Vec<Facts>,
    forces: Vec<Harmonic>,
}

/// A harmonic force `cosine cos(w t) + sine sin(w t)`: entries of the residual, then of the outputs.
struct Harmonic {
    cosine: Vec<ExprId>,
    sine: Vec<ExprId>,
    frequency: ExprId,
}

impl Excitations {
    pub(crate) fn new(g: &mut Graph, context: &Context, responses: &[Response], turning: &Turning) -> Self {
        let (mut facts, mut forces): (Vec<Facts>, Vec<Harmonic>) = (Vec::new(), Vec::new());
        let excitations = context.mechanism.excitations.iter();
        for ((excitation, response), turning) in excitations.zip(responses).zip(turning) {
            let (frequency, order) = frequency(g, context, excitation, turning);
            let force = harmonic(g, context, excitation, response, frequency);
            let opposite = g.neg(frequency);
            let with = forces.iter().position(|other| [frequency, opposite].contains(&other.frequency));
            facts.push(Facts {
                name: excitation.name.to_string(),
                kind: match excitation.law {
                    ExcitationLaw::Unbalance { .. } => "unbalance",
                    ExcitationLaw::Load { .. } | ExcitationLaw::Generalized { .. } => "harmonic",
                    ExcitationLaw::Shaken { .. } => "shaken",
                },
                with: with.unwrap_or(forces.len()),
                order,
            });
            forces.push(force);
        }
        Self { facts, forces }
    }
}

/// The frequency, and in words the order of which drives it is.
fn frequency(
    g: &mut Graph,
    context: &Context,
    excitation: &Excitation,
    turning: &[(CoordinateId, f64)],
) -> (ExprId, String) {
    let name = |id: &CoordinateId| &context.mechanism.coordinates[id.index()].name;
    match &excitation.frequency {
        Frequency::Own(value) => (context.values.scalar(g, value), String::new()),
        Frequency::Order(order, id) => {
            let (factor, speed) = (context.values.scalar(g, order), speed(g, context, *id));
            let words = match g.constant_value(factor) {
                Some(order) => format!("{order} {}", name(id)),
                None => format!("order of {}", name(id)),
            };
            (g.mul(factor, speed), words)
        }
        Frequency::OfTurning => {
            let speeds: Vec<ExprId> = turning
                .iter()
                .map(|(id, sign)| {
                    let speed = speed(g, context, *id);
                    g.scale(*sign, speed)
                })
                .collect();
            let words: Vec<String> = turning.iter().map(|(id, sign)| format!("{sign} {}", name(id))).collect();
            (g.sum(speeds), words.join(" + "))
        }
    }
}

/// The steady speed of a running coordinate.
fn speed(g: &mut Graph, context: &Context, id: CoordinateId) -> ExprId {
    match &context.mechanism.coordinates[id.index()].motion {
        Motion::Driven(speed) => context.values.scalar(g, speed),
        Motion::Coasting => {
            let index = context.topology.coasting.iter().position(|x| *x == id);
            let index = context.moving().0 + index.unwrap_or_default();
            context.symbols.q.values[index]
        }
        Motion::Free => g.zero(),
    }
}

/// The harmonic force of an excitation. In terms of `in phase - i quadrature`, times its size and `e^(i phase)`.
fn harmonic(
    g: &mut Graph,
    context: &Context,
    excitation: &Excitation,
    response: &Response,
    frequency: ExprId,
) -> Harmonic {
    let zeros = vec![g.zero(); context.symbols.running.ids.len()];
    let still: Vec<_> = context.symbols.running.with(&zeros).collect();
    let n = context.symbols.q.ids.len();
    let by: Vec<Vec<ExprId>> = response
        .by
        .iter()
        .map(|change| {
            let mut change = substitute(g, change, &still);
            for residual in &mut change[..n] {
                *residual = g.neg(*residual);
            }
            change
        })
        .collect();
    let none = vec![g.zero(); by[0].len()];
    let one = g.constant(1.0);
    let (in_phase, quadrature, size) = match &excitation.law {
        ExcitationLaw::Unbalance { body, deviation, .. } => {
            let size = size(g, context, *body, deviation);
            (by[0].clone(), by[1].clone(), size)
        }
        ExcitationLaw::Load { .. } | ExcitationLaw::Generalized { .. } => (by[0].clone(), none, one),
        ExcitationLaw::Shaken { measure, amplitude, .. } => {
            let [in_phase, quadrature] = shaken(g, &by, *measure, frequency);
            (in_phase, quadrature, context.values.scalar(g, amplitude))
        }
    };
    let phase = context.values.scalar(g, &excitation.phase);
    let (sine, cosine) = (g.unary(Unary::Sin, phase), g.unary(Unary::Cos, phase));
    let (along, across) = (g.mul(size, cosine), g.mul(size, sine));
    let mut harmonic = Harmonic { cosine: Vec::new(), sine: Vec::new(), frequency };
    for (&a, &b) in in_phase.iter().zip(&quadrature) {
        let (aa, ba) = (g.mul(along, a), g.mul(across, b));
        harmonic.cosine.push(g.add(aa, ba));
        let (bb, ab) = (g.mul(along, b), g.mul(across, a));
        harmonic.sine.push(g.sub(bb, ab));
    }
    harmonic
}

/// In phase and in quadrature with what is given, from the derivatives by displacement, velocity and acceleration.
fn shaken(g: &mut Graph, by: &[Vec<ExprId>], measure: ShakenBy, w: ExprId) -> [Vec<ExprId>; 2] {
    let square = g.mul(w, w);
    let (mut in_phase, mut quadrature) = (Vec::new(), Vec::new());
    for ((&x, &v), &a) in by[0].iter().zip(&by[1]).zip(&by[2]) {
        let (wv, wwa) = (g.mul(w, v), g.mul(square, a));
        let elastic = g.sub(x, wwa);
        match measure {
            // q = cos, q' = -w sin, q'' = -w^2 cos
            ShakenBy::Displacement => {
                in_phase.push(elastic);
                quadrature.push(g.neg(wv));
            }
            // q = sin / w, q' = cos, q'' = -w sin
            ShakenBy::Velocity => {
                in_phase.push(v);
                quadrature.push(g.div(elastic, w));
            }
            // q = -cos / w^2, q' = sin / w, q'' = cos
            ShakenBy::Acceleration => {
                let elastic = g.div(elastic, square);
                in_phase.push(g.neg(elastic));
                quadrature.push(g.div(v, w));
            }
        }
    }
    [in_phase, quadrature]
}

/// The kernels of forced vibration.
pub(crate) fn forced(g: &mut Graph, context: &Context, e: &Equations, excitations: &Excitations) -> Vec<Function> {
    if excitations.forces.is_empty() {
        return Vec::new();
    }
    let s = context.symbols;
    let (n, m) = (e.rest.len(), e.outputs.len());
    let state = || vec![parameter("q", &s.q), parameter("u", &s.u), parameter("b", &s.b)];
    let count = excitations.forces.len();
    let forces = || excitations.forces.iter();
    let array = |name, shape: Vec<usize>, values: Vec<ExprId>| Array { name, shape, values };
    let split = |of: fn(&Harmonic) -> &Vec<ExprId>, outputs: bool| -> Vec<ExprId> {
        let range = if outputs { n..n + m } else { 0..n };
        forces().flat_map(|force| of(force)[range.clone()].to_vec()).collect()
    };
    let frequencies: Vec<ExprId> = forces().map(|force| force.frequency).collect();
    let forcing = vec![
        array("cosine", vec![count, n], split(|f| &f.cosine, false)),
        array("frequency", vec![count], frequencies.clone()),
        array("direct_cosine", vec![count, m], split(|f| &f.cosine, true)),
        array("sine", vec![count, n], split(|f| &f.sine, false)),
        array("direct_sine", vec![count, m], split(|f| &f.sine, true)),
    ];
    let without_slope = without_slope(g, s, &e.outputs_in_motion);
    let motion = [("by_acceleration", &s.acceleration), ("by_velocity", &s.velocity), ("by_position", &s.q)].map(
        |(name, list)| {
            let columns = columns(g, &e.outputs_in_motion, list);
            let rows: Vec<ExprId> = (0..m).flat_map(|k| columns.iter().map(move |column| column[k])).collect();
            let mut values = at_rest(g, s, &rows);
            for (k, slope) in without_slope.iter().enumerate() {
                if let Some(slope) = slope {
                    values[k * n..(k + 1) * n].fill(*slope);
                }
            }
            array(name, vec![m, n], values)
        },
    );
    let weights = Weights::new(g, context, count);
    let weighted = weights.weighted(g, context, e, excitations);
    let gradient = state_gradient(g, s, weighted);
    let function = |kernel: KernelName, after: Vec<Parameter>, results| Function {
        name: kernel.name(),
        parameters: state().into_iter().chain(after).collect(),
        results,
    };
    vec![
        function(KernelName::Forcing, vec![], forcing),
        function(KernelName::OutputMotion, vec![], motion.into()),
        function(KernelName::ForcedGradient, weights.parameters(context), gradient),
    ]
}

/// Of each output, its infinite slope if it has none at rest in any design, like the length of a vector that is zero.
///
/// Simplification does not see that: the slope `v / |v|` of a length is a product with zero. What stands in front of the
/// length decides whether that is its value, as for `v |v|`, or whether there is none.
fn without_slope(g: &mut Graph, s: &Symbols, outputs: &[ExprId]) -> Vec<Option<ExprId>> {
    let moving: Vec<SymbolId> =
        [&s.q, &s.velocity, &s.acceleration].into_iter().flat_map(|list| list.ids.iter().copied()).collect();
    let of_output = |&output: &ExprId| {
        let all: Vec<ExprId> = rough(g, output, &moving).into_flattened();
        let all = at_rest(g, s, &all);
        let infinite = |g: &Graph, slope: ExprId| {
            let size = match g.node(slope) {
                Node::Unary(Unary::Negate, size) => size,
                _ => slope,
            };
            matches!(g.node(size), Node::Binary(Operator::Divide, _, divisor) if g.is(divisor, 0.0))
        };
        let mut pairs = all.as_chunks::<2>().0.iter();
        pairs.find(|[slope, factor]| infinite(g, *slope) && !g.is(*factor, 0.0)).map(|[slope, _]| *slope)
    };
    outputs.iter().map(of_output).collect()
}

/// The factors of the functional of a forced vibration.
struct Weights {
    output: SymbolList,
    share: SymbolList,
    cosine: SymbolList,
    sine: SymbolList,
    direct_cosine: SymbolList,
    direct_sine: SymbolList,
    frequency: SymbolList,
}

impl Weights {
    fn new(g: &mut Graph, context: &Context, excitations: usize) -> Self {
        let mut list = |prefix: &str, count: usize| {
            let mut list = SymbolList::default();
            for k in 0..count {
                let (id, value) = g.symbol(format!("{prefix}_{k}"), Stage::Rate);
                list.ids.push(id);
                list.values.push(value);
            }
            list
        };
        let (n, m) = (context.symbols.q.ids.len(), context.mechanism.outputs.len());
        Self {
            output: list("on_output", m),
            share: list("share", excitations),
            cosine: list("on_cosine", n),
            sine: list("on_sine", n),
            direct_cosine: list("on_direct_cosine", m),
            direct_sine: list("on_direct_sine", m),
            frequency: list("on_frequency", excitations),
        }
    }

    fn parameters(&self, context: &Context) -> Vec<Parameter> {
        let pencil = &context.symbols.pencil;
        vec![
            parameter("output", &self.output),
            parameter("acceleration", &pencil.acceleration),
            parameter("velocity", &pencil.velocity),
            parameter("position", &pencil.position),
            parameter("share", &self.share),
            parameter("cosine", &self.cosine),
            parameter("sine", &self.sine),
            parameter("direct_cosine", &self.direct_cosine),
            parameter("direct_sine", &self.direct_sine),
            parameter("frequency", &self.frequency),
        ]
    }

    /// The functional of `Mechanism::forced_gradient`.
    fn weighted(&self, g: &mut Graph, context: &Context, e: &Equations, excitations: &Excitations) -> ExprId {
        let s = context.symbols;
        let outputs = weighted_sum(g, &self.output.values, &e.outputs_in_motion);
        let mut terms = vec![at_rest_along_motion(g, s, outputs, "_forced")];
        let on_cosine = [&self.cosine.values[..], &self.direct_cosine.values].concat();
        let on_sine = [&self.sine.values[..], &self.direct_sine.values].concat();
        for (force, &share) in excitations.forces.iter().zip(&self.share.values) {
            let cosine = weighted_sum(g, &on_cosine, &force.cosine);
            let sine = weighted_sum(g, &on_sine, &force.sine);
            let both = g.add(cosine, sine);
            terms.push(g.mul(share, both));
        }
        let frequencies: Vec<ExprId> = excitations.forces.iter().map(|f| f.frequency).collect();
        terms.push(weighted_sum(g, &self.frequency.values, &frequencies));
        g.sum(terms)
    }
}
