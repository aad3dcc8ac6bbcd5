//! Standard deviations beyond first order: moments of the second-order model from the file's second derivatives, and
//! samples in which the loops are closed again.

use eigentol::Mechanism;
use eigentol_oracle::truth::Truth;
use eigentol_tests::loops::{
    FiveBar, FourBar, GearedCoasting, GearedMotor, GearedRotors, Governor, PorterGovernor, SliderCrank,
};
use eigentol_tests::sampled::{Compared, compare};

use super::common::{Case, assert_close, complex};
use super::study::study;

const SAMPLES: usize = 2000;

/// Shift of the mean, and standard deviation, of `Im s`: `sum H_ii v_i / 2`, and the root of
/// `sum (g_i)^2 v_i + sum (H_ij)^2 v_i v_j / 2`, with the variances `v`.
fn moments(case: &Case, mode: &Truth) -> [f64; 2] {
    let design = case.truth.get("design").list();
    let variance = |i: usize| (design[i].get("tolerance").number() / 3.0).powi(2);
    let slope = |i: usize| complex(&mode.get("s_by").get(&case.variables[i])).im;
    let rows = mode.get("s_second").list();
    let rows: Vec<Vec<Truth>> = rows.iter().map(Truth::list).collect();
    let second = |i: usize, j: usize| complex(&rows[i.max(j)][i.min(j)]).im;
    let all = || 0..design.len();
    let shift = all().map(|i| second(i, i) * variance(i) / 2.0).sum::<f64>();
    let first = all().map(|i| slope(i).powi(2) * variance(i)).sum::<f64>();
    let bend = |i: usize| all().map(|j| second(i, j).powi(2) * variance(i) * variance(j) / 2.0).sum::<f64>();
    [shift, (first + all().map(bend).sum::<f64>()).sqrt()]
}

fn check(machine: impl Mechanism, name: &'static str) {
    let case = Case::new(name);
    let point = case.points().remove(1);
    let study = study(machine, &case, &point).samples(SAMPLES).seed(5);
    let modes = study.modes().expect("modes");
    let found = study.second_order().expect("second order");
    let sampled = study.monte_carlo().expect("samples");
    assert_eq!(sampled.counts.stable, SAMPLES, "{}", point.what);
    for truth in point.modes() {
        let s = complex(&truth.get("s"));
        let what = format!("{}: {s}", point.what);
        let near = |mode: &eigentol::Mode| (mode.s - s).norm() < 1e-6 * s.norm();
        let r = modes.modes.iter().position(near).expect("the mode");
        let [shift, sigma] = moments(&case, &truth);
        let frequency = &found.modes[r].as_ref().expect("derivatives").frequency;
        assert_close(frequency.moments.mean_shift, shift, 1e-2 * sigma, &what);
        assert_close(frequency.moments.sigma, sigma, 0.0, &what);

        let statistics = sampled.modes[r].as_ref().expect("samples");
        // Four standard errors of the mean and of the standard deviation.
        let count = SAMPLES as f64;
        let off = (statistics.mean - s.im - shift).abs();
        assert!(off < 4.0 * sigma / count.sqrt(), "{what}: {statistics:?}");
        let deviation = statistics.sigma.expect("many samples");
        let off = (deviation / sigma - 1.0).abs();
        assert!(off < 4.0 / (2.0 * count).sqrt(), "{what}: {statistics:?}");
    }
}

#[test]
fn second_order_and_samples() {
    check(Governor, "governor");
    check(SliderCrank, "slider_crank");
    check(FiveBar, "five_bar");
    check(FourBar, "four_bar_crossed");
}

/// Samples at every point, in vectors and one by one.
fn in_vectors<M: Mechanism + Copy>(machine: M, name: &'static str, samples: usize) -> Vec<(String, [Compared; 2])> {
    let case = Case::new(name);
    let points = case.points().into_iter();
    let compared = points.map(|point| {
        let study = study(machine, &case, &point).samples(samples).seed(6);
        (point.what.clone(), compare(&study, &point.what))
    });
    compared.collect()
}

#[test]
fn samples_in_vectors_are_those_alone() {
    compare_all(40);
}

#[test]
#[ignore = "a quarter of a minute"]
fn many_samples_in_vectors_are_those_alone() {
    compare_all(300);
}

fn compare_all(samples: usize) {
    let all = [
        in_vectors(Governor, "governor", samples),
        in_vectors(PorterGovernor, "porter_governor", samples),
        in_vectors(SliderCrank, "slider_crank", samples),
        in_vectors(FiveBar, "five_bar", samples),
        in_vectors(FourBar, "four_bar_open", samples),
        in_vectors(FourBar, "four_bar_crossed", samples),
        in_vectors(GearedRotors, "geared_rotors", samples),
        in_vectors(GearedCoasting, "geared_coasting", samples),
        in_vectors(GearedMotor, "geared_motor", samples),
    ];
    let all = all.concat();
    println!("{all:#?}");
    let [own, wide] = Compared::sum(all.iter().map(|(_, x)| *x));
    assert!(own.samples > 10 * samples && 10 * own.in_vectors > 8 * own.samples, "{own:?}");
    assert!(wide.samples > 5 * samples / 2 && 10 * wide.in_vectors > 6 * wide.samples, "{wide:?}");
}
