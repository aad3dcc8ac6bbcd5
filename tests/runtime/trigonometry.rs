//! Sine and cosine of `f64` against stored values and against another implementation.

use eigentol::Real;

/// `x`, then its sine and its cosine from 80-digit arithmetic, each as a double and its remainder.
fn exact() -> Vec<[f64; 5]> {
    let text = include_str!("../truth/sine_and_cosine.txt");
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    let rows = rows.map(|line| {
        let numbers = line.split(' ').map(|number| number.parse());
        let numbers: Vec<f64> = numbers.collect::<Result<_, _>>().expect("numbers");
        <[f64; 5]>::try_from(numbers).expect("five numbers")
    });
    let rows: Vec<_> = rows.collect();
    assert_eq!(rows.len(), 137);
    rows
}

/// Distance of `value` from `exact + lacking`, in units in the last place of `exact`.
fn units(value: f64, exact: f64, lacking: f64) -> f64 {
    let place = (exact.abs().next_up() - exact.abs()).max(f64::from_bits(1));
    ((value - exact) - lacking).abs() / place
}

#[test]
fn stored_values_to_one_unit_in_the_last_place() {
    for [x, sine, sine_rest, cosine, cosine_rest] in exact() {
        let (s, c) = Real::sin_cos(x);
        let errors = [units(s, sine, sine_rest), units(c, cosine, cosine_rest)];
        assert!(errors.iter().all(|&error| error <= 1.0), "{x:e}: {errors:?}");
    }
}

/// Tests the measure itself: the neighbour of a correct value is too far away.
#[test]
fn a_wrong_last_digit_is_seen() {
    let [x, sine, rest, ..] = exact()[0];
    let (right, _) = Real::sin_cos(x);
    assert!(units(right.next_up().next_up(), sine, rest) > 1.0);
}

/// In vectors: the same bits as one by one, whatever the neighbouring lanes, and the correct sign of zero.
#[test]
fn several_angles_at_once() {
    let angles = [0.3, -0.0, 2e5, -1.2e4, f64::NAN, 7.0, f64::INFINITY, 1.0, 0.0];
    let bits = |(s, c): (f64, f64)| [s.to_bits(), c.to_bits()];
    let alone = angles.map(|x| bits(Real::sin_cos(x)));
    let comparable = |k: usize| angles[k].is_finite();
    for (k, pair) in Real::sin_cos_all(angles).into_iter().enumerate() {
        assert!(!comparable(k) || bits(pair) == alone[k], "{}: {pair:?}", angles[k]);
        assert!(comparable(k) || (pair.0.is_nan() && pair.1.is_nan()));
    }
    let [(even, _)] = Real::sin_cos_all([-0.0_f64]);
    let [(first, _), _] = Real::sin_cos_all([-0.0_f64, 1.0]);
    assert!(even.is_sign_negative() && first.is_sign_negative());
    for [x, ..] in exact() {
        let [(s, c), _] = Real::sin_cos_all([x, 0.5]);
        assert_eq!(bits((s, c)), bits(Real::sin_cos(x)), "{x:e}");
    }
}

#[test]
fn agrees_with_the_standard_library_everywhere() {
    let mut state = 1_u64;
    let mut uniform = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    for k in 0..300_000 {
        let size = [1e5, 10.0, 1.0, 1e-3, 1e9][k % 5];
        let x = size * (2.0 * uniform() - 1.0);
        // Every second one is close to a multiple of pi/2.
        let quarter = core::f64::consts::FRAC_PI_2;
        let x = if k % 2 == 0 { x } else { (x / quarter).round() * quarter };
        let (s, c) = Real::sin_cos(x);
        let (sine, cosine) = f64::sin_cos(x);
        assert!(units(s, sine, 0.0) <= 1.0 && units(c, cosine, 0.0) <= 1.0, "{x:e}");
        assert_eq!((Real::sin(x), Real::cos(x)), (s, c));
        assert_eq!(Real::sin_cos(-x), (-s, c));
    }
}

#[test]
fn what_is_not_finite_is_not_a_number() {
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let (s, c) = Real::sin_cos(x);
        assert!(s.is_nan() && c.is_nan());
    }
    let (s, c) = Real::sin_cos(-0.0_f64);
    assert!(s == 0.0 && s.is_sign_negative() && c == 1.0);
}
