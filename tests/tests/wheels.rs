//! Wheels that roll without slip: the bicycle benchmark, and mechanisms with closed forms.

#[path = "wheels/bicycle.rs"]
mod bicycle;
#[path = "wheels/coasting_critical.rs"]
mod coasting_critical;
#[path = "wheels/common.rs"]
mod common;
#[path = "wheels/events.rs"]
mod events;
#[path = "wheels/free.rs"]
mod free;
#[path = "wheels/mechanisms.rs"]
mod mechanisms;
#[path = "wheels/motion.rs"]
mod motion;
#[path = "wheels/projection.rs"]
mod projection;
#[path = "wheels/spreads.rs"]
mod spreads;
