//! Tests hyper-dual numbers themselves, and the interpreter that runs kernels in them.

use eigentol::{Mechanism, Real};
use eigentol_compiler::program;
use eigentol_consistency::interpreter::interpret;
use eigentol_tests::corpus::governor::{self, Governor};
use eigentol_tests::generated::evaluate;
use eigentol_tests::hyper::Hyper;

use super::common::assert_close;

/// `x` with a unit derivative along the first direction, `y` with one along the second and a small one along the first.
fn variables(x: f64, y: f64) -> [Hyper; 2] {
    [Hyper::new([x, 1.0, 0.0, 0.0]), Hyper::new([y, 0.3, 1.0, 0.0])]
}

/// Values and first derivatives against `f64` formulas, second derivatives against differences of these.
#[test]
fn functions_have_their_derivatives() {
    type Pair = (fn(Hyper) -> Hyper, fn(f64) -> [f64; 3]);
    let functions: [Pair; 10] = [
        (Real::sqrt, |x| [x.sqrt(), 0.5 / x.sqrt(), -0.25 * x.powf(-1.5)]),
        (Real::sin, |x| [x.sin(), x.cos(), -x.sin()]),
        (Real::cos, |x| [x.cos(), -x.sin(), -x.cos()]),
        (Real::tan, |x| {
            let t = x.tan();
            [t, 1.0 + t * t, 2.0 * t * (1.0 + t * t)]
        }),
        (Real::asin, |x| {
            let w = 1.0 - x * x;
            [x.asin(), w.powf(-0.5), x * w.powf(-1.5)]
        }),
        (Real::acos, |x| {
            let w = 1.0 - x * x;
            [x.acos(), -w.powf(-0.5), -x * w.powf(-1.5)]
        }),
        (Real::exp, |x| [x.exp(); 3]),
        (Real::ln, |x| [x.ln(), 1.0 / x, -1.0 / (x * x)]),
        (|x| x.powi(-3), |x| [x.powi(-3), -3.0 * x.powi(-4), 12.0 * x.powi(-5)]),
        (|x| x.powf(Hyper::constant(2.5)), |x| [x.powf(2.5), 2.5 * x.powf(1.5), 3.75 * x.sqrt()]),
    ];
    for (k, (function, expected)) in functions.into_iter().enumerate() {
        for x in [0.2, 0.5, 0.9] {
            let [value, slope, curvature] = expected(x);
            let (d1, d2, d12) = (1.5, -0.7, 0.4);
            let found = function(Hyper::new([x, d1, d2, d12])).parts();
            let expected = [value, slope * d1, slope * d2, slope * d12 + curvature * d1 * d2];
            assert_close(&found, &expected, 1e-3, &format!("function {k} at {x}"));
        }
    }
}

/// In all quadrants and on the axes: the gradient `(-y, x) / r^2` and its derivative.
#[test]
fn angles_have_their_derivatives() {
    for (x, y) in [(1.0, 2.0), (-1.0, 0.5), (-2.0, -0.3), (0.0, 1.5), (0.0, -1.5), (-1.0, 0.0), (2.0, 0.0)] {
        let [hx, hy] = variables(x, y);
        let found = hy.atan2(hx).parts();
        let square = f64::hypot(x, y).powi(2);
        let by = |dx: f64, dy: f64| (x * dy - y * dx) / square;
        // The Hessian of the angle: [2xy, y^2 - x^2; y^2 - x^2, -2xy] / r^4.
        let (a, c) = (2.0 * x * y, y * y - x * x);
        let curved = (c + -a * 0.3) / square.powi(2);
        let expected = [y.atan2(x), by(1.0, 0.3), by(0.0, 1.0), curved];
        assert_close(&found, &expected, 1e-3, &format!("{x}, {y}"));
    }
}

#[test]
fn interpreter_and_generated_code_agree_in_hyper_dual_numbers() {
    let program =
        program(governor::DECLARATION.parse().expect("tokens")).unwrap_or_else(|mistakes| panic!("{mistakes:?}"));
    let number = |k: usize, value: f64| {
        let k = k as f64;
        Hyper::new([value, (k + 1.0).sin(), (2.0 * k).cos(), 0.1 * k])
    };
    let description = Governor::DESCRIPTION;
    let design = description.design.iter().map(|info| info.nominal);
    let arguments = [
        vec![number(0, 0.7)],
        vec![number(1, 12.0), number(2, 0.08)],
        design.enumerate().map(|(k, value)| number(k + 3, value)).collect(),
    ];
    let slices = arguments.each_ref().map(Vec::as_slice);
    for name in ["residual", "residual_and_stiffness", "linear", "outputs"] {
        let found = interpret(program.kernel(name).expect("a kernel"), &slices);
        let expected = evaluate(&Governor, name, &arguments).expect("in the contract");
        assert_eq!(found, expected, "{name}");
        assert!(found.concat().iter().all(|x| x.parts().iter().all(|part| part.is_finite())));
    }
}
