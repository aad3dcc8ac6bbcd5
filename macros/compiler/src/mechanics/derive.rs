//! The recipe from a mechanism to its functions.

use crate::algebra::{Array, Function, Graph, substitute};
use crate::base::diagnostics::Diagnostics;
use crate::base::ids::{CoordinateId, ExprId};
use crate::model::mechanism::Mechanism;
use crate::topology::Topology;

use super::constraints;
use super::functions::{Functions, Limits, Pose, Requirement, Role, Unknown};
use super::kernels::{kernels, parameter};
use super::layout::Runs;
use super::linearise::{Jacobians, Linear, at_rest};
use super::outputs::outputs;
use super::poses::poses;
use super::problem::{Parts, Problem};
use super::properties;
use super::requirements::requirements;
use super::sources::Sources;
use super::steady_state;
use super::symbols::Symbols;
use super::values::Values;
use super::variation::{Variation, variation};
use super::whirl::whirl;

/// Derives every function of a mechanism. Fails where no steady state exists, where a coordinate has no inertia, and
/// where nothing resists one: what only the equations can tell about a declaration.
pub fn derive(
    mechanism: &Mechanism,
    topology: &Topology,
    limits: Limits,
) -> Result<Functions, Diagnostics> {
    let mut graph = Graph::new();
    let g = &mut graph;
    let symbols = Symbols::new(g, mechanism, topology);
    let values = Values::new(g, mechanism, &symbols);
    let runs = Runs::new(g, mechanism, topology, &values, &symbols);
    let unconstrained = Problem {
        mechanism,
        topology,
        symbols: &symbols,
        values: &values,
        runs: &runs,
        rows: &[],
    };
    let rows = constraints::rows(g, &unconstrained);
    let labels: Vec<String> = rows.iter().map(|row| row.label.replace('.', "_")).collect();
    let symbols = symbols.clone().with_reactions(g, &labels);
    let runs = runs.with_reactions(&symbols);
    let values = Values::new(g, mechanism, &symbols);
    let problem = Problem {
        mechanism,
        topology,
        symbols: &symbols,
        values: &values,
        runs: &runs,
        rows: &rows,
    };

    steady_state::check(g, &problem)?;
    let equations = Equations::new(g, &problem);
    let jacobians = Jacobians::new(g, &problem, &equations);
    properties::check(g, &problem, &jacobians)?;
    let properties = properties::establish(g, &problem, &jacobians);
    let linear = Linear::new(g, &jacobians, properties, &problem);
    let mut functions = kernels(g, &symbols, &equations, &linear, limits);
    functions.extend(whirl(g, &problem).map(|values| whirl_of(values, &symbols)));
    let requirements = requirements(g, mechanism, &values);
    functions.push(check_of(&requirements, &symbols));
    let poses = poses(g, &problem);
    functions.push(margins_of(&poses, &symbols));
    let unknowns = unknowns(&problem);
    Ok(Functions {
        unknowns,
        graph,
        functions,
        requirements,
        poses,
        properties,
    })
}

/// What the entries of `q` are.
fn unknowns(problem: &Problem) -> Vec<Unknown> {
    let (mechanism, topology) = (problem.mechanism, problem.topology);
    let of = |id: CoordinateId, per_second: &str, role: fn(CoordinateId) -> Role| {
        let coordinate = &mechanism.coordinates[id.index()];
        Unknown {
            name: coordinate.name.to_string(),
            unit: format!("{}{per_second}", coordinate.quantity.unit()),
            role: role(id),
        }
    };
    let free = topology.free.iter().map(|&id| of(id, "", Role::Position));
    let coasting = topology
        .coasting
        .iter()
        .map(|&id| of(id, "/s", Role::Speed));
    let reactions = problem.rows.iter().map(|row| Unknown {
        name: row.label.clone(),
        unit: row.unit.clone(),
        role: match row.of_velocities {
            false => Role::PositionReaction,
            true => Role::VelocityReaction,
        },
    });
    free.chain(coasting).chain(reactions).collect()
}

/// The function whose results have to be positive.
fn check_of(requirements: &[Requirement], symbols: &Symbols) -> Function {
    let values: Vec<ExprId> = requirements.iter().map(|r| r.value).collect();
    Function {
        name: "violation",
        parameters: vec![parameter("u", &symbols.u), parameter("b", &symbols.b)],
        results: vec![Array {
            name: "requirements",
            shape: vec![values.len()],
            values,
        }],
    }
}

/// The function whose results tell how far joints are from their singular poses.
fn margins_of(poses: &[Pose], symbols: &Symbols) -> Function {
    let values: Vec<ExprId> = poses.iter().map(|pose| pose.volume).collect();
    Function {
        name: "pose_margin",
        parameters: vec![
            parameter("q", &symbols.q),
            parameter("u", &symbols.u),
            parameter("b", &symbols.b),
        ],
        results: vec![Array {
            name: "volumes",
            shape: vec![values.len()],
            values,
        }],
    }
}

/// The function that tells the sense in which a vibration circles.
fn whirl_of(moment_and_size: [ExprId; 2], symbols: &Symbols) -> Function {
    Function {
        name: "whirl",
        parameters: vec![
            parameter("q", &symbols.q),
            parameter("u", &symbols.u),
            parameter("b", &symbols.b),
            parameter("real", &symbols.real),
            parameter("imaginary", &symbols.imaginary),
        ],
        results: vec![Array {
            name: "moment_and_size",
            shape: vec![2],
            values: moment_and_size.to_vec(),
        }],
    }
}

/// The equations with the running coordinates at zero, which a steady state allows.
pub(super) struct Equations {
    /// `g(qddot, qdot, q; u, b)`, and its parts.
    pub(super) motion: Vec<ExprId>,
    pub(super) parts: Parts,
    /// Derivatives of the inertial part, where there is a shorter way than to differentiate it.
    pub(super) variation: Option<Variation>,
    /// `g(qddot, 0, q; u, b)`.
    pub(super) without_velocity: Vec<ExprId>,
    /// `g(0, 0, q; u, b)`.
    pub(super) rest: Vec<ExprId>,
    /// The part of `rest` due to inertia.
    pub(super) rest_inertia: Vec<ExprId>,
    /// The part of `rest` due to applied forces, with the sign of a force: `rest = rest_inertia - rest_applied`.
    pub(super) rest_applied: Vec<ExprId>,
    /// Outputs at rest.
    pub(super) outputs: Vec<ExprId>,
}

impl Equations {
    fn new(g: &mut Graph, problem: &Problem) -> Self {
        let zero = g.zero();
        let symbols = problem.symbols;
        let running = vec![zero; symbols.running.ids.len()];
        let kinematics = problem.kinematics(g, &running);
        let zeros = vec![zero; symbols.q.ids.len()];
        let parts = problem.parts(g, &running, &kinematics, Sources::ALL);
        let motion = problem.together(g, &parts);
        let variation = variation(g, problem, &running);
        let inertia = problem.residual(g, &running, &kinematics, Sources::INERTIA);
        let applied = problem.residual(g, &running, &kinematics, Sources::APPLIED);
        let outputs = outputs(g, problem, &running, &kinematics);
        let without: Vec<_> = symbols.velocity.with(&zeros).collect();
        let without_velocity = substitute(g, &motion, &without);
        let rest = at_rest(g, symbols, &motion);
        let rest_inertia = at_rest(g, symbols, &inertia);
        let minus_applied = at_rest(g, symbols, &applied);
        let rest_applied = minus_applied
            .into_iter()
            .map(|force| g.neg(force))
            .collect();
        let outputs = at_rest(g, symbols, &outputs);
        Self {
            motion,
            parts,
            variation,
            without_velocity,
            rest,
            rest_inertia,
            rest_applied,
            outputs,
        }
    }
}
