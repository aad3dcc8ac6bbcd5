//! Numbers in SI or in their declared unit.

use crate::Unit;

/// A number in the declared unit of the quantity it is assigned to: for an input declared in rpm,
/// `InDeclaredUnit(3000.0)` is 3000 rpm.
///
/// Wherever a [`Study`](crate::Study) takes a value, it accepts this or a plain `f64` in SI. Coordinates have no
/// declared unit: they are in rad or m.
///
/// ```
/// use eigentol::{InDeclaredUnit, Study, mechanism};
///
/// mechanism! {
///     mechanism Governor {
///         input  speed: rpm;
///         design l = 200 mm +/- 1 mm;
///         gravity 9.81 m/s^2 along -z;
///         body shaft: massless;
///         body bar: rod(mass: 2 kg, length: l, along: -z);
///         joint spin:  revolute(z) from ground to shaft, driven at speed;
///         joint theta: revolute(y) from shaft to bar;
///     }
/// }
///
/// let study = Study::new(Governor)
///     .input(Governor::speed, InDeclaredUnit(120.0))
///     .design(Governor::l, InDeclaredUnit(250.0))
///     .tolerance(Governor::l, InDeclaredUnit(0.5));
/// assert!((study.input_values()[0] - 12.566_370_614_359_172).abs() < 1e-12);
/// assert_eq!(study.design_values(), [0.25]);
///
/// let sweep = study.sweep(Governor::speed, &[60.0, 90.0, 120.0].map(InDeclaredUnit))?;
/// assert_eq!(sweep.points.len(), 3);
/// let critical = study.critical_state(Governor::speed, 0.0, InDeclaredUnit(300.0))?;
/// let unit = &study.description().inputs[Governor::speed.index()].unit;
/// println!("critical at {} {}", unit.from_si(critical.value), unit.symbol);
/// # Ok::<(), eigentol::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InDeclaredUnit(pub f64);

/// A value as entered: an `f64` in SI, or an [`InDeclaredUnit`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Value {
    /// In SI units.
    Si(f64),
    /// In the declared unit.
    Declared(f64),
}

impl From<f64> for Value {
    fn from(value: f64) -> Self {
        Self::Si(value)
    }
}

impl From<InDeclaredUnit> for Value {
    fn from(InDeclaredUnit(value): InDeclaredUnit) -> Self {
        Self::Declared(value)
    }
}

impl Value {
    /// The value with the opposite sign.
    pub(super) fn negative(self) -> Self {
        match self {
            Self::Si(value) => Self::Si(-value),
            Self::Declared(value) => Self::Declared(-value),
        }
    }

    /// Converts the value of a quantity declared in `unit` to SI.
    #[must_use]
    pub fn si(self, unit: &Unit) -> f64 {
        match self {
            Self::Si(value) => value,
            Self::Declared(value) => unit.to_si(value),
        }
    }
}
