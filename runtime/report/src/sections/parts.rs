//! Tables of bodies, joints, forces and constraints.

use eigentol::picture::{Beam, Body, Joint, Scene, Section, Shape, Solid};
use eigentol::{Description, ExcitationInfo};
use eigentol_tables::Table;

use crate::words::number;

/// The non-empty tables with their captions.
pub(super) fn tables(scene: &Scene, d: &Description) -> Vec<(&'static str, Table)> {
    [
        ("Bodies; lengths in m, masses in kg", bodies(scene)),
        ("Joints", joints(scene)),
        ("Gravity, drives, forces, constraints and curves; numbers in SI", elements(scene)),
        ("Excitations", excitations(d)),
        ("What rolls", wheels(scene)),
    ]
    .into_iter()
    .filter(|(_, x)| x.rows() > 0)
    .collect()
}

fn excitations(d: &Description) -> Table {
    let mut table = Table::new("excitations");
    let all = || d.excitations.iter();
    table.texts("excitation", all().map(|info| Some(info.name.to_string())));
    table.texts("kind", all().map(|info| Some(info.kind.to_string())));
    let order = |info: &ExcitationInfo| Some(info.order.to_string()).filter(|order| !order.is_empty());
    table.texts("order", all().map(order));
    table
}

fn bodies(scene: &Scene) -> Table {
    let all = scene.bodies.iter().enumerate();
    let all = all.filter(|(number, _)| !scene.is_of_beam(*number));
    let mut table = Table::new("bodies");
    let names = all.clone().map(|(_, body)| &body.name);
    let names = names.chain(scene.beams.iter().map(|beam| &beam.name));
    table.texts("body", names.map(|name| Some(name.to_string())));
    let is_station =
        |number: usize| scene.joints.iter().any(|joint| joint.is_flexure() && joint.to.body == Some(number));
    let made_of = |(number, body): (usize, &Body)| match &body.solids[..] {
        [] => "massless".to_owned(),
        _ if is_station(number) => "station of a superelement".to_owned(),
        all => all.iter().map(solid).collect::<Vec<_>>().join("; "),
    };
    let made_of = all.map(made_of).chain(scene.beams.iter().map(|member| beam(scene, member)));
    table.texts("made of", made_of.map(Some));
    table
}

fn beam(scene: &Scene, member: &Beam) -> String {
    let size = |[width, height]: [f64; 2]| {
        if member.round {
            format!("diameter {}", number(width))
        } else {
            format!("{} x {}", number(width), number(height))
        }
    };
    let sections = || member.sections.iter();
    let (word, ends) = if scene.is_shaft(member) {
        let by_size = |a: &&Section, b: &&Section| a.size[0].total_cmp(&b.size[0]);
        ("shaft", [sections().min_by(by_size), sections().max_by(by_size)])
    } else {
        ("beam", [sections().next(), sections().last()])
    };
    let [Some(root), Some(tip)] = ends.map(|end| end.map(|section| section.size)) else {
        return word.to_owned();
    };
    if root == [0.0; 2] {
        word.to_owned()
    } else if root == tip {
        format!("{word}, {}", size(root))
    } else {
        format!("{word}, {} to {}", size(root), size(tip))
    }
}

fn solid(part: &Solid) -> String {
    let text = shape(&part.shape);
    if part.hole { format!("less a {text}") } else { text }
}

fn shape(shape: &Shape) -> String {
    match shape {
        Shape::Point { mass } => format!("point mass, {}", number(*mass)),
        Shape::Rod { length, .. } => format!("rod, length {}", number(*length)),
        Shape::Disk { radius, .. } => format!("disk, radius {}", number(*radius)),
        Shape::Cylinder { radius, length, .. } => {
            format!("cylinder, radius {}, length {}", number(*radius), number(*length))
        }
        Shape::Tube { inner, outer, length, .. } => {
            format!("tube, radii {} and {}, length {}", number(*inner), number(*outer), number(*length))
        }
        Shape::Box { size, .. } => format!("box, {}", size.map(number).join(" x ")),
        Shape::Sphere { radius } => format!("sphere, radius {}", number(*radius)),
        Shape::Ellipsoid { semi_axes, .. } => format!(
            "rigid body of given inertia, drawn as an ellipsoid of semi-axes {}",
            semi_axes.map(number).join(", ")
        ),
    }
}

/// The name of a body; `None` is the ground.
fn body(scene: &Scene, number: Option<usize>) -> Option<String> {
    let name = number.map(|number| scene.bodies.get(number).map(|body| body.name.to_string()));
    name.unwrap_or_else(|| Some("ground".to_owned()))
}

fn joints(scene: &Scene) -> Table {
    let all = scene.joints.iter().filter(|joint| !joint.is_flexure());
    let mut table = Table::new("joints");
    table.texts("joint", all.clone().map(|x| Some(x.name.to_string())));
    table.texts("kind", all.clone().map(|x| Some(x.kind.to_string())));
    table.texts("from", all.clone().map(|x| body(scene, x.from.body)));
    table.texts("to", all.clone().map(|x| body(scene, x.to.body)));
    table.texts("role", all.map(|joint: &Joint| joint.closes_loop.then(|| "closes a loop".to_owned())));
    table
}

fn elements(scene: &Scene) -> Table {
    let all = scene.elements.iter();
    let mut table = Table::new("elements");
    table.texts("name", all.clone().map(|x| Some(x.name.to_string())));
    table.texts("kind", all.clone().map(|x| Some(x.kind.to_string())));
    table.texts("law", all.map(|x| Some(x.law.to_string())));
    table
}

fn wheels(scene: &Scene) -> Table {
    let all = scene.wheels.iter();
    let mut table = Table::new("wheels");
    table.texts("name", all.clone().map(|x| Some(x.name.to_string())));
    table.numbers("radius", "m", all.map(|x| x.radius));
    table
}
