//! What is worth knowing about beams that are right.

use crate::algebra::{ExprId, Graph, Vector3};
use crate::base::ids::BodyId;
use crate::mechanics::equations::carried;
use crate::mechanics::motion::Kinematics;
use crate::mechanics::setup::{Context, at_rest, vanish};
use crate::model::expression::Expr;
use crate::model::mechanism::{Beam, Frame, Mechanism};

/// Notes on beams that loads split, that twist without bending in both planes, or that spin and carry what does not.
pub(crate) fn notes_on_beams(mechanism: &Mechanism) -> Vec<String> {
    let mut notes = Vec::new();
    for beam in &mechanism.beams {
        let [torsion, about_y, about_z] = beam.coordinates.each_ref().map(|ids| !ids.is_empty());
        let root = &mechanism.bodies[beam.body.index()].name;
        if beam.whole != beam.name {
            notes.push(format!(
                "`{}` carries loads between its ends, so it is split there: `{}` starts at `{root}`",
                beam.whole, beam.name
            ));
        }
        if torsion && about_y != about_z && beam.whole == *root {
            notes.push(format!(
                "`{}` twists and bends in one plane only: right as long as it is nearly straight",
                beam.whole
            ));
        }
        for body_id in welded_to(mechanism, beam) {
            notes.push(format!(
                "`{}` is fixed to `{}` and does not spin with its material; what does is held by a joint driven at the same speed",
                mechanism.bodies[body_id.index()].name,
                beam.whole
            ));
        }
    }
    notes
}

/// Notes on beams that carry a load where they have no coordinates to bend: at their root it has a moment there.
pub(crate) fn notes_on_planes(g: &mut Graph, context: &Context, kinematics: &Kinematics) -> Vec<String> {
    let mechanism = context.mechanism;
    let is_rigid = |beam: &Beam, k: usize| beam.coordinates[k].is_empty();
    if !mechanism.beams.iter().any(|beam| is_rigid(beam, 1) || is_rigid(beam, 2)) {
        return Vec::new();
    }
    let running = &context.symbols.running.values;
    let carried = carried(g, context, running, kinematics);
    let mut notes = Vec::new();
    for beam in &mechanism.beams {
        let axes = kinematics.of(beam.body).frame.orientation.axes.transpose();
        let moment: Vector3 = axes.apply(g, carried[beam.body.index()].moment);
        let about: Vec<ExprId> =
            beam.axes[1..].iter().map(|axis| context.values.vector(g, axis).dot(g, moment)).collect();
        let about = at_rest(g, context.symbols, &about);
        let is_zero = vanish(g, context, &about);
        for (k, name) in [(1, "bending_y"), (2, "bending_z")] {
            let note = format!(
                "`{}` stays straight where a load would bend it: it has no coordinates of `{name}`",
                beam.whole
            );
            if is_rigid(beam, k) && !is_zero[k - 1] && !notes.contains(&note) {
                notes.push(note);
            }
        }
    }
    notes
}

/// Whether a body is the root or a station of a beam that spins.
pub(crate) fn is_on_spinning(mechanism: &Mechanism, body: BodyId) -> bool {
    mechanism.beams.iter().filter(|beam| spins(beam)).into_iter().any(|beam| has(beam, body))
}

fn spins(beam: &Beam) -> bool {
    beam.spin != Expr::Number(0.0)
}

fn has(beam: &Beam, body: BodyId) -> bool {
    beam.body == body || beam.stations.iter().any(|station| station.body == body)
}

/// Bodies with a mass that are welded to a beam that spins.
fn welded_to(mechanism: &Mechanism, beam: &Beam) -> Vec<BodyId> {
    let welds = mechanism.joints.iter().filter(|joint| joint.steps.is_empty() && spins(beam));
    welds
        .filter_map(|joint| match (joint.from, joint.to) {
            (Frame::Body(from), Frame::Body(to)) if has(beam, from) => Some(to),
            _ => None,
        })
        .filter(|x| !mechanism.bodies[x.index()].parts.is_empty())
        .collect()
}
