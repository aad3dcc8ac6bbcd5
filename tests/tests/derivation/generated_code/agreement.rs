//! Interpreter and generated code agree to the last bit in every number of every kernel of every machine.

use eigentol::{Array, Kernels, Linear, LinearPartials, Mechanism, PartialsOf, Square};
use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::program::Program;
use eigentol_compiler::{compile, program};
use eigentol_consistency::interpreter::interpret;
use eigentol_tests::corpus::{Visitor, declarations, visit};
use eigentol_tests::generated::evaluate;
use proc_macro2::TokenStream;

use super::Numbers;

fn tokens(declaration: &str) -> TokenStream {
    declaration.parse().expect("the text has tokens")
}

fn interpreted(name: &str, declaration: &str) -> Program {
    program(tokens(declaration)).unwrap_or_else(|mistakes| panic!("{name}: {mistakes:?}"))
}

/// The compiler's interpreter takes sine and cosine from the standard library, while the runtime has its own: they
/// agree except for rounding.
fn near(values: &[Vec<f64>], expected: &[Vec<f64>], name: &str, kernel: &str) {
    for (found, expected) in values.iter().zip(expected) {
        assert_eq!(found.len(), expected.len(), "{name} {kernel}");
        let largest = expected.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
        for (one, other) in found.iter().zip(expected) {
            assert!((one - other).abs() <= 1e-10 * largest, "{name} {kernel}: compiler {one:e}, runtime {other:e}");
        }
    }
}

#[derive(Default)]
struct Agreement {
    machines: usize,
    kernels: usize,
    numbers: usize,
}

impl Visitor for Agreement {
    fn visit<M: Mechanism + Copy>(&mut self, name: &'static str, declaration: &'static str, machine: M) {
        let program = interpreted(name, declaration);
        let mut numbers = Numbers::new(1);
        for kernel in &program.kernels {
            let parameters: Vec<(&str, usize)> =
                kernel.parameters.iter().map(|parameter| (parameter.name, parameter.entries.len())).collect();
            for _ in 0..5 {
                let arguments = numbers.arguments(&machine, &parameters);
                let slices: Vec<&[f64]> = arguments.iter().map(Vec::as_slice).collect();
                let expected = interpret(kernel, &slices);
                near(&kernel.evaluate(&slices), &expected, name, kernel.name);
                let Some(found) = evaluate(&machine, kernel.name, &arguments) else {
                    match kernel.name {
                        "pose_margin" => {
                            let volumes = expected[0].iter().map(|volume| volume.abs());
                            let least = volumes.min_by(f64::total_cmp);
                            assert_eq!(pose_margin(&machine, &arguments), least, "{name}");
                        }
                        other => assert_eq!(other, "violation", "{name}"),
                    }
                    continue;
                };
                for (array, (found, expected)) in found.iter().zip(&expected).enumerate() {
                    assert_eq!(found.len(), expected.len(), "{name} {}", kernel.name);
                    for (entry, (one, other)) in found.iter().zip(expected).enumerate() {
                        assert!(
                            one.to_bits() == other.to_bits() && one.is_finite(),
                            "{name} {} [{array}][{entry}]: generated {one:e}, interpreted {other:e}",
                            kernel.name
                        );
                        self.numbers += 1;
                    }
                }
                assert_eq!(found.len(), expected.len(), "{name} {}", kernel.name);
            }
            self.kernels += 1;
        }
        self.machines += 1;
        assert_eq!(M::DESCRIPTION.kernels.len(), program.kernels.len(), "{name}");
    }
}

/// The pose margin from generated code at `q`, `u`, `b`.
fn pose_margin(machine: &dyn Kernels, arguments: &[Vec<f64>]) -> Option<f64> {
    let [q, u, b] = arguments else { panic!("three arguments") };
    machine.pose_margin(q, u, b).map(|pose| pose.margin)
}

#[test]
fn generated_code_computes_what_the_interpreter_computes() {
    let mut agreement = Agreement::default();
    visit(&mut agreement);
    assert_eq!(agreement.machines, declarations().len());
    assert!(agreement.kernels >= 15 * agreement.machines);
    assert!(agreement.numbers > 50_000, "{}", agreement.numbers);
}

/// Violates requirements one at a time: the generated check must name the quantity that the interpreter finds not
/// positive.
struct Requirements {
    broken: usize,
}

impl Visitor for Requirements {
    fn visit<M: Mechanism + Copy>(&mut self, name: &'static str, declaration: &'static str, machine: M) {
        self.check(name, declaration, &machine);
    }
}

impl Requirements {
    fn check(&mut self, name: &str, declaration: &str, machine: &dyn Kernels) {
        let program = interpreted(name, declaration);
        let kernel = program.kernel("violation").expect("a check");
        let description = machine.description();
        // The curves of one machine start at a higher speed.
        let input = if name == "film_rotor" { 500.0 } else { 1.0 };
        let inputs = vec![input; description.inputs.len()];
        let nominal: Vec<f64> = description.design.iter().map(|info| info.nominal).collect();
        assert_eq!(machine.violation(&inputs, &nominal), None, "{name}");
        for j in 0..nominal.len() {
            for value in [0.0, -0.0, -1.0, -nominal[j], f64::NAN, f64::NEG_INFINITY] {
                let mut design = nominal.clone();
                design[j] = value;
                let values = &kernel.evaluate(&[&inputs, &design])[0];
                let expected = values.iter().copied().find(|value| value.is_nan() || *value <= 0.0);
                let found = machine.violation(&inputs, &design).map(|violation| violation.value);
                assert_eq!(
                    found.map(f64::to_bits),
                    expected.map(f64::to_bits),
                    "{name}: {} = {value}",
                    description.design[j].name
                );
                self.broken += usize::from(found.is_some());
            }
        }
    }
}

#[test]
fn generated_requirements_are_the_interpreters() {
    let mut requirements = Requirements { broken: 0 };
    visit(&mut requirements);
    assert!(requirements.broken > 100, "{}", requirements.broken);
}

/// Where the compiler leaves explicit partial derivatives to the runtime, they equal those it would have generated.
struct Columns {
    machines: usize,
}

impl Visitor for Columns {
    fn visit<M: Mechanism + Copy>(&mut self, name: &'static str, declaration: &'static str, machine: M) {
        if M::DESCRIPTION.kernels.iter().any(|kernel| kernel.name == "linear_partials") {
            return;
        }
        self.machines += 1;
        let everything = Limits::NONE;
        let program = compile(tokens(declaration), everything).expect("it compiles").program;
        let kernel = program.kernel("linear_partials").expect("no limit");
        let arguments = Numbers::new(2).point(&machine);
        let slices: Vec<&[f64]> = arguments.iter().map(Vec::as_slice).collect();
        let expected = kernel.evaluate(&slices);
        let found = evaluate(&machine, "linear_partials", &arguments).expect("in the contract");
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(&expected) {
            assert_eq!(found.len(), expected.len());
            let scale = expected.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
            for (one, other) in found.iter().zip(expected) {
                assert!((one - other).abs() <= 1e-12 * scale, "{name}: {one:e}, not {other:e}");
            }
        }
    }
}

#[test]
fn large_machines_get_their_partials_column_by_column() {
    let mut columns = Columns { machines: 0 };
    visit(&mut columns);
    // One has too many entries, a beam too many operations.
    assert_eq!(columns.machines, 2);
}

/// Writes partial derivatives into a result that held those of other states.
#[derive(Default)]
struct Reused {
    machines: usize,
    /// Number of entries in the largest result that is not completely overwritten.
    largest: usize,
}

impl Visitor for Reused {
    fn visit<M: Mechanism + Copy>(&mut self, name: &'static str, _: &'static str, machine: M) {
        let mut numbers = Numbers::new(6);
        let mut result = zeros::<M>();
        for _ in 0..3 {
            let arguments = numbers.point(&machine);
            let q = Array::view(&arguments[0]);
            let u = Array::view(&arguments[1]);
            let b = Array::view(&arguments[2]);
            Mechanism::linear_partials_into(&machine, q, u, b, &mut result);
            let new = machine.linear_partials(q, u, b);
            assert_eq!(entries::<M>(&result), entries::<M>(&new), "{name}");
        }
        let mut marked = zeros::<M>();
        for matrices in marked.by_coordinate.as_mut() {
            matrices.damping = filled::<M>(f64::NAN);
        }
        let (q, u, b) = (Array::filled(0.1), Array::filled(1.0), Array::filled(1.0));
        Mechanism::linear_partials_into(&machine, &q, &u, &b, &mut marked);
        let entries = entries::<M>(&marked);
        if entries.iter().any(|entry| entry.is_nan()) {
            self.largest = self.largest.max(entries.len());
        }
        self.machines += 1;
    }
}

fn filled<M: Mechanism>(value: f64) -> Square<M, f64> {
    Array::filled(Array::filled(value))
}

/// An initial buffer for partial derivatives.
fn zeros<M: Mechanism>() -> Box<PartialsOf<M, f64>> {
    let zero = Linear { mass: filled::<M>(0.0), damping: filled::<M>(0.0), stiffness: filled::<M>(0.0) };
    Box::new(LinearPartials {
        by_coordinate: Array::filled(zero),
        by_input: Array::filled(zero),
        by_design: Array::filled(zero),
    })
}

fn entries<M: Mechanism>(partials: &PartialsOf<M, f64>) -> Vec<f64> {
    let lists = [partials.by_coordinate.as_ref(), partials.by_input.as_ref(), partials.by_design.as_ref()];
    let matrices =
        lists.into_iter().flatten().flat_map(|one: &Linear<Square<M, f64>>| [&one.mass, &one.damping, &one.stiffness]);
    let rows = matrices.flat_map(|matrix| matrix.as_ref());
    rows.flat_map(|row| row.as_ref()).copied().collect()
}

#[test]
fn partials_into_a_used_result_are_those_of_a_new_one() {
    let mut reused = Reused::default();
    visit(&mut reused);
    assert_eq!(reused.machines, declarations().len());
    assert!(reused.largest > 4096, "{}", reused.largest);
}

/// A keyword that no machine uses is not covered by the tests above.
#[test]
fn the_corpus_uses_the_whole_language() {
    let text: String = declarations().iter().map(|(_, declaration)| *declaration).collect();
    let words: Vec<String> = tokens(&text).into_iter().flat_map(words_of).collect();
    for word in [
        "input",
        "design",
        "let",
        "gravity",
        "body",
        "joint",
        "point",
        "force",
        "output",
        "massless",
        "rod",
        "disk",
        "cylinder",
        "box",
        "sphere",
        "rigid",
        "center",
        "inertia",
        "size",
        "axis",
        "along",
        "fixed",
        "revolute",
        "prismatic",
        "screw",
        "lead",
        "cylindrical",
        "universal",
        "planar",
        "spherical",
        "free",
        "tube",
        "density",
        "inner",
        "outer",
        "about",
        "at",
        "rotated",
        "on",
        "driven",
        "spring",
        "damper",
        "spring_damper",
        "tension",
        "law",
        "generalized",
        "potential",
        "energy",
        "bushing",
        "turning_stiffness",
        "turning_damping",
        "load",
        "follower",
        "moment",
        "drag",
        "rest",
        "length",
        "rate",
        "damping",
        "sqrt",
        "sin",
        "cos",
        "tan",
        "asin",
        "acos",
        "atan",
        "atan2",
        "exp",
        "ln",
        "norm",
        "dot",
        "cross",
        "position",
        "distance",
        "distance_from_axis",
        "angle",
        "reaction_force",
        "reaction_moment",
        "kinetic_energy",
        "potential_energy",
        "pi",
    ] {
        assert!(words.iter().any(|known| known == word), "no machine uses `{word}`");
    }
}

fn words_of(token: proc_macro2::TokenTree) -> Vec<String> {
    match token {
        proc_macro2::TokenTree::Group(group) => group.stream().into_iter().flat_map(words_of).collect(),
        other => vec![other.to_string()],
    }
}
