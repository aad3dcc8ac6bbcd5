//! Pictures of a mechanism against the oracle's matrices, closed forms, outputs and robot files.

#[path = "pictures/beams.rs"]
mod beams;
#[path = "pictures/closed_forms.rs"]
mod closed_forms;
#[path = "pictures/joints.rs"]
mod joints;
#[path = "pictures/modes.rs"]
mod modes;
#[path = "pictures/oracle.rs"]
mod oracle;
#[path = "pictures/robots.rs"]
mod robots;
#[path = "pictures/space.rs"]
mod space;
