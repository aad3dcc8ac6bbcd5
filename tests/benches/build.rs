//! Kernels of the chain of bars, one mechanism for every size that is timed.
//!
//! A build script rather than `mechanism!`: only it can lift the bound on explicit partials, so that all of them are timed up
//! to 16 bars, and only it knows the profile: what is merely checked (`cargo clippy`) gets the small chains.

use std::env;
use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::path::Path;

use eigentol_compiler::compile;
use eigentol_compiler::mechanics::Limits;

#[path = "chain.rs"]
mod chain;

/// Bars of the chains that are timed, and the largest chain whose explicit partials are written out.
const TIMED: &[usize] = &[1, 2, 4, 8, 16, 32, 64];
const CHECKED: &[usize] = &[1, 2];
const MOST_WITH_PARTIALS: usize = 16;

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=chain.rs");
    let released = env::var("PROFILE")? == "release";
    let mut text = String::new();
    let mut visits = String::new();
    for &bars in if released { TIMED } else { CHECKED } {
        let explicit_partials = match bars <= MOST_WITH_PARTIALS {
            true => usize::MAX,
            false => 0,
        };
        let declaration = chain::declaration(bars).parse()?;
        let items = compile(declaration, Limits { explicit_partials })
            .map_err(|mistakes| format!("{bars} bars: {mistakes:?}"))?
            .emit();
        write!(text, "{items}")?;
        write!(visits, "visitor.visit(Chain{bars});")?;
    }
    write!(
        text,
        "/// Calls the visitor with every chain, shortest first.\n\
         pub(crate) fn visit_all(visitor: &mut impl Visitor) {{ {visits} }}"
    )?;
    fs::write(Path::new(&env::var("OUT_DIR")?).join("chains.rs"), text)?;
    Ok(())
}
