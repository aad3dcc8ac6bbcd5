//! Inertia of beams: a mass distribution over arms that turn by themselves.
//!
//! A beam's sections are at `r_a = L sum_k W_ak d_k` from the root, with the directions `d_k` of the beam at the places
//! of quadrature and the numbers `W_ak` of integration up to place `a`. So its integrals of `rho` and `rho rho^T` have
//! the form of those of a rigid body, `sum_k first_k d_k` and `sum_kj second_kj d_k d_j^T`, with constant `first` and
//! `second`; only the arms `d_k` do not turn together. A centre of mass off the axis is one more arm `o_k`, with `first
//! = m_k w_k L`, with this also as `second` with itself, and with `first L W_kj` as `second` with `d_j`. Each arm needs
//! the force `S_k = first_k a_O + sum_j second_kj d_j'' + reach_k F`, where `F` acts on a station, and `d_k x S_k` is
//! the moment that turns its section. The moment of its own inertia, `J w' + w x J w`, is written along its axes.

use crate::algebra::{Direction, ExprId, Graph, Matrix3, Vector3};
use crate::base::ids::BeamId;
use crate::mechanics::motion::{BeamMotion, FrameMotion, curved, offset, turned};
use crate::mechanics::setup::{Context, Sections, weighted_sum};

/// The mass distribution of a beam over the directions of its sections.
pub(crate) struct BeamInertia {
    pub(crate) mass: ExprId,
    /// By arm: the sections in order, then those with mass off the axis.
    pub(crate) first: Vec<ExprId>,
    pub(super) second: Vec<Vec<ExprId>>,
    /// By section: inertia against turning, along its axes.
    pub(super) turning: Vec<Matrix3>,
    /// By section: angular momentum about its axis by which its material spins beside it.
    pub(super) spin: Vec<ExprId>,
    /// Twice the energy of this spin.
    energy_of_spin: ExprId,
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
    /// By station: the moment on it.
    of_stations: Vec<Vector3>,
    /// By section: the moment that its rotary inertia requires, along its axes.
    of_sections: Vec<Vector3>,
    /// By arm: the force on it.
    on_arms: Vec<Vector3>,
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
        let masses: Vec<ExprId> = beam.sections.iter().map(|(_, _, section)| values.scalar(g, &section.mass)).collect();
        // Equal masses are added as numbers.
        let weighted = |g: &mut Graph, of: &dyn Fn(usize) -> f64| {
            let mut sums: Vec<(ExprId, f64)> = Vec::new();
            for (a, &mass) in masses.iter().enumerate() {
                let share = rule.weights[a] * of(a);
                match sums.iter_mut().find(|(x, _)| *x == mass) {
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
            first: Vec::new(),
            second: vec![vec![zero; n]; n],
            turning: Vec::new(),
            spin: Vec::new(),
            energy_of_spin: zero,
        };
        let spin = values.scalar(g, &beam.spin);
        for k in 0..n {
            let share = weighted(g, &|a| reach[a][k]);
            this.first.push(g.mul(share, square));
            for j in 0..=k {
                let share = weighted(g, &|a| reach[a][k] * reach[a][j]);
                let second = g.mul(share, cube);
                g.set_name(second, || format!("{name}_second_moment_{k}_{j}"));
                this.second[k][j] = second;
                this.second[j][k] = second;
            }
        }
        for (k, (_, weight, section)) in beam.sections.iter().enumerate() {
            if offset(g, values, section).is_zero(g) {
                continue;
            }
            let share = g.scale(*weight, length);
            let mass = g.mul(masses[k], share);
            let by_length = g.mul(mass, length);
            let mut row: Vec<ExprId> = reach[k].iter().map(|x| g.scale(*x, by_length)).collect();
            row.resize(this.first.len(), zero);
            for (others, second) in this.second.iter_mut().zip(&row) {
                others.push(*second);
            }
            row.push(mass);
            this.first.push(mass);
            this.second.push(row);
        }
        for (_, weight, section) in &beam.sections {
            let [about_y, about_z] = [&section.inertia[0], &section.inertia[1]].map(|value| values.scalar(g, value));
            let twist = values.scalar(g, &section.twist);
            let share = g.scale(*weight, length);
            let polar = g.add(about_y, about_z);
            let inertia = g.mul(share, polar);
            let momentum = g.mul(inertia, spin);
            let energy = g.mul(momentum, spin);
            this.energy_of_spin = g.add(this.energy_of_spin, energy);
            this.spin.push(momentum);
            let about = [about_y, about_z].map(|x| g.mul(share, x));
            let [yy, yz, zz] = turned(g, about, twist);
            let tensor = [[inertia, zero, zero], [zero, yy, yz], [zero, yz, zz]];
            this.turning.push(Matrix3(curved(g, values, section).turn_symmetric(g, tensor).map(Vector3)));
        }
        this
    }

    /// By section: the angular momentum along its axes.
    fn momenta(&self, g: &mut Graph, motion: &BeamMotion) -> Vec<Vector3> {
        let sections = motion.sections.iter().zip(&self.turning);
        sections
            .zip(&self.spin)
            .map(|((section, inertia), &spin_momentum)| {
                let mut momentum = inertia.apply(g, section.spin);
                momentum.0[0] = g.add(momentum.0[0], spin_momentum);
                momentum
            })
            .collect()
    }

    /// Twice the kinetic energy of a beam whose root moves with the velocity `v`.
    pub(crate) fn twice_kinetic(&self, g: &mut Graph, motion: &BeamMotion, v: Vector3) -> ExprId {
        let speed = v.dot(g, v);
        let mut terms = vec![g.mul(self.mass, speed), self.energy_of_spin];
        let momenta = self.momenta(g, motion);
        for ((section, momentum), &spin_momentum) in motion.sections.iter().zip(momenta).zip(&self.spin) {
            terms.push(section.spin.dot(g, momentum));
            terms.push(g.mul(spin_momentum, section.spin.0[0]));
        }
        let arms = motion.arms().zip(&self.first);
        for (((_, arm), first), second) in arms.zip(&self.second) {
            let along = v.dot(g, arm.rate);
            let double = g.scale(2.0, *first);
            terms.push(g.mul(double, along));
            for (&second, (_, other)) in second.iter().zip(motion.arms()) {
                let product = arm.rate.dot(g, other.rate);
                terms.push(g.mul(second, product));
            }
        }
        g.sum(terms)
    }

    /// Inertia of a beam whose root moves like `root`.
    pub(crate) fn load(&self, g: &mut Graph, motion: &BeamMotion, root: &FrameMotion, from: &FromStations) -> BeamLoad {
        let zero = Vector3::zero(g);
        let mut load = BeamLoad {
            force: zero,
            moment: zero,
            of_stations: from.moments.clone(),
            of_sections: Vec::new(),
            on_arms: Vec::new(),
        };
        for (k, ((_, arm), second)) in motion.arms().zip(&self.second).enumerate() {
            let mut bracket = root.acceleration.scale(g, self.first[k]);
            for (&second, (_, other)) in second.iter().zip(motion.arms()) {
                let share = other.second_rate.scale(g, second);
                bracket = bracket.add(g, share);
            }
            if let Some(passed) = from.brackets.get(k) {
                bracket = bracket.add(g, *passed);
            }
            load.on_arms.push(bracket);
            let share = arm.second_rate.scale(g, self.first[k]);
            load.force = load.force.add(g, share);
            let moment = arm.vector.cross(g, bracket);
            load.moment = load.moment.add(g, moment);
        }
        let momenta = self.momenta(g, motion);
        let sections = motion.sections.iter().zip(&self.turning);
        for ((section, inertia), momentum) in sections.zip(momenta) {
            let gyroscopic = section.spin.cross(g, momentum);
            let moment = inertia.apply(g, section.growth).add(g, gyroscopic);
            load.of_sections.push(moment);
            let moment = section.frame.orientation.axes.apply(g, moment);
            load.moment = load.moment.add(g, moment);
        }
        load
    }
}

impl FromStations {
    /// Nothing, for each beam.
    pub(crate) fn nothing(g: &mut Graph, context: &Context) -> Vec<Self> {
        let zero = Vector3::zero(g);
        let beams = context.mechanism.beams.iter();
        beams
            .map(|beam| Self { brackets: vec![zero; beam.sections.len()], moments: vec![zero; beam.stations.len()] })
            .collect()
    }

    /// Adds the load on a station, about its origin.
    pub(crate) fn add(&mut self, g: &mut Graph, motion: &BeamMotion, station: usize, [force, moment]: [Vector3; 2]) {
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
        let moment = directions.fold(zero, |sum, (direction, bracket)| {
            let moment = direction.vector.cross(g, *bracket);
            sum.add(g, moment)
        });
        BeamLoad {
            force: zero,
            moment,
            of_stations: self.moments.clone(),
            of_sections: Vec::new(),
            on_arms: self.brackets.clone(),
        }
    }
}

impl BeamLoad {
    /// Power while the rows of the sections move at some rates. Contracting first makes derivatives of it shorter than
    /// those of the forces.
    pub(crate) fn power(
        &self,
        g: &mut Graph,
        sections: &Sections,
        (id, motion): (BeamId, &BeamMotion),
        rates: &[ExprId],
    ) -> ExprId {
        let direction = Direction::new("_virtual", sections.position.with(rates).collect());
        let rows = sections.of(id);
        let zero = g.zero();
        let rate_of = |row: &Option<usize>| row.map_or(zero, |row| rates[row]);
        let mut terms = Vec::new();
        for ((_, arm), force) in motion.arms().zip(&self.on_arms) {
            terms.push(arm.power(g, *force, &direction));
        }
        let turns = motion.sections.iter().zip(&rows.rotations);
        for ((section, rows), moment) in turns.zip(&self.of_sections) {
            let spin = section.turning(g, Vector3(rows.each_ref().map(rate_of)));
            terms.push(moment.dot(g, spin));
        }
        let stations = motion.stations.iter().zip(&rows.stations);
        for ((station, rows), moment) in stations.zip(&self.of_stations) {
            let powers = station.section.project(g, *moment);
            terms.push(weighted_sum(g, &rows.each_ref().map(rate_of), &powers));
        }
        g.sum(terms)
    }

    /// Adds the forces along the rows of the sections.
    pub(crate) fn add_along(
        &self,
        g: &mut Graph,
        sections: &Sections,
        id: BeamId,
        motion: &BeamMotion,
        along: &mut [ExprId],
    ) {
        let rows = sections.of(id);
        let mut add = |g: &mut Graph, rows: &[Option<usize>], powers: &[ExprId]| {
            for (row, power) in rows.iter().zip(powers) {
                if let Some(row) = *row {
                    along[row] = g.add(along[row], *power);
                }
            }
        };
        for ((k, arm), force) in motion.arms().zip(&self.on_arms) {
            let (powers, strains) = arm.project(g, *force);
            add(g, &rows.rotations[k], &powers);
            for (row, power) in strains {
                add(g, &[Some(row)], &[power]);
            }
        }
        let turns = motion.sections.iter().zip(&rows.rotations);
        for ((section, rows), moment) in turns.zip(&self.of_sections) {
            let powers = section.project_own(g, *moment);
            add(g, rows, &powers);
        }
        let stations = motion.stations.iter().zip(&rows.stations);
        for ((station, rows), moment) in stations.zip(&self.of_stations) {
            let powers = station.section.project(g, *moment);
            add(g, rows, &powers);
        }
    }
}
