//! The inverse of the normal distribution function, for one value and for vectors of them, without a function of the
//! system's library: the same bits everywhere.

use crate::lanes::Vector;

/// Standard normal value `z` with `P(Z < z) = probability`, strictly between 0 and 1; relative error below 1e-15. Wichura
/// (1988), algorithm AS 241.
#[inline(always)]
pub(super) fn standard_normal<V: Vector>(probability: V) -> V {
    let number = V::constant;
    let q = probability - number(0.5);
    let r = number(0.180625) - q * q;
    let central = q * polynomial(&A, r) / polynomial(&B, r);
    let inner = q.abs().at_most(number(0.425));
    if V::every(inner) {
        return central;
    }
    let opposite = number(1.0) - probability;
    let tail = V::choose(q.at_most(number(0.0)), probability, opposite);
    let root = (-ln(tail)).sqrt();
    let r = root - number(1.6);
    let mut outer = polynomial(&C, r) / polynomial(&D, r);
    let moderate = root.at_most(number(5.0));
    if !V::every(moderate) {
        let r = root - number(5.0);
        outer = V::choose(moderate, outer, polynomial(&E, r) / polynomial(&F, r));
    }
    let outer = V::choose(q.at_most(number(0.0)), -outer, outer);
    V::choose(inner, central, outer)
}

#[inline(always)]
fn polynomial<V: Vector, const K: usize>(coefficients: &[f64; K], x: V) -> V {
    let mut sum = V::constant(coefficients[K - 1]);
    for coefficient in coefficients[..K - 1].iter().rev() {
        sum = sum * x + V::constant(*coefficient);
    }
    sum
}

/// Natural logarithm of a positive normal number: of its mantissa `m` by `2 artanh((m - 1) / (m + 1))`.
#[inline(always)]
fn ln<V: Vector>(x: V) -> V {
    let number = V::constant;
    let (exponent, mantissa) = x.split();
    let s = (mantissa - number(1.0)) / (mantissa + number(1.0));
    let z = s * s;
    exponent * number(core::f64::consts::LN_2) + s * (number(2.0) + z * polynomial(&LN, z))
}

/// `(2 artanh(s) / s - 2) / s^2` in powers of `s^2` for mantissas about 1, relative error of the logarithm below 2^-59.
const LN: [f64; 7] = [
    0.6666666666666735,
    0.39999999999409136,
    0.285714287437815,
    0.2222219841461147,
    0.18183573331205893,
    0.15313801563972204,
    0.14798618881501438,
];

const A: [f64; 8] = [
    3.387_132_872_796_366_5,
    1.331_416_678_917_843_8e2,
    1.971_590_950_306_551_3e3,
    1.373_169_376_550_946e4,
    4.592_195_393_154_987e4,
    6.726_577_092_700_87e4,
    3.343_057_558_358_813e4,
    2.509_080_928_730_122_7e3,
];
const B: [f64; 8] = [
    1.0,
    4.231_333_070_160_091e1,
    6.871_870_074_920_579e2,
    5.394_196_021_424_751e3,
    2.121_379_430_158_659_7e4,
    3.930_789_580_009_271e4,
    2.872_908_573_572_194_3e4,
    5.226_495_278_852_854e3,
];
const C: [f64; 8] = [
    1.423_437_110_749_683_5,
    4.630_337_846_156_546,
    5.769_497_221_460_691,
    3.647_848_324_763_204_5,
    1.270_458_252_452_368_4,
    2.417_807_251_774_506e-1,
    2.272_384_498_926_918_4e-2,
    7.745_450_142_783_414e-4,
];
const D: [f64; 8] = [
    1.0,
    2.053_191_626_637_759,
    1.676_384_830_183_803_8,
    6.897_673_349_851e-1,
    1.481_039_764_274_800_8e-1,
    1.519_866_656_361_645_7e-2,
    5.475_938_084_995_345e-4,
    1.050_750_071_644_416_9e-9,
];
const E: [f64; 8] = [
    6.657_904_643_501_103,
    5.463_784_911_164_114,
    1.784_826_539_917_291_3,
    2.965_605_718_285_048_7e-1,
    2.653_218_952_657_612_4e-2,
    1.242_660_947_388_078_4e-3,
    2.711_555_568_743_487_6e-5,
    2.010_334_399_292_288_1e-7,
];
const F: [f64; 8] = [
    1.0,
    5.998_322_065_558_88e-1,
    1.369_298_809_227_358e-1,
    1.487_536_129_085_061_5e-2,
    7.868_691_311_456_133e-4,
    1.846_318_317_510_054_8e-5,
    1.421_511_758_316_446e-7,
    2.044_263_103_389_939_8e-15,
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{Batch, Instructions, Task, WIDTH};
    use crate::tolerance::distribution::normal::upper;

    /// Probabilities from the least that is drawn on, close together in the tails.
    fn probabilities() -> Vec<f64> {
        let tails = (0..=200).map(|k| 2.0_f64.powf(-53.0 + 0.26 * f64::from(k)));
        let tails: Vec<f64> = tails.filter(|&p| p < 0.5).collect();
        let centre = (1..1000).map(|k| f64::from(k) / 1000.0);
        tails
            .iter()
            .copied()
            .chain(centre)
            .chain(tails.iter().map(|p| 1.0 - p))
            .collect()
    }

    #[test]
    fn inverts_the_distribution() {
        for p in probabilities().into_iter().filter(|p| *p <= 0.5) {
            let z = standard_normal(p);
            // The slope of ln P is about -z in the tail: what one rounding of z moves.
            let allowed = 1e-15 * (1.0 + z * z);
            assert!((upper(-z) / p - 1.0).abs() <= allowed, "{p:e}: {z}");
        }
        for (p, z) in [
            // Values of 50-digit arithmetic.
            (0.25, -0.674_489_750_196_081_7),
            (1e-3, -3.090_232_306_167_813_5),
            (1e-15, -7.941_345_326_170_997),
        ] {
            assert!((standard_normal(p) / z - 1.0_f64).abs() < 1e-15);
        }
        assert_eq!(standard_normal(0.5), 0.0);
    }

    #[test]
    fn logarithms() {
        for p in probabilities() {
            assert!(
                (ln(p) - p.ln()).abs() <= 4e-16 * p.ln().abs().max(0.3),
                "{p:e}"
            );
        }
    }

    #[test]
    fn vectors_give_the_same_bits() {
        struct All<'a>(&'a Batch);
        impl Task for All<'_> {
            type Output = Batch;
            #[inline(always)]
            fn run<V: Vector>(self) -> Batch {
                let mut out = Batch::default();
                for at in (0..WIDTH).step_by(V::WIDTH) {
                    standard_normal(V::load(self.0, at)).store(&mut out, at);
                }
                out
            }
        }
        let all = probabilities();
        for set in Instructions::available() {
            for start in 0..all.len() {
                // Neighbours, and values from anywhere: the path that one lane takes is no matter to the others.
                for stride in [1, 177] {
                    let batch = Batch::from_fn(|k| all[(start + k * stride) % all.len()]);
                    let values = set.run(All(&batch));
                    assert_eq!(
                        values.0.map(f64::to_bits),
                        batch.0.map(standard_normal).map(f64::to_bits)
                    );
                }
            }
        }
    }
}
