//! A disk on a light elastic shaft (Jeffcott), in ground and in shaft coordinates.

use super::{body, prismatic, spinning};
use crate::model::{
    Amount, Coordinate, Expr, Force, ForceLaw, Frame, Joint, Matrix, Model, Motion, ORIGIN, Part, Placement, Point,
    Shape, Step, Unit, Value, Word, diagonal,
};

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

fn number(number: f64) -> Value {
    Value::Number(number)
}

fn disk(mass: f64) -> Vec<Part> {
    vec![Part::whole(Shape::Disk { mass: Amount::Mass(number(mass)), radius: number(0.2), axis: Z, center: ORIGIN })]
}

fn force(model: &mut Model, law: ForceLaw) {
    let name = format!("force{}", model.forces.len());
    model.forces.push(Force { name, law });
}

fn point(model: &mut Model, frame: Frame) -> usize {
    let name = format!("point{}", model.points.len());
    model.points.push(Point { name, frame, placement: Placement::NONE });
    model.points.len() - 1
}

/// Drag of the surrounding medium on the disk.
fn external(model: &mut Model, disk: usize, damping: f64) {
    let point = point(model, Frame::Body(disk));
    let law = ForceLaw::Drag { point, damping: number(damping), turning_damping: number(0.3) };
    force(model, law);
}

/// Slides fixed in the ground, then the driven rotation; one bearing stiffness along each slide.
pub fn jeffcott_in_the_ground(mass: f64, stiffness: [f64; 2], damping: f64) -> Model {
    let mut model = spinning("Jeffcott");
    model.bodies = vec![body("disk", disk(mass))];
    let steps = vec![
        Step::new(Motion::Slide, X).named("px"),
        Step::new(Motion::Slide, Y).named("py"),
        Step::new(Motion::Turn, Z).named("turn").driven(0, 1.0),
    ];
    let (ground, disk) = (Frame::Ground, Frame::Body(0));
    model.joints = vec![Joint::new("bearing", Word::Planar, steps, ground, disk)];
    for (step, stiffness) in stiffness.into_iter().enumerate() {
        let coordinate = Coordinate { joint: 0, step };
        let law = ForceLaw::Spring { coordinate, stiffness: number(stiffness), rest: number(0.0) };
        force(&mut model, law);
    }
    external(&mut model, 0, damping);
    model
}

/// Slides fixed in the turning shaft, with the shaft's stiffness and internal damping.
pub fn jeffcott_in_the_shaft(mass: f64, stiffness: f64, internal: f64, damping: f64) -> Model {
    let mut model = plain_in_the_shaft(mass);
    for joint in [1, 2] {
        let coordinate = Coordinate { joint, step: 0 };
        let spring = ForceLaw::Spring { coordinate, stiffness: number(stiffness), rest: number(0.0) };
        let damper = ForceLaw::Damper { coordinate, damping: number(internal) };
        force(&mut model, spring);
        force(&mut model, damper);
    }
    external(&mut model, 2, damping);
    model
}

fn plain_in_the_shaft(mass: f64) -> Model {
    let mut model = spinning("Jeffcott");
    model.bodies.push(body("carriage", Vec::new()));
    model.bodies.push(body("disk", disk(mass)));
    model.joints.push(prismatic("along_x", X, Frame::Body(0), 1));
    model.joints.push(prismatic("along_y", Y, Frame::Body(1), 2));
    model
}

/// Ground coordinates, with stiffness and internal damping from a bushing whose axes turn with the shaft.
pub fn steadied_by_the_shaft(mass: f64, stiffness: f64, internal: f64, damping: f64) -> Model {
    let mut model = jeffcott_in_the_ground(mass, [0.0; 2], damping);
    model.forces.clear();
    model.points.clear();
    model.bodies.push(body("shaft", Vec::new()));
    let step = Step::new(Motion::Turn, Z).driven(0, 1.0);
    let (ground, shaft) = (Frame::Ground, Frame::Body(1));
    model.joints.push(Joint::new("spin", Word::Revolute, vec![step], ground, shaft));
    let (from, to) = (point(&mut model, shaft), point(&mut model, Frame::Body(0)));
    let all = |value: f64| -> Matrix { diagonal([number(value); 3]) };
    let law = ForceLaw::Bushing {
        from,
        to,
        stiffness: all(stiffness),
        damping: all(internal),
        turning_stiffness: all(7.0),
        turning_damping: all(0.4),
    };
    force(&mut model, law);
    external(&mut model, 0, damping);
    model
}

/// Shaft coordinates, with a ground-fixed bearing that is stiffer in one direction: no steady state.
pub fn anisotropic_bearing(mass: f64, stiffness: [f64; 2]) -> Model {
    let mut model = plain_in_the_shaft(mass);
    let disk = point(&mut model, Frame::Body(2));
    let along = |axis: usize| {
        let unit = Unit::NewtonPerMetre;
        Expr::Product(vec![
            Expr::number(0.5),
            Expr::Value(number(stiffness[axis]), unit),
            Expr::Power(Box::new(Expr::Position(disk, axis)), 2),
        ])
    };
    let energy = Expr::Sum(vec![along(0), along(1)]);
    force(&mut model, ForceLaw::Potential { energy });
    model
}
