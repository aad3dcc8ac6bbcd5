use core::fmt;

use eigentol_results::grid::cells;
use eigentol_results::naming::named;
use eigentol_results::numbers::{converted, heading, in_unit, optional, or_dash, rough, rough_in, short};
use eigentol_results::{Answer, Columns, Findings, Grid, Listed, Subject, at_point, displayed};

use super::tolerance::ClusterTolerance;
use super::{ClusterSpread, DirectionalDerivatives, SortedSpread};
use crate::Unit;
use crate::modes::Family;
use crate::tolerance::{Spread, Statistics, statistics};

/// `cluster verdicts`: a row for each cluster; `clusters`: for each cluster, a row for each member from the lowest up,
/// and one for the splitting between the lowest and the highest.
impl Listed for ClusterTolerance {
    const KIND: &'static str = "clusters";

    at_point!();

    fn findings(all: &[Self]) -> Findings {
        let mut said = Findings::default();
        for cluster in all {
            said.join(cluster.said());
        }
        if all.is_empty() {
            said.note("tolerances bring no modes together");
            return said;
        }
        verdicts(&mut said, all);
        members(&mut said, all);
        said
    }
}

impl fmt::Display for ClusterTolerance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.said().fmt(f)
    }
}

fn frequency_of_mean(cluster: &ClusterTolerance) -> Option<&Spread> {
    cluster.mean.as_ref()?.frequency.as_ref()
}

fn verdicts(said: &mut Findings, all: &[ClusterTolerance]) {
    let mut table = Columns::new("cluster verdicts", all);
    table.words("modes", &|row| Some(listed(&row.modes)));
    table.number("distance", "sigma", &|row| Some(row.distance));
    table.number("mean frequency", "rad/s", &|row| Some(frequency_of_mean(row)?.mean));
    table.number("sigma of mean frequency", "rad/s", &|row| Some(frequency_of_mean(row)?.sigma));
    table.words("error", &|row| Some(row.spread.as_ref().err()?.to_string()));
    said.columns(table);
}

/// A member of a cluster, or the splitting of its members.
struct Member<'a> {
    cluster: &'a ClusterTolerance,
    quantity: &'static str,
    name: String,
    value: Option<&'a Statistics>,
}

fn members(said: &mut Findings, all: &[ClusterTolerance]) {
    let rows: Vec<Member<'_>> = all.iter().flat_map(ClusterTolerance::members).collect();
    let mut table = Columns::new("clusters", &rows);
    table.words("modes", &|row| Some(listed(&row.cluster.modes)));
    table.number("distance", "sigma", &|row| Some(row.cluster.distance));
    table.words("quantity", &|row| Some(row.quantity.to_owned()));
    table.words("member", &|row| Some(row.name.clone()));
    statistics(&mut table, "member", "", &|row| row.value);
    said.columns(table);
}

impl ClusterTolerance {
    fn members(&self) -> Vec<Member<'_>> {
        let Ok(spread) = &self.spread else {
            return Vec::new();
        };
        let damping = spread.damping_ratio.as_ref();
        let quantities = [("frequency", &spread.frequency)].into_iter();
        let quantities = quantities.chain(damping.map(|damping| ("damping ratio", damping)));
        let mut rows = Vec::new();
        for (quantity, spreads) in quantities {
            let member = |name, value| Member { cluster: self, quantity, name, value };
            rows.extend(spreads.members.iter().enumerate().map(|(k, x)| member((k + 1).to_string(), x.value.as_ref())));
            rows.push(member("splitting".to_owned(), spreads.splitting.as_ref()));
        }
        rows
    }

    /// What its text says.
    #[doc(hidden)]
    pub fn said(&self) -> Findings {
        let of = Subject::at(&self.description, &self.inputs);
        let modes = named(&self.modes);
        let spread = match &self.spread {
            Ok(spread) => spread,
            Err(_) if self.defective() => {
                return of.titled(format_args!(
                    "merged into a defective eigenvalue: {modes}. It splits as the square root of any change and \
                     has no sigma"
                ));
            }
            Err(error) => {
                return of.titled(format_args!("{modes} form a cluster: {error}"));
            }
        };
        let are = if self.equal {
            "are equal in every design".to_owned()
        } else {
            format!("form a cluster, {} standard deviations apart", short(self.distance))
        };
        let samples = spread.samples;
        let mut said = of.titled(format_args!("{modes} {are}; {samples} samples"));
        said.text(self.sorted(spread));
        if spread.unstable > 0 {
            let unstable = spread.unstable;
            said.note(format!("A member grows in {unstable} of the samples."));
        }
        without(&mut said, spread);
        said
    }

    fn sorted(&self, spread: &ClusterSpread) -> Grid {
        let unit = &self.description.frequency;
        let mut table = Grid::new(cells(["sorted", "mean", "sigma", "min", "max", "samples"]));
        if let Some(spread) = frequency_of_mean(self) {
            let (mean, sigma) = (in_unit(spread.mean, unit), rough_in(spread.sigma, unit));
            table.row(cells([&heading("of the mean eigenvalue", unit), &mean, &sigma, "-", "-", "-"]));
        }
        sorted_members(&mut table, ("frequency", unit), &spread.frequency);
        let splitting = spread.frequency.splitting.as_ref();
        sorted_row(&mut table, &heading("splitting", unit), unit, splitting);
        if let Some(damping_ratio) = &spread.damping_ratio {
            sorted_members(&mut table, ("damping ratio", &Unit::si("")), damping_ratio);
        }
        table
    }
}

/// Rows for the lowest member, those in between, and the highest.
fn sorted_members(table: &mut Grid, (quantity, unit): (&str, &Unit), spread: &SortedSpread) {
    let count = spread.members.len();
    for (k, member) in spread.members.iter().enumerate() {
        let quantity = heading(quantity, unit);
        let name = match k {
            0 => format!("lowest {quantity}"),
            k if k + 1 == count => format!("highest {quantity}"),
            k => format!("{quantity} {} of {count}", k + 1),
        };
        sorted_row(table, &name, unit, member.value.as_ref());
    }
}

fn sorted_row(table: &mut Grid, name: &str, unit: &Unit, value: Option<&Statistics>) {
    let of = |pick: fn(&Statistics) -> f64| optional(value.map(|own| converted(pick(own), unit)));
    table.row(vec![
        name.to_owned(),
        of(|own| own.mean),
        or_dash(value.and_then(|own| own.sigma).map(|sigma| converted(sigma, unit)), rough),
        of(|own| own.min),
        of(|own| own.max),
        value.map_or(0, |own| own.count).to_string(),
    ]);
}

/// Counts what the table omits.
fn without(said: &mut Findings, spread: &ClusterSpread) {
    let lowest = spread.frequency.lowest().map_or(0, |member| member.without);
    if lowest > 0 {
        said.note(format!("In {lowest} of the samples a member has no frequency."));
    }
    if spread.unsolved > 0 {
        let unsolved = spread.unsolved;
        said.note(format!("The eigenvalues of {unsolved} samples were not found."));
    }
}

/// `directional derivatives`: a row for each eigenvalue of the cluster; their assignment to modes is undefined.
impl Answer for DirectionalDerivatives {
    const KIND: &'static str = "directional derivatives";

    at_point!();

    fn findings(&self) -> Findings {
        let modes = named(&self.modes);
        let mut said = self.titled(format_args!("derivatives of {modes} in a direction"));
        let unit = match self.family {
            Family::Undamped => "1/s^2",
            Family::General => "1/s",
        };
        let rows: Vec<_> = self.eigenvalues.iter().enumerate().collect();
        let mut table = Columns::new("directional derivatives", &rows);
        table.words("modes", &|_| Some(listed(&self.modes)));
        table.number("Re derivative", unit, &|(_, x)| Some(x.re)).digits(rough);
        table.number("Im derivative", unit, &|(_, x)| Some(x.im)).digits(rough);
        let frequency =
            table.number("derivative of frequency", "rad/s", &|(k, _)| self.frequencies.as_ref()?.get(*k).copied());
        frequency.digits(rough);
        said.columns(table);
        said
    }
}

displayed!(DirectionalDerivatives);

/// `1 2 3`
fn listed(modes: &[usize]) -> String {
    let modes: Vec<String> = modes.iter().map(|mode| (mode + 1).to_string()).collect();
    modes.join(" ")
}
