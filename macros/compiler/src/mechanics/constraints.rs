//! Constraints: their equations, and what holds them on bodies and coordinates.
//!
//! Every equation has a multiplier `mu`. The generalised forces that hold it are `-mu` times the derivative of the equation
//! by each speed, so that `g + Phi_q^T mu = 0`; on bodies they are pairs of forces and moments. Equations are what a demand
//! lacks, `Phi = -value`: then `mu` is what the `from` side exerts on the `to` side, as the reaction of a joint is. What an
//! equation leaves open is the way to go in the direction of its reaction.

use proc_macro2::Ident;

use crate::algebra::{Graph, Vector3, gradient, substitute};
use crate::base::census::taken;
use crate::base::ids::{ConstraintId, ExprId, JointId};
use crate::model::expression::Expr;
use crate::model::mechanism::{Constraint, ConstraintLaw, Mechanism, Unit};

use super::closure::{Demand, Pair, aligned, coincident, distance, joint_demands};
use super::forces::{AppliedForces, Wrench};
use super::kinematics::Kinematics;
use super::problem::Problem;
use super::properties::vanish;
use super::rolling::rolling;
use super::setting::Setting;
use super::values::State;

/// What an equation comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    Constraint(ConstraintId),
    /// A joint that closes a loop.
    Joint(JointId),
}

/// One equation of a constraint.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub(super) source: Source,
    /// Which of the equations of its source.
    pub(super) component: usize,
    /// The name of its source, with the component where there are several.
    pub(super) label: String,
    /// Unit of its multiplier.
    pub(super) unit: String,
    /// It is one of velocities, not of positions.
    pub(super) of_velocities: bool,
}

/// All equations that do not hold whatever the mechanism does: those of positions first.
pub(super) fn rows(g: &mut Graph, problem: &Problem) -> Vec<Row> {
    let sources = sources(problem);
    if sources.is_empty() {
        return Vec::new();
    }
    let kinematics = problem.kinematics_at_zero(g);
    let setting = Setting::new(problem, &kinematics);
    let mut rows = Vec::new();
    for source in sources {
        let name = source.name(problem.mechanism);
        let Some(pair) = geometric(g, &setting, source) else {
            let (zero, unit) = problem.equation(source);
            taken(|| "closing: equation".into());
            rows.push(Row {
                source,
                component: 0,
                label: name.to_string(),
                unit: reaction_unit(&unit.symbol),
                of_velocities: has_running(problem, zero),
            });
            continue;
        };
        for (component, demand) in pair.demands.iter().enumerate() {
            if vanish(g, problem, &[demand.value])[0] {
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

impl Source {
    pub(super) fn name(self, mechanism: &Mechanism) -> &Ident {
        match self {
            Source::Constraint(id) => &mechanism.constraints[id.index()].name,
            Source::Joint(id) => &mechanism.joints[id.index()].name,
        }
    }
}

impl<'a> Problem<'a> {
    /// The place of an equation; `None` where it holds whatever the mechanism does.
    pub(super) fn row(&self, source: Source, component: usize) -> Option<usize> {
        let is = |row: &Row| row.source == source && row.component == component;
        self.rows.iter().position(is)
    }

    /// The expression of a constraint that is no geometric one, and its unit.
    fn equation(&self, source: Source) -> (&'a Expr, &'a Unit) {
        if let Source::Constraint(id) = source
            && let ConstraintLaw::Equation { zero, unit } =
                &self.mechanism.constraints[id.index()].law
        {
            return (zero, unit);
        }
        unreachable!("all other constraints are geometric")
    }
}

/// Work per unit of an expression.
fn reaction_unit(unit: &str) -> String {
    match unit {
        "m" => "N".to_owned(),
        "" | "1" | "rad" => "N*m".to_owned(),
        other => format!("J/({other})"),
    }
}

/// Everything that has equations, in order of declaration: joints, then constraints.
fn sources(problem: &Problem) -> Vec<Source> {
    let joints = problem.topology.cut.iter().copied().map(Source::Joint);
    let constraints = (0..problem.mechanism.constraints.len())
        .map(ConstraintId::new)
        .map(Source::Constraint);
    joints.chain(constraints).collect()
}

/// A constraint between two sides; `None` for an equation.
fn geometric(g: &mut Graph, setting: &Setting, source: Source) -> Option<Pair> {
    let mechanism = setting.problem.mechanism;
    let id = match source {
        Source::Joint(id) => return Some(joint_demands(g, setting, &mechanism.joints[id.index()])),
        Source::Constraint(id) => id,
    };
    let Constraint { law, .. } = &mechanism.constraints[id.index()];
    Some(match law {
        ConstraintLaw::Coincident { from, to, along } => {
            coincident(g, setting, (*from, *to), *along)
        }
        ConstraintLaw::Aligned { from, to, axis } => {
            aligned(g, setting, (*from, *to), axis.as_ref())
        }
        ConstraintLaw::Distance { from, to, length } => distance(g, setting, (*from, *to), length),
        ConstraintLaw::Rolling {
            wheel,
            axis,
            radius,
            on,
            normal,
        } => rolling(g, setting, *wheel, axis.as_ref(), radius, *on, normal),
        ConstraintLaw::Equation { .. } => return None,
    })
}

/// Whether an expression holds a coordinate that runs in steady motion.
fn has_running(problem: &Problem, value: &Expr) -> bool {
    value.leaves().into_iter().any(|leaf| match leaf {
        Expr::Coordinate(id) => problem.mechanism.coordinates[id.index()].motion.runs(),
        _ => false,
    })
}

/// Evaluates the equations, by row, and adds what holds them to `forces`.
pub(super) fn constraints(
    g: &mut Graph,
    setting: &Setting,
    forces: &mut AppliedForces,
) -> Vec<ExprId> {
    let problem = setting.problem;
    let mut values = vec![g.zero(); problem.rows.len()];
    for source in sources(problem) {
        match geometric(g, setting, source) {
            Some(pair) => {
                let mut load = Wrench::zero(g);
                for (component, demand) in pair.demands.iter().enumerate() {
                    let Some(row) = problem.row(source, component) else {
                        continue;
                    };
                    values[row] = g.neg(demand.value);
                    let held = demand.held_by(g, problem.multiplier(row));
                    load = load.add(g, held);
                }
                forces.apply_pair(g, setting, &pair, load);
            }
            None => {
                let Some(row) = problem.row(source, 0) else {
                    continue;
                };
                values[row] = equation(g, setting, source, problem.multiplier(row), forces);
            }
        }
    }
    for (value, row) in values.iter().zip(problem.rows) {
        g.set_name(*value, || {
            format!("constraint_{}", row.label.replace('.', "_"))
        });
    }
    values
}

/// Running coordinates as symbols, everything else as it is.
struct Running<'a> {
    problem: &'a Problem<'a>,
    kinematics: &'a Kinematics,
}

impl State for Running<'_> {
    fn leaf(&self, leaf: &Expr) -> ExprId {
        if let Expr::Coordinate(id) = leaf
            && let Some(k) = self.problem.topology.running().position(|own| own == *id)
        {
            return self.problem.symbols.running.values[k];
        }
        self.kinematics.leaf(leaf)
    }
}

/// An expression that is zero, or whose rate is zero where it holds running coordinates.
fn equation(
    g: &mut Graph,
    setting: &Setting,
    source: Source,
    multiplier: ExprId,
    forces: &mut AppliedForces,
) -> ExprId {
    let Setting {
        problem,
        kinematics,
        ..
    } = *setting;
    let (symbols, topology) = (problem.symbols, problem.topology);
    let (zero, _) = problem.equation(source);
    let state = Running {
        problem,
        kinematics,
    };
    let value = problem.values.scalar_at(g, zero, &state);
    let free = topology.free.len();
    let ids: Vec<_> = symbols.q.ids[..free]
        .iter()
        .chain(&symbols.running.ids)
        .copied()
        .collect();
    let slopes = gradient(g, value, &ids);
    let coordinates: Vec<_> = topology
        .free
        .iter()
        .copied()
        .chain(topology.running())
        .collect();
    let positions: Vec<_> = topology
        .running()
        .map(|id| kinematics.coordinates[id.index()].position)
        .collect();
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
    let value = if has_running(problem, zero) {
        rate
    } else {
        value
    };
    g.neg(value)
}

/// What the `from` side of a constraint or of a cut joint exerts on the `to` side, seen from the point of `from` along its
/// axes; `None` for an equation.
pub(super) fn held(g: &mut Graph, setting: &Setting, source: Source) -> Option<Wrench> {
    let pair = geometric(g, setting, source)?;
    let mut load = Wrench::zero(g);
    for (component, demand) in pair.demands.iter().enumerate() {
        if let Some(row) = setting.problem.row(source, component) {
            let held = demand.held_by(g, setting.problem.multiplier(row));
            load = load.add(g, held);
        }
    }
    let lever = pair.gap(g).cross(g, load.force);
    let moment = load.moment.add(g, lever);
    let to_axes = pair.from.at.axes.transpose();
    Some(Wrench {
        force: to_axes.apply(g, load.force),
        moment: to_axes.apply(g, moment),
    })
}

impl Demand {
    /// What a multiplier exerts on the `to` side.
    fn held_by(&self, g: &mut Graph, multiplier: ExprId) -> Wrench {
        Wrench {
            force: self.force.scale(g, multiplier),
            moment: self.moment.scale(g, multiplier),
        }
    }
}

impl Wrench {
    pub(super) fn zero(g: &mut Graph) -> Self {
        Self {
            force: Vector3::zero(g),
            moment: Vector3::zero(g),
        }
    }
}
