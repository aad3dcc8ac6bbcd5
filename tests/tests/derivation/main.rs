//! The equations that the compiler derives: against the oracle, the interpreter, dual numbers and closed forms.

mod agreement;
mod consistency;
mod cut_loops;
mod generated_code;
mod interpreted;
mod rederived;
mod side_by_side;
