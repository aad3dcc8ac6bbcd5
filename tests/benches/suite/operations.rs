//! Operations: every node of the expression graph but inputs, outputs and constants, by the same rule for both sides.

use eigentol_compiler::algebra::{Direction, gradient};
use eigentol_compiler::algebra::{Node, Unary, derivatives_along, reachable};
use eigentol_compiler::base::ids::{ExprId, SymbolId};
use eigentol_compiler::compile;
use eigentol_compiler::mechanics::{Functions, Limits};
use serde_json::Value;

use crate::arm;
use crate::declaration::declaration;
use crate::tools::Tools;

/// Numbers of bars.
const BARS: [usize; 5] = [2, 4, 8, 16, 32];

/// Longer chains have no count of all partials.
const MOST_WITH_ALL: usize = 16;

/// Operations of one set of expressions.
#[derive(Clone, Debug)]
pub(crate) struct Operations {
    /// Mechanism and set. Sets of a chain: `mk`, residual, upper triangles of mass and stiffness; `adj`, gradient of a mode's
    /// functional by coordinates and design variables; `all`, `mk` with all their partial derivatives but those of the
    /// residual by coordinates.
    pub(crate) set: String,
    /// Ours, changes of sign included.
    pub(crate) ours: usize,
    /// Changes of sign among them, which fold into additions and cost nothing.
    pub(crate) signs: usize,
    /// CasADi's, from closed forms or a recursion typed in.
    pub(crate) typed: Option<u64>,
    /// CasADi's, from energies typed in.
    pub(crate) energies: Option<u64>,
}

/// Counts all sets.
///
/// # Errors
/// Where our side does not compile.
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
    let functions = functions(&declaration("Counted", bars), with_all)?;
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
    let mut functions = functions(arm::DECLARATION, false)?;
    let peer = counts(tools, "arm.py", &["count", &arm::numbers()]);
    let torques = result(&functions, "motion_residual", "residual");
    let mass = upper(result(&functions, "motion", "mass"), 7);
    let stiffness = result(&functions, "residual_and_stiffness", "stiffness");
    let parameters: Vec<Vec<SymbolId>> = ["acceleration", "velocity", "q"]
        .into_iter()
        .map(|name| parameter(&functions, "motion_residual", name))
        .collect();
    let [_, velocity, q] = &parameters[..] else {
        return Err("three parameters".to_owned());
    };
    // No kernel has these; they are derived here, forward and in reverse, and the cheaper way counts.
    let moving: Vec<SymbolId> = velocity.iter().chain(q).copied().collect();
    let graph = &mut functions.graph;
    let mut forward = mass.clone();
    for &symbol in &moving {
        let direction = Direction::unit(graph, symbol);
        forward.extend(derivatives_along(graph, &torques, &direction));
    }
    let mut reverse = Vec::new();
    for &torque in &torques {
        reverse.extend(gradient(graph, torque, &parameters.concat()));
    }
    let cheaper = |a: &Vec<ExprId>| operations(&functions, a).0;
    let moving = match cheaper(&forward) < cheaper(&reverse) {
        true => forward,
        false => reverse,
    };
    let sets = [
        ("inverse dynamics", torques),
        ("mass", mass),
        ("stiffness at rest", stiffness),
        ("derivatives in motion", moving),
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

fn functions(declaration: &str, with_all: bool) -> Result<Functions, String> {
    let explicit_partials = if with_all { usize::MAX } else { 0 };
    let tokens = declaration.parse().map_err(|error| format!("{error:?}"))?;
    let compilation = compile(
        tokens,
        Limits {
            explicit_partials,
            motion_linear: 0,
        },
    );
    Ok(compilation
        .map_err(|mistakes| format!("{mistakes:?}"))?
        .functions)
}

fn counts(tools: &mut Tools, script: &str, arguments: &[&str]) -> Option<Value> {
    let line = tools.casadi(script, arguments).ok()?;
    serde_json::from_str(&line).ok()
}

/// What a set of a chain consists of: CasADi's side counts the same expressions.
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
    let found: Vec<ExprId> = arrays
        .filter(|array| array.name == name)
        .flat_map(|array| array.values.iter().copied())
        .collect();
    assert!(!found.is_empty(), "{kernel} has no result {name}");
    found
}

fn parameter(functions: &Functions, kernel: &str, name: &str) -> Vec<SymbolId> {
    let of_kernel = functions.functions.iter().filter(|f| f.name == kernel);
    let parameters = of_kernel.flat_map(|f| &f.parameters);
    let found = parameters.filter(|parameter| parameter.name == name);
    found.flat_map(|p| p.symbols.iter().copied()).collect()
}

/// The upper triangles of matrices that lie one after the other.
fn upper(flat: Vec<ExprId>, size: usize) -> Vec<ExprId> {
    let entry = |index: &usize| (index % (size * size)) / size <= index % size;
    (0..flat.len()).filter(entry).map(|k| flat[k]).collect()
}

/// Operations and, among them, changes of sign.
fn operations(functions: &Functions, roots: &[ExprId]) -> (usize, usize) {
    let (mut operations, mut signs) = (0, 0);
    for id in reachable(&functions.graph, roots) {
        match functions.graph.node(id) {
            Node::Constant(_) | Node::Symbol(_) => continue,
            Node::Unary(Unary::Negate, _) => signs += 1,
            _ => {}
        }
        operations += 1;
    }
    (operations, signs)
}
