//! Harmonic excitations: what shakes a mechanism about its steady motion.

use proc_macro2::Ident;

use super::expression::{Expr, Vector};
use crate::base::ids::{BodyId, CoordinateId, PointId};

/// A harmonic excitation. It does not change the steady motion.
#[derive(Clone, Debug)]
pub struct Excitation {
    /// Declared name; of a shaken coordinate, the coordinate's.
    pub name: Ident,
    /// What it does.
    pub law: ExcitationLaw,
    /// Its frequency.
    pub frequency: Frequency,
    /// Phase at time zero, rad; of an unbalance, its angle.
    pub phase: Expr,
}

/// What an excitation does at phase zero.
#[derive(Clone, Debug)]
pub enum ExcitationLaw {
    /// A turning body deviates from symmetry about its axis.
    Unbalance {
        /// The body.
        body: BodyId,
        /// Where, in the body's frame.
        at: Vector,
        /// How.
        deviation: Deviation,
    },
    /// A force and a moment on a body at a point, in the ground's axes, times `cos(w t + phase)`.
    Load {
        /// The point of application.
        point: PointId,
        /// N.
        force: Vector,
        /// N m.
        moment: Vector,
    },
    /// A force along a coordinate, times `cos(w t + phase)`.
    Generalized {
        /// The coordinate.
        coordinate: CoordinateId,
        /// N m or N.
        value: Expr,
    },
    /// A coordinate is moved: its displacement, velocity or acceleration is `amplitude cos(w t + phase)`.
    Shaken {
        /// The coordinate.
        coordinate: CoordinateId,
        /// Which of them.
        measure: ShakenBy,
        /// Its amplitude, SI.
        amplitude: Expr,
    },
}

/// How a body deviates from symmetry about the axis about which it turns.
#[derive(Clone, Debug)]
pub enum Deviation {
    /// An additional first moment of mass, kg m.
    Amount(Expr),
    /// Distance of the centre of mass from the axis, m, besides what the shapes say.
    Eccentricity(Expr),
    /// Rotation of the body's inertia about the centre of mass, rad, that leaves the body's axis in place.
    Tilt(Expr),
}

/// The quantity that is given of a shaken coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShakenBy {
    /// m or rad.
    Displacement,
    /// m/s or rad/s.
    Velocity,
    /// m/s^2 or rad/s^2.
    Acceleration,
}

/// The frequency of an excitation.
#[derive(Clone, Debug)]
pub enum Frequency {
    /// A value, rad/s.
    Own(Expr),
    /// A multiple of the speed of a driven or coasting coordinate.
    Order(Expr, CoordinateId),
    /// The rate at which its body turns.
    OfTurning,
}
