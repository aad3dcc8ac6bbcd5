//! Where the variance of a mode comes from.

use eigentol::FirstOrder;

use super::along::with_notes;
use crate::Error;
use crate::caption::{number, operating_point};
use crate::figure::{Axis, Colour, Figure, Panel};
use crate::style::Style;

/// Variables beyond these are summed.
const MOST: usize = 12;
/// Half of the height of a bar.
const HALF: f64 = 0.36;

/// Shares of the design variables in the variance of the frequency of mode number `mode`, from 0, the greatest at the top (a tornado
/// chart). Of a mode without a frequency they are those of `lambda`. Correlated variables can have negative shares.
///
/// # Errors
/// [`Error::UnknownMode`]; [`Error::Nothing`] where nothing moves the mode.
pub fn shares(result: &FirstOrder, mode: usize, style: &Style) -> Result<Figure, Error> {
    let modes = result.modes.len();
    let own = result.modes.get(mode);
    let own = own.ok_or(Error::UnknownMode { mode, modes })?;
    let d = &*result.description;
    let name = style.mode(mode);
    let shares = own.variance_shares().iter().zip(d.design.iter());
    let shares = shares.map(|(share, info)| (info.name.to_string(), 100.0 * share));
    let mut all: Vec<(String, f64)> = shares
        .filter(|(_, share)| share.is_finite() && *share != 0.0)
        .collect();
    if all.is_empty() {
        return Err(Error::nothing(format!("no tolerance moves {name}")));
    }
    all.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
    if all.len() > MOST {
        let rest = all.split_off(MOST - 1);
        let sum = rest.iter().map(|own| own.1).sum();
        all.push((format!("{} others", rest.len()), sum));
    }
    // The first category is the lowest one.
    all.reverse();
    let bars = all.iter().enumerate().map(|(k, (_, share))| {
        let k = k as f64;
        [share.min(0.0), share.max(0.0), k - HALF, k + HALF]
    });
    let bars: Vec<[f64; 4]> = bars.collect();
    let names = all.iter().map(|own| own.0.clone()).collect();
    let mut panel = Panel::new(
        Axis::new("share in the variance", "%"),
        Axis::of_categories("", names),
    );
    panel.bars("", Colour::Series(0), bars);
    for (k, (_, share)) in all.iter().enumerate() {
        let text = match share.abs() < 0.05 {
            true => format!("{share:.1e}"),
            false => format!("{share:.1}"),
        };
        panel.label([share.max(0.0), k as f64], text);
    }
    let ends = all.iter().map(|own| own.1);
    let [low, high] = ends.fold([0.0_f64, 0.0_f64], |[low, high], share| {
        [low.min(share), high.max(share)]
    });
    panel.x.range = [1.1 * low, high + 0.12 * (high - low)];
    let caption = with_notes(
        vec![
            operating_point(d, &result.inputs, None),
            spread(result, mode, style),
        ],
        style,
        d,
    );
    let title = style.titled(format!(
        "{}: where the variance of {name} comes from",
        d.name
    ));
    Ok(Figure::new(title, caption, vec![panel]))
}

fn spread(result: &FirstOrder, mode: usize, style: &Style) -> String {
    let (scale, symbol) = style.frequency(None);
    let own = result
        .modes
        .get(mode)
        .and_then(|own| own.frequency.as_ref());
    own.map_or_else(String::new, |own| {
        let (mean, sigma) = (number(scale * own.mean), number(scale * own.sigma));
        format!("First order: frequency {mean} {symbol}, sigma {sigma} {symbol}.")
    })
}
