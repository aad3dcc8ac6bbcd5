//! Equalities: joined bodies, and joints that follow each other.

use super::attributes::{exactly, numbers, of_quaternion, required};
use super::element::Element;
use super::model::{CONSTRAINTS, Coordinate, Placed, Translation};
use super::remark;
use crate::error::{ImportError, Reason};
use crate::geometry::{Pose, Vector};
use crate::write::number as text_of;

type Result<T> = std::result::Result<T, ImportError>;

pub(super) fn equality(all: &mut Translation<'_>, own: &Element) -> Result<()> {
    if own.get("active") == Some("false") {
        all.notes.push(remark(format!("an `{}` that is not active is left out", own.tag)));
        return Ok(());
    }
    let wanted = own.get("name").unwrap_or(&own.tag);
    match &*own.tag {
        "connect" => {
            let [from, to] = ends(all, own, wanted, false)?;
            add(all, wanted, &format!("coincident(from: {from}, to: {to})"));
        }
        "weld" => {
            let [from, to] = ends(all, own, wanted, true)?;
            add(all, wanted, &format!("coincident(from: {from}, to: {to})"));
            add(all, &format!("{wanted}_turned"), &format!("aligned(from: {from}, to: {to})"));
        }
        "joint" => {
            let first = all.coordinate(own, "joint1")?;
            let second = own.get("joint2").map(|_| all.coordinate(own, "joint2")).transpose()?;
            let law = polynomial(&first, second.as_ref(), &factors(own)?);
            add(all, wanted, &law);
        }
        other => all.notes.push(remark(format!("the equality `{other}` is left out"))),
    }
    Ok(())
}

pub(super) fn factors(own: &Element) -> Result<Vec<f64>> {
    let given = numbers(own, "polycoef")?;
    Ok(if given.is_empty() { vec![0.0, 1.0] } else { given })
}

fn add(all: &mut Translation<'_>, wanted: &str, law: &str) {
    let name = all.names.of_file(wanted, "constraint");
    all.lines[CONSTRAINTS].push((name.clone(), format!("constraint {name}: {law}")));
}

/// `x - a0 - a1 y - a2 y^2 ..` is zero, where `x` and `y` count from the reference.
fn polynomial(first: &Coordinate, second: Option<&Coordinate>, factors: &[f64]) -> String {
    let unit = |is_angle: bool| if is_angle { "rad" } else { "m" };
    let (own, term) = (unit(first.is_angle), |k: usize| factors.get(k).copied().unwrap_or(0.0));
    let higher = factors.iter().skip(2).any(|x| *x != 0.0);
    match second.filter(|_| higher || term(1) != 0.0) {
        None => format!("equation(zero: {} - {} {own})", first.name, text_of(term(0))),
        Some(second) if !higher => {
            let ratio = match (first.is_angle, second.is_angle) {
                (true, false) => " rad/m",
                (false, true) => " m/rad",
                _ => "",
            };
            let offset = if term(0) == 0.0 { String::new() } else { format!(", offset: {} {own}", text_of(term(0))) };
            let (of, with, factor) = (&first.name, &second.name, text_of(term(1)));
            format!("coupling(of: {of}, with: {with}, ratio: {factor}{ratio}{offset})")
        }
        Some(second) => {
            let share = format!("({} / 1 {})", second.name, unit(second.is_angle));
            let terms = (0..factors.len()).filter(|&k| term(k) != 0.0).map(|k| match k {
                0 => format!(" - {}", text_of(term(0))),
                1 => format!(" - {} * {share}", text_of(term(1))),
                _ => format!(" - {} * {share}^{k}", text_of(term(k))),
            });
            format!("equation(zero: {} / 1 {own}{})", first.name, terms.collect::<String>())
        }
    }
}

/// The two points that an equality of bodies joins; of a weld they have axes.
fn ends(all: &mut Translation<'_>, own: &Element, wanted: &str, axes: bool) -> Result<[String; 2]> {
    if own.get("site1").is_some() {
        let site = |attribute| {
            let name = required(own, attribute)?;
            let unknown = || own.mistake(Reason::Unknown { what: "site", name: name.to_owned(), near: None });
            all.sites.get(name).cloned().ok_or_else(unknown)
        };
        return Ok([site("site1")?, site("site2")?]);
    }
    let first = placed(all, own, required(own, "body1")?)?;
    let second = placed(all, own, own.get("body2").unwrap_or("world"))?;
    let anchor = exactly::<3>(own, "anchor")?;
    // The frame of the second body in the first one, as they stand or as is said.
    let said = exactly::<7>(own, "relpose")?.filter(|pose| axes && pose[3..].iter().any(|x| *x != 0.0));
    let relative = match said {
        Some([x, y, z, a, b, c, d]) => Pose { offset: [x, y, z], rotations: of_quaternion([a, b, c, d]) },
        None => first.pose.inverse().then(&second.pose),
    };
    // The anchor of a weld is in the second body, that of a connection in the first one.
    let (at_first, at_second) = if axes {
        let anchor = anchor.unwrap_or([0.0; 3]);
        // A pose that is said is that of the anchor.
        (if said.is_some() { relative } else { relative.then(&at(anchor)) }, at(anchor))
    } else {
        let Some(anchor) = anchor else {
            return Err(own.mistake(Reason::MissingAttribute { element: own.tag.clone(), attribute: "anchor" }));
        };
        (at(anchor), at(relative.inverse().then(&at(anchor)).offset))
    };
    let names = [1, 2].map(|k| all.names.unique(&format!("{wanted}_{k}"), "point"));
    all.point(&names[0], &first.name, &at_first);
    all.point(&names[1], &second.name, &at_second);
    Ok(names)
}

fn at(offset: Vector) -> Pose {
    Pose { offset, rotations: Vec::new() }
}

fn placed(all: &Translation<'_>, own: &Element, name: &str) -> Result<Placed> {
    let unknown = || own.mistake(Reason::Unknown { what: "body", name: name.to_owned(), near: None });
    all.bodies.get(name).cloned().ok_or_else(unknown)
}
