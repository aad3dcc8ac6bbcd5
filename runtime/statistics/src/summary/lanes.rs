//! Sums over slices in a fixed order that the compiler can vectorise: eight interleaved accumulators.

const LANES: usize = 8;

/// Eight accumulators, each of every eighth value.
type Lanes = [f64; LANES];

#[inline(always)]
fn total(lanes: &Lanes) -> f64 {
    let [a, b, c, d, e, f, g, h] = lanes;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

/// The sum of the deviations from `pivot`, and the smallest and largest values, which are infinite for an empty slice.
#[inline(always)]
pub(super) fn sum_and_range(values: &[f64], pivot: f64) -> (f64, f64, f64) {
    let (mut sums, mut least, mut greatest) = ([0.0; LANES], [f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]);
    let (blocks, rest) = values.as_chunks::<LANES>();
    let mut add = |k: usize, value: f64| {
        sums[k] += value - pivot;
        // `f64::min` does not specify which of two zeros it returns.
        least[k] = if value < least[k] { value } else { least[k] };
        greatest[k] = if value > greatest[k] { value } else { greatest[k] };
    };
    for block in blocks {
        for (k, &value) in block.iter().enumerate() {
            add(k, value);
        }
    }
    for (k, &value) in rest.iter().enumerate() {
        add(k, value);
    }
    let least = least.into_iter().fold(f64::INFINITY, |a, b| if b < a { b } else { a });
    let greatest = greatest.into_iter().fold(f64::NEG_INFINITY, |a, b| if b > a { b } else { a });
    (total(&sums), least, greatest)
}

/// The sum of the deviations from `pivot`.
pub(super) fn sum_from(values: &[f64], pivot: f64) -> f64 {
    let mut sums = [0.0; LANES];
    let (blocks, rest) = values.as_chunks::<LANES>();
    for block in blocks {
        for (sum, value) in sums.iter_mut().zip(block) {
            *sum += value - pivot;
        }
    }
    for (sum, value) in sums.iter_mut().zip(rest) {
        *sum += value - pivot;
    }
    total(&sums)
}

/// The sums of the first four powers of the deviations from `centre`.
#[inline(always)]
pub(super) fn powers(values: &[f64], centre: f64) -> [f64; 4] {
    let mut sums = [[0.0; LANES]; 4];
    let (blocks, rest) = values.as_chunks::<LANES>();
    let mut add = |k: usize, value: f64| {
        let deviation = value - centre;
        let square = deviation * deviation;
        sums[0][k] += deviation;
        sums[1][k] += square;
        sums[2][k] += square * deviation;
        sums[3][k] += square * square;
    };
    for block in blocks {
        for (k, &value) in block.iter().enumerate() {
            add(k, value);
        }
    }
    for (k, &value) in rest.iter().enumerate() {
        add(k, value);
    }
    sums.each_ref().map(total)
}

/// The sums of the deviations `x` and `y` from their centres, and of `x^2`, `y^2` and `x y`.
pub(super) fn products(values: [&[f64]; 2], centres: [f64; 2]) -> [f64; 5] {
    let mut sums = [[0.0; LANES]; 5];
    let (first, first_rest) = values[0].as_chunks::<LANES>();
    let (second, second_rest) = values[1].as_chunks::<LANES>();
    let mut add = |k: usize, x: f64, y: f64| {
        let (x, y) = (x - centres[0], y - centres[1]);
        sums[0][k] += x;
        sums[1][k] += y;
        sums[2][k] += x * x;
        sums[3][k] += y * y;
        sums[4][k] += x * y;
    };
    for (first, second) in first.iter().zip(second) {
        for k in 0..LANES {
            add(k, first[k], second[k]);
        }
    }
    for (k, (&x, &y)) in first_rest.iter().zip(second_rest).enumerate() {
        add(k, x, y);
    }
    sums.each_ref().map(total)
}
