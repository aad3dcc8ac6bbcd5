//! What turns, and how far it is out of balance: the numbers that a grade of balancing compares (ISO 21940-11).

use super::evaluate::Values;
use super::expression::Expr;
use super::mechanism::{Beam, Body, CoordinateQuantity, Deviation, ExcitationLaw, Frame, Mechanism, Shaft};
use crate::base::ids::DesignId;

/// The mass of all that a running coordinate turns, and of beams that spin, kg, at inputs `u` and design variables `b`, SI.
pub fn turning_mass(mechanism: &Mechanism, u: &[f64], b: &[f64]) -> f64 {
    let values = Values::new(&mechanism.constants, u, b);
    let turns = turning(mechanism);
    let rigid = mechanism.bodies.iter().zip(&turns).filter(|(_, turns)| **turns);
    let rigid = rigid.map(|(body, _)| mass(body, &values));
    let spins = |beam: &&Beam| turns[beam.body.index()] || beam.spin != Expr::Number(0.0);
    let flexible = mechanism.beams.iter().filter(spins).map(|beam| {
        let density = beam.sections.iter().map(|(_, weight, section)| weight * values.of(&section.mass)).sum::<f64>();
        density * values.of(&beam.length)
    });
    let shafts = mechanism.shafts.iter().filter(|shaft| shaft.speed != Expr::Number(0.0));
    let stepped = shafts.flat_map(|shaft| &shaft.weights).map(|[_, mass]| values.of(mass));
    rigid.chain(flexible).chain(stepped).sum()
}

/// Length of a shaft, m, its mass, kg, and how far its centre of mass is from its root, m, in the nominal design; nothing where an
/// input decides.
pub fn nominal_weight(mechanism: &Mechanism, shaft: &Shaft) -> Option<[f64; 3]> {
    let design: Vec<f64> = mechanism.design.iter().map(|value| value.nominal).collect();
    let values = Values::new(&mechanism.constants, &[], &design);
    let [mut length, mut mass, mut moment] = [0.0; 3];
    for [own_length, own_mass] in shaft.weights.iter().map(|weight| weight.each_ref().map(|x| values.of(x))) {
        moment += own_mass * (length + own_length / 2.0);
        length += own_length;
        mass += own_mass;
    }
    (mass > 0.0).then(|| [length, mass, moment / mass])
}

/// For each body whether a running coordinate turns it.
fn turning(mechanism: &Mechanism) -> Vec<bool> {
    let mut turns = vec![false; mechanism.bodies.len()];
    // A joint can stand before the one that carries it.
    for _ in 0..mechanism.joints.len() {
        for joint in mechanism.joints.iter().filter(|joint| !joint.cut) {
            let Frame::Body(to) = joint.to else { continue };
            let carried = matches!(joint.from, Frame::Body(from) if turns[from.index()]);
            let own = joint.steps.iter().map(|step| &mechanism.coordinates[step.coordinate.index()]);
            let mut own = own.filter(|own| own.quantity == CoordinateQuantity::Angle);
            turns[to.index()] |= carried || own.any(|own| own.motion.runs());
        }
    }
    turns
}

/// An unbalance.
#[derive(Clone, Debug, PartialEq)]
pub struct Unbalanced {
    /// Number of the excitation.
    pub excitation: usize,
    /// Mass times distance from the axis, kg m.
    pub first_moment: f64,
    /// The design variable that is its size, if it is one.
    pub size: Option<DesignId>,
}

/// The unbalances with a first moment of mass: all but tilts.
pub fn unbalances(mechanism: &Mechanism, u: &[f64], b: &[f64]) -> Vec<Unbalanced> {
    let values = Values::new(&mechanism.constants, u, b);
    let each = mechanism.excitations.iter().enumerate().filter_map(|(excitation, declared)| {
        let ExcitationLaw::Unbalance { body, deviation, .. } = &declared.law else {
            return None;
        };
        let (size, mass) = match deviation {
            Deviation::Amount(amount) => (amount, 1.0),
            Deviation::Eccentricity(eccentricity) => (eccentricity, mass(&mechanism.bodies[body.index()], &values)),
            Deviation::Tilt(_) => return None,
        };
        let first_moment = mass * values.of(size);
        let size = match size {
            Expr::Design(id) => Some(*id),
            _ => None,
        };
        Some(Unbalanced { excitation, first_moment, size })
    });
    each.collect()
}

fn mass(body: &Body, values: &Values<'_>) -> f64 {
    body.parts
        .iter()
        .map(|part| {
            let mass = values.of(part.shape.reduced().mass);
            if part.hole { -mass } else { mass }
        })
        .sum()
}
