//! Finds coordinates that nothing resists, from the equations.

use eigentol_compiler::mechanics::{Limits, Role};
use eigentol_compiler::{Compilation, compile};

use crate::assemble::Assembly;
use crate::error::{ImportError, Mistake, Reason};
use crate::note::Note;
use crate::write::declaration;

/// Leaves out everything that only a solver needs.
const LIMITS: Limits = Limits { explicit_partials: 0, partial_operations: usize::MAX, motion_linear: 0 };

/// Drives coordinates at 0 if nothing resists them. This may leave other coordinates without weight, so the search is
/// repeated.
pub(crate) fn drive(assembly: &mut Assembly) -> Result<(), ImportError> {
    loop {
        let undetermined = undetermined(&declaration(assembly, true))?;
        if undetermined.is_empty() {
            return Ok(());
        }
        let mut rest = 0;
        for coordinate in assembly.joints.iter_mut().flat_map(|joint| &mut joint.coordinates) {
            if undetermined.contains(&coordinate.name) {
                coordinate.driven = true;
                assembly.notes.push(Note::Driven { coordinate: coordinate.name.clone(), why: "nothing resists it" });
            }
            rest += usize::from(!coordinate.driven);
        }
        let driven: Vec<String> = undetermined;
        assembly.dampers.retain(|damper| !driven.contains(&damper.on));
        if rest == 0 {
            return Err(refused(Reason::NothingMoves("nothing resists any joint, not even gravity")));
        }
    }
}

fn undetermined(declaration: &str) -> Result<Vec<String>, ImportError> {
    let tokens = declaration.parse();
    let tokens = tokens.map_err(|error| refused(Reason::Refused(format!("{error}"))))?;
    let compiled = compile(tokens, LIMITS);
    let compiled = compiled.map_err(|mistakes| refused(Reason::Refused(mistakes.to_string())))?;
    let coordinates = &compiled.mechanism.coordinates;
    let names = compiled.functions.undetermined.iter();
    let mut names: Vec<String> = names.map(|id| coordinates[id.index()].name.to_string()).collect();
    for (unknown, share) in compiled.functions.unknowns.iter().zip(stiffness(&compiled)) {
        let is_position = matches!(unknown.role, Role::Position(_));
        if is_position && share < NEARLY_NOTHING && !names.contains(&unknown.name) {
            names.push(unknown.name.clone());
        }
    }
    Ok(names)
}

/// Fraction of the largest stiffness. An axis that a file turns upright by `3.14159265359` is not quite upright.
const NEARLY_NOTHING: f64 = 1e-10;

/// By unknown, the largest derivative of the residual at rest by it over a few states, as a fraction of the largest of
/// all.
fn stiffness(compiled: &Compilation) -> Vec<f64> {
    let n = compiled.functions.unknowns.len();
    let mut columns = vec![0.0_f64; n];
    for state in 0..4 {
        let q: Vec<f64> = (0..n).map(|k| ((1 + 7 * k + 13 * state) as f64).sin()).collect();
        let kernel = "residual_and_stiffness";
        let values = compiled.program.evaluate(kernel, &[&q, &[], &[]]);
        let matrix = values.and_then(|values| values.into_iter().nth(1));
        for (k, entry) in matrix.unwrap_or_default().into_iter().enumerate() {
            columns[k % n] = columns[k % n].max(entry.abs());
        }
    }
    let most = columns.iter().fold(0.0_f64, |most, x| most.max(*x));
    let share = |x: f64| if most > 0.0 { x / most } else { 0.0 };
    columns.into_iter().map(share).collect()
}

fn refused(reason: Reason) -> ImportError {
    ImportError { mistakes: vec![Mistake { line: 1, column: 1, reason }] }
}
