use eigentol::Quantity;
use eigentol::summary::{Advice, Summary};

use super::Tables;
use super::names::{operating_point, word};
use crate::Table;

/// `summary`: a row for each mode, with the sigmas of all methods and the recommended method; `doubts`: a row for each
/// reason not to trust first order; `clusters`, if any.
impl Tables for Summary {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let modes = || self.first.modes.iter().zip(&self.trust).enumerate();
        let alone = |r: usize| self.cluster_of(r).is_none();
        let mut table = Table::new("summary");
        table.whole("mode", 1..=self.trust.len());
        table.numbers(
            "frequency",
            "rad/s",
            modes().map(|(_, (own, _))| own.behaviour.frequency()),
        );
        let first = modes().map(|(r, (own, _))| Some(own.frequency().filter(|_| alone(r))?.sigma));
        table.numbers("sigma, first order", "rad/s", first);
        let second = modes().map(|(r, _)| {
            let mode = self.second.modes.get(r).filter(|_| alone(r))?;
            Some(mode.as_ref().ok()?.frequency.moments.sigma)
        });
        table.numbers("sigma, second order", "rad/s", second);
        let checks = || modes().map(|(_, (_, trust))| trust.check(Quantity::Frequency));
        table.numbers(
            "sigma, sampled",
            "rad/s",
            checks().map(|own| Some(own?.sigma.value)),
        );
        let error = checks().map(|own| Some(own?.sigma.standard_error));
        table.numbers("standard error of sampled sigma", "rad/s", error);
        table.whole("samples", checks().map(|own| Some(own?.count)));
        let band = modes().map(|(r, (own, _))| Some(own.frequency().filter(|_| alone(r))?.band));
        table.numbers("band", "rad/s", band);
        table.flags("trusted", modes().map(|(_, (_, trust))| trust.trusted()));
        let advice = modes().map(|(_, (_, trust))| {
            word(match trust.advice {
                Advice::FirstOrder => "first order",
                Advice::SecondOrder => "second order",
                Advice::Cluster => "cluster",
                _ => "samples",
            })
        });
        table.texts("use", advice);
        operating_point(&mut table, d, &self.inputs, None);
        let doubts = || {
            let each = self.trust.iter();
            each.flat_map(|own| own.doubts.iter().map(move |doubt| (own.mode, doubt)))
        };
        let mut reasons = Table::new("doubts");
        reasons.whole("mode", doubts().map(|(mode, _)| mode + 1));
        reasons.texts("doubt", doubts().map(|(_, doubt)| Some(doubt.to_string())));
        operating_point(&mut reasons, d, &self.inputs, None);
        let mut tables = vec![table, reasons];
        tables.extend(self.clusters[..].tables());
        tables
    }
}
