//! General modes, whirl, critical speeds and onsets of instability of machines with closed forms, through the public
//! interface.

mod common;
mod film;
mod follower;
mod following;
mod real_roots;
mod rotors;
mod shaft_frame;
mod sleeping_top;
mod tops;
