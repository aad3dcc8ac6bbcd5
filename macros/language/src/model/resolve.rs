//! From the syntax tree to the mechanism: every name becomes an id, every value is converted to SI. A wrong item still
//! declares its name, and a wrong value causes no further errors where it is used, so that each mistake is reported
//! once.

mod arguments;
mod bare;
mod beams;
mod bodies;
mod constants;
mod constraints;
mod coordinates;
mod correlated;
mod curves;
mod directions;
mod every;
mod excitations;
mod exerted;
mod expected;
mod forces;
mod functions;
pub mod given;
mod gravity;
mod joints;
mod kernels_only;
mod lists;
mod matrices;
mod nominal;
mod operators;
mod outputs;
mod parameters;
mod placements;
mod point_arguments;
mod references;
mod resolver;
mod rings;
mod scope;
mod shafts;
mod steady;
mod superelements;
mod tension;
mod tolerances;
mod typed;
mod units;
mod values;

use self::resolver::Resolver;
use self::scope::Scope;
use super::expression::Vector;
use super::mechanism::{
    Beam, Body, Constraint, DesignVariable, Excitation, Force, Input, Joint, Mechanism, Output, Point, Shaft, Steady,
    Superelement,
};
use super::rules::{attributes, physical, presence};
use crate::base::diagnostics::Diagnostics;
use crate::syntax::ast::{self as syntax, Ast, ItemKind, Unread};

/// The outcome of resolving a declaration.
#[derive(Debug)]
pub struct Resolution {
    /// The parts that could be resolved.
    pub mechanism: Mechanism,
    /// The mistakes in the other parts.
    pub mistakes: Diagnostics,
    /// Whether every body, joint and constraint is present and none is used under the name of another, so that the
    /// connections are known.
    pub is_connected: bool,
}

/// Resolves and checks a declaration.
pub fn resolve(ast: &Ast) -> Result<Mechanism, Diagnostics> {
    let resolution = resolve_what_is_right(ast, 0);
    resolution.mistakes.into_result(resolution.mechanism)
}

/// Resolves and checks the correct parts of a declaration, with this many `more` coordinates of every component of a
/// beam than declared.
pub fn resolve_what_is_right(ast: &Ast, more: usize) -> Resolution {
    let mut resolver = resolver(ast);
    resolver.more = more;
    let mut items = items(&mut resolver);
    resolver.refuse_unclear_units();
    attributes::check(ast, &mut resolver.diagnostics);
    presence::check(ast, resolver.can_move(), &mut resolver.diagnostics);
    physical::check(
        &resolver.requirements,
        &resolver.constants,
        &resolver.design_points(),
        items.inputs.len(),
        &mut resolver.diagnostics,
    );
    let is_used = |name: &syn::Ident| resolver.used.contains(&name.to_string());
    items.inputs.iter_mut().for_each(|input| input.is_used = is_used(&input.name));
    items.design.iter_mut().for_each(|variable| variable.is_used = is_used(&variable.name));
    let correlations = resolver.correlations(&items.design);
    let rings = resolver.rings(&items.design);
    let length = resolver.typical_length();
    let mechanism = Mechanism {
        name: ast.name.clone(),
        visibility: ast.visibility.clone(),
        attributes: ast.attributes.clone(),
        inputs: items.inputs,
        design: items.design,
        correlations,
        rings,
        constants: resolver.constants,
        curves: resolver.curves.into_iter().flatten().collect(),
        curve_arguments: resolver.curve_arguments,
        gravity: items.gravity,
        length,
        kernels_only: items.kernels_only,
        bodies: items.bodies,
        beams: items.beams,
        shafts: items.shafts,
        superelements: items.superelements,
        joints: items.joints,
        coordinates: resolver.declared_coordinates,
        points: items.points,
        forces: items.forces,
        excitations: items.excitations,
        constraints: items.constraints,
        steady: items.steady,
        outputs: items.outputs,
    };
    let is_whole = ast.unread.is_empty();
    if resolver.diagnostics.is_empty() && is_whole && !is_complete(ast, &mechanism) {
        // A value was dropped without a message.
        let message = "this declaration cannot be compiled, and eigentol does not know why";
        let help = "this is a bug of eigentol: please report it with the declaration";
        resolver.diagnostics.error_with_help(&ast.name, message, help);
    }
    Resolution {
        is_connected: !resolver.scope.is_ambiguous && is_connected(ast, &mechanism),
        mechanism,
        mistakes: resolver.diagnostics,
    }
}

/// The items of a declaration, as far as they are right.
struct Items {
    inputs: Vec<Input>,
    design: Vec<DesignVariable>,
    gravity: Vector,
    kernels_only: bool,
    bodies: Vec<Body>,
    beams: Vec<Beam>,
    shafts: Vec<Shaft>,
    superelements: Vec<Superelement>,
    joints: Vec<Joint>,
    points: Vec<Point>,
    forces: Vec<Force>,
    excitations: Vec<Excitation>,
    constraints: Vec<Constraint>,
    steady: Vec<Steady>,
    outputs: Vec<Output>,
}

/// A resolver that knows the names of a declaration.
fn resolver(ast: &Ast) -> Resolver<'_> {
    let mut diagnostics = Diagnostics::new();
    let coordinates = coordinates::declared(ast);
    let scope = Scope::new(ast, &coordinates, &mut diagnostics);
    Resolver::new(ast, coordinates, scope, diagnostics)
}

/// Resolves every item; the mistakes and the requirements on values are left in the resolver.
fn items(resolver: &mut Resolver<'_>) -> Items {
    let inputs = resolver.inputs();
    let design = resolver.design_variables();
    resolver.curves();
    resolver.named_constants();
    let gravity = resolver.gravity();
    let kernels_only = resolver.kernels_only();
    resolver.materials();
    let mut bodies = resolver.bodies();
    let mut joints = resolver.joints();
    resolver.require_inertias(&joints);
    let points = resolver.points();
    let mut forces = resolver.forces();
    forces.extend(resolver.forces_of_every(&forces));
    let excitations = resolver.excitations();
    let constraints = resolver.constraints();
    let steady = resolver.steady_values();
    let outputs = resolver.outputs();
    let (beams, shafts, superelements) =
        resolver.flexible_bodies(&mut bodies, &mut joints, &points, &mut forces, &gravity);
    Items {
        beams,
        shafts,
        superelements,
        inputs,
        design,
        gravity,
        kernels_only,
        bodies,
        joints,
        points,
        forces,
        excitations,
        constraints,
        steady,
        outputs,
    }
}

/// Whether every declared item has become an entry.
fn is_complete(ast: &Ast, mechanism: &Mechanism) -> bool {
    mechanism.inputs.len() == ast.all::<syntax::Input>().count()
        && mechanism.design.len() == ast.all::<syntax::Design>().count()
        && mechanism.curves.len() == ast.all::<syntax::Curve>().count()
        && mechanism.constants.len() >= count(ast, |kind| matches!(kind, ItemKind::Let(_)))
        && mechanism.points.len() == ast.all::<syntax::Point>().count()
        && mechanism.forces.iter().filter(|force| !force.of_every).count()
            == ast.all::<syntax::Force>().filter(|force| !force.is_harmonic()).count()
        && mechanism.excitations.len() == excitations::declared(ast)
        && mechanism.steady.len() == ast.all::<syntax::Named>().count()
        && mechanism.outputs.len() == count(ast, |kind| matches!(kind, ItemKind::Output(_)))
        && is_connected(ast, mechanism)
}

/// Whether every declared body, joint and constraint has become an entry.
fn is_connected(ast: &Ast, mechanism: &Mechanism) -> bool {
    let stations = mechanism.beams.iter().map(|beam| beam.stations.len()).sum::<usize>() + mechanism.stations().count();
    let of_beams: usize = mechanism.beams.iter().map(Beam::size).sum();
    let internal: usize = mechanism.superelements.iter().map(|own| own.internal.len()).sum();
    let of_stations = mechanism.stations().flat_map(|own| own.coordinates).flatten().count() + internal;
    let roots = mechanism.shafts.len() + mechanism.superelements.len();
    let (bodies, joints) = (mechanism.bodies.len(), mechanism.joints.len());
    !ast.unread.iter().any(Unread::may_connect)
        && bodies == ast.all::<syntax::Body>().count() + stations - roots
        && joints == ast.all::<syntax::Joint>().count() + stations
        && mechanism.coordinates.len() == coordinates::declared(ast).len() + of_beams + of_stations
        && (beams::declared::number_of(ast, "beam") == 0) == mechanism.beams.is_empty()
        && beams::declared::number_of(ast, "shaft") == mechanism.shafts.len()
        && beams::declared::number_of(ast, "superelement") == mechanism.superelements.len()
        && mechanism.constraints.len() == ast.all::<syntax::Constraint>().count()
}

fn count(ast: &Ast, is: fn(&ItemKind) -> bool) -> usize {
    ast.items.iter().filter(|item| is(&item.kind)).count()
}

#[cfg(test)]
mod tests {
    use super::arguments::Signature;
    use super::{bodies, constraints, forces, joints::kinds::Kind};
    use crate::syntax::parse::INSIDE;

    /// The parser distinguishes a misplaced word from an unknown one; `point` also starts an item.
    #[test]
    fn the_parser_knows_the_words_inside_items() {
        fn words<R>(table: &[Signature<R>]) -> Vec<&'static str> {
            let words = table.iter().map(|row| row.word);
            words.filter(|word| *word != "point").collect()
        }
        let known = [
            ("body", words(bodies::SHAPES)),
            ("joint", Kind::words().collect()),
            ("force", words(forces::LAWS)),
            ("constraint", words(constraints::KINDS)),
        ];
        for ((keyword, inside), (expected, words)) in INSIDE.iter().zip(known) {
            assert_eq!((*keyword, inside.to_vec()), (expected, words));
        }
    }
}
