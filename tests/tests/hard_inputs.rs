//! Bad values, distant starts, critical states and extreme scales on compiled machines: each gives a typed error or a
//! reported class, never NaN, a panic or a wrong answer.

#[path = "hard_inputs/extremes.rs"]
mod extremes;
#[path = "hard_inputs/failure.rs"]
mod failure;
#[path = "hard_inputs/sampling.rs"]
mod sampling;
#[path = "hard_inputs/scales.rs"]
mod scales;
#[path = "hard_inputs/sound.rs"]
mod sound;
#[path = "hard_inputs/states.rs"]
mod states;
#[path = "hard_inputs/values.rs"]
mod values;
#[path = "hard_inputs/wild.rs"]
mod wild;
