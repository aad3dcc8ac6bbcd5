//! Matrices and eigenvalues of the bicycle, against the paper and against its formulas in high precision.

use eigentol::{Complex, Study};
use eigentol_oracle::truth::Truth;
use eigentol_tests::wheels::WhippleBicycle;

use super::common::{TIGHT, at, check_design, check_modes, close, close_real_slopes, complex, design_names, truth};
use super::projection::onto;

fn bicycle() -> Study<WhippleBicycle> {
    Study::new(WhippleBicycle)
}

/// Compares each entry relative to the largest of its matrix.
#[track_caller]
fn same(values: &[Vec<f64>], expected: &[f64], tolerance: f64, what: &str) {
    let found = values.concat();
    let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    for (one, other) in found.iter().zip(expected) {
        assert!((one - other).abs() <= tolerance * size, "{what}: {found:?}, not {expected:?}");
    }
}

#[test]
fn the_parameters_are_those_of_the_benchmark() {
    check_design::<WhippleBicycle>(&truth("bicycle").get("parameters"));
}

/// `M`, `v C1` and `g K0 + v^2 K2`, against the printed values and the formulas of the paper.
#[test]
fn canonical_matrices() {
    let truth = truth("bicycle");
    let kept = [WhippleBicycle::lean.index(), WhippleBicycle::steer.index()];
    for (source, tolerance) in [("matrices", 1e-12), ("published", 1e-12)] {
        let matrix = |name: &str| truth.get(source).get(name).matrix();
        let [m, c1, k0, k2] = ["M", "C1", "K0", "K2"].map(matrix);
        for speed in [0.0, 0.3, 1.0, 4.6, 10.0] {
            let study = bicycle().input(WhippleBicycle::v, speed);
            let state = study.equilibrium().expect("rolling straight ahead");
            let projected = onto(&state.linear, &state.description, &kept);
            let scaled = |a: &[f64], factor: f64| a.iter().map(|x| factor * x).collect::<Vec<_>>();
            let (gravity, speeds) = (scaled(&k0, 9.81), scaled(&k2, speed * speed));
            let stiffness: Vec<f64> = gravity.iter().zip(&speeds).map(|(a, b)| a + b).collect();
            let what = format!("{source}, {speed} m/s");
            same(&projected.mass, &m, tolerance, &what);
            same(&projected.damping, &scaled(&c1, speed), tolerance, &what);
            same(&projected.stiffness, &stiffness, tolerance, &what);
        }
    }
}

/// Eigenvalues at 0, 1, ..., 10 m/s and their derivatives by the speed and all parameters.
#[test]
fn eigenvalues_and_their_derivatives() {
    for point in truth("bicycle").get("spectra").list() {
        check_modes(&at(&bicycle(), &point), &point);
    }
}

/// To the digits of Table 2; the last digits of its largest eigenvalues are inaccurate.
#[test]
fn published_eigenvalues() {
    let table = truth("bicycle").get("published").get("eigenvalues").list();
    for (speed, row) in table.iter().enumerate() {
        let study = bicycle().input(WhippleBicycle::v, speed as f64);
        let found = study.modes().expect("modes");
        let row = row.list();
        assert_eq!(found.modes.len(), row.len());
        for s in row.iter().map(complex) {
            let off = |mode: &eigentol::Mode| (mode.s - s).norm();
            let best = found.modes.iter().map(off).fold(f64::INFINITY, f64::min);
            assert!(best <= 2e-12 * (1.0 + s.norm()), "{speed} m/s: {s} is missing by {best:e}");
        }
    }
}

/// Two real eigenvalues merge into the weave mode: their distance grows as the square root of the distance in speed.
#[test]
fn the_double_root() {
    let double = truth("bicycle").get("double_root");
    let (speed, s) = (double.get("speed").number(), double.get("s").number());
    for (step, pairs) in [(-1e-4, false), (1e-4, true)] {
        let study = bicycle().input(WhippleBicycle::v, speed * (1.0 + step));
        let found = study.modes().expect("modes");
        let near: Vec<Complex> = found.modes.iter().map(|mode| mode.s).collect();
        let near: Vec<_> = near.into_iter().filter(|z| (z - s).norm() < 0.1).collect();
        assert_eq!(near.len(), if pairs { 1 } else { 2 }, "{near:?}");
        assert!(near.iter().all(|z| (z.im > 1e-3) == pairs), "{near:?}");
    }
    let study = bicycle().input(WhippleBicycle::v, speed);
    let found = study.modes().expect("modes");
    let near = found.modes.iter().enumerate();
    let near: Vec<_> = near.filter(|(_, mode)| (mode.s - s).norm() < 1e-6).collect();
    assert!(!near.is_empty(), "{found:?}");
    let slopes = study.sensitivities().expect("derivatives, where there are any");
    assert!(near.iter().all(|(k, _)| slopes.modes[*k].clustered));
}

/// The load on each wheel, independent of speed.
#[test]
fn wheel_loads() {
    let loads = truth("bicycle").get("loads");
    let names = design_names::<WhippleBicycle>();
    for speed in [0.0, 5.0] {
        let study = bicycle().input(WhippleBicycle::v, speed);
        let found = study.outputs().expect("loads");
        for (k, name) in ["rear", "front"].into_iter().enumerate() {
            let load = loads.get(name).number();
            close(found.values[k], load, 0.0, name);
            let by = loads.get("by_design");
            let by: Vec<f64> = names.iter().map(|name| by.get(name).numbers()[k]).collect();
            let own = found.by_design[k].as_ref().expect("derivatives");
            close_real_slopes(own, &by, study.design_values(), &names, name);
            let by_speed = found.by_input[k].as_ref().expect("derivatives")[0];
            assert!(by_speed.abs() < 1e-9 * load, "{by_speed}");
        }
    }
}

/// All second derivatives of the weave eigenvalue at 5 m/s.
#[test]
fn curvature_of_the_weave() {
    let hessian = truth("bicycle").get("hessian");
    let s = complex(&hessian.get("s"));
    let order = hessian.get("order").list();
    let order: Vec<String> = order.iter().map(Truth::text).collect();
    assert_eq!(order, design_names::<WhippleBicycle>());
    let study = bicycle().input(WhippleBicycle::v, hessian.get("speed").number());
    let modes = study.modes().expect("modes");
    let weave = modes.modes.iter().position(|mode| (mode.s - s).norm() < 1e-6);
    let found = study.mode_curvature(weave.expect("the weave")).expect("curvature");
    let found = &found.eigenvalue.as_ref().expect("it oscillates").by_design;
    let rows = |part: &str| -> Vec<Vec<f64>> {
        let rows = hessian.get(part).list();
        rows.iter().map(Truth::numbers).collect()
    };
    let (real, imaginary) = (rows("real"), rows("imag"));
    let values = study.design_values();
    let expected = |i: usize, j: usize| Complex::new(real[i][j], imaginary[i][j]);
    let greatest = (0..26)
        .flat_map(|i| (0..26).map(move |j| (i, j)))
        .fold(0.0_f64, |most, (i, j)| most.max((expected(i, j) * values[i] * values[j]).norm()));
    for i in 0..26 {
        for j in 0..26 {
            let scale = 1e-2 * greatest / (values[i] * values[j]).abs();
            let off = (found[i][j] - expected(i, j)).norm();
            assert!(
                off <= TIGHT * expected(i, j).norm().max(scale),
                "by {} and {}: {}, not {}",
                order[i],
                order[j],
                found[i][j],
                expected(i, j)
            );
        }
    }
}
