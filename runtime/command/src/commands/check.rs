//! Checking declarations.

use std::path::PathBuf;

use clap::Args;
use eigentol::{Description, Role};
use eigentol_compiler::model::rotor::nominal_weight;
use eigentol_interpreter::description;
use eigentol_results::numbers::number;

use crate::color::Color;
use crate::declaration::Declaration;
use crate::destination::print;
use crate::diagnostics;
use crate::failure::{Failure, plural};
use crate::verdict::Verdict;

/// Check declarations: every mistake with its line and column, or what they declare, which design variables are unused,
/// and in which directions nothing holds the mechanism
#[derive(Args, Debug)]
pub(crate) struct Check {
    /// Files with one declaration each, `-` for standard input
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
}

impl Check {
    pub(crate) fn run(&self, color: Color) -> Result<Verdict, Failure> {
        for file in &self.files {
            let declaration = Declaration::read(file)?;
            let compilation = declaration.checked()?;
            for warning in &compilation.mechanism.warnings() {
                diagnostics::warn(&declaration, &warning.into(), color);
            }
            let overview = summary(&description(&compilation));
            print(&format!("{}: {overview}\n", declaration.name))?;
            for shaft in &compilation.mechanism.shafts {
                let Some(weight) = nominal_weight(&compilation.mechanism, shaft) else { continue };
                let [length, mass, center] = weight.map(number);
                let name = &shaft.name;
                print(&format!("  {name}: {length} m, {mass} kg, centre of mass {center} m from its first end\n"))?;
            }
            for steady in &compilation.mechanism.steady {
                let name = &steady.name;
                print(&format!("  steady: the value of `{name}` selects one of a family of steady motions\n"))?;
            }
            let free = &compilation.functions.free;
            for note in free.notes.iter().chain(&free.unbalanced) {
                print(&format!("  {note}\n"))?;
            }
        }
        Ok(Verdict::Yes)
    }
}

/// One-line summary of a declaration.
fn summary(of: &Description) -> String {
    let moves = |role: &Role| matches!(role, Role::Position | Role::Speed);
    let moving = of.coordinates.iter().filter(|info| moves(&info.role));
    let counts = [
        (moving.count(), "coordinate", "coordinates"),
        (of.inputs.len(), "input", "inputs"),
        (of.design.len(), "design variable", "design variables"),
        (of.excitations.len(), "excitation", "excitations"),
        (of.outputs.len(), "output", "outputs"),
    ];
    let mentioned = counts.iter().filter(|(count, one, _)| *count > 0 || *one != "excitation");
    let counts: Vec<String> =
        mentioned.map(|(count, one, many)| format!("{count} {}", plural(*count, one, many))).collect();
    format!("mechanism `{}`, {}", of.name, counts.join(", "))
}
