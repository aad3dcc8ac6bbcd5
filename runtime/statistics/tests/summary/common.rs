//! Samples that depend only on their index.

use eigentol_statistics::Error;
use eigentol_statistics::summary::{Chunk, Partial, Plan, chunks};
use std::ops::Range;

/// A number between 0 and 1 (SplitMix64, Steele, Lea and Flood 2014).
pub(crate) fn uniform(stream: u64, sample: u64) -> f64 {
    let mut z = (stream << 40 ^ sample).wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ z >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ z >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ z >> 31) >> 11) as f64 / (1_u64 << 53) as f64
}

/// A standard normal number, from a pair of uniform numbers (Box and Muller 1958).
pub(crate) fn normal(stream: u64, sample: u64) -> f64 {
    let radius = (-2.0 * (1.0 - uniform(2 * stream, sample)).ln()).sqrt();
    radius * (std::f64::consts::TAU * uniform(2 * stream + 1, sample)).cos()
}

/// Three quantities: a large mean with a small standard deviation, one missing in every fifth sample, and one
/// with zeros of either sign.
pub(crate) fn quantities(sample: u64) -> [Option<f64>; 3] {
    let x = normal(7, sample);
    let y = 0.5 * x + uniform(8, sample);
    let z = [0.0, -0.0, 1.0, -3.5][(sample % 4) as usize] * uniform(9, sample);
    [Some(1e8 + 1e-4 * x), (sample % 5 != 3).then_some(y), Some(z)]
}

pub(crate) fn plan() -> Result<Plan, Error> {
    let plan = Plan::new(3).sketch(0, 1e8, 1e-4)?.sketch(2, 0.0, 1.0)?;
    Ok(plan.covariances(&[0, 1], &[1, 2])?.outcomes(2))
}

/// The samples of a range, in one pass.
pub(crate) fn gathered(samples: Range<u64>) -> Result<Partial, Error> {
    let mut partial = Partial::new(plan()?);
    add(&mut partial, samples)?;
    Ok(partial)
}

pub(crate) fn add(partial: &mut Partial, samples: Range<u64>) -> Result<(), Error> {
    for piece in chunks(samples) {
        let mut chunk = Chunk::new(&plan()?, piece.clone())?;
        for sample in piece {
            for (k, value) in quantities(sample).into_iter().enumerate() {
                chunk.set(sample, k, value)?;
            }
            chunk.count((sample % 5 == 3).into(), 1)?;
        }
        partial.add(&chunk)?;
    }
    Ok(())
}
