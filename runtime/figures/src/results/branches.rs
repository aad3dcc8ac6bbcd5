//! Branches of equilibria.

use eigentol::branches::{Branch, BranchPoint, Branches, SpecialKind, SpecialPoint};
use eigentol::{Description, Role, Stability, Text, Unit};

use super::along::{finished, input_axis, input_unit, with_notes};
use crate::Error;
use crate::caption::{design, in_unit, operating_point, with_unit};
use crate::figure::{Axis, Colour, Curve, Figure, Panel, Point, Shape, Stroke};
use crate::style::Style;

/// Maximum number of panels that fit on a page.
const MOST: usize = 4;
/// Coordinates (SI) below this are rounding.
const ZERO: f64 = 1e-12;

/// Branches of equilibria along the input, one panel for each output, or for each coordinate if none is declared.
///
/// Stable stretches are solid, unstable ones dotted; folds and branch points are numbered.
///
/// # Errors
/// [`Error::Nothing`] without a branch, or if the mechanism has no coordinates at rest.
pub fn branches(result: &Branches, style: &Style) -> Result<Figure, Error> {
    let first = result.branches.iter().find(|branch| !branch.points.is_empty());
    let Some(first) = first else {
        return Err(Error::nothing("no branch was found"));
    };
    let d = &*first.description;
    let special = result.special();
    let mut panels: Vec<Panel> = Vec::new();
    let mut open_ends = false;
    let shown = quantities(d, result);
    for quantity in shown.iter().take(MOST) {
        let y = Axis::new(&*quantity.name, &*quantity.unit.symbol);
        let mut panel = Panel::new(input_axis(d, first.input), y);
        let unit = input_unit(d, first.input);
        let place = |point: &BranchPoint| -> Option<Point> {
            Some([in_unit(point.value, &unit), in_unit(quantity.of(point)?, &quantity.unit)])
        };
        for (number, branch) in result.branches.iter().enumerate() {
            for (stability, stretch, before, after) in joined(branch) {
                let (word, stroke) =
                    if stability.holds() { ("stable", Stroke::Solid) } else { ("unstable", Stroke::Dotted) };
                let label = match result.branches.len() {
                    1 => word.to_owned(),
                    _ => format!("branch {}, {word}", number + 1),
                };
                let middle = |pair: [&BranchPoint; 2]| {
                    let [a, b] = pair.map(place);
                    Some(between(a?, b?))
                };
                let points = stretch.iter().map(place);
                let points = before.map(middle).into_iter().chain(points);
                let points = points.chain(after.map(middle)).collect();
                open_ends |= after.is_some_and(|[a, b]| holds(a) != holds(b));
                add(&mut panel, label, Colour::Series(number), stroke, points);
            }
        }
        for (word, shape) in
            [("fold", Shape::Triangle), ("branch point", Shape::Square), ("stiffness is lost", Shape::Cross)]
        {
            let here = special.iter().filter(|x| kind(x).0 == word);
            let points = here.filter_map(|special| place(point_of(result, special)?));
            panel.markers(word, Colour::Black, shape, points);
        }
        for (k, point) in special.iter().enumerate() {
            if let Some(at) = point_of(result, point).and_then(place) {
                panel.label(at, (k + 1).to_string());
            }
        }
        panel.marks.extend(style.marks());
        panels.push(panel);
    }
    panels.retain(|panel| !panel.is_empty());
    if panels.is_empty() {
        return Err(Error::nothing("the mechanism has no coordinates that rest"));
    }
    let mut caption = about(d, result);
    if shown.len() > MOST {
        caption.push(format!("The first {MOST} of {} that change.", shown.len()));
    }
    caption = with_notes(caption, style, d);
    let unit = input_unit(d, first.input);
    caption.extend(special.iter().enumerate().map(|(k, item)| {
        let at = with_unit(item.value, &unit);
        format!("({}) {} at {at}", k + 1, kind(item).1)
    }));
    if open_ends {
        caption.push(
            "Where a stretch ends without a number, stability changes between two points of the branch: drawn half way.".to_owned(),
        );
    }
    if result.truncated {
        caption.push("There are more branches than were followed.".to_owned());
    }
    Ok(finished(style, d, "branches of equilibria", caption, panels))
}

/// What a panel shows.
struct Quantity {
    name: Text,
    unit: Unit,
    /// Its number among the outputs or the coordinates.
    index: usize,
    is_output: bool,
}

impl Quantity {
    fn of(&self, point: &BranchPoint) -> Option<f64> {
        let values = if self.is_output { &point.outputs } else { &point.equilibrium.coordinates };
        values.get(self.index).copied()
    }
}

/// The outputs that are not zero all along; else the coordinates that are not, or all if everything is.
fn quantities(d: &Description, result: &Branches) -> Vec<Quantity> {
    let all = |is_output: bool| -> Vec<Quantity> {
        let quantity = |(index, name, unit): (usize, &Text, &Unit)| Quantity {
            name: name.clone(),
            unit: unit.clone(),
            index,
            is_output,
        };
        if is_output {
            d.outputs.iter().enumerate().map(|(k, info)| quantity((k, &info.name, &info.unit))).collect()
        } else {
            (d.coordinates.iter().enumerate())
                .filter(|(_, info)| info.role == Role::Position)
                .map(|(k, info)| quantity((k, &info.name, &info.unit)))
                .collect()
        }
    };
    let points = || result.branches.iter().flat_map(|branch| &branch.points);
    let changes = |own: &Quantity| points().any(|point| own.of(point).is_some_and(|value| value.abs() > ZERO));
    for is_output in [true, false] {
        let changing: Vec<Quantity> = all(is_output).into_iter().filter(changes).collect();
        if !changing.is_empty() {
            return changing;
        }
    }
    all(false)
}

/// The point of a branch at which a special point lies.
fn point_of<'a>(result: &'a Branches, special: &SpecialPoint) -> Option<&'a BranchPoint> {
    let mut points = result.branches.iter().flat_map(|branch| &branch.points);
    points
        .find(|point| point.value == special.value && point.equilibrium.coordinates == special.equilibrium.coordinates)
}

fn holds(point: &BranchPoint) -> bool {
    point.equilibrium.stability.holds()
}

/// A stretch of a branch and, if it begins or ends between two points, those two points.
type Joined<'a> = (Stability, &'a [BranchPoint], Option<[&'a BranchPoint; 2]>, Option<[&'a BranchPoint; 2]>);

/// The stretches of a branch. Where stability changes away from special points, as at a flutter onset, no point belongs
/// to both stretches.
fn joined(branch: &Branch) -> Vec<Joined<'_>> {
    let all = branch.stretches();
    let gap = |before: Option<usize>, after: usize| {
        let last = all.get(before?)?.1.last()?;
        let next = all.get(after)?.1.first()?;
        (!core::ptr::eq(last, next)).then_some([last, next])
    };
    let each = all.iter().enumerate();
    each.map(|(k, (stability, stretch))| {
        let (before, after) = (gap(k.checked_sub(1), k), gap(Some(k), k + 1));
        (*stability, *stretch, before, after)
    })
    .collect()
}

/// The midpoint of two points.
fn between(a: Point, b: Point) -> Point {
    [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]
}

/// Adds a stretch to the curve with the same look, so that the legend lists it once.
fn add(panel: &mut Panel, label: String, colour: Colour, stroke: Stroke, points: Vec<Option<Point>>) {
    let curve = Curve::new(label, colour, points).stroke(stroke);
    let known = |x: &&mut Curve| x.label == curve.label && x.stroke == stroke;
    match panel.curves.iter_mut().find(known) {
        Some(existing) if curve.pieces.iter().all(|piece| piece.len() > 1) => {
            existing.pieces.extend(curve.pieces);
        }
        _ => panel.curve(curve),
    }
}

fn about(d: &Description, result: &Branches) -> Vec<String> {
    let first = result.branches.iter().flat_map(|branch| &branch.points).next();
    let input = result.branches.first().map(|branch| branch.input);
    match first {
        Some(point) => {
            vec![operating_point(d, &point.equilibrium.inputs, input), design(d, &point.equilibrium.design, &[])]
        }
        None => Vec::new(),
    }
}

/// The wording for the legend and for the caption.
fn kind(point: &SpecialPoint) -> (&'static str, &'static str) {
    match point.kind {
        SpecialKind::Fold => ("fold", "fold"),
        SpecialKind::Pitchfork { supercritical: Some(true) } => ("branch point", "pitchfork, supercritical"),
        SpecialKind::Pitchfork { supercritical: Some(false) } => ("branch point", "pitchfork, subcritical"),
        SpecialKind::Pitchfork { .. } => ("branch point", "pitchfork"),
        SpecialKind::Transcritical => ("branch point", "transcritical"),
        _ => ("stiffness is lost", "stiffness is lost"),
    }
}
