//! The text of the declaration.
//!
//! # Robots are imported as text
//!
//! `macros/urdf` writes a declaration that a person can read, change and keep; it asks the compiler only which
//! coordinates nothing resists. Welded links are summed numerically, because dummy inertias make sense only together.
//! URDF is read as XML (roxmltree), not with urdf-rs, which rejects three of 69 files for the meshes they name, gives
//! no lines and columns, and drops what it does not know.

use std::fmt::Write as _;

use crate::Import;
use crate::assemble::{Assembly, Body, Coordinate, Coupling, Moving};
use crate::geometry::{Pose, Vector};
use crate::options::Resistance;

/// The declaration, with its names and notes.
pub(crate) fn write(assembly: &Assembly) -> Import {
    let kernels_only = assembly.resistance == Resistance::KernelsOnly;
    Import {
        declaration: declaration(assembly, kernels_only),
        names: assembly.names.renamed.clone(),
        notes: assembly.notes.clone(),
    }
}

/// The text of the declaration; `kernels_only` declares only its kernels.
pub(crate) fn declaration(assembly: &Assembly, kernels_only: bool) -> String {
    let mut text = format!(
        "/// The robot `{}`, from a URDF file.\npub mechanism {} {{\n",
        printable(&assembly.robot),
        assembly.name
    );
    let mut line = |name: &str, item: String| {
        let original = assembly.names.renamed.get(name);
        let comment = original.map(|original| format!(" // `{}`", printable(original)));
        let _ = writeln!(text, "    {item};{}", comment.unwrap_or_default());
    };
    if kernels_only {
        line("", "kernels only".to_owned());
    }
    line("", "gravity 9.81 m/s^2 along -z".to_owned());
    for one in &assembly.bodies {
        line(&one.name, body(one));
    }
    for one in &assembly.joints {
        line(&one.name, joint(one));
    }
    for point in &assembly.points {
        let (name, body) = (&point.name, &point.body);
        line(name, format!("point {name}: {body}{}", placed(&point.pose)));
    }
    for one in &assembly.couplings {
        line("", coupling(one));
    }
    for damper in &assembly.dampers {
        let unit = if damper.is_angle { "N*m*s/rad" } else { "N*s/m" };
        line(
            "",
            format!("force {}: damper(on: {}, damping: {} {unit})", damper.name, damper.on, number(damper.damping)),
        );
    }
    if !kernels_only {
        let is_free = |is_angle: bool| {
            let mut all = assembly.joints.iter().flat_map(|joint| &joint.coordinates);
            all.any(|coordinate| coordinate.is_angle == is_angle && !coordinate.driven)
        };
        for item in springs(assembly.resistance, is_free) {
            line("", item);
        }
    }
    text.push_str("}\n");
    text
}

/// Removes characters that would end a comment or a line.
pub(crate) fn printable(name: &str) -> String {
    let printable = |c: char| if c.is_control() || c == '`' { ' ' } else { c };
    name.chars().map(printable).collect()
}

/// Writes a number so that it is read back unchanged.
pub(crate) fn number(value: f64) -> String {
    // Avoids negative zero.
    format!("{:?}", value + 0.0)
}

pub(crate) fn vector(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|value| number(*value)).collect();
    format!("[{}]", values.join(", "))
}

pub(crate) fn direction(axis: Vector) -> String {
    match axis {
        [x, 0.0, 0.0] => signed(x, "x"),
        [0.0, y, 0.0] => signed(y, "y"),
        [0.0, 0.0, z] => signed(z, "z"),
        axis => vector(&axis),
    }
}

fn signed(value: f64, axis: &str) -> String {
    let sign = if value < 0.0 { "-" } else { "" };
    format!("{sign}{axis}")
}

pub(crate) fn body(body: &Body) -> String {
    let Some(mass) = &body.mass else {
        return format!("body {}: massless", body.name);
    };
    let center = match mass.center {
        [0.0, 0.0, 0.0] => String::new(),
        center => format!(", center: {} m", vector(&center)),
    };
    let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = mass.inertia;
    let entries = [xx, yy, zz, xy, yz, xz];
    let (name, mass) = (&body.name, number(mass.mass));
    if entries.iter().all(|entry| *entry == 0.0) {
        return format!("body {name}: point(mass: {mass} kg{center})");
    }
    let inertia = match entries {
        [xx, yy, zz, 0.0, 0.0, 0.0] => vector(&[xx, yy, zz]),
        entries => vector(&entries),
    };
    format!("body {name}: rigid(mass: {mass} kg, inertia: {inertia} kg*m^2{center})")
}

fn joint(joint: &Moving) -> String {
    let named = joint.coordinates.len() > 1;
    let axis = |coordinate: &Coordinate| {
        let axis = direction(coordinate.axis);
        if named { format!("{}: {axis}", coordinate.name) } else { axis }
    };
    let axes: Vec<String> = joint.coordinates.iter().map(axis).collect();
    let mut text = format!(
        "joint {}: {}({}) from {} to {}{}",
        joint.name,
        joint.kind,
        axes.join(", "),
        joint.from,
        joint.to,
        placed(&joint.pose)
    );
    for coordinate in joint.coordinates.iter().filter(|coordinate| coordinate.driven) {
        let name = if named { format!(" {}", coordinate.name) } else { String::new() };
        let _ = write!(text, ",{name} driven at 0");
    }
    text
}

pub(crate) fn placed(pose: &Pose) -> String {
    let mut text = String::new();
    if pose.offset != [0.0; 3] {
        let _ = write!(text, " at {} m", vector(&pose.offset));
    }
    for &(axis, angle) in &pose.rotations {
        let _ = write!(text, " rotated({}, {} rad)", direction(axis), number(angle));
    }
    text
}

fn coupling(coupling: &Coupling) -> String {
    let unit = match (coupling.of.1, coupling.with.1) {
        (true, false) => " rad/m",
        (false, true) => " m/rad",
        _ => "",
    };
    let offset = match coupling.offset {
        0.0 => String::new(),
        offset => {
            let unit = if coupling.of.1 { "rad" } else { "m" };
            format!(", offset: {} {unit}", number(offset))
        }
    };
    format!(
        "constraint {}: coupling(of: {}, with: {}, ratio: {}{unit}{offset})",
        coupling.name,
        coupling.of.0,
        coupling.with.0,
        number(coupling.ratio)
    )
}

/// Springs and dampers on all free coordinates, of the kinds that there are.
pub(crate) fn springs(resistance: Resistance, is_free: impl Fn(bool) -> bool) -> Vec<String> {
    let Resistance::Springs { stiffness, damping, linear_stiffness, linear_damping } = resistance else {
        return Vec::new();
    };
    let mut items = Vec::new();
    if is_free(true) {
        items.push(format!(
            "every angle: spring_damper(stiffness: {} N*m/rad, damping: {} N*m*s/rad)",
            number(stiffness),
            number(damping)
        ));
    }
    if is_free(false) {
        items.push(format!(
            "every displacement: spring_damper(stiffness: {} N/m, damping: {} N*s/m)",
            number(linear_stiffness),
            number(linear_damping)
        ));
    }
    items
}
