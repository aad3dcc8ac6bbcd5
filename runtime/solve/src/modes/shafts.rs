//! Modes of mechanisms with shafts, the stability that follows from them, and how they move what spins.

use super::mode::{Behaviour, Mode};
use super::normalisation::normalise_by_mass;
use crate::algebra::{Cholesky, Lu, Matrix, dot_complex};
use crate::kernels::Kernels;
use crate::shafts::{Shafts, numbers};
use crate::{Complex, Description, Equilibrium, Stability};

/// The number of modes that are sought: those of lowest frequency.
const MODES: usize = 12;
/// Rounding of an eigenvalue in units of that of the largest terms.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

impl Shafts {
    /// The modes at a state of these shafts, from those of a nearby one if given: the lowest that oscillate.
    pub(crate) fn modes(&self, at: &Equilibrium, nearby: &[Mode]) -> Option<Vec<Mode>> {
        let found = self.followed(nearby).or_else(|| self.whole.modes(MODES).ok())?;
        let mut modes = Vec::new();
        for own in found {
            let (mut right, mut left) = (own.right.stations.clone(), own.left.stations.clone());
            let weighs =
                normalise_by_mass(&mut right, &at.linear.mass) && normalise_by_mass(&mut left, &at.linear.mass);
            if !weighs {
                return None;
            }
            let condensed = self.whole.condensed(own.s);
            let matrix = condensed.matrix();
            let size = |row: &[Complex]| row.iter().zip(&right).map(|(a, x)| a.norm() * x.norm()).sum::<f64>();
            let terms: f64 = left.iter().zip(matrix.iter()).map(|(l, row)| l.norm() * size(row)).sum();
            let slope = dot_complex(&left, &condensed.slope_times(&right)).norm();
            let error = ROUNDING * (terms / slope + own.s.norm());
            let rest: f64 = matrix
                .iter()
                .map(|row: &[Complex]| {
                    let sum: Complex = row.iter().zip(&right).map(|(a, x)| a * x).sum();
                    sum.norm() / size(row).max(f64::MIN_POSITIVE)
                })
                .fold(0.0, f64::max);
            let behaviour = Behaviour::of_general(own.s, error, false);
            modes.push(Mode::general(own.s, (right, left), behaviour, rest, error));
        }
        Some(modes)
    }

    /// The modes next to others; `None` if two of them became one.
    fn followed(&self, nearby: &[Mode]) -> Option<Vec<eigentol_shafts::Mode>> {
        if nearby.is_empty() {
            return None;
        }
        let near = nearby.iter().map(|mode| {
            let condensed = self.whole.condensed(mode.s);
            let (right, left) = (condensed.motion(&mode.shape), condensed.weights(mode.left()));
            self.whole.near(&eigentol_shafts::Mode { s: mode.s, right, left }).ok()
        });
        let found: Vec<eigentol_shafts::Mode> = near.collect::<Option<_>>()?;
        let twice = |k: usize| found[..k].iter().any(|other| other.is_same(&found[k]));
        (!(0..found.len()).any(twice)).then_some(found)
    }

    /// Adds what spins of the shafts to the sums of the kernel `whirl` of a vibration.
    pub(crate) fn add_to_whirl(&self, of: &Description, s: Complex, shape: &[Complex], sums: &mut [f64; 7]) {
        let inertia = self.spans.inertia(&self.spans.condensed(s).motion(shape));
        let [moment, lateral, torsional, axial, eccentric, moving, still] = sums;
        let before = *moving;
        for (span, own) in self.spans.spans().iter().zip(inertia) {
            let (speed, square) = (span.speed, span.speed * span.speed);
            let all = match own[..] {
                [with, against] => {
                    *moment += 0.25 * speed * speed.abs() * (with - against);
                    *lateral += 0.25 * square * (with + against);
                    0.25 * (with + against)
                }
                _ => {
                    let place = span.ends.iter().find_map(|end| end[0]).map_or(0, |(index, _)| index);
                    let along = of.coordinates.get(place).is_some_and(|info| *info.unit.symbol == *"m");
                    *(if along { &mut *axial } else { &mut *torsional }) += 0.5 * square * own[0];
                    0.5 * own[0]
                }
            };
            *(if speed == 0.0 { &mut *still } else { &mut *moving }) += all;
        }
        // Shafts stand on their axes.
        if *moving > 0.0 {
            *eccentric *= (before / *moving).powi(2);
        }
    }
}

/// Gives a solved state the numbers of its shafts, and judges it by their lowest modes; `None` if it has none. Without
/// modes near which to look, all are sought; where none are `wanted`, nothing is judged.
#[doc(hidden)]
pub fn judge_shafts(
    mechanism: &dyn Kernels,
    state: &mut Equilibrium,
    nearby: &[Mode],
    wanted: bool,
) -> Option<(Stability, Vec<Mode>)> {
    state.spans = numbers(mechanism, &state.description, &state.inputs, &state.design);
    if state.spans.is_empty() {
        return None;
    }
    if !wanted || state.constraints.singular {
        return Some((Stability::Undecided, Vec::new()));
    }
    let modes = Shafts::of(state).ok().flatten().and_then(|shafts| shafts.modes(state, nearby)).unwrap_or_default();
    let stability = if modes.is_empty() { Stability::Undecided } else { stability(state, &modes) };
    Some((stability, modes))
}

/// The stability of a state with these modes.
fn stability(at: &Equilibrium, modes: &[Mode]) -> Stability {
    let growing = modes.iter().filter(|mode| mode.behaviour.grows()).count();
    let stiffness = &at.linear.stiffness;
    if Lu::new(stiffness).is_some_and(|factors| factors.negative_determinant()) {
        Stability::Divergent { negative: 1 }
    } else if growing > 0 {
        Stability::Flutter { growing }
    } else if modes.iter().all(|mode| matches!(mode.behaviour, Behaviour::Damped(_)))
        || Cholesky::new(&symmetric_part(stiffness)).is_ok()
    {
        Stability::Stable
    } else {
        Stability::Marginal
    }
}

fn symmetric_part(a: &Matrix) -> Matrix {
    Matrix::from_fn(a.row_count(), a.row_count(), |i, j| 0.5 * (a[i][j] + a[j][i]))
}
