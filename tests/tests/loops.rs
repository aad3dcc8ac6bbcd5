//! Mechanisms with closed loops and couplings against reference solutions in minimal coordinates (`truth/loops.json`).

#[path = "loops/along.rs"]
mod along;
#[path = "loops/assembly.rs"]
mod assembly;
#[path = "loops/common.rs"]
mod common;
#[path = "loops/folded.rs"]
mod folded;
#[path = "loops/gear_train.rs"]
mod gear_train;
#[path = "loops/kernels.rs"]
mod kernels;
#[path = "loops/redundant.rs"]
mod redundant;
#[path = "loops/signs.rs"]
mod signs;
#[path = "loops/singular_start.rs"]
mod singular_start;
#[path = "loops/spreads.rs"]
mod spreads;
#[path = "loops/study.rs"]
mod study;
#[path = "loops/toggles.rs"]
mod toggles;
#[path = "loops/unloaded.rs"]
mod unloaded;
