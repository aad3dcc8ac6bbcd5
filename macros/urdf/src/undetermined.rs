//! Coordinates that nothing resists: only the equations tell which.

use eigentol_compiler::compile;
use eigentol_compiler::mechanics::Limits;

use crate::assemble::Assembly;
use crate::error::{ImportError, Mistake, Reason};
use crate::note::Note;
use crate::write::declaration;

/// Nothing that only a solver needs.
const LIMITS: Limits = Limits {
    explicit_partials: 0,
    motion_linear: 0,
};

/// Drives at 0 what nothing resists. What is held may have been all that made something else heavy: the rest is asked again.
pub(crate) fn drive(assembly: &mut Assembly) -> Result<(), ImportError> {
    loop {
        let undetermined = undetermined(&declaration(assembly, true))?;
        if undetermined.is_empty() {
            return Ok(());
        }
        let mut rest = 0;
        for coordinate in assembly
            .joints
            .iter_mut()
            .flat_map(|joint| &mut joint.coordinates)
        {
            if undetermined.contains(&coordinate.name) {
                coordinate.driven = true;
                assembly.notes.push(Note::Driven {
                    coordinate: coordinate.name.clone(),
                    why: "nothing resists it",
                });
            }
            rest += usize::from(!coordinate.driven);
        }
        let driven: Vec<String> = undetermined;
        assembly
            .dampers
            .retain(|damper| !driven.contains(&damper.on));
        if rest == 0 {
            return Err(refused(Reason::NothingMoves(
                "nothing resists any joint, not even gravity",
            )));
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
    Ok(names
        .map(|id| coordinates[id.index()].name.to_string())
        .collect())
}

fn refused(reason: Reason) -> ImportError {
    ImportError {
        mistakes: vec![Mistake {
            line: 1,
            column: 1,
            reason,
        }],
    }
}
