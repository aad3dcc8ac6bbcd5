//! The reasons not to trust a number, in sentences.

use core::fmt;

use crate::tolerance::{Doubt, TRUSTED_DISTANCE};
use eigentol_results::Findings;
use eigentol_results::naming::{capital, named};
use eigentol_results::numbers::short;

/// Each doubt once, with all the modes that share it; one list of doubts for each mode.
fn shared(all: &[impl AsRef<[Doubt]>]) -> Vec<(Vec<usize>, &Doubt)> {
    let mut said: Vec<(Vec<usize>, &Doubt)> = Vec::new();
    for (mode, doubts) in all.iter().enumerate() {
        for doubt in doubts.as_ref() {
            let of_one = matches!(doubt, Doubt::EqualNeighbours | Doubt::NearNeighbour { .. });
            match said.iter_mut().find(|(_, other)| !of_one && *other == doubt) {
                Some((modes, _)) => modes.push(mode),
                None => said.push((vec![mode], doubt)),
            }
        }
    }
    said
}

/// Each doubt in a sentence, with all the modes that share it.
pub fn doubt_sentences(all: &[impl AsRef<[Doubt]>]) -> Vec<String> {
    let sentence = |(modes, doubt): &(Vec<usize>, &Doubt)| format!("{}: {doubt}", capital(named(modes)));
    shared(all).iter().map(sentence).collect()
}

/// The verdict on a number that is in doubt.
pub fn standing(doubt: &Doubt) -> &'static str {
    if doubt.certain() { "Not to be trusted" } else { "Doubtful" }
}

/// Writes the doubts that distances raise, and names the analysis that can settle them.
pub fn doubted(said: &mut Findings, all: &[impl AsRef<[Doubt]>]) {
    let mut open = false;
    for (modes, doubt) in shared(all) {
        let names = named(&modes);
        match doubt {
            Doubt::NoFrequency => said.note(format!("{}: {doubt}", capital(names))),
            _ => {
                open |= !doubt.certain();
                said.note(format!("{} for {names}: {doubt}", standing(doubt)));
            }
        }
    }
    if open {
        said.note("Distances do not tell how large an error is: `summary` compares sigma with samples.");
    }
}

/// All doubts about one number as one text, for a cell.
pub fn joined(doubts: &[impl fmt::Display]) -> Option<String> {
    let texts: Vec<String> = doubts.iter().map(ToString::to_string).collect();
    (!texts.is_empty()).then(|| texts.join(" "))
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoFrequency => write!(f, "no oscillation, so there is no frequency to spread."),
            Self::Clustered { defective: true, .. } => write!(
                f,
                "merged into one defective eigenvalue, which splits as the square root of any change. There is no \
                 sigma at first order."
            ),
            Self::Clustered { modes, distance, .. } => write!(
                f,
                "tolerances mix {}, {} standard deviations apart. None has a sigma of its own: use that of the \
                 mean, of the lowest and of the highest below, or of samples.",
                named(modes),
                short(*distance)
            ),
            Self::EqualInEveryDesign { modes } => write!(
                f,
                "no tolerance splits {}: they are equal in every design, each with the sigma of their mean below.",
                named(modes)
            ),
            Self::Blades { modes } => write!(
                f,
                "a blade vibrates in it as in {}, and each blade with a tolerance of its own mixes them: their spread is that of \
                 single blades, not of their mean, which first order and samples take.",
                named(modes)
            ),
            Self::Unrepresentative { quantity } => write!(
                f,
                "sigma of the {} is due to values too rare to be among the samples: nothing confirms it.",
                quantity
            ),
            Self::NearCritical { distance: 0.0 } => {
                write!(f, "the stiffness is zero within rounding: this is a critical state. Sigma is meaningless here.")
            }
            Self::NearCritical { distance } => write!(
                f,
                "the critical state is {} standard deviations away. Within {TRUSTED_DISTANCE} of them the error of sigma \
                 has no bound.",
                short(distance.abs())
            ),
            Self::BranchNear { mode, distance } => write!(
                f,
                "the critical state of mode {} is {} standard deviations away, beyond which the equilibrium changes branch \
                 and all modes with it.",
                mode + 1,
                short(distance.abs())
            ),
            Self::EqualNeighbours => {
                write!(f, "it has nearly equal neighbours and no derivative of its own.")
            }
            Self::NearNeighbour { distance } => {
                write!(f, "samples may mix it with another mode, {} standard deviations away.", short(*distance))
            }
            Self::NearInstability { distance: 0.0 } => write!(
                f,
                "the vibration neither grows nor decays within rounding. Sigma counts samples that are unstable: see the counts of Monte \
                 Carlo."
            ),
            Self::NearInstability { distance } if *distance < 0.0 => {
                write!(f, "the vibration grows. Sigma is that of the frequency of a motion that does not stay small.")
            }
            Self::NearInstability { distance } => write!(
                f,
                "the vibration begins to grow {} standard deviations away. Sigma counts samples that are unstable: see \
                 the counts of Monte Carlo.",
                short(*distance)
            ),
            Self::NearCriticalDamping { distance } => write!(
                f,
                "the oscillation ceases {} standard deviations away, where it becomes two decaying motions. Within \
                 {TRUSTED_DISTANCE} of them the error of sigma has no bound.",
                short(*distance)
            ),
            Self::Nonlinear { quantity, sigma_error } => {
                let name = quantity;
                write!(
                    f,
                    "the first-order sigma of the {name} is {:.1} % below that of second order, because it is not linear \
                     within the tolerances. Second order shows that, but not by how much.",
                    100.0 * sigma_error
                )
            }
            Self::Inaccurate { quantity, error } => write!(
                f,
                "the first-order sigma of the {} is {:.1} % {} that of the samples.",
                quantity,
                100.0 * error.value.abs(),
                if error.value < 0.0 { "below" } else { "above" }
            ),
            Self::Missing { quantity, count, samples } => {
                write!(f, "only {count} of {samples} samples have its {}.", quantity)
            }
            Self::Unchecked { reason } => {
                write!(f, "sigma was not checked against second order: {reason}.")
            }
        }
    }
}
