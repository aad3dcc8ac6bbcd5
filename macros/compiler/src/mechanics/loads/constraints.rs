//! Constraints: their equations, and their reactions on bodies and coordinates.
//!
//! Every equation has a multiplier `mu`. Its generalised reaction forces are `-mu` times the derivative of the equation
//! by each speed, so that `g + Phi_q^T mu = 0`; on bodies they are pairs of forces and moments. An equation is the
//! negative of the value that must vanish, `Phi = -value`. Then `mu` is the load that the `from` side exerts on the
//! `to` side, as for the reaction of a joint, and the residual of an equation has the direction of its reaction.

use crate::algebra::{ExprId, Graph, Node, Operator, gradient, substitute};
use crate::base::ids::ConstraintId;
use crate::census::taken;
use crate::mechanics::motion::{Kinematics, Wrench, in_common_frame, in_common_frame_at_zero};
use crate::mechanics::setup::{Context, Row, Source, State, vanish};
use crate::model::expression::Expr;
use crate::model::mechanism::{Constraint, ConstraintLaw, Unit};

use super::applied::AppliedForces;
use super::closure::{aligned, coincident, distance, joint_demands};
use super::force_context::ForceContext;
use super::pair::Pair;
use super::rolling::rolling;

/// All equations that do not hold trivially, starting with those of positions.
pub(crate) fn constraint_rows(g: &mut Graph, context: &Context) -> Vec<Row> {
    let sources = sources(context);
    if sources.is_empty() {
        return Vec::new();
    }
    let running = anywhere(g, context);
    let kinematics = in_common_frame(g, context, &running);
    let force_context = ForceContext::new(context, &kinematics);
    let mut rows = Vec::new();
    for source in sources {
        let name = source.name(context.mechanism);
        let Some(pair) = geometric(g, &force_context, source) else {
            let (zero, unit) = declared_equation(context, source);
            taken(|| "closing: equation".into());
            rows.push(Row {
                source,
                component: 0,
                label: name.to_string(),
                unit: reaction_unit(&unit.symbol),
                of_velocities: has_running(context, zero),
            });
            continue;
        };
        for (component, demand) in pair.demands.iter().enumerate() {
            if always_holds(g, context, demand.value) {
                taken(|| "closing: holds whatever moves".into());
                continue;
            }
            taken(|| format!("closing: demand `{}`", demand.label));
            rows.push(Row {
                source,
                component,
                label: match demand.label {
                    "" => name.to_string(),
                    label => format!("{name}.{label}"),
                },
                unit: if demand.moment.is_zero(g) { "N" } else { "N*m" }.to_owned(),
                of_velocities: demand.of_velocities,
            });
        }
    }
    rows.sort_by_key(|row| row.of_velocities);
    rows
}

/// Whether a demand holds wherever things move. Of an angle it is enough that its sine vanishes, unless it is always half
/// a turn: `b` then turns in one plane through `a`, and the other angles of its constraint, which keep it in that plane,
/// leave it no opposite direction.
fn always_holds(g: &mut Graph, context: &Context, value: ExprId) -> bool {
    let Node::Binary(Operator::Atan2, sine, cosine) = g.node(value) else {
        return vanish(g, context, &[value])[0];
    };
    let one = g.constant(1.0);
    let beside_opposite = g.add(cosine, one);
    vanish(g, context, &[sine, beside_opposite]) == [true, false]
}

/// Arbitrary positions of the running coordinates, but zero for those driven at zero speed. An equation that holds only
/// at zero is not trivial.
fn anywhere(g: &mut Graph, context: &Context) -> Vec<ExprId> {
    let at_zero = in_common_frame_at_zero(g, context);
    let running = context.topology.running();
    running
        .zip(&context.symbols.running.values)
        .map(|(id, &value)| {
            let locked = g.is(at_zero.coordinates[id.index()].velocity, 0.0);
            if locked { g.zero() } else { value }
        })
        .collect()
}

/// The expression and unit of a constraint that is not geometric.
fn declared_equation<'a>(context: &Context<'a>, source: Source) -> (&'a Expr, &'a Unit) {
    if let Source::Constraint(id) = source
        && let ConstraintLaw::Equation { zero, unit } = &context.mechanism.constraints[id.index()].law
    {
        return (zero, unit);
    }
    unreachable!("all other constraints are geometric")
}

/// Work per unit of an expression.
fn reaction_unit(unit: &str) -> String {
    match unit {
        "m" => "N".to_owned(),
        "" | "1" | "rad" => "N*m".to_owned(),
        other => format!("J/({other})"),
    }
}

/// All sources of equations in order of declaration: joints, then constraints.
fn sources(context: &Context) -> Vec<Source> {
    let joints = context.topology.cut.iter().copied().map(Source::Joint);
    let constraints = (0..context.mechanism.constraints.len()).map(ConstraintId::new).map(Source::Constraint);
    joints.chain(constraints).collect()
}

/// A constraint between two sides; `None` for a declared equation.
fn geometric(g: &mut Graph, force_context: &ForceContext, source: Source) -> Option<Pair> {
    let mechanism = force_context.context.mechanism;
    let id = match source {
        Source::Joint(id) => {
            return Some(joint_demands(g, force_context, &mechanism.joints[id.index()]));
        }
        Source::Constraint(id) => id,
    };
    let Constraint { law, .. } = &mechanism.constraints[id.index()];
    Some(match law {
        ConstraintLaw::Coincident { from, to, along } => coincident(g, force_context, (*from, *to), *along),
        ConstraintLaw::Aligned { from, to, axis } => aligned(g, force_context, (*from, *to), axis.as_ref()),
        ConstraintLaw::Distance { from, to, length } => distance(g, force_context, (*from, *to), length),
        ConstraintLaw::Rolling { wheel, axis, radius, on, normal } => {
            rolling(g, force_context, *wheel, axis.as_ref(), radius, *on, normal)
        }
        ConstraintLaw::Equation { .. } => return None,
    })
}

/// Whether an expression contains a coordinate that runs in steady motion.
fn has_running(context: &Context, value: &Expr) -> bool {
    value.leaves().into_iter().any(|leaf| match leaf {
        Expr::Coordinate(id) => context.mechanism.coordinates[id.index()].motion.runs(),
        _ => false,
    })
}

/// Evaluates the equations, by row, and adds their reactions to `forces`.
pub(crate) fn constraints(g: &mut Graph, force_context: &ForceContext, forces: &mut AppliedForces) -> Vec<ExprId> {
    let context = force_context.context;
    let mut values = vec![g.zero(); context.rows.len()];
    for source in sources(context) {
        match geometric(g, force_context, source) {
            Some(pair) => {
                let mut load = Wrench::zero(g);
                for (component, demand) in pair.demands.iter().enumerate() {
                    let Some(row) = context.row(source, component) else {
                        continue;
                    };
                    values[row] = g.neg(demand.value);
                    let held = demand.held_by(g, context.multiplier(row));
                    load = load.add(g, held);
                }
                forces.apply_pair(g, force_context, &pair, load);
            }
            None => {
                let Some(row) = context.row(source, 0) else {
                    continue;
                };
                values[row] = equation(g, force_context, source, context.multiplier(row), forces);
            }
        }
    }
    for (value, row) in values.iter().zip(context.rows) {
        g.set_name(*value, || format!("constraint_{}", row.label.replace('.', "_")));
    }
    values
}

/// Running coordinates as symbols, everything else at its value.
struct Running<'a> {
    context: &'a Context<'a>,
    kinematics: &'a Kinematics,
}

impl State for Running<'_> {
    fn leaf(&self, leaf: &Expr) -> ExprId {
        if let Expr::Coordinate(id) = leaf
            && let Some(k) = self.context.topology.running().position(|x| x == *id)
        {
            return self.context.symbols.running.values[k];
        }
        self.kinematics.leaf(leaf)
    }
}

/// An expression that must be zero, or whose rate must be zero if it contains running coordinates.
fn equation(
    g: &mut Graph,
    force_context: &ForceContext,
    source: Source,
    multiplier: ExprId,
    forces: &mut AppliedForces,
) -> ExprId {
    let ForceContext { context, kinematics, .. } = *force_context;
    let (symbols, topology) = (context.symbols, context.topology);
    let (zero, _) = declared_equation(context, source);
    let state = Running { context, kinematics };
    let value = context.values.scalar_at(g, zero, &state);
    let free = topology.free.len();
    let ids: Vec<_> = symbols.q.ids[..free].iter().chain(&symbols.running.ids).copied().collect();
    let slopes = gradient(g, value, &ids);
    let coordinates: Vec<_> = topology.free.iter().copied().chain(topology.running()).collect();
    let positions: Vec<_> = topology.running().map(|id| kinematics.coordinates[id.index()].position).collect();
    let stopped: Vec<_> = symbols.running.with(&positions).collect();
    let stood = substitute(g, &[vec![value], slopes].concat(), &stopped);
    let (value, slopes) = (stood[0], &stood[1..]);
    let mut rate = g.zero();
    for (&slope, id) in slopes.iter().zip(&coordinates) {
        let load = g.mul(multiplier, slope);
        let slot = &mut forces.on_coordinates[id.index()];
        *slot = g.add(*slot, load);
        let share = g.mul(slope, kinematics.coordinates[id.index()].velocity);
        rate = g.add(rate, share);
    }
    let value = if has_running(context, zero) { rate } else { value };
    g.neg(value)
}

/// The load that the `from` side of a constraint or of a cut joint exerts on the `to` side, at the point of `from` and
/// in its axes; `None` for a declared equation.
pub(crate) fn held(g: &mut Graph, force_context: &ForceContext, source: Source) -> Option<Wrench> {
    let pair = geometric(g, force_context, source)?;
    let mut load = Wrench::zero(g);
    for (component, demand) in pair.demands.iter().enumerate() {
        if let Some(row) = force_context.context.row(source, component) {
            let held = demand.held_by(g, force_context.context.multiplier(row));
            load = load.add(g, held);
        }
    }
    let lever = pair.gap(g).cross(g, load.force);
    let moment = load.moment.add(g, lever);
    let to_axes = pair.from.at.axes.transpose();
    Some(Wrench { force: to_axes.apply(g, load.force), moment: to_axes.apply(g, moment) })
}
