//! Values with units, directions, placements.

use crate::model::{Frame, Matrix, Model, Placement, Unit, Value, Values, diagonal};

pub(super) struct Printer<'a> {
    pub(super) model: &'a Model,
}

/// The symbol of a unit; empty for a plain number.
pub(super) fn symbol(unit: Unit) -> String {
    let known = match unit {
        Unit::Kilogram => "kg",
        Unit::Metre => "m",
        Unit::Radian => "rad",
        Unit::KilogramSquareMetre => "kg*m^2",
        Unit::Newton => "N",
        Unit::NewtonMetre => "N*m",
        Unit::NewtonPerMetre => "N/m",
        Unit::NewtonMetrePerRadian => "N*m/rad",
        Unit::NewtonSecondPerMetre => "N*s/m",
        Unit::NewtonMetreSecondPerRadian => "N*m*s/rad",
        Unit::MetrePerSquareSecond => "m/s^2",
        Unit::MetrePerSecond => "m/s",
        Unit::RadianPerSecond => "rad/s",
        Unit::Of(exponents) => return product(exponents),
    };
    known.to_owned()
}

/// `kg*m^2/s^2`, `kg/(m*s^2)`, `1/s`.
fn product(exponents: [i8; 3]) -> String {
    let power = |(name, exponent): (&str, i8)| match exponent {
        1 => name.to_owned(),
        _ => format!("{name}^{exponent}"),
    };
    let powers = |sign: i8| -> Vec<String> {
        let all = ["kg", "m", "s"].into_iter().zip(exponents);
        let signed = all.map(|(name, exponent)| (name, sign * exponent));
        let kept = signed.filter(|&(_, exponent)| exponent > 0);
        kept.map(power).collect()
    };
    let (above, below) = (powers(1), powers(-1));
    let above = match (above.is_empty(), below.is_empty()) {
        (true, true) => return String::new(),
        (true, false) => "1".to_owned(),
        _ => above.join("*"),
    };
    match &below[..] {
        [] => above,
        [one] => format!("{above}/{one}"),
        several => format!("{above}/({})", several.join("*")),
    }
}

pub(super) fn quantity(number: f64, unit: Unit) -> String {
    let symbol = symbol(unit);
    let space = if symbol.is_empty() { "" } else { " " };
    format!("{number:?}{space}{symbol}")
}

/// A direction: `x`, `-z` or its components.
pub(super) fn direction(axis: &[f64; 3]) -> String {
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

impl Printer<'_> {
    pub(super) fn value(&self, value: Value, unit: Unit) -> String {
        match value {
            Value::Number(number) => quantity(number, unit),
            Value::Design { variable, factor } => {
                let name = &self.model.design[variable].name;
                if factor == 1.0 { name.clone() } else { format!("{factor:?} * {name}") }
            }
        }
    }

    /// `[1.0, 2.0, 3.0] m` for numbers alone, `[0.5 * b2, 0.1 m, 0]` for a mixture.
    pub(super) fn list(&self, values: &[Value], unit: Unit) -> String {
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
        let components: Vec<String> = values.iter().map(component).collect();
        format!("[{}]", components.join(", "))
    }

    pub(super) fn vector(&self, values: &Values, unit: Unit) -> String {
        self.list(values, unit)
    }

    /// A matrix by rows, or by its diagonal if it is diagonal.
    pub(super) fn matrix(&self, matrix: &Matrix, unit: Unit) -> String {
        let entries = [matrix[0][0], matrix[1][1], matrix[2][2]];
        if diagonal(entries) == *matrix {
            return self.vector(&entries, unit);
        }
        let rows = matrix.each_ref().map(|row| self.vector(row, unit));
        format!("[{}]", rows.join(", "))
    }

    pub(super) fn metres(&self, values: &Values) -> String {
        self.vector(values, Unit::Metre)
    }

    pub(super) fn frame(&self, frame: Frame) -> &str {
        match frame {
            Frame::Ground => "ground",
            Frame::Body(body) => &self.model.bodies[body].name,
        }
    }

    /// ` at [..] rotated(axis, angle)`, or empty.
    pub(super) fn placement(&self, placement: &Placement) -> String {
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
}
