//! Beams against the oracle, which knows them as slices on flexures and differentiates their kinematics in dual numbers,
//! and against what must hold whatever the equations are.

mod curved;
mod judged;
mod moving;
mod objective;
mod offset;
mod outputs;
mod random;
mod special;
mod spinning;
