//! Shafts: straight, round, of many sections, small motions about a line that does not move.

use proc_macro2::Ident;

use super::expression::{Expr, Vector};
use crate::base::ids::{BodyId, CoordinateId, JointId};

/// A stepped shaft. What is at its stations has coordinates; all between them is eliminated at run time.
#[derive(Clone, Debug)]
pub struct Shaft {
    /// Declared name.
    pub name: Ident,
    /// Unit vectors in the ground: along the shaft, across and up.
    pub axes: [Vector; 3],
    /// Speed at which it turns about its line, rad/s.
    pub speed: Expr,
    /// Length, m, and mass, kg, of each section.
    pub weights: Vec<[Expr; 2]>,
    /// How it is seen: cross-sections from the root to the tip, linear between, two where the diameter jumps.
    pub outline: Vec<CrossSection>,
    /// Its stations in order; the first is at the root, the last at the tip.
    pub stations: Vec<ShaftStation>,
    /// What bends, twists or stretches between neighbouring stations.
    pub spans: Vec<Span>,
    /// What must be positive in any design, and its values.
    pub positive: Vec<(String, Expr)>,
}

/// A cross-section of a shaft as it is seen.
#[derive(Clone, Debug)]
pub struct CrossSection {
    /// Number of the station before it; the next one is not before it.
    pub station: usize,
    /// Its place between the two, from 0 to 1.
    pub fraction: Expr,
    /// Outer diameter, m; zero where the shaft is known by numbers only.
    pub diameter: Expr,
}

/// A place of a shaft or a superelement with a frame of its own, which does not spin.
#[derive(Clone, Debug)]
pub struct ShaftStation {
    /// How many sections are before it, or of a superelement how many stations.
    pub place: usize,
    /// The massless body that moves with it.
    pub body: BodyId,
    /// Its small motions against the ground.
    pub joint: JointId,
    /// The coordinates of these: across, up, about across, about up, along, about the shaft; of a superelement along and about
    /// x, y and z; none where it is rigid.
    pub coordinates: [Option<CoordinateId>; 6],
}

/// What a part of a shaft between two stations does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// Bends and shears (Timoshenko).
    Timoshenko,
    /// Bends without shear (Rayleigh).
    Slender,
    /// Twists or stretches.
    Bar,
}

/// The numbers of a section of a line.
pub const NUMBERS: usize = 8;

/// The inertia of a slope of a uniform span, as a part of its mass times the square of its length.
pub const LUMPED: f64 = 1.0 / 52.5;

/// A line of a part of a shaft between two stations.
#[derive(Clone, Debug)]
pub struct Span {
    /// What it does.
    pub line: Line,
    /// Speed at which its material turns, rad/s.
    pub speed: Expr,
    /// For each section its length; stiffness against bending, twist or stretch; against shear; mass, or inertia about the
    /// axis, and inertia about a diameter, of a length; lag; tension; drag.
    pub sections: Vec<[Expr; NUMBERS]>,
    /// Into how many equal elements each section is divided.
    pub elements: Vec<usize>,
    /// The coordinates of its ends, each with the factor that makes it a motion along the second axis, a slope towards it,
    /// and the same of the third; of a bar one only.
    pub ends: [Vec<(CoordinateId, f64)>; 2],
}
