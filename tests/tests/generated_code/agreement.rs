//! Interpreter and generated code: every number the same to the last bit, for every kernel of every machine.

use eigentol::{LinearPartials, Mechanism};
use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::program::Program;
use eigentol_compiler::{compile, program};
use eigentol_consistency::interpreter::interpret;
use eigentol_tests::corpus::{Visitor, corpus, visit};
use eigentol_tests::generated::evaluate;
use proc_macro2::TokenStream;

use super::Numbers;

fn tokens(declaration: &str) -> TokenStream {
    declaration.parse().expect("the text has tokens")
}

fn interpreted(name: &str, declaration: &str) -> Program {
    program(tokens(declaration)).unwrap_or_else(|mistakes| panic!("{name}: {mistakes:?}"))
}

/// The compiler's own interpreter takes sine and cosine from the standard library, the runtime has its own: rounding apart.
fn near(found: &[Vec<f64>], expected: &[Vec<f64>], name: &str, kernel: &str) {
    for (found, expected) in found.iter().zip(expected) {
        assert_eq!(found.len(), expected.len(), "{name} {kernel}");
        let largest = expected.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
        for (one, other) in found.iter().zip(expected) {
            assert!(
                (one - other).abs() <= 1e-10 * largest,
                "{name} {kernel}: compiler {one:e}, runtime {other:e}"
            );
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
    fn visit<M, const N: usize, const U: usize, const P: usize, const O: usize>(
        &mut self,
        name: &'static str,
        declaration: &'static str,
        machine: M,
    ) where
        M: Mechanism<N, U, P, O> + Copy,
    {
        let program = interpreted(name, declaration);
        let mut numbers = Numbers::new(1);
        for kernel in &program.kernels {
            let parameters: Vec<(&str, usize)> = kernel
                .parameters
                .iter()
                .map(|parameter| (parameter.name, parameter.entries.len()))
                .collect();
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
        assert_eq!(
            M::DESCRIPTION.kernels.len(),
            program.kernels.len(),
            "{name}"
        );
    }
}

/// The generated distance from singular poses at `q`, `u`, `b`.
fn pose_margin<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    machine: &M,
    arguments: &[Vec<f64>],
) -> Option<f64>
where
    M: Mechanism<N, U, P, O>,
{
    let [q, u, b] = arguments else {
        panic!("three arguments")
    };
    let q: [f64; N] = q[..].try_into().expect("coordinates");
    let u: [f64; U] = u[..].try_into().expect("inputs");
    let b: [f64; P] = b[..].try_into().expect("design variables");
    machine.pose_margin(&q, &u, &b).map(|pose| pose.margin)
}

#[test]
fn generated_code_computes_what_the_interpreter_computes() {
    let mut agreement = Agreement::default();
    visit(&mut agreement);
    assert_eq!(agreement.machines, corpus().len());
    assert!(agreement.kernels >= 15 * agreement.machines);
    assert!(agreement.numbers > 50_000, "{}", agreement.numbers);
}

/// Requirements: broken one at a time, the generated check names what the interpreter finds not positive.
struct Requirements {
    broken: usize,
}

impl Visitor for Requirements {
    fn visit<M, const N: usize, const U: usize, const P: usize, const O: usize>(
        &mut self,
        name: &'static str,
        declaration: &'static str,
        machine: M,
    ) where
        M: Mechanism<N, U, P, O> + Copy,
    {
        let program = interpreted(name, declaration);
        let kernel = program.kernel("violation").expect("a check");
        let inputs = [1.0; U];
        let nominal: [f64; P] = std::array::from_fn(|j| M::DESCRIPTION.design[j].nominal);
        assert_eq!(machine.violation(&inputs, &nominal), None, "{name}");
        for j in 0..P {
            for value in [0.0, -0.0, -1.0, -nominal[j], f64::NAN, f64::NEG_INFINITY] {
                let mut design = nominal;
                design[j] = value;
                let values = &kernel.evaluate(&[&inputs, &design])[0];
                let expected = values
                    .iter()
                    .copied()
                    .find(|value| value.is_nan() || *value <= 0.0);
                let found = machine
                    .violation(&inputs, &design)
                    .map(|violation| violation.value);
                assert_eq!(
                    found.map(f64::to_bits),
                    expected.map(f64::to_bits),
                    "{name}: {} = {value}",
                    M::DESCRIPTION.design[j].name
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

/// Where the compiler leaves the explicit partial derivatives to the runtime, they are those it would have written.
struct Columns {
    machines: usize,
}

impl Visitor for Columns {
    fn visit<M, const N: usize, const U: usize, const P: usize, const O: usize>(
        &mut self,
        name: &'static str,
        declaration: &'static str,
        machine: M,
    ) where
        M: Mechanism<N, U, P, O> + Copy,
    {
        if M::DESCRIPTION
            .kernels
            .iter()
            .any(|kernel| kernel.name == "linear_partials")
        {
            return;
        }
        self.machines += 1;
        let everything = Limits::NONE;
        let program = compile(tokens(declaration), everything)
            .expect("it compiles")
            .program;
        let kernel = program.kernel("linear_partials").expect("no limit");
        let parameters = [("q", N), ("u", U), ("b", P)];
        let arguments = Numbers::new(2).arguments(&machine, &parameters);
        let slices: Vec<&[f64]> = arguments.iter().map(Vec::as_slice).collect();
        let expected = kernel.evaluate(&slices);
        let found = evaluate(&machine, "linear_partials", &arguments).expect("in the contract");
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(&expected) {
            assert_eq!(found.len(), expected.len());
            let scale = expected
                .iter()
                .fold(0.0, |most: f64, value| most.max(value.abs()));
            for (one, other) in found.iter().zip(expected) {
                assert!(
                    (one - other).abs() <= 1e-12 * scale,
                    "{name}: {one:e}, not {other:e}"
                );
            }
        }
    }
}

#[test]
fn large_machines_get_their_partials_column_by_column() {
    let mut columns = Columns { machines: 0 };
    visit(&mut columns);
    assert_eq!(columns.machines, 1);
}

/// Partial derivatives into a result that held those of other states.
#[derive(Default)]
struct Reused {
    machines: usize,
    /// Entries of the largest result of which not everything is set anew.
    largest: usize,
}

impl Visitor for Reused {
    fn visit<M, const N: usize, const U: usize, const P: usize, const O: usize>(
        &mut self,
        name: &'static str,
        _: &'static str,
        machine: M,
    ) where
        M: Mechanism<N, U, P, O> + Copy,
    {
        let mut numbers = Numbers::new(6);
        let mut result: Box<LinearPartials<f64, N, U, P>> = Box::default();
        for _ in 0..3 {
            let arguments = numbers.arguments(&machine, &[("q", N), ("u", U), ("b", P)]);
            let q = arguments[0][..].try_into().expect("N");
            let u = arguments[1][..].try_into().expect("U");
            let b = arguments[2][..].try_into().expect("P");
            machine.linear_partials_into(q, u, b, &mut result);
            assert_eq!(*result, machine.linear_partials(q, u, b), "{name}");
        }
        let mut marked = LinearPartials::default();
        for matrices in &mut marked.by_coordinate {
            matrices.damping = [[f64::NAN; N]; N];
        }
        machine.linear_partials_into(&[0.1; N], &[1.0; U], &[1.0; P], &mut marked);
        let kept = |list: &[eigentol::Linear<f64, N>]| {
            let entries = list.iter().flat_map(|one| one.damping.as_flattened());
            entries.filter(|entry| entry.is_nan()).count()
        };
        if kept(&marked.by_coordinate) > 0 {
            self.largest = self.largest.max(3 * N * N * (N + U + P));
        }
        self.machines += 1;
    }
}

#[test]
fn partials_into_a_used_result_are_those_of_a_new_one() {
    let mut reused = Reused::default();
    visit(&mut reused);
    assert_eq!(reused.machines, corpus().len());
    assert!(reused.largest > 4096, "{}", reused.largest);
}

/// A word of the language that no machine uses is a word that the tests above say nothing about.
#[test]
fn the_corpus_uses_the_whole_language() {
    let text: String = corpus()
        .iter()
        .map(|(_, declaration)| *declaration)
        .collect();
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
        assert!(
            words.iter().any(|known| known == word),
            "no machine uses `{word}`"
        );
    }
}

fn words_of(token: proc_macro2::TokenTree) -> Vec<String> {
    match token {
        proc_macro2::TokenTree::Group(group) => {
            group.stream().into_iter().flat_map(words_of).collect()
        }
        other => vec![other.to_string()],
    }
}
