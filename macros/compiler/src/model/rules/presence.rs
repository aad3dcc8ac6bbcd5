//! What every mechanism must have.

use crate::base::diagnostics::Diagnostics;
use crate::syntax::ast::{Ast, ItemKind, JointClause};

/// Checks that there is something to move and a way for it to move.
pub(crate) fn check(ast: &Ast, diagnostics: &mut Diagnostics) {
    if !has_body(ast) {
        diagnostics.error_with_help(
            &ast.name,
            format!("`{}` has no body", ast.name),
            "declare one, for example `body bar: rod(mass: 1 kg, length: 1 m, along: -z);`",
        );
    } else if !has_free_coordinate(ast) {
        diagnostics.error_with_help(
            &ast.name,
            format!(
                "nothing in `{}` is free to move: every joint is fixed or driven",
                ast.name
            ),
            "an undriven `revolute` or `prismatic` joint gives a free coordinate",
        );
    }
}

/// Without bodies there is no motion.
fn has_body(ast: &Ast) -> bool {
    ast.items
        .iter()
        .any(|item| matches!(item.kind, ItemKind::Body(_)))
}

/// Modes are those of free coordinates. A joint of an unknown kind gets the benefit of the doubt.
fn has_free_coordinate(ast: &Ast) -> bool {
    ast.items.iter().any(|item| match &item.kind {
        ItemKind::Joint(joint) => {
            let driven = |clause: &JointClause| matches!(clause, JointClause::Drive { .. });
            joint.kind != "fixed" && !joint.clauses.iter().any(driven)
        }
        _ => false,
    })
}
