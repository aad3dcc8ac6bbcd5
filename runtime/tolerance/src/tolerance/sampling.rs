//! Random designs: sample `k` is a function of seed, stream and `k` only, so any sample can be drawn on any machine.

use eigentol_statistics::random::RandomNumbers;

use super::Tolerances;
use super::normal_sampling::standard_normal_pair;
use crate::algebra::Vector;
use crate::scalar::WIDTH;

/// Random bits of one probability for each sample of a batch.
pub(crate) type Bits = [u64; WIDTH];

/// Draws designs in sequence, starting at a given sample.
#[doc(hidden)]
pub struct Draw<'a> {
    random: RandomNumbers,
    nominal: &'a [f64],
    tolerances: &'a Tolerances,
    /// Whether anything depends on this pair of random numbers.
    used: Vec<bool>,
    /// The last sample: standard normal numbers, and the design made from them.
    standard: Vector,
    design: Vector,
}

impl<'a> Draw<'a> {
    /// Prepares to draw samples from number `first` on.
    #[doc(hidden)]
    pub fn starting(sequence: (u64, u64), first: u64, nominal: &'a [f64], tolerances: &'a Tolerances) -> Self {
        let factor = tolerances.factor();
        let variables = nominal.len();
        let variable = |j: usize| factor.iter().any(|row| row.get(j).is_some_and(|l| *l != 0.0));
        let all = tolerances.joint().is_some();
        let used = |pair| all || variable(2 * pair) || variable(2 * pair + 1);
        Self {
            random: numbers(sequence, first, variables),
            nominal,
            tolerances,
            used: (0..pairs_of(variables)).map(used).collect(),
            standard: Vector::zeros(variables),
            design: Vector::zeros(variables),
        }
    }

    /// The next sample.
    #[doc(hidden)]
    pub fn next_design(&mut self) -> &[f64] {
        for (values, used) in self.standard.chunks_mut(2).zip(&self.used) {
            let (radius, angle) = (self.random.probability(), self.random.probability());
            if *used {
                let (x, y) = standard_normal_pair(radius, angle);
                for (value, normal) in values.iter_mut().zip([x, y]) {
                    *value = normal;
                }
            }
        }
        self.tolerances.design_from_normal(self.nominal, &self.standard, &mut self.design);
        &self.design
    }
}

/// The random bits of the samples drawn by [`Draw`], batch by batch.
pub(crate) struct Batches(RandomNumbers);

impl Batches {
    /// Prepares to draw samples of `variables` variables from number `first` on.
    pub(crate) fn from(sequence: (u64, u64), first: u64, variables: usize) -> Self {
        Self(numbers(sequence, first, variables))
    }

    /// Writes the bits of a batch, by pair of variables.
    pub(crate) fn next(&mut self, pairs: &mut [[Bits; 2]]) {
        for sample in 0..WIDTH {
            for pair in &mut *pairs {
                for number in pair {
                    number[sample] = self.0.bits();
                }
            }
        }
    }
}

/// The random numbers from sample `first` on: each sample takes two per pair of design variables.
fn numbers((seed, stream): (u64, u64), first: u64, variables: usize) -> RandomNumbers {
    let index = u128::from(first) * 2 * pairs_of(variables) as u128;
    RandomNumbers::starting_at(seed, stream, index)
}

/// Variables `2 p` and `2 p + 1` share pair `p`.
fn pairs_of(variables: usize) -> usize {
    variables.div_ceil(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Lanes;
    use eigentol_statistics::random::probability;

    fn upper(z: f64) -> f64 {
        0.5 * libm::erfc(z * core::f64::consts::FRAC_1_SQRT_2)
    }

    fn design(seed: u64, first: u64, tolerances: &Tolerances) -> Vector {
        let nominal = Vector::zeros(tolerances.sigmas().len());
        Draw::starting((seed, 0), first, &nominal, tolerances).next_design().into()
    }

    #[test]
    fn vectors_take_the_same_probability_from_bits() {
        for k in 0..200_u32 {
            let bits = u64::MAX.rotate_right(k) >> (k % 64) ^ u64::from(k) << 40;
            assert_eq!(f64::probability(&[bits; WIDTH], 0), probability(bits));
        }
    }

    /// Tests 20,000 samples: the largest distance of each variable's empirical distribution from the normal one
    /// (Kolmogorov), and the correlations.
    #[test]
    fn variables_are_normal_and_independent() {
        let number = 20_000;
        let tolerances = Tolerances::new([1.0; 3], 1.0, None).expect("valid");
        let nominal = [0.0; 3];
        let mut draw = Draw::starting((5, 0), 0, &nominal, &tolerances);
        let samples: Vec<Vector> = (0..number).map(|_| draw.next_design().into()).collect();
        for i in 0..3 {
            let mut values: Vec<f64> = samples.iter().map(|sample| sample[i]).collect();
            values.sort_by(f64::total_cmp);
            let distances = values.iter().enumerate().map(|(k, &value)| {
                let empirical = (k as f64 + 0.5) / f64::from(number);
                (empirical - upper(-value)).abs()
            });
            // 1.95 / sqrt(n) is exceeded once in a thousand cases.
            assert!(distances.fold(0.0, f64::max) < 1.95 / f64::from(number).sqrt());
            for j in 0..i {
                let product: f64 = samples.iter().map(|sample| sample[i] * sample[j]).sum();
                let squares: f64 = samples.iter().map(|sample| (sample[i] * sample[j]).powi(2)).sum();
                assert!((product / f64::from(number)).abs() < 4.0 / f64::from(number).sqrt());
                assert!((squares / f64::from(number) - 1.0).abs() < 0.1);
            }
        }
    }

    #[test]
    fn batches_hold_what_single_samples_are_made_of() {
        let tolerances = Tolerances::new([1.0, 0.0, 1.0], 1.0, None).expect("valid");
        let first = 5 * WIDTH;
        let mut batches = Batches::from((9, 0), first as u64, 3);
        let mut pairs = [[[0; WIDTH]; 2]; 2];
        for batch in 0..7 {
            batches.next(&mut pairs);
            for sample in 0..WIDTH {
                let alone = design(9, (first + batch * WIDTH + sample) as u64, &tolerances);
                let normal = |pair: usize| {
                    let [radius, angle] = pairs[pair].map(|bits| probability(bits[sample]));
                    standard_normal_pair(radius, angle).0
                };
                assert_eq!(alone, [normal(0), 0.0, normal(1)]);
            }
        }
    }

    #[test]
    fn samples_are_addressable() {
        let Ok(tolerances) = Tolerances::new([0.3, 0.6], 3.0, None) else { panic!("valid") };
        let nominal = [1.0, 2.0];
        let mut sequence = Draw::starting((7, 0), 0, &nominal, &tolerances);
        let all: Vec<_> = (0..20).map(|_| Vector::from(sequence.next_design())).collect();
        for (k, sample) in all.iter().enumerate() {
            let mut alone = Draw::starting((7, 0), k as u64, &nominal, &tolerances);
            assert_eq!(*sample, alone.next_design());
            let mut other = Draw::starting((7, 1), k as u64, &nominal, &tolerances);
            assert_ne!(*sample, other.next_design());
        }
    }
}
