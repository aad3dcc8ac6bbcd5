//! Normal variables from random bits, one pair at a time or in vectors, without calls to the system's math library: the
//! same bits everywhere.

use crate::scalar::{Lanes, sin_cos_of_turns};

/// Upper bound of all values drawn: the smallest probability is 2^-53, and `sqrt(-2 ln 2^-53) = 8.572`.
pub(super) const GREATEST_NORMAL: f64 = 8.6;

/// Two independent standard normal values from two independent probabilities, strictly between 0 and 1 (Box and Muller
/// 1958): the first gives a radius with `P(R > r) = exp(-r^2/2)`, the second an angle.
#[inline(always)]
pub(super) fn standard_normal_pair<V: Lanes>(radius: V, angle: V) -> (V, V) {
    let radius = (ln(radius) * V::constant(-2.0)).sqrt();
    let (sine, cosine) = sin_cos_of_turns(angle);
    (radius * cosine, radius * sine)
}

/// Natural logarithm of a positive normal number; that of its mantissa `m` is `2 artanh((m - 1) / (m + 1))`.
#[inline(always)]
fn ln<V: Lanes>(x: V) -> V {
    let number = V::constant;
    let (exponent, mantissa) = x.split();
    let s = (mantissa - number(1.0)) / (mantissa + number(1.0));
    let z = s * s;
    let mut sum = number(LN[6]);
    for coefficient in LN[..6].iter().rev() {
        sum = sum * z + number(*coefficient);
    }
    exponent * number(core::f64::consts::LN_2) + s * (number(2.0) + z * sum)
}

/// `(2 artanh(s) / s - 2) / s^2` in powers of `s^2` for mantissas around 1; the relative error of the logarithm is
/// below 2^-59.
const LN: [f64; 7] = [
    0.6666666666666735,
    0.39999999999409136,
    0.285714287437815,
    0.2222219841461147,
    0.18183573331205893,
    0.15313801563972204,
    0.14798618881501438,
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::{Batch, Instructions, Task, WIDTH};

    /// Probabilities from the smallest to the largest that is drawn, closely spaced at both ends.
    fn probabilities() -> Vec<f64> {
        let tails = (0..=200).map(|k| 2.0_f64.powf(-53.0 + 0.26 * f64::from(k)));
        let tails: Vec<f64> = tails.filter(|&p| p < 0.5).collect();
        let centre = (1..1000).map(|k| f64::from(k) / 1000.0);
        let opposite = tails.iter().map(|p| 1.0 - p);
        tails.iter().copied().chain(centre).chain(opposite).collect()
    }

    #[test]
    fn logarithms() {
        for p in probabilities() {
            let size = p.ln().abs();
            assert!((ln(p) - p.ln()).abs() <= 4e-16 * size.max(1e-300), "{p:e}");
        }
    }

    #[test]
    fn a_radius_and_an_angle() {
        for (k, p) in probabilities().into_iter().enumerate() {
            let angle = (k % 97) as f64 / 97.0 + 0.003;
            let (x, y) = standard_normal_pair(p, angle);
            let radius = (-2.0 * p.ln()).sqrt();
            let (sine, cosine) = (core::f64::consts::TAU * angle).sin_cos();
            assert!(x.hypot(y) < GREATEST_NORMAL);
            assert!((x - radius * cosine).abs() <= 1e-15 * radius * 2.0);
            assert!((y - radius * sine).abs() <= 1e-15 * radius * 2.0);
        }
    }

    #[test]
    fn vectors_give_the_same_bits() {
        struct All<'a>(&'a Batch, &'a Batch);
        impl Task for All<'_> {
            type Output = [Batch; 2];
            #[inline(always)]
            fn run<V: Lanes>(self) -> [Batch; 2] {
                let mut out = [Batch::default(); 2];
                for at in (0..WIDTH).step_by(V::WIDTH) {
                    let pair = standard_normal_pair(V::load(self.0, at), V::load(self.1, at));
                    pair.0.store(&mut out[0], at);
                    pair.1.store(&mut out[1], at);
                }
                out
            }
        }
        let all = probabilities();
        for set in Instructions::available() {
            for start in 0..all.len() {
                let shifted = |shift: usize| all[(start + shift) % all.len()];
                let (radii, angles) = (Batch::from_fn(|k| shifted(177 * k)), Batch::from_fn(shifted));
                let pairs = set.run(All(&radii, &angles));
                for state in 0..WIDTH {
                    let (x, y) = standard_normal_pair(radii.0[state], angles.0[state]);
                    let bits = pairs.map(|batch| batch.0[state].to_bits());
                    assert_eq!(bits, [x.to_bits(), y.to_bits()]);
                }
            }
        }
    }
}
