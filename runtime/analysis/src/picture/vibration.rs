//! Modes and forced vibrations as poses over one period.

use super::extent::dot;
use super::read::{poses, scene};
use super::scene::{ModePictures, Pose, Scene, VibrationPictures};
use crate::constraints::Structure;
use crate::equilibrium::assemble;
use crate::forced::Harmonic;
use crate::kernels::PictureKernels;
use crate::{Complex, Equilibrium, Error, Modes};

/// Step, rad or m, for differencing displacements along a mode.
const STEP: f64 = 1e-4;
/// Smaller displacements, relative to the size of the mechanism, are rounding: the body stands still.
const STILL: f64 = 1e-12;
/// Maximum rotation of a body or a section to either side, rad: the rotation is the only visible motion of a slender
/// shaft in torsion.
const MOST_TURN: f64 = 0.5;

/// Poses of all bodies, then of the sections of all beams, over one period of mode `mode` (counted from 0): at
/// `q* + a Re(phi e^(i theta))` for `phases` evenly spaced phases `theta`, the first at zero.
///
/// The factor `a` is chosen such that, to first order, the largest displacement to either side is the fraction
/// `amplitude` of the size of the mechanism ([`Scene::size`]; a metre if the size is zero), and no body rotates by more
/// than half a radian. Growth and decay are not shown. Loops are closed: coordinates move to the nearest point that
/// satisfies the position constraints, and stay if none is found.
///
/// # Errors
/// [`Error::NoSuchMode`], [`Error::WrongLength`], [`Error::OutsideDomain`]; [`Error::Setting`] for an amplitude that is
/// negative or not finite.
pub fn mode_pictures(
    mechanism: &dyn PictureKernels,
    at: &Equilibrium,
    modes: &Modes,
    mode: usize,
    phases: usize,
    amplitude: f64,
) -> Result<ModePictures, Error> {
    let Some(chosen) = modes.modes.get(mode) else {
        return Err(Error::NoSuchMode { mode, count: modes.modes.len() });
    };
    let (amplitude, frames) = over_a_period(mechanism, at, &chosen.shape, phases, amplitude)?;
    Ok(ModePictures { mode, amplitude, frames })
}

/// Poses of all bodies, then of the sections of all beams, over one period of a forced vibration: the operating
/// deflection shape, at `q* + a Re(z e^(i theta))` with the amplitudes `z` of its coordinates, enlarged or reduced by
/// the factor `a` as modes are ([`mode_pictures`]).
///
/// # Errors
/// As [`mode_pictures`].
pub fn vibration_pictures(
    mechanism: &dyn PictureKernels,
    at: &Equilibrium,
    harmonic: &Harmonic,
    phases: usize,
    amplitude: f64,
) -> Result<VibrationPictures, Error> {
    let shape = &harmonic.unknowns;
    let (enlargement, frames) = over_a_period(mechanism, at, shape, phases, amplitude)?;
    Ok(VibrationPictures { frequency: harmonic.frequency, enlargement, frames })
}

/// The factor of a shape and the poses over one period of its motion.
fn over_a_period(
    mechanism: &dyn PictureKernels,
    at: &Equilibrium,
    shape: &[Complex],
    phases: usize,
    amplitude: f64,
) -> Result<(f64, Vec<Vec<Pose>>), Error> {
    if !(amplitude >= 0.0 && amplitude.is_finite()) {
        return Err(Error::setting(
            "amplitude",
            format!("it has to be a share of the size of the mechanism, not {amplitude}"),
        ));
    }
    let structure = Structure::of(&mechanism.description());
    let shape: Vec<Complex> = (shape.iter().enumerate())
        .map(|(k, &value)| if k < structure.coordinates { value } else { Complex::ZERO })
        .collect();
    let motion = Motion { mechanism, at, closes: structure.position_constraints > 0 };
    let factor = motion.factor(&shape, amplitude)?;
    let frames = (0..phases).map(|k| {
        let angle = core::f64::consts::TAU * k as f64 / phases as f64;
        motion.poses(&shape, Complex::from_polar(factor, angle))
    });
    Ok((factor, frames.collect::<Result<_, _>>()?))
}

/// States about an equilibrium.
struct Motion<'a> {
    mechanism: &'a dyn PictureKernels,
    at: &'a Equilibrium,
    closes: bool,
}

impl Motion<'_> {
    /// Poses at `q* + Re(factor shape)`.
    fn poses(&self, shape: &[Complex], factor: Complex) -> Result<Vec<Pose>, Error> {
        let Equilibrium { coordinates, inputs, design, .. } = self.at;
        let moved = coordinates.iter().zip(shape);
        let moved: Vec<f64> = moved.map(|(q, phi)| q + (factor * phi).re).collect();
        let closed = if self.closes { assemble(self.mechanism, inputs, design, &moved, &[]).ok() } else { None };
        let q = closed.as_ref().map_or(&*moved, |state| &*state.coordinates);
        poses(self.mechanism, q, inputs, design)
    }

    /// The shape factor for which the mechanism moves by the fraction `share` of its size.
    fn factor(&self, shape: &[Complex], share: f64) -> Result<f64, Error> {
        let largest = shape.iter().fold(0.0, |most: f64, c| most.max(c.norm()));
        if largest == 0.0 || share == 0.0 {
            return Ok(0.0);
        }
        let scene = scene(self.mechanism, &self.at.coordinates, &self.at.inputs, &self.at.design)?;
        let size = match scene.size() {
            0.0 => 1.0,
            size => size,
        };
        let step = STEP / largest;
        let open = Self { closes: false, ..*self };
        let either = |factor: Complex| -> Result<[Vec<Pose>; 2], Error> {
            Ok([open.poses(shape, factor)?, open.poses(shape, -factor)?])
        };
        // Re(h phi) and Re(i h phi) are the displacements a quarter of a period apart.
        let (first, second) = (either(Complex::new(step, 0.0))?, either(Complex::new(0.0, step))?);
        let travel = farthest(&scene, |body, point| {
            [&first, &second].map(|[ahead, behind]| {
                let (ahead, behind) = (ahead[body].place(point), behind[body].place(point));
                core::array::from_fn(|i| (ahead[i] - behind[i]) / 2.0)
            })
        });
        if travel <= STILL * size {
            return Ok(0.0);
        }
        let turn = (0..scene.poses())
            .map(|pose| semi_major([&first, &second].map(|[a, b]| turned(&a[pose], &b[pose]))))
            .fold(0.0, f64::max);
        let by_turn = if turn > 0.0 { MOST_TURN / turn } else { f64::INFINITY };
        Ok(step * (share * size / travel).min(by_turn))
    }
}

/// The largest displacement of the visible parts of bodies and beams; `displaced` gives the
/// displacements of a place on a body, or on a section after all bodies, at two phases a quarter of a period apart.
fn farthest(scene: &Scene, displaced: impl Fn(usize, [f64; 3]) -> [[f64; 3]; 2]) -> f64 {
    let solids = scene
        .bodies
        .iter()
        .enumerate()
        .flat_map(|(body, parts)| parts.solids.iter().flat_map(|solid| solid.tips()).map(move |tip| (body, tip)));
    let seats = scene.joints.iter().flat_map(|joint| [joint.from, joint.to]);
    let seats = seats.map(|seat| (seat.body, seat.place));
    let points = scene.points.iter().map(|point| (point.body, point.place));
    let fixed = seats.chain(points).filter_map(|(body, point)| Some((body?, point)));
    // Two corners of a section, which move where it only twists.
    let sections = scene.beams.iter().flat_map(|beam| &beam.sections).zip(scene.bodies.len()..);
    let sections = sections.flat_map(|(section, pose)| {
        let [width, height] = section.size.map(|size| 0.5 * size);
        [[0.0; 3], [0.0, width, height], [0.0, width, -height]].map(|corner| (pose, corner))
    });
    solids.chain(fixed).chain(sections).map(|(body, point)| semi_major(displaced(body, point))).fold(0.0, f64::max)
}

/// Half of the rotation from one pose to the other, as a vector, to second order.
fn turned(ahead: &Pose, behind: &Pose) -> [f64; 3] {
    let rows = (ahead.rotation, behind.rotation);
    // The antisymmetric part of `ahead behind^T`.
    let entry = |i: usize, j: usize| dot(rows.0[i], rows.1[j]);
    [(2, 1), (0, 2), (1, 0)].map(|(i, j)| (entry(i, j) - entry(j, i)) / 4.0)
}

/// The larger semi-axis of the ellipse `x cos + y sin`.
fn semi_major([x, y]: [[f64; 3]; 2]) -> f64 {
    let (xx, yy, xy) = (dot(x, x), dot(y, y), dot(x, y));
    let radius = ((xx - yy) / 2.0).hypot(xy);
    ((xx + yy) / 2.0 + radius).sqrt()
}
