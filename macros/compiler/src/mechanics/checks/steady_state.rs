//! A steady state exists only if the equations do not depend on the running coordinates, whether driven or coasting.

use crate::algebra::{Direction, ExprId, Graph, SymbolId, derivatives_along};
use crate::base::diagnostics::Diagnostics;
use proc_macro2::Ident;

use crate::base::ids::{BodyId, CoordinateId, ForceId};
use crate::base::names::LINK;
use crate::mechanics::equations::{Residual, outputs};
use crate::mechanics::motion::Kinematics;
use crate::mechanics::setup::{Context, ForceSelection, Selection, at_rest, by_symbol, vanish};
use crate::model::mechanism::Motion;

const INERTIA: &str = "the inertia of";
const UNBALANCE: &str = "; an eccentric centre or a skew axis of a symmetric body is an `unbalance`; what has unequal moments of inertia across the axis makes the equations of vibration periodic (theory of Floquet), which is not supported";
const BLADES: &str = "; three or more equal blades declared with `cyclic` may stand on a support that is not symmetric";
const SPINNING: &str =
    "; a round beam that turns about its axis is held by what does not turn, and is `spinning at` its speed";
const BEYOND: &str = "; joints that should not turn come before one that coasts";
const GRAVITY: &str = "gravity is not parallel to its axis";

/// Why there is no steady state.
pub(crate) enum Unsteady {
    /// These coasting coordinates can only stand still, because the slip at a contact depends on them: they are free.
    Standing(Vec<CoordinateId>),
    Mistakes(Diagnostics),
    /// The equations or the outputs depend on a running coordinate, which other unknowns may change: those of the rings
    /// that a drive turns.
    Turning(Vec<bool>),
}

impl From<Diagnostics> for Unsteady {
    fn from(mistakes: Diagnostics) -> Self {
        Self::Mistakes(mistakes)
    }
}

/// Whether neither equations nor outputs depend on a running coordinate.
pub(crate) fn is_steady(g: &mut Graph, context: &Context, kinematics: &Kinematics) -> bool {
    let running = &context.symbols.running;
    let residual = Residual::new(g, context, &running.values, kinematics, ForceSelection::ALL).total(g, context);
    let mut all = decisive(g, context, residual);
    let outputs = outputs(g, context, &running.values, kinematics);
    all.extend(at_rest(g, context.symbols, &outputs));
    let coordinates: Vec<_> = context.topology.running().collect();
    let mut pairs = running.ids.iter().zip(coordinates);
    pairs.all(|(&symbol, id)| {
        g.is(kinematics.coordinates[id.index()].velocity, 0.0) || !depends(g, context, &all, symbol)
    })
}

/// Rejects a mechanism whose equations or outputs depend on a running coordinate, naming the cause.
pub(crate) fn require_steady_state(g: &mut Graph, context: &Context, kinematics: &Kinematics) -> Result<(), Unsteady> {
    let mut diagnostics = Diagnostics::new();
    let mut standing = Vec::new();
    let running = &context.symbols.running.values;
    let residual = Residual::new(g, context, running, kinematics, ForceSelection::ALL).total(g, context);
    let residual = decisive(g, context, residual);
    let outputs = outputs(g, context, running, kinematics);
    let outputs = at_rest(g, context.symbols, &outputs);
    let coordinates: Vec<_> = context.topology.running().collect();
    for (&symbol, id) in context.symbols.running.ids.iter().zip(coordinates) {
        // A coordinate driven at zero speed is locked: the equations hold at its position.
        if g.is(kinematics.coordinates[id.index()].velocity, 0.0) {
            continue;
        }
        let coordinate = &context.mechanism.coordinates[id.index()];
        let name = &coordinate.name;
        let (motion, drive) = match coordinate.motion {
            Motion::Coasting => ("coasting", "motion"),
            _ => ("driven", "drive"),
        };
        if depends(g, context, &residual, symbol) {
            let Causes { mut causes, slip } = causes(g, context, kinematics, symbol);
            if slip && coordinate.motion == Motion::Coasting {
                standing.push(id);
                continue;
            }
            if causes.is_empty() {
                causes.push("at least, the contrary could not be shown near the nominal design".to_owned());
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
                    causes => {
                        let bodies = causes.iter().filter(|cause| cause.starts_with(INERTIA)).count();
                        let inertia = bodies > 0;
                        let equal = bodies > 2 && context.mechanism.rings.is_empty();
                        let of_blades = if equal { BLADES } else { "" };
                        let coasts = coordinate.motion == Motion::Coasting;
                        let beyond = if coasts { BEYOND } else { "" };
                        let of_bodies = if inertia { UNBALANCE } else { "" };
                        let has_beams = inertia && !context.mechanism.beams.is_empty();
                        let of_beams = if has_beams { SPINNING } else { "" };
                        format!("make what it names symmetric about the axis of the {drive}, or attach it to what moves with it{beyond}{of_bodies}{of_blades}{of_beams}")
                    }
                },
            );
        }
        for (&value, output) in outputs.iter().zip(&context.mechanism.outputs) {
            if depends(g, context, &[value], symbol) {
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
    match diagnostics.into_result(()) {
        Err(mistakes) => Err(Unsteady::Mistakes(mistakes)),
        Ok(()) if standing.is_empty() => Ok(()),
        Ok(()) => Err(Unsteady::Standing(standing)),
    }
}

/// What makes the equations depend on a coordinate.
struct Causes {
    /// In words.
    causes: Vec<String>,
    /// Whether that is only the slip at contacts.
    slip: bool,
}

/// What must not change: the equations of motion, and where blades need not do the same, the equations at rest and their
/// first derivatives.
fn decisive(g: &mut Graph, context: &Context, residual: Vec<ExprId>) -> Vec<ExprId> {
    if context.multiblade.is_empty() {
        return residual;
    }
    let (symbols, pencil) = (context.symbols, &context.symbols.pencil);
    let along = symbols
        .acceleration
        .with(&pencil.acceleration.values)
        .chain(symbols.velocity.with(&pencil.velocity.values))
        .chain(symbols.q.with(&pencil.position.values));
    // Along any motion at once.
    let change = derivatives_along(g, &residual, &Direction::new("_turning", along.collect()));
    at_rest(g, symbols, &[residual, change].concat())
}

fn depends(g: &mut Graph, context: &Context, roots: &[ExprId], symbol: SymbolId) -> bool {
    let change = by_symbol(g, roots, symbol);
    vanish(g, context, &change).into_iter().any(|zero| !zero)
}

/// The individual causes of force that make the equations depend on `symbol`.
fn causes(g: &mut Graph, context: &Context, kinematics: &Kinematics, symbol: SymbolId) -> Causes {
    let running = &context.symbols.running.values;
    let none = ForceSelection { inertia: Selection::None, forces: Selection::None, gravity: false, constraints: false };
    // Equal blades change with it by themselves, and not together.
    let of_ring = |name: &Ident| {
        let name = name.to_string();
        let mut rings = context.mechanism.rings.iter().map(|ring| format!("{}{LINK}", ring.name));
        rings.any(|ring| name.starts_with(&ring))
    };
    let mut candidates = vec![(ForceSelection { gravity: true, ..none }, GRAVITY.to_owned(), false)];
    for (index, force) in context.mechanism.forces.iter().enumerate() {
        candidates.push((
            ForceSelection { forces: Selection::One(ForceId::new(index)), ..none },
            format!("the force `{}` changes with it", force.name),
            of_ring(&force.name),
        ));
    }
    for (index, body) in context.mechanism.bodies.iter().enumerate() {
        candidates.push((
            ForceSelection { inertia: Selection::One(BodyId::new(index)), ..none },
            format!("{INERTIA} `{}` changes with it", body.name),
            of_ring(&body.name),
        ));
    }
    candidates.retain(|(selection, ..)| {
        let part = Residual::new(g, context, running, kinematics, *selection).total(g, context);
        let part = decisive(g, context, part);
        depends(g, context, &part, symbol)
    });
    let others = candidates.iter().any(|(.., of_ring)| !of_ring);
    candidates.retain(|(.., of_ring)| !(others && *of_ring));
    let mut causes: Vec<String> = candidates.into_iter().map(|(_, cause, _)| cause).collect();
    let (mut rows, mut slip) = (0, causes.is_empty());
    let constraints = ForceSelection { constraints: true, ..none };
    let values = Residual::new(g, context, running, kinematics, constraints).total(g, context);
    for (row, &value) in context.rows.iter().zip(&values[context.moving().1..]) {
        if depends(g, context, &[value], symbol) {
            slip &= row.of_velocities && row.source.rolls(context.mechanism);
            rows += 1;
            let source = row.source.name(context.mechanism);
            causes.push(format!("the constraint `{source}` changes with it"));
        }
    }
    causes.dedup();
    slip &= rows > 0;
    Causes { causes, slip }
}
