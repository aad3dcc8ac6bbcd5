//! Tables of samples, whole or in parts.

use eigentol_results::{Columns, Table};

use crate::mechanism::Description;
use crate::tolerance::{MonteCarlo, Sample};

/// A row for each sample: its number in the run, its outcome, the design variables, the unknowns, and the frequency,
/// damping ratio and eigenvalue of each mode.
///
/// `first` is the number of the first sample, counted from 0, so that parts of a run can be written one after the
/// other: all non-empty parts have the same columns.
#[must_use]
pub fn samples_table(d: &Description, first: usize, samples: &[Sample]) -> Table {
    let rows: Vec<_> = samples.iter().enumerate().map(|(k, sample)| (first + k, sample)).collect();
    // A sample has a slot for each nominal mode, even where the mode was not found.
    samples_columns(d, samples.iter().map(|sample| sample.frequencies.len()).max().unwrap_or(0), &rows).finish().0
}

/// Like [`samples_table`], for samples that carry their own numbers, counted from 0, as returned by
/// [`PartialMonteCarlo::take_samples`](crate::tolerance::PartialMonteCarlo::take_samples).
///
/// A part without samples has the same columns. Seed, stream and operating point come last, as in all tables of the run.
#[must_use]
pub fn numbered_samples_table(run: &MonteCarlo, samples: &[(u64, Sample)]) -> Table {
    let rows: Vec<_> = samples.iter().map(|(number, sample)| (*number as usize, sample)).collect();
    let mut table = samples_columns(&run.description, run.modes.len(), &rows);
    origin(&mut table, run);
    let mut table = table.finish().0;
    table.operating_point(&run.description, &run.inputs, None);
    table
}

/// Seed and stream of the random numbers, if below 2^63.
pub(super) fn origin<R>(table: &mut Columns<'_, R>, run: &MonteCarlo) {
    for (name, value) in [("seed", run.seed), ("stream", run.stream)] {
        table.whole(name, &|_| usize::try_from(value).ok());
    }
}

pub(super) fn samples_columns<'a>(
    d: &Description,
    modes: usize,
    rows: &'a [(usize, &'a Sample)],
) -> Columns<'a, (usize, &'a Sample)> {
    let mut table = Columns::new("samples", rows);
    table.whole("sample", &|(number, _)| Some(number + 1));
    table.words("outcome", &|(_, x)| Some(x.outcome.word().to_owned()));
    table.design(d, &|(_, x)| Some(&x.design[..]));
    table.unknowns(d, &|(_, x)| x.coordinates.as_deref());
    for r in 0..modes {
        let number = r + 1;
        table.number(&format!("frequency {number}"), "rad/s", &|(_, x)| *x.frequencies.get(r)?);
        table.number(&format!("damping ratio {number}"), "", &|(_, item)| *item.damping_ratios.get(r)?);
        let s = move |sample: &Sample| *sample.eigenvalues.get(r)?;
        table.number(&format!("Re s {number}"), "1/s", &|(_, x)| Some(s(x)?.re));
        table.number(&format!("Im s {number}"), "1/s", &|(_, x)| Some(s(x)?.im));
    }
    table
}
