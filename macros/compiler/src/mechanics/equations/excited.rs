//! The equations with their excitations: how the residual and the outputs change with each.
//!
//! Every excitation has one to three small parameters: two perpendicular directions of an unbalance, the size of a load,
//! displacement, velocity and acceleration of a shaken coordinate. Its forces are the derivatives of the whole residual
//! by them, so nothing is typed in: an unbalance brings its weight, a shaken joint the inertia of what it carries. They
//! are derived with the running coordinates as symbols, which shows whether they are harmonic.

use std::rc::Rc;

use crate::algebra::{ExprId, Graph, Stage, Vector3, substitute};
use crate::base::ids::{BodyId, DesignId};
use crate::mechanics::inertia::{Direction, deviation};
use crate::mechanics::motion::{Kinematics, in_common_frame, turning};
use crate::mechanics::setup::{
    Context, CoordinateMotion, Excited, ForceSelection, SymbolList, Symbols, Values, at_rest, by_symbol, vanish,
};
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::{Excitation, ExcitationLaw, Force, ForceLaw, Mechanism};

use super::outputs::outputs;
use super::residual::Residual;

/// How the residual and the outputs change with the parameters of one excitation.
pub(crate) struct Response {
    /// By parameter: derivatives of the residual, followed by those of the outputs, at rest.
    pub(crate) by: Vec<Vec<ExprId>>,
}

impl Response {
    /// Of unknowns with harmonics, along which forces that do not depend on the angle of a drive do not act.
    pub(crate) fn along_means(self, g: &mut Graph, context: &Context) -> Self {
        let outputs = context.mechanism.outputs.len();
        let padded = |change: Vec<ExprId>| {
            let (residual, outputs) = change.split_at(change.len() - outputs);
            let mut change = context.harmonics.constant(g, residual);
            change.extend(outputs);
            change
        };
        Self { by: self.by.into_iter().map(padded).collect() }
    }
}

/// The responses to all excitations, with the running coordinates as symbols.
pub(crate) fn excited(g: &mut Graph, context: &Context, at_zero: &Kinematics) -> Vec<Response> {
    let mechanism = context.mechanism;
    if mechanism.excitations.is_empty() {
        return Vec::new();
    }
    let mut symbols = context.symbols.clone();
    let parameters: Vec<SymbolList> =
        mechanism.excitations.iter().map(|excitation| parameters(g, excitation, &mut symbols)).collect();
    let excited = additions(g, context, at_zero, &parameters);
    let mechanism = with_loads(mechanism, &parameters, context.symbols.b.ids.len());
    let values = Values::new(g, &mechanism, &symbols);
    let context = &Context { mechanism: &mechanism, symbols: &symbols, values: &values, excited: &excited, ..*context };
    let running = &symbols.running.values;
    let kinematics = in_common_frame(g, context, running);
    let mut all = Residual::new(g, context, running, &kinematics, ForceSelection::ALL).total(g, context);
    all.extend(outputs(g, context, running, &kinematics));
    let zero = g.zero();
    let none: Vec<_> = parameters.iter().flat_map(|list| list.ids.iter().map(|&id| (id, zero))).collect();
    parameters
        .iter()
        .map(|list| Response {
            by: list
                .ids
                .iter()
                .map(|&symbol| {
                    let change = by_symbol(g, &all, symbol);
                    let change = substitute(g, &change, &none);
                    at_rest(g, &symbols, &change)
                })
                .collect(),
        })
        .collect()
}

/// The parameters of an excitation. They follow the design variables, so that a value can refer to them.
fn parameters(g: &mut Graph, excitation: &Excitation, symbols: &mut Symbols) -> SymbolList {
    let names: &[&str] = match excitation.law {
        ExcitationLaw::Unbalance { .. } => &["", "_across"],
        ExcitationLaw::Load { .. } | ExcitationLaw::Generalized { .. } => &[""],
        ExcitationLaw::Shaken { .. } => &["_displacement", "_velocity", "_acceleration"],
    };
    let mut list = SymbolList::default();
    for name in names {
        let (id, value) = g.symbol(format!("{}{name}", excitation.name), Stage::Design);
        list.ids.push(id);
        list.values.push(value);
        symbols.b.ids.push(id);
        symbols.b.values.push(value);
    }
    list
}

/// Deviations of bodies and motions of shaken coordinates.
fn additions(g: &mut Graph, context: &Context, kinematics: &Kinematics, parameters: &[SymbolList]) -> Excited {
    let mut excited = Excited::default();
    for (excitation, list) in context.mechanism.excitations.iter().zip(parameters) {
        match &excitation.law {
            ExcitationLaw::Unbalance { body, at, deviation: kind } => {
                let directions = across(g, context, kinematics, *body);
                for (along, &amount) in directions.into_iter().flatten().zip(&list.values) {
                    let direction = Direction { along, amount };
                    let change = deviation(g, context, *body, (at, kind), &direction);
                    excited.deviations.push((*body, change));
                }
            }
            ExcitationLaw::Shaken { coordinate, .. } => {
                let motion = CoordinateMotion {
                    position: list.values[0],
                    velocity: list.values[1],
                    acceleration: list.values[2],
                };
                excited.shaken.push((*coordinate, motion));
            }
            ExcitationLaw::Load { .. } | ExcitationLaw::Generalized { .. } => {}
        }
    }
    excited
}

/// Two perpendicular directions across the axis about which a body is turned by the nearest running coordinate, in the
/// body's frame: along x for an axis along z, y for x, z for y, and for any other axis along the part across it of the
/// one that belongs to the nearest of these. The second is a quarter of a turn ahead. `None` if nothing turns the body.
fn across(g: &mut Graph, context: &Context, kinematics: &Kinematics, body: BodyId) -> Option<[Vector3; 2]> {
    let (_, axis) = turning(g, context, kinematics, body)?;
    let unit: [Vector3; 3] = crate::algebra::Matrix3::identity(g).0;
    let size = |k: usize| context.nominal(g, axis.0[k]).abs();
    let nearest = (1..3).fold(0, |best, k| if size(k) > size(best) { k } else { best });
    let reference = (nearest + 1) % 3;
    let zero = vanish(g, context, &axis.0);
    let exactly = (0..3).all(|k| k == nearest || zero[k]);
    let first = if exactly {
        unit[reference]
    } else {
        let part = axis.scale(g, axis.0[reference]);
        let across = unit[reference].sub(g, part);
        let length = across.norm(g);
        Vector3(across.0.map(|component| g.div(component, length)))
    };
    Some([first, axis.cross(g, first)])
}

/// The mechanism with the loads of its excitations as forces, each times its parameter.
fn with_loads(mechanism: &Mechanism, parameters: &[SymbolList], design: usize) -> Mechanism {
    let mut mechanism = mechanism.clone();
    let mut design = design;
    for (excitation, list) in mechanism.excitations.clone().iter().zip(parameters) {
        let parameter = Rc::new(Expr::Design(DesignId::new(design)));
        design += list.ids.len();
        let times = |value: &Expr| Expr::Multiply(parameter.clone(), Rc::new(value.clone()));
        let vector = |vector: &Vector| vector.each_ref().map(times);
        let law = match &excitation.law {
            ExcitationLaw::Load { point, force, moment } => {
                ForceLaw::Load { point: *point, force: vector(force), moment: vector(moment), following: false }
            }
            ExcitationLaw::Generalized { coordinate, value } => {
                ForceLaw::Generalized { coordinate: *coordinate, value: times(value) }
            }
            ExcitationLaw::Unbalance { .. } | ExcitationLaw::Shaken { .. } => continue,
        };
        mechanism.forces.push(Force { name: excitation.name.clone(), law, of_every: false });
    }
    mechanism
}
