//! Clusters and verdicts as text.

use core::fmt;

use super::numbers::{number, optional, or_dash, rough, short};
use super::relevance::unless_rounding;
use super::shares::mostly;
use super::table::{Table, cells, undamped};
use super::title::title;
use super::tolerance::{far, spread_of, unmoved};
use crate::Quantity;
use crate::clusters::{ClusterSpread, ClusterTolerance, MemberSpread, SortedSpread};
use crate::summary::{Advice, Chance, Check, Doubt, Measured, Sampled, Sampling, Summary};
use crate::tolerance::{Outcome, Statistics, TRUSTED_DISTANCE};

/// `mode 2`, `modes 2 and 3`, `modes 1 to 4 and 7`, counted from 1.
fn named(modes: &[usize]) -> String {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for &mode in modes {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == mode => *last = mode,
            _ => runs.push((mode, mode)),
        }
    }
    let texts = runs.iter().flat_map(|&(first, last)| match last - first {
        0 => vec![(first + 1).to_string()],
        1 => vec![(first + 1).to_string(), (last + 1).to_string()],
        _ => vec![format!("{} to {}", first + 1, last + 1)],
    });
    let texts: Vec<String> = texts.collect();
    match &texts[..] {
        [] => "no mode".to_owned(),
        [one] if modes.len() == 1 => format!("mode {one}"),
        [one] => format!("modes {one}"),
        [others @ .., last] => format!("modes {} and {last}", others.join(", ")),
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
        or_dash(value.and_then(|s| s.sigma), rough),
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
        let (distance, samples) = (short(self.distance), spread.samples);
        writeln!(
            f,
            "{title}: {modes} form a cluster, {distance} standard deviations apart; {samples} samples"
        )?;
        let mut table = Table::new(cells(["sorted", "mean", "sigma", "min", "max", "samples"]));
        if let Some(mean) = self.mean.as_ref().and_then(|mean| mean.frequency.as_ref()) {
            let name = "of the mean eigenvalue [rad/s]".to_owned();
            let (mean, sigma) = (number(mean.mean), rough(mean.sigma));
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
        if self.unmoved() {
            writeln!(f, "  No tolerance moves a mode.")?;
        } else {
            self.frequencies(f)?;
            self.damping_ratios(f)?;
        }
        undamped(f, self.first.family, d)?;
        self.sentences(f)?;
        self.about_samples(f)?;
        let mixed = |cluster: &&ClusterTolerance| {
            cluster
                .modes
                .iter()
                .any(|mode| self.cluster_of(*mode).is_some())
        };
        (self.clusters.iter().filter(mixed)).try_for_each(|cluster| write!(f, "{cluster}"))
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
    /// Whether no tolerance moves a mode, or mixes it with others.
    fn unmoved(&self) -> bool {
        self.clusters.is_empty() && self.first.modes.iter().all(unmoved)
    }

    /// The spread of each frequency by every method, what it comes from, and whether first order is right.
    fn frequencies(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut head = cells([
            "mode",
            "nominal [rad/s]",
            "sigma: first order",
            "second order",
        ]);
        let sampled = self.sampled().is_some();
        if sampled {
            head.push("sampled".to_owned());
        }
        head.push(format!("{} sigma", self.first.sigma_level));
        head.extend(cells(["mostly from", "trusted"]));
        let mut table = Table::new(head);
        for (r, (mode, trust)) in self.first.modes.iter().zip(&self.trust).enumerate() {
            let alone = self.cluster_of(r).is_none();
            let own = |value: Option<f64>| or_dash(value.filter(|_| alone), rough);
            let sigma = mode.frequency.as_ref().map(spread_of);
            let nominal = mode.behaviour.frequency();
            let second = self.second_order_sigma(r);
            let mut row = vec![
                (r + 1).to_string(),
                optional(nominal),
                own(sigma),
                own(second.map(|sigma| unless_rounding(sigma, nominal.unwrap_or(0.0)))),
            ];
            if sampled {
                let check = trust.check(Quantity::Frequency);
                row.push(or_dash(check.map(|check| check.sigma.value), rough));
            }
            row.push(own(sigma.map(|sigma| sigma * self.first.sigma_level)));
            let moved = alone && sigma.is_none_or(|sigma| sigma != 0.0);
            let shares = moved.then(|| mostly(&self.description, mode.variance_shares()));
            row.push(shares.unwrap_or_else(|| "-".to_owned()));
            row.push(verdict(&trust.doubts));
            table.row(row);
        }
        write!(f, "{table}")
    }

    /// The same of damping ratios, where any varies.
    fn damping_ratios(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sampled = self.sampled().is_some();
        let mut head = cells(["mode", "damping ratio", "sigma: first order"]);
        if sampled {
            head.push("sampled".to_owned());
        }
        head.extend(cells(["to instability [sigma]", "mostly from"]));
        let mut table = Table::new(head);
        for (r, (mode, trust)) in self.first.modes.iter().zip(&self.trust).enumerate() {
            let Some(own) = mode.damping_ratio.as_ref() else {
                continue;
            };
            let sigma = spread_of(own);
            if sigma == 0.0 || self.cluster_of(r).is_some() {
                continue;
            }
            let mut row = vec![(r + 1).to_string(), rough(own.mean), rough(sigma)];
            if sampled {
                let check = trust.check(Quantity::DampingRatio);
                row.push(or_dash(check.map(|check| check.sigma.value), rough));
            }
            row.push(far(mode.distance_to_instability));
            row.push(mostly(&self.description, &own.variance_shares));
            table.row(row);
        }
        match table.is_empty() {
            true => Ok(()),
            false => write!(f, "{table}"),
        }
    }

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
        for trust in self.trust.iter().filter(|own| !own.trusted()) {
            let converges = self.second_order_sigma(trust.mode).is_some();
            (trust.checks.iter()).try_for_each(|check| row_of(f, trust.mode, check, converges))?;
        }
        for advice in [Advice::FirstOrder, Advice::SecondOrder, Advice::Sampling] {
            let own = || self.trust.iter().filter(|own| own.advice == advice);
            let modes: Vec<usize> = own().map(|own| own.mode).collect();
            let text = match advice {
                Advice::FirstOrder => format!(
                    "nothing speaks against the first-order sigma{}.",
                    confirmed(own().flat_map(|own| &own.checks))
                ),
                Advice::SecondOrder => {
                    "use second order, which agrees with the samples.".to_owned()
                }
                _ => "use Monte Carlo.".to_owned(),
            };
            if !modes.is_empty() && !self.unmoved() {
                writeln!(f, "  {}: {text}", capital(named(&modes)))?;
            }
        }
        Ok(())
    }

    /// What became of the samples, or why there are none.
    fn about_samples(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.sampling {
            Sampling::NotNeeded => Ok(()),
            Sampling::TooDear { operations, budget } => writeln!(
                f,
                "  Not checked by samples: they would cost {operations:.1e} operations of {budget:.1e}. The verdicts rest on distances \
                 and second order."
            ),
            Sampling::Done(sampled) => {
                let missing = self.trust.iter().flat_map(|own| &own.checks);
                if missing.clone().any(|check| check.count < check.samples) {
                    writeln!(
                        f,
                        "  Sampled sigmas are those of the samples that are stable and in which the mode oscillates; in others it has no \
                         frequency."
                    )?;
                }
                chances(f, sampled)
            }
        }
    }
}

/// By how much first order misses the samples at most; empty without samples.
fn confirmed<'a>(checks: impl Iterator<Item = &'a Check>) -> String {
    let errors = checks.filter_map(|check| Some((check.first_order_error?, check.count)));
    let most = errors.max_by(|(a, _), (b, _)| a.value.abs().total_cmp(&b.value.abs()));
    match most {
        None => String::new(),
        Some((error, count)) => format!(
            ", which is off by at most {:.1} % (+- {:.1}) over {count} samples",
            100.0 * error.value.abs(),
            200.0 * error.standard_error
        ),
    }
}

/// By how much first and second order miss the samples; where the series does not converge, second order has no sigma.
fn row_of(f: &mut fmt::Formatter<'_>, mode: usize, check: &Check, converges: bool) -> fmt::Result {
    let percent = |error: Measured| {
        let (value, uncertain) = (100.0 * error.value, 200.0 * error.standard_error);
        format!("{value:+.1} % (+- {uncertain:.1})")
    };
    let name = quantity_name(check.quantity);
    let count = match check.count {
        all if all == check.samples => format!("{all} samples"),
        some => format!("{some} of {} samples", check.samples),
    };
    write!(
        f,
        "  Mode {}: sigma of the {name} over {count} {}",
        mode + 1,
        rough(check.sigma.value)
    )?;
    if let Some(error) = check.first_order_error {
        write!(f, "; first order is off by {}", percent(error))?;
    }
    match check.second_order_error {
        Some(error) if converges => write!(f, ", second order by {}", percent(error))?,
        Some(_) => write!(f, "; the second-order series does not converge")?,
        None => {}
    }
    writeln!(f, ".")
}

/// What happened to samples that are not stable on the nominal branch.
fn chances(f: &mut fmt::Formatter<'_>, sampled: &Sampled) -> fmt::Result {
    let line = |f: &mut fmt::Formatter<'_>, name: &str, chance: Chance| {
        if chance.count == 0 {
            return Ok(());
        }
        let percent = |share: f64| format!("{:.3}", 100.0 * share);
        writeln!(
            f,
            "  {name}: {} % of {} samples (95 %: {} to {} %).",
            percent(chance.value()),
            chance.samples,
            percent(chance.lower),
            percent(chance.upper)
        )
    };
    if let Some(chance) = sampled.other_branch {
        line(f, "Stable on another branch", chance)?;
    }
    for (outcome, chance) in &sampled.outcomes {
        let name = match outcome {
            Outcome::Stable => continue,
            Outcome::Divergent => "Unstable without oscillation",
            Outcome::Flutter => "Unstable in a growing oscillation",
            Outcome::Undecided => "Stability not decided",
            Outcome::NoEquilibrium => "No equilibrium",
            Outcome::NotAssembled => "Loops do not close",
            Outcome::Unphysical => "Bodies that cannot exist",
            Outcome::NoModes => "Modes not found",
        };
        line(f, name, *chance)?;
    }
    Ok(())
}

fn quantity_name(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Frequency => "frequency",
        Quantity::NaturalFrequency => "natural frequency",
        Quantity::DampingRatio => "damping ratio",
        Quantity::Growth => "growth",
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
                short(*distance)
            ),
            Self::NearCritical { distance: 0.0 } => write!(
                f,
                "the stiffness is zero within rounding: this is a critical state. Sigma says nothing here."
            ),
            Self::NearCritical { distance } if *distance < 0.0 => write!(
                f,
                "the equilibrium is not stable. Samples settle elsewhere, and sigma says nothing about them."
            ),
            Self::NearCritical { distance } => write!(
                f,
                "the critical state is {} standard deviations away. Within {TRUSTED_DISTANCE} of them the error of sigma \
                 has no bound.",
                short(*distance)
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
                short(*distance)
            ),
            Self::NearCriticalDamping { distance } => write!(
                f,
                "the oscillation ceases {} standard deviations away, where it becomes two decaying motions. Within \
                 {TRUSTED_DISTANCE} of them the error of sigma has no bound.",
                short(*distance)
            ),
            Self::Nonlinear {
                quantity,
                sigma_error,
            } => {
                let name = quantity_name(*quantity);
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
                quantity_name(*quantity),
                100.0 * error.value.abs(),
                if error.value < 0.0 { "below" } else { "above" }
            ),
            Self::Missing {
                quantity,
                count,
                samples,
            } => write!(
                f,
                "only {count} of {samples} samples have its {}.",
                quantity_name(*quantity)
            ),
            Self::Unchecked { reason } => {
                write!(f, "sigma was not checked against second order: {reason}.")
            }
        }
    }
}
