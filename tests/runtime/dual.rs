//! Dual numbers against first and second derivatives in closed form.

use eigentol::{Dual, Real};

type Second = Dual<Dual<f64>>;

/// A number with unit rate in both dual directions.
fn moving(value: f64) -> Second {
    let one = Dual::fixed(1.0);
    let [value] = Dual::along(&[value], &[1.0]);
    Dual { value, slope: one }
}

/// Value, first and second derivative.
fn assert_derivatives(what: &str, second: Second, expected: [f64; 3]) {
    let found = [second.value.value, second.value.slope, second.slope.slope];
    for (order, (one, other)) in found.iter().zip(expected).enumerate() {
        let close = (one - other).abs() <= 1e-14 * (1.0 + other.abs());
        assert!(close, "{what}, derivative {order}: {one:e}, not {other:e}");
    }
}

#[test]
fn functions_have_the_derivatives_of_the_tables() {
    let x = 0.4_f64;
    let m = moving(x);
    let (sine, cosine, tangent) = (x.sin(), x.cos(), x.tan());
    let rest = 1.0 - x * x;
    let near = 1.0 + x * x;
    let (square, root) = (tangent * tangent + 1.0, x.sqrt());
    let one = Second::constant(1.0);
    for (what, found, expected) in [
        ("sin", m.sin(), [sine, cosine, -sine]),
        ("cos", m.cos(), [cosine, -sine, -cosine]),
        ("tan", m.tan(), [tangent, square, 2.0 * tangent * square]),
        ("sqrt", m.sqrt(), [root, 0.5 / root, -0.25 / (x * root)]),
        ("asin", m.asin(), [x.asin(), rest.powf(-0.5), x * rest.powf(-1.5)]),
        ("acos", m.acos(), [x.acos(), -rest.powf(-0.5), -x * rest.powf(-1.5)]),
        ("atan2", m.atan2(one), [x.atan(), 1.0 / near, -2.0 * x / (near * near)]),
        ("atan2 of the other", one.atan2(m), [1.0_f64.atan2(x), -1.0 / near, 2.0 * x / (near * near)]),
        ("exp", m.exp(), [x.exp(); 3]),
        ("ln", m.ln(), [x.ln(), 1.0 / x, -1.0 / (x * x)]),
        ("third power", m.powi(3), [x * x * x, 3.0 * x * x, 6.0 * x]),
        ("reciprocal", m.powi(-1), [1.0 / x, -1.0 / (x * x), 2.0 / (x * x * x)]),
        ("power", m.powf(Second::constant(2.5)), [x.powf(2.5), 2.5 * x.powf(1.5), 3.75 * root]),
        ("exponent", Second::constant(2.0).powf(m), [0, 1, 2].map(|k| 2.0_f64.powf(x) * 2.0_f64.ln().powi(k))),
        ("quotient", m / (one + m), [x / (1.0 + x), (1.0 + x).powi(-2), -2.0 * (1.0 + x).powi(-3)]),
        ("product", -(m * m - one), [1.0 - x * x, -2.0 * x, -2.0]),
    ] {
        assert_derivatives(what, found, expected);
    }
    let both = Second::sin_cos_all([m, m + m]);
    assert_derivatives("first sine", both[0].0, [sine, cosine, -sine]);
    let (sine, cosine) = (2.0 * x).sin_cos();
    assert_derivatives("second cosine", both[1].1, [cosine, -2.0 * sine, -4.0 * cosine]);
}

#[test]
fn small_powers_of_zero_are_finite() {
    assert_derivatives("one", moving(0.0).powi(0), [1.0, 0.0, 0.0]);
    assert_derivatives("itself", moving(0.0).powi(1), [0.0, 1.0, 0.0]);
    assert_derivatives("square", moving(0.0).powi(2), [0.0, 0.0, 2.0]);
}
