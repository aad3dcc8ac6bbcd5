//! Sizes of arrays, and named indices into them.

use std::fmt::Write;

use eigentol_compiler::Compilation;
use eigentol_compiler::base::names::{flattened, written};
use eigentol_compiler::mechanics::Role;
use eigentol_compiler::model::mechanism::Unit;
use proc_macro2::Ident;

use super::Names;

/// The constants: the length of each array, and the index of each quantity.
pub(super) fn constants(compilation: &Compilation, names: &Names) -> String {
    let (mechanism, unknowns) = (&compilation.mechanism, &compilation.functions.unknowns);
    let mut list = Constants { text: String::new(), prefix: &names.shouted };
    list.size("COORDINATES", "unknowns `q`", unknowns.len());
    list.size("INPUTS", "inputs `u`", mechanism.inputs.len());
    list.size("DESIGN", "design variables `b`", mechanism.design.len());
    list.size("OUTPUTS", "outputs", mechanism.outputs.len());
    if !mechanism.excitations.is_empty() {
        list.size("EXCITATIONS", "excitations", mechanism.excitations.len());
    }
    for (k, unknown) in unknowns.iter().enumerate() {
        // Reactions have labels, not names.
        if let Role::Position(id) | Role::Harmonic(id) | Role::Speed(id) = unknown.role {
            let name = Ident::new(&unknown.name, mechanism.coordinates[id.index()].name.span());
            list.place("COORDINATE", &name, &[], &one(&unknown.unit), k);
        }
    }
    for (k, input) in mechanism.inputs.iter().enumerate() {
        list.place("INPUT", &input.name, &input.docs, &si(&input.unit), k);
    }
    for (k, design) in mechanism.design.iter().enumerate() {
        list.place("DESIGN", &design.name, &design.docs, &si(&design.unit), k);
    }
    for (k, output) in mechanism.outputs.iter().enumerate() {
        list.place("OUTPUT", &output.name, &output.docs, &si(&output.unit), k);
    }
    for (k, excitation) in mechanism.excitations.iter().enumerate() {
        list.place("EXCITATION", &excitation.name, &[], "SI", k);
    }
    list.text + "\n"
}

/// The symbol of a unit, `1` for a plain number.
fn one(symbol: &str) -> String {
    match symbol {
        "" => "1".to_owned(),
        symbol => symbol.to_owned(),
    }
}

/// The declared unit, with its SI value if it is not an SI unit.
fn si(unit: &Unit) -> String {
    let symbol = one(&unit.symbol);
    if unit.scale == 1.0 { symbol } else { format!("SI; one {symbol} is {:?}", unit.scale) }
}

struct Constants<'a> {
    text: String,
    prefix: &'a str,
}

impl Constants<'_> {
    fn size(&mut self, name: &str, what: &str, count: usize) {
        let Self { text, prefix } = self;
        let _ = writeln!(text, "/// Number of {what}.\npub const {prefix}_{name}: usize = {count};");
    }

    /// Names are spelled as declared: `m` and `M` may both exist.
    fn place(&mut self, list: &str, name: &Ident, docs: &[String], unit: &str, k: usize) {
        let Self { text, prefix } = self;
        for line in docs.iter().flat_map(|docs| docs.lines()) {
            // It would end the comment in C.
            let line = line.trim().replace("*/", "* /");
            let _ = writeln!(text, "/// {line}");
        }
        let name = name.to_string();
        let (name, flat) = (written(&name), flattened(&name));
        let _ = writeln!(text, "/// `{name}`, {unit}.\npub const {prefix}_{list}_{flat}: usize = {k};");
    }
}
