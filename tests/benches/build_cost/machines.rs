//! The declarations whose builds are measured.

use crate::declaration;

/// A declaration of the language.
pub(crate) struct Machine {
    pub(crate) name: String,
    /// Name of the generated type.
    pub(crate) kind: String,
    pub(crate) text: String,
    pub(crate) extent: Extent,
}

/// How far a declaration is processed.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Extent {
    /// Expanded by the macro.
    Expanded,
    /// The generated code is checked by rustc.
    Built,
    /// The kernels are compiled by rustc.
    Called,
}

/// The paper's examples, a seven-joint arm, chains of bars.
pub(crate) fn all() -> Vec<Machine> {
    let named = [
        ("single pendulum", include_str!("../../../examples/rotating_pendulum.rs"), Extent::Expanded),
        ("double pendulum", include_str!("../../../examples/rotating_double_pendulum.rs"), Extent::Called),
        ("arm of seven joints", include_str!("../../src/corpus/robot_arm.rs"), Extent::Called),
    ];
    let chains = [(8, Extent::Expanded), (16, Extent::Expanded), (32, Extent::Called), (64, Extent::Built)];
    let named = named.into_iter().map(|(name, source, extent)| {
        let text = declared(source);
        Machine { name: name.to_owned(), kind: kind(&text), text, extent }
    });
    let chains = chains.into_iter().map(|(bars, extent)| Machine {
        name: format!("chain of {bars}"),
        kind: format!("Chain{bars}"),
        text: declaration::declaration(&format!("Chain{bars}"), bars),
        extent,
    });
    named.chain(chains).collect()
}

/// The text in the braces of the first macro in a source that declares a mechanism.
fn declared(source: &str) -> String {
    let start = ["mechanism! {", "machine! {"]
        .iter()
        .filter_map(|call| source.find(call).map(|place| place + call.len()))
        .min()
        .expect("a source with a mechanism");
    let mut depth = 1;
    source[start..]
        .chars()
        .take_while(|character| {
            match character {
                '{' => depth += 1,
                '}' => depth -= 1,
                _ => {}
            }
            depth > 0
        })
        .collect()
}

/// The word after `mechanism`.
fn kind(declaration: &str) -> String {
    let words = declaration.split_whitespace();
    words.skip_while(|word| *word != "mechanism").nth(1).expect("a declaration with a name").to_owned()
}
