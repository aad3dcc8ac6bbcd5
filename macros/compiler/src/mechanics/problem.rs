//! What every step of the derivation reads, and the residual in its parts.

use crate::algebra::{Graph, Vector3, evaluate, substitute};
use crate::base::ids::{CoordinateId, ExprId};
use crate::model::mechanism::{Mechanism, Motion};
use crate::topology::Topology;

use super::constraints::Row;
use super::inertial::{Inertial, inertial};
use super::kinematics::{CoordinateMotion, Kinematics};
use super::layout::{Layout, Runs};
use super::loads::transmitted;
use super::sources::{Selection, Sources};
use super::symbols::Symbols;
use super::values::Values;

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

    /// What an expression of inputs and design variables comes to at the nominal design; inputs, which have no nominal values,
    /// are one.
    pub(super) fn nominal(&self, g: &Graph, value: ExprId) -> f64 {
        let value = evaluate(g, &[value], |symbol| {
            let design = self.symbols.b.ids.iter().zip(&self.mechanism.design);
            let mut nominal = design.filter(|(id, _)| **id == symbol);
            nominal.next().map_or(1.0, |(_, variable)| variable.nominal)
        });
        value[0]
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
    pub(super) fn parts(
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

    /// The whole of the two parts.
    pub(super) fn together(&self, g: &mut Graph, parts: &Parts) -> Vec<ExprId> {
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
