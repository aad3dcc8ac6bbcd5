//! Parts that every mechanism must have.

use crate::base::diagnostics::Diagnostics;
use crate::syntax::ast::{Ast, ItemKind, Unread};

/// Checks that there is something that can move, and a way for it to move.
pub(crate) fn check(ast: &Ast, can_move: bool, diagnostics: &mut Diagnostics) {
    if !has_body(ast) {
        diagnostics.error_with_help(
            &ast.name,
            format!("`{}` has no body", ast.name),
            "declare one, for example `body bar: rod(mass: 1 kg, length: 1 m, along: -z);`",
        );
    } else if !can_move {
        // Modes exist only in free coordinates.
        diagnostics.error_with_help(
            &ast.name,
            format!("nothing in `{}` is free to move: every joint is fixed or driven", ast.name),
            "a joint that is not driven, such as `revolute` or `prismatic`, gives a free coordinate",
        );
    }
}

/// Without bodies there is no motion.
fn has_body(ast: &Ast) -> bool {
    ast.items.iter().any(|item| matches!(item.kind, ItemKind::Body(_))) || ast.unread.iter().any(Unread::may_connect)
}
