//! The appearance of a mechanism, at rest, in its modes and in forced vibration: positions and shapes of bodies, joints,
//! points and forces.

mod ellipsoid;
mod extent;
mod read;
mod scene;
mod vibration;

pub use read::scene;
pub use scene::{
    Beam, Body, Element, Joint, Link, ModePictures, Point, Pose, Scene, Seat, Section, Shape, Solid, VibrationPictures,
    Wheel,
};
pub use vibration::{mode_pictures, vibration_pictures};
