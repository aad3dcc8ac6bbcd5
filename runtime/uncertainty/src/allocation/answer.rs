use eigentol_results::numbers::{converted, given, heading, number, rough, short};
use eigentol_results::{Answer, Columns, Findings, Table, at_point, displayed};

use crate::allocation::Allocation;
use crate::judge::chance;

/// `allocation`: a row for each design variable, numbers in its `unit`; `requirements`: a row for each requirement;
/// `cost`: one row.
impl Answer for Allocation {
    const KIND: &'static str = "allocation";

    at_point!();

    fn findings(&self) -> Findings {
        let mut said =
            self.titled(format_args!("allocation, cost {} instead of {}", rough(self.cost), rough(self.cost_before)));
        self.variables(&mut said);
        self.requirements(&mut said);
        let mut cost = Table::new("cost");
        cost.numbers("cost", "", [self.cost]);
        cost.numbers("cost before", "", [self.cost_before]);
        said.data(cost);
        if self.stopped {
            said.note("Stopped: there may be cheaper tolerances.");
        }
        let planned = self.chances.planned;
        if self.chances.all.samples() < planned {
            said.note(format!("Not complete: {planned} samples were asked for."));
        }
        said
    }
}

displayed!(Allocation);

impl Allocation {
    fn variables(&self, said: &mut Findings) {
        let values = self.nominal.iter().zip(&self.half_widths);
        let rows: Vec<_> = self.description.design.iter().zip(values).collect();
        let mut table = Columns::new("allocation", &rows);
        table.cells("variable", &|(info, _)| heading(&info.name, &info.unit));
        table.words("variable", &|(info, _)| Some(info.name.to_string()));
        table.words("unit", &|(info, _)| Some(info.unit.symbol.to_string()));
        let nominal = table.number("nominal value", "", &|(info, (nominal, _))| Some(converted(**nominal, &info.unit)));
        nominal.digits(number);
        let half_width =
            table.number("half-width", "", &|(info, (_, half_width))| Some(converted(**half_width, &info.unit)));
        half_width.digits(rough);
        said.columns(table);
    }

    fn requirements(&self, said: &mut Findings) {
        let rows: Vec<_> = self.failure.iter().enumerate().collect();
        let sampled = |k: usize| Some(self.chances.each.get(k)?.failure());
        let mut table = Columns::new("requirements", &rows);
        table.whole("requirement", &|(k, _)| Some(k + 1)).shown();
        table.number("allowed to fail", "", &|(_, allowed)| Some(**allowed)).digits(given);
        table.number("beta", "", &|(k, _)| self.reliability.beta_of(*k)).digits(short);
        let column = table.number("probability of failure, sampled", "", &|(k, _)| sampled(*k));
        column.digits(|value| chance(value, 0.0)).headed("P(failed), sampled");
        table.flag("refuted", &|(k, _)| Some(self.refuted.contains(k))).shown().headed("samples refute it");
        said.columns(table);
    }
}
