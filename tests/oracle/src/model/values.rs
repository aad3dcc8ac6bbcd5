//! Values, units, and user-defined quantities.

/// A scalar value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// `factor * variable`, the variable by its index in [`super::Model::design`].
    Design {
        /// Index of the design variable.
        variable: usize,
        /// Pure number.
        factor: f64,
    },
}

impl Value {
    /// `-self`.
    pub fn negated(self) -> Self {
        match self {
            Self::Number(number) => Self::Number(-number),
            Self::Design { variable, factor } => Self::Design { variable, factor: -factor },
        }
    }
}

/// Three values.
pub type Values = [Value; 3];

/// Three rows.
pub type Matrix = [Values; 3];

/// The value 0.
pub const ZERO: Value = Value::Number(0.0);

/// The vector 0.
pub const ORIGIN: Values = [ZERO; 3];

/// The matrix with this diagonal and zeros elsewhere.
pub fn diagonal(values: Values) -> Matrix {
    let mut matrix = [ORIGIN; 3];
    for (i, value) in values.into_iter().enumerate() {
        matrix[i][i] = value;
    }
    matrix
}

/// The unit of a declared value. SI values need no scale; an angle is a plain number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Mass.
    Kilogram,
    /// Length or displacement.
    Metre,
    /// Angle.
    Radian,
    /// Moment of inertia.
    KilogramSquareMetre,
    /// Force.
    Newton,
    /// Moment.
    NewtonMetre,
    /// Stiffness of a displacement.
    NewtonPerMetre,
    /// Stiffness of an angle.
    NewtonMetrePerRadian,
    /// Damping of a displacement.
    NewtonSecondPerMetre,
    /// Damping of an angle.
    NewtonMetreSecondPerRadian,
    /// Acceleration.
    MetrePerSquareSecond,
    /// Speed of a displacement.
    MetrePerSecond,
    /// Speed of an angle.
    RadianPerSecond,
    /// Any other, by its exponents of kilogram, metre and second.
    Of([i8; 3]),
}

impl Unit {
    /// Exponents of kilogram, metre and second.
    pub fn exponents(self) -> [i8; 3] {
        match self {
            Self::Kilogram => [1, 0, 0],
            Self::Metre => [0, 1, 0],
            Self::Radian => [0, 0, 0],
            Self::KilogramSquareMetre => [1, 2, 0],
            Self::Newton => [1, 1, -2],
            Self::NewtonMetre | Self::NewtonMetrePerRadian => [1, 2, -2],
            Self::NewtonPerMetre => [1, 0, -2],
            Self::NewtonSecondPerMetre => [1, 0, -1],
            Self::NewtonMetreSecondPerRadian => [1, 2, -1],
            Self::MetrePerSquareSecond => [0, 1, -2],
            Self::MetrePerSecond => [0, 1, -1],
            Self::RadianPerSecond => [0, 0, -1],
            Self::Of(exponents) => exponents,
        }
    }

    /// The unit of the factor whose product with `others` has this unit.
    pub fn over(self, others: &[Unit]) -> Self {
        let mut exponents = self.exponents();
        for other in others {
            for (sum, exponent) in exponents.iter_mut().zip(other.exponents()) {
                *sum -= exponent;
            }
        }
        Self::Of(exponents)
    }
}

/// An operating parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Declared name.
    pub name: String,
    /// Declared unit.
    pub unit: Unit,
}

/// A design variable.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignVariable {
    /// Declared name.
    pub name: String,
    /// Unit of the nominal value.
    pub unit: Unit,
    /// Nominal value.
    pub nominal: f64,
}
