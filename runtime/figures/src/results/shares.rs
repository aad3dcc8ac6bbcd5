//! Sources of the variance of a mode.

use eigentol::FirstOrder;
use eigentol::tolerance::ModeTolerance;

use super::along::{finished, with_notes};
use crate::Error;
use crate::caption::{number, operating_point};
use crate::figure::{Axis, Colour, Figure, Panel};
use crate::style::Style;

/// Variables beyond this number are summed.
const MOST: usize = 12;
/// Half the height of a bar.
const HALF: f64 = 0.36;

/// Maximum number of panels that fit on a page.
const PANELS: usize = 4;

/// Share of each design variable in the variance of the frequency of mode `mode`, from 0, largest at the top (a tornado
/// chart).
///
/// If the mode has no frequency, the shares are for `lambda`. Correlated variables can have negative shares.
///
/// # Errors
/// [`Error::UnknownMode`]; [`Error::Nothing`] if nothing moves the mode.
pub fn shares(result: &FirstOrder, mode: usize, style: &Style) -> Result<Figure, Error> {
    let panel = panel(result, mode, "")?;
    let name = style.mode(mode);
    let lines = vec![operating_point(&result.description, &result.inputs, None), spread(result, mode, style)];
    let d = &*result.description;
    Ok(finished(
        style,
        d,
        &format!("where the variance of {name} comes from"),
        with_notes(lines, style, d),
        vec![panel],
    ))
}

/// Variance shares of the first modes that tolerances move, one panel each.
///
/// # Errors
/// [`Error::Nothing`] if nothing moves any mode.
pub fn shares_of_all(result: &FirstOrder, style: &Style) -> Result<Figure, Error> {
    let d = &*result.description;
    let mut lines = vec![operating_point(d, &result.inputs, None)];
    let mut panels = Vec::new();
    let (oscillating, others): (Vec<usize>, Vec<usize>) =
        (0..result.modes.len()).partition(|&mode| result.modes[mode].behaviour.frequency().is_some());
    for mode in oscillating.into_iter().chain(others) {
        if panels.len() == PANELS {
            lines.push(format!("The first {PANELS} modes of {}.", result.modes.len()));
            break;
        }
        let name = style.mode(mode);
        if let Ok(panel) = panel(result, mode, &name) {
            panels.push(panel);
            let spread = spread(result, mode, style);
            if !spread.is_empty() {
                lines.push(format!("{name}: {spread}"));
            }
        }
    }
    if panels.is_empty() {
        return Err(Error::nothing("no tolerance moves a mode"));
    }
    Ok(finished(style, d, "where variance comes from", with_notes(lines, style, d), panels))
}

fn panel(result: &FirstOrder, mode: usize, name: &str) -> Result<Panel, Error> {
    let modes = result.modes.len();
    let this_mode = result.modes.get(mode);
    let this_mode = this_mode.ok_or(Error::UnknownMode { mode, modes })?;
    let shares = this_mode.variance_shares().iter().zip(result.description.design.iter());
    let mut all: Vec<(String, f64)> = shares
        .map(|(share, info)| (info.name.to_string(), 100.0 * share))
        .filter(|(_, share)| share.is_finite() && *share != 0.0)
        .collect();
    if all.is_empty() {
        return Err(Error::nothing(format!("no tolerance moves mode {}", mode + 1)));
    }
    all.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
    if all.len() > MOST {
        let rest = all.split_off(MOST - 1);
        let sum = rest.iter().map(|pair| pair.1).sum();
        all.push((format!("{} others", rest.len()), sum));
    }
    // The first category is at the bottom.
    all.reverse();
    let bars = all.iter().enumerate().map(|(k, (_, share))| {
        let k = k as f64;
        [share.min(0.0), share.max(0.0), k - HALF, k + HALF]
    });
    let bars: Vec<[f64; 4]> = bars.collect();
    let names = all.iter().map(|pair| pair.0.clone()).collect();
    let heading =
        if name.is_empty() { "share in the variance".to_owned() } else { format!("share in the variance of {name}") };
    let mut panel = Panel::new(Axis::new(heading, "%"), Axis::of_categories("", names));
    panel.bars("", Colour::Series(0), bars);
    for (k, (_, share)) in all.iter().enumerate() {
        let text = if share.abs() < 0.05 { "below 0.1".to_owned() } else { format!("{share:.1}") };
        panel.label([share.max(0.0), k as f64], text);
    }
    let ends = all.iter().map(|pair| pair.1);
    let [low, high] = ends.fold([0.0_f64, 0.0_f64], |[low, high], share| [low.min(share), high.max(share)]);
    panel.x.range = [1.1 * low, high + 0.12 * (high - low)];
    Ok(panel)
}

fn spread(result: &FirstOrder, mode: usize, style: &Style) -> String {
    let (scale, symbol) = style.frequency(&result.description);
    let frequency = result.modes.get(mode).and_then(ModeTolerance::frequency);
    frequency.map_or_else(String::new, |item| {
        let (mean, sigma) = (number(scale * item.mean), number(scale * item.sigma));
        format!("frequency {mean} {symbol}, sigma {sigma} {symbol} at first order.")
    })
}
