//! How the bodies move.

mod beam;
mod bend;
mod frame;
mod kinematics;
mod orientation;
mod recursions;
mod step_axis;
mod strain;
mod tree;
mod turned;
mod turning;
mod unbent;
mod wrench;

pub(super) use beam::{BeamMotion, StationMotion};
pub(super) use bend::{bend, bend_powers};
pub(crate) use frame::FrameMotion;
pub(super) use frame::second_rate;
pub(super) use kinematics::{BodyMotion, Kinematics, PointMotion};
pub(super) use recursions::{for_inertia, for_inertia_at_rest, in_common_frame, in_common_frame_at_zero};
pub(super) use step_axis::StepAxis;
pub(super) use strain::{headings, strains, turned};
pub(super) use tree::Tree;
pub(super) use turning::turning;
pub(super) use unbent::{curved, offset, unbent};
pub(super) use wrench::Wrench;
