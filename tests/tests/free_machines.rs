//! Machines that nothing holds in some direction, against reference values (`truth/practice`), in any coordinates.

#[path = "free_machines/along.rs"]
mod along;
#[path = "free_machines/common.rs"]
mod common;
#[path = "free_machines/families.rs"]
mod families;
#[path = "free_machines/members.rs"]
mod members;
#[path = "free_machines/random.rs"]
mod random;
#[path = "free_machines/reference.rs"]
mod reference;
#[path = "free_machines/unstable.rs"]
mod unstable;
