//! Beams against the oracle, which knows them as slices on flexures and differentiates their kinematics in dual numbers,
//! and against what must hold whatever the equations are.

#[path = "flexible/judged.rs"]
mod judged;
#[path = "flexible/random.rs"]
mod random;
