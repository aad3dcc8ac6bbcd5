//! What the blades of a ring do in a mode: together, one against the next, or as a wave that travels around the axis.

use core::f64::consts::TAU;
use core::fmt;

use eigentol_contract::RingInfo;

use crate::algebra::Matrix;
use crate::kernels::Kernels;
use crate::scalar::Dual;
use crate::{Complex, Description, Equilibrium};

/// The direction in which a wave of blades travels around its axis, relative to the blades.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Travel {
    /// With the rotation.
    Progressive,
    /// Against the rotation.
    Regressive,
}

/// The pattern of a ring in a mode.
///
/// With blade `i` of `N` at the angle `phi_i` on the ring, the vibration of its coordinates is a sum of waves
/// `Re(x e^{i(w t - r phi_i)})`. The pattern is the one with the largest share.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BladePattern {
    /// Which ring.
    pub ring: usize,
    /// How many blades it has.
    pub blades: usize,
    /// Number of nodal diameters, `r`: all blades together have none, each against the next has half the number of blades.
    pub nodal_diameters: usize,
    /// Where the wave travels; `None` if it has no direction, or two waves are about equal.
    pub travel: Option<Travel>,
    /// Share of these waves in the motion of the blades.
    pub share: f64,
    /// Share of the blades in the kinetic energy of the mode.
    pub of_blades: f64,
    /// The frequency at which a blade vibrates, rad/s. The frequency of the mode is seen from the ground if the
    /// coordinates are multiblade coordinates; a blade sees another, by as many speeds of rotation as there are diameters.
    pub of_blade: f64,
}

/// Two waves that differ by less have no direction.
const EQUAL: f64 = 0.01;

/// Waves in both directions with one number of diameters: `[with, against]` growing angles, and the frequencies at which
/// blades vibrate in them, negative where the wave then travels the other way.
struct Waves {
    diameters: usize,
    squares: [f64; 2],
    frequencies: [f64; 2],
}

impl BladePattern {
    /// Of a ring that turns at `speed`, in a vibration at `frequency` with this shape, rad/s.
    fn new(
        (place, ring): (usize, &RingInfo),
        speed: f64,
        frequency: f64,
        of_blades: f64,
        of: &[Weighted],
    ) -> Option<Self> {
        let blades = ring.members;
        let mut waves: Vec<Waves> = (0..=blades / 2)
            .map(|diameters| Waves { diameters, squares: [0.0; 2], frequencies: [frequency; 2] })
            .collect();
        for values in of {
            for wave in &mut waves {
                let [with, against] =
                    if ring.patterns { patterns(values, wave.diameters) } else { around(values, wave.diameters) };
                wave.squares[0] += with;
                wave.squares[1] += against;
            }
        }
        if ring.patterns {
            for wave in &mut waves {
                let turn = wave.diameters as f64 * speed;
                if wave.has_direction(blades) {
                    wave.frequencies = [frequency - turn, frequency + turn];
                }
            }
        }
        let all: f64 = waves.iter().flat_map(|wave| wave.squares).sum();
        let most = waves.iter().max_by(|a, b| a.size().total_cmp(&b.size()))?;
        let [with, against] = most.squares;
        let larger = usize::from(against > with);
        // relative to the blade, and to the rotation
        let with_angles = (larger == 0) == (most.frequencies[larger] >= 0.0);
        let forward = with_angles == (speed >= 0.0);
        let directed = most.has_direction(blades) && (with - against).abs() > EQUAL * (with + against);
        (all > 0.0).then_some(Self {
            ring: place,
            blades,
            nodal_diameters: most.diameters,
            travel: directed.then_some(if forward { Travel::Progressive } else { Travel::Regressive }),
            share: most.size() / all,
            of_blades,
            of_blade: most.frequencies[larger].abs(),
        })
    }

    /// Whether equal blades have it twice, with two places of its diameters, and it is hardly mixed with others.
    #[must_use]
    pub fn is_of_pair(&self) -> bool {
        /// Least share of a pattern of its own.
        const PURE: f64 = 0.99;
        self.nodal_diameters > 0 && !self.is_differential() && self.share >= PURE
    }

    /// Whether each blade moves against the next.
    #[must_use]
    pub fn is_differential(&self) -> bool {
        2 * self.nodal_diameters == self.blades
    }
}

impl Waves {
    fn size(&self) -> f64 {
        self.squares.iter().sum()
    }

    fn has_direction(&self, blades: usize) -> bool {
        self.diameters > 0 && 2 * self.diameters != blades
    }
}

/// One coordinate of all blades, or its patterns.
type Weighted = Vec<Complex>;

/// Squares of the waves with so many diameters, from multiblade coordinates.
fn patterns(values: &[Complex], diameters: usize) -> [f64; 2] {
    let n = values.len();
    match diameters {
        0 => [values[0].norm_sqr(), 0.0],
        r if 2 * r == n => [values[n - 1].norm_sqr(), 0.0],
        r => {
            let (cosine, sine) = (values[2 * r - 1], values[2 * r]);
            let turned = Complex::new(-sine.im, sine.re);
            [(cosine + turned).norm_sqr() / 4.0, (cosine - turned).norm_sqr() / 4.0]
        }
    }
}

/// The same from the coordinates of the blades.
fn around(values: &[Complex], diameters: usize) -> [f64; 2] {
    let n = values.len();
    let wave = |sign: f64| {
        let terms = values.iter().enumerate().map(|(i, value)| {
            let angle = sign * TAU * ((diameters * i) % n) as f64 / n as f64;
            value * Complex::new(angle.cos(), angle.sin())
        });
        (terms.sum::<Complex>() / n as f64).norm_sqr()
    };
    if diameters == 0 || 2 * diameters == n { [wave(1.0), 0.0] } else { [wave(1.0), wave(-1.0)] }
}

/// The speeds at which the rings turn about their axes, rad/s.
pub fn ring_speeds(mechanism: &dyn Kernels, at: &Equilibrium) -> Vec<f64> {
    let description = mechanism.description();
    let number = |value: &f64| Dual::fixed(Dual::fixed(*value));
    let (u, b): (Vec<_>, Vec<_>) = (at.inputs.iter().map(number).collect(), at.design.iter().map(number).collect());
    let held = description.held.len();
    let mut values = vec![number(&0.0); held + description.rings.len()];
    mechanism.held_values_into(&u, &b, &mut values);
    values[held..].iter().map(|value| value.value.value).collect()
}

/// The pattern of the ring that moves most in a mode, with the mass matrix at its equilibrium.
pub(crate) fn pattern(
    description: &Description,
    speeds: &[f64],
    mass: &Matrix,
    (shape, frequency): (&[Complex], f64),
) -> Option<BladePattern> {
    let energy = |places: &[usize]| -> f64 {
        let pairs = places.iter().flat_map(|&i| places.iter().map(move |&j| (i, j)));
        pairs.map(|(i, j)| (shape[i].conj() * shape[j]).re * mass[i][j]).sum()
    };
    let everything: Vec<usize> = (0..shape.len()).collect();
    let whole = energy(&everything);
    let share = |ring: &RingInfo| if whole > 0.0 { (energy(&ring.coordinates) / whole).clamp(0.0, 1.0) } else { 0.0 };
    let rings = description.rings.iter().enumerate().map(|(k, ring)| ((k, ring), share(ring)));
    let ((place, ring), share) = rings.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let values = ring.coordinates.chunks_exact(ring.members);
    let values: Vec<Weighted> = values
        .map(|slots| {
            let weight = mass[slots[0]][slots[0]].abs().sqrt();
            slots.iter().map(|&k| shape[k] * weight).collect()
        })
        .collect();
    BladePattern::new((place, ring), speeds[place], frequency, share, &values).filter(|_| share > NO_SHARE)
}

/// Blades with less of the energy do not count.
const NO_SHARE: f64 = 1e-4;

crate::worded! {
    Travel {
        Self::Progressive => "progressive",
        Self::Regressive => "regressive",
    }
}

/// `collective`, `differential`, `regressive`, or `progressive, 2 diameters` where there are several.
impl fmt::Display for BladePattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plural = if self.nodal_diameters == 1 { "" } else { "s" };
        let diameters = format!("{} diameter{plural}", self.nodal_diameters);
        match self.travel {
            _ if self.nodal_diameters == 0 => f.write_str("collective"),
            _ if self.is_differential() => f.write_str("differential"),
            Some(travel) if self.blades <= 4 => travel.fmt(f),
            Some(travel) => write!(f, "{travel}, {diameters}"),
            None => f.write_str(&diameters),
        }
    }
}
