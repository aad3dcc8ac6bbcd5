//! The equations of motion (eqs. 4-12).

use num_dual::Dual;

use super::bodies::{inertia, value};
use super::forces::Moving;
use super::kinematics::{Columns, Configuration, VelocityTransformation, of_body, rows_of, times, transposed_times};
use super::scalar::{along, rates, still};
use super::space::{Matrix, Vector};
use super::{Oracle, Scalar};
use crate::model::{Coordinate, ForceLaw};

/// A state of motion: free accelerations, speeds and positions, inputs, design variables.
#[derive(Clone, Debug)]
pub struct State<D> {
    /// `qddot_R`.
    pub acceleration: Vec<D>,
    /// `qdot_R`.
    pub velocity: Vec<D>,
    /// `q_R`.
    pub position: Vec<D>,
    /// Inputs.
    pub inputs: Vec<D>,
    /// Design variables.
    pub design: Vec<D>,
}

impl<D: Scalar> State<D> {
    /// At rest relative to the drives: `(0, 0, q; u, b)`.
    pub fn at_rest(q: &[D], u: &[D], b: &[D]) -> Self {
        let zero = vec![D::zero(); q.len()];
        Self {
            acceleration: zero.clone(),
            velocity: zero,
            position: q.to_vec(),
            inputs: u.to_vec(),
            design: b.to_vec(),
        }
    }

    /// The same state in numbers that carry one more derivative.
    pub fn lifted(&self) -> State<Dual<D>> {
        State {
            acceleration: still(&self.acceleration),
            velocity: still(&self.velocity),
            position: still(&self.position),
            inputs: still(&self.inputs),
            design: still(&self.design),
        }
    }
}

/// The parts of the equations of motion, projected on the free coordinates.
#[derive(Clone, Debug)]
pub struct Motion<D> {
    /// `M* = B_R^T M B_R` (eq. 8), by rows.
    pub mass: Vec<Vec<D>>,
    /// `B_R^T (M (Bdot_D u + Bdot_R qdot_R) + omega x J omega)`.
    pub inertia: Vec<D>,
    /// `B_R^T Q` plus the forces along the coordinates themselves.
    pub applied: Vec<D>,
}

impl<D: Scalar> Motion<D> {
    /// `Q*` (eq. 9).
    pub fn right_hand_side(&self) -> Vec<D> {
        self.applied.iter().zip(&self.inertia).map(|(&applied, &inertia)| applied - inertia).collect()
    }
}

/// All quantities of eqs. 4-9 before the projection, as rows of `B`.
struct Bodies<D> {
    /// `B_R`.
    b_free: Columns<D>,
    masses: Vec<D>,
    /// `R J R^T`, about the centres of mass, in the ground frame.
    tensors: Vec<Matrix<D>>,
    /// `Bdot_D u + Bdot_R qdot_R`.
    bias: Vec<D>,
    /// `omega x J omega`.
    gyroscopic: Vec<D>,
    /// `Q`.
    applied: Vec<D>,
    /// Forces along free coordinates, added to `B_R^T Q`.
    generalized: Vec<D>,
}

impl<D: Scalar> Bodies<D> {
    /// `M x`, `M = blockdiag(m I, R J R^T)`.
    fn times_mass(&self, x: &[D]) -> Vec<D> {
        let block = |body: usize| {
            let (linear, angular) = of_body(x, body);
            rows_of(linear.scaled(self.masses[body]), self.tensors[body] * angular)
        };
        (0..self.masses.len()).flat_map(block).collect()
    }
}

impl Oracle<'_> {
    /// Speeds of the driven coordinates.
    pub(crate) fn drives<D: Scalar>(&self, inputs: &[D]) -> Vec<D> {
        let speed = |&coordinate: &Coordinate| {
            let drive = self.model.step(coordinate).drive.expect("it is driven");
            inputs[drive.input] * drive.factor
        };
        self.driven.iter().map(speed).collect()
    }

    /// Eqs. 8 and 9.
    pub fn motion<D: Scalar>(&self, state: &State<D>) -> Motion<D> {
        let bodies = self.bodies(state);
        // M* = B_R^T (M B_R), one column at a time; it is symmetric
        let columns = bodies.b_free.iter().map(|column| bodies.times_mass(column));
        let mut mass: Vec<Vec<D>> = columns.map(|column| transposed_times(&bodies.b_free, &column)).collect();
        for (k, inertance) in self.inertances(&state.design).into_iter().enumerate() {
            mass[k][k] += inertance;
        }
        let inertial = sum(&bodies.times_mass(&bodies.bias), &bodies.gyroscopic);
        Motion {
            mass,
            inertia: transposed_times(&bodies.b_free, &inertial),
            applied: sum(&transposed_times(&bodies.b_free, &bodies.applied), &bodies.generalized),
        }
    }

    /// `g = M* qddot - Q*` (eq. 12) as `B_R^T (M (B_R qddot + Bdot_D u + Bdot_R qdot_R) + omega x J omega - Q)`; at
    /// rest it is eq. 10.
    pub fn motion_residual<D: Scalar>(&self, state: &State<D>) -> Vec<D> {
        let bodies = self.bodies(state);
        let free = times(&bodies.b_free, &state.acceleration, bodies.bias.len());
        let inertial = sum(&bodies.times_mass(&sum(&free, &bodies.bias)), &bodies.gyroscopic);
        let unbalanced: Vec<D> =
            inertial.iter().zip(&bodies.applied).map(|(&inertial, &applied)| inertial - applied).collect();
        let projected = transposed_times(&bodies.b_free, &unbalanced);
        let inertances = self.inertances(&state.design);
        let coupled =
            inertances.iter().zip(&state.acceleration).map(|(&inertance, &acceleration)| inertance * acceleration);
        let both = projected.iter().zip(&bodies.generalized).zip(coupled);
        both.map(|((&unbalanced, &force), coupled)| unbalanced - force + coupled).collect()
    }

    /// The sum of the inertances on each free coordinate.
    fn inertances<D: Scalar>(&self, design: &[D]) -> Vec<D> {
        let mut sums = vec![D::zero(); self.free.len()];
        for force in &self.model.forces {
            if let ForceLaw::Inerter { coordinate, inertance } = force.law
                && let Some(k) = self.free.iter().position(|&other| other == coordinate)
            {
                sums[k] += value(inertance, design);
            }
        }
        sums
    }

    /// `Bdot_D u + Bdot_R qdot_R`: accelerations where the coordinates themselves have none.
    pub(crate) fn rest_acceleration<D: Scalar>(&self, state: &State<D>) -> Vec<D> {
        self.bodies(state).bias
    }

    fn bodies<D: Scalar>(&self, state: &State<D>) -> Bodies<D> {
        let rows = 6 * self.model.bodies.len();
        let design = &state.design;
        let driven: Vec<D> = self.driven_position.iter().map(|&x| D::from(x)).collect();
        let drives = self.drives(&state.inputs);

        let at = self.configuration(&state.position, &driven, design);
        let b = self.velocity_transformation(&at);
        // xdot = B_D u + B_R qdot_R (4)
        let velocities = sum(&times(&b.driven, &drives, rows), &times(&b.free, &state.velocity, rows));
        // The same configuration advanced in time by epsilon.
        let moving =
            self.configuration(&along(&state.position, &state.velocity), &along(&driven, &drives), &still(design));
        let b_dot = self.velocity_transformation_rate(&moving);
        let bias = sum(&times(&b_dot.driven, &drives, rows), &times(&b_dot.free, &state.velocity, rows));

        let inertias: Vec<_> = self.model.bodies.iter().map(|body| inertia(&body.parts, design)).collect();
        let masses: Vec<D> = inertias.iter().map(|inertia| inertia.mass).collect();
        let tensors: Vec<Matrix<D>> = inertias
            .iter()
            .zip(&at.bodies)
            .map(|(inertia, pose)| pose.rotation * inertia.tensor * pose.rotation.transpose())
            .collect();
        let gyroscopic = (0..masses.len()).flat_map(|body| {
            let (_, spin) = of_body(&velocities, body);
            rows_of(Vector::zero(), spin.cross(tensors[body] * spin))
        });
        let gyroscopic = gyroscopic.collect();

        let moving = Moving { at: &at, moving: &moving, driven: (&driven, &drives), state };
        let (applied, generalized) = self.applied_forces(&moving, &masses);
        Bodies { b_free: b.free, masses, tensors, bias, gyroscopic, applied, generalized }
    }

    /// `Bdot_D` and `Bdot_R`: `B` differentiated along the speeds of all coordinates.
    fn velocity_transformation_rate<D: Scalar>(&self, moving: &Configuration<Dual<D>>) -> VelocityTransformation<D> {
        let b = self.velocity_transformation(moving);
        let rate = |columns: Vec<Vec<Dual<D>>>| columns.iter().map(|c| rates(c)).collect();
        VelocityTransformation { driven: rate(b.driven), free: rate(b.free) }
    }
}

fn sum<D: Scalar>(a: &[D], b: &[D]) -> Vec<D> {
    a.iter().zip(b).map(|(&a, &b)| a + b).collect()
}
