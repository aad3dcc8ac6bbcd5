//! Wheels that roll without slip: the bicycle benchmark, and mechanisms with closed forms.

mod bicycle;
mod coasting_critical;
mod common;
mod events;
mod free;
mod mechanisms;
mod motion;
mod projection;
mod spreads;
