//! Kernels of an imported robot against numbers from Pinocchio.

use eigentol_compiler::mechanics::{Limits, Role};
use eigentol_consistency::interpreter::interpret;
use eigentol_consistency::subject::Subject;
use eigentol_urdf::{Base, Import, Options, import};
use serde_json::Value;

/// Tolerance relative to the largest entry of an array.
pub(crate) const TOLERANCE: f64 = 1e-9;

/// The import options assumed by the reference numbers: springs and dampers on every coordinate, and no others.
pub(crate) fn options(floating: bool) -> Options {
    let base = if floating { Base::Floating } else { Base::Fixed };
    Options::default().base(base).damping(false)
}

/// An import that compiles.
pub(crate) struct Robot {
    pub(crate) import: Import,
    pub(crate) subject: Subject,
}

impl Robot {
    /// Compiles an import, with outputs for the positions of some points.
    pub(crate) fn new(text: &str, options: &Options, points: &[String]) -> Result<Self, String> {
        let import = import(text, options).map_err(|error| error.to_string())?;
        let mut declaration = import.declaration.clone();
        let end = declaration.rfind('}').expect("a closing brace");
        let outputs = points.iter().enumerate().flat_map(|(k, point)| {
            ["x", "y", "z"].map(|axis| format!("output place_{k}_{axis} = position({point}).{axis};\n"))
        });
        declaration.insert_str(end, &outputs.collect::<String>());
        let limits = Limits { explicit_partials: 0, ..Limits::default() };
        let subject = Subject::new(&declaration, limits).map_err(|mistakes| mistakes.join("\n"))?;
        Ok(Self { import, subject })
    }

    /// The name in the file for a name in the declaration.
    pub(crate) fn original<'a>(&'a self, name: &'a str) -> &'a str {
        self.import.names.get(name).map_or(name, String::as_str)
    }

    /// The name in the declaration for a name in the file.
    pub(crate) fn declared(&self, original: &str) -> String {
        let mut renamed = self.import.names.iter();
        let found = renamed.find(|(_, name)| *name == original);
        found.map_or(original, |(name, _)| name).to_owned()
    }

    /// The free coordinates, in the order of the unknowns.
    pub(crate) fn coordinates(&self) -> Vec<&str> {
        let unknowns = self.subject.unknowns.iter().zip(&self.subject.roles);
        let free = unknowns.filter(|(_, role)| matches!(role, Role::Position(_)));
        free.map(|(name, _)| self.original(name)).collect()
    }

    /// The first `count` points of the declaration, by name.
    pub(crate) fn points(&self, count: usize) -> Vec<String> {
        let lines = self.import.declaration.lines();
        let names = lines.filter_map(|line| line.trim().strip_prefix("point ")?.split(':').next());
        let names: Vec<String> = names.map(str::to_owned).collect();
        let step = names.len().div_ceil(count).max(1);
        names.into_iter().step_by(step).collect()
    }

    /// The largest error of each quantity over all states. Reactions of couplings are set to zero, as if nothing were
    /// coupled.
    pub(crate) fn errors(&self, names: &[&str], states: &[Value], points: &[String]) -> Vec<(&'static str, f64)> {
        let (own, n) = (self.coordinates(), self.subject.unknowns.len());
        let place = |name: &&str| names.iter().position(|other| other == name);
        let order: Option<Vec<usize>> = own.iter().map(place).collect();
        let order = order.unwrap_or_else(|| panic!("{own:?} are among {names:?}"));
        assert_eq!(own.len(), names.len());
        let kernel = |name: &str, arguments: &[&[f64]]| {
            interpret(self.subject.program.kernel(name).expect("a kernel"), arguments)
        };
        let mut worst: Vec<(&'static str, f64)> = Vec::new();
        let mut compare = |what, values: &[f64], expected: &[f64]| {
            // where a quantity is zero, the reference contains rounding errors of 1e-14
            let size = expected.iter().fold(1e-4_f64, |size, x| size.max(x.abs()));
            let pairs = values.iter().zip(expected);
            let error = pairs.fold(0.0_f64, |worst, (a, b)| match (a - b).abs() / size {
                error if error.is_finite() => worst.max(error),
                _ => f64::INFINITY,
            });
            match worst.iter_mut().find(|(known, _)| *known == what) {
                Some((_, worst)) => *worst = worst.max(error),
                None => worst.push((what, error)),
            }
        };
        for state in states {
            let get = |field: &str| -> Vec<f64> {
                let list = numbers(&state[field]);
                order.iter().map(|&place| list[place]).collect()
            };
            let unknowns = |field: &str| {
                let mut all = get(field);
                all.resize(n, 0.0);
                all
            };
            let (q, v, a, w) = (unknowns("q"), unknowns("v"), unknowns("a"), unknowns("w"));
            let times = |matrix: &[f64]| -> Vec<f64> {
                let rows = matrix.chunks_exact(n).take(own.len());
                rows.map(|row| row.iter().zip(&w).map(|(m, w)| m * w).sum()).collect()
            };
            compare("gravity", &kernel("residual", &[&q, &[], &[]])[0], &get("tau_rest"));
            let moving: [&[f64]; 5] = [&a, &v, &q, &[], &[]];
            compare("torque", &kernel("motion_residual", &moving)[0], &get("tau"));
            let motion = kernel("motion", &[&v, &q, &[], &[]]);
            let bias: Vec<f64> = motion[1].iter().map(|force| -force).collect();
            compare("bias", &bias, &get("bias"));
            compare("mass", &times(&motion[0]), &get("mass_w"));
            let linear = kernel("linear", &[&q, &[], &[]]);
            compare("stiffness", &times(&linear[2]), &get("rest_dq_w"));
            // For the largest robots this kernel would be too long.
            if self.subject.program.kernel("motion_linear").is_some() {
                let along = kernel("motion_linear", &moving);
                compare("mass along a motion", &times(&along[0]), &get("mass_w"));
                compare("damping along a motion", &times(&along[1]), &get("dv_w"));
                compare("stiffness along a motion", &times(&along[2]), &get("dq_w"));
            }
            let expected = points.iter().flat_map(|point| numbers(&state["points"][self.original(point)]));
            let expected: Vec<f64> = expected.collect();
            if !expected.is_empty() {
                let found = kernel("outputs", &[&q, &[], &[]]);
                compare("points", &found[0], &expected);
            }
        }
        worst
    }

    /// Panics if any quantity is wrong.
    pub(crate) fn assert_right(&self, what: &str, names: &[&str], states: &[Value], points: &[String]) -> f64 {
        let errors = self.errors(names, states, points);
        assert!(errors.len() >= 5, "{what}: {errors:?}");
        for (quantity, error) in &errors {
            assert!(*error <= TOLERANCE, "{what}: {quantity} is off by {error:e}");
        }
        errors.iter().fold(0.0, |worst, (_, error)| worst.max(*error))
    }
}

pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().unwrap_or_else(|| panic!("a list, not {value}"));
    list.iter().map(|x| x.as_f64().expect("a number")).collect()
}

pub(crate) fn texts(value: &Value) -> Vec<&str> {
    let list = value.as_array().unwrap_or_else(|| panic!("a list, not {value}"));
    list.iter().filter_map(Value::as_str).collect()
}
