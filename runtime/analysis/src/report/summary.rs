//! Clusters and verdicts as text.

use core::fmt;

use crate::Quantity;
use crate::clusters::{ClusterSpread, ClusterTolerance, MemberSpread, SortedSpread};
use crate::judge::Doubt;
use crate::summary::Summary;
use crate::tolerance::Statistics;
use eigentol_results::naming::named;
use eigentol_results::numbers::{number, optional, or_dash, rough, short};
use eigentol_results::relevance::{NOTHING_VARIES, unless_rounding};
use eigentol_results::shares::mostly;
use eigentol_results::table::{Table, cells};
use eigentol_results::title::title;
use eigentol_solve::report::undamped;
use eigentol_tolerance::report::{far, spread_of, unmoved};

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

/// Rows for the lowest member, those in between, and the highest.
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
                     has no sigma"
                );
            }
            Err(error) => return writeln!(f, "{title}: {modes} form a cluster: {error}"),
        };
        let samples = spread.samples;
        let are = match self.equal {
            true => "are equal in every design".to_owned(),
            false => format!(
                "form a cluster, {} standard deviations apart",
                short(self.distance)
            ),
        };
        writeln!(f, "{title}: {modes} {are}; {samples} samples")?;
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

/// Counts what the table omits.
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
        if !self.first.varies {
            writeln!(f, "  {NOTHING_VARIES}")?;
        } else if self.unmoved() {
            writeln!(f, "  No tolerance moves a mode.")?;
        } else {
            self.frequencies(f)?;
            self.damping_ratios(f)?;
        }
        undamped(f, self.first.family, d)?;
        for sentence in self.sentences() {
            writeln!(f, "  {sentence}")?;
        }
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
        doubts if doubts.iter().any(Doubt::shared) => "cluster",
        [Doubt::NoFrequency, ..] => "-",
        _ => "no",
    };
    word.to_owned()
}

impl Summary {
    /// Whether no tolerance moves a mode or mixes it with others.
    pub(super) fn unmoved(&self) -> bool {
        self.clusters.is_empty() && self.first.modes.iter().all(unmoved)
    }

    /// The spread of each frequency by every method, its sources, and whether first order is right.
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
            let sigma = mode.frequency().as_ref().map(spread_of);
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
            let moved = alone && sigma.is_some_and(|sigma| sigma != 0.0);
            let shares = moved.then(|| mostly(&self.description, mode.variance_shares()));
            row.push(shares.unwrap_or_else(|| "-".to_owned()));
            row.push(verdict(&trust.doubts));
            table.row(row);
        }
        write!(f, "{table}")
    }

    /// The spread of each damping ratio, if any varies, in the same form.
    fn damping_ratios(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sampled = self.sampled().is_some();
        let mut head = cells(["mode", "damping ratio", "sigma: first order"]);
        if sampled {
            head.push("sampled".to_owned());
        }
        head.extend(cells(["to instability [sigma]", "mostly from"]));
        let mut table = Table::new(head);
        for (r, (mode, trust)) in self.first.modes.iter().zip(&self.trust).enumerate() {
            let Some(own) = mode.damping_ratio() else {
                continue;
            };
            let sigma = spread_of(&own);
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
}
