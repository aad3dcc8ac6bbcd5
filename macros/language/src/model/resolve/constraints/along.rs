//! The axes of a point along which a constraint holds.

use super::super::resolver::Resolver;
use crate::syntax::ast::{Value, ValueKind};

const AXES: [&str; 3] = ["x", "y", "z"];

impl Resolver<'_> {
    /// One of x, y and z, or a list of them.
    pub(super) fn axes_along(&mut self, value: &Value) -> Option<[bool; 3]> {
        let names = match &value.bare().kind {
            ValueKind::Vector(names, None) if !names.is_empty() => names.as_slice(),
            _ => std::slice::from_ref(value),
        };
        let mut along = [false; 3];
        let mut right = Some(());
        for name in names {
            let Some(axis) = axis(name) else {
                self.diagnostics.error_with_help(
                    name.extent,
                    "the name of an axis is expected here: `x`, `y` or `z`",
                    "`along` chooses axes of the point `from`: write `along: x` or `along: [x, z]`",
                );
                right = None;
                continue;
            };
            if std::mem::replace(&mut along[axis], true) {
                let message = format!("`{}` is given twice", AXES[axis]);
                self.diagnostics.error(name.extent, message);
                right = None;
            }
        }
        right.map(|()| along)
    }
}

fn axis(value: &Value) -> Option<usize> {
    match &value.bare().kind {
        ValueKind::Name(name) => AXES.iter().position(|axis| name == axis),
        _ => None,
    }
}
