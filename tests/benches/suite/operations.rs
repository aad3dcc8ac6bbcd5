//! Operations: every node of the expression graph but inputs, outputs and constants, by the same rule for both sides.

use eigentol_compiler::algebra::{Node, Unary, reachable};
use eigentol_compiler::base::ids::ExprId;
use eigentol_compiler::compile;
use eigentol_compiler::mechanics::{Functions, Limits};
use serde_json::Value;

use crate::declaration::declaration;
use crate::tools::Tools;

/// Numbers of bars.
pub(crate) const BARS: [usize; 5] = [2, 4, 8, 16, 32];

/// Longer chains have no count of all partials.
const MOST_WITH_ALL: usize = 16;

/// Operations of one set of expressions.
#[derive(Clone, Debug)]
pub(crate) struct Operations {
    pub(crate) bars: usize,
    /// `mk`: residual, upper triangles of mass and stiffness; `adj`: gradient of a mode's functional by coordinates and
    /// design variables; `all`: `mk` and all their partial derivatives but those of the residual by coordinates.
    pub(crate) set: &'static str,
    /// Ours; changes of sign, which fold into additions, apart.
    pub(crate) ours: usize,
    pub(crate) signs: usize,
    /// CasADi's from closed forms and from energies.
    pub(crate) typed: Option<u64>,
    pub(crate) energies: Option<u64>,
}

/// Counts all sets for all chains.
pub(crate) fn count(tools: &mut Tools) -> Vec<Operations> {
    BARS.into_iter()
        .flat_map(|bars| count_one(bars, tools))
        .collect()
}

fn count_one(bars: usize, tools: &mut Tools) -> Vec<Operations> {
    let with_all = bars <= MOST_WITH_ALL;
    let explicit_partials = if with_all { usize::MAX } else { 0 };
    let text = declaration("Counted", bars);
    let tokens = text.parse().expect("the declaration has tokens");
    let functions = compile(tokens, Limits { explicit_partials })
        .expect("the declaration has no mistakes")
        .functions;
    let size = bars.to_string();
    let mut arguments = vec!["count", &size];
    arguments.extend(with_all.then_some("all"));
    let peer: Option<Value> = tools
        .casadi("chain.py", &arguments)
        .ok()
        .and_then(|line| serde_json::from_str(&line).ok());
    let peer = |formulation: &str, set: &str| peer.as_ref()?[formulation][set].as_u64();
    let mut sets = vec!["mk", "adj"];
    sets.extend(with_all.then_some("all"));
    let counted = sets.into_iter().map(|set| {
        let (ours, signs) = operations(&functions, &roots(&functions, set, bars));
        Operations {
            bars,
            set,
            ours,
            signs,
            typed: peer("typed", set),
            energies: peer("energies", set),
        }
    });
    counted.collect()
}

/// What a set consists of: CasADi's side counts the same expressions.
fn roots(functions: &Functions, set: &str, bars: usize) -> Vec<ExprId> {
    let values = |kernel: &str, result: &str| -> Vec<ExprId> {
        let of_kernel = functions.functions.iter().filter(|f| f.name == kernel);
        let arrays = of_kernel.flat_map(|f| &f.results);
        let found: Vec<ExprId> = arrays
            .filter(|array| array.name == result)
            .flat_map(|array| array.values.iter().copied())
            .collect();
        assert!(!found.is_empty(), "{kernel}: no result {result}");
        found
    };
    let upper = |flat: Vec<ExprId>| -> Vec<ExprId> {
        let entry = |index: &usize| (index % (bars * bars)) / bars <= index % bars;
        (0..flat.len()).filter(entry).map(|k| flat[k]).collect()
    };
    if set == "adj" {
        let mut all = values("mode_gradient", "coordinates");
        all.extend(values("mode_gradient", "design"));
        return all;
    }
    let mut all = values("residual_and_stiffness", "residual");
    all.extend(upper(values("linear", "mass")));
    all.extend(upper(values("linear", "stiffness")));
    if set == "all" {
        all.extend(values("residual_partials", "by_design"));
        let partials = functions.functions.iter().filter(|f| f.name == "linear_partials");
        // Mass, damping, stiffness by coordinates, by inputs, by design variables.
        let arrays: Vec<_> = partials.flat_map(|f| &f.results).collect();
        for index in [0, 2, 6, 8] {
            all.extend(upper(arrays[index].values.clone()));
        }
    }
    all
}

fn operations(functions: &Functions, roots: &[ExprId]) -> (usize, usize) {
    let (mut operations, mut signs) = (0, 0);
    for id in reachable(&functions.graph, roots) {
        match functions.graph.node(id) {
            Node::Constant(_) | Node::Symbol(_) => {}
            Node::Unary(Unary::Negate, _) => signs += 1,
            _ => operations += 1,
        }
    }
    (operations, signs)
}
