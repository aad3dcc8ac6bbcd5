//! Operation counts of the generated code for a chain of `n` bars on a spinning shaft, with the length and the mass of
//! every bar as design variables, and for a robot arm.
//!
//! # What this costs
//!
//! Graph nodes except inputs, outputs and constants (pinned by `tests/tests/operation_counts.rs`), beside CasADi 3.8
//! when an expert types in closed forms of both matrices. For a chain of n bars with lengths and masses as design
//! variables, "model" is the residual with the upper triangles of `Mhat` and `Khat`, "gradient" that of one mode's
//! functional by coordinates and design, "all" the model with its partial derivatives by both.
//!
//! | n | model | typed | gradient | typed | all | typed |
//! | --- | ---: | ---: | ---: | ---: | ---: | ---: |
//! | 2 | 59 | 62 | 181 | 146 | 207 | 227 |
//! | 4 | 180 | 197 | 463 | 487 | 845 | 992 |
//! | 8 | 512 | 671 | 1027 | 1719 | 3603 | 4738 |
//! | 16 | 1560 | 2435 | 2155 | 6391 | 17503 | 25350 |
//! | 32 | 5192 | 9227 | 4411 | 24567 | - | - |
//!
//! A robot arm of seven joints (`tests/truth/panda_arm.json`), beside CasADi on recursions in each body's frame:
//!
//! | | inverse dynamics | mass matrix | stiffness at rest | all derivatives along a motion |
//! | --- | ---: | ---: | ---: | ---: |
//! | compiled | 701 | 382 | 183 | 3191 |
//! | CasADi | 810 | 485 | 1175 | 6480 |

use eigentol_compiler::algebra::ExprId;
use eigentol_compiler::algebra::{Cost, Function, cost, regroup};
use eigentol_compiler::mechanics::{Functions, Limits};
use eigentol_compiler::{Compilation, compile};
use eigentol_oracle::declaration::declaration;
use eigentol_oracle::examples::{arm, chain};
use eigentol_oracle::model::{Coordinate, Force, ForceLaw, Model, Value};
use eigentol_oracle::truth::Truth;
use eigentol_tests::op_counter::operations_along;

/// Number of bars, and the cost of an expert's closed forms in CasADi 3.8: residual, mass and stiffness matrix;
/// gradient of a mode's functional; these with all partial derivatives. Every node except inputs, outputs and constants
/// counts.
const TYPED: [(usize, usize, usize, Option<usize>); 5] = [
    (2, 62, 146, Some(227)),
    (4, 197, 487, Some(992)),
    (8, 671, 1719, Some(4738)),
    (16, 2435, 6391, Some(25350)),
    (32, 9227, 24567, None),
];

/// Costs of the arm: inverse dynamics, mass matrix, stiffness at rest, all derivatives along a motion.
const ARM: [usize; 4] = [810, 485, 1175, 6480];

fn functions(bars: usize) -> Functions {
    let ones = vec![1.0; bars];
    let explicit_partials = if bars <= 16 { usize::MAX } else { 0 };
    compiled(&chain(&ones, &ones), explicit_partials)
}

fn compiled(model: &Model, explicit_partials: usize) -> Functions {
    compilation(model, explicit_partials).functions
}

fn compilation(model: &Model, explicit_partials: usize) -> Compilation {
    let tokens = declaration(model).parse().expect("tokens");
    let limits = Limits { explicit_partials, ..Limits::default() };
    compile(tokens, limits).unwrap_or_else(|mistakes| panic!("{mistakes:?}"))
}

/// Results of a kernel, by name.
fn results(functions: &Functions, kernel: &str, wanted: &[&str]) -> Vec<ExprId> {
    let function = functions.functions.iter().find(|f| f.name == kernel);
    let function = function.unwrap_or_else(|| panic!("no kernel {kernel}"));
    let results = function.results.iter();
    let values: Vec<_> =
        results.filter(|array| wanted.contains(&array.name)).flat_map(|array| array.values.clone()).collect();
    assert!(!values.is_empty(), "{kernel}: {wanted:?}");
    values
}

/// The number of nodes except inputs, outputs and constants.
fn nodes(functions: &Functions, roots: &[ExprId]) -> usize {
    let mut graph = functions.graph.clone();
    let roots = regroup(&mut graph, roots);
    let cost = cost(&graph, &roots);
    cost.operations + cost.functions + cost.negations
}

/// Cost before regrouping, which can only reduce it.
fn together(functions: &Functions, names: &[&str]) -> Cost {
    let wanted = |function: &&Function| names.contains(&function.name);
    let roots: Vec<_> = functions.functions.iter().filter(wanted).flat_map(Function::roots).collect();
    assert!(!roots.is_empty(), "{names:?}");
    cost(&functions.graph, &roots)
}

/// Costs of a chain: residual with matrices, gradient of a mode, everything.
fn chain_counts(bars: usize) -> (usize, usize, Option<usize>) {
    let functions = functions(bars);
    let mut model = results(&functions, "residual", &["residual"]);
    model.extend(results(&functions, "linear", &["mass", "stiffness"]));
    let gradient = results(&functions, "mode_gradient", &["coordinates", "design"]);
    let all = (bars <= 16).then(|| {
        let mut all = model.clone();
        all.extend(results(&functions, "residual_partials", &["by_design"]));
        all.extend(partials_without_inputs(&functions));
        nodes(&functions, &all)
    });
    (nodes(&functions, &model), nodes(&functions, &gradient), all)
}

/// Partial derivatives of mass and stiffness by coordinates and design variables.
fn partials_without_inputs(functions: &Functions) -> Vec<ExprId> {
    let kernel = functions.functions.iter().find(|f| f.name == "linear_partials");
    let kernel = kernel.expect("partials are written out");
    // three matrices by coordinates, by inputs, by design variables
    let [by_coordinate, _, by_design] = [0, 1, 2].map(|k| &kernel.results[3 * k..3 * k + 3]);
    let both = by_coordinate.iter().chain(by_design);
    both.filter(|array| array.name != "damping").flat_map(|array| array.values.clone()).collect()
}

#[test]
fn chains_cost_no_more_than_closed_forms_typed_by_an_expert() {
    let mut table = String::from("bars  model  typed  gradient  typed     all  typed\n");
    for (bars, model, gradient, all) in TYPED {
        let counts = chain_counts(bars);
        assert!(counts.0 <= model, "{bars} bars: model {}", counts.0);
        assert!(counts.2 <= all, "{bars} bars: all {:?}", counts.2);
        if bars == 32 {
            assert!(3 * counts.1 <= gradient, "gradient {}", counts.1);
        }
        let text = |count: Option<usize>| count.map_or("-".to_owned(), |count| count.to_string());
        table.push_str(&format!(
            "{bars:>4}{:>7}{model:>7}{:>10}{gradient:>7}{:>8}{:>7}\n",
            counts.0,
            counts.1,
            text(counts.2),
            text(all),
        ));
    }
    insta::assert_snapshot!(table);
}

#[test]
fn an_arm_costs_less_than_in_casadi() {
    let mut model = arm(&Truth::load("panda_arm"));
    // a coordinate without resistance would be refused
    model.forces.push(Force {
        name: "hold".to_owned(),
        law: ForceLaw::Spring {
            coordinate: Coordinate { joint: 0, step: 0 },
            stiffness: Value::Number(1.0),
            rest: Value::Number(0.0),
        },
    });
    let functions = compiled(&model, 0);
    let counts = [
        ("motion_residual", &["residual"][..]),
        ("motion", &["mass"]),
        ("linear", &["stiffness"]),
        ("motion_linear", &["mass", "damping", "stiffness"]),
    ]
    .map(|(kernel, wanted)| nodes(&functions, &results(&functions, kernel, wanted)));
    for (count, peer) in counts.into_iter().zip(ARM) {
        assert!(count < peer, "{counts:?}");
    }
    insta::assert_debug_snapshot!(counts);
}

#[test]
fn residual_and_adjoint_grow_linearly() {
    for name in ["residual", "motion_residual", "mode_gradient", "residual_gradient", "pencil_gradient", "whirl"] {
        let [four, eight, sixteen, thirty_two] =
            [4, 8, 16, 32].map(|bars| together(&functions(bars), &[name]).operations);
        assert_eq!(sixteen - eight, 2 * (eight - four), "{name}");
        assert_eq!(thirty_two - sixteen, 2 * (sixteen - eight), "{name}");
    }
}

/// Counts every operation in the dual numbers in which the runtime takes directional derivatives.
#[test]
fn directional_derivatives_of_adjoints_grow_linearly() {
    let programs = [4, 8, 16, 32].map(|bars| {
        let ones = vec![1.0; bars];
        compilation(&chain(&ones, &ones), 0).program
    });
    for name in ["mode_gradient", "pencil_gradient", "residual_gradient"] {
        let kernels = programs.each_ref().map(|program| {
            let kernel = program.kernel(name);
            kernel.expect("in the contract")
        });
        let [four, eight, sixteen, thirty_two] = kernels.map(operations_along);
        assert_eq!(sixteen - eight, 2 * (eight - four), "{name}");
        assert_eq!(thirty_two - sixteen, 2 * (sixteen - eight), "{name}");
        for kernel in kernels {
            let cost = kernel.cost.operations + kernel.cost.functions;
            assert!(operations_along(kernel) < 4 * cost, "{name}");
        }
    }
}

#[test]
fn matrices_grow_with_the_square() {
    for name in ["motion", "linear"] {
        let counts = [4, 8, 16, 32].map(|bars| together(&functions(bars), &[name]).operations);
        // Quadratic in the number of bars: second differences over doublings grow by exactly four.
        let steps: Vec<i64> = counts.windows(2).map(|pair| pair[1] as i64 - pair[0] as i64).collect();
        let [first, second, third] = steps[..] else { unreachable!("four counts") };
        assert_eq!(third - 2 * second, 4 * (second - 2 * first), "{name}: {counts:?}");
    }
}

/// Kernels that the runtime differentiates along a direction.
const DIFFERENTIATED: [&str; 4] = ["linear", "mode_gradient", "pencil_gradient", "residual_gradient"];

#[test]
fn counts_are_known() {
    let mut table = String::new();
    for bars in [1, 2, 4, 8, 16] {
        let ones = vec![1.0; bars];
        let compilation = compilation(&chain(&ones, &ones), usize::MAX);
        table.push_str(&format!("{bars} bars\n"));
        for function in &compilation.program.kernels {
            let Cost { operations, functions, negations } = function.cost;
            let along = match DIFFERENTIATED.contains(&function.name) {
                true => format!("{:>7} along", operations_along(function)),
                false => String::new(),
            };
            table.push_str(&format!("  {:<26}{operations:>7} +{functions:>4} +{negations:>4}{along}\n", function.name));
        }
    }
    insta::assert_snapshot!(table);
}

/// A beam that is clamped to a hub at constant speed.
fn beam(planes: &str) -> Compilation {
    let text = format!(
        "mechanism Blade {{
            input omega: rad/s; design L = 1 m; design EIy = 100 N*m^2; design EIz = 300 N*m^2;
            design GJ = 80 N*m^2; design rhoA = 1 kg/m;
            body hub: massless;
            joint spin: revolute(z) from ground to hub, driven at omega;
            body blade: beam(length: L, along: x, up: z, mass_per_length: rhoA, {planes});
            joint clamp: fixed from hub to blade;
        }}"
    );
    let limits = Limits { explicit_partials: 0, ..Limits::default() };
    let tokens = text.parse().expect("tokens");
    compile(tokens, limits).unwrap_or_else(|mistakes| panic!("{mistakes:?}"))
}

/// The three matrices together, and the gradient of a mode. A derivation by hand, structured in the same way, takes 12,176
/// for the matrices in space.
#[test]
fn beams_cost_less_than_a_derivation_by_hand() {
    let planar = "stiffness_y: EIy, bending_y: 4";
    let spatial = "stiffness_y: EIy, stiffness_z: EIz, torsion_stiffness: GJ, torsion: 2, bending: 4";
    let rotary = format!("{spatial}, inertia_y: 1e-3 * rhoA * L^2, inertia_z: 2e-3 * rhoA * L^2");
    let counts = [planar, spatial, &rotary].map(|planes| {
        let program = beam(planes).program;
        ["linear", "mode_gradient"].map(|name| {
            let cost = program.kernel(name).expect("in the contract").cost;
            cost.operations + cost.functions + cost.negations
        })
    });
    for ([linear, gradient], [most, most_of_gradient]) in
        counts.into_iter().zip([[800, 1_070], [9_600, 4_700], [11_800, 6_900]])
    {
        assert!(linear <= most && gradient <= most_of_gradient, "{counts:?}");
    }
    insta::assert_debug_snapshot!(counts);
}
