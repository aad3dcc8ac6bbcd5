//! Forced vibration of declared machines: closed forms, a rigid rotor, bands against designs solved anew.

mod bands;
mod closed_forms;
mod exceedance;
mod extents;
mod followed;
mod requirements;
mod rigid_rotor;
mod rough;
mod shares;
mod side_by_side;
