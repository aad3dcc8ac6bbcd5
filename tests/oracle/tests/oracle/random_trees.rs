//! Random trees: Lagrange's equations, invariance, finite differences.

use eigentol_oracle::agreement::Case;
use eigentol_oracle::energy;
use eigentol_oracle::examples::chain;
use eigentol_oracle::kernels::{At, Kernels};
use eigentol_oracle::model::{Model, Value};
use eigentol_oracle::random::on_plans;
use eigentol_oracle::{Oracle, State};

fn on_models(cases: u32, check: impl Fn(&Model, u64)) {
    on_plans(cases, |plan| check(&plan.model(), plan.seed));
}

fn at(case: &Case) -> At<'_> {
    [&case.at[0], &case.at[1], &case.at[2]]
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| value.abs().max(most))
}

#[test]
fn lagrange_gives_the_same_equations_of_motion() {
    on_models(400, |model, seed| {
        let case = Case::random(model, seed);
        let oracle = Oracle::new(model);
        let paper = Kernels::motion_residual(&oracle, &case.acceleration, &case.velocity, at(&case));
        let state = [&case.acceleration[..], &case.velocity, &case.at[0]];
        let lagrange = energy::residual(model, state, &case.at[1], &case.at[2]);
        let scale = 1.0 + largest(&paper);
        for (one, other) in paper.iter().zip(&lagrange) {
            assert!((one - other).abs() < 1e-11 * scale, "{paper:?} {lagrange:?}");
        }
    });
}

#[test]
fn driven_coordinates_do_not_matter_in_a_steady_state() {
    on_models(400, |model, seed| {
        let case = Case::random(model, seed);
        let driven: Vec<f64> = (0..model.driven().len()).map(|i| 0.8 - 1.7 * i as f64).collect();
        let (here, there) = (Oracle::new(model), Oracle::new(model).with_driven(&driven));
        let residual =
            |oracle: &Oracle| Kernels::motion_residual(oracle, &case.acceleration, &case.velocity, at(&case));
        let (here, there) = (residual(&here), residual(&there));
        let scale = 1.0 + largest(&here);
        for (one, other) in here.iter().zip(&there) {
            assert!((one - other).abs() < 1e-11 * scale, "{here:?} {there:?}");
        }
    });
}

#[test]
fn tilted_gravity_destroys_the_steady_state_and_shows() {
    let mut model = chain(&[0.8, 1.1], &[2.5, 3.7]);
    model.gravity[0] = Value::Number(1.0);
    let case = Case::random(&model, 1);
    let here = Kernels::residual(&Oracle::new(&model), at(&case));
    let there = Kernels::residual(&Oracle::new(&model).with_driven(&[0.5]), at(&case));
    assert!(here.iter().zip(&there).any(|(one, other)| (one - other).abs() > 1e-3));
}

#[test]
fn mass_matrix_is_the_derivative_by_accelerations() {
    on_models(20, |model, seed| {
        let case = Case::random(model, seed);
        let [q, u, b] = at(&case);
        let oracle = Oracle::new(model);
        // Eq. 8 agrees with eq. 15.
        let literal = oracle.motion(&State::at_rest(q, u, b)).mass.concat();
        let derived = oracle.linear(q, u, b).mass;
        for (one, other) in literal.iter().zip(&derived) {
            assert!((one - other).abs() <= 1e-13 * largest(&literal));
        }
    });
}

/// `|moment| <= lateral`, bodies beside their axes have a share of at most one, and a phase shift changes nothing.
#[test]
fn whirl_is_bounded_and_has_no_phase() {
    on_models(40, |model, seed| {
        let case = Case::random(model, seed);
        let oracle = Oracle::new(model);
        let (x, y) = (&case.mode.0, &case.weight);
        let sums = Oracle::whirl(&oracle, at(&case), x, y);
        let [moment, size, _, _, eccentric, ..] = sums;
        assert!(moment.abs() <= size * (1.0 + 1e-12), "{moment} {size}");
        assert!((0.0..=1.0 + 1e-12).contains(&eccentric), "{eccentric}");
        // (x + i y) (0.6 + 0.8 i)
        let mix = |a: f64, b: f64| -> Vec<f64> { x.iter().zip(y).map(|(x, y)| a * x + b * y).collect() };
        let later = Oracle::whirl(&oracle, at(&case), &mix(0.6, -0.8), &mix(0.8, 0.6));
        let size = sums[1] + sums[2] + sums[3] + sums[6] + 1.0;
        for (one, other) in sums.iter().zip(later) {
            assert!((one - other).abs() <= 1e-12 * size, "{one} {other}");
        }
    });
}

/// `f(+h) - f(-h)` over `2 h`, extrapolated once.
fn slope(f: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
    let central =
        |h: f64| -> Vec<f64> { f(h).iter().zip(f(-h)).map(|(plus, minus)| (plus - minus) / (2.0 * h)).collect() };
    let (wide, narrow) = (central(2e-3), central(1e-3));
    wide.iter().zip(narrow).map(|(wide, narrow)| (4.0 * narrow - wide) / 3.0).collect()
}

fn assert_close(exact: &[f64], approximate: &[f64], what: &str) {
    let scale = 1.0 + largest(exact);
    for (one, other) in exact.iter().zip(approximate) {
        assert!((one - other).abs() < 1e-5 * scale, "{what}: {exact:?} {approximate:?}");
    }
}

#[test]
fn derivatives_are_slopes() {
    on_models(12, |model, seed| {
        let case = Case::random(model, seed);
        let oracle = Oracle::new(model);
        let [dq, du, db] = [&case.along[0][..], &case.along[1], &case.along[2]];
        // Design variables move relative to their size; otherwise a small one would change sign.
        let db: Vec<f64> = db.iter().zip(&case.at[2]).map(|(db, b)| db * b).collect();
        let moved = |h: f64| -> [Vec<f64>; 3] {
            let step = |x: &[f64], dx: &[f64]| x.iter().zip(dx).map(|(x, dx)| x + h * dx).collect();
            [step(&case.at[0], dq), step(&case.at[1], du), step(&case.at[2], &db)]
        };
        fn view(at: &[Vec<f64>; 3]) -> At<'_> {
            [&at[0], &at[1], &at[2]]
        }
        let along: At = [dq, du, &db];
        let at = at(&case);

        let linear = oracle.linear_along(at, along);
        let part = |part: fn(&Oracle, At) -> Vec<f64>| slope(|h| part(&oracle, view(&moved(h))));
        assert_close(&linear.mass, &part(|o, at| Kernels::linear(o, at).mass), "mass");
        assert_close(&linear.damping, &part(|o, at| Kernels::linear(o, at).damping), "damping");
        assert_close(&linear.stiffness, &part(|o, at| Kernels::linear(o, at).stiffness), "stiffness");

        let (phi, lambda) = (&case.mode.0[..], case.mode.1);
        let (dphi, dlambda) = (&case.mode_along.0[..], case.mode_along.1);
        let mode = |h: f64| {
            let phi: Vec<f64> = phi.iter().zip(dphi).map(|(x, dx)| x + h * dx).collect();
            oracle.mode_gradient(view(&moved(h)), &phi, lambda + h * dlambda).concat()
        };
        let exact = oracle.mode_gradient_along(at, (phi, lambda), along, (dphi, dlambda)).concat();
        assert_close(&exact, &slope(mode), "mode_gradient_along");

        let [pencil, pencil_along] = [&case.pencil, &case.pencil_along].map(|list| list.each_ref().map(Vec::as_slice));
        let moved_pencil = |h: f64| {
            let vectors: [Vec<f64>; 4] = std::array::from_fn(|k| {
                let pairs = pencil[k].iter().zip(pencil_along[k]);
                pairs.map(|(x, dx)| x + h * dx).collect()
            });
            oracle.pencil_gradient(view(&moved(h)), vectors.each_ref().map(Vec::as_slice)).concat()
        };
        let exact = oracle.pencil_gradient_along(at, pencil, along, pencil_along).concat();
        assert_close(&exact, &slope(moved_pencil), "pencil_gradient_along");

        let weighted = |h: f64| {
            let w: Vec<f64> = case.weight.iter().zip(&case.weight_along).map(|(x, dx)| x + h * dx).collect();
            oracle.residual_gradient(view(&moved(h)), &w).concat()
        };
        let exact = oracle.residual_gradient_along(at, &case.weight, along, &case.weight_along).concat();
        assert_close(&exact, &slope(weighted), "residual_gradient_along");
    });
}

#[test]
fn gradients_are_contractions_of_partials() {
    on_models(12, |model, seed| {
        let case = Case::random(model, seed);
        let oracle = Oracle::new(model);
        let at = at(&case);
        let n = model.free().len();
        let (phi, lambda) = (&case.mode.0, case.mode.1);
        let partials = Kernels::linear_partials(&oracle, at);
        let all = partials.by_coordinate.iter().chain(&partials.by_input).chain(&partials.by_design);
        let contracted: Vec<f64> = all
            .map(|d| {
                let entry = |k: usize| phi[k / n] * (d.stiffness[k] - lambda * d.mass[k]) * phi[k % n];
                (0..n * n).map(entry).sum()
            })
            .collect();
        let gradient = Kernels::mode_gradient(&oracle, at, phi, lambda).concat();
        let scale = 1.0 + largest(&gradient);
        for (one, other) in gradient.iter().zip(&contracted) {
            assert!((one - other).abs() < 1e-11 * scale, "{gradient:?} {contracted:?}");
        }
        // The special case of undamped modes, which the oracle evaluates without matrices.
        let minus: Vec<f64> = phi.iter().map(|phi| -lambda * phi).collect();
        let still = vec![0.0; n];
        let pencil = [phi, &minus, &still, phi].map(Vec::as_slice);
        let special = Kernels::pencil_gradient(&oracle, at, pencil).concat();
        for (one, other) in gradient.iter().zip(&special) {
            assert!((one - other).abs() < 1e-11 * scale, "{gradient:?} {special:?}");
        }
        // w^T dg: the part by coordinates is w^T Khat.
        let [by_input, by_design] = Kernels::residual_partials(&oracle, at);
        let stiffness = Kernels::linear(&oracle, at).stiffness;
        let gradient = oracle.residual_gradient(at, &case.weight);
        for (matrix, part) in [stiffness, by_input, by_design].iter().zip(&gradient) {
            for (k, value) in part.iter().enumerate() {
                let sum: f64 = (0..n).map(|i| case.weight[i] * matrix[i * part.len() + k]).sum();
                let scale = 1.0 + largest(matrix);
                assert!((sum - value).abs() < 1e-12 * scale, "{sum} {value}");
            }
        }
    });
}
