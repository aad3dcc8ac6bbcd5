//! A steady state exists only if the equations do not change while the running coordinates, driven or coasting, go on.

use crate::algebra::Graph;
use crate::base::diagnostics::Diagnostics;
use crate::base::ids::{BodyId, ExprId, ForceId, SymbolId};

use crate::model::mechanism::Motion;

use super::kinematics::Kinematics;
use super::linearise::{at_rest, by_symbol};
use super::outputs::outputs;
use super::problem::Problem;
use super::properties::vanish;
use super::sources::{Selection, Sources};

const GRAVITY: &str = "gravity is not parallel to its axis";

/// Rejects a mechanism whose equations or outputs depend on a running coordinate, naming the cause.
pub(super) fn check(g: &mut Graph, problem: &Problem) -> Result<(), Diagnostics> {
    let mut diagnostics = Diagnostics::new();
    let running = &problem.symbols.running.values;
    let kinematics = problem.kinematics(g, running);
    let residual = problem.residual(g, running, &kinematics, Sources::ALL);
    let outputs = outputs(g, problem, running, &kinematics);
    let outputs = at_rest(g, problem.symbols, &outputs);
    let coordinates: Vec<_> = problem.topology.running().collect();
    for (&symbol, id) in problem.symbols.running.ids.iter().zip(coordinates) {
        // Driven at a speed of zero is locked: the equations hold where it stands.
        if g.is(kinematics.coordinates[id.index()].velocity, 0.0) {
            continue;
        }
        let coordinate = &problem.mechanism.coordinates[id.index()];
        let name = &coordinate.name;
        let (motion, drive) = match coordinate.motion {
            Motion::Coasting => ("coasting", "motion"),
            _ => ("driven", "drive"),
        };
        if depends(g, problem, &residual, symbol) {
            let mut causes = causes(g, problem, &kinematics, symbol);
            if causes.is_empty() {
                causes.push(
                    "at least, the contrary could not be shown near the nominal design".to_owned(),
                );
            }
            diagnostics.error_with_help(
                name.span(),
                format!(
                    "the equations of motion depend on the {motion} coordinate `{name}`, so there is no steady state: {}",
                    causes.join("; ")
                ),
                match causes.as_slice() {
                    [only] if only == GRAVITY => format!(
                        "let gravity act along the axis of the {drive}, for example `gravity 9.81 m/s^2 along -z;`, or hold the axis upright"
                    ),
                    _ => format!("make what it names symmetric about the axis of the {drive}, or attach it to what moves with it"),
                },
            );
        }
        for (&value, output) in outputs.iter().zip(&problem.mechanism.outputs) {
            if depends(g, problem, &[value], symbol) {
                diagnostics.error_with_help(
                    output.name.span(),
                    format!(
                        "output `{}` depends on the {motion} coordinate `{name}` and is not constant in steady motion",
                        output.name
                    ),
                    "use a quantity that this motion leaves unchanged: a height, a distance, a distance from the axis",
                );
            }
        }
    }
    diagnostics.into_result(())
}

fn depends(g: &mut Graph, problem: &Problem, roots: &[ExprId], symbol: SymbolId) -> bool {
    let change = by_symbol(g, roots, symbol);
    vanish(g, problem, &change).into_iter().any(|zero| !zero)
}

/// The causes of force that alone make the equations depend on `symbol`.
fn causes(
    g: &mut Graph,
    problem: &Problem,
    kinematics: &Kinematics,
    symbol: SymbolId,
) -> Vec<String> {
    let running = &problem.symbols.running.values;
    let none = Sources {
        inertia: Selection::None,
        forces: Selection::None,
        gravity: false,
        constraints: false,
    };
    let mut candidates = vec![(
        Sources {
            gravity: true,
            ..none
        },
        GRAVITY.to_owned(),
    )];
    for (index, force) in problem.mechanism.forces.iter().enumerate() {
        candidates.push((
            Sources {
                forces: Selection::One(ForceId::new(index)),
                ..none
            },
            format!("the force `{}` changes with it", force.name),
        ));
    }
    for (index, body) in problem.mechanism.bodies.iter().enumerate() {
        candidates.push((
            Sources {
                inertia: Selection::One(BodyId::new(index)),
                ..none
            },
            format!("the inertia of `{}` changes with it", body.name),
        ));
    }
    candidates.retain(|(sources, _)| {
        let part = problem.residual(g, running, kinematics, *sources);
        depends(g, problem, &part, symbol)
    });
    let mut causes: Vec<String> = candidates.into_iter().map(|(_, cause)| cause).collect();
    let constraints = Sources {
        constraints: true,
        ..none
    };
    let values = problem.residual(g, running, kinematics, constraints);
    for (row, &value) in problem.rows.iter().zip(&values[problem.moving().1..]) {
        if depends(g, problem, &[value], symbol) {
            let source = row.source.name(problem.mechanism);
            causes.push(format!("the constraint `{source}` changes with it"));
        }
    }
    causes.dedup();
    causes
}
