//! General modes, whirl, critical speeds and onsets of instability of machines with closed forms, through the public
//! interface.

#[path = "spectra/common.rs"]
mod common;
#[path = "spectra/film.rs"]
mod film;
#[path = "spectra/follower.rs"]
mod follower;
#[path = "spectra/following.rs"]
mod following;
#[path = "spectra/real_roots.rs"]
mod real_roots;
#[path = "spectra/rotors.rs"]
mod rotors;
#[path = "spectra/shaft_frame.rs"]
mod shaft_frame;
#[path = "spectra/sleeping_top.rs"]
mod sleeping_top;
#[path = "spectra/tops.rs"]
mod tops;
