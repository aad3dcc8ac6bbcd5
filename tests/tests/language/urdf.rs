//! Robots imported from URDF files agree with Pinocchio: three files in this repository, the robots of `truth/robots`,
//! and every file of the package example-robot-data if Python has it. `EIGENTOL_PYTHON` names an interpreter that can
//! import `pinocchio` and has that package installed (`pip install pin example-robot-data`).

mod files;
mod package;
mod reference;
mod table;
