//! Orbits of two outputs.

use core::f64::consts::{FRAC_PI_4, SQRT_2};

use eigentol::equilibrium::equilibrium;
use eigentol::forced::{Orbit, Turning, response};
use eigentol::{Complex, Output, Policy};

use super::models::Jeffcott;
use crate::common::derived::Derived;

#[test]
fn ellipses() {
    // `x = 3 cos(wt - a)`, `y = sin(wt - a)` turned by 0.4: an ellipse of semi-axes 3 and 1, forward.
    let (sine, cosine) = 0.4_f64.sin_cos();
    let late = Complex::from_polar(1.0, -0.7);
    for (sign, turning) in [(1.0, Turning::Forward), (-1.0, Turning::Backward)] {
        let (long, short) = (late * 3.0, late * Complex::new(0.0, -sign));
        let orbit = Orbit::of(long * cosine - short * sine, long * sine + short * cosine);
        let [a, b] = orbit.semi_axes();
        assert!((a - 3.0).abs() < 1e-15 && (b - 1.0).abs() < 1e-15);
        assert!((orbit.direction().unwrap() - 0.4).abs() < 1e-15);
        assert_eq!(orbit.turning(), Some(turning));
    }
}

#[test]
fn lines_and_circles() {
    let line = Orbit::of(Complex::new(1.0, 2.0), Complex::new(1.0, 2.0));
    assert_eq!(line.turning(), None);
    assert!((line.direction().unwrap() - FRAC_PI_4).abs() < 1e-15);
    assert!((line.semi_axes()[0] - SQRT_2 * 5.0_f64.sqrt()).abs() < 1e-15);
    let circle = Orbit::of(Complex::new(0.0, 2.0), Complex::new(2.0, 0.0));
    assert_eq!(circle.direction(), None);
    assert_eq!(circle.turning(), Some(Turning::Forward));
}

#[test]
fn a_rotor_on_equal_springs_circles_with_its_shaft() {
    let model = Derived(Jeffcott);
    for (speed, turning) in [(200.0, Turning::Forward), (-200.0, Turning::Backward)] {
        let at = equilibrium(&model, &[speed], &[12.0, 1.9e6, 310.0, 4e-5], &[0.0; 2], Policy::Stable);
        let found = response(&model, &at.unwrap()).unwrap();
        let own = found.harmonics[0].orbit(Output::new(0), Output::new(1)).unwrap();
        assert_eq!(own.turning(), Some(turning));
        assert_eq!(own.direction(), None);
        let [long, short] = own.semi_axes();
        assert!((long / 1.350_825_703_822_996_4e-5 - 1.0).abs() < 1e-12);
        assert!((long - short).abs() < 1e-12 * long);
    }
}
