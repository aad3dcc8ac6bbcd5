use eigentol::allocation::Allocation;

use super::Tables;
use super::names::{by, in_unit, operating_point};
use crate::Table;

/// `allocation`: a row for each design variable, numbers in its `unit`; `requirements`: a row for each requirement;
/// `cost`: one row.
impl Tables for Allocation {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let design = d.design.iter();
        let mut variables = Table::new("allocation");
        variables.texts(
            "variable",
            design.clone().map(|info| Some(info.name.to_string())),
        );
        variables.texts("unit", design.clone().map(|info| by(&info.unit)));
        let nominal = design.clone().zip(&self.nominal);
        let nominal = nominal.map(|(info, &value)| in_unit(value, &info.unit));
        variables.numbers("nominal value", "", nominal);
        let half_widths = design.zip(&self.half_widths);
        let half_widths = half_widths.map(|(info, &value)| in_unit(value, &info.unit));
        variables.numbers("half-width", "", half_widths);
        operating_point(&mut variables, d, &self.inputs, None);
        let each = 0..self.failure.len();
        let mut requirements = Table::new("requirements");
        requirements.whole("requirement", each.clone().map(|k| k + 1));
        requirements.numbers("allowed to fail", "", self.failure.iter().copied());
        let beta = each.clone().map(|k| self.reliability.beta_of(k));
        requirements.numbers("beta", "", beta);
        let sampled = each
            .clone()
            .map(|k| Some(self.chances.each.get(k)?.failure()));
        requirements.numbers("probability of failure, sampled", "", sampled);
        requirements.flags("refuted", each.map(|k| self.refuted.contains(&k)));
        operating_point(&mut requirements, d, &self.inputs, None);
        let mut cost = Table::new("cost");
        cost.numbers("cost", "", [self.cost]);
        cost.numbers("cost before", "", [self.cost_before]);
        operating_point(&mut cost, d, &self.inputs, None);
        vec![variables, requirements, cost]
    }
}
