//! Checks the oracle against the reference values in `truth/`.

use eigentol_oracle::examples::{arm, chain, two_sliders};
use eigentol_oracle::kernels::{At, Kernels};
use eigentol_oracle::model::Model;
use eigentol_oracle::truth::Truth;
use eigentol_oracle::{Linear, Oracle};
use nalgebra::{DMatrix, DVector};

fn assert_close(values: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(values.len(), expected.len(), "{what}");
    let scale = expected.iter().fold(1.0, |most: f64, value| most.max(value.abs()));
    for (one, other) in values.iter().zip(expected) {
        assert!((one - other).abs() <= tolerance * scale, "{what}: {values:?}, not {expected:?}");
    }
}

/// The variable of differentiation: an input or a design variable.
#[derive(Clone, Copy)]
enum By {
    Input(usize),
    Design(usize),
}

/// Total first derivatives at an equilibrium, including its own shift.
struct Total<'a> {
    oracle: &'a Oracle<'a>,
    at: At<'a>,
    stiffness: DMatrix<f64>,
}

impl<'a> Total<'a> {
    fn new(oracle: &'a Oracle<'a>, at: At<'a>) -> Self {
        let n = at[0].len();
        let stiffness = Kernels::linear(oracle, at).stiffness;
        Self { oracle, at, stiffness: DMatrix::from_row_slice(n, n, &stiffness) }
    }

    /// `Khat dq*/db = -dg/db`.
    fn equilibrium(&self, by: By) -> Vec<f64> {
        let [_, u, b] = self.at;
        let [by_input, by_design] = Kernels::residual_partials(self.oracle, self.at);
        let column = |matrix: &[f64], width: usize, k: usize| {
            DVector::from_iterator(self.at[0].len(), matrix.iter().skip(k).step_by(width).copied())
        };
        let partial = match by {
            By::Input(k) => column(&by_input, u.len(), k),
            By::Design(k) => column(&by_design, b.len(), k),
        };
        let solution = self.stiffness.clone().lu().solve(&-partial);
        solution.expect("regular").as_slice().to_vec()
    }

    /// `dM/db`, `dC/db`, `dK/db`: the explicit part plus the part through the equilibrium.
    fn linear(&self, by: By) -> Linear<f64> {
        let partials = Kernels::linear_partials(self.oracle, self.at);
        let explicit = match by {
            By::Input(k) => &partials.by_input[k],
            By::Design(k) => &partials.by_design[k],
        };
        let mut total = explicit.clone();
        for (partial, dq) in partials.by_coordinate.iter().zip(self.equilibrium(by)) {
            for (sum, part) in [
                (&mut total.mass, &partial.mass),
                (&mut total.damping, &partial.damping),
                (&mut total.stiffness, &partial.stiffness),
            ] {
                for (sum, part) in sum.iter_mut().zip(part) {
                    *sum += part * dq;
                }
            }
        }
        total
    }

    /// `domega/db` of an undamped mode by the adjoint method: `dlambda/db = da/db - (dg/db)^T w`, `Khat^T w = da/dq`.
    fn frequency(&self, (lambda, phi): &(f64, Vec<f64>)) -> [Vec<f64>; 2] {
        let [by_q, by_input, by_design] = self.oracle.mode_gradient(self.at, phi, *lambda);
        let w = self.stiffness.transpose().lu().solve(&DVector::from_vec(by_q)).expect("regular");
        let [_, g_input, g_design] = self.oracle.residual_gradient(self.at, w.as_slice());
        let omega = lambda.sqrt();
        let rate =
            |a: Vec<f64>, g: Vec<f64>| -> Vec<f64> { a.iter().zip(g).map(|(a, g)| (a - g) / (2.0 * omega)).collect() };
        [rate(by_input, g_input), rate(by_design, g_design)]
    }
}

/// `K phi = lambda M phi`, `phi^T M phi = 1`, ascending.
fn modes(linear: &Linear<f64>) -> Vec<(f64, Vec<f64>)> {
    let n = linear.mass.len().isqrt();
    let mass = DMatrix::from_row_slice(n, n, &linear.mass);
    let factor = mass.cholesky().expect("positive definite").l();
    let inverse = factor.try_inverse().expect("regular");
    let stiffness = DMatrix::from_row_slice(n, n, &linear.stiffness);
    let eigen = (&inverse * stiffness * inverse.transpose()).symmetric_eigen();
    let mode = |i: usize| {
        let phi = inverse.transpose() * eigen.eigenvectors.column(i);
        (eigen.eigenvalues[i], phi.as_slice().to_vec())
    };
    let mut modes: Vec<_> = (0..n).map(mode).collect();
    modes.sort_by(|one, other| one.0.total_cmp(&other.0));
    modes
}

/// Checks every condition of `P1`, `P2` or `P3`; `names` lists the design variables in order.
fn paper(case: &str, model: impl Fn(&Truth) -> Model, names: &[&str]) {
    for condition in Truth::load(case).get("conditions").list() {
        let what = format!("{case} {}", condition.get("label").text());
        let model = model(&condition.get("parameters"));
        let q_star = condition.get("q_star");
        let q: Vec<f64> = q_star.fields().iter().map(|name| q_star.get(name).number()).collect();
        let u = [condition.get("parameters").get("Omega").number()];
        let b = model.nominal();
        let at: At = [&q, &u, &b];
        let oracle = Oracle::new(&model);

        assert_close(&Kernels::residual(&oracle, at), &vec![0.0; q.len()], 1e-13, &what);
        let linear = Kernels::linear(&oracle, at);
        assert_close(&linear.mass, &condition.get("M").matrix(), 1e-14, &what);
        assert_close(&linear.damping, &condition.get("C").matrix(), 1e-14, &what);
        assert_close(&linear.stiffness, &condition.get("K").matrix(), 1e-14, &what);

        let total = Total::new(&oracle, at);
        let by = |name: &str| {
            let design = names.iter().position(|other| *other == name);
            design.map_or(By::Input(0), By::Design)
        };
        let variables = condition.get("dq_star_db").fields();
        for name in &variables {
            let expected = |field: &str| condition.get(field).get(name);
            let shift = expected("dq_star_db").numbers();
            assert_close(&total.equilibrium(by(name)), &shift, 1e-12, &what);
            let linear = total.linear(by(name));
            assert_close(&linear.mass, &expected("dM_db_total").matrix(), 1e-12, &what);
            assert_close(&linear.damping, &expected("dC_db_total").matrix(), 1e-12, &what);
            assert_close(&linear.stiffness, &expected("dK_db_total").matrix(), 1e-12, &what);
        }
        for (mode, expected) in modes(&linear).iter().zip(condition.get("undamped_modes").list()) {
            let lambda = expected.get("lambda").number();
            assert_close(&[mode.0], &[lambda], 1e-12, &what);
            let [by_input, by_design] = total.frequency(mode);
            for name in &variables {
                let found = match by(name) {
                    By::Input(k) => by_input[k],
                    By::Design(k) => by_design[k],
                };
                let expected = expected.get("domega_db").get(name).number();
                assert_close(&[found], &[expected], 1e-11, &format!("{what} by {name}"));
            }
        }
    }
}

#[test]
fn rotating_pendulum() {
    let model = |p: &Truth| chain(&[p.get("L").number()], &[p.get("m").number()]);
    paper("P1", model, &["L", "m"]);
}

#[test]
fn rotating_double_pendulum() {
    let model = |p: &Truth| {
        let get = |name: &str| p.get(name).number();
        chain(&[get("L1"), get("L2")], &[get("m1"), get("m2")])
    };
    paper("P2", model, &["L1", "L2", "m1", "m2"]);
}

#[test]
fn sliders_on_a_spinning_plate() {
    let names = ["m", "kx", "ky", "x0", "y0", "cx", "cy"];
    paper("P3", |p| two_sliders(names.map(|name| p.get(name).number())), &names);
}

/// Relative angles from absolute ones: `q = D theta`.
fn relative(theta: &[f64]) -> Vec<f64> {
    let before = |j: usize| if j == 0 { 0.0 } else { theta[j - 1] };
    (0..theta.len()).map(|j| theta[j] - before(j)).collect()
}

/// `D^T A D`: converts a matrix from relative to absolute angles.
fn absolute(matrix: &[f64]) -> Vec<f64> {
    let n = matrix.len().isqrt();
    let d = DMatrix::from_fn(n, n, |i, j| f64::from(i == j) - f64::from(i == j + 1));
    let product = d.transpose() * DMatrix::from_row_slice(n, n, matrix) * d;
    product.transpose().as_slice().to_vec()
}

/// `D^T a`.
fn absolute_vector(vector: &[f64]) -> Vec<f64> {
    let after = |j: usize| vector.get(j + 1).copied().unwrap_or(0.0);
    (0..vector.len()).map(|j| vector[j] - after(j)).collect()
}

#[test]
fn chains_at_equilibrium() {
    let truth = Truth::load("w1_w2_w3");
    for name in ["W1", "W2", "W2_varied", "W3_n4", "W3_n4_varied", "W3_n8", "W3_n8_varied"] {
        let case = truth.get(name);
        let model = chain(&case.get("L").numbers(), &case.get("m").numbers());
        let (b, oracle) = (model.nominal(), Oracle::new(&model));
        for point in case.get("points").list() {
            let u = [point.get("Omega").number()];
            let what = format!("{name} at {u:?}");
            let q = relative(&point.get("theta_star").numbers());
            let at: At = [&q, &u, &b];
            let linear = Kernels::linear(&oracle, at);
            // No matrices are stored for the longest chains.
            for (field, matrix) in [("M", &linear.mass), ("K", &linear.stiffness)] {
                if let Some(expected) = point.find(field) {
                    assert_close(&absolute(matrix), &expected.matrix(), 1e-13, &what);
                }
            }
            assert_close(&linear.damping, &vec![0.0; linear.mass.len()], 1e-12, &what);
            let residual = Kernels::residual(&oracle, at);
            assert_close(&residual, &vec![0.0; q.len()], 1e-11, &what);

            let total = Total::new(&oracle, at);
            let (omegas, rates) = (point.get("omega_n").numbers(), point.get("domega_db").list());
            let modes = modes(&linear);
            let values: Vec<f64> = modes.iter().map(|(lambda, _)| lambda.sqrt()).collect();
            assert_close(&values, &omegas, 1e-11, &what);
            // For the longest chains one mode is enough.
            let checked = if q.len() > 4 { 1 } else { q.len() };
            for (mode, rates) in modes.iter().zip(rates).take(checked) {
                let [_, by_design] = total.frequency(mode);
                assert_close(&by_design, &rates.numbers(), 1e-9, &what);
            }
        }
    }
}

/// `sum_ij sin(3 i + 7 j + 1) D_ij`.
fn checksum(matrix: &[f64]) -> f64 {
    let n = matrix.len().isqrt();
    let weight = |k: usize| ((3 * (k / n) + 7 * (k % n) + 1) as f64).sin();
    matrix.iter().enumerate().map(|(k, entry)| weight(k) * entry).sum()
}

#[test]
fn chains_away_from_equilibrium() {
    for case in Truth::load("w1_w2_w3").get("given_q").list() {
        let what = case.get("name").text();
        let model = chain(&case.get("L").numbers(), &case.get("m").numbers());
        let (b, u) = (model.nominal(), [case.get("Omega").number()]);
        let q = relative(&case.get("q").numbers());
        let at: At = [&q, &u, &b];
        let oracle = Oracle::new(&model);
        let linear = Kernels::linear(&oracle, at);
        assert_close(&absolute(&linear.mass), &case.get("M").matrix(), 1e-13, &what);
        assert_close(&absolute(&linear.stiffness), &case.get("K").matrix(), 1e-13, &what);
        let residual = absolute_vector(&Kernels::residual(&oracle, at));
        assert_close(&residual, &case.get("R").numbers(), 1e-13, &what);

        let partials = Kernels::linear_partials(&oracle, at);
        let sums = |list: &[Linear<f64>], part: fn(&Linear<f64>) -> &Vec<f64>| -> Vec<f64> {
            list.iter().map(|linear| checksum(&absolute(part(linear)))).collect()
        };
        let (design, coordinates) = (&partials.by_design, &partials.by_coordinate);
        for (field, found) in [
            ("dM_db_checksum", sums(design, |linear| &linear.mass)),
            ("dK_db_checksum", sums(design, |linear| &linear.stiffness)),
            ("dM_dq_checksum", absolute_vector(&sums(coordinates, |linear| &linear.mass))),
            ("dK_dq_checksum", absolute_vector(&sums(coordinates, |linear| &linear.stiffness))),
        ] {
            assert_close(&found, &case.get(field).numbers(), 1e-12, &format!("{what} {field}"));
        }
    }
}

#[test]
fn seven_joint_arm() {
    let truth = Truth::load("panda_arm");
    let model = arm(&truth);
    let oracle = Oracle::new(&model);
    for state in truth.get("states").list() {
        let get = |field: &str| state.get(field);
        let q = get("q").numbers();
        let at: At = [&q, &[], &[]];
        let (velocity, acceleration) = (get("qdot").numbers(), get("qddot").numbers());
        let torque = Kernels::motion_residual(&oracle, &acceleration, &velocity, at);
        assert_close(&torque, &get("tau").numbers(), 1e-12, "tau");
        let [mass, _] = Kernels::motion(&oracle, &velocity, at);
        assert_close(&mass, &get("M").matrix(), 1e-12, "M");
        let torque = Kernels::residual(&oracle, at);
        assert_close(&torque, &get("static_tau").numbers(), 1e-12, "static tau");
        let linear = Kernels::linear(&oracle, at);
        assert_close(&linear.mass, &get("M").matrix(), 1e-12, "Mhat");
        assert_close(&linear.stiffness, &get("static_dtau_dq").matrix(), 1e-12, "Khat");
        // In motion: by central differences of the residual, which the file gives exactly.
        for (field, by_velocity) in [("dtau_dq", false), ("dtau_dqdot", true)] {
            let columns = (0..q.len()).map(|j| {
                let torque = |h: f64| {
                    let (mut q, mut velocity) = (q.clone(), velocity.clone());
                    if by_velocity {
                        velocity[j] += h;
                    } else {
                        q[j] += h;
                    }
                    let torque = Kernels::motion_residual(&oracle, &acceleration, &velocity, [&q, &[], &[]]);
                    DVector::from_vec(torque)
                };
                (torque(1e-4) - torque(-1e-4)) / 2e-4
            });
            let jacobian = DMatrix::from_columns(&columns.collect::<Vec<_>>()).transpose();
            assert_close(jacobian.as_slice(), &get(field).matrix(), 1e-7, field);
        }
    }
}
