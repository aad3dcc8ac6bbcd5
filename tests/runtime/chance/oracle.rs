//! A uniform bar on a spinning shaft, in closed form: exact probabilities of its frequency for a normally distributed
//! length. Shares no code with the library.

/// `3 g / 2`: the square of the critical speed of a bar of 1 m.
pub(super) const W: f64 = 1.5 * 9.81;

/// The speed at this multiple of the critical one.
pub(super) fn speed(ratio: f64) -> f64 {
    ratio * W.sqrt()
}

/// Lengths between which the frequency is below `limit`: the hanging bar is slower the longer it is, the swung-out one
/// faster.
pub(super) fn slow(speed: f64, limit: f64) -> (f64, f64) {
    let (square, limit) = (speed * speed, limit.max(0.0));
    let longest = if limit < speed { W / (speed * (square - limit * limit).sqrt()) } else { f64::INFINITY };
    (W / (square + limit * limit), longest)
}

/// Probability of a frequency between two limits, for a length of 1 m with this standard deviation.
pub(super) fn between(speed: f64, sigma: f64, (low, high): (f64, f64)) -> f64 {
    let of = |(a, b): (f64, f64)| [(a - 1.0) / sigma, (b - 1.0) / sigma];
    let [a, b] = of(slow(speed, high));
    if low <= 0.0 {
        return normal_between(a, b);
    }
    let [c, d] = of(slow(speed, low));
    normal_between(a, c) + normal_between(d, b)
}

/// `P(a < Z < b)` without cancellation.
pub(super) fn normal_between(a: f64, b: f64) -> f64 {
    if a > 0.0 {
        upper(a) - upper(b)
    } else if b < 0.0 {
        upper(-b) - upper(-a)
    } else {
        1.0 - upper(b) - upper(-a)
    }
}

/// `P(Z > z)` for `z >= 0`: Marsaglia's series up to 3, Laplace's continued fraction beyond.
pub(super) fn upper(z: f64) -> f64 {
    if z == f64::INFINITY {
        return 0.0;
    }
    let density = (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt();
    if z < 3.0 {
        let (mut term, mut sum, mut k) = (z, z, 1.0);
        while term.abs() > 1e-17 * sum.abs() {
            k += 2.0;
            term *= z * z / k;
            sum += term;
        }
        return 0.5 - density * sum;
    }
    let fraction = (1..=200).rev().fold(z, |rest, k| z + f64::from(k) / rest);
    density / fraction
}
