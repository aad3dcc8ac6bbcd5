//! Names in settings: one, or those of several instances at once.

use eigentol::Description;

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

/// Whether a name has the indices that a pattern has, or others in its ranges.
fn fits(pattern: &str, name: &str) -> bool {
    match (pattern.split_once('['), name.split_once('[')) {
        (None, None) => pattern == name,
        (Some((own, pattern)), Some((other, name))) if own == other => {
            let (Some((range, pattern)), Some((index, name))) = (pattern.split_once(']'), name.split_once(']')) else {
                return false;
            };
            contains(range.trim(), index) && fits(pattern, name)
        }
        _ => false,
    }
}

/// Whether a range or an index contains an index.
fn contains(range: &str, index: &str) -> bool {
    let Some((from, to)) = range.split_once("..") else { return range == index };
    let Ok(index) = index.parse::<u32>() else { return false };
    let bound = |text: &str, otherwise: u32| match text.trim() {
        "" => Some(otherwise),
        text => text.parse().ok(),
    };
    bound(from, 0).is_some_and(|from| from <= index) && bound(to, u32::MAX).is_some_and(|to| index < to)
}
