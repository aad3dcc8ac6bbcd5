//! Small drawings of the distribution of each variable: its density about its mean.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use eigentol::tolerance::Distribution;

use super::variables::Variable;
use crate::html::Html;
use crate::words::{digits, number};

/// Size of a drawing, and of the space below its curve for a line.
const WIDTH: f64 = 160.0;
const HEIGHT: f64 = 48.0;
const BELOW: f64 = 4.0;
/// Standard deviations drawn to either side of a normal variable, and the number of points.
const REACH: f64 = 3.5;
const STEPS: u32 = 56;
/// Maximum number of variables drawn; further ones appear only in the table.
const MOST: usize = 48;

/// A drawing for each variable with a tolerance.
pub(super) fn drawings(html: &mut Html, all: &[Variable<'_>], sigma_level: f64) {
    let varying = all.iter().filter_map(|x| Some((x, x.law?)));
    let varying: Vec<_> = varying.filter(|(_, law)| law.sigma() > 0.0).collect();
    if varying.is_empty() {
        return;
    }
    html.element("div", &[("class", "laws")], |html| {
        for (variable, law) in varying.iter().take(MOST) {
            html.element("div", &[("class", "law")], |html| {
                html.leaf("strong", &[], variable.name);
                drawing(html, variable, law);
                html.leaf("p", &[], &words(variable, law, sigma_level));
            });
        }
    });
    html.paragraph(&format!(
        "Law, mean and {sigma_level} standard deviations. Each plot shows the density; the line marks the set value, the shade the band."
    ));
    if varying.len() > MOST {
        let more = varying.len() - MOST;
        html.paragraph(&format!("{more} more variables vary: they are in the table."));
    }
}

/// `normal, 1 ± 0.03 m`: distribution, mean and band.
fn words(variable: &Variable<'_>, law: &Distribution, sigma_level: f64) -> String {
    let mean = number(variable.unit.from_si(law.mean()));
    let band = digits(variable.unit.from_si(sigma_level * law.sigma()), 3);
    format!("{}, {mean} \u{b1} {band} {}", law.name(), variable.unit.symbol).trim_end().to_owned()
}

fn drawing(html: &mut Html, variable: &Variable<'_>, law: &Distribution) {
    let points = density(law);
    let xs = points.iter().map(|point| point[0]);
    let (low, high) = xs.fold((variable.value, variable.value), |(low, high), x| (low.min(x), high.max(x)));
    let top = points.iter().fold(0.0, |top: f64, point| top.max(point[1]));
    if !(high > low && top > 0.0 && (high - low).is_finite() && top.is_finite()) {
        return;
    }
    let x = |value: f64| 1.0 + (WIDTH - 2.0) * ((value - low) / (high - low)).clamp(0.0, 1.0);
    let base = HEIGHT - BELOW;
    let y = |height: f64| base - (base - 2.0) * height / top;
    let mut path = String::new();
    for (k, point) in points.iter().enumerate() {
        let letter = if k == 0 { 'M' } else { 'L' };
        let _ = write!(path, "{letter}{:.1} {:.1}", x(point[0]), y(point[1]));
    }
    let view = format!("0 0 {WIDTH} {HEIGHT}");
    let label = format!("Density of {}", variable.name);
    let attributes = [("viewBox", &*view), ("role", "img"), ("aria-label", &*label)];
    html.element("svg", &attributes, |html| {
        let [left, right] = [-1.0, 1.0].map(|side| law.mean() + side * variable.half_width).map(x);
        let numbers = [left, 0.0, right - left, base].map(|x| format!("{x:.1}"));
        let [left, top, width, height] = &numbers;
        let shade = [("class", "shade"), ("x", left), ("y", top), ("width", width), ("height", height)];
        html.leaf("rect", &shade, "");
        html.leaf("path", &[("class", "density"), ("d", &path)], "");
        let line = format!("M0 {base}H{WIDTH}M{:.1} 0V{HEIGHT}", x(variable.value));
        html.leaf("path", &[("class", "scale"), ("d", &line)], "");
    });
}

/// Values and their densities from left to right, zero at both ends; for a discrete distribution, vertical lines
/// proportional to the probability of each value.
fn density(law: &Distribution) -> Vec<[f64; 2]> {
    let quantiles = (0..=STEPS).map(|k| REACH * (2.0 * f64::from(k) / f64::from(STEPS) - 1.0));
    let mut points = Vec::new();
    if law.is_continuous() {
        let height = |z: f64| (-0.5 * z * z).exp() / TAU.sqrt() / law.slope_from_normal(z);
        points.extend(quantiles.map(|z| [law.from_normal(z), height(z)]));
        points.retain(|point| point.iter().all(|x| x.is_finite()));
    } else {
        let mut counted: Vec<[f64; 2]> = Vec::new();
        let count = 4 * STEPS;
        for k in 0..count {
            let value = law.quantile((f64::from(k) + 0.5) / f64::from(count));
            match counted.last_mut() {
                Some([last, times]) if *last == value => *times += 1.0,
                _ => counted.push([value, 1.0]),
            }
        }
        points.extend(counted.into_iter().flat_map(|[x, times]| [[x, 0.0], [x, times], [x, 0.0]]));
    }
    let ends = points.first().zip(points.last());
    if let Some(([first, _], [last, _])) = ends.map(|(a, b)| (*a, *b)) {
        points.insert(0, [first, 0.0]);
        points.push([last, 0.0]);
    }
    points
}
