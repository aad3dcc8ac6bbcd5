//! Whirl: whether a vibration circles in the direction in which the bodies spin.

use core::fmt;
use std::ops::Deref;

use eigentol_results::columns::Columns;
use eigentol_results::numbers::rough;
use eigentol_results::{Answer, Findings, Subject, displayed};

use crate::kernels::Kernels;
use crate::{Equilibrium, Mode, Modes};

/// Direction in which a vibration circles about the axes of the spinning bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Sense {
    /// With the spin.
    Forward,
    /// Against the spin.
    Backward,
    /// Along a line, or circles in both directions that cancel.
    Planar,
}

/// How a mode whirls.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Whirl {
    /// From 1 (every orbit a circle traversed with the spin) through 0 (straight lines) to -1 (circles against the
    /// spin).
    ///
    /// The orbits are those of the centres of mass and of the small rotations of the bodies, weighted with mass, second
    /// moment and the square of the spin. They are seen by an observer who moves with the coordinates: in the rotating
    /// frame if the coordinates are declared behind the drive.
    pub ratio: f64,
}

impl Whirl {
    /// The direction; ratios within 1e-6 of zero are planar.
    #[must_use]
    pub fn sense(self) -> Sense {
        if self.ratio > 1e-6 {
            Sense::Forward
        } else if self.ratio < -1e-6 {
            Sense::Backward
        } else {
            Sense::Planar
        }
    }
}

impl fmt::Display for Sense {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Forward => "forward",
            Self::Backward => "backward",
            Self::Planar => "planar",
        })
    }
}

impl fmt::Display for Whirl {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({:+.2})", self.sense(), self.ratio)
    }
}

/// The whirl of each mode, in the order of the modes. Dereferences to its list.
///
/// `None` for a mode that does not oscillate, or that moves nothing transverse to a spin axis.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct Whirls(pub Vec<Option<Whirl>>);

impl Deref for Whirls {
    type Target = [Option<Whirl>];

    fn deref(&self) -> &[Option<Whirl>] {
        &self.0
    }
}

impl IntoIterator for Whirls {
    type Item = Option<Whirl>;
    type IntoIter = std::vec::IntoIter<Option<Whirl>>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

/// `whirls`: a row for each mode. They do not record the mechanism; the modes do.
impl Answer for Whirls {
    const KIND: &'static str = "whirls";

    fn subject(&self) -> Option<Subject<'_>> {
        None
    }

    fn findings(&self) -> Findings {
        let rows: Vec<_> = self.iter().copied().enumerate().collect();
        let mut table = Columns::new("whirls", &rows);
        table.whole("mode", &|row| Some(row.0 + 1)).shown();
        let sense = |row: &(usize, Option<Whirl>)| Some(row.1?.sense().to_string());
        table.words("sense", &sense).shown();
        table
            .number("ratio", "", &|row| Some(row.1?.ratio))
            .digits(rough);
        let mut said = Findings::titled("Whirl of each mode".to_owned());
        said.columns(table);
        said
    }
}

displayed!(Whirls);

/// The whirl of each mode.
pub fn whirls(mechanism: &dyn Kernels, at: &Equilibrium, modes: &Modes) -> Whirls {
    let whirl = |mode: &Mode| {
        mode.frequency()?;
        let real = mode.shape.map(|value| value.re);
        let imaginary = mode.shape.map(|value| value.im);
        let [moment, size] =
            mechanism.whirl(&at.coordinates, &at.inputs, &at.design, &real, &imaginary);
        (size > 0.0 && moment.is_finite() && size.is_finite()).then(|| Whirl {
            ratio: (moment / size).clamp(-1.0, 1.0),
        })
    };
    Whirls(modes.modes.iter().map(whirl).collect())
}
