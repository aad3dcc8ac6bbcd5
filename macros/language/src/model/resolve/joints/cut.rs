//! Joints that are declared to close a loop.

use super::super::resolver::Resolver;
use super::kinds::Kind;
use crate::syntax::ast::{Joint, JointClause};

impl Resolver<'_> {
    /// Whether the joint is cut. Its motions then become equations, which are not available for every kind.
    pub(super) fn cut(&mut self, joint: &Joint, kind: Option<&Kind>) -> Option<bool> {
        let mut clauses = joint.clauses.iter().filter_map(|clause| match clause {
            JointClause::Cut(keyword) => Some(*keyword),
            _ => None,
        });
        let Some(first) = clauses.next() else {
            return Some(false);
        };
        if let Some(second) = clauses.next() {
            return self.refuse(second, "this joint is cut twice");
        }
        let kind = kind?;
        if kind.is_screw() {
            return self.refuse_with_help(first, "a screw joint cannot be cut", "cut another joint of the loop");
        }
        if kind.is_free() {
            return self.refuse_with_help(
                first,
                "a free joint holds nothing, so that it closes no loop",
                "leave the joint out",
            );
        }
        Some(true)
    }
}
