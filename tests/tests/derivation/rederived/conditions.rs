//! `P1`, `P2`, `P3`: every first and second derivative in the files, undamped and for the whole pencil.

use eigentol_oracle::truth::Truth;
use eigentol_tests::corpus::{rotating_double_pendulum, rotating_pendulum, sliders_on_plate};
use eigentol_tests::rederived::{ComplexDerived, Derived, Machine};

use super::common::{assert_close, largest};

/// The positions of a file's variables among those of a machine; the speed is the only input.
struct Variables {
    names: Vec<String>,
    places: Vec<usize>,
}

impl Variables {
    fn new(condition: &Truth, design: &[&str]) -> Self {
        let names: Vec<String> =
            condition.get("design").list().iter().map(|variable| variable.get("name").text()).collect();
        let place = |name: &String| {
            let design_place = design.iter().position(|value| value == name);
            design_place.unwrap_or_else(|| {
                assert_eq!(name, "Omega");
                design.len()
            })
        };
        let places = names.iter().map(place).collect();
        Self { names, places }
    }

    fn gradient(&self, derived: &Derived) -> Vec<f64> {
        let places = self.places.iter();
        places.map(|&place| derived.gradient[place]).collect()
    }

    fn hessian(&self, derived: &Derived) -> Vec<f64> {
        let pick = |&i: &usize| self.places.iter().map(move |&j| derived.hessian[i][j]);
        self.places.iter().flat_map(pick).collect()
    }

    /// A gradient from the file, whatever lists its fields contain.
    fn by_name<T>(&self, gradient: &Truth, read: impl Fn(&Truth) -> T) -> Vec<T> {
        let names = self.names.iter();
        names.map(|name| read(&gradient.get(name))).collect()
    }

    fn check(&self, derived: &Derived, truth: &Truth, fields: [&str; 3], what: &str) {
        let [value, gradient, hessian] = fields;
        let what = format!("{what} {value}");
        assert_close(&[derived.value], &[truth.get(value).number()], 1e-6, &what);
        let expected = self.by_name(&truth.get(gradient), Truth::number);
        let scale = 1e-2 * largest(&expected);
        assert_close(&self.gradient(derived), &expected, scale, &format!("{what} gradient"));
        let expected = truth.get(hessian).matrix();
        let scale = 1e-2 * largest(&expected);
        assert_close(&self.hessian(derived), &expected, scale, &format!("{what} Hessian"));
    }

    fn check_complex(&self, complex_derived: &ComplexDerived, truth: &Truth, what: &str) {
        let rates = self.by_name(&truth.get("ds_db"), Truth::numbers);
        let curvatures: Vec<Vec<f64>> = truth
            .get("d2s_db2")
            .list()
            .iter()
            .flat_map(|row| row.list().iter().map(Truth::numbers).collect::<Vec<_>>())
            .collect();
        for (k, part) in [&complex_derived.re, &complex_derived.im].into_iter().enumerate() {
            let values = |list: &[Vec<f64>]| list.iter().map(|pair| pair[k]).collect::<Vec<_>>();
            let what = format!("{what} part {k} of s");
            assert_close(&[part.value], &[truth.get("s").numbers()[k]], 1.0, &what);
            let expected = values(&rates);
            let scale = 1e-2 * largest(&rates.concat());
            assert_close(&self.gradient(part), &expected, scale, &what);
            let expected = values(&curvatures);
            let scale = 1e-2 * largest(&curvatures.concat());
            assert_close(&self.hessian(part), &expected, scale, &what);
        }
    }
}

/// Checks all conditions of a file; `design` lists its names in the machine's order. Returns the number of nonzero
/// second derivatives.
fn check(declaration: &str, file: &str, design: &[&str]) -> usize {
    let machine = Machine::new(declaration);
    let mut curved = 0;
    for condition in Truth::load(file).get("conditions").list() {
        let what = format!("{file} {}", condition.get("label").text());
        let parameters = condition.get("parameters");
        let b: Vec<f64> = design.iter().map(|name| parameters.get(name).number()).collect();
        let start = condition.get("q_start").numbers();
        let state = machine.at(&[parameters.get("Omega").number()], &b, &start);
        let variables = Variables::new(&condition, design);

        let q_star = condition.get("q_star");
        let names = q_star.fields();
        let shifts = condition.get("dq_star_db");
        let shifts = variables.by_name(&shifts, Truth::numbers);
        for (i, q) in state.equilibrium().iter().enumerate() {
            let expected = q_star.get(&names[i]).number();
            assert_close(&[q.value], &[expected], 1e-2, &what);
            let expected: Vec<f64> = shifts.iter().map(|shift| shift[i]).collect();
            assert_close(&variables.gradient(q), &expected, 1e-3, &what);
        }

        let modes = state.undamped_modes();
        let truths = condition.get("undamped_modes").list();
        assert_eq!(modes.len(), truths.len(), "{what}");
        for (mode, truth) in modes.iter().zip(&truths) {
            let mode = mode.as_ref().expect("a simple mode");
            let lambda = truth.get("lambda").number();
            assert_close(&[mode.lambda.value], &[lambda], 0.0, &what);
            let omega = mode.omega.as_ref().expect("it oscillates");
            let fields = ["omega", "domega_db", "d2omega_db2"];
            variables.check(omega, truth, fields, &what);
            let phi = truth.get("phi_M_normalised").numbers();
            let side = phi[mode.lead].signum();
            let shape: Vec<f64> = mode.shape.iter().map(|x| side * x.value).collect();
            assert_close(&shape, &phi, 1e-2, &what);
            let hessian = variables.hessian(omega);
            curved += hessian.iter().filter(|x| x.abs() > 1e-9).count();
        }

        let modes = state.general_modes();
        let of_pencil = condition.get("quadratic_modes");
        if file != "P3" {
            // Without damping, the file refers to the undamped modes.
            for (mode, truth) in modes.iter().zip(&truths) {
                let mode = mode.as_ref().expect("a simple mode");
                for number in [&mode.s.im, &mode.magnitude] {
                    let fields = ["omega", "domega_db", "d2omega_db2"];
                    variables.check(number, truth, fields, &what);
                }
            }
            continue;
        }
        assert_eq!(modes.len(), of_pencil.list().len(), "{what}");
        for (mode, truth) in modes.iter().zip(of_pencil.list()) {
            let mode = mode.as_ref().expect("a simple mode");
            variables.check_complex(&mode.s, &truth, &what);
            let fields = ["omega_n", "domega_n_db", "d2omega_n_db2"];
            variables.check(&mode.magnitude, &truth, fields, &what);
            let fields = ["omega_d", "domega_d_db", "d2omega_d_db2"];
            variables.check(&mode.s.im, &truth, fields, &what);
            let ratio = truth.get("zeta").number();
            assert_close(&[mode.damping_ratio.value], &[ratio], 1e-3, &what);
        }
    }
    curved
}

#[test]
fn rotating_pendulum() {
    assert!(check(rotating_pendulum::DECLARATION, "P1", &["L", "m"]) > 10);
}

#[test]
fn rotating_double_pendulum() {
    let design = ["L1", "L2", "m1", "m2"];
    assert!(check(rotating_double_pendulum::DECLARATION, "P2", &design) > 150);
}

#[test]
fn sliders_on_a_spinning_plate() {
    let design = ["m", "kx", "ky", "x0", "y0", "cx", "cy"];
    assert!(check(sliders_on_plate::DECLARATION, "P3", &design) > 30);
}
