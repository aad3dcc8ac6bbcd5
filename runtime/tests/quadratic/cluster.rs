//! Clusters: distributions known in closed form, and what is refused.

use std::f64::consts::PI;

use eigentol::tolerance::{Cluster, ClusterSampling, ClusterSpread, sample_cluster};
use eigentol::{Error, Tolerances};

use super::{close, independent, within};

fn root(lambda: f64) -> Option<f64> {
    (lambda >= 0.0).then(|| lambda.sqrt())
}

fn run<const P: usize>(
    values: &[f64],
    slopes: &[Vec<f64>; P],
    tolerances: &Tolerances<P>,
    symmetric: bool,
) -> Result<ClusterSpread, Error> {
    let cluster = Cluster {
        values,
        slopes,
        symmetric,
    };
    sample_cluster(&cluster, tolerances, &ClusterSampling::default(), root)
}

#[test]
fn split_pair_is_rayleigh() {
    // [[100 + x, y], [y, 100 - x]] has eigenvalues 100 -+ sqrt(x^2 + y^2): a Rayleigh distribution.
    let slopes = [vec![1.0, 0.0, 0.0, -1.0], vec![0.0, 1.0, 1.0, 0.0]];
    let found = run(&[100.0, 100.0], &slopes, &independent([2.0, 2.0]), true).unwrap();
    assert_eq!((found.samples, found.complex), (4096, 0));
    assert_eq!((found.mean, found.mean_sigma), (100.0, 0.0));
    let (low, high) = (found.lowest().unwrap(), found.highest().unwrap());
    let (low_value, high_value) = (low.value.unwrap(), high.value.unwrap());
    let (mean, sigma) = (2.0 * (0.5 * PI).sqrt(), 2.0 * (2.0 - 0.5 * PI).sqrt());
    let error = sigma / 64.0;
    within(high_value.mean, 100.0 + mean, 4.0 * error);
    within(low_value.mean, 100.0 - mean, 4.0 * error);
    within(high_value.standard_deviation.unwrap(), sigma, 4.0 * error);
    within(low_value.mean + high_value.mean, 200.0, 1e-11);
    // The function: frequencies about 10 rad/s.
    let frequency = high.function.unwrap();
    assert_eq!((frequency.count, high.without), (4096, 0));
    within(frequency.mean, 10.0 + mean / 20.0, 0.01);
}

#[test]
fn members_are_sorted_and_their_mean_is_the_trace() {
    let slopes = [
        vec![1.0, 0.5, 0.0, 0.5, 2.0, -0.3, 0.0, -0.3, -1.0],
        vec![0.2, 0.0, 1.0, 0.0, 0.3, 0.0, 1.0, 0.0, 0.7],
    ];
    let correlation = [[1.0, 0.6], [0.6, 1.0]];
    let tolerances = Tolerances::new([0.3, 0.9], 3.0, Some(correlation)).unwrap();
    let values = [4.0, 4.001, 4.002];
    let found = run(&values, &slopes, &tolerances, true).unwrap();
    close(found.mean, 4.001, 1e-15);
    // Traces 2 and 1.2 over 3, with sigma 0.1 and 0.3 and correlation 0.6.
    let (a, b): (f64, f64) = (0.2 / 3.0, 0.36 / 3.0);
    close(
        found.mean_sigma,
        (a * a + b * b + 1.2 * a * b).sqrt(),
        1e-14,
    );
    let means: Vec<f64> = found
        .members
        .iter()
        .map(|m| m.value.unwrap().mean)
        .collect();
    assert!(means[0] < means[1] && means[1] < means[2]);
    let mean = means.iter().sum::<f64>() / 3.0;
    within(mean, found.mean, 4.0 * found.mean_sigma / 64.0);
}

#[test]
fn a_cluster_of_one_is_normal_and_keeps_the_domain_of_the_function() {
    let found = run(&[0.0], &[vec![1.0]], &independent([1.0]), true).unwrap();
    let member = found.lowest().unwrap();
    within(member.value.unwrap().mean, 0.0, 4.0 / 64.0);
    // Half of the samples have no root: binomial with standard deviation 32.
    within(member.without as f64, 2048.0, 128.0);
    assert_eq!(member.function.unwrap().count + member.without, 4096);
}

#[test]
fn nonsymmetric_pairs_flutter() {
    // [[3, x], [-x, 3]]: always the pair 3 +- i |x|, a half-normal imaginary part.
    let found = run(
        &[3.0, 3.0],
        &[vec![0.0, 1.0, -1.0, 0.0]],
        &independent([1.0]),
        false,
    )
    .unwrap();
    assert_eq!(found.complex, 4096);
    let imaginary = found.imaginary.unwrap();
    within(imaginary.mean, (2.0 / PI).sqrt(), 4.0 * 0.603 / 64.0);
    let member = found.highest().unwrap();
    assert_eq!(member.value.unwrap().mean, 3.0);
    assert!(member.function.is_none());
    assert_eq!(member.without, 4096);
    // [[3 + y, x], [-x, 3 - y]]: real where |y| > |x|, one half of the samples.
    let slopes = [vec![0.0, 1.0, -1.0, 0.0], vec![1.0, 0.0, 0.0, -1.0]];
    let half = run(&[3.0, 3.0], &slopes, &independent([1.0, 1.0]), false).unwrap();
    within(half.complex as f64, 2048.0, 128.0);
    assert_eq!(half.imaginary.unwrap().count, half.complex);
    // A symmetric matrix treated as any other has the same eigenvalues.
    let slopes = [vec![1.0, 0.5, 0.5, -1.0]];
    let one = run(&[1.0, 1.1], &slopes, &independent([0.1]), true).unwrap();
    let other = run(&[1.0, 1.1], &slopes, &independent([0.1]), false).unwrap();
    for (a, b) in one.members.iter().zip(&other.members) {
        close(a.value.unwrap().mean, b.value.unwrap().mean, 1e-13);
    }
}

#[test]
fn one_seed_gives_one_result() {
    let slopes = [vec![1.0, 0.3, 0.3, -1.0], vec![0.0, 1.0, 1.0, 0.2]];
    let cluster = Cluster {
        values: &[5.0, 5.0],
        slopes: &slopes,
        symmetric: true,
    };
    let tolerances = independent([0.1, 0.2]);
    let of = |seed, stream| {
        let sampling = ClusterSampling {
            samples: 500,
            seed,
            stream,
        };
        sample_cluster(&cluster, &tolerances, &sampling, root).unwrap()
    };
    assert_eq!(of(1, 0), of(1, 0));
    assert_ne!(of(1, 0), of(2, 0));
    assert_ne!(of(1, 0), of(1, 1));
}

#[test]
fn nonsense_is_refused() {
    let tolerances = independent([1.0]);
    let refused = |values: &[f64], slopes: Vec<f64>, symmetric: bool| {
        let found = run(values, &[slopes], &tolerances, symmetric);
        assert!(matches!(found, Err(Error::Setting { .. })), "{found:?}");
    };
    refused(&[1.0, 1.0], vec![0.0; 3], true);
    refused(&[1.0, 1.0], vec![0.0, 1.0, 2.0, 0.0], true);
    refused(&[1.0; 3], vec![0.0; 9], false);
    refused(&[f64::NAN], vec![0.0], true);
    refused(&[1.0], vec![f64::INFINITY], true);
    refused(&[1.0], vec![1e300], true);
    let empty = run(&[], &[vec![]], &tolerances, true).unwrap();
    assert!(empty.lowest().is_none() && empty.highest().is_none());
    let none = Cluster {
        values: &[1.0],
        slopes: &[vec![1.0]],
        symmetric: true,
    };
    let sampling = ClusterSampling {
        samples: 0,
        ..ClusterSampling::default()
    };
    let found = sample_cluster(&none, &tolerances, &sampling, root).unwrap();
    assert!(found.lowest().unwrap().value.is_none());
}
