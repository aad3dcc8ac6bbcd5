//! The mass of a body: its `inertial`, or its geoms.

use std::f64::consts::PI;

use super::attributes::{Angles, exactly, from_z, number, numbers, pose};
use super::element::Element;
use super::meshes::{Mesh, Meshes};
use crate::error::ImportError;
use crate::geometry::{Inertial, Moments, Pose, Vector, matrix, norm};

type Result<T> = std::result::Result<T, ImportError>;

/// Where the mass of bodies comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    /// From geoms, whatever is said of it.
    Geoms,
    /// From geoms where nothing else is said.
    Either,
    /// Only what is said.
    Inertial,
}

/// What masses are made from.
pub(super) struct Masses<'a> {
    pub(super) angles: Angles,
    pub(super) source: Source,
    /// Of geoms that count.
    pub(super) groups: [f64; 2],
    pub(super) meshes: Meshes<'a>,
}

/// Mass, centre and inertia in the axes of the body; `None` of what has none.
pub(super) fn mass(body: &Element, from: &Masses<'_>) -> Result<Option<Moments>> {
    let Masses { angles, source, groups, .. } = from;
    let said = body.named("inertial").next().filter(|_| *source != Source::Geoms);
    let mut total = Moments::default();
    match said {
        Some(own) => total.add(&Moments::of(&inertial(own, angles)?, &Pose::default())),
        None if *source == Source::Inertial => {}
        None => {
            for geom in body.named("geom") {
                let group = number(geom, "group", 0.0)?;
                if (groups[0]..=groups[1]).contains(&group)
                    && let Some(own) = solid(geom, from)?
                {
                    total.add(&Moments::of(&own, &Pose::default()));
                }
            }
        }
    }
    Ok((total.mass > 0.0).then_some(total))
}

fn inertial(own: &Element, angles: &Angles) -> Result<Inertial> {
    let diagonal = exactly::<3>(own, "diaginertia")?;
    let full = exactly::<6>(own, "fullinertia")?;
    let inertia = match (full, diagonal) {
        (Some([xx, yy, zz, xy, xz, yz]), _) => [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]],
        (None, Some(three)) => matrix(|i, j| if i == j { three[i] } else { 0.0 }),
        (None, None) => return Err(own.wrong("`inertial` has no inertia", "add `diaginertia` or `fullinertia`")),
    };
    Ok(Inertial { pose: pose(own, angles)?, mass: number(own, "mass", 0.0)?, inertia })
}

/// A geom of some mass.
fn solid(geom: &Element, from: &Masses<'_>) -> Result<Option<Inertial>> {
    let angles = &from.angles;
    let kind = geom.get("type").unwrap_or(if geom.get("mesh").is_some() { "mesh" } else { "sphere" });
    if ["plane", "hfield"].contains(&kind) {
        return Ok(None);
    }
    let given = exactly::<1>(geom, "mass")?.map(|[mass]| mass);
    let density = number(geom, "density", 1000.0)?;
    if given == Some(0.0) || (given.is_none() && density == 0.0) {
        return Ok(None);
    }
    if geom.get("shellinertia") == Some("true") {
        return Err(geom.wrong("the inertia of a shell is not known here", "give the body an `inertial`"));
    }
    let size = numbers(geom, "size")?;
    let ends = exactly::<6>(geom, "fromto")?;
    let mut frame = pose(geom, angles)?;
    let along = ends.map(|[a, b, c, d, e, f]| {
        let axis = [a - d, b - e, c - f];
        frame = Pose { offset: [(a + d) / 2.0, (b + e) / 2.0, (c + f) / 2.0], rotations: from_z(axis) };
        norm(axis) / 2.0
    });
    let size = |k: usize| -> Result<f64> {
        let found = match along {
            // The radius or the half-width both ways, then half the distance of the ends.
            Some(half) if k == 2 || (k == 1 && ["capsule", "cylinder"].contains(&kind)) => Some(half),
            Some(_) => size.first().copied(),
            None => size.get(k).copied(),
        };
        let wrong = || geom.wrong(format!("the size of this {kind} has too few numbers"), "give all of them, positive");
        found.filter(|x| *x > 0.0).ok_or_else(wrong)
    };
    let ellipsoid = |three: Vector| {
        let squares = three.map(|x| x * x);
        squares.map(|x| squares.iter().sum::<f64>() - x)
    };
    // Volume, and moments for a mass of one.
    let (volume, moments) = match kind {
        "sphere" => {
            let r = size(0)?;
            (4.0 / 3.0 * PI * r.powi(3), [0.4 * r * r; 3])
        }
        "ellipsoid" => {
            let three = [size(0)?, size(1)?, size(2)?];
            (4.0 / 3.0 * PI * three.iter().product::<f64>(), ellipsoid(three).map(|x| x / 5.0))
        }
        "box" => {
            let three = [size(0)?, size(1)?, size(2)?];
            (8.0 * three.iter().product::<f64>(), ellipsoid(three).map(|x| x / 3.0))
        }
        "cylinder" => {
            let (r, h) = (size(0)?, 2.0 * size(1)?);
            let across = (3.0 * r * r + h * h) / 12.0;
            (PI * r * r * h, [across, across, r * r / 2.0])
        }
        "capsule" => {
            let (r, h) = (size(0)?, 2.0 * size(1)?);
            let [tube, ends] = [PI * r * r * h, 4.0 / 3.0 * PI * r.powi(3)];
            let across = tube * (3.0 * r * r + h * h) / 12.0 + ends * (0.4 * r * r + 0.375 * r * h + h * h / 4.0);
            let about = tube * r * r / 2.0 + ends * 0.4 * r * r;
            let volume = tube + ends;
            (volume, [across / volume, across / volume, about / volume])
        }
        "mesh" => {
            let Mesh { volume, unit } = from.meshes.get(geom)?;
            let mass = given.unwrap_or(density * volume);
            let pose = frame.then(&unit.pose);
            return Ok(Some(Inertial { pose, mass, inertia: unit.inertia.map(|row| row.map(|x| mass * x)) }));
        }
        other => {
            let help = "give its body an `inertial`";
            return Err(geom.wrong(format!("the mass of a {other} is not known here"), help));
        }
    };
    let mass = given.unwrap_or(density * volume);
    let inertia = matrix(|i, j| if i == j { mass * moments[i] } else { 0.0 });
    Ok(Some(Inertial { pose: frame, mass, inertia }))
}
