//! A figure of the frequencies near the running speed.

use eigentol::Campbell;
use eigentol_figures::figure::{Colour, ErrorBar, Shape};
use eigentol_figures::{Error, Figure, Style, campbell};

use super::{HZ, RPM, Risk, RotorQuestion};

/// Frequencies near the running speed with their bands, the forbidden band with the probability of each mode lying in
/// it, and the samples.
///
/// # Errors
/// [`Error::Nothing`] if no mode oscillates.
pub fn margin(
    question: &RotorQuestion,
    close: &Campbell,
    risk: &Risk,
    style: Style,
) -> Result<Figure, Error> {
    let running = question.running / HZ;
    let style = style.lowest(0.6 * running).highest(1.3 * running);
    let mut figure = campbell(close, &style.true_width())?;
    let Some(panel) = figure.panels.first_mut() else {
        return Ok(figure);
    };
    let edges = panel.x.range.map(|rpm| {
        let speed = rpm * RPM / HZ;
        let half = question.margin * speed;
        [rpm, speed - half, speed + half]
    });
    let label = format!("within {} % of the speed", 100.0 * question.margin);
    panel.band(label, Colour::Grey, edges);
    let (at, level) = (question.running / RPM, close.sigma_level);
    let sampled = risk.modes.iter().filter_map(|mode| {
        let own = &mode.sampled_frequency;
        let (mean, sigma) = (own.mean()? / HZ, own.sigma()? / HZ);
        Some(ErrorBar::upright([at, mean], level * sigma))
    });
    let label = format!("Monte Carlo: mean, {level} sigma");
    panel.error_bars(label, Colour::Black, Shape::Ring, sampled);
    for mode in &risk.modes {
        let chance = mode.in_band.second_order.filter(|own| *own > 1e-6);
        if let (Some(chance), Some(mean)) = (chance, mode.sampled_frequency.mean()) {
            let text = format!("{:.3} % in the band", 100.0 * chance);
            panel.label([at, mean / HZ], text);
        }
    }
    Ok(figure)
}
