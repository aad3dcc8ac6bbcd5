//! Bad values, distant starts, critical states and extreme scales on compiled machines: each gives a typed error or a
//! reported class, never NaN, a panic or a wrong answer.

mod extremes;
mod failure;
mod sampling;
mod scales;
mod sound;
mod states;
mod values;
mod wild;
