//! Dimensions of quantities: exponents of length, mass and time. An angle is a plain number, as in the SI.

use std::fmt;

/// Exponents of metre, kilogram and second.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dimension {
    length: Exponent,
    mass: Exponent,
    time: Exponent,
}

/// An exact exponent: roots produce halves and thirds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Exponent {
    numerator: i16,
    denominator: i16,
}

impl Exponent {
    const fn whole(numerator: i16) -> Self {
        Self { numerator, denominator: 1 }
    }

    /// In lowest terms with a positive denominator; `None` if it does not fit.
    fn reduced(numerator: i64, denominator: i64) -> Option<Self> {
        let divisor = gcd(numerator.unsigned_abs(), denominator.unsigned_abs());
        let divisor = i64::try_from(divisor).ok().filter(|&d| d != 0)?;
        let sign = denominator.signum();
        Some(Self {
            numerator: i16::try_from(sign * numerator / divisor).ok()?,
            denominator: i16::try_from(sign * denominator / divisor).ok()?,
        })
    }

    fn plus(self, other: Self, sign: i64) -> Option<Self> {
        let (n, d) = (i64::from(self.numerator), i64::from(self.denominator));
        let (other_n, other_d) = (i64::from(other.numerator), i64::from(other.denominator));
        Self::reduced(n * other_d + sign * other_n * d, d * other_d)
    }

    fn times(self, numerator: i32, denominator: i32) -> Option<Self> {
        Self::reduced(
            i64::from(self.numerator) * i64::from(numerator),
            i64::from(self.denominator) * i64::from(denominator),
        )
    }
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

impl Dimension {
    /// A plain number or an angle.
    pub const NONE: Self = Self::new(0, 0, 0);
    /// m.
    pub const LENGTH: Self = Self::new(1, 0, 0);
    /// kg.
    pub const MASS: Self = Self::new(0, 1, 0);
    /// s.
    pub const TIME: Self = Self::new(0, 0, 1);
    /// 1/s, rad/s.
    pub const RATE: Self = Self::new(0, 0, -1);
    /// m/s.
    pub const SPEED: Self = Self::new(1, 0, -1);
    /// m/s^2.
    pub const ACCELERATION: Self = Self::new(1, 0, -2);
    /// N.
    pub const FORCE: Self = Self::new(1, 1, -2);
    /// N m, J; also N m/rad.
    pub const MOMENT: Self = Self::new(2, 1, -2);
    /// N/m.
    pub const STIFFNESS: Self = Self::new(0, 1, -2);
    /// N s/m.
    pub const DAMPING: Self = Self::new(0, 1, -1);
    /// N m s/rad.
    pub const ROTARY_DAMPING: Self = Self::new(2, 1, -1);
    /// kg m^2.
    pub const INERTIA: Self = Self::new(2, 1, 0);
    /// kg/m^3.
    pub const DENSITY: Self = Self::new(-3, 1, 0);
    /// kg/m^2.
    pub const AREA_DENSITY: Self = Self::new(-2, 1, 0);
    /// kg/m.
    pub const LINE_DENSITY: Self = Self::new(-1, 1, 0);
    /// Pa.
    pub const PRESSURE: Self = Self::new(-1, 1, -2);
    /// W.
    pub const POWER: Self = Self::new(2, 1, -3);

    /// From the exponents of metre, kilogram and second.
    pub const fn new(length: i16, mass: i16, time: i16) -> Self {
        Self { length: Exponent::whole(length), mass: Exponent::whole(mass), time: Exponent::whole(time) }
    }

    /// Whether this is a plain number or an angle.
    pub fn is_none(self) -> bool {
        self == Self::NONE
    }

    /// Dimension of a product; `None` if an exponent is out of range.
    pub fn times(self, other: Self) -> Option<Self> {
        self.combine(other, 1)
    }

    /// Dimension of a quotient; `None` if an exponent is out of range.
    pub fn over(self, other: Self) -> Option<Self> {
        self.combine(other, -1)
    }

    /// Dimension of the power `numerator / denominator`; `None` if an exponent is out of range.
    pub fn power(self, numerator: i32, denominator: i32) -> Option<Self> {
        Some(Self {
            length: self.length.times(numerator, denominator)?,
            mass: self.mass.times(numerator, denominator)?,
            time: self.time.times(numerator, denominator)?,
        })
    }

    fn combine(self, other: Self, sign: i64) -> Option<Self> {
        Some(Self {
            length: self.length.plus(other.length, sign)?,
            mass: self.mass.plus(other.mass, sign)?,
            time: self.time.plus(other.time, sign)?,
        })
    }

    /// The name that engineers use, with an article and the SI unit: `a length (m)`.
    pub fn describe(self) -> String {
        match self.common_name() {
            Some((name, _)) if self.is_none() => name.to_string(),
            Some((name, unit)) => format!("{name} ({unit})"),
            None => format!("a quantity in {}", self.si_symbol()),
        }
    }

    /// The name alone: `a length`.
    pub fn name(self) -> String {
        match self.common_name() {
            Some((name, _)) => name.to_string(),
            None => format!("a quantity in {}", self.si_symbol()),
        }
    }

    /// The SI unit: `m/s^2`; `1` for a plain number.
    pub fn si_symbol(self) -> String {
        match self.common_name() {
            Some((_, unit)) => unit.to_string(),
            None => self.to_string(),
        }
    }

    fn common_name(self) -> Option<(&'static str, &'static str)> {
        COMMON.iter().find(|(dimension, ..)| *dimension == self).map(|&(_, name, unit)| (name, unit))
    }
}

/// Names of the dimensions that occur in mechanisms.
const COMMON: [(Dimension, &str, &str); 24] = [
    (Dimension::NONE, "a plain number or an angle", "1"),
    (Dimension::LENGTH, "a length", "m"),
    (Dimension::MASS, "a mass", "kg"),
    (Dimension::TIME, "a time", "s"),
    (Dimension::RATE, "an angular speed", "rad/s"),
    (Dimension::SPEED, "a speed", "m/s"),
    (Dimension::ACCELERATION, "an acceleration", "m/s^2"),
    (Dimension::FORCE, "a force", "N"),
    (Dimension::MOMENT, "a moment or an energy", "N*m"),
    (Dimension::STIFFNESS, "a stiffness", "N/m"),
    (Dimension::DAMPING, "a damping", "N*s/m"),
    (Dimension::ROTARY_DAMPING, "a rotary damping", "N*m*s/rad"),
    (Dimension::INERTIA, "a moment of inertia", "kg*m^2"),
    (Dimension::PRESSURE, "a pressure", "Pa"),
    (Dimension::POWER, "a power", "W"),
    (Dimension::new(2, 0, 0), "an area", "m^2"),
    (Dimension::new(3, 0, 0), "a volume", "m^3"),
    (Dimension::new(0, 0, -2), "an angular acceleration", "rad/s^2"),
    (Dimension::DENSITY, "a density", "kg/m^3"),
    (Dimension::AREA_DENSITY, "a mass per area", "kg/m^2"),
    (Dimension::LINE_DENSITY, "a mass per length", "kg/m"),
    (Dimension::new(3, 1, -2), "a bending stiffness", "N*m^2"),
    (Dimension::new(1, 1, -1), "a momentum", "kg*m/s"),
    (Dimension::new(1, 1, 0), "a first moment of mass", "kg*m"),
];

/// The unit in powers of m, kg and s.
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut factors = Vec::new();
        for (symbol, exponent) in [("kg", self.mass), ("m", self.length), ("s", self.time)] {
            match (exponent.numerator, exponent.denominator) {
                (0, _) => {}
                (1, 1) => factors.push(symbol.to_string()),
                (numerator, 1) => factors.push(format!("{symbol}^{numerator}")),
                (numerator, denominator) => {
                    factors.push(format!("{symbol}^({numerator}/{denominator})"));
                }
            }
        }
        if self.is_none() { f.write_str("1") } else { f.write_str(&factors.join("*")) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_and_roots() {
        let area = Dimension::LENGTH.times(Dimension::LENGTH).unwrap();
        assert_eq!(area.power(1, 2), Some(Dimension::LENGTH));
        let root = Dimension::LENGTH.power(1, 2).unwrap();
        assert_eq!(root.times(root), Some(Dimension::LENGTH));
        assert_eq!(root.to_string(), "m^(1/2)");
        assert_eq!(Dimension::MASS.times(Dimension::ACCELERATION), Some(Dimension::FORCE));
        assert_eq!(Dimension::FORCE.over(Dimension::FORCE), Some(Dimension::NONE));
    }

    #[test]
    fn exponents_out_of_range_are_refused() {
        let large = Dimension::LENGTH.power(30000, 1).unwrap();
        assert_eq!(large.times(large), None);
        assert_eq!(large.power(i32::MAX, 1), None);
        assert_eq!(Dimension::LENGTH.power(1, 0), None);
    }

    #[test]
    fn descriptions() {
        assert_eq!(Dimension::LENGTH.describe(), "a length (m)");
        assert_eq!(Dimension::NONE.describe(), "a plain number or an angle");
        assert_eq!(Dimension::new(1, 2, -5).describe(), "a quantity in kg^2*m*s^-5");
    }
}
