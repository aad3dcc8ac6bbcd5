//! Mechanisms with closed loops and couplings against reference solutions in minimal coordinates (`truth/loops.json`).

mod along;
mod assembly;
mod common;
mod folded;
mod gear_train;
mod kernels;
mod redundant;
mod signs;
mod singular_start;
mod spreads;
mod study;
mod toggles;
mod unloaded;
