//! The points of the reference file, and comparisons with them.

use eigentol_oracle::truth::Truth;
use eigentol_tests::loops::{
    five_bar, four_bar, geared_coasting, geared_motor, geared_rotors, governor, porter_governor, slider_crank,
};
use nalgebra::Complex;

/// Names in the file, with their declarations.
pub(crate) const LOOPS: [(&str, &str); 9] = [
    ("governor", governor::DECLARATION),
    ("porter_governor", porter_governor::DECLARATION),
    ("slider_crank", slider_crank::DECLARATION),
    ("five_bar", five_bar::DECLARATION),
    ("four_bar_open", four_bar::DECLARATION),
    ("four_bar_crossed", four_bar::DECLARATION),
    ("geared_rotors", geared_rotors::DECLARATION),
    ("geared_coasting", geared_coasting::DECLARATION),
    ("geared_motor", geared_motor::DECLARATION),
];

/// Relative error within which everything must match.
pub(crate) const TIGHT: f64 = 1e-9;

/// A mechanism in the file.
pub(crate) struct Case {
    pub(crate) name: &'static str,
    pub(crate) truth: Truth,
    /// Design variables, then the input.
    pub(crate) variables: Vec<String>,
    /// Nominal design.
    pub(crate) design: Vec<f64>,
    /// Names of the coordinates that determine all others.
    pub(crate) independent: Vec<String>,
}

impl Case {
    pub(crate) fn new(name: &'static str) -> Self {
        let truth = Truth::load("loops").get("mechanisms").get(name);
        let texts = |field| truth.get(field).list().iter().map(Truth::text).collect();
        let design = truth.get("design").list();
        Self {
            name,
            variables: texts("variables"),
            independent: texts("independent"),
            design: design.iter().map(|one| one.get("value").number()).collect(),
            truth,
        }
    }

    /// Changes the value of one design variable.
    pub(crate) fn with(mut self, variable: &str, value: f64) -> Self {
        let place = self.variables.iter().position(|name| name == variable);
        self.design[place.expect("a design variable")] = value;
        self
    }

    pub(crate) fn points(&self) -> Vec<Point> {
        let points = self.truth.get("points").list();
        assert!(points.len() >= 3, "{}", self.name);
        points
            .into_iter()
            .map(|truth| {
                let input = truth.get("input").number();
                Point {
                    what: format!("{} at {input}", self.name),
                    input,
                    scales: [&self.design[..], &[input]].concat(),
                    truth,
                }
            })
            .collect()
    }
}

/// A steady motion of a mechanism.
pub(crate) struct Point {
    pub(crate) what: String,
    pub(crate) input: f64,
    pub(crate) truth: Truth,
    /// Values of the variables.
    scales: Vec<f64>,
}

impl Point {
    pub(crate) fn modes(&self) -> Vec<Truth> {
        self.truth.get("modes").list()
    }

    /// The scale of a derivative of something of size `size` by a variable: one hundredth of the size per 100 % change.
    pub(crate) fn scale(&self, size: f64, variables: &[usize]) -> f64 {
        let per = |&variable: &usize| {
            let value = self.scales[variable].abs();
            if value > 0.0 { value } else { 1.0 }
        };
        1e-2 * size / variables.iter().map(per).product::<f64>()
    }
}

pub(crate) fn complex(value: &Truth) -> Complex<f64> {
    let parts = value.numbers();
    Complex::new(parts[0], parts[1])
}

/// Error relative to the larger of the expected value and `scale`.
#[track_caller]
pub(crate) fn assert_near(complex: Complex<f64>, expected: Complex<f64>, scale: f64, what: &str) {
    let off = (complex - expected).norm();
    // NaN is not agreement.
    let agrees = off <= TIGHT * expected.norm().max(scale);
    assert!(agrees, "{what}: {complex}, not {expected}: off by {off:e}, of a scale of {scale:e}");
}

#[track_caller]
pub(crate) fn assert_close(value: f64, expected: f64, scale: f64, what: &str) {
    assert_near(value.into(), expected.into(), scale, what);
}
