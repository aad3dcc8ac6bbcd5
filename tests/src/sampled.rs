//! Compares samples solved in vectors with samples solved one by one.

use eigentol::modes::Family;
use eigentol::propagation::{ResponseSpread, sampled};
use eigentol::response::{Response, Responses};
use eigentol::scalar::Instructions;
use eigentol::tolerance::Sample;
use eigentol::tolerance::{Points, Sampling};
use eigentol::{Error, Mechanism, MonteCarlo, Quantity, Study};

/// The number of samples compared, and the number that differ in their last bits, which were solved in vectors.
#[derive(Clone, Copy, Debug, Default)]
pub struct Compared {
    /// Samples compared with those solved one by one.
    pub samples: usize,
    /// How many of these were solved in vectors.
    pub in_vectors: usize,
}

impl Compared {
    /// The sums of many comparisons, first with each study's own tolerances, then with wide ones.
    pub fn sum(all: impl IntoIterator<Item = [Self; 2]>) -> [Self; 2] {
        let mut sum = [Self::default(); 2];
        for own in all {
            for (sum, own) in sum.iter_mut().zip(own) {
                sum.samples += own.samples;
                sum.in_vectors += own.in_vectors;
            }
        }
        sum
    }
}

/// Compares samples of damped and undamped modes: every instruction set must give the same bits, and solving one by one
/// must give the same numbers or the same error. It does so with the study's tolerances and, for a quarter of the
/// samples, with tolerances ten times as wide. Nothing is compared where the study solves no samples in vectors.
///
/// # Panics
/// When anything differs.
pub fn compare<M: Mechanism + Copy>(study: &Study<M>, name: &str) -> [Compared; 2] {
    // Half-widths of 0.3 standard deviations.
    let wide = study.clone().sigma_level(0.3);
    let wide = wide.samples(study.sampling().samples / 4);
    [compare_one(study, name), compare_one(&wide, &format!("{name}, wide"))]
}

fn compare_one<M: Mechanism + Copy>(study: &Study<M>, name: &str) -> Compared {
    let mut compared = Compared::default();
    for family in [Family::General, Family::Undamped] {
        let study = study.clone().family(family).keep_samples(true);
        let run = |vectors| study.clone().vectors(vectors).monte_carlo();
        let (alone, own) = match (run(None), run(Some(Instructions::SCALAR))) {
            (Ok(alone), Ok(own)) => (alone, own),
            (alone, own) => {
                assert_eq!(own.err(), alone.err(), "{name}, {family:?}");
                continue;
            }
        };
        if !own.side_by_side {
            continue;
        }
        for set in Instructions::available().filter(|set| *set != Instructions::SCALAR) {
            assert!(run(Some(set)).as_ref() == Ok(&own), "{name}: {set:?}");
        }
        assert_eq!(own.counts, alone.counts, "{name}");
        let all = |run: &MonteCarlo| run.all.clone().expect("samples are kept");
        for (k, (own, alone)) in all(&own).iter().zip(&all(&alone)).enumerate() {
            same(own, alone, &format!("{name}, {family:?}, sample {k}"));
            compared.samples += 1;
            compared.in_vectors += usize::from(own != alone);
        }
        responses(&study, &format!("{name}, {family:?}"));
    }
    compared
}

/// Standard deviations of every quantity of the first mode, in vectors and one by one.
fn responses<M: Mechanism + Copy>(study: &Study<M>, what: &str) {
    let quantities = Quantity::ALL.map(|quantity| Response::Mode { mode: 0, quantity });
    let (at, modes) = (&study.equilibrium().expect("a nominal state"), &study.modes().expect("a nominal state"));
    let (machine, wanted) = (study.mechanism(), quantities.to_vec());
    let tolerances = study.tolerances().expect("tolerances");
    let sampling = Sampling::default().points(Points::Sobol).samples(64).threads(1);
    let run = |responses: Result<Responses<'_>, Error>| {
        let samples = sampled(&responses?, &tolerances, &sampling)?;
        samples.propagation()
    };
    let own = run(Responses::side_by_side(machine, at, modes, wanted.clone())).expect("samples");
    let alone = run(Responses::new(machine, at, modes, wanted)).expect("samples");
    assert_eq!(own.counts, alone.counts, "{what}");
    for (own, alone) in own.spreads.iter().zip(&alone.spreads) {
        assert_eq!(own.is_some(), alone.is_some(), "{what}");
        let (Some(own), Some(alone)) = (own, alone) else {
            continue;
        };
        let size = alone.mean.value.abs().max(1.0);
        near(own.mean.value, alone.mean.value, size, what);
        let sigma = |spread: &ResponseSpread| spread.sigma.map_or(0.0, |sigma| sigma.value);
        near(sigma(own), sigma(alone), size, what);
        assert_eq!(own.share, alone.share, "{what}");
    }
}

fn near(a: f64, b: f64, scale: f64, what: &str) {
    assert!((a - b).abs() <= 1e-9 * scale, "{what}: {a} {b}");
}

fn same(sample: &Sample, alone: &Sample, what: &str) {
    assert_eq!(sample.design, alone.design, "{what}");
    assert_eq!(sample.outcome, alone.outcome, "{what}");
    assert_eq!(sample.coordinates.is_some(), alone.coordinates.is_some(), "{what}");
    if let (Some(a), Some(b)) = (&sample.coordinates, &alone.coordinates) {
        let size = b.iter().fold(1.0, |most: f64, value| most.max(value.abs()));
        for (a, b) in a.iter().zip(b) {
            near(*a, *b, size, what);
        }
    }
    assert_eq!(sample.eigenvalues.len(), alone.eigenvalues.len(), "{what}");
    for (a, b) in sample.eigenvalues.iter().zip(&alone.eigenvalues) {
        assert_eq!(a.is_some(), b.is_some(), "{what}");
        if let (Some(a), Some(b)) = (a, b) {
            near(a.re, b.re, b.norm(), what);
            near(a.im, b.im, b.norm(), what);
        }
    }
    for (own, alone) in [(&sample.frequencies, &alone.frequencies), (&sample.damping_ratios, &alone.damping_ratios)] {
        for (a, b) in own.iter().zip(alone) {
            assert_eq!(a.is_some(), b.is_some(), "{what}");
            near(a.unwrap_or(0.0), b.unwrap_or(0.0), b.unwrap_or(0.0).abs().max(1.0), what);
        }
    }
}
