//! Reads the numbers of the picture kernel into a scene.

use super::ellipsoid::ellipsoid;
use super::extent::bounds;
use super::scene::{Beam, Body, Element, Joint, Link, Point, Pose, Scene, Seat, Section, Shape, Solid, Wheel};
use crate::algebra::all_finite;
use crate::arguments::check_count;
use crate::kernels::PictureKernels;
use crate::{Description, Error, PictureInfo, SolidInfo, SolidKind};

/// The scene at one state.
///
/// `q` are the coordinates (then speeds and reactions, which are ignored), `u` the inputs, `b` the design variables;
/// all SI.
///
/// ```
/// use eigentol::picture::{Shape, scene};
/// use eigentol::mechanism;
///
/// mechanism! {
///     mechanism Pendulum {
///         design l = 2.0 m;
///         gravity 9.81 m/s^2 along -z;
///         body bar: rod(mass: 3 kg, length: l, along: -z);
///         joint theta: revolute(y) from ground to bar;
///     }
/// }
///
/// let scene = scene(&Pendulum, &[std::f64::consts::FRAC_PI_2], &[], &[2.0])?;
/// let bar = &scene.bodies[0];
/// let Shape::Rod { along, length } = bar.solids[0].shape else { panic!("it is a rod") };
/// let end = bar.pose.place(along.map(|component| component * length));
/// assert!((end[0] + 2.0).abs() < 1e-15 && end[2].abs() < 1e-15);
/// # Ok::<(), eigentol::Error>(())
/// ```
///
/// # Errors
/// [`Error::WrongLength`]; [`Error::OutsideDomain`] if a number is not finite.
pub fn scene(mechanism: &dyn PictureKernels, q: &[f64], u: &[f64], b: &[f64]) -> Result<Scene, Error> {
    let info = &*mechanism.picture_info();
    let mut numbers = Numbers::new(mechanism, info, q, u, b)?;
    let mut poses = numbers.poses(info).into_iter();
    let bodies = info.bodies.iter().zip(poses.by_ref().take(info.bodies.len()));
    let bodies = bodies.map(|(body, pose)| Body {
        name: body.name.clone(),
        pose,
        solids: body.solids.iter().map(|&solid| numbers.solid(solid)).collect(),
    });
    let bodies = bodies.collect();
    let beams = info.beams.iter().map(|beam| {
        let sections = poses.by_ref().take(beam.sections as usize);
        let sections = sections.map(|pose| Section { pose, size: numbers.take() });
        Beam { name: beam.name.clone(), round: beam.round, sections: sections.collect() }
    });
    let beams = beams.collect();
    let joints = info.joints.iter().map(|joint| {
        let [from, to] = [joint.from, joint.to].map(|body| numbers.seat(body));
        Joint {
            name: joint.name.clone(),
            kind: joint.kind.clone(),
            from,
            to,
            closes_loop: joint.cut,
            driven: joint.driven,
        }
    });
    let joints = joints.collect();
    let points = info.points.iter().map(|point| Point {
        name: point.name.clone(),
        body: place(point.body),
        place: numbers.take(),
    });
    let points = points.collect();
    let links = info.links.iter().map(|link| Link {
        name: link.name.clone(),
        kind: link.kind.clone(),
        ends: link.ends.map(|end| end as usize),
    });
    let wheels = info.wheels.iter().map(|wheel| {
        let [radius] = numbers.take();
        Wheel {
            name: wheel.name.clone(),
            center: wheel.center as usize,
            axle: direction(numbers.take()),
            radius,
            on: wheel.on as usize,
            normal: numbers.take(),
        }
    });
    let wheels = wheels.collect();
    let gravity = numbers.take();
    let elements = info.elements.iter().map(|element| Element {
        name: element.name.clone(),
        kind: element.kind.clone(),
        law: element.law.clone(),
    });
    let mut scene = Scene {
        bodies,
        beams,
        joints,
        points,
        links: links.collect(),
        wheels,
        elements: elements.collect(),
        gravity: direction(gravity),
        bounds: [[0.0; 3]; 2],
    };
    scene.bounds = bounds(&scene);
    Ok(scene)
}

/// The poses of all bodies, then of the sections of all beams, at one state.
pub(super) fn poses(mechanism: &dyn PictureKernels, q: &[f64], u: &[f64], b: &[f64]) -> Result<Vec<Pose>, Error> {
    let info = &*mechanism.picture_info();
    let mut numbers = Numbers::new(mechanism, info, q, u, b)?;
    Ok(numbers.poses(info))
}

/// The numbers of a picture that are still unread.
struct Numbers {
    rest: std::vec::IntoIter<f64>,
}

impl Numbers {
    fn new(mechanism: &dyn PictureKernels, info: &PictureInfo, q: &[f64], u: &[f64], b: &[f64]) -> Result<Self, Error> {
        let description: &Description = &mechanism.description();
        check_count("coordinates", q, description.coordinates.len())?;
        check_count("inputs", u, description.inputs.len())?;
        check_count("design variables", b, description.design.len())?;
        let mut computed = vec![0.0; info.computed.len()];
        mechanism.picture_into(q, u, b, &mut computed);
        if !all_finite(&computed) {
            return Err(Error::OutsideDomain {
                mechanism: description.name.clone(),
                what: "the picture",
                coordinates: q.to_vec(),
            });
        }
        let mut all = info.numbers.to_vec();
        for (&index, value) in info.computed.iter().zip(computed) {
            if let Some(number) = all.get_mut(index as usize) {
                *number = value;
            }
        }
        let rest = all.into_iter();
        Ok(Self { rest })
    }

    /// Takes the next numbers; zeros after the last.
    fn take<const N: usize>(&mut self) -> [f64; N] {
        core::array::from_fn(|_| self.rest.next().unwrap_or_default())
    }

    fn three<const N: usize>(&mut self) -> [[f64; N]; 3] {
        core::array::from_fn(|_| self.take())
    }

    /// The poses of all bodies, then of the sections of all beams.
    fn poses(&mut self, info: &PictureInfo) -> Vec<Pose> {
        let count = info.bodies.len() + info.beams.iter().map(|beam| beam.sections as usize).sum::<usize>();
        (0..count).map(|_| self.pose()).collect()
    }

    fn pose(&mut self) -> Pose {
        Pose { position: self.take(), rotation: self.three() }
    }

    fn seat(&mut self, body: Option<u32>) -> Seat {
        Seat { body: place(body), place: self.take(), axis: direction(self.take()) }
    }

    fn solid(&mut self, solid: SolidInfo) -> Solid {
        let center = self.take();
        let shape = match solid.kind {
            SolidKind::Point => {
                let [mass] = self.take();
                Shape::Point { mass }
            }
            SolidKind::Rod => {
                let (along, [length]) = (self.take(), self.take());
                Shape::Rod { along, length }
            }
            SolidKind::Disk => {
                let (axis, [radius]) = (self.take(), self.take());
                Shape::Disk { axis, radius }
            }
            SolidKind::Cylinder => {
                let (axis, [radius, length]) = (self.take(), self.take());
                Shape::Cylinder { axis, radius, length }
            }
            SolidKind::Tube => {
                let (axis, [inner, outer, length]) = (self.take(), self.take());
                Shape::Tube { axis, inner, outer, length }
            }
            SolidKind::Box => Shape::Box { edges: self.three(), size: self.take() },
            SolidKind::Sphere => {
                let [radius] = self.take();
                Shape::Sphere { radius }
            }
            SolidKind::Rigid => {
                let (frame, [mass]) = (self.three(), self.take());
                let (inertia, about) = (self.take(), self.take());
                ellipsoid(frame, mass, inertia, about)
            }
        };
        Solid { center, shape, hole: solid.hole }
    }
}

fn place(body: Option<u32>) -> Option<usize> {
    body.map(|body| body as usize)
}

/// A vector; `None` if it is zero.
fn direction(vector: [f64; 3]) -> Option<[f64; 3]> {
    (vector != [0.0; 3]).then_some(vector)
}
