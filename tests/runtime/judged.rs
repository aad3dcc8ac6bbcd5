//! Samples that jump across flutter and divergence, far from the nominal design: the stability and eigenvalues of each
//! against closed forms and, on a turntable, against a dense QR method; their numbers against the exact distribution.

use eigentol::tolerance::Outcome;
use eigentol::{Complex, Mechanism, MonteCarlo, Stability, Study, mechanism};
use nalgebra::{Matrix4, Schur};

mechanism! {
    /// A mass of 1 kg in a seal: a force across the displacement has no potential.
    mechanism Seal {
        design kx = 110.0 N/m;
        design ky = 90.0 N/m;
        design across = 8.0 N/m;
        design damping = 0.5 N*s/m;
        body slide: massless;
        body block: point(mass: 1.0 kg);
        joint x: prismatic(x) from ground to slide;
        joint y: prismatic(y) from slide to block;
        point seat: ground;
        point journal: block;
        force seal: bushing(from: seat, to: journal,
            stiffness: [[kx, across, 0 N/m], [-across, ky, 0 N/m], [0 N/m, 0 N/m, 0 N/m]],
            damping: [[damping, 0 N*s/m, 0 N*s/m], [0 N*s/m, damping, 0 N*s/m], [0 N*s/m, 0 N*s/m, 0 N*s/m]]);
    }
}

mechanism! {
    /// A mass of 1 kg on two slides of a turntable.
    mechanism Turntable {
        input omega: rad/s;
        design kx = 110.0 N/m;
        design ky = 90.0 N/m;
        design damping = 0.0 N*s/m;
        body plate: massless;
        body slide: massless;
        body block: point(mass: 1.0 kg);
        joint spin: revolute(z) from ground to plate, driven at omega;
        joint x: prismatic(x) from plate to slide;
        joint y: prismatic(y) from slide to block;
        force x_spring: spring(on: x, stiffness: kx);
        force x_damper: damper(on: x, damping: damping);
        force y_spring: spring(on: y, stiffness: ky);
        force y_damper: damper(on: y, damping: damping);
    }
}

const SAMPLES: usize = 1000;

fn sampled<M: Mechanism>(study: Study<M>) -> MonteCarlo {
    let study = study.sigma_level(1.0).samples(SAMPLES).keep_samples(true);
    study.monte_carlo().expect("samples")
}

/// The probability of a standard normal number below `z`, by Simpson's rule.
fn normal(z: f64) -> f64 {
    let n = 2000;
    let h = (z + 12.0) / n as f64;
    let density = |x: f64| (-0.5 * x * x).exp() / std::f64::consts::TAU.sqrt();
    let weight = |k: usize| match k {
        _ if k == 0 || k == n => 1.0,
        _ if k % 2 == 1 => 4.0,
        _ => 2.0,
    };
    let terms = (0..=n).map(|k| weight(k) * density(-12.0 + h * k as f64));
    h / 3.0 * terms.sum::<f64>()
}

/// Checks a number of samples with this probability to within five standard deviations.
fn agrees(count: usize, chance: f64) {
    let n = SAMPLES as f64;
    let sigma = (n * chance * (1.0 - chance)).sqrt();
    assert!((count as f64 - n * chance).abs() < 5.0 * sigma + 0.5, "{count} {}", n * chance);
}

/// Eigenvalues of `s^2 + s C + K` by a library's QR method on the companion matrix.
fn by_qr([[cxx, cxy], [cyx, cyy]]: [[f64; 2]; 2], [[kxx, kxy], [kyx, kyy]]: [[f64; 2]; 2]) -> Vec<Complex> {
    #[rustfmt::skip]
    let companion = Matrix4::new(
        0.0, 0.0, 1.0, 0.0,
        0.0, 0.0, 0.0, 1.0,
        -kxx, -kxy, -cxx, -cxy,
        -kyx, -kyy, -cyx, -cyy,
    );
    let schur = Schur::try_new(companion, 1e-14, 1000).expect("it converges");
    let values = schur.complex_eigenvalues();
    let each = values.iter().map(|s| Complex::new(s.re, s.im));
    each.collect()
}

/// Eigenvalues of a seal with equal damping along both axes: `s^2 + c s + lambda = 0`, with `lambda` an eigenvalue of
/// the stiffness.
fn of_seal(damping: f64, [kx, ky]: [f64; 2], across: f64) -> Vec<Complex> {
    let both = |middle: f64, square: f64| {
        let root = Complex::new(square, 0.0).sqrt();
        [middle - root, middle + root]
    };
    let half = 0.5 * (kx - ky);
    let roots = both(0.5 * (kx + ky), half * half - across * across);
    let of = |lambda: Complex| {
        let root = (0.25 * damping * damping - lambda).sqrt();
        [-0.5 * damping - root, -0.5 * damping + root]
    };
    roots.into_iter().flat_map(of).collect()
}

/// Whether the eigenvalues of a sample, without conjugates, match those of the companion matrix including multiplicity.
fn same(complexes: &[Option<Complex>], wanted: &[Complex], tolerance: f64) {
    let mut left = wanted.to_vec();
    assert!(complexes.iter().any(Option::is_some), "{complexes:?}");
    for s in complexes.iter().flatten() {
        let both = [Some(*s), (s.im > 0.0).then(|| s.conj())];
        for s in both.into_iter().flatten() {
            let distance = |other: &Complex| (s - other).norm();
            let nearest = (0..left.len()).min_by(|&a, &b| distance(&left[a]).total_cmp(&distance(&left[b])));
            let nearest = left.remove(nearest.expect("no more eigenvalues than there are"));
            assert!(distance(&nearest) < tolerance, "{s} {nearest} of {wanted:?}, {complexes:?}");
        }
    }
}

/// `lambda = k +- sqrt((d/2)^2 - q^2)` are the eigenvalues of the stiffness, and `s^2 + c s + lambda` has a growing
/// root where `(Im lambda)^2 > c^2 Re lambda`.
#[test]
fn a_seal_flutters_beyond_its_limit() {
    for (nominal, sigma) in [(8.0, 4.0), (8.0, 0.9), (10.0, 1.0), (11.1, 0.1), (14.0, 2.0)] {
        let study = Study::new(Seal).design(Seal::across, nominal).tolerance(Seal::across, sigma);
        let run = sampled(study);
        let limit = (10.0_f64.powi(2) + 0.5_f64.powi(2) * 100.0).sqrt();
        let mut stable = 0;
        for sample in run.all.as_ref().expect("samples were asked for") {
            let q = sample.design[2];
            stable += usize::from(q.abs() < limit);
            let expected = if q.abs() < limit { Outcome::Stable } else { Outcome::Flutter };
            assert_eq!(sample.outcome, expected, "{nominal} {sigma}: {q}");
            let exact = of_seal(0.5, [110.0, 90.0], q);
            assert_eq!(sample.eigenvalues.iter().flatten().count(), 2);
            // Near a double eigenvalue a rounding error acts through its square root.
            same(&sample.eigenvalues, &exact, 1e-6);
        }
        assert_eq!((run.counts.stable, run.counts.flutter), (stable, SAMPLES - stable));
        agrees(stable, normal((limit - nominal) / sigma) - normal((-limit - nominal) / sigma));
    }
}

/// Both stiffnesses of the seal, and with them both pairs of eigenvalues, change sign together.
#[test]
fn a_seal_gives_way_in_one_direction_or_in_two() {
    let mut growing = [0; 2];
    for (nominal, sigma, damping) in [(30.0, 40.0, 0.5), (3.0, 2.0, 9.0), (-2.0, 3.0, 1.0)] {
        let stiff = [Seal::kx, Seal::ky];
        let study = Study::new(Seal).design(Seal::damping, damping).design(Seal::across, 0.5);
        let study = stiff.into_iter().fold(study, |study, k| study.design(k, nominal).tolerance(k, sigma));
        let run = sampled(study);
        for sample in run.all.as_ref().expect("samples were asked for") {
            let [kx, ky] = [sample.design[0], sample.design[1]];
            let exact = of_seal(damping, [kx, ky], 0.5);
            same(&sample.eigenvalues, &exact, 1e-6);
            let grows = exact.iter().filter(|s| s.re > 0.0);
            let (real, complex): (Vec<&Complex>, Vec<&Complex>) = grows.partition(|s| s.im == 0.0);
            let expected = match (real.len(), complex.len()) {
                (0, 0) => Outcome::Stable,
                (0, _) => Outcome::Flutter,
                _ => Outcome::Divergent,
            };
            assert_eq!(sample.outcome, expected, "{nominal}: {kx} {ky}");
            growing[0] += usize::from(real.len() == 1);
            growing[1] += usize::from(real.len() == 2);
        }
        assert_eq!(run.counts.total(), SAMPLES);
    }
    assert!(growing.iter().all(|&count| count > 100), "{growing:?}");
}

/// `a = kx - omega^2` and `b = ky - omega^2`: with a damper on the plate it is stable where both are positive, without
/// one also where both are negative.
#[test]
fn a_turntable_holds_its_block_by_springs_or_by_turning() {
    for (omega, damping, sigma) in [
        (7.0, 0.0, 20.0),
        (10.0, 0.0, 10.0),
        (12.0, 0.0, 20.0),
        (7.0, 0.4, 20.0),
        (9.0, 0.4, 8.0),
        (9.0, 4.0, 2.0),
        (12.0, 0.4, 20.0),
    ] {
        let study = Study::new(Turntable)
            .input(Turntable::omega, omega)
            .design(Turntable::damping, damping)
            .tolerance(Turntable::kx, sigma)
            .tolerance(Turntable::ky, sigma);
        let run = sampled(study);
        let square = omega * omega;
        for sample in run.all.as_ref().expect("samples were asked for") {
            let (a, b) = (sample.design[0] - square, sample.design[1] - square);
            let expected = match (a > 0.0, b > 0.0) {
                (true, true) => Outcome::Stable,
                (false, false) if damping == 0.0 => Outcome::Stable,
                (false, false) => Outcome::Flutter,
                _ => Outcome::Divergent,
            };
            assert_eq!(sample.outcome, expected, "{omega} {damping}: {a} {b}");
            let exact = by_qr([[damping, -2.0 * omega], [2.0 * omega, damping]], [[a, 0.0], [0.0, b]]);
            same(&sample.eigenvalues, &exact, 1e-6);
        }
        let (x, y) = (normal((110.0 - square) / sigma), normal((90.0 - square) / sigma));
        let turning = if damping == 0.0 { (1.0 - x) * (1.0 - y) } else { 0.0 };
        agrees(run.counts.stable, x * y + turning);
        agrees(run.counts.divergent, x * (1.0 - y) + y * (1.0 - x));
    }
}

/// At rest the directions are uncoupled: a mode keeps its direction where their frequencies exchange order.
#[test]
fn modes_that_change_places_keep_their_names() {
    for damping in [0.0, 0.3] {
        let study = Study::new(Turntable)
            .input(Turntable::omega, 0.0)
            .design(Turntable::damping, damping)
            .tolerance(Turntable::kx, 8.0)
            .tolerance(Turntable::ky, 8.0);
        let run = sampled(study);
        let mut changed = 0;
        for sample in run.all.as_ref().expect("samples were asked for") {
            let [kx, ky] = [sample.design[0], sample.design[1]];
            changed += usize::from(kx < ky);
            // At the nominal design the lower mode moves along y.
            for (s, k) in sample.eigenvalues.iter().zip([ky, kx]) {
                let exact = Complex::new(-0.5 * damping, (k - 0.25 * damping * damping).sqrt());
                let s = s.expect("it oscillates");
                assert!((s - exact).norm() < 1e-9, "{s} {exact}");
            }
            for (frequency, k) in sample.frequencies.iter().zip([ky, kx]) {
                let exact = (k - 0.25 * damping * damping).sqrt();
                assert!(frequency.is_some_and(|own| (own - exact).abs() < 1e-9));
            }
        }
        agrees(changed, normal(-20.0 / (8.0 * 2.0_f64.sqrt())));
    }
}

/// The modes by which a seal is judged, in ascending order of size, are those it returns.
#[test]
fn a_study_answers_with_the_modes_it_was_judged_by() {
    for (stiff, across, damping) in
        [([110.0, 90.0], 8.0, 0.5), ([400.0, 90.0], 30.0, 60.0), ([90.0, 400.0], 200.0, 3.0)]
    {
        let study = Study::new(Seal)
            .design(Seal::kx, stiff[0])
            .design(Seal::ky, stiff[1])
            .design(Seal::across, across)
            .design(Seal::damping, damping);
        let state = study.equilibrium().expect("an equilibrium");
        let modes = study.modes().expect("an equilibrium");
        let mut exact = of_seal(damping, stiff, across);
        exact.retain(|s| s.im >= 0.0);
        exact.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
        let found = &modes.modes;
        assert_eq!(found.len(), exact.len());
        for (label, (mode, s)) in found.iter().zip(&exact).enumerate() {
            assert!((mode.s - s).norm() < 1e-9 * s.norm(), "{} {s}", mode.s);
            assert_eq!(mode.label, label);
        }
        let grows = exact.iter().any(|s| s.re > 0.0);
        assert_eq!(modes.stable(), !grows);
        let stable = state.stability == Stability::Stable;
        assert_eq!(stable, !grows);
    }
}
