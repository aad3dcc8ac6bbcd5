//! What the generated code costs: additions and multiplications for a chain of `n` bars on a spinning shaft, with the
//! length and the mass of every bar as design variables.

use eigentol_compiler::algebra::{Cost, Function, cost};
use eigentol_compiler::compile;
use eigentol_compiler::mechanics::{Functions, Limits};
use eigentol_oracle::declaration::declaration;
use eigentol_oracle::examples::chain;

/// Bars, full adjoint gradient, all explicit partial matrices, as counted on a sketch.
const SKETCH: [(usize, usize, Option<usize>); 5] = [
    (2, 280, Some(405)),
    (4, 702, Some(1650)),
    (8, 1546, Some(7744)),
    (16, 3234, Some(42860)),
    (32, 6610, None),
];

fn functions(bars: usize) -> Functions {
    let ones = vec![1.0; bars];
    let model = chain(&ones, &ones);
    let tokens = declaration(&model).parse().expect("tokens");
    let explicit_partials = if bars <= 16 { usize::MAX } else { 0 };
    compile(tokens, Limits { explicit_partials })
        .unwrap_or_else(|mistakes| panic!("{mistakes:?}"))
        .functions
}

fn together(functions: &Functions, names: &[&str]) -> Cost {
    let wanted = |function: &&Function| names.contains(&function.name);
    let roots: Vec<_> = functions
        .functions
        .iter()
        .filter(wanted)
        .flat_map(Function::roots)
        .collect();
    assert!(!roots.is_empty(), "{names:?}");
    cost(&functions.graph, &roots)
}

#[test]
fn chains_cost_no_more_than_half_again_the_sketch() {
    for (bars, adjoint, explicit) in SKETCH {
        let functions = functions(bars);
        let count = together(&functions, &["mode_gradient", "residual_gradient"]).operations;
        assert!(
            2 * count <= 3 * adjoint,
            "{bars} bars: adjoint {count}, sketch {adjoint}"
        );
        if let Some(explicit) = explicit {
            let count = together(&functions, &["linear_partials"]).operations;
            assert!(
                2 * count <= 3 * explicit,
                "{bars} bars: explicit {count}, sketch {explicit}"
            );
        }
    }
}

#[test]
fn residual_and_adjoint_grow_linearly() {
    for name in [
        "residual",
        "motion_residual",
        "mode_gradient",
        "residual_gradient",
        "mode_gradient_along",
        "pencil_gradient",
        "pencil_gradient_along",
        "whirl",
        "residual_gradient_along",
    ] {
        let [four, eight, sixteen, thirty_two] =
            [4, 8, 16, 32].map(|bars| together(&functions(bars), &[name]).operations);
        assert_eq!(sixteen - eight, 2 * (eight - four), "{name}");
        assert_eq!(thirty_two - sixteen, 2 * (sixteen - eight), "{name}");
    }
}

#[test]
fn matrices_grow_with_the_square() {
    for name in ["motion", "linear", "linear_along"] {
        let counts = [4, 8, 16, 32].map(|bars| together(&functions(bars), &[name]).operations);
        // A quadratic in the number of bars: second differences over doublings grow by exactly four.
        let steps: Vec<i64> = counts
            .windows(2)
            .map(|pair| pair[1] as i64 - pair[0] as i64)
            .collect();
        let [first, second, third] = steps[..] else {
            unreachable!("four counts")
        };
        assert_eq!(
            third - 2 * second,
            4 * (second - 2 * first),
            "{name}: {counts:?}"
        );
    }
}

/// The table of the architecture page.
#[test]
fn counts_are_known() {
    let mut table = String::new();
    for bars in [1, 2, 4, 8, 16] {
        let functions = functions(bars);
        table.push_str(&format!("{bars} bars\n"));
        for function in &functions.functions {
            let Cost {
                operations,
                functions,
            } = function.cost(&functions.graph);
            table.push_str(&format!(
                "  {:<26}{operations:>7} +{functions:>4}\n",
                function.name
            ));
        }
        let both = together(&functions, &["mode_gradient", "residual_gradient"]);
        table.push_str(&format!(
            "  {:<26}{:>7} +{:>4}\n",
            "full adjoint", both.operations, both.functions
        ));
    }
    insta::assert_snapshot!(table);
}
