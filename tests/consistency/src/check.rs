//! Derives every kernel a second time from `motion_residual` and compares the two.
//!
//! First-order matrices are compared entry by entry. Kernels that return many derivatives are compared along one random
//! direction, which exposes a wrong entry with probability one.

use eigentol::{Dual, Real};
use eigentol_compiler::mechanics::Role;
use eigentol_compiler::program::{Kernel, Program};

use crate::bounded::Bounded;
use crate::interpreter::interpret;
use crate::state::State;
use crate::subject::Subject;

/// Values below this are not compared: products of nearly zero constants may have been folded to zero.
const FLOOR: f64 = 1e-15;

type First = Dual<Bounded>;
type Second = Dual<First>;

/// Two values that should be equal.
#[derive(Clone, Debug)]
pub struct Difference {
    /// The kernel, and which of its results differs.
    pub place: String,
    /// What the kernel returns.
    pub found: f64,
    /// The value derived from the equations of motion.
    pub expected: f64,
    /// The difference that rounding alone may cause.
    pub allowed: f64,
}

/// The outcome of comparing all kernels.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// Values that disagree.
    pub differences: Vec<Difference>,
    /// Number of values compared.
    pub compared: usize,
    /// How many of these have a rounding bound above a millionth of the largest value of their kind, so that agreement
    /// says little.
    pub blurred: usize,
    /// The largest difference relative to the largest value of its kind.
    pub worst: f64,
}

/// Compares every kernel at a state, and each constraint's reactions with its constraint equation.
///
/// # Panics
/// When a kernel of the runtime's contract is missing.
pub fn check(subject: &Subject, state: &State) -> Outcome {
    let mut this = Check { program: &subject.program, state, outcome: Outcome::default() };
    this.reactions(&subject.roles);
    this.residuals();
    this.linear();
    this.motion();
    this.residual_partials();
    this.linear_partials();
    this.gradients();
    this.output_partials();
    this.forced();
    this.outcome
}

struct Check<'a> {
    program: &'a Program,
    state: &'a State,
    outcome: Outcome,
}

/// The three arguments of `g` with respect to which it is differentiated.
#[derive(Clone, Copy, PartialEq)]
enum By {
    Acceleration,
    Velocity,
    Position,
}

const MATRICES: [(By, &str); 3] = [(By::Acceleration, "mass"), (By::Velocity, "damping"), (By::Position, "stiffness")];

fn exact(values: &[f64]) -> Vec<Bounded> {
    values.iter().copied().map(Bounded::exact).collect()
}

fn fixed<T: Real + Copy>(values: &[T]) -> Vec<Dual<T>> {
    values.iter().copied().map(Dual::fixed).collect()
}

fn moving<T: Real + Copy>(values: &[T], along: &[T]) -> Vec<Dual<T>> {
    let pairs = values.iter().zip(along);
    pairs.map(|(&value, &slope)| Dual { value, slope }).collect()
}

fn slopes<T: Copy>(values: &[Dual<T>]) -> Vec<T> {
    values.iter().map(|value| value.slope).collect()
}

fn dot(a: &[Bounded], b: &[Bounded]) -> Bounded {
    let zero = Bounded::exact(0.0);
    a.iter().zip(b).fold(zero, |sum, (&x, &y)| sum + x * y)
}

impl Check<'_> {
    fn n(&self) -> usize {
        self.state.at[0].len()
    }

    fn kernel(&self, name: &str) -> Option<&Kernel> {
        self.program.kernel(name)
    }

    /// The results of a kernel at the state; the kernel's own arguments come before and after those of the state.
    fn evaluate(&self, name: &str, before: &[&[f64]], after: &[&[f64]]) -> Vec<Vec<Bounded>> {
        let at = self.state.at.each_ref().map(Vec::as_slice);
        let all = [before, &at, after].concat();
        let all: Vec<Vec<Bounded>> = all.into_iter().map(exact).collect();
        let all: Vec<&[Bounded]> = all.iter().map(Vec::as_slice).collect();
        let kernel = self.kernel(name);
        interpret(kernel.unwrap_or_else(|| panic!("no kernel `{name}`")), &all)
    }

    fn motion_residual<T: Real + Copy>(&self, arguments: &[Vec<T>; 5]) -> Vec<T> {
        let kernel = self.kernel("motion_residual").expect("equations of motion");
        let arguments: Vec<&[T]> = arguments.iter().map(Vec::as_slice).collect();
        interpret(kernel, &arguments).swap_remove(0)
    }

    /// Acceleration, velocity, and the unknowns, inputs and design variables of the state.
    fn arguments(&self, at_rest: bool) -> [Vec<Bounded>; 5] {
        let [q, u, b] = self.state.at.each_ref().map(|list| exact(list));
        let still = vec![Bounded::exact(0.0); q.len()];
        let [acceleration, velocity] = match at_rest {
            true => [still.clone(), still],
            false => [exact(&self.state.acceleration), exact(&self.state.velocity)],
        };
        [acceleration, velocity, q, u, b]
    }

    /// The derivative of `g` along a direction in some of its arguments.
    fn along(&self, at_rest: bool, directions: &[(usize, &[Bounded])]) -> Vec<Bounded> {
        let arguments = self.arguments(at_rest);
        let mut moved: [Vec<First>; 5] = arguments.each_ref().map(|list| fixed(list));
        for (place, direction) in directions {
            moved[*place] = moving(&arguments[*place], direction);
        }
        slopes(&self.motion_residual(&moved))
    }

    /// A matrix of first derivatives of `g`, by rows.
    fn matrix(&self, by: By, at_rest: bool) -> Vec<Bounded> {
        let n = self.n();
        let mut matrix = vec![Bounded::exact(0.0); n * n];
        for column in 0..n {
            let mut unit = vec![Bounded::exact(0.0); n];
            unit[column] = Bounded::exact(1.0);
            let entries = self.along(at_rest, &[(by as usize, &unit)]);
            for (row, entry) in entries.into_iter().enumerate() {
                matrix[row * n + column] = entry;
            }
        }
        matrix
    }

    /// The directional derivative, along the state's direction, of the sum of the matrices at rest, each times a
    /// vector.
    fn second(&self, vectors: &[(By, &[f64])]) -> Vec<Bounded> {
        let along = self.state.along.each_ref().map(|list| exact(list));
        let still = exact(&vec![0.0; self.n()]);
        let arguments = self.arguments(true);
        let inner: [Vec<First>; 5] = [
            fixed(&arguments[0]),
            fixed(&arguments[1]),
            moving(&arguments[2], &along[0]),
            moving(&arguments[3], &along[1]),
            moving(&arguments[4], &along[2]),
        ];
        let mut outer: [Vec<Second>; 5] = inner.each_ref().map(|list| fixed(list));
        for &(by, vector) in vectors {
            let vector = moving(&exact(vector), &still);
            outer[by as usize] = moving(&inner[by as usize], &vector);
        }
        slopes(&slopes(&self.motion_residual(&outer)))
    }

    fn compare(&mut self, text: &str, bounds: &[Bounded], expected: &[Bounded]) {
        assert_eq!(bounds.len(), expected.len(), "{text}");
        let size = expected.iter().map(|x| x.value.abs()).fold(0.0, f64::max);
        for (k, (one, other)) in bounds.iter().zip(expected).enumerate() {
            let difference = (one.value - other.value).abs();
            let allowed = FLOOR + 2.0 * (one.error + other.error);
            self.outcome.compared += 1;
            self.outcome.blurred += usize::from(allowed > 1e-6 * size);
            if size > 0.0 {
                self.outcome.worst = self.outcome.worst.max(difference / size);
            }
            // NaN is not agreement
            let agrees = difference <= allowed;
            if !agrees {
                self.outcome.differences.push(Difference {
                    place: format!("{text}[{k}]"),
                    found: one.value,
                    expected: other.value,
                    allowed,
                });
            }
        }
    }

    fn residuals(&mut self) {
        let rest = self.motion_residual(&self.arguments(true));
        let found = self.evaluate("residual", &[], &[]);
        self.compare("residual", &found[0], &rest);
        let parts = self.evaluate("residual_parts", &[], &[]);
        let sum: Vec<Bounded> = parts[0].iter().zip(&parts[1]).map(|(&a, &b)| a - b).collect();
        self.compare("residual_parts", &sum, &rest);
        let found = self.evaluate("residual_and_stiffness", &[], &[]);
        self.compare("residual_and_stiffness.residual", &found[0], &rest);
        let stiffness = self.matrix(By::Position, true);
        self.compare("residual_and_stiffness.stiffness", &found[1], &stiffness);
    }

    fn linear(&mut self) {
        let found = self.evaluate("linear", &[], &[]);
        for ((by, name), found) in MATRICES.iter().zip(&found) {
            let expected = self.matrix(*by, true);
            self.compare(&format!("linear.{name}"), found, &expected);
        }
        let state = self.state;
        if self.kernel("motion_linear").is_none() {
            return;
        }
        let found = self.evaluate("motion_linear", &[&state.acceleration, &state.velocity], &[]);
        for ((by, name), found) in MATRICES.iter().zip(&found) {
            let expected = self.matrix(*by, false);
            self.compare(&format!("motion_linear.{name}"), found, &expected);
        }
    }

    fn motion(&mut self) {
        let found = self.evaluate("motion", &[&self.state.velocity], &[]);
        let mass = self.matrix(By::Acceleration, false);
        self.compare("motion.mass", &found[0], &mass);
        let mut arguments = self.arguments(false);
        arguments[0] = exact(&vec![0.0; self.n()]);
        let force: Vec<Bounded> = self.motion_residual(&arguments).iter().map(|&h| -h).collect();
        self.compare("motion.force", &found[1], &force);
    }

    /// The reaction along a coordinate equals the change of the constraint equation per unit of that coordinate or of
    /// its speed. With coasting coordinates the speeds are unknowns themselves, and these columns belong to them.
    fn reactions(&mut self, roles: &[Role]) {
        let n = self.n();
        let [damping, stiffness] = [By::Velocity, By::Position].map(|by| self.matrix(by, true));
        for (row, role) in roles.iter().enumerate() {
            let by_speed = match role {
                Role::PositionReaction => false,
                Role::VelocityReaction => true,
                _ => continue,
            };
            let (mut exerted, mut demanded) = (Vec::new(), Vec::new());
            for (k, other) in roles.iter().enumerate() {
                let own = match other {
                    Role::Position(_) if by_speed => &damping,
                    Role::Position(_) | Role::Harmonic(_) | Role::Speed(_) => &stiffness,
                    _ => continue,
                };
                exerted.push(stiffness[k * n + row]);
                demanded.push(own[row * n + k]);
            }
            self.compare("reaction", &exerted, &demanded);
        }
    }

    fn residual_partials(&mut self) {
        let along = self.state.along.each_ref().map(|list| exact(list));
        let found = self.evaluate("residual_partials", &[], &[]);
        for (place, name) in [(1, "by_input"), (2, "by_design")] {
            let contracted = contracted(&found[place - 1], &along[place]);
            if contracted.is_empty() {
                continue;
            }
            let expected = self.along(true, &[(place + 2, &along[place])]);
            self.compare(&format!("residual_partials.{name}"), &contracted, &expected);
        }
        let weights = exact(&self.state.shape);
        let found = self.gradient_along("residual_gradient", &[&self.state.shape]);
        let directions: Vec<(usize, &[Bounded])> = (0..3).map(|k| (k + 2, &along[k][..])).collect();
        let expected = dot(&weights, &self.along(true, &directions));
        self.compare("residual_gradient", &[found], &[expected]);
    }

    /// A gradient by coordinates, inputs and design, contracted with the direction of the state.
    fn gradient_along(&self, kernel: &str, values: &[&[f64]]) -> Bounded {
        let gradient = self.evaluate(kernel, &[], values);
        let along = self.state.along.each_ref().map(|list| exact(list));
        let parts = gradient.iter().zip(&along).map(|(part, along)| dot(part, along));
        parts.fold(Bounded::exact(0.0), |sum, part| sum + part)
    }

    fn linear_partials(&mut self) {
        if self.kernel("linear_partials").is_none() {
            return;
        }
        let n = self.n();
        let shape = exact(&self.state.shape);
        let found = self.evaluate("linear_partials", &[], &[]);
        for (k, (by, name)) in MATRICES.iter().enumerate() {
            let mut changed = vec![Bounded::exact(0.0); n];
            for (list, along) in self.state.along.iter().enumerate() {
                let all = &found[3 * list + k];
                for (matrix, &slope) in all.chunks_exact((n * n).max(1)).zip(along) {
                    for (row, sum) in changed.iter_mut().enumerate() {
                        let entry = dot(&matrix[row * n..(row + 1) * n], &shape);
                        *sum = *sum + Bounded::exact(slope) * entry;
                    }
                }
            }
            let expected = self.second(&[(*by, &self.state.shape)]);
            self.compare(&format!("linear_partials.{name}"), &changed, &expected);
        }
    }

    fn gradients(&mut self) {
        let state = self.state;
        let shape = exact(&state.shape);
        let lambda = Bounded::exact(state.lambda);
        let stiffness = dot(&shape, &self.second(&[(By::Position, &state.shape)]));
        let mass = dot(&shape, &self.second(&[(By::Acceleration, &state.shape)]));
        let found = self.gradient_along("mode_gradient", &[&state.shape, &[state.lambda]]);
        self.compare("mode_gradient", &[found], &[stiffness - lambda * mass]);

        let [left, acceleration, velocity, position] = &state.pencil;
        let changed =
            self.second(&[(By::Acceleration, acceleration), (By::Velocity, velocity), (By::Position, position)]);
        let expected = dot(&exact(left), &changed);
        let own = [left, acceleration, velocity, position].map(Vec::as_slice);
        let found = self.gradient_along("pencil_gradient", &own);
        self.compare("pencil_gradient", &[found], &[expected]);
    }

    fn output_partials(&mut self) {
        let kernel = self.kernel("outputs").expect("outputs");
        let arguments = self.state.at.each_ref().map(|list| exact(list));
        let along = self.state.along.each_ref().map(|list| exact(list));
        let moved: Vec<Vec<First>> = (0..3).map(|k| moving(&arguments[k], &along[k])).collect();
        let moved: Vec<&[First]> = moved.iter().map(Vec::as_slice).collect();
        let expected = slopes(&interpret(kernel, &moved)[0]);
        if expected.is_empty() {
            return;
        }
        let found = self.evaluate("output_partials", &[], &[]);
        let mut changed = vec![Bounded::exact(0.0); expected.len()];
        for (part, along) in found.iter().zip(&along) {
            for (sum, entry) in changed.iter_mut().zip(contracted(part, along)) {
                *sum = *sum + entry;
            }
        }
        self.compare("output_partials", &changed, &expected);
    }
}

impl Check<'_> {
    /// Excitations: the gradient of the functional of `forcing` and `output_motion`, and the outputs by position.
    fn forced(&mut self) {
        let (Some(forcing), Some(motion)) = (self.kernel("forcing"), self.kernel("output_motion")) else {
            return;
        };
        let along = self.state.along.each_ref().map(|list| exact(list));
        let at = self.state.at.each_ref().map(|list| exact(list));
        let moved: Vec<Vec<First>> = (0..3).map(|k| moving(&at[k], &along[k])).collect();
        let moved: Vec<&[First]> = moved.iter().map(Vec::as_slice).collect();
        let forcing = interpret(forcing, &moved);
        let motion = interpret(motion, &moved);

        let position: Vec<Bounded> = motion[2].iter().map(|entry| entry.value).collect();
        if !position.is_empty() {
            let expected = self.evaluate("output_partials", &[], &[]).swap_remove(0);
            self.compare("output_motion.by_position", &position, &expected);
        }

        let (n, excitations) = (self.n(), forcing[1].len());
        let outputs = forcing[2].len() / excitations;
        let state = self.state;
        let weights =
            |count: usize, from: f64| -> Vec<f64> { (0..count).map(|k| (from + 1.7 * k as f64).sin()).collect() };
        let on_outputs = weights(outputs, 0.3);
        let (share, frequency) = (weights(excitations, 1.1), weights(excitations, 2.3));
        let [direct_cosine, direct_sine] = [0.7, 1.9].map(|from| weights(outputs, from));
        let [cosine, acceleration, velocity, position] = &state.pencil;
        let sine = &state.shape;

        let rows = |matrix: &[First], width: usize, by: &[f64]| -> Vec<Bounded> {
            let rows = matrix.chunks_exact(width.max(1));
            rows.map(|row| dot(&slopes(row), &exact(by))).collect()
        };
        let mut expected = dot(&slopes(&forcing[1]), &exact(&frequency));
        for (matrix, by) in motion.iter().zip([acceleration, velocity, position]) {
            expected = expected + dot(&rows(matrix, n, by), &exact(&on_outputs));
        }
        let forces = [(0, cosine), (2, &direct_cosine), (3, sine), (4, &direct_sine)];
        for (place, by) in forces {
            // without outputs there are no rows
            let rows = rows(&forcing[place], by.len(), by);
            let share = &exact(&share)[..rows.len()];
            expected = expected + dot(&rows, share);
        }
        let own = [
            &on_outputs,
            acceleration,
            velocity,
            position,
            &share,
            cosine,
            sine,
            &direct_cosine,
            &direct_sine,
            &frequency,
        ]
        .map(Vec::as_slice);
        let found = self.gradient_along("forced_gradient", &own);
        self.compare("forced_gradient", &[found], &[expected]);
    }
}

/// A matrix, by rows, times a vector; empty if there are no columns.
fn contracted(matrix: &[Bounded], vector: &[Bounded]) -> Vec<Bounded> {
    let rows = matrix.chunks_exact(vector.len().max(1));
    rows.map(|row| dot(row, vector)).collect()
}
