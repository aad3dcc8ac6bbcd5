//! Inertia of beams: a mass distribution over arms that turn by themselves.
//!
//! A beam's sections are at `r_a = L sum_k W_ak d_k` from the root, with the directions `d_k` of the beam at the places
//! of quadrature and the numbers `W_ak` of integration up to place `a`. So its integrals of `rho` and `rho rho^T` have
//! the form of those of a rigid body, `sum_k first_k d_k` and `sum_kj second_kj d_k d_j^T`, with constant `first` and
//! `second`; only the arms `d_k` do not turn together. Each arm needs the force `S_k = first_k a_O + sum_j second_kj
//! d_j'' + reach_k F`, where `F` acts on a station, and `d_k x S_k` is the moment that turns its section. The axes of a
//! section are further arms, for its inertia against turning.

use crate::algebra::{ExprId, Graph, Unary, Vector3};
use crate::base::ids::BeamId;
use crate::mechanics::motion::{BeamMotion, FrameMotion};
use crate::mechanics::setup::{Context, Sections};

/// The mass distribution of a beam over the arms of its sections.
pub(crate) struct BeamInertia {
    pub(crate) mass: ExprId,
    arms: Vec<Arm>,
    /// By arm.
    first: Vec<ExprId>,
    second: Vec<Vec<ExprId>>,
    /// By section: angular momentum about its axis by which its material spins beside it; empty if none does.
    spin: Vec<ExprId>,
    /// Twice the energy of this spin.
    energy_of_spin: ExprId,
}

/// An arm of a section: the direction of the beam there, or a direction across the section by its components.
struct Arm {
    section: usize,
    across: Option<[ExprId; 2]>,
}

/// An arm in motion.
pub(crate) struct MovingArm {
    section: usize,
    is_direction: bool,
    pub(crate) vector: Vector3,
    second_rate: Vector3,
    pub(crate) rate: Vector3,
    pub(crate) first: ExprId,
}

/// What the stations of a beam pass on.
#[derive(Clone)]
pub(crate) struct FromStations {
    /// By section: the force that its direction carries to the stations, times the share in their places.
    brackets: Vec<Vector3>,
    /// By station.
    moments: Vec<Vector3>,
}

/// Inertia of a beam about its root, with what its stations pass on.
pub(crate) struct BeamLoad {
    /// The part of the force that does not depend on the root's acceleration.
    pub(crate) force: Vector3,
    /// The moment without those of the stations.
    pub(crate) moment: Vector3,
    /// By section, then by station: the moment that turns it.
    turning: Vec<Vector3>,
    /// By section: the force on its direction.
    pulling: Vec<Vector3>,
}

impl BeamInertia {
    pub(crate) fn new(g: &mut Graph, context: &Context, id: BeamId) -> Self {
        let beam = &context.mechanism.beams[id.index()];
        let values = context.values;
        let name = beam.name.clone();
        let length = values.scalar(g, &beam.length);
        let square = g.mul(length, length);
        let cube = g.mul(square, length);
        let rule = beam.quadrature();
        let zero = g.zero();
        let reach: Vec<Vec<f64>> = rule.points.iter().map(|x| rule.integrals_to(*x)).collect();
        let masses: Vec<ExprId> = beam
            .sections
            .iter()
            .map(|(_, _, section)| values.scalar(g, &section.mass))
            .collect();
        // Equal masses are added as numbers.
        let weighted = |g: &mut Graph, of: &dyn Fn(usize) -> f64| {
            let mut sums: Vec<(ExprId, f64)> = Vec::new();
            for (a, &mass) in masses.iter().enumerate() {
                let share = rule.weights[a] * of(a);
                match sums.iter_mut().find(|(own, _)| *own == mass) {
                    Some((_, sum)) => *sum += share,
                    None => sums.push((mass, share)),
                }
            }
            let terms: Vec<ExprId> = sums.into_iter().map(|(m, sum)| g.scale(sum, m)).collect();
            g.sum(terms)
        };
        let per_length = weighted(g, &|_| 1.0);
        let mass = g.mul(per_length, length);
        g.set_name(mass, || format!("{name}_mass"));
        let n = rule.points.len();
        let mut this = Self {
            mass,
            arms: Vec::new(),
            first: Vec::new(),
            second: vec![vec![zero; n]; n],
            spin: Vec::new(),
            energy_of_spin: zero,
        };
        let spin = values.scalar(g, &beam.spin);
        for k in 0..n {
            let share = weighted(g, &|a| reach[a][k]);
            this.first.push(g.mul(share, square));
            this.arms.push(Arm {
                section: k,
                across: None,
            });
            for j in 0..=k {
                let share = weighted(g, &|a| reach[a][k] * reach[a][j]);
                let second = g.mul(share, cube);
                g.set_name(second, || format!("{name}_second_moment_{k}_{j}"));
                this.second[k][j] = second;
                this.second[j][k] = second;
            }
        }
        for (k, (_, weight, section)) in beam.sections.iter().enumerate() {
            let [about_y, about_z] =
                [&section.inertia[0], &section.inertia[1]].map(|value| values.scalar(g, value));
            let twist = values.scalar(g, &section.twist);
            let (sine, cosine) = (g.unary(Unary::Sin, twist), g.unary(Unary::Cos, twist));
            let minus = g.neg(sine);
            let share = g.scale(*weight, length);
            if !g.is(spin, 0.0) {
                let polar = g.add(about_y, about_z);
                let inertia = g.mul(share, polar);
                let momentum = g.mul(inertia, spin);
                let energy = g.mul(momentum, spin);
                this.energy_of_spin = g.add(this.energy_of_spin, energy);
                this.spin.push(momentum);
            }
            // The distance along the second axis is that from the third.
            let axes = [(about_z, [cosine, sine]), (about_y, [minus, cosine])];
            for (inertia, components) in axes {
                if g.is(inertia, 0.0) {
                    continue;
                }
                let second = g.mul(share, inertia);
                this.add(g, k, components, second);
            }
        }
        this
    }

    fn add(&mut self, g: &mut Graph, section: usize, components: [ExprId; 2], second: ExprId) {
        let zero = g.zero();
        self.first.push(zero);
        self.arms.push(Arm {
            section,
            across: Some(components),
        });
        for row in &mut self.second {
            row.push(zero);
        }
        let mut row = vec![zero; self.arms.len()];
        if let Some(last) = row.last_mut() {
            *last = second;
        }
        self.second.push(row);
    }

    /// The arms in motion.
    pub(crate) fn moving(&self, g: &mut Graph, motion: &BeamMotion) -> Vec<MovingArm> {
        let arms = self.arms.iter().zip(&self.first);
        arms.map(|(arm, &first)| {
            let own = &motion.sections[arm.section];
            let Some(components) = &arm.across else {
                let own = &motion.directions[arm.section];
                return MovingArm {
                    section: arm.section,
                    is_direction: true,
                    vector: own.vector,
                    rate: own.rate,
                    second_rate: own.second_rate,
                    first,
                };
            };
            let (mut vector, mut second_rate) = (Vector3::zero(g), Vector3::zero(g));
            for ((axis, rate), &share) in own.arms().into_iter().skip(1).zip(components) {
                let along = axis.scale(g, share);
                vector = vector.add(g, along);
                let along = rate.scale(g, share);
                second_rate = second_rate.add(g, along);
            }
            MovingArm {
                section: arm.section,
                is_direction: false,
                rate: own.frame.angular_velocity.cross(g, vector),
                vector,
                second_rate,
                first,
            }
        })
        .collect()
    }

    /// Twice the kinetic energy of a beam whose root moves with the velocity `v`.
    pub(crate) fn twice_kinetic(&self, g: &mut Graph, motion: &BeamMotion, v: Vector3) -> ExprId {
        let moving = self.moving(g, motion);
        let speed = v.dot(g, v);
        let mut terms = vec![g.mul(self.mass, speed), self.energy_of_spin];
        for (section, &momentum) in motion.sections.iter().zip(&self.spin) {
            let [(axis, _), ..] = section.arms();
            let along = section.frame.angular_velocity.dot(g, axis);
            let product = g.mul(momentum, along);
            terms.push(g.scale(2.0, product));
        }
        for (arm, second) in moving.iter().zip(&self.second) {
            let along = v.dot(g, arm.rate);
            let double = g.scale(2.0, arm.first);
            terms.push(g.mul(double, along));
            for (&second, other) in second.iter().zip(&moving) {
                if !g.is(second, 0.0) {
                    let product = arm.rate.dot(g, other.rate);
                    terms.push(g.mul(second, product));
                }
            }
        }
        g.sum(terms)
    }

    /// Inertia of a beam whose root moves like `root`.
    pub(crate) fn load(
        &self,
        g: &mut Graph,
        motion: &BeamMotion,
        root: &FrameMotion,
        from: &FromStations,
    ) -> BeamLoad {
        let moving = self.moving(g, motion);
        let zero = Vector3::zero(g);
        let mut load = BeamLoad {
            force: zero,
            moment: zero,
            turning: vec![zero; motion.sections.len()],
            pulling: vec![zero; motion.sections.len()],
        };
        for (k, (arm, second)) in moving.iter().zip(&self.second).enumerate() {
            let mut bracket = root.acceleration.scale(g, arm.first);
            for (&second, other) in second.iter().zip(&moving) {
                let share = other.second_rate.scale(g, second);
                bracket = bracket.add(g, share);
            }
            if let Some(passed) = from.brackets.get(k) {
                bracket = bracket.add(g, *passed);
            }
            if arm.is_direction {
                load.pulling[arm.section] = bracket;
            }
            let share = arm.second_rate.scale(g, arm.first);
            load.force = load.force.add(g, share);
            let moment = arm.vector.cross(g, bracket);
            load.moment = load.moment.add(g, moment);
            let turning = &mut load.turning[arm.section];
            *turning = turning.add(g, moment);
        }
        for (k, &momentum) in self.spin.iter().enumerate() {
            let section = &motion.sections[k];
            let [(axis, _), ..] = section.arms();
            let turning = section.frame.angular_velocity.cross(g, axis);
            let moment = turning.scale(g, momentum);
            load.moment = load.moment.add(g, moment);
            load.turning[k] = load.turning[k].add(g, moment);
        }
        load.turning.extend(&from.moments);
        load
    }
}

impl FromStations {
    /// Nothing, for each beam.
    pub(crate) fn nothing(g: &mut Graph, context: &Context) -> Vec<Self> {
        let zero = Vector3::zero(g);
        let beams = context.mechanism.beams.iter();
        beams
            .map(|beam| Self {
                brackets: vec![zero; beam.sections.len()],
                moments: vec![zero; beam.stations.len()],
            })
            .collect()
    }

    /// Adds the load on a station, about its origin.
    pub(crate) fn add(
        &mut self,
        g: &mut Graph,
        motion: &BeamMotion,
        station: usize,
        [force, moment]: [Vector3; 2],
    ) {
        let reach = &motion.stations[station].reach;
        for (bracket, &share) in self.brackets.iter_mut().zip(reach) {
            let part = force.scale(g, share);
            *bracket = bracket.add(g, part);
        }
        self.moments[station] = self.moments[station].add(g, moment);
    }

    /// Takes away forces on the directions.
    pub(crate) fn subtract_distributed(&mut self, g: &mut Graph, forces: &[Vector3]) {
        for (bracket, force) in self.brackets.iter_mut().zip(forces) {
            *bracket = bracket.sub(g, *force);
        }
    }

    /// The moments that turn sections and stations, without inertia.
    pub(crate) fn turning(&self, g: &mut Graph, motion: &BeamMotion) -> BeamLoad {
        let zero = Vector3::zero(g);
        let directions = motion.directions.iter().zip(&self.brackets);
        let mut turning: Vec<Vector3> = directions
            .map(|(own, bracket)| own.vector.cross(g, *bracket))
            .collect();
        let moment = turning.iter().fold(zero, |sum, own| sum.add(g, *own));
        turning.extend(&self.moments);
        BeamLoad {
            force: zero,
            pulling: self.brackets.clone(),
            moment,
            turning,
        }
    }
}

impl BeamLoad {
    /// Adds the forces along the rows of the sections.
    pub(crate) fn add_along(
        &self,
        g: &mut Graph,
        sections: &Sections,
        id: BeamId,
        motion: &BeamMotion,
        along: &mut [ExprId],
    ) {
        for (direction, force) in motion.directions.iter().zip(&self.pulling) {
            for (row, power) in direction.project(g, *force) {
                along[row] = g.add(along[row], power);
            }
        }
        let rows = sections.of(id);
        let rows = rows.rotations.iter().chain(&rows.stations);
        let stations = motion.stations.iter().map(|own| &own.section);
        let all = motion.sections.iter().chain(stations);
        for ((rows, section), moment) in rows.zip(all).zip(&self.turning) {
            let powers = section.project(g, *moment);
            for (row, power) in rows.iter().zip(powers) {
                if let Some(row) = *row {
                    along[row] = g.add(along[row], power);
                }
            }
        }
    }
}
