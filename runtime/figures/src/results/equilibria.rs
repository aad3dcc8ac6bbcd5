//! The equilibrium along an input.

use eigentol::{Equilibrium, Role};

use super::along::{Along, Course, finished};
use crate::Error;
use crate::caption::{in_unit, number};
use crate::figure::{Axis, Colour, Curve, Figure, Mark, Panel, Point, Stroke};
use crate::style::Style;

/// Number of points between a critical value and the next station.
const STEPS: usize = 8;

/// The coordinates of the equilibrium along the input, one panel per unit.
///
/// Unstable stretches are dotted. Curves are interrupted where there is no equilibrium and where it passes to another
/// branch at a critical value.
///
/// # Errors
/// [`Error::Nothing`] without an equilibrium, or if the mechanism has no coordinates at rest.
pub fn equilibria<R: Along + ?Sized>(result: &R, style: &Style) -> Result<Figure, Error> {
    let course = Course::of(result);
    let mut panels: Vec<Panel> = Vec::new();
    let resting = |role: Role| role == Role::Position;
    let infos = course.description.coordinates.iter().enumerate();
    for (k, info) in infos.filter(|(_, info)| resting(info.role)) {
        let known = |panel: &Panel| panel.y.unit == *info.unit.symbol;
        let index = panels.iter().position(known).unwrap_or_else(|| {
            let y = Axis::new("equilibrium", &*info.unit.symbol);
            panels.push(Panel::new(course.axis(), y));
            panels.len() - 1
        });
        let panel = &mut panels[index];
        let value = |equilibrium: &Equilibrium| equilibrium.coordinates.get(k).map(|q| in_unit(*q, &info.unit));
        for (stable, label) in [(true, info.name.to_string()), (false, format!("{}, unstable", info.name))] {
            let stroke = if stable { Stroke::of(k % 3) } else { Stroke::Dotted };
            let points = stretch(&course, stable, value);
            panel.curve(Curve::new(label, Colour::Series(k), points).stroke(stroke));
        }
    }
    panels.retain(|panel| !panel.is_empty());
    if panels.is_empty() {
        return Err(Error::nothing("there is no equilibrium at any of the values"));
    }
    for panel in &mut panels {
        panel.marks.extend(style.marks());
        panel.marks.extend(course.critical.iter().map(|&at| Mark { label: format!("critical {}", number(at)), at }));
    }
    Ok(finished(style, course.description, "equilibrium", course.caption(style), panels))
}

/// The stable or the unstable points; each stretch includes the first point of the next, so that they meet. At a
/// critical value where the equilibrium does not jump, the curve starts with a square-root branch.
fn stretch(course: &Course<'_>, stable: bool, value: impl Fn(&Equilibrium) -> Option<f64>) -> Vec<Option<Point>> {
    let mut points = Vec::new();
    let mut before: Option<(Point, bool)> = None;
    for (at, state) in &course.equilibria {
        let point = state.and_then(|state| Some(([*at, value(state)?], state.stability.holds())));
        let passed = |value: f64, from: f64| (from < value) != (*at < value);
        let (mut start, mut end) = (None, before);
        if let Some((from, _)) = before
            && course.critical.iter().any(|x| passed(*x, from[0]))
        {
            let turn = course.soft.iter().find(|pair| passed(pair.0, from[0]));
            start = turn.and_then(|(at, state)| Some([*at, value(state)?]));
            end = None;
            if before.is_some_and(|(_, held)| held == stable) {
                points.push(start);
            }
        }
        match point {
            Some((point, holds)) if holds == stable => {
                if end.is_none() {
                    points.push(None);
                    points.extend(start.iter().flat_map(|start| root(*start, point)));
                }
                points.push(Some(point));
            }
            Some((point, _)) if end.is_some_and(|(_, held)| held == stable) => {
                points.extend([Some(point), None]);
            }
            _ => points.push(None),
        }
        before = point;
    }
    points
}

/// Points of a square root from its origin to just before another point.
fn root(from: Point, to: Point) -> impl Iterator<Item = Option<Point>> {
    (0..STEPS).map(move |k| {
        let t = k as f64 / STEPS as f64;
        let x = from[0] + t * t * (to[0] - from[0]);
        Some([x, from[1] + t * (to[1] - from[1])])
    })
}
