//! Beams whose stiffness seems to be given in the wrong plane.

use proc_macro2::Ident;

use super::evaluate::Values;
use super::mechanism::{Beam, Mechanism, Section};

/// Ratios this close to one say nothing.
const ALIKE: f64 = 1e-6;

/// A beam whose section is extended more in one direction and stiffer in the other, in the nominal design.
#[derive(Clone, Debug)]
pub struct Exchanged {
    /// The beam.
    pub beam: Ident,
    /// What contradicts what.
    pub message: String,
}

impl Exchanged {
    /// What to look at.
    pub const HELP: &str = "bending about y moves the beam along `up`: its stiffness takes the height to the third power. Exchange the \
                            stiffnesses, or write `#[allow(deprecated)]` above the mechanism if they are meant";
}

impl Mechanism {
    /// Beams given by numbers whose two bending stiffnesses seem to be exchanged: the lower one is about the axis from
    /// which the section extends, or has its inertia, farther. Nothing is said where a number depends on an input.
    pub fn exchanged(&self) -> Vec<Exchanged> {
        let design: Vec<f64> = self.design.iter().map(|value| value.nominal).collect();
        let values = Values::new(&self.constants, &[], &design);
        let mut list: Vec<Exchanged> = Vec::new();
        for beam in &self.beams {
            if list.iter().any(|x| x.beam == beam.whole) {
                continue;
            }
            let Some(contradiction) = contradiction(&values, beam) else {
                continue;
            };
            let message = format!("`{}` {contradiction}", beam.whole);
            let beam = beam.whole.clone();
            list.push(Exchanged { beam, message });
        }
        list
    }
}

fn contradiction(values: &Values<'_>, beam: &Beam) -> Option<String> {
    let mut sections = beam.sections.iter().map(|(_, _, section)| section);
    sections.find_map(|section| {
        let Section {
            stiffness: [_, about_y, about_z], inertia: [inertia_y, inertia_z], size: [width, height], ..
        } = section;
        let ratio = |a, b| {
            let (a, b) = (values.of(a), values.of(b));
            (a > 0.0 && b > 0.0).then(|| (a / b).ln())
        };
        let stiffness = ratio(about_y, about_z)?;
        let evidence = [
            (ratio(height, width), "its height", "its width"),
            (ratio(inertia_y, inertia_z), "`inertia_y`", "`inertia_z`"),
        ];
        evidence.into_iter().find_map(|(ratio, y, z)| {
            let ratio = ratio?;
            let is_clear = stiffness.abs() > ALIKE && ratio.abs() > ALIKE;
            let (stiffer, larger, smaller) = if ratio > 0.0 { ('z', y, z) } else { ('y', z, y) };
            (is_clear && stiffness * ratio < 0.0)
                .then(|| format!("is stiffer about {stiffer}, although {larger} is greater than {smaller}"))
        })
    })
}
