//! Ten real robots against Pinocchio (`tests/truth/robots`, made from public robot files): every kernel at five states
//! per robot, and every kernel against the equations of motion.

use std::fs;
use std::path::Path;

use eigentol::Mechanism;
use eigentol_compiler::mechanics::Limits;
use eigentol_consistency::check::check;
use eigentol_consistency::interpreter::{interpret, interpret_along};
use eigentol_consistency::subject::Subject;
use eigentol_tests::generated::evaluate;
use eigentol_tests::robots::{self, Solo12Free, Ur5};
use proc_macro2::TokenStream;
use serde_json::Value;

const ROBOTS: [&str; 10] =
    ["AnymalC", "Baxter", "G1", "Icub", "Kinova", "Panda", "Solo12Free", "TalosArm", "Ur5", "Xarm7"];

/// Tolerance relative to the largest entry of an array.
const TOLERANCE: f64 = 1e-9;

fn read(file: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("truth/robots").join(file);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().unwrap_or_else(|| panic!("a list, not {value}"));
    list.iter().map(|x| x.as_f64().expect("a number")).collect()
}

/// Evaluates a kernel by its name.
type Evaluate<'a> = dyn Fn(&str, &[&[f64]]) -> Vec<Vec<f64>> + 'a;

struct Robot {
    subject: Subject,
    truth: Value,
    /// For each unknown, its index among the coordinates of the reference.
    order: Vec<usize>,
    /// Values of the design variables.
    design: Vec<f64>,
}

impl Robot {
    fn load(name: &str) -> Self {
        let truth: Value = serde_json::from_str(&read(&format!("{name}.json"))).expect("JSON");
        let text = read(&format!("{name}.mech"));
        let subject = Subject::new(&text, Limits::default()).unwrap_or_else(|mistakes| panic!("{name}: {mistakes:?}"));
        let names: Vec<&str> =
            truth["coordinates"].as_array().expect("names").iter().filter_map(Value::as_str).collect();
        let place = |name: &String| {
            let found = names.iter().position(|other| other == name);
            found.unwrap_or_else(|| panic!("`{name}` is among {names:?}"))
        };
        let order: Vec<usize> = subject.unknowns.iter().map(place).collect();
        assert_eq!(order.len(), names.len(), "{name}");
        let value = |name: &String| truth["design"][name].as_f64().expect("a design variable");
        let design = subject.design.iter().map(value).collect();
        Self { subject, truth, order, design }
    }

    /// Values by unknown, from the order of the reference.
    fn ordered(&self, list: &Value) -> Vec<f64> {
        let list = numbers(list);
        self.order.iter().map(|&place| list[place]).collect()
    }

    fn interpreted(&self, kernel: &str, arguments: &[&[f64]]) -> Vec<Vec<f64>> {
        let kernel_of = |name: &str| {
            let found = self.subject.program.kernel(name);
            found.unwrap_or_else(|| panic!("no kernel `{name}`"))
        };
        match kernel {
            "linear_along" => interpret_along(kernel_of("linear"), &arguments[..3], &arguments[3..]),
            _ => interpret(kernel_of(kernel), arguments),
        }
    }

    /// The largest error of each quantity over all states, for kernels run by `evaluate`.
    fn errors(&self, evaluate: &Evaluate) -> Vec<(&'static str, f64)> {
        let mut errors: Vec<(&'static str, f64)> = Vec::new();
        // where a quantity is zero, the reference contains rounding errors of 1e-14
        let mut compare = |what, values: &[f64], expected: &[f64]| {
            assert_eq!(values.len(), expected.len(), "{what}");
            let size = expected.iter().fold(1e-4_f64, |size, x| size.max(x.abs()));
            let pairs = values.iter().zip(expected);
            let error = pairs.fold(0.0_f64, |worst, (a, b)| match (a - b).abs() / size {
                error if error.is_finite() => worst.max(error),
                _ => f64::INFINITY,
            });
            match errors.iter_mut().find(|(known, _)| *known == what) {
                Some((_, worst)) => *worst = worst.max(error),
                None => errors.push((what, error)),
            }
        };
        let b = &self.design[..];
        let states = self.truth["states"].as_array().expect("states");
        assert_eq!(states.len(), 5);
        for state in states {
            let get = |field: &str| self.ordered(&state[field]);
            let (q, v, a, w) = (get("q"), get("v"), get("a"), get("w"));
            let n = q.len();
            let times = |matrix: &[f64]| -> Vec<f64> {
                let rows = matrix.chunks_exact(n);
                rows.map(|row| row.iter().zip(&w).map(|(m, w)| m * w).sum()).collect()
            };
            let at = [&q[..], &[], b];
            let moving = [&a[..], &v, &q, &[], b];

            compare("residual", &evaluate("residual", &at)[0], &get("tau_rest"));
            let found = evaluate("motion_residual", &moving);
            compare("motion residual", &found[0], &get("tau"));
            let found = evaluate("motion", &[&v, &q, &[], b]);
            let bias: Vec<f64> = found[1].iter().map(|force| -force).collect();
            compare("motion: force", &bias, &get("bias"));
            compare("motion: mass", &times(&found[0]), &get("mass_w"));
            let found = evaluate("residual_and_stiffness", &at);
            compare("stiffness with residual", &times(&found[1]), &get("rest_dq_w"));
            let found = evaluate("linear", &at);
            compare("mass", &times(&found[0]), &get("mass_w"));
            compare("stiffness", &times(&found[2]), &get("rest_dq_w"));
            let found = evaluate("motion_linear", &moving);
            compare("mass along a motion", &times(&found[0]), &get("mass_w"));
            compare("damping along a motion", &times(&found[1]), &get("dv_w"));
            compare("stiffness along a motion", &times(&found[2]), &get("dq_w"));

            let lambda = [state["lambda"].as_f64().expect("lambda")];
            let partials = evaluate("residual_partials", &at);
            let gradient = evaluate("mode_gradient", &[&q, &[], b, &w, &lambda]);
            for (k, name) in self.subject.design.iter().enumerate() {
                let column: Vec<f64> = partials[1].chunks_exact(b.len()).map(|row| row[k]).collect();
                compare("residual by design", &column, &self.ordered(&state["by_design"][name]));
                let expected = state["mode_by_design"][name].as_f64().expect("a number");
                compare("mode by design", &[gradient[2][k]], &[expected]);
                // w^T (K - lambda M) w along the design variable, in dual numbers
                let mut along = vec![0.0; b.len()];
                along[k] = 1.0;
                let still = vec![0.0; n];
                let slopes = evaluate("linear_along", &[&q, &[], b, &still, &[], &along]);
                let form = |matrix: &[f64]| -> f64 { times(matrix).iter().zip(&w).map(|(x, w)| x * w).sum() };
                let found = form(&slopes[2]) - lambda[0] * form(&slopes[0]);
                compare("matrices by design", &[found], &[expected]);
            }
            // by eighth-order differences
            compare("mode by coordinates", &gradient[0], &get("mode_by_q"));
        }
        errors
    }
}

fn assert_right(name: &str, errors: Vec<(&'static str, f64)>) {
    assert_eq!(errors.len(), 14);
    for (what, error) in errors {
        assert!(error <= TOLERANCE, "{name}: {what} is off by {error:e}");
    }
}

#[test]
fn robots_are_those_of_pinocchio() {
    for name in ROBOTS {
        let robot = Robot::load(name);
        let errors = robot.errors(&|kernel, arguments| robot.interpreted(kernel, arguments));
        assert_right(name, errors);
    }
}

fn compiled<M: Mechanism>(machine: &M, kernel: &str, arguments: &[&[f64]]) -> Vec<Vec<f64>> {
    let arguments: Vec<Vec<f64>> = arguments.iter().map(|list| list.to_vec()).collect();
    evaluate(machine, kernel, &arguments).unwrap_or_else(|| panic!("no kernel `{kernel}`"))
}

/// The declarations compiled by the macro match the files.
#[test]
fn compiled_robots_are_those_of_pinocchio() {
    let tokens = |text: &str| -> String {
        let tokens: TokenStream = text.parse().expect("tokens");
        tokens.to_string()
    };
    for (name, declaration) in [("Ur5", robots::ur5::DECLARATION), ("Solo12Free", robots::solo::DECLARATION)] {
        let file = tokens(&read(&format!("{name}.mech")));
        assert!(tokens(declaration).ends_with(&file), "{name}");
    }
    let arm = Robot::load("Ur5");
    assert_right("Ur5", arm.errors(&|kernel, list| compiled(&Ur5, kernel, list)));
    let walker = Robot::load("Solo12Free");
    let errors = walker.errors(&|kernel, list| compiled(&Solo12Free, kernel, list));
    assert_right("Solo12Free", errors);
}

#[test]
fn kernels_of_robots_are_consistent() {
    for name in ROBOTS {
        let robot = Robot::load(name);
        let outcome = check(&robot.subject, &robot.subject.state(1));
        assert!(outcome.differences.is_empty(), "{name}: {:#?}", outcome.differences);
        assert!(20 * outcome.blurred < outcome.compared, "{name}: {}", outcome.blurred);
    }
}

/// A comparison that cannot fail proves nothing: a design variable that is off by one part in 10^8 shows in
/// every quantity it affects.
#[test]
fn a_small_fault_is_found() {
    let mut robot = Robot::load("Ur5");
    let length = robot.subject.design.iter().position(|name| name == "offset_of_elbow_joint");
    robot.design[length.expect("a length")] *= 1.0 + 1e-8;
    let errors = robot.errors(&|kernel, arguments| robot.interpreted(kernel, arguments));
    let wrong = errors.iter().filter(|(_, error)| *error > TOLERANCE);
    assert!(wrong.count() >= 8, "{errors:?}");
}
