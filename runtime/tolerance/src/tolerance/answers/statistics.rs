//! Columns and counts that all samples have.

use core::fmt;

use eigentol_results::{Columns, Table};

use crate::tolerance::{Counts, Outcome, Statistics};

/// Columns of data about the samples of one quantity.
pub fn statistics<R>(table: &mut Columns<'_, R>, name: &str, unit: &str, of: &dyn Fn(&R) -> Option<&Statistics>) {
    type Pick = fn(&Statistics) -> Option<f64>;
    table.whole(&format!("samples of {name}"), &|row| Some(of(row).map_or(0, |x| x.count as usize)));
    let picks: [(&str, &str, Pick); 6] = [
        ("mean", unit, |x| Some(x.mean)),
        ("standard error", unit, |x| x.standard_error),
        ("sigma", unit, |x| x.sigma),
        ("skewness", "", |x| x.skewness),
        ("least", unit, |x| Some(x.min)),
        ("greatest", unit, |x| Some(x.max)),
    ];
    for (what, unit, pick) in picks {
        table.number(&format!("{what} of {name}"), unit, &|row| pick(of(row)?));
    }
}

/// Every outcome in words, with its number of samples.
pub(super) fn outcome_rows(counts: &Counts) -> [(&'static str, usize); 8] {
    Outcome::ALL.map(|outcome| (outcome.word(), counts.of(outcome)))
}

/// A row for each outcome.
pub fn outcomes(counts: &Counts) -> Table {
    let mut table = Table::new("outcomes");
    let rows = outcome_rows(counts);
    table.texts("outcome", rows.map(|(word, _)| Some(word.to_owned())));
    table.whole("samples", rows.map(|(_, count)| count));
    table
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} stable", self.stable)?;
        for outcome in Outcome::ALL.into_iter().skip(1) {
            let words = match outcome {
                Outcome::Flutter => "in flutter",
                Outcome::Undecided => "of undecided stability",
                Outcome::NoEquilibrium => "without equilibrium",
                Outcome::NoModes => "without modes",
                same => same.word(),
            };
            match self.of(outcome) {
                0 => {}
                number => write!(f, ", {number} {words}")?,
            }
        }
        Ok(())
    }
}
