//! The printed summary of a run: events, tables by speed, doubtful or failed points, CPU times.

use std::io::{self, Write};

use eigentol::Text;
use eigentol::tolerance::TRUSTED_DISTANCE;

use crate::cost::Cost;
use crate::events::{Event, Events};
use crate::question::percent;
use crate::sweep::{Row, Sweep};
use crate::table::{Table, number};

/// The paper's results for an example.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paper {
    /// Speed at which a natural frequency equals the drive speed, rad/s.
    pub resonance: f64,
    /// Critical speed, rad/s.
    pub critical: f64,
    /// CPU time of Monte Carlo divided by that of the paper's sensitivity method.
    pub ratio: f64,
}

/// Maximum number of rows in a table by speed, to fit a screen.
const ROWS: usize = 14;

/// Prints the speeds of the events.
///
/// # Errors
/// The errors of the writer.
pub fn events(
    out: &mut dyn Write,
    sweep: &Sweep,
    events: &Events,
    paper: Option<&Paper>,
) -> io::Result<()> {
    let level = sweep.question.levels.first().copied().unwrap_or(0.0);
    writeln!(
        out,
        "Events: speed and its standard deviation, rad/s ({} % on {} holds 3 of them)",
        percent(level),
        names(&sweep.variables)
    )?;
    let mut table =
        Table::new(["event                        ", "speed", "sigma", "paper"].map(str::to_owned));
    let mut line = |name: &str, event: &Event, paper: Option<f64>| {
        table.row([
            format!("{name:<29}"),
            number(Some(event.speed), 6),
            number(event.sigma, 6),
            number(paper, 3),
        ]);
    };
    for event in &events.resonances {
        line(
            "frequency meets the speed",
            event,
            paper.map(|paper| paper.resonance),
        );
    }
    line(
        "stiffness vanishes (critical)",
        &events.critical,
        paper.map(|paper| paper.critical),
    );
    writeln!(out, "{table}")
}

/// Prints selected rows of a sweep under its first tolerance; if several variables vary, mode by mode with the
/// contribution of each.
///
/// # Errors
/// The errors of the writer.
pub fn by_speed(out: &mut dyn Write, sweep: &Sweep) -> io::Result<()> {
    let level = sweep.question.levels.first().copied().unwrap_or(0.0);
    writeln!(
        out,
        "By speed, {} % on {}: standard deviation at first order and from {} samples",
        percent(level),
        names(&sweep.variables),
        sweep.samples
    )?;
    if sweep.variables.len() > 1 {
        for mode in 0..sweep.modes {
            writeln!(out, "{}", table(sweep, mode..mode + 1))?;
        }
    } else {
        writeln!(out, "{}", table(sweep, 0..sweep.modes))?;
    }
    // The standard error of a standard deviation of n normal values is sigma / sqrt(2 (n - 1)).
    let error = 100.0 / (2.0 * (sweep.samples.max(2) - 1) as f64).sqrt();
    writeln!(
        out,
        "  omega: natural frequency, rad/s; theta: from the axis, rad; sigma: first order; MC: sampled, good to {error:.1} %\n  \
         (its standard error); distance: to the critical state, in standard deviations of the eigenvalue; unstable:\n  \
         samples without a stable equilibrium.\n  \
         `!`: nearer than {TRUSTED_DISTANCE} standard deviations first order is not to be trusted: use the samples.\n"
    )
}

fn table(sweep: &Sweep, modes: std::ops::Range<usize>) -> Table {
    let angles = sweep.rows.first().map_or(0, |row| row.angles.len());
    let several = sweep.variables.len() > 1;
    let mut head = vec!["speed".to_owned()];
    head.extend((1..=angles).map(|k| format!("theta{k}")));
    for mode in modes.clone() {
        let mode = mode + 1;
        head.extend([format!("omega{mode}"), format!("sigma{mode}")]);
        if several {
            head.extend(sweep.variables.iter().map(|name| format!("by {name}")));
        }
        head.push(format!("MC {mode}"));
    }
    head.extend(["distance", "unstable", " "].map(str::to_owned));
    let mut table = Table::new(head);
    for row in selected(sweep) {
        let mut cells = vec![number(Some(row.speed), 4)];
        cells.extend(row.angles.iter().map(|&angle| number(angle, 4)));
        for mode in modes.clone() {
            cells.push(number(row.frequencies[mode], 4));
            cells.extend(row.spreads.first().into_iter().flat_map(|spread| {
                let variables = 0..if several { sweep.variables.len() } else { 0 };
                let parts = variables.map(|k| spread.contribution(mode, k));
                let first = std::iter::once(spread.first_order[mode].sigma).chain(parts);
                let all = first.chain([spread.sampled[mode].sigma]);
                all.map(|value| number(value, 5)).collect::<Vec<_>>()
            }));
        }
        if let Some(spread) = row.spreads.first() {
            cells.push(number(spread.distance, 1));
            cells.push(number(spread.unstable.map(|count| count as f64), 0));
            cells.push(if spread.trusted { " " } else { "!" }.to_owned());
        }
        table.row(cells);
    }
    table
}

/// Selects rows evenly by index, and hence more densely near the critical speed, like the sweep.
fn selected(sweep: &Sweep) -> impl Iterator<Item = &Row> {
    let last = sweep.rows.len().saturating_sub(1);
    let count = ROWS.min(sweep.rows.len());
    (0..count).filter_map(move |k| sweep.rows.get(k * last / (count.max(2) - 1)))
}

/// Prints where first order cannot be trusted and which points failed.
///
/// Also printed: how many samples are unstable, and how well the paper's central differences agree.
///
/// # Errors
/// The errors of the writer.
pub fn checks(out: &mut dyn Write, sweep: &Sweep) -> io::Result<()> {
    writeln!(out, "Checks")?;
    let drawn = sweep.samples * sweep.rows.len();
    for (k, &level) in sweep.question.levels.iter().enumerate() {
        let doubtful: Vec<&Row> = sweep
            .rows
            .iter()
            .filter(|row| !row.spreads[k].trusted)
            .collect();
        let unstable: usize = sweep
            .rows
            .iter()
            .filter_map(|row| row.spreads[k].unstable)
            .sum();
        write!(
            out,
            "  {} %: {unstable} of {drawn} samples unstable; ",
            percent(level)
        )?;
        match (doubtful.first(), doubtful.last()) {
            (Some(first), Some(last)) => writeln!(
                out,
                "first order not to be trusted at {} speeds, {:.4} to {:.4} rad/s",
                doubtful.len(),
                first.speed,
                last.speed
            )?,
            _ => writeln!(out, "first order to be trusted at every speed")?,
        }
    }
    if let Some(difference) = worst_difference(sweep) {
        writeln!(
            out,
            "  Central differences, the paper's way, give the trusted sigmas to {difference:.1e} relative."
        )?;
    }
    let failed: Vec<&Row> = sweep
        .rows
        .iter()
        .filter(|row| !row.troubles.is_empty())
        .collect();
    if failed.is_empty() {
        writeln!(out, "  All {} speeds were solved.", sweep.rows.len())?;
    } else {
        writeln!(
            out,
            "  {} of {} speeds failed:",
            failed.len(),
            sweep.rows.len()
        )?;
    }
    for row in failed {
        writeln!(
            out,
            "    {:.6} rad/s: {}",
            row.speed,
            row.troubles.join("; ")
        )?;
    }
    writeln!(out)
}

/// Largest relative difference between the two first-order results under the first tolerance, where they are trusted.
fn worst_difference(sweep: &Sweep) -> Option<f64> {
    let spreads = sweep.rows.iter().filter_map(|row| row.spreads.first());
    spreads
        .filter(|spread| spread.trusted)
        .flat_map(|spread| spread.first_order.iter().zip(&spread.differences))
        .filter_map(|(exact, differences)| Some((differences.sigma? / exact.sigma? - 1.0).abs()))
        .filter(|difference| difference.is_finite())
        .reduce(f64::max)
}

/// Prints the comparison of CPU times (tables 1 and 2 of the paper).
///
/// # Errors
/// The errors of the writer.
pub fn costs(
    out: &mut dyn Write,
    speeds: usize,
    costs: &[Cost],
    paper: Option<&Paper>,
) -> io::Result<()> {
    let Some(cost) = costs.first() else {
        return Ok(());
    };
    writeln!(out, "CPU time over all {speeds} speeds, ms")?;
    let mut table = Table::new(
        [
            "tolerance",
            "first order",
            "Monte Carlo",
            "ratio",
            "paper's ratio",
        ]
        .map(str::to_owned),
    );
    for cost in costs {
        table.row([
            format!("{} %", percent(cost.level)),
            format!("{:.4}", 1e3 * cost.first_order.as_secs_f64()),
            format!("{:.2}", 1e3 * cost.monte_carlo.as_secs_f64()),
            format!("{:.0}", cost.ratio()),
            number(paper.map(|paper| paper.ratio), 0),
        ]);
    }
    write!(out, "{table}")?;
    writeln!(
        out,
        "  CPU time of one thread, timed apart from the results above. First order: equilibrium from the start value, modes,\n  \
         sensitivities, spread; mean of {} passes. Monte Carlo: equilibrium from the start value, modes, then {} samples,\n  \
         each with its own equilibrium (from the nominal one) and modes; one pass.\n",
        cost.passes, cost.samples
    )
}

fn names(variables: &[Text]) -> String {
    let names: Vec<&str> = variables.iter().map(|name| &**name).collect();
    names.join(", ")
}
