//! Kinds of modes: how a vibration moves the bodies that spin, and whether it circles in the direction of their spin.

use core::fmt;
use std::ops::Deref;

use eigentol_results::columns::Columns;
use eigentol_results::numbers::rough;
use eigentol_results::{Answer, Findings, Subject, displayed};

use super::blades::{BladePattern, pattern, ring_speeds};
use crate::kernels::Kernels;
use crate::shafts::Shafts;
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

/// What a mode does to the shafts of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Kind {
    /// It bends or tilts them, or moves them across their axes.
    Lateral,
    /// It twists them.
    Torsional,
    /// It moves them along their axes.
    Axial,
    /// None of these alone.
    Mixed,
    /// The blades of a ring move, and little else.
    Blades,
}

/// The kind of a mode, with its sense of whirl if it has one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Character {
    /// The kind.
    pub kind: Kind,
    /// The sense of whirl of a mode that is lateral, at least in part.
    pub sense: Option<Sense>,
}

/// The smallest share of a kind in the kinetic energy of a mode that has only this kind.
const ONE_KIND: f64 = 0.9;
/// Shares of energy below this do not count: of the spinning bodies in a mode of what does not spin, and of the motion
/// with the spin in a mode that an unbalance can excite. It is that of one hundredth in the amplitude.
const NO_SHARE: f64 = 1e-4;
/// How close a frequency is to the spin, relative to it, where an unbalance acts at that frequency.
const SYNCHRONOUS: f64 = 1e-6;

/// How a mode moves the bodies that spin.
///
/// Energies are those of the centres of mass and of the small rotations of the bodies, weighted with mass, second moment
/// and the square of the spin.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Whirl {
    /// Its kind.
    pub kind: Kind,
    /// From 1 (every orbit a circle traversed with the spin) through 0 (straight lines) to -1 (circles against the
    /// spin); `None` if the mode is neither lateral nor, to a tenth of its energy, in part.
    ///
    /// The orbits are those of points on the axes of spin. They are seen by an observer who moves with the coordinates:
    /// in the rotating frame if the coordinates are declared behind the drive.
    pub ratio: Option<f64>,
    /// Share of energy in motion across the axes that circles with the spin: what a force that turns with the shaft
    /// drives.
    pub with_spin: f64,
    /// Spin of the bodies that move, root mean square, rad/s.
    pub spin: f64,
    /// What the blades of a ring do, if there is one and they move.
    #[cfg_attr(feature = "serde", serde(default))]
    pub blades: Option<BladePattern>,
}

impl Whirl {
    /// From the seven sums of the kernel; `None` if no shaft moves.
    fn new([moment, lateral, torsional, axial, eccentric, moving, still]: [f64; 7]) -> Option<Self> {
        let all = lateral + torsional + axial;
        // What turns about an axis beside it is no shaft.
        let shaft = moving > NO_SHARE * (moving + still) && eccentric < 0.5;
        if !(all.is_finite() && shaft) {
            return None;
        }
        let [lateral, torsional, axial] = [lateral, torsional, axial].map(|part| part / all);
        let kind = match () {
            () if lateral >= ONE_KIND => Kind::Lateral,
            () if torsional >= ONE_KIND => Kind::Torsional,
            () if axial >= ONE_KIND => Kind::Axial,
            () => Kind::Mixed,
        };
        let circles = lateral >= 1.0 - ONE_KIND;
        let with_spin = 0.5 * (lateral + moment / all);
        Some(Self {
            kind,
            ratio: circles.then(|| (moment / all / lateral).clamp(-1.0, 1.0)),
            with_spin: with_spin.clamp(0.0, 1.0),
            spin: (all / moving).sqrt(),
            blades: None,
        })
    }

    /// With what blades do. A mode of which they have most of the energy is theirs.
    fn with_blades(of_shafts: Option<Self>, blades: Option<BladePattern>) -> Option<Self> {
        let Some(pattern) = blades else { return of_shafts };
        let theirs = pattern.of_blades >= 0.5;
        match of_shafts {
            Some(of_shafts) if !theirs => Some(Self { blades, ..of_shafts }),
            _ => {
                let kind = if theirs { Kind::Blades } else { Kind::Mixed };
                // Any force on blades may excite them, whatever the shaft does.
                Some(Self {
                    kind,
                    ratio: None,
                    with_spin: 1.0,
                    spin: of_shafts.map_or(0.0, |whirl| whirl.spin),
                    blades,
                })
            }
        }
    }

    /// The direction; ratios within 1e-6 of zero are planar. `None` where there is no ratio.
    #[must_use]
    pub fn sense(self) -> Option<Sense> {
        Some(match self.ratio? {
            ratio if ratio > 1e-6 => Sense::Forward,
            ratio if ratio < -1e-6 => Sense::Backward,
            _ => Sense::Planar,
        })
    }

    /// Its kind with its sense.
    #[must_use]
    pub fn character(self) -> Character {
        Character { kind: self.kind, sense: self.sense() }
    }

    /// Whether anything can excite the mode where its frequency (rad/s) meets a multiple of the speed.
    ///
    /// At the frequency of the spin a shaft is excited by its unbalance, a force that turns with it. This drives what
    /// moves across the axis with the spin, but neither torsion nor motion along the axis nor a circle against the
    /// spin. At other multiples any force may act.
    #[must_use]
    pub fn is_excited_at(self, frequency: f64) -> bool {
        let synchronous = (frequency - self.spin).abs() <= SYNCHRONOUS * self.spin;
        !synchronous || self.with_spin >= NO_SHARE
    }
}

crate::worded! {
    Kind {
        Self::Lateral => "lateral",
        Self::Torsional => "torsional",
        Self::Axial => "axial",
        Self::Mixed => "mixed",
        Self::Blades => "blades",
    }
}

crate::worded! {
    Sense {
        Self::Forward => "forward",
        Self::Backward => "backward",
        Self::Planar => "planar",
    }
}

/// `forward` of a lateral mode, `mixed forward`, or a kind without a sense: `torsional`.
impl fmt::Display for Character {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.kind, self.sense) {
            (Kind::Lateral, Some(sense)) => sense.fmt(f),
            (kind, Some(sense)) => write!(f, "{kind} {sense}"),
            (kind, None) => kind.fmt(f),
        }
    }
}

impl fmt::Display for Whirl {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.blades.filter(|_| self.kind == Kind::Blades) {
            Some(pattern) => pattern.fmt(f),
            None => self.character().fmt(f),
        }
    }
}

/// The kind and whirl of each mode, in the order of the modes. Dereferences to its list.
///
/// `None` for a mode that does not oscillate, or that moves no shaft: nothing that spins, or what turns about an axis beside
/// it, as a blade or a pendulum does.
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
        table.words("kind", &|row| Some(row.1?.kind.to_string())).shown();
        table.words("sense", &|row| Some(row.1?.sense()?.to_string())).shown();
        table.number("ratio", "", &|row| row.1?.ratio).digits(rough);
        blades(&mut table, &|row| row.1);
        let mut said = Findings::titled("Kind and whirl of each mode".to_owned());
        said.columns(table);
        said
    }
}

/// Columns of what blades do; of the text only those of modes with blades.
pub(super) fn blades<R>(table: &mut Columns<'_, R>, of: &dyn Fn(&R) -> Option<Whirl>) {
    let pattern = |row: &R| of(row)?.blades;
    table.whole("nodal diameters", &|row| Some(pattern(row)?.nodal_diameters));
    table.words("travel", &|row| Some(pattern(row)?.travel?.to_string()));
    table.number("share of pattern", "", &|row| Some(pattern(row)?.share));
    table.number("share of blades", "", &|row| Some(pattern(row)?.of_blades));
    table.number("frequency in blade", "rad/s", &|row| Some(pattern(row)?.of_blade));
}

displayed!(Whirls);

/// The kind and whirl of each mode.
pub fn whirls(mechanism: &dyn Kernels, at: &Equilibrium, modes: &Modes) -> Whirls {
    let description = mechanism.description();
    let rings = (!description.rings.is_empty()).then(|| {
        let mass = mechanism.linear(&at.coordinates, &at.inputs, &at.design).mass;
        (ring_speeds(mechanism, at), mass)
    });
    let of_mode = |mode: &Mode| {
        let [real, imaginary] = [mode.shape.map(|value| value.re), mode.shape.map(|value| value.im)];
        mechanism.whirl(&at.coordinates, &at.inputs, &at.design, &real, &imaginary)
    };
    let mut sums: Vec<[f64; 7]> = modes.modes.iter().map(of_mode).collect();
    if let Ok(Some(shafts)) = Shafts::of(at) {
        shafts.add_to_whirls(&description, &modes.modes, &mut sums);
    }
    let whirl = |(mode, sums): (&Mode, [f64; 7])| {
        let frequency = mode.frequency()?;
        let of_shafts = Whirl::new(sums);
        let Some((speeds, mass)) = &rings else { return of_shafts };
        Whirl::with_blades(of_shafts, pattern(&description, speeds, mass, (&mode.shape, frequency)))
    };
    Whirls(modes.modes.iter().zip(sums).map(whirl).collect())
}
