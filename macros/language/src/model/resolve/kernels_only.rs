//! Mechanisms of which only the equations are wanted.

use super::resolver::Resolver;
use crate::syntax::ast::ItemKind;

impl Resolver<'_> {
    /// Whether `kernels only` is declared.
    pub(super) fn kernels_only(&mut self) -> bool {
        let all: Vec<_> = self
            .ast
            .items
            .iter()
            .filter_map(|item| match item.kind {
                ItemKind::KernelsOnly(extent) => Some(extent),
                _ => None,
            })
            .collect();
        for extent in all.iter().skip(1) {
            let message = "`kernels only` is declared twice";
            self.diagnostics.error(*extent, message);
        }
        !all.is_empty()
    }
}
