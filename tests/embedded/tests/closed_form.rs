//! A mechanism without the standard library, in double and single precision.

use eigentol_embedded::{imbalance, imbalance_f32};

/// `g = k theta + m g l / 2 sin(theta) - m l^2 / 3 omega^2 sin(theta) cos(theta)`.
#[test]
fn it_is_the_closed_form() {
    let (theta, omega) = (0.4_f64, 3.0);
    let (sin, cos) = theta.sin_cos();
    let expected = 20.0 * theta + 3.0 * 9.81 / 2.0 * sin - omega * omega * sin * cos;
    assert!((imbalance(theta, omega, &[3.0, 1.0, 20.0]) - expected).abs() < 1e-13);
    let single = imbalance_f32(theta as f32, omega as f32, &[3.0, 1.0, 20.0]);
    assert!((f64::from(single) - expected).abs() < 1e-5);
}
