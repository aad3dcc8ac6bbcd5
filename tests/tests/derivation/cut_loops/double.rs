//! The double of a tree: a free joint replaces one joint, which is declared again to close the loop.

use eigentol_oracle::declaration::declaration;
use eigentol_oracle::model::{Expr, ForceLaw, Joint, Model, Motion, Point, Step, Word};

use super::pose::Embedding;

/// How the loop of the double is closed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Closing {
    /// Gives the free joint the placements of the cut one; otherwise it has none.
    pub(crate) placed: bool,
    /// Closes the loop by point constraints equivalent to the joint; otherwise by the joint.
    pub(crate) by_constraints: bool,
}

impl Closing {
    pub(crate) const fn new(placed: bool, by_constraints: bool) -> Self {
        Self { placed, by_constraints }
    }
}

/// Coordinates of the free joint.
pub(crate) const LOOSE: [&str; 6] = ["loose_x", "loose_y", "loose_z", "loose_a", "loose_b", "loose_c"];

/// The declaration with the joint cut and a free joint in its place.
pub(crate) fn cut_text(model: &Model, joint: usize, embedding: &Embedding, closing: Closing) -> String {
    let original = &model.joints[joint];
    let slides = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| Step::new(Motion::Slide, axis));
    let turns = embedding.turns.axes().map(|axis| Step::new(Motion::Turn, axis));
    let steps = slides.into_iter().chain(turns).zip(LOOSE);
    let steps = steps.map(|(step, name)| step.named(name)).collect();
    let mut double = model.clone();
    let mut loose = Joint::new("loose", Word::Free, steps, original.from, original.to);
    if closing.placed {
        loose.from_placement = original.from_placement.clone();
        loose.to_placement = original.to_placement.clone();
    }
    double.joints[joint] = loose;
    let ends = [("from_end", original.from, &original.from_placement), ("to_end", original.to, &original.to_placement)];
    if closing.by_constraints {
        double.points.extend(ends.map(|(name, frame, placement)| Point {
            name: name.to_owned(),
            frame,
            placement: placement.clone(),
        }));
    }
    let text = declaration(&double);
    let end = text.rfind('}').expect("a closing brace");
    let items = match closing.by_constraints {
        true => constraints(original),
        false => cut_joint(model, original),
    };
    format!("{}    {items}\n}}\n", &text[..end])
}

fn cut_joint(model: &Model, joint: &Joint) -> String {
    let start = format!("joint {}:", joint.name);
    let open = declaration(model);
    let line = open.lines().map(str::trim).find(|line| line.starts_with(&start));
    let line = line.expect("the joint is declared");
    format!("{}, cut;", line.trim_end_matches(';'))
}

/// The constraints on two points that are equivalent to a fixed, revolute or spherical joint.
fn constraints(joint: &Joint) -> String {
    let pin = "constraint pin: coincident(from: from_end, to: to_end);";
    let aligned = match (joint.word, &joint.steps[..]) {
        (Word::Fixed, _) => "constraint square: aligned(from: from_end, to: to_end);".to_owned(),
        (Word::Revolute, [step]) => {
            let [x, y, z] = step.axis;
            format!("constraint parallel: aligned(from: from_end, to: to_end, axis: [{x:?}, {y:?}, {z:?}]);")
        }
        _ => String::new(),
    };
    format!("{pin} {aligned}")
}

/// Removes forces that a cut joint cannot have, as it has no coordinates.
pub(crate) fn without_forces_on(mut model: Model, joint: usize) -> Model {
    let on = |value: &Expr| {
        let mut found = false;
        value.leaves(&mut |leaf| {
            if let Expr::Coordinate(one) | Expr::Rate(one) = leaf {
                found |= one.joint == joint;
            }
        });
        found
    };
    model.forces.retain(|force| match &force.law {
        ForceLaw::Spring { coordinate, .. }
        | ForceLaw::Damper { coordinate, .. }
        | ForceLaw::Inerter { coordinate, .. } => coordinate.joint != joint,
        ForceLaw::Generalized { coordinate, value } => coordinate.joint != joint && !on(value),
        ForceLaw::Potential { energy } => !on(energy),
        _ => true,
    });
    model
}
