//! Mechanisms with closed loops and couplings against their references in minimal coordinates (`truth/loops.json`).

#[path = "loops/common.rs"]
mod common;
#[path = "loops/kernels.rs"]
mod kernels;
#[path = "loops/study.rs"]
mod study;
