//! The recipe from a mechanism to its functions.

use crate::algebra::{Array, Function, Graph, Vector3, substitute};
use crate::base::diagnostics::Diagnostics;
use crate::base::ids::{CoordinateId, ExprId};
use crate::model::mechanism::{Mechanism, Motion};
use crate::topology::Topology;

use super::constraints::{self, Row};
use super::functions::{Functions, Limits, Pose, Requirement, Role, Unknown};
use super::inertial::{Inertial, inertial};
use super::kernels::{kernels, parameter};
use super::kinematics::{CoordinateMotion, Kinematics};
use super::layout::{Layout, Runs};
use super::linearise::{Jacobians, Linear, at_rest};
use super::loads::transmitted;
use super::outputs::outputs;
use super::poses::poses;
use super::properties;
use super::requirements::requirements;
use super::sources::{Selection, Sources};
use super::steady_state;
use super::symbols::Symbols;
use super::values::Values;
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

/// What every step of the derivation reads.
pub(super) struct Problem<'a> {
    pub(super) mechanism: &'a Mechanism,
    pub(super) topology: &'a Topology,
    pub(super) symbols: &'a Symbols,
    pub(super) values: &'a Values<'a>,
    /// The coordinates in which inertia and weight are derived.
    pub(super) runs: &'a Runs,
    /// The equations of constraints.
    pub(super) rows: &'a [Row],
}

impl Problem<'_> {
    /// Numbers of free coordinates, and of coordinates with an equation of motion: free and coasting.
    pub(super) fn moving(&self) -> (usize, usize) {
        let free = self.topology.free.len();
        (free, free + self.topology.coasting.len())
    }

    /// The multiplier of an equation of a constraint.
    pub(super) fn multiplier(&self, row: usize) -> ExprId {
        self.symbols.q.values[self.moving().1 + row]
    }

    /// Motion of every frame while the running coordinates stand at zero.
    pub(super) fn kinematics_at_zero(&self, g: &mut Graph) -> Kinematics {
        let zero = g.zero();
        self.kinematics(g, &vec![zero; self.symbols.running.ids.len()])
    }

    /// Motion of every frame while the running coordinates stand at `running`.
    pub(super) fn kinematics(&self, g: &mut Graph, running: &[ExprId]) -> Kinematics {
        let symbols = self.symbols;
        let motions = self.motions(g, running, |k| CoordinateMotion {
            position: symbols.q.values[k],
            velocity: symbols.velocity.values[k],
            acceleration: symbols.acceleration.values[k],
        });
        let layout = Layout::common(self.mechanism.bodies.len());
        let still = Vector3::zero(g);
        Kinematics::new(
            g,
            self.mechanism,
            self.topology,
            self.values,
            motions,
            &layout,
            still,
        )
    }

    /// Motion of every body as inertia and weight need it: along runs, the ground accelerated against gravity.
    pub(super) fn inertial_kinematics(
        &self,
        g: &mut Graph,
        running: &[ExprId],
        sources: Sources,
    ) -> Kinematics {
        let mut motions = self.motions(g, running, |k| self.runs.motion(k));
        let zero = g.zero();
        if sources.inertia == Selection::None {
            for motion in &mut motions {
                motion.velocity = zero;
                motion.acceleration = zero;
            }
        }
        let ground = match sources.gravity {
            true => self.values.vector(g, &self.mechanism.gravity).neg(g),
            false => Vector3::zero(g),
        };
        let layout = &self.runs.layout;
        Kinematics::new(
            g,
            self.mechanism,
            self.topology,
            self.values,
            motions,
            layout,
            ground,
        )
    }

    /// By coordinate id: the motion of all coordinates, `free` of the free ones.
    fn motions(
        &self,
        g: &mut Graph,
        running: &[ExprId],
        free: impl Fn(usize) -> CoordinateMotion,
    ) -> Vec<CoordinateMotion> {
        let zero = g.zero();
        let still = CoordinateMotion {
            position: zero,
            velocity: zero,
            acceleration: zero,
        };
        let mut coordinates = vec![still; self.mechanism.coordinates.len()];
        for (k, id) in self.topology.free.iter().enumerate() {
            coordinates[id.index()] = free(k);
        }
        for (k, id) in self.topology.driven.iter().enumerate() {
            let coordinate = &self.mechanism.coordinates[id.index()];
            if let Motion::Driven(speed) = &coordinate.motion {
                let velocity = self.values.scalar(g, speed);
                g.set_name(velocity, || format!("speed_{}", coordinate.name));
                coordinates[id.index()] = CoordinateMotion {
                    position: running[k],
                    velocity,
                    acceleration: zero,
                };
            }
        }
        let (free, driven) = (self.moving().0, self.topology.driven.len());
        for (k, id) in self.topology.coasting.iter().enumerate() {
            coordinates[id.index()] = CoordinateMotion {
                position: running[driven + k],
                velocity: self.symbols.q.values[free + k],
                acceleration: self.symbols.velocity.values[free + k],
            };
        }
        coordinates
    }

    /// For each unknown, the position of its joint on the way from the ground to the leaves; reactions stand behind them.
    pub(super) fn outward_order(&self) -> Vec<usize> {
        let place = |id: &CoordinateId| {
            let joint = self.mechanism.coordinates[id.index()].joint;
            self.topology
                .branches
                .iter()
                .position(|branch| branch.joint == joint)
                .unwrap_or(0)
        };
        let reactions = self.rows.iter().map(|_| usize::MAX);
        let moving = self.topology.free.iter().chain(&self.topology.coasting);
        moving.map(place).chain(reactions).collect()
    }

    /// Inertia less weight of every body and along every coordinate.
    pub(super) fn inertial(&self, g: &mut Graph, running: &[ExprId], sources: Sources) -> Inertial {
        let kinematics = self.inertial_kinematics(g, running, sources);
        inertial(g, self, &kinematics, sources)
    }

    /// The residual in its two parts.
    fn parts(
        &self,
        g: &mut Graph,
        running: &[ExprId],
        kinematics: &Kinematics,
        sources: Sources,
    ) -> Parts {
        let inertial = self.inertial(g, running, sources).along;
        let loads = transmitted(g, self, kinematics, sources);
        let moving = || self.topology.free.iter().chain(&self.topology.coasting);
        let zeros = loads.constraints.iter().map(|_| g.zero());
        Parts {
            inertial: moving()
                .map(|id| inertial[id.index()])
                .chain(zeros)
                .collect(),
            applied: moving()
                .map(|id| loads.along[id.index()])
                .chain(loads.constraints.iter().copied())
                .collect(),
        }
    }

    /// The residual: along free and coasting coordinates, then the equations of constraints. `kinematics` is the motion while
    /// the running coordinates stand at `running`.
    pub(super) fn residual(
        &self,
        g: &mut Graph,
        running: &[ExprId],
        kinematics: &Kinematics,
        sources: Sources,
    ) -> Vec<ExprId> {
        let parts = self.parts(g, running, kinematics, sources);
        self.together(g, &parts)
    }

    fn together(&self, g: &mut Graph, parts: &Parts) -> Vec<ExprId> {
        let inertial = self.runs.forces(g, &parts.inertial);
        let inertial = self.in_unknowns(g, &inertial);
        let sums: Vec<ExprId> = inertial
            .into_iter()
            .zip(&parts.applied)
            .map(|(inertial, &applied)| g.add(inertial, applied))
            .collect();
        let coordinates = self.topology.free.iter().chain(&self.topology.coasting);
        for (&value, id) in sums.iter().zip(coordinates) {
            let name = &self.mechanism.coordinates[id.index()].name;
            g.set_name(value, || format!("residual_{name}"));
        }
        sums
    }

    /// With the sums of the unknowns for the angles in all.
    pub(super) fn in_unknowns(&self, g: &mut Graph, roots: &[ExprId]) -> Vec<ExprId> {
        let sums = self.runs.sums(g, self.symbols);
        substitute(g, roots, &sums)
    }
}

/// The residual in two parts: their sum, once the first is summed along runs.
pub(super) struct Parts {
    /// By unknown: inertia less weight, over the angles in all.
    pub(super) inertial: Vec<ExprId>,
    /// By unknown: forces and constraints, with the sign of inertia.
    pub(super) applied: Vec<ExprId>,
}

/// The equations with the running coordinates at zero, which a steady state allows.
pub(super) struct Equations {
    /// `g(qddot, qdot, q; u, b)`, and its parts.
    pub(super) motion: Vec<ExprId>,
    pub(super) parts: Parts,
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
            without_velocity,
            rest,
            rest_inertia,
            rest_applied,
            outputs,
        }
    }
}
