//! Names in settings: one, or those of several instances at once.

use eigentol::Description;
use eigentol_compiler::base::names::fits;

/// The names of inputs, design variables and coordinates that a pattern means: `blade[..].mass`, `blade[2..4].mass`. Without
/// a range, or if there are none, it is the name itself.
///
/// ```
/// use eigentol::Mechanism as _;
/// use eigentol_interpreter::{Interpreted, meant};
///
/// let machine = Interpreted::from_text(
///     "mechanism Pair {
///         design m[0..3] = 2 kg; design k = 8 N/m; body b[0..3]: rod(mass: 1 kg, length: 1 m, along: x);
///         for i in 0..3 {
///             joint x[i]: prismatic(x) from ground to b[i]; force f[i]: spring(on: x[i], stiffness: k * m[i] / 1 kg);
///         }
///     }",
/// )?;
/// assert_eq!(meant("m[1..]", machine.description()), ["m[1]", "m[2]"]);
/// assert_eq!(meant("k", machine.description()), ["k"]);
/// # Ok::<(), eigentol_interpreter::Mistakes>(())
/// ```
#[must_use]
pub fn meant(pattern: &str, of: &Description) -> Vec<String> {
    let inputs = of.inputs.iter().map(|info| &*info.name);
    let design = of.design.iter().map(|info| &*info.name);
    let all = inputs.chain(design).chain(of.coordinates.iter().map(|info| &*info.name));
    let mut names: Vec<String> =
        all.filter(|name| pattern.contains("..") && fits(pattern, name)).map(str::to_owned).collect();
    if names.is_empty() {
        names.push(pattern.to_owned());
    }
    names
}
