//! What a mechanism looks like, at rest and in its modes: where bodies are, what they are made of, where joints, points and forces
//! are.

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
