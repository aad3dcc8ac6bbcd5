//! Warnings about a declaration that is right.

use syn::punctuated::Punctuated;
use syn::{Attribute, Meta, Token};

use super::mechanism::Mechanism;
use crate::mistakes::{Mistake, mistake};

impl Mechanism {
    /// The warnings that rustc gives if the declaration is written in a macro: design variables that nothing refers to.
    /// A leading underscore or an attribute marks such a variable as intended.
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
        if is_allowed(&self.attributes) {
            return Vec::new();
        }
        let unused = self.unused_design().map(|variable| {
            let name = variable.name.to_string();
            let (plain, span) = (name.trim_start_matches("r#"), variable.name.span());
            let message = format!("unused variable: `{name}`");
            let help = format!("if this is intentional, prefix it with an underscore: `_{plain}`");
            (!plain.starts_with('_')).then(|| mistake((span, span), message, Some(help)))
        });
        unused.flatten().collect()
    }
}

/// Lints that cover unused variables.
const UNUSED: [&str; 3] = ["unused_variables", "unused", "warnings"];

/// Whether the last attribute about unused variables allows them.
fn is_allowed(attributes: &[Attribute]) -> bool {
    let is_meant = |attribute: &&Attribute| {
        let lints = attribute.parse_args_with(Punctuated::<Meta, Token![,]>::parse_terminated);
        let mut lints = lints.into_iter().flatten();
        lints.any(|lint| UNUSED.iter().any(|name| lint.path().is_ident(name)))
    };
    let levels = ["allow", "warn", "deny", "forbid"];
    let is_level = |a: &&Attribute| levels.iter().any(|level| a.path().is_ident(level));
    let last = attributes.iter().filter(is_level).rfind(is_meant);
    last.is_some_and(|attribute| attribute.path().is_ident("allow"))
}
