//! What a run prints: events, a table by speed, what failed, CPU times.

use std::io::{self, Write};

use eigentol::tolerance::TRUSTED_DISTANCE;

use crate::cost::Cost;
use crate::events::{Event, Events};
use crate::question::percent;
use crate::sweep::{Row, Sweep};
use crate::table::{Table, number};

/// What the paper says about an example.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paper {
    /// Speed at which frequency and drive speed meet, rad/s.
    pub resonance: f64,
    /// Critical speed, rad/s.
    pub critical: f64,
    /// CPU time of Monte Carlo divided by that of its sensitivity method.
    pub ratio: f64,
}

/// Rows of the table by speed: more would not fit a screen.
const ROWS: usize = 14;

/// Prints the speeds at which something happens.
///
/// # Errors
/// Those of the writer.
pub fn events(
    out: &mut dyn Write,
    sweep: &Sweep,
    events: &Events,
    paper: Option<&Paper>,
) -> io::Result<()> {
    let level = sweep.question.levels.first().copied().unwrap_or(0.0);
    let variables = sweep.variables.join(", ");
    let percent = percent(level);
    writeln!(
        out,
        "Events (tolerance {percent} % on {variables} = 3 standard deviations)"
    )?;
    let mut table = Table::new(["event", "speed [rad/s]", "sigma", "paper"].map(str::to_owned));
    let mut line = |name: &str, event: &Event, paper: Option<f64>| {
        table.row([
            name.to_owned(),
            format!("{:.6}", event.speed),
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
        "critical: stiffness vanishes",
        &events.critical,
        paper.map(|paper| paper.critical),
    );
    writeln!(out, "{table}")
}

/// Prints a selection of the rows of a sweep, mode by mode, under its first tolerance.
///
/// # Errors
/// Those of the writer.
pub fn by_speed(out: &mut dyn Write, sweep: &Sweep) -> io::Result<()> {
    let level = sweep.question.levels.first().copied().unwrap_or(0.0);
    writeln!(
        out,
        "By speed, tolerance {} % on {}: standard deviation of the frequency by first order and by {} samples",
        percent(level),
        sweep.variables.join(", "),
        sweep.samples
    )?;
    let angles = sweep.rows.first().map_or(0, |row| row.angles.len());
    let mut head = vec!["speed".to_owned()];
    head.extend((1..=angles).map(|k| format!("theta{k}")));
    for mode in 1..=sweep.modes {
        head.push(format!("omega{mode}"));
        head.push(format!("sigma{mode}"));
        head.extend(
            sweep
                .variables
                .iter()
                .filter(|_| sweep.variables.len() > 1)
                .map(|name| format!("of {name}")),
        );
        head.push("sampled".to_owned());
    }
    head.extend([
        "to critical".to_owned(),
        "unstable".to_owned(),
        String::new(),
    ]);
    let mut table = Table::new(head);
    for row in selected(sweep) {
        table.row(cells(sweep, row));
    }
    write!(out, "{table}")?;
    writeln!(
        out,
        "  speed, omega, sigma in rad/s, theta in rad from the axis; `to critical` in standard deviations of lambda;\n  \
         `!`: nearer than {TRUSTED_DISTANCE} of them first order is not to be trusted: believe the samples.\n"
    )
}

fn cells(sweep: &Sweep, row: &Row) -> Vec<String> {
    let mut cells = vec![format!("{:.4}", row.speed)];
    cells.extend(row.angles.iter().map(|&angle| number(angle, 4)));
    let Some(spread) = row.spreads.first() else {
        return cells;
    };
    for mode in 0..sweep.modes {
        cells.push(number(row.frequencies[mode], 4));
        cells.push(number(spread.first_order[mode].sigma, 5));
        if sweep.variables.len() > 1 {
            let variables = 0..sweep.variables.len();
            cells.extend(variables.map(|k| number(spread.contribution(mode, k), 5)));
        }
        cells.push(number(spread.sampled[mode].sigma, 5));
    }
    cells.push(number(spread.distance, 1));
    cells.push(
        spread
            .unstable
            .map_or_else(String::new, |count| count.to_string()),
    );
    cells.push(if spread.trusted { " " } else { "!" }.to_owned());
    cells
}

/// Evenly chosen rows; the sweep is denser near the critical speed, and so is the choice.
fn selected(sweep: &Sweep) -> impl Iterator<Item = &Row> {
    let last = sweep.rows.len().saturating_sub(1);
    let count = ROWS.min(sweep.rows.len());
    (0..count).filter_map(move |k| sweep.rows.get(k * last / (count.max(2) - 1)))
}

/// Prints where first order is not to be trusted, samples that are not stable, and points that failed.
///
/// # Errors
/// Those of the writer.
pub fn warnings(out: &mut dyn Write, sweep: &Sweep) -> io::Result<()> {
    for (k, &level) in sweep.question.levels.iter().enumerate() {
        let level = percent(level);
        let doubtful: Vec<f64> = sweep
            .rows
            .iter()
            .filter(|row| !row.spreads[k].trusted)
            .map(|row| row.speed)
            .collect();
        if let (Some(first), Some(last)) = (doubtful.first(), doubtful.last()) {
            writeln!(
                out,
                "At {level} %: first order is not to be trusted at {} speeds from {first:.4} to {last:.4} rad/s.",
                doubtful.len()
            )?;
        }
        let unstable: usize = sweep
            .rows
            .iter()
            .filter_map(|row| row.spreads[k].unstable)
            .sum();
        let drawn = sweep.samples * sweep.rows.len();
        writeln!(
            out,
            "At {level} %: {unstable} of {drawn} samples have no stable equilibrium."
        )?;
    }
    let failed: Vec<&Row> = sweep
        .rows
        .iter()
        .filter(|row| !row.troubles.is_empty())
        .collect();
    if failed.is_empty() {
        writeln!(out, "All {} speeds were solved.\n", sweep.rows.len())?;
        return Ok(());
    }
    writeln!(
        out,
        "{} of {} speeds failed:",
        failed.len(),
        sweep.rows.len()
    )?;
    for row in failed {
        writeln!(out, "  {:.6} rad/s: {}", row.speed, row.troubles.join("; "))?;
    }
    writeln!(out)
}

/// Prints the comparison of CPU times (tables 1 and 2 of the paper).
///
/// # Errors
/// Those of the writer.
pub fn costs(
    out: &mut dyn Write,
    speeds: usize,
    costs: &[Cost],
    paper: Option<&Paper>,
) -> io::Result<()> {
    writeln!(out, "CPU time over all {speeds} speeds")?;
    let mut table = Table::new(
        [
            "tolerance",
            "analytic [ms]",
            "Monte Carlo [ms]",
            "ratio",
            "paper",
        ]
        .map(str::to_owned),
    );
    for cost in costs {
        table.row([
            format!("{} %", percent(cost.level)),
            format!("{:.4}", 1e3 * cost.analytic.as_secs_f64()),
            format!("{:.2}", 1e3 * cost.monte_carlo.as_secs_f64()),
            format!("{:.0}", cost.ratio()),
            number(paper.map(|paper| paper.ratio), 0),
        ]);
    }
    write!(out, "{table}")?;
    let Some(cost) = costs.first() else {
        return Ok(());
    };
    writeln!(
        out,
        "  Measured: CPU time of one thread, in a run of its own apart from the results above. Analytic: equilibrium,\n  \
         modes, sensitivities and first-order spread at every speed, mean of {} passes. Monte Carlo: equilibrium, modes\n  \
         and {} samples at every speed, each sample with its own equilibrium and modes, one pass.\n",
        cost.passes, cost.samples
    )
}
