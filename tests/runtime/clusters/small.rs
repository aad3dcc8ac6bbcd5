//! Small matrices: distributions known in closed form, and refused inputs.

use std::f64::consts::PI;

use eigentol::clusters::ModalCouplings;
use eigentol::clusters::{ClusterSpread, sample_cluster};
use eigentol::tolerance::Sampling;
use eigentol::{Complex, Error, Family, Matrix, Tolerances};

use super::{close, independent, refused, within};

fn couplings(family: Family, values: &[Complex], slopes: &[Vec<Complex>]) -> ModalCouplings {
    let matrix = |complexes: &Vec<Complex>| Matrix::from_rows(values.len(), complexes.clone());
    ModalCouplings::new(family, values.to_vec(), slopes.iter().map(matrix).collect())
}

fn undamped(values: &[f64], slopes: &[Vec<f64>], tolerances: &Tolerances) -> Result<ClusterSpread, Error> {
    let complex = |values: &[f64]| -> Vec<Complex> { values.iter().map(|&x| x.into()).collect() };
    let slopes: Vec<Vec<Complex>> = slopes.iter().map(|slope| complex(slope)).collect();
    let couplings = couplings(Family::Undamped, &complex(values), &slopes);
    sample_cluster(&couplings, tolerances, &Sampling::default().samples(4096))
}

/// `s = i 10 + i (matrix)`: the eigenvalues of the real matrices appear in the frequencies.
fn turned(values: &[f64], slopes: &[Vec<f64>], tolerances: &Tolerances) -> ClusterSpread {
    let turn = |values: &[f64]| values.iter().map(|&x| Complex::new(0.0, x)).collect();
    let slopes: Vec<Vec<Complex>> = slopes.iter().map(|slope| turn(slope)).collect();
    let couplings = couplings(Family::General, &turn(values), &slopes);
    sample_cluster(&couplings, tolerances, &Sampling::default().samples(4096)).unwrap()
}

#[test]
fn split_pair_is_rayleigh() {
    // [[100 + x, y], [y, 100 - x]] has eigenvalues 100 -+ sqrt(x^2 + y^2): a Rayleigh distribution.
    let slopes = [vec![1.0, 0.0, 0.0, -1.0], vec![0.0, 1.0, 1.0, 0.0]];
    let found = undamped(&[100.0, 100.0], &slopes, &independent([2.0, 2.0])).unwrap();
    assert_eq!((found.samples, found.unstable, found.unsolved), (4096, 0, 0));
    assert!(found.growth.is_none() && found.damping_ratio.is_none());
    let lambda = found.lambda.unwrap();
    let (low, high) = (lambda.lowest().unwrap(), lambda.highest().unwrap());
    let (low_value, high_value) = (low.value.as_ref().unwrap(), high.value.as_ref().unwrap());
    let (mean, sigma) = (2.0 * (0.5 * PI).sqrt(), 2.0 * (2.0 - 0.5 * PI).sqrt());
    let error = sigma / 64.0;
    within(high_value.mean, 100.0 + mean, 4.0 * error);
    within(low_value.mean, 100.0 - mean, 4.0 * error);
    within(high_value.sigma.unwrap(), sigma, 4.0 * error);
    within(low_value.mean + high_value.mean, 200.0, 1e-11);
    within(lambda.splitting.unwrap().mean, 2.0 * mean, 8.0 * error);
    // Frequencies near 10 rad/s.
    let frequency = found.frequency.highest().unwrap();
    assert_eq!((frequency.value.as_ref().unwrap().count, frequency.without), (4096, 0));
    within(frequency.value.as_ref().unwrap().mean, 10.0 + mean / 20.0, 0.01);
}

#[test]
fn members_are_sorted_and_their_mean_is_the_trace() {
    let slopes =
        [vec![1.0, 0.5, 0.0, 0.5, 2.0, -0.3, 0.0, -0.3, -1.0], vec![0.2, 0.0, 1.0, 0.0, 0.3, 0.0, 1.0, 0.0, 0.7]];
    let correlation = [[1.0, 0.6], [0.6, 1.0]];
    let tolerances = Tolerances::new([0.3, 0.9], 3.0, Some(correlation.into())).unwrap();
    let values = [4.0, 4.001, 4.002];
    let found = undamped(&values, &slopes, &tolerances).unwrap();
    let members = found.lambda.unwrap().members;
    let means: Vec<f64> = members.iter().map(|m| m.value.as_ref().unwrap().mean).collect();
    assert!(means[0] < means[1] && means[1] < means[2]);
    // Traces 2 and 1.2 over 3, with sigma 0.1 and 0.3 and correlation 0.6.
    let (a, b): (f64, f64) = (0.2 / 3.0, 0.36 / 3.0);
    let sigma = (a * a + b * b + 1.2 * a * b).sqrt();
    within(means.iter().sum::<f64>() / 3.0, 4.001, 4.0 * sigma / 64.0);
}

#[test]
fn general_matrices_of_any_size_meet_symmetric_ones() {
    // Symmetric matrices by both methods: lambda by rotations, Im s by the complex iteration.
    for m in 1..6 {
        let slope = |k: usize| -> Vec<f64> {
            let element = |i: usize, j: usize| ((3 * i * j + 2 * (i + j) + k) as f64).sin();
            (0..m * m).map(|e| element(e / m, e % m)).collect()
        };
        let slopes = [slope(0), slope(1), slope(7)];
        let values: Vec<f64> = (0..m).map(|i| 100.0 + 0.1 * i as f64).collect();
        let tolerances = independent([0.3, 1.0, 0.5]);
        let one = undamped(&values, &slopes, &tolerances).unwrap();
        let other = turned(&values, &slopes, &tolerances);
        assert_eq!((other.unstable, other.unsolved), (0, 0));
        let pairs = one.lambda.unwrap().members.into_iter();
        for (a, b) in pairs.zip(&other.frequency.members) {
            let (a, b) = (a.value.unwrap(), b.value.as_ref().unwrap());
            close(a.mean, b.mean, 1e-13);
            close(a.sigma.unwrap(), b.sigma.unwrap(), 1e-10);
        }
    }
}

#[test]
fn a_cluster_of_one_is_normal_and_loses_its_frequency_below_zero() {
    let found = undamped(&[0.0], &[vec![1.0]], &independent([1.0])).unwrap();
    let lambda = found.lambda.as_ref().unwrap().lowest().unwrap();
    within(lambda.value.as_ref().unwrap().mean, 0.0, 4.0 / 64.0);
    // Half of the samples have no root: binomial with standard deviation 32.
    let frequency = found.frequency.lowest().unwrap();
    within(frequency.without as f64, 2048.0, 128.0);
    let count = frequency.value.as_ref().unwrap().count as usize;
    assert_eq!(count + frequency.without, 4096);
    assert_eq!(found.unstable, frequency.without);
}

#[test]
fn nonsymmetric_pairs_flutter() {
    // [[3, x], [-x, 3]]: always the pair 3 +- i |x|; rotated, frequency 3 and growth -+ |x|, half-normal.
    let one = turned(&[3.0, 3.0], &[vec![0.0, 1.0, -1.0, 0.0]], &independent([1.0]));
    assert_eq!(one.unstable, 4096);
    let growth = one.growth.unwrap();
    let highest = growth.highest().unwrap().value.as_ref().unwrap();
    within(highest.mean, (2.0 / PI).sqrt(), 4.0 * 0.603 / 64.0);
    close(growth.splitting.as_ref().unwrap().mean, 2.0 * highest.mean, 1e-12);
    for member in &one.frequency.members {
        close(member.value.as_ref().unwrap().mean, 3.0, 1e-14);
    }
    // The lowest damping ratio belongs to the growth, -x / sqrt(x^2 + 9).
    let ratio = one.damping_ratio.unwrap();
    let (low, high) = (ratio.lowest().unwrap(), ratio.highest().unwrap());
    let (low, high) = (low.value.as_ref().unwrap(), high.value.as_ref().unwrap());
    assert!(low.max < 0.0 && high.min > 0.0);
    close(low.min, -highest.max / highest.max.hypot(3.0), 1e-12);
    // [[3 + y, x], [-x, 3 - y]]: real where |y| > |x|, in half of the samples.
    let slopes = [vec![0.0, 1.0, -1.0, 0.0], vec![1.0, 0.0, 0.0, -1.0]];
    let half = turned(&[3.0, 3.0], &slopes, &independent([1.0, 1.0]));
    within(half.unstable as f64, 2048.0, 128.0);
}

#[test]
fn one_seed_gives_one_result() {
    let one = Complex::new(0.0, 1.0);
    let slopes = [vec![one, 0.3 * one, 0.3 * one, -one], vec![0.0 * one, one, 0.5 * one, 0.2 * one]];
    let couplings = couplings(Family::General, &[5.0 * one, 5.0 * one], &slopes);
    let tolerances = independent([0.1, 0.2]);
    let of = |seed, stream| {
        let sampling = Sampling::default().samples(500).seed(seed).stream(stream);
        sample_cluster(&couplings, &tolerances, &sampling).unwrap()
    };
    assert_eq!(of(1, 0), of(1, 0));
    assert_ne!(of(1, 0), of(2, 0));
    assert_ne!(of(1, 0), of(1, 1));
}

#[test]
fn nonsense_is_refused() {
    let tolerances = independent([1.0]);
    let wrong = |values: &[f64], slopes| refused(undamped(values, &[slopes], &tolerances));
    wrong(&[1.0, 1.0], vec![0.0; 3]);
    wrong(&[1.0, 1.0], vec![0.0, 1.0, 2.0, 0.0]);
    wrong(&[f64::NAN], vec![0.0]);
    wrong(&[1.0], vec![f64::INFINITY]);
    wrong(&[1.0], vec![1e300]);
    let one = Complex::new(1.0, 0.0);
    let sampling = Sampling::default().samples(4096);
    let complex = couplings(Family::Undamped, &[one], &[vec![Complex::new(1.0, 1.0)]]);
    refused(sample_cluster(&complex, &tolerances, &sampling));
    let missing = couplings(Family::General, &[one], &[]);
    refused(sample_cluster(&missing, &tolerances, &sampling));
    let empty = undamped(&[], &[vec![]], &tolerances).unwrap();
    assert!(empty.frequency.lowest().is_none() && empty.frequency.highest().is_none());
    let none = sampling.samples(0);
    let fine = couplings(Family::General, &[one], &[vec![one]]);
    let found = sample_cluster(&fine, &tolerances, &none).unwrap();
    assert!(found.frequency.lowest().unwrap().value.is_none());
}
