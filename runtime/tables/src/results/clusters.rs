use eigentol::Family;
use eigentol::clusters::{ClusterTolerance, DirectionalDerivatives, SortedSpread};
use eigentol::tolerance::Statistics;

use super::Tables;
use super::names::operating_point;
use super::tolerance::statistics;
use crate::Table;

/// `clusters`: for each cluster, a row for each member from the lowest up, and one for the splitting between the lowest
/// and the highest.
impl Tables for [ClusterTolerance] {
    fn tables(&self) -> Vec<Table> {
        let Some(one) = self.first() else {
            return Vec::new();
        };
        let mut rows: Vec<(usize, String, &str, Option<&Statistics>)> = Vec::new();
        for (k, cluster) in self.iter().enumerate() {
            let Ok(spread) = &cluster.spread else {
                continue;
            };
            let quantities = [
                ("frequency", Some(&spread.frequency)),
                ("damping ratio", spread.damping_ratio.as_ref()),
            ];
            for (quantity, own) in quantities {
                let own = own.into_iter().flat_map(members);
                rows.extend(own.map(|(name, value)| (k, name, quantity, value)));
            }
        }
        let cluster = |k: usize| &self[k];
        let mut table = Table::new("clusters");
        table.texts(
            "modes",
            rows.iter().map(|(k, ..)| Some(listed(&cluster(*k).modes))),
        );
        table.numbers(
            "distance",
            "sigma",
            rows.iter().map(|(k, ..)| cluster(*k).distance),
        );
        table.texts(
            "quantity",
            rows.iter()
                .map(|(_, _, quantity, _)| Some((*quantity).to_owned())),
        );
        table.texts(
            "member",
            rows.iter().map(|(_, name, ..)| Some(name.clone())),
        );
        statistics(
            &mut table,
            "member",
            "",
            rows.iter().map(|(.., value)| *value),
        );
        let d = &one.description;
        operating_point(&mut table, d, &one.inputs, None);
        let mut found = Table::new("cluster verdicts");
        found.texts("modes", self.iter().map(|own| Some(listed(&own.modes))));
        found.numbers("distance", "sigma", self.iter().map(|own| own.distance));
        let mean = self.iter().map(|own| own.mean.as_ref()?.frequency.as_ref());
        found.numbers(
            "mean frequency",
            "rad/s",
            mean.clone().map(|own| Some(own?.mean)),
        );
        found.numbers(
            "sigma of mean frequency",
            "rad/s",
            mean.map(|own| Some(own?.sigma)),
        );
        found.texts(
            "error",
            self.iter()
                .map(|own| Some(own.spread.as_ref().err()?.to_string())),
        );
        operating_point(&mut found, d, &one.inputs, None);
        vec![found, table]
    }
}

/// `directional derivatives`: a row for each eigenvalue of the cluster; their assignment to modes is undefined.
impl Tables for DirectionalDerivatives {
    fn tables(&self) -> Vec<Table> {
        let unit = match self.family {
            Family::Undamped => "1/s^2",
            Family::General => "1/s",
        };
        let rows = self.eigenvalues.len();
        let mut table = Table::new("directional derivatives");
        table.texts("modes", vec![Some(listed(&self.modes)); rows]);
        table.numbers(
            "Re derivative",
            unit,
            self.eigenvalues.iter().map(|own| own.re),
        );
        table.numbers(
            "Im derivative",
            unit,
            self.eigenvalues.iter().map(|own| own.im),
        );
        let frequencies = (0..rows).map(|k| self.frequencies.as_ref()?.get(k).copied());
        table.numbers("derivative of frequency", "rad/s", frequencies);
        operating_point(&mut table, &self.description, &self.inputs, None);
        vec![table]
    }
}

/// `1 2 3`
pub(super) fn listed(modes: &[usize]) -> String {
    let modes: Vec<String> = modes.iter().map(|mode| (mode + 1).to_string()).collect();
    modes.join(" ")
}

fn members(own: &SortedSpread) -> impl Iterator<Item = (String, Option<&Statistics>)> {
    let members = own.members.iter().enumerate();
    let members = members.map(|(k, member)| ((k + 1).to_string(), member.value.as_ref()));
    members.chain([("splitting".to_owned(), own.splitting.as_ref())])
}
