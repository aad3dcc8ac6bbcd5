//! Warnings about a declaration that is right.

use syn::punctuated::Punctuated;
use syn::{Attribute, Meta, Token};

use super::mechanism::Mechanism;
use crate::mistakes::{Mistake, mistake};

impl Mechanism {
    /// The warnings that rustc gives if the declaration is written in a macro: inputs and design variables that nothing refers to, and
    /// [what seems not to be meant](Self::doubts). A leading underscore or an attribute marks what is meant.
    ///
    /// ```
    /// use eigentol_language::mistakes::{Mistakes, tokens};
    /// use eigentol_language::{model::resolve::resolve, syntax::parse::parse};
    ///
    /// let text = "mechanism A { design l = 1 m; design width = 5 cm; gravity 9.81 m/s^2 along -z;
    ///     body bar: rod(mass: 1 kg, length: l, along: -z); joint t: revolute(y) from ground to bar; }";
    /// let mechanism = resolve(&parse(tokens(text)?)?)?;
    /// let warnings = mechanism.warnings();
    /// assert_eq!(warnings[0].message, "unused variable: `width`");
    /// # Ok::<(), Mistakes>(())
    /// ```
    pub fn warnings(&self) -> Vec<Mistake> {
        let unused = self.unused().filter_map(|variable| {
            let name = variable.to_string();
            let (plain, span) = (name.trim_start_matches("r#"), variable.span());
            let message = format!("unused variable: `{name}`");
            let help = format!("if this is intentional, prefix it with an underscore: `_{plain}`");
            (!plain.starts_with('_')).then(|| mistake((span, span), message, Some(help)))
        });
        let doubts = self.doubts().into_iter().map(|doubt| {
            let span = doubt.name.span();
            mistake((span, span), doubt.message, Some(doubt.help.to_owned()))
        });
        let told = |lints: &[&str]| !is_allowed(&self.attributes, lints);
        unused.filter(|_| told(&UNUSED)).chain(doubts.filter(|_| told(&DEPRECATED))).collect()
    }
}

/// Lints that cover unused variables.
const UNUSED: [&str; 3] = ["unused_variables", "unused", "warnings"];

/// Lints that cover all else that rustc warns of in the name of a macro.
const DEPRECATED: [&str; 2] = ["deprecated", "warnings"];

/// Whether the last attribute about some lints allows them.
fn is_allowed(attributes: &[Attribute], lints: &[&str]) -> bool {
    let is_meant = |attribute: &&Attribute| {
        let named = attribute.parse_args_with(Punctuated::<Meta, Token![,]>::parse_terminated);
        let mut named = named.into_iter().flatten();
        named.any(|lint| lints.iter().any(|name| lint.path().is_ident(name)))
    };
    let levels = ["allow", "warn", "deny", "forbid"];
    let is_level = |a: &&Attribute| levels.iter().any(|level| a.path().is_ident(level));
    attributes.iter().filter(is_level).rfind(is_meant).is_some_and(|attribute| attribute.path().is_ident("allow"))
}
