//! Data for the 3-D view: a scene, and the poses of each mode and each forced vibration over one period.

use std::f64::consts::TAU;

use eigentol::picture::{ModePictures, Pose, Scene, VibrationPictures};
use eigentol::{Description, Mode, Modes};
use eigentol_figures::Style;
use serde::Serialize;

use crate::forced::{excitations, harmonics};
use crate::pictures::Pictures;
use crate::words::{capital, digits, number};

/// A scene with its motions, passed to the script.
#[derive(Serialize)]
pub(crate) struct View<'a> {
    scene: &'a Scene,
    /// The upward direction.
    up: [f64; 3],
    /// Modes, then forced vibrations.
    motions: Vec<Motion>,
}

#[derive(Serialize)]
struct Motion {
    title: String,
    about: String,
    /// For each phase, the poses of all bodies and sections of beams: twelve numbers each, position and rows of the
    /// rotation.
    frames: Vec<Vec<f64>>,
}

impl<'a> View<'a> {
    pub(crate) fn new(pictures: &'a Pictures, d: &Description, modes: Option<&Modes>, style: &Style) -> Self {
        let scene = &pictures.scene;
        let size = scene.size();
        let motion = |mode_pictures: &ModePictures| {
            let mode = modes?.modes.get(mode_pictures.mode)?;
            let frames = mode_pictures.frames.iter().map(|poses| flat(poses, size));
            Some(Motion {
                title: title(mode, d, style),
                about: about(mode, mode_pictures.amplitude, &style.frequency(d).1),
                frames: frames.collect(),
            })
        };
        let vibrations = harmonics(d).into_iter().zip(&pictures.vibrations);
        let forced = vibrations.filter_map(|(excitation, item)| {
            let own = item.as_ref().ok()?;
            let (scale, unit) = style.frequency(d);
            let frequency = number(scale * own.frequency);
            Some(Motion {
                title: format!("Under {}: {frequency} {unit}", excitations(d, excitation)),
                about: enlarged(own),
                frames: own.frames.iter().map(|poses| flat(poses, size)).collect(),
            })
        });
        let modes = pictures.modes.iter().flatten().filter_map(motion);
        Self { scene, up: scene.up(), motions: modes.chain(forced).collect() }
    }
}

/// Flattens poses and rounds them to four decimals of the size, finer than a screen can show.
fn flat(poses: &[Pose], size: f64) -> Vec<f64> {
    let power = if size > 0.0 { 4 - size.log10().floor() as i32 } else { 4 };
    // An integer over a power of ten is the number nearest to a short decimal.
    let round = |value: f64, power: i32| {
        let (up, down) = (10_f64.powi(power.max(0)), 10_f64.powi((-power).max(0)));
        (value * up / down).round() * down / up
    };
    poses
        .iter()
        .flat_map(|pose| {
            let position = pose.position.map(|value| round(value, power));
            let rotation = pose.rotation.as_flattened().to_vec();
            position.into_iter().chain(rotation.into_iter().map(|value| round(value, 4)))
        })
        .collect()
}

fn title(mode: &Mode, d: &Description, style: &Style) -> String {
    let name = capital(&style.mode(mode.label));
    let (scale, unit) = style.frequency(d);
    match mode.frequency() {
        Some(omega) => format!("{name}: {} {unit}", number(scale * omega)),
        None => format!("{name}: {}", mode.behaviour),
    }
}

fn enlarged(vibration_pictures: &VibrationPictures) -> String {
    match vibration_pictures.enlargement {
        0.0 => "forced vibration; it moves no body".to_owned(),
        factor => format!("forced vibration, enlarged {} times, not in real time", digits(factor, 3)),
    }
}

fn about(mode: &Mode, amplitude: f64, unit: &str) -> String {
    if amplitude == 0.0 {
        return format!("{}; it moves no body", mode.behaviour);
    }
    let damping = mode.damping_ratio().filter(|ratio| *ratio != 0.0 && mode.frequency().is_some());
    let damping = damping.map_or_else(String::new, |ratio| format!(", damping ratio {}", number(ratio)));
    let pace = match mode.frequency() {
        // The title has the other one.
        Some(omega) if unit == "Hz" => format!("{} rad/s, ", number(omega)),
        Some(omega) => format!("{} Hz, ", number(omega / TAU)),
        None => String::new(),
    };
    if mode.frequency().is_none() {
        return "shown as if it oscillated, not in real time".to_owned();
    }
    format!("{pace}{}{damping}; shown at constant amplitude, not in real time", mode.behaviour)
}
