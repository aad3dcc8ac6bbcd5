use eigentol::tolerance::{Outcome, Sample};
use eigentol::{Complex, Description, MonteCarlo};

use super::names::{design, operating_point, unknowns, word};
use crate::Table;

/// A row for each sample: its number in the run, its outcome, the design variables, the unknowns, and the frequency,
/// damping ratio and eigenvalue of each mode.
///
/// `first` is the number of the first sample, counted from 0, so that parts of a run can be written one after the
/// other: all non-empty parts have the same columns.
///
/// ```
/// # use eigentol::{Study, mechanism};
/// # mechanism! {
/// #     mechanism Pendulum {
/// #         design l = 2 m +/- 1 %;
/// #         gravity 9.81 m/s^2 along -z;
/// #         body bar: rod(mass: 3 kg, length: l, along: -z);
/// #         joint theta: revolute(y) from ground to bar;
/// #     }
/// # }
/// use eigentol_tables::samples_table;
///
/// let study = Study::new(Pendulum).samples(5).keep_samples(true);
/// let run = study.monte_carlo()?;
/// let samples = run.all.expect("samples were kept");
/// let table = samples_table(&run.description, 0, &samples);
/// assert_eq!(table.rows(), 5);
/// assert_eq!(table.column("l").expect("a design variable").unit, "m");
/// # Ok::<(), eigentol::Error>(())
/// ```
#[must_use]
pub fn samples_table(d: &Description, first: usize, samples: &[Sample]) -> Table {
    // A sample has a slot for each nominal mode, even where the mode was not found.
    let modes = samples.iter().map(|own| own.frequencies.len()).max();
    let numbers = (first + 1..).take(samples.len());
    rows(d, modes.unwrap_or(0), numbers, samples.iter())
}

/// Like [`samples_table`], for samples that carry their own numbers, counted from 0, as returned by
/// [`PartialMonteCarlo::take_samples`](eigentol::tolerance::PartialMonteCarlo::take_samples).
///
/// A part without samples has the same columns. The operating point, seed and stream come last, as in all tables of the
/// run.
#[must_use]
pub fn numbered_samples_table(run: &MonteCarlo, samples: &[(u64, Sample)]) -> Table {
    let numbers = samples.iter().map(|(number, _)| *number as usize + 1);
    let all = samples.iter().map(|(_, sample)| sample);
    let mut table = rows(&run.description, run.modes.len(), numbers, all);
    origin(&mut table, run);
    table
}

/// Adds the operating point and the origin of the random numbers.
pub(super) fn origin(table: &mut Table, run: &MonteCarlo) {
    operating_point(table, &run.description, &run.inputs, None);
    let rows = table.rows();
    for (name, value) in [("seed", run.seed), ("stream", run.stream)] {
        table.whole(name, vec![usize::try_from(value).ok(); rows]);
    }
}

fn rows<'a>(
    d: &Description,
    modes: usize,
    numbers: impl Iterator<Item = usize>,
    all: impl Iterator<Item = &'a Sample> + Clone,
) -> Table {
    let mut table = Table::new("samples");
    table.whole("sample", numbers);
    table.texts("outcome", all.clone().map(|sample| outcome(sample.outcome)));
    design(&mut table, d, all.clone().map(|sample| &sample.design[..]));
    unknowns(
        &mut table,
        d,
        all.clone().map(|sample| sample.coordinates.as_deref()),
    );
    for r in 0..modes {
        let frequency = all.clone().map(|own| *own.frequencies.get(r)?);
        table.numbers(format!("frequency {}", r + 1), "rad/s", frequency);
        let damping = all.clone().map(|own| *own.damping_ratios.get(r)?);
        table.numbers(format!("damping ratio {}", r + 1), "", damping);
        let part = |of: fn(Complex) -> f64| {
            let own = move |own: &Sample| own.eigenvalues.get(r)?.map(of);
            all.clone().map(own)
        };
        table.numbers(format!("Re s {}", r + 1), "1/s", part(|s| s.re));
        table.numbers(format!("Im s {}", r + 1), "1/s", part(|s| s.im));
    }
    table
}

pub(super) fn outcome(outcome: Outcome) -> Option<String> {
    word(match outcome {
        Outcome::Stable => "stable",
        Outcome::Divergent => "divergent",
        Outcome::Flutter => "flutter",
        Outcome::Undecided => "undecided",
        Outcome::NoEquilibrium => "no equilibrium",
        Outcome::NotAssembled => "not assembled",
        Outcome::Unphysical => "unphysical",
        Outcome::NoModes => "no modes",
    })
}
