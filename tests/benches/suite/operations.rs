//! Operation counts: every node of the expression graph except inputs, outputs and constants, by the same rule for both
//! sides.

use eigentol_compiler::algebra::ExprId;
use eigentol_compiler::algebra::{cost, regroup};
use eigentol_compiler::compile;
use eigentol_compiler::mechanics::{Functions, Limits};
use serde_json::Value;

use crate::arm;
use crate::declaration::declaration;
use crate::tools::Tools;

/// Numbers of bars.
const BARS: [usize; 5] = [2, 4, 8, 16, 32];

/// The longest chain for which all partials are counted.
const MOST_WITH_ALL: usize = 16;

/// Operation counts of one set of expressions.
#[derive(Clone, Debug)]
pub(crate) struct Operations {
    /// Mechanism and set. The sets of a chain are `mk`: residual, upper triangles of mass and stiffness; `adj`:
    /// gradient of a mode's functional by coordinates and design variables; `all`: `mk` with all its partial
    /// derivatives except those of the residual by coordinates.
    pub(crate) set: String,
    /// Ours, including sign changes.
    pub(crate) ours: usize,
    /// The sign changes among them, which fold into additions and cost nothing.
    pub(crate) signs: usize,
    /// CasADi's, from closed forms or a hand-written recursion.
    pub(crate) typed: Option<u64>,
    /// CasADi's, from hand-written energies.
    pub(crate) energies: Option<u64>,
}

/// Counts all sets.
///
/// # Errors
/// When our side does not compile.
pub(crate) fn count(tools: &mut Tools) -> Result<Vec<Operations>, String> {
    let mut all = Vec::new();
    for bars in BARS {
        all.extend(of_chain(bars, tools)?);
    }
    all.extend(of_arm(tools)?);
    Ok(all)
}

fn of_chain(bars: usize, tools: &mut Tools) -> Result<Vec<Operations>, String> {
    let with_all = bars <= MOST_WITH_ALL;
    let limits = Limits { explicit_partials: if with_all { usize::MAX } else { 0 }, ..Limits::default() };
    let functions = functions(&declaration("Counted", bars), limits)?;
    let size = bars.to_string();
    let mut arguments = vec!["count", &size];
    let mut sets = vec!["mk", "adj"];
    if with_all {
        arguments.push("all");
        sets.push("all");
    }
    let peer = counts(tools, "chain.py", &arguments);
    let peer = |formulation: &str, set: &str| peer.as_ref()?[formulation][set].as_u64();
    let counted = sets.into_iter().map(|set| {
        let (ours, signs) = operations(&functions, &of_set(&functions, set, bars));
        Operations {
            set: format!("chain{bars}, {set}"),
            ours,
            signs,
            typed: peer("typed", set),
            energies: peer("energies", set),
        }
    });
    Ok(counted.collect())
}

fn of_arm(tools: &mut Tools) -> Result<Vec<Operations>, String> {
    let functions = functions(arm::DECLARATION, Limits::default())?;
    let peer = counts(tools, "arm.py", &["count", &arm::numbers()]);
    let kernel = |kernel, names: &[&str]| -> Vec<ExprId> {
        let results = names.iter().map(|name| result(&functions, kernel, name));
        results.flatten().collect()
    };
    let sets = [
        ("inverse dynamics", kernel("motion_residual", &["residual"])),
        ("mass", upper(kernel("motion", &["mass"]), 7)),
        ("stiffness at rest", kernel("residual_and_stiffness", &["stiffness"])),
        ("derivatives in motion", kernel("motion_linear", &["mass", "damping", "stiffness"])),
    ];
    let counted = sets.map(|(set, roots)| {
        let (ours, signs) = operations(&functions, &roots);
        Operations {
            set: format!("arm, {set}"),
            ours,
            signs,
            typed: peer.as_ref().and_then(|counts| counts[set].as_u64()),
            energies: None,
        }
    });
    Ok(counted.into())
}

fn functions(declaration: &str, limits: Limits) -> Result<Functions, String> {
    let tokens = declaration.parse().map_err(|error| format!("{error:?}"))?;
    let compilation = compile(tokens, limits).map_err(|mistakes| format!("{mistakes:?}"))?;
    Ok(compilation.functions)
}

fn counts(tools: &mut Tools, script: &str, arguments: &[&str]) -> Option<Value> {
    let line = tools.casadi(script, arguments).ok()?;
    serde_json::from_str(&line).ok()
}

/// The expressions of a set of a chain; CasADi's side counts the same ones.
fn of_set(functions: &Functions, set: &str, bars: usize) -> Vec<ExprId> {
    if set == "adj" {
        let mut all = result(functions, "mode_gradient", "coordinates");
        all.extend(result(functions, "mode_gradient", "design"));
        return all;
    }
    let mut all = result(functions, "residual_and_stiffness", "residual");
    all.extend(upper(result(functions, "linear", "mass"), bars));
    all.extend(upper(result(functions, "linear", "stiffness"), bars));
    if set == "all" {
        all.extend(result(functions, "residual_partials", "by_design"));
        let kernels = functions.functions.iter();
        let partials = kernels.filter(|f| f.name == "linear_partials");
        // Mass, damping, stiffness by coordinates, by inputs, by design variables.
        let arrays: Vec<_> = partials.flat_map(|f| &f.results).collect();
        for index in [0, 2, 6, 8] {
            all.extend(upper(arrays[index].values.clone(), bars));
        }
    }
    all
}

/// The entries of one result of a kernel.
fn result(functions: &Functions, kernel: &str, name: &str) -> Vec<ExprId> {
    let of_kernel = functions.functions.iter().filter(|f| f.name == kernel);
    let arrays = of_kernel.flat_map(|f| &f.results);
    let expr_ids: Vec<ExprId> =
        arrays.filter(|array| array.name == name).flat_map(|array| array.values.iter().copied()).collect();
    assert!(!expr_ids.is_empty(), "{kernel} has no result {name}");
    expr_ids
}

/// The upper triangles of consecutive matrices.
fn upper(flat: Vec<ExprId>, size: usize) -> Vec<ExprId> {
    let entry = |index: &usize| (index % (size * size)) / size <= index % size;
    (0..flat.len()).filter(entry).map(|k| flat[k]).collect()
}

/// Operations of generated code, and how many of them are sign changes.
fn operations(functions: &Functions, roots: &[ExprId]) -> (usize, usize) {
    let mut graph = functions.graph.clone();
    let roots = regroup(&mut graph, roots);
    let cost = cost(&graph, &roots);
    let signs = cost.negations;
    (cost.operations + cost.functions + signs, signs)
}
