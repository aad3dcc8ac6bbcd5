//! A rotor's results as tables, in rpm, Hz and percent.

use std::io::{self, Write};

use eigentol::tolerance::Tolerances;
use eigentol::{Campbell, Description};

use super::risk::{Chance, Risk};
use super::{HZ, RPM, RotorEvent, RotorQuestion, letter};
use crate::table::{Table, number};

/// Maximum number of rows in the table of a diagram, to fit a screen.
const ROWS: usize = 13;

/// Prints a selection of the points of a Campbell diagram.
///
/// # Errors
/// The errors of the writer.
pub fn diagram(out: &mut dyn Write, campbell: &Campbell) -> io::Result<()> {
    writeln!(
        out,
        "Campbell diagram: frequency [Hz] with its whirl (F forward, B backward, P planar) and standard deviation,\n\
         damping ratio [%]"
    )?;
    let labels = campbell.labels();
    let mut head = vec!["rpm".to_owned()];
    for label in &labels {
        head.extend([
            format!("mode {}", label + 1),
            "sigma".into(),
            "damp.".into(),
        ]);
    }
    let mut table = Table::new(head);
    for point in selected(&campbell.points) {
        let mut row = vec![number(Some(point.value / RPM), 0)];
        let modes = point.modes.as_deref().unwrap_or_default();
        for &label in &labels {
            let mode = modes.iter().find(|mode| mode.label == label);
            let frequency = mode.and_then(|mode| mode.behaviour.frequency());
            let sigma = mode
                .and_then(|mode| mode.frequency.as_ref())
                .map(|own| own.sigma / HZ);
            let damping = mode.and_then(|mode| mode.damping_ratio.as_ref());
            let whirl = letter(mode.and_then(|mode| mode.whirl));
            row.push(format!("{} {whirl}", hertz(frequency)));
            row.push(number(sigma, 2));
            row.push(number(damping.map(|own| 100.0 * own.mean), 2));
        }
        table.row(row);
    }
    writeln!(out, "{table}")?;
    let troubles = campbell.points.iter().filter_map(|point| {
        let error = point.modes.as_ref().err()?;
        Some((point.value, error))
    });
    for (value, error) in troubles {
        writeln!(out, "  {:.0} rpm: {error}", value / RPM)?;
    }
    Ok(())
}

/// Prints the events and the effect of every tolerance on them.
///
/// # Errors
/// The errors of the writer.
pub fn events(
    out: &mut dyn Write,
    events: &[RotorEvent],
    tolerances: &Tolerances,
    description: &Description,
) -> io::Result<()> {
    writeln!(out, "Critical speeds and limit of stability")?;
    let head = [
        "",
        "event                     ",
        "rpm",
        "sigma",
        "Hz",
        "whirl",
    ];
    let mut table = Table::new(head.map(str::to_owned));
    for (event, name) in events.iter().zip('a'..) {
        table.row([
            format!("({name})"),
            format!("{:<26}", event.name()),
            number(Some(event.speed / RPM), 1),
            number(event.sigma().map(|sigma| sigma / RPM), 1),
            hertz(Some(event.s.im)),
            letter(event.whirl).to_owned(),
        ]);
    }
    write!(out, "{table}")?;
    for (event, name) in events.iter().zip('a'..) {
        if let Err(error) = &event.spread {
            writeln!(out, "  ({name}) {error}")?;
        }
    }
    writeln!(
        out,
        "\nHow these speeds move, in rpm, when one variable rises from its nominal value to its upper limit"
    )?;
    let mut head = vec!["variable         ".to_owned(), "half-width".to_owned()];
    head.extend(
        events
            .iter()
            .zip('a'..)
            .map(|(_, name)| format!("({name})")),
    );
    let mut table = Table::new(head);
    let half_widths = tolerances.half_widths();
    for (j, info) in description.design.iter().enumerate() {
        let half_width = half_widths[j] / info.unit.scale;
        let mut row = vec![
            format!("{:<17}", info.name),
            format!("{} {:<5}", significant(half_width), info.unit.symbol),
        ];
        for event in events {
            let slopes = event.spread.as_ref().ok().map(|spread| &spread.by_design);
            row.push(number(
                slopes.map(|slopes| slopes[j] * half_widths[j] / RPM),
                1,
            ));
        }
        table.row(row);
    }
    writeln!(out, "{table}")
}

/// Prints the effect of the tolerances at the running speed.
///
/// # Errors
/// The errors of the writer.
pub fn risk(out: &mut dyn Write, risk: &Risk, question: &RotorQuestion) -> io::Result<()> {
    let samples = risk.unstable.samples;
    writeln!(
        out,
        "At the running speed, {:.0} rpm = {:.1} Hz: spread at first and second order and from {samples} samples",
        question.running / RPM,
        question.running / HZ
    )?;
    let head = [
        "quantity        ",
        "nominal",
        "mean shift 2nd",
        "MC",
        "std. error",
        "sigma 1st",
        "2nd",
        "MC",
    ];
    let mut table = Table::new(head.map(str::to_owned));
    for (mode, place) in risk.modes.iter().zip(1..) {
        let whirl = letter(mode.whirl);
        let lines = [
            (
                format!("mode {place} {whirl}, Hz"),
                mode.frequency.as_ref(),
                mode.sampled_frequency,
                1.0 / HZ,
            ),
            (
                "  damping, %".to_owned(),
                mode.damping_ratio.as_ref(),
                mode.sampled_damping_ratio,
                100.0,
            ),
        ];
        for (name, model, sampled, unit) in lines {
            let moments = model.map(|model| &model.moments);
            let nominal = model.map(|model| model.model.value);
            let shown = |value: Option<f64>| number(value.map(|value| unit * value), 4);
            let shift = sampled
                .mean()
                .zip(nominal)
                .map(|(mean, nominal)| mean - nominal);
            table.row([
                format!("{name:<16}"),
                shown(nominal),
                shown(moments.map(|moments| moments.mean_shift)),
                shown(shift),
                shown(sampled.sigma().map(|sigma| sigma / (samples as f64).sqrt())),
                shown(moments.map(|moments| moments.first_order_sigma)),
                shown(moments.map(|moments| moments.sigma)),
                shown(sampled.sigma()),
            ]);
        }
    }
    writeln!(out, "{table}")?;
    chances(out, risk, question)
}

fn chances(out: &mut dyn Write, risk: &Risk, question: &RotorQuestion) -> io::Result<()> {
    let (low, high) = question.band();
    writeln!(
        out,
        "Probability, in percent, that a frequency lies within {:.0} % of the running speed ({} to {} Hz), and that the\n\
         rotor is unstable there",
        100.0 * question.margin,
        hertz(Some(low)),
        hertz(Some(high))
    )?;
    let head = [
        "                ",
        "first order",
        "second order",
        "Monte Carlo",
        "std. error",
    ];
    let mut table = Table::new(head.map(str::to_owned));
    let mut line = |name: String, chance: &Chance| {
        let percent = |value: Option<f64>| number(value.map(|value| 100.0 * value), 3);
        let (share, error) = chance.sampled();
        table.row([
            format!("{name:<16}"),
            percent(chance.first_order),
            percent(chance.second_order),
            percent(Some(share)),
            percent(Some(error)),
        ]);
    };
    for (mode, place) in risk.modes.iter().zip(1..) {
        line(format!("mode {place} in band"), &mode.in_band);
    }
    line("unstable".to_owned(), &risk.unstable);
    writeln!(out, "{table}")
}

fn hertz(frequency: Option<f64>) -> String {
    number(frequency.map(|frequency| frequency / HZ), 2)
}

/// Formats a value with three significant digits.
fn significant(value: f64) -> String {
    let before = value.abs().log10().floor() as i32;
    number(Some(value), (2 - before).clamp(0, 9) as usize)
}

/// Selects the first and last items and evenly spaced ones between them.
fn selected<T>(all: &[T]) -> impl Iterator<Item = &T> {
    let rows = ROWS.min(all.len());
    let place = move |row: usize| row * (all.len() - 1) / (rows - 1).max(1);
    (0..rows).filter_map(move |row| all.get(place(row)))
}
