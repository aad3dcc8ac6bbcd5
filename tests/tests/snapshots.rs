//! Every stage of the corpus as text, with operation counts: the diff shows the effect of a change, and its cost.

use eigentol_compiler::base::names::written;
use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::program::Program;
use eigentol_compiler::{Compilation, compile, early_stages, expand, expand_pretty};
use eigentol_tests::corpus::declarations;
use eigentol_tests::every;
use eigentol_tests::fits;
use eigentol_tests::loops::{geared_coasting, slider_crank};
use eigentol_tests::wheels::disk;
use insta::assert_snapshot;

/// Kernels short enough to read line by line; for the others only the counts are kept.
const READABLE: [&str; 3] = ["residual", "linear", "violation"];

/// Machines whose generated code is kept in full.
const GENERATED: [&str; 6] =
    ["rotating_pendulum", "rotating_double_pendulum", "turntable_slider", "geared_coasting", "fits", "conical"];

/// A pendulum that goes round with a declared speed.
const CONICAL: &str = "mechanism Conical {
    input speed: rpm;
    design l = 1 m;
    design n = 2;
    gravity 9.81 m/s^2 along -z;
    body shaft: massless;
    body bar: rod(mass: 1 kg, length: l, along: -z);
    joint spin: revolute(z) from ground to shaft, coasting;
    joint tilt: revolute(y) from shaft to bar;
    steady spin = speed / n;
}";

/// The corpus, a closed loop, running coordinates, a rolling wheel, every kind of tolerance, and springs on every free
/// coordinate, a steady value.
fn machines() -> Vec<(&'static str, &'static str)> {
    let constrained = [
        ("slider_crank", slider_crank::DECLARATION),
        ("geared_coasting", geared_coasting::DECLARATION),
        ("disk", disk::DECLARATION),
        ("fits", fits::DECLARATION),
        ("every", every::DECLARATION),
        ("conical", CONICAL),
    ];
    declarations().into_iter().chain(constrained).collect()
}

fn compiled(declaration: &str) -> Compilation {
    let tokens = declaration.parse().expect("tokens");
    compile(tokens, Limits::default()).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

#[test]
fn stages() {
    for (machine, declaration) in machines() {
        let mut compilation = compiled(declaration);
        let kernels = compilation.program.kernels.into_iter();
        compilation.program = Program { kernels: kernels.filter(|kernel| READABLE.contains(&kernel.name)).collect() };
        let [ast, _, topology] =
            early_stages(declaration.parse().expect("tokens")).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let functions = ("functions", compilation.functions.to_string());
        for (stage, text) in
            [ast, topology, functions, ("program", written(&compilation.program.to_string()).into_owned())]
        {
            assert_snapshot!(format!("{machine}__{stage}"), text);
        }
    }
}

#[test]
fn generated_code() {
    for (machine, declaration) in machines() {
        if GENERATED.contains(&machine) {
            let code =
                expand_pretty(declaration.parse().expect("tokens")).unwrap_or_else(|mistakes| panic!("{mistakes}"));
            assert_snapshot!(format!("{machine}__generated"), code);
        }
    }
}

#[test]
fn the_same_declaration_gives_the_same_tokens() {
    for (_, declaration) in machines() {
        let tokens = || expand(declaration.parse().expect("tokens")).to_string();
        assert_eq!(tokens(), tokens());
    }
}

/// Long function bodies are split into blocks, so that no chain of `let`s is long enough to overflow rustc's stack.
#[test]
fn no_block_nests_many_statements() {
    let long = declarations().into_iter().find(|(machine, _)| *machine == "chain_of_eight");
    let (_, declaration) = long.expect("the chain of eight is in the corpus");
    let code = expand_pretty(declaration.parse().expect("tokens")).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let mut longest = 0;
    let mut statements = 0;
    for line in code.lines() {
        if line.trim_start().starts_with("fn ") {
            statements = 0;
        }
        statements += usize::from(line.trim_start().starts_with("let "));
        longest = longest.max(statements);
    }
    assert!(longest <= 256, "{longest} nested statements");
    assert!(code.lines().count() > 10_000, "the chain of eight has long bodies");
}
