//! The appearance of a mechanism, at rest and in its modes: positions and shapes of bodies, joints, points and forces.

mod ellipsoid;
mod extent;
mod read;
mod scene;
mod vibration;

pub use read::scene;
pub use scene::{
    Body, Element, Joint, Link, ModePictures, Point, Pose, Scene, Seat, Shape, Solid, Wheel,
};
pub use vibration::mode_pictures;
