//! Mode shapes.

use eigentol::{Complex, Description, Equilibrium, Mode, Modes, Role};

use super::along::{finished, with_notes};
use crate::Error;
use crate::caption::{design, number, operating_point};
use crate::figure::{Axis, Colour, Figure, Panel, Shape};
use crate::style::Style;

/// Maximum number of modes that fit on a page.
pub(super) const MOST: usize = 6;
/// Components smaller than this fraction of the largest have no meaningful phase.
const VISIBLE: f64 = 1e-3;
/// Half the width of the bars of one coordinate.
const HALF: f64 = 0.38;
/// Maximum width of a bar.
const WIDEST: f64 = 0.25;

/// Mode shapes as bars by coordinate, in SI units, relative to the largest component.
///
/// Shapes of undamped modes are drawn with signs; those of general modes as magnitudes, and in a second panel as phases
/// relative to the largest component.
///
/// # Errors
/// [`Error::Nothing`] without modes.
pub fn mode_shapes(result: &Modes, style: &Style) -> Result<Figure, Error> {
    let shown = shown(result)?;
    let real = |mode: &&Mode| {
        let whole = mode.shape.iter().map(|component| component.norm()).fold(0.0, f64::max);
        mode.shape.iter().all(|component| component.im.abs() <= 1e-9 * whole)
    };
    let real = shown.iter().all(real);
    let mut upper = panel(result, if real { "shape" } else { "magnitude" }, "");
    let mut lower = panel(result, "phase", "deg");
    for (r, mode) in shown.iter().enumerate() {
        let components = relative(result, mode);
        let heights = components.iter().map(|x| if real { x.re } else { x.norm() });
        let bars: Vec<[f64; 4]> = columns(heights, r, shown.len()).collect();
        upper.bars(label(mode, &result.description, style), Colour::Series(r), bars);
        let phases = columns(components.iter().map(|x| x.arg().to_degrees()), r, shown.len());
        let phases = phases.zip(&components).filter(|(_, x)| x.norm() >= VISIBLE);
        let points =
            phases.map(|([left, right, low, high], _)| [0.5 * (left + right), if low < 0.0 { low } else { high }]);
        lower.markers("", Colour::Series(r), Shape::of(r), points.collect::<Vec<_>>());
    }
    let panels = if real {
        upper.fit();
        upper.level_line(0.0);
        vec![upper]
    } else {
        lower.y.range = [-195.0, 195.0];
        lower.level_line(0.0);
        vec![upper, lower]
    };
    let mut caption = caption(result);
    let mut units: Vec<&str> = resting(result).map(|k| &*result.description.coordinates[k].unit.symbol).collect();
    units.dedup();
    if units.len() > 1 {
        caption.push("Coordinates in rad and in m do not compare.".to_owned());
    }
    let caption = with_notes(caption, style, &result.description);
    Ok(finished(style, &result.description, "mode shapes", caption, panels))
}

/// The share of each coordinate in the kinetic energy of each mode, `Re(phi_i* (Mhat phi)_i) / phi^H Mhat phi`.
///
/// The shares are comparable whatever the units of the coordinates. Coupled coordinates can have negative shares.
///
/// # Errors
/// [`Error::Nothing`] without modes, or for an equilibrium of another mechanism.
pub fn participation(result: &Modes, at: &Equilibrium, style: &Style) -> Result<Figure, Error> {
    let shown = shown(result)?;
    let mass = &at.linear.mass;
    let mut panel = panel(result, "share of kinetic energy", "%");
    for (r, mode) in shown.iter().enumerate() {
        let product = |i: usize| -> Option<f64> {
            let complex: Complex = mass.iter().nth(i)?.iter().zip(mode.shape.iter()).map(|(m, phi)| phi * *m).sum();
            Some((mode.shape.get(i)?.conj() * complex).re)
        };
        let all: Option<Vec<f64>> = (0..mode.shape.len()).map(product).collect();
        let all = all.ok_or_else(|| Error::nothing("the equilibrium is that of another mechanism"))?;
        let whole: f64 = all.iter().sum();
        let percentages = resting(result).map(|k| 100.0 * all[k] / whole);
        let bars: Vec<[f64; 4]> = columns(percentages, r, shown.len()).collect();
        panel.bars(label(mode, &result.description, style), Colour::Series(r), bars);
    }
    if panel.is_empty() {
        return Err(Error::nothing("no mode moves a mass"));
    }
    let mut caption = caption(result);
    caption.insert(1, design(&result.description, &at.design, &[]));
    let caption = with_notes(caption, style, &result.description);
    Ok(finished(style, &result.description, "what moves in each mode", caption, vec![panel]))
}

fn shown(result: &Modes) -> Result<Vec<&Mode>, Error> {
    let shown: Vec<&Mode> = result.foremost(MOST).into_iter().map(|mode| &result.modes[mode]).collect();
    if shown.is_empty() || resting(result).next().is_none() {
        Err(Error::nothing("the mechanism has no modes"))
    } else {
        Ok(shown)
    }
}

/// Coordinates and speeds; reactions are not part of the motion.
fn resting(result: &Modes) -> impl Iterator<Item = usize> + '_ {
    result
        .description
        .coordinates
        .iter()
        .enumerate()
        .filter(|(_, info)| matches!(info.role, Role::Position | Role::Speed))
        .map(|(k, _)| k)
}

fn panel(result: &Modes, name: &str, unit: &str) -> Panel {
    let names = resting(result).map(|k| result.description.coordinates[k].name.to_string());
    Panel::new(Axis::of_categories("", names.collect()), Axis::new(name, unit))
}

/// Components divided by the largest one, whose phase is zero.
fn relative(result: &Modes, mode: &Mode) -> Vec<Complex> {
    let complexes: Vec<Complex> = resting(result).filter_map(|k| mode.shape.get(k).copied()).collect();
    let largest = complexes.iter().copied().max_by(|a, b| a.norm().total_cmp(&b.norm()));
    match largest.filter(|largest| largest.norm() > 0.0) {
        Some(largest) => complexes.iter().map(|x| x / largest).collect(),
        None => complexes,
    }
}

/// Bars of mode `r` of `modes`, side by side with the others, one for each coordinate.
fn columns(heights: impl Iterator<Item = f64>, r: usize, modes: usize) -> impl Iterator<Item = [f64; 4]> {
    let width = (2.0 * HALF / modes as f64).min(WIDEST);
    heights.enumerate().map(move |(k, height)| {
        let left = k as f64 + width * (r as f64 - 0.5 * modes as f64);
        [left, left + 0.9 * width, height.min(0.0), height.max(0.0)]
    })
}

pub(super) fn label(mode: &Mode, d: &Description, style: &Style) -> String {
    let (scale, symbol) = style.frequency(d);
    let name = style.mode(mode.label);
    match mode.frequency() {
        Some(frequency) => format!("{name}, {} {symbol}", number(scale * frequency)),
        None => format!("{name}, s = {} 1/s", number(mode.s.re)),
    }
}

fn caption(result: &Modes) -> Vec<String> {
    let mut lines = vec![operating_point(&result.description, &result.inputs, None)];
    let all = result.modes.len();
    if all > MOST {
        lines.push(format!("The first {MOST} of {all} modes."));
    }
    lines
}
