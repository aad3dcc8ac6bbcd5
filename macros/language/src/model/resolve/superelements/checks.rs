//! Whether matrices are those of a part that exists: of the right order, moving as a rigid body without resistance and with
//! the same mass in all directions unless they are held, and with no negative energy.

use proc_macro2::Ident;

use super::super::resolver::Resolver;
use super::declared::{Declared, MOTIONS, Share, Square};
use crate::base::span::Extent;

/// What is left of a sum of terms that cancel, as a part of the terms: files have some seven digits.
const ROUNDED: f64 = 1e-6;
/// What is no longer a mistake of units or of order, but of small terms.
const NEARLY: f64 = 1e-3;
/// What is added to a diagonal, as a part of it, so that rigid bodies count as positive.
const SHIFT: f64 = 1e-6;
const WORDS: [&str; MOTIONS] = ["along x", "along y", "along z", "about x", "about y", "about z"];

impl Resolver<'_> {
    /// Whether the matrices can be those of a part; what is wrong is reported.
    pub(super) fn check_superelement(
        &mut self,
        name: &Ident,
        declared: &Declared,
        at: &dyn Fn(&'static str) -> Extent,
        is_held: bool,
    ) -> bool {
        let wrong = self.wrong_with(name, declared, is_held);
        if let Some((matrix, message, help)) = wrong {
            self.diagnostics.error_with_help(at(matrix), message, help);
            return false;
        }
        true
    }

    /// What is wrong with which matrix, and advice.
    fn wrong_with(&self, name: &Ident, declared: &Declared, is_held: bool) -> Option<(&'static str, String, String)> {
        let order = declared.order();
        let rows = MOTIONS * declared.stations.len();
        if order < rows {
            let message = format!("the matrices have {order} rows; {} stations have {rows}", declared.stations.len());
            let help = "each station has six, along and about x, y, z; fill those that nothing moves with zeros";
            return Some(("mass", message, help.into()));
        }
        let [damping, gyroscopic] = &declared.damping;
        let all = [(&declared.stiffness, "stiffness"), (damping, "damping"), (gyroscopic, "gyroscopic")];
        for (shares, what) in all {
            if let Some(share) = shares.iter().find(|share| share.matrix.order != order) {
                let message = format!("the mass of `{name}` has {order} rows, this matrix {}", share.matrix.order);
                return Some((what, message, "matrices of one part have the same rows in the same order".into()));
            }
        }
        let [mass, stiffness] = [&declared.mass, &declared.stiffness].map(|shares| self.at_nominal(shares, order));
        let arms: Vec<[f64; 3]> =
            declared.stations.iter().map(|place| place.each_ref().map(|x| self.nominal_of(x))).collect();
        if !is_held && let Some(wrong) = resists(declared, &stiffness, &arms) {
            return Some(("stiffness", wrong.0, wrong.1));
        }
        if let Some(message) = masses_differ(declared, &mass, &arms, is_held) {
            let help = "rows are along x, y, z and about x, y, z of each station in turn, then what is internal";
            return Some(("mass", message, help.into()));
        }
        for (matrix, what) in [(&mass, "mass"), (&stiffness, "stiffness")] {
            if let Some(row) = not_positive(matrix) {
                let message =
                    format!("the {what} of `{name}` is not positive: row {} makes its energy negative", row + 1);
                let help = "check the sign and the order of rows and columns";
                return Some((what, message, help.into()));
            }
        }
        None
    }

    fn at_nominal(&self, shares: &[Share], order: usize) -> Square {
        let mut sum = Square::zeros(order);
        shares
            .iter()
            .filter(|share| !share.grows)
            .for_each(|share| sum.add(self.nominal_of(&share.factor), &share.matrix));
        sum
    }
}

/// What resists a motion as a rigid body, with advice.
fn resists(declared: &Declared, stiffness: &Square, arms: &[[f64; 3]]) -> Option<(String, String)> {
    let motions: Vec<Vec<f64>> = (0..MOTIONS).map(|motion| declared.rigid(motion, arms)).collect();
    let (motion, part) = (0..MOTIONS)
        .filter(|motion| declared.moves.iter().skip(*motion).step_by(MOTIONS).take(arms.len()).all(|moves| *moves))
        .map(|motion| (motion, resistance(stiffness, &motions[motion], 0)))
        .max_by(|a, b| a.1.total_cmp(&b.1))?;
    if part <= ROUNDED.max(stiffness.rounding) {
        return None;
    }
    let percent = 100.0 * part;
    let message = format!(
        "this stiffness resists a motion {} as a rigid body: {} % of its terms are left, where all should cancel",
        WORDS[motion],
        if percent < 0.1 { format!("{percent:.1e}") } else { format!("{percent:.1}") }
    );
    let help = if part < NEARLY {
        let left = energy(stiffness, &motions[motion]);
        format!(
            "a stiffness of {left:.2e} {} is left, {}: numbers of too few digits, or something that was added to the diagonal",
            if motion < 3 { "N/m" } else { "N*m/rad" },
            if left < 0.0 { "a negative eigenvalue" } else { "a weak spring to the ground" }
        )
    } else if resistance(stiffness, &motions[motion], MOTIONS * arms.len()) > NEARLY {
        "internal coordinates are modes in which all stations stand still: other nodes are stations, or reduced first (Craig and Bampton)"
            .to_owned()
    } else if motion < 3 {
        "a part that is fixed to the ground within its matrices is `held: inside`; else check the order of the rows"
            .to_owned()
    } else if let Some(unit) = unit_of_length(declared, stiffness, arms) {
        format!("with places {unit} times as large nothing resists: matrix and places are in different units of length")
    } else {
        "check the places of the stations, the order of the rows, and the units of both".to_owned()
    };
    Some((message, help))
}

/// Twice the energy of a motion.
fn energy(a: &Square, x: &[f64]) -> f64 {
    (0..a.order).map(|row| x[row] * a.row(row).iter().zip(x).map(|(a, x)| a * x).sum::<f64>()).sum()
}

/// The greatest sum in a row of `a x` from one on, as a part of its terms.
fn resistance(a: &Square, x: &[f64], first: usize) -> f64 {
    let terms = |row: usize| a.row(row).iter().zip(x).map(|(a, x)| a * x);
    let sizes: Vec<f64> = (0..a.order).map(|row| terms(row).map(f64::abs).sum()).collect();
    let greatest = sizes.iter().copied().fold(0.0, f64::max);
    let part = |row: usize| terms(row).sum::<f64>().abs() / sizes[row].max(ROUNDED * greatest);
    (first..a.order).map(part).fold(0.0, f64::max)
}

/// By which factor the places must grow so that nothing resists a turn, if there is one.
fn unit_of_length(declared: &Declared, stiffness: &Square, arms: &[[f64; 3]]) -> Option<f64> {
    let none = vec![[0.0; 3]; arms.len()];
    let times = |x: &[f64]| -> Vec<f64> {
        (0..stiffness.order).map(|row| stiffness.row(row).iter().zip(x).map(|(a, x)| a * x).sum()).collect()
    };
    let (mut above, mut below) = (0.0, 0.0);
    for motion in 3..MOTIONS {
        let turn = times(&declared.rigid(motion, &none));
        let whole = times(&declared.rigid(motion, arms));
        let moved: Vec<f64> = whole.iter().zip(&turn).map(|(whole, turn)| whole - turn).collect();
        above -= moved.iter().zip(&turn).map(|(a, b)| a * b).sum::<f64>();
        below += moved.iter().map(|x| x * x).sum::<f64>();
    }
    let factor = above / below;
    let scaled: Vec<[f64; 3]> = arms.iter().map(|arm| arm.map(|x| factor * x)).collect();
    let fits = (3..MOTIONS).all(|motion| resistance(stiffness, &declared.rigid(motion, &scaled), 0) < NEARLY);
    (factor > 0.0 && fits).then(|| format!("{factor:.3e}").parse().unwrap_or(factor))
}

/// What is wrong with the mass in the three directions. They differ in a part that is held: what lies between its stations
/// and the ground moves less, and not by the same share.
fn masses_differ(declared: &Declared, mass: &Square, arms: &[[f64; 3]], is_held: bool) -> Option<String> {
    let weigh = |motion: usize| -> Option<f64> {
        let moves = declared.moves.iter().skip(motion).step_by(MOTIONS).take(arms.len()).all(|moves| *moves);
        let x = declared.rigid(motion, arms);
        moves.then(|| energy(mass, &x))
    };
    let masses: Vec<(usize, f64)> = (0..3).filter_map(|motion| Some((motion, weigh(motion)?))).collect();
    let (_, first) = *masses.first()?;
    if first <= 0.0 {
        return Some(format!("the mass {} is {first:.6} kg", WORDS[masses[0].0]));
    }
    let other = masses.iter().find(|(_, other)| !is_held && (other - first).abs() > NEARLY * first)?;
    Some(format!("the mass is {first:.6} kg {}, but {:.6} kg {}", WORDS[masses[0].0], other.1, WORDS[other.0]))
}

/// The first row where the factorisation of a matrix that is positive, but for what is rigid, has a negative square.
fn not_positive(a: &Square) -> Option<usize> {
    let n = a.order;
    let diagonal: Vec<f64> = (0..n).map(|k| a.entry(k, k)).collect();
    let scale = |k: usize| if diagonal[k] > 0.0 { diagonal[k].sqrt() } else { 1.0 };
    if let Some(row) =
        (0..n).find(|k| diagonal[*k] < 0.0 || (diagonal[*k] == 0.0 && a.row(*k).iter().any(|x| *x != 0.0)))
    {
        return Some(row);
    }
    let mut factor = vec![vec![0.0; n]; n];
    for i in 0..n {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
            let own = a.mean(i, j) / (scale(i) * scale(j));
            if i == j {
                let square = own + if diagonal[i] > 0.0 { SHIFT.max(a.rounding) } else { 1.0 } - known;
                if square <= 0.0 {
                    return Some(i);
                }
                factor[i][i] = square.sqrt();
            } else {
                factor[i][j] = (own - known) / factor[j][j];
            }
        }
    }
    None
}
