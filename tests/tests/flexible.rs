//! Beams against the oracle, which knows them as slices on flexures and differentiates their kinematics in dual numbers,
//! and against what must hold whatever the equations are.

#[path = "flexible/curved.rs"]
mod curved;
#[path = "flexible/judged.rs"]
mod judged;
#[path = "flexible/moving.rs"]
mod moving;
#[path = "flexible/objective.rs"]
mod objective;
#[path = "flexible/offset.rs"]
mod offset;
#[path = "flexible/outputs.rs"]
mod outputs;
#[path = "flexible/random.rs"]
mod random;
#[path = "flexible/special.rs"]
mod special;
#[path = "flexible/spinning.rs"]
mod spinning;
