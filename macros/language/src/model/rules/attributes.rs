//! Attributes allowed on a mechanism: they go to the generated type, which already derives some traits.

use syn::punctuated::Punctuated;

use crate::base::diagnostics::Diagnostics;
use crate::base::span::Extent;
use crate::syntax::ast::Ast;

const DERIVED: [&str; 6] = ["Clone", "Copy", "Debug", "Default", "PartialEq", "Eq"];

/// Rejects traits that would be derived twice, which would be a conflict in the generated code.
pub(crate) fn check(ast: &Ast, diagnostics: &mut Diagnostics) {
    for derive in ast.attributes.iter().filter(|attribute| attribute.path().is_ident("derive")) {
        let list = derive.parse_args_with(Punctuated::<syn::Path, syn::Token![,]>::parse_terminated);
        for path in list.into_iter().flatten() {
            let Some(last) = path.segments.last() else {
                continue;
            };
            if DERIVED.iter().any(|name| last.ident == name) {
                let name = &last.ident;
                let message = format!("a mechanism implements `{name}` already");
                let all = DERIVED.map(|name| format!("`{name}`")).join(", ");
                let help = format!("remove it; derived are {all}");
                diagnostics.error_with_help(Extent::from(name), message, help);
            }
        }
    }
}
