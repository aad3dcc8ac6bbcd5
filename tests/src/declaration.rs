//! Prints a model in the language of `mechanism!`, every number to full precision.

use crate::model::{
    Drive, Force, ForceLaw, Frame, Joint, JointKind, Model, Placement, Shape, Unit, Value, Values,
};

/// The declaration of a model: what stands between the braces of `mechanism! { ... }`.
pub fn declaration(model: &Model) -> String {
    let print = Printer { model };
    let mut lines = Vec::new();
    for input in &model.inputs {
        lines.push(format!("input {}: {};", input.name, symbol(input.unit)));
    }
    for variable in &model.design {
        let nominal = quantity(variable.nominal, variable.unit);
        lines.push(format!("design {} = {nominal};", variable.name));
    }
    lines.push(format!(
        "gravity {};",
        print.vector(&model.gravity, Unit::MetrePerSquareSecond)
    ));
    for body in &model.bodies {
        lines.push(format!("body {}: {};", body.name, print.shape(&body.shape)));
    }
    lines.extend(model.joints.iter().map(|joint| print.joint(joint)));
    for point in &model.points {
        let (frame, at) = (print.frame(point.frame), print.metres(&point.position));
        lines.push(format!("point {}: {frame} at {at};", point.name));
    }
    lines.extend(model.forces.iter().map(|force| print.force(force)));
    format!(
        "pub mechanism {} {{\n    {}\n}}\n",
        model.name,
        lines.join("\n    ")
    )
}

/// The symbol of a unit.
fn symbol(unit: Unit) -> &'static str {
    match unit {
        Unit::Kilogram => "kg",
        Unit::Metre => "m",
        Unit::Radian => "rad",
        Unit::KilogramSquareMetre => "kg*m^2",
        Unit::NewtonPerMetre => "N/m",
        Unit::NewtonMetrePerRadian => "N*m/rad",
        Unit::NewtonSecondPerMetre => "N*s/m",
        Unit::NewtonMetreSecondPerRadian => "N*m*s/rad",
        Unit::MetrePerSquareSecond => "m/s^2",
        Unit::MetrePerSecond => "m/s",
        Unit::RadianPerSecond => "rad/s",
    }
}

fn quantity(number: f64, unit: Unit) -> String {
    format!("{number:?} {}", symbol(unit))
}

/// A direction: `x`, `-z` or its components.
fn direction(axis: &[f64; 3]) -> String {
    for (index, name) in ["x", "y", "z"].into_iter().enumerate() {
        let mut unit = [0.0; 3];
        unit[index] = 1.0;
        if *axis == unit {
            return name.to_owned();
        }
        if axis.map(|component| -component) == unit {
            return format!("-{name}");
        }
    }
    format!("[{:?}, {:?}, {:?}]", axis[0], axis[1], axis[2])
}

struct Printer<'a> {
    model: &'a Model,
}

impl Printer<'_> {
    fn value(&self, value: Value, unit: Unit) -> String {
        match value {
            Value::Number(number) => quantity(number, unit),
            Value::Design { variable, factor } => {
                let name = &self.model.design[variable].name;
                if factor == 1.0 {
                    name.clone()
                } else {
                    format!("{factor:?} * {name}")
                }
            }
        }
    }

    /// `[1.0, 2.0, 3.0] m` for numbers alone, `[0.5 * b2, 0.1 m, 0]` for a mixture.
    fn list(&self, values: &[Value], unit: Unit) -> String {
        let numbers = values.iter().map(|value| match value {
            Value::Number(number) => Some(format!("{number:?}")),
            Value::Design { .. } => None,
        });
        if let Some(numbers) = numbers.collect::<Option<Vec<_>>>() {
            return format!("[{}] {}", numbers.join(", "), symbol(unit));
        }
        let component = |value: &Value| match value {
            Value::Number(0.0) => "0".to_owned(),
            other => self.value(*other, unit),
        };
        format!(
            "[{}]",
            values.iter().map(component).collect::<Vec<_>>().join(", ")
        )
    }

    fn vector(&self, values: &Values, unit: Unit) -> String {
        self.list(values, unit)
    }

    fn metres(&self, values: &Values) -> String {
        self.vector(values, Unit::Metre)
    }

    fn frame(&self, frame: Frame) -> &str {
        match frame {
            Frame::Ground => "ground",
            Frame::Body(body) => &self.model.bodies[body].name,
        }
    }

    fn shape(&self, shape: &Shape) -> String {
        let mass = |mass: &Value| format!("mass: {}", self.value(*mass, Unit::Kilogram));
        let metre = |value: &Value| self.value(*value, Unit::Metre);
        match shape {
            Shape::Massless => "massless".to_owned(),
            Shape::Point { mass: m, center } => {
                format!("point({}, center: {})", mass(m), self.metres(center))
            }
            Shape::Rod {
                mass: m,
                length,
                along,
                center,
            } => {
                let center = center.map(|center| format!(", center: {}", self.metres(&center)));
                let (length, along) = (metre(length), direction(along));
                let center = center.unwrap_or_default();
                format!("rod({}, length: {length}, along: {along}{center})", mass(m))
            }
            Shape::Disk {
                mass: m,
                radius,
                axis,
                center,
            } => format!(
                "disk({}, radius: {}, axis: {}, center: {})",
                mass(m),
                metre(radius),
                direction(axis),
                self.metres(center)
            ),
            Shape::Cylinder {
                mass: m,
                radius,
                length,
                axis,
                center,
            } => format!(
                "cylinder({}, radius: {}, length: {}, axis: {}, center: {})",
                mass(m),
                metre(radius),
                metre(length),
                direction(axis),
                self.metres(center)
            ),
            Shape::Cuboid {
                mass: m,
                size,
                center,
            } => {
                let (size, center) = (self.metres(size), self.metres(center));
                format!("box({}, size: {size}, center: {center})", mass(m))
            }
            Shape::Sphere {
                mass: m,
                radius,
                center,
            } => format!(
                "sphere({}, radius: {}, center: {})",
                mass(m),
                metre(radius),
                self.metres(center)
            ),
            Shape::Rigid {
                mass: m,
                center,
                inertia,
            } => {
                let inertia = self.list(inertia, Unit::KilogramSquareMetre);
                format!(
                    "rigid({}, center: {}, inertia: {inertia})",
                    mass(m),
                    self.metres(center)
                )
            }
        }
    }

    /// ` at [..] rotated(axis, angle)`, or nothing.
    fn placement(&self, placement: &Placement) -> String {
        if *placement == Placement::NONE {
            return String::new();
        }
        let mut text = format!(" at {}", self.metres(&placement.offset));
        for (axis, angle) in &placement.rotations {
            let angle = self.value(*angle, Unit::Radian);
            text.push_str(&format!(" rotated({}, {angle})", direction(axis)));
        }
        text
    }

    fn joint(&self, joint: &Joint) -> String {
        let kind = match &joint.kind {
            JointKind::Fixed => "fixed".to_owned(),
            JointKind::Revolute(axis) => format!("revolute({})", direction(axis)),
            JointKind::Prismatic(axis) => format!("prismatic({})", direction(axis)),
        };
        let mut text = format!(
            "joint {}: {kind} from {} to {}",
            joint.name,
            self.frame(joint.from),
            self.frame(joint.to)
        );
        let (from, to) = (
            self.placement(&joint.from_placement),
            self.placement(&joint.to_placement),
        );
        text.push_str(&from);
        if !to.is_empty() {
            text.push_str(if from.is_empty() { "" } else { "," });
            text.push_str(&format!("{to} on {}", self.frame(joint.to)));
        }
        if let Some(Drive { input, factor }) = joint.drive {
            let name = &self.model.inputs[input].name;
            let factor = if factor == 1.0 {
                String::new()
            } else {
                format!("{factor:?} * ")
            };
            text.push_str(&format!(", driven at {factor}{name}"));
        }
        text.push(';');
        text
    }

    /// Units of stiffness, damping and position of a joint's coordinate.
    fn coordinate_units(&self, joint: usize) -> [Unit; 3] {
        match self.model.joints[joint].kind {
            JointKind::Prismatic(_) => [
                Unit::NewtonPerMetre,
                Unit::NewtonSecondPerMetre,
                Unit::Metre,
            ],
            _ => [
                Unit::NewtonMetrePerRadian,
                Unit::NewtonMetreSecondPerRadian,
                Unit::Radian,
            ],
        }
    }

    fn force(&self, force: &Force) -> String {
        let law = match &force.law {
            ForceLaw::Spring {
                joint,
                stiffness,
                rest,
            } => {
                let [stiffness_unit, _, rest_unit] = self.coordinate_units(*joint);
                format!(
                    "spring(on: {}, stiffness: {}, rest: {})",
                    self.model.joints[*joint].name,
                    self.value(*stiffness, stiffness_unit),
                    self.value(*rest, rest_unit)
                )
            }
            ForceLaw::Damper { joint, damping } => {
                let [_, unit, _] = self.coordinate_units(*joint);
                let damping = self.value(*damping, unit);
                format!(
                    "damper(on: {}, damping: {damping})",
                    self.model.joints[*joint].name
                )
            }
            ForceLaw::SpringDamper {
                from,
                to,
                stiffness,
                damping,
                length,
            } => format!(
                "spring_damper(from: {}, to: {}, stiffness: {}, damping: {}, length: {})",
                self.model.points[*from].name,
                self.model.points[*to].name,
                self.value(*stiffness, Unit::NewtonPerMetre),
                self.value(*damping, Unit::NewtonSecondPerMetre),
                self.value(*length, Unit::Metre)
            ),
        };
        format!("force {}: {law};", force.name)
    }
}
