//! Kinds of machines: joints, loops, wheels, robots, free directions, and their pictures.

mod blades;
mod free_directions;
mod free_machines;
mod loops;
mod machines;
mod pictures;
mod reduced;
mod robots;
mod scales;
mod special_cases;
mod turning_planes;
mod wheels;
