//! The pieces of curves, as constants next to the methods.
//!
//! ```text
//! const PIECES_OF_kxx: [[f64; 5]; 4] = [[..], ..];
//! ```

use std::fmt::Write;

use crate::algebra::Unary;
use crate::program::{Operation, Program};
use eigentol_symbolic::base::spline::Spline;

use super::expression::pieces_of;

/// One constant for each curve that some kernel uses.
pub(super) fn constants(program: &Program) -> String {
    let mut text = String::new();
    for spline in used(program) {
        let (name, pieces) = (pieces_of(spline), spline.pieces());
        let _ = writeln!(
            text,
            "#[allow(non_upper_case_globals, clippy::all, clippy::pedantic)]
            const {name}: [[f64; 5]; {}] = {pieces:?};",
            pieces.len()
        );
    }
    text
}

/// The curves in use, ordered by name.
fn used(program: &Program) -> Vec<Spline> {
    let kernels = program.kernels.iter();
    let mut used: Vec<Spline> = kernels
        .flat_map(|kernel| &kernel.instructions)
        .filter_map(|instruction| match instruction.operation {
            Operation::Unary(Unary::Spline(spline, _), _) => Some(spline),
            _ => None,
        })
        .collect();
    used.sort_unstable();
    used.dedup();
    used
}
