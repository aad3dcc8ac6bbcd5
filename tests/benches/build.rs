//! Kernels of the chain of bars, one mechanism for each size that is timed.
//!
//! This is a build script rather than `mechanism!` for two reasons: it can lift the limit on explicit partials, so that
//! all of them are timed up to 16 bars, and it knows the profile, so that a mere check (`cargo clippy`) generates only
//! the small chains.

use std::env;
use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::path::Path;

use eigentol_compiler::algebra::regrouped;
use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::program::lower;
use eigentol_compiler::{Compilation, compile};

#[path = "chain.rs"]
mod chain;

/// Chain sizes compared with a peer, and chain sizes for the growth measurement.
const COMPARED: [&[usize]; 2] = [&[2, 4, 8, 16, 32], &[2]];
const GROWN: [&[usize]; 2] = [&[1, 2, 4, 8, 16, 32, 64], &[1]];

/// The largest chain whose explicit partials are generated.
const MOST_WITH_PARTIALS: usize = 16;

/// The largest chain whose kernels are compiled for vectors: each kernel is compiled for every instruction set.
const MOST_IN_LANES: usize = 16;

/// The kernels whose growth is measured; `growth::Kernels` is the contract reduced to these.
const GROWING: [&str; 2] = ["residual", "mode_gradient"];

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=chain.rs");
    let checked = usize::from(env::var("PROFILE")? != "release");
    let folder = env::var("OUT_DIR")?;
    let folder = Path::new(&folder);

    let (mut items, mut visits, mut short) = (String::new(), String::new(), String::new());
    for &bars in COMPARED[checked] {
        let name = format!("Chain{bars}");
        items += &compiled(&name, bars)?.emit_text();
        let visit = format!("visitor.visit({name});");
        if bars <= MOST_IN_LANES {
            short += &visit;
        }
        visits += &visit;
    }
    let visitor = "/// Shows every chain to the visitor, shortest first.\npub(crate) fn visit_all";
    write!(items, "{visitor}(visitor: &mut impl Visitor) {{ {visits} }}")?;
    write!(
        items,
        "/// Shows every chain that is timed in vectors.\n\
         pub(crate) fn visit_short(visitor: &mut impl Visitor) {{ {short} }}"
    )?;
    let longest = COMPARED[checked].iter().max().ok_or("no chain")?;
    write!(
        items,
        "/// The longest chain.\npub(crate) type Longest = Chain{longest};\n\
         /// Its number of bars.\npub(crate) const LONGEST: usize = {longest};"
    )?;
    fs::write(folder.join("chains.rs"), items)?;

    let (mut items, mut visits) = (String::new(), String::new());
    for &bars in GROWN[checked] {
        let name = format!("Growing{bars}");
        let text = growing(&name, bars)?;
        let bytes = text.len();
        items += &text;
        write!(visits, "visitor.visit({name}, {bytes});")?;
    }
    write!(items, "{visitor}(visitor: &mut impl Visitor) {{ {visits} }}")?;
    fs::write(folder.join("growing.rs"), items)?;
    Ok(())
}

fn compiled(name: &str, bars: usize) -> Result<Compilation, Box<dyn Error>> {
    let explicit_partials = match bars <= MOST_WITH_PARTIALS {
        true => usize::MAX,
        false => 0,
    };
    let declaration = chain::declaration(name, bars).parse()?;
    let compilation =
        compile(declaration, Limits { explicit_partials, partial_operations: usize::MAX, motion_linear: 0 })
            .map_err(|mistakes| format!("{name}: {mistakes:?}"))?;
    Ok(compilation)
}

/// A chain with only the growing kernels: a complete long chain would be tens of megabytes that are never timed.
fn growing(name: &str, bars: usize) -> Result<String, Box<dyn Error>> {
    let mut compilation = compiled(name, bars)?;
    let functions = &mut compilation.functions;
    functions.functions.retain(|function| GROWING.contains(&function.name));
    let mut kernels = Vec::new();
    for function in &functions.functions {
        kernels.extend(regrouped(&mut functions.graph, std::slice::from_ref(function)));
    }
    compilation.program = lower(&functions.graph, &kernels);
    let text = compilation.emit_text();
    let (before, after) = text.split_once("::eigentol::Mechanism for").ok_or("no contract in the emitted items")?;
    Ok(format!("{before} Kernels for {after}"))
}
