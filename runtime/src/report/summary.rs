//! Clusters and verdicts as text.

use core::fmt;

use super::table::{Table, cells, number, optional, undamped};
use super::title::title;
use crate::Quantity;
use crate::clusters::{ClusterSpread, ClusterTolerance, MemberSpread, SortedSpread};
use crate::summary::{Doubt, Summary};
use crate::tolerance::{Statistics, TRUSTED_DISTANCE};

/// `mode 2`, `modes 2 and 3`, `modes 1, 2 and 3`, counted from 1.
fn named(modes: &[usize]) -> String {
    match modes {
        [] => "no mode".to_owned(),
        [one] => format!("mode {}", one + 1),
        [others @ .., last] => {
            let others: Vec<String> = others.iter().map(|mode| (mode + 1).to_string()).collect();
            format!("modes {} and {}", others.join(", "), last + 1)
        }
    }
}

fn capital(mut text: String) -> String {
    if let Some(first) = text.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    text
}

fn statistics(name: String, value: Option<&Statistics>) -> Vec<String> {
    let of = |pick: fn(&Statistics) -> Option<f64>| optional(value.and_then(pick));
    vec![
        name,
        of(|s| Some(s.mean)),
        of(|s| s.sigma),
        of(|s| Some(s.min)),
        of(|s| Some(s.max)),
        value.map_or(0, |s| s.count).to_string(),
    ]
}

/// Rows for the lowest, those between and the highest.
fn members(table: &mut Table, quantity: &str, spread: &SortedSpread) {
    let count = spread.members.len();
    for (k, MemberSpread { value, .. }) in spread.members.iter().enumerate() {
        let name = match k {
            0 => format!("lowest {quantity}"),
            k if k + 1 == count => format!("highest {quantity}"),
            k => format!("{quantity} {} of {count}", k + 1),
        };
        table.row(statistics(name, value.as_ref()));
    }
}

impl fmt::Display for ClusterTolerance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let title = title(&self.description, &self.inputs);
        let modes = named(&self.modes);
        let spread = match &self.spread {
            Ok(spread) => spread,
            Err(_) if self.defective() => {
                return writeln!(
                    f,
                    "{title}: merged into a defective eigenvalue: {modes}. It splits as the square root of any change and \
                     has no sigma; use Monte Carlo"
                );
            }
            Err(error) => return writeln!(f, "{title}: {modes} form a cluster: {error}"),
        };
        let (distance, samples) = (number(self.distance), spread.samples);
        writeln!(
            f,
            "{title}: {modes} form a cluster, {distance} standard deviations apart; {samples} samples"
        )?;
        let mut table = Table::new(cells(["sorted", "mean", "sigma", "min", "max", "samples"]));
        if let Some(mean) = self.mean.as_ref().and_then(|mean| mean.frequency.as_ref()) {
            let name = "of the mean eigenvalue [rad/s]".to_owned();
            let (mean, sigma) = (number(mean.mean), number(mean.sigma));
            let none = || "-".to_owned();
            table.row(vec![name, mean, sigma, none(), none(), none()]);
        }
        members(&mut table, "frequency [rad/s]", &spread.frequency);
        let splitting = spread.frequency.splitting.as_ref();
        table.row(statistics("splitting [rad/s]".to_owned(), splitting));
        if let Some(damping_ratio) = &spread.damping_ratio {
            members(&mut table, "damping ratio", damping_ratio);
        }
        write!(f, "{table}")?;
        if spread.unstable > 0 {
            writeln!(f, "  A member grows in {} of the samples.", spread.unstable)?;
        }
        without(f, spread)
    }
}

/// Counts what the table leaves out.
fn without(f: &mut fmt::Formatter<'_>, spread: &ClusterSpread) -> fmt::Result {
    let lowest = spread.frequency.lowest().map_or(0, |member| member.without);
    if lowest > 0 {
        writeln!(f, "  In {lowest} of the samples a member has no frequency.")?;
    }
    if spread.unsolved > 0 {
        let unsolved = spread.unsolved;
        writeln!(f, "  The eigenvalues of {unsolved} samples were not found.")?;
    }
    Ok(())
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let d = &self.description;
        let title = title(d, &self.inputs);
        writeln!(f, "{title}: what tolerances do to the frequencies")?;
        let mut head = cells([
            "mode",
            "nominal [rad/s]",
            "sigma, first order",
            "second order",
        ]);
        head.push(format!("{} sigma [rad/s]", self.first.sigma_level));
        head.push("trusted".to_owned());
        let mut table = Table::new(head);
        for (r, (mode, trust)) in self.first.modes.iter().zip(&self.trust).enumerate() {
            let alone = self.cluster_of(r).is_none();
            let own = |value: Option<f64>| optional(value.filter(|_| alone));
            let frequency = mode.frequency.as_ref();
            table.row(vec![
                (r + 1).to_string(),
                optional(mode.behaviour.frequency()),
                own(frequency.map(|spread| spread.sigma)),
                own(self.second_order_sigma(r)),
                own(frequency.map(|spread| spread.band)),
                verdict(&trust.doubts),
            ]);
        }
        write!(f, "{table}")?;
        undamped(f, self.first.family, d)?;
        self.sentences(f)?;
        self.clusters
            .iter()
            .try_for_each(|cluster| write!(f, "{cluster}"))
    }
}

fn verdict(doubts: &[Doubt]) -> String {
    let word = match doubts {
        [] => "yes",
        doubts
            if doubts
                .iter()
                .any(|doubt| matches!(doubt, Doubt::Clustered { .. })) =>
        {
            "cluster"
        }
        [Doubt::NoFrequency, ..] => "-",
        _ => "no",
    };
    word.to_owned()
}

impl Summary {
    /// Each doubt once, with all the modes that share it.
    fn sentences(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut said: Vec<&Doubt> = Vec::new();
        for doubt in self.trust.iter().flat_map(|own| &own.doubts) {
            if said.contains(&doubt) {
                continue;
            }
            said.push(doubt);
            let shares = self.trust.iter().filter(|own| own.doubts.contains(doubt));
            let modes: Vec<usize> = shares.map(|own| own.mode).collect();
            writeln!(f, "  {}: {doubt}", capital(named(&modes)))?;
        }
        let trusted: Vec<usize> = self
            .trust
            .iter()
            .filter(|own| own.trusted())
            .map(|own| own.mode)
            .collect();
        if trusted.is_empty() {
            return Ok(());
        }
        let modes = capital(named(&trusted));
        writeln!(
            f,
            "  {modes}: nothing speaks against the first-order sigma."
        )
    }
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoFrequency => write!(
                f,
                "no oscillation, so no frequency that could have a sigma."
            ),
            Self::Clustered {
                defective: true, ..
            } => write!(
                f,
                "merged into one defective eigenvalue, which splits as the square root of any change. There is no \
                 sigma at first order; use Monte Carlo."
            ),
            Self::Clustered {
                modes, distance, ..
            } => write!(
                f,
                "tolerances mix {}, {} standard deviations apart. None has a sigma of its own: use that of the \
                 mean, of the lowest and of the highest below, or Monte Carlo.",
                named(modes),
                number(*distance)
            ),
            Self::NearCritical { distance: 0.0 } => write!(
                f,
                "the stiffness is zero within rounding: this is a critical state. Sigma says nothing here: use Monte Carlo."
            ),
            Self::NearCritical { distance } if *distance < 0.0 => write!(
                f,
                "the equilibrium is not stable. Samples settle elsewhere, and sigma says nothing about them."
            ),
            Self::NearCritical { distance } => write!(
                f,
                "the critical state is {} standard deviations away. Within {TRUSTED_DISTANCE} of them the error of sigma \
                 has no bound: use Monte Carlo.",
                number(*distance)
            ),
            Self::NearInstability { distance: 0.0 } => write!(
                f,
                "the vibration neither grows nor decays within rounding. Sigma counts samples that are unstable: see the counts of Monte \
                 Carlo."
            ),
            Self::NearInstability { distance } if *distance < 0.0 => write!(
                f,
                "the vibration grows. Sigma is that of the frequency of a motion that does not stay small."
            ),
            Self::NearInstability { distance } => write!(
                f,
                "the vibration begins to grow {} standard deviations away. Sigma counts samples that are unstable: see \
                 the counts of Monte Carlo.",
                number(*distance)
            ),
            Self::NearCriticalDamping { distance } => write!(
                f,
                "the oscillation ceases {} standard deviations away, where it becomes two decaying motions. Within \
                 {TRUSTED_DISTANCE} of them the error of sigma has no bound: use Monte Carlo.",
                number(*distance)
            ),
            Self::Nonlinear {
                quantity,
                sigma_error,
            } => {
                let name = match quantity {
                    Quantity::Frequency => "frequency",
                    Quantity::NaturalFrequency => "natural frequency",
                    Quantity::DampingRatio => "damping ratio",
                    Quantity::Growth => "growth",
                };
                write!(
                    f,
                    "the first-order sigma of the {name} is {:.1} % below that of second order, because it is not linear \
                     within the tolerances. Second order shows that, but not by how much: use Monte Carlo.",
                    100.0 * sigma_error
                )
            }
            Self::Unchecked { reason } => {
                write!(f, "sigma was not checked against second order: {reason}.")
            }
        }
    }
}
