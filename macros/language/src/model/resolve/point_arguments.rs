//! Points as arguments of forces and constraints.

use super::arguments::Arguments;
use super::resolver::Resolver;
use crate::base::ids::PointId;
use crate::syntax::ast;

impl Resolver<'_> {
    /// An argument that must be the name of a point.
    pub(super) fn point_argument(&mut self, arguments: &Arguments, name: &str) -> Option<PointId> {
        let point = self.name_of(arguments.get(name)?, "point")?;
        self.point_named(point)
    }

    /// The frame of a point as written.
    pub(super) fn point_frame(&self, point: PointId) -> Option<String> {
        self.ast.all::<ast::Point>().nth(point.index()).map(|point| point.frame.to_string())
    }

    /// Whether the point is fixed in a body.
    pub(super) fn point_moves(&self, point: PointId) -> bool {
        self.point_frame(point).is_some_and(|frame| frame != "ground")
    }

    /// Two arguments that must be points of different bodies, because nothing ever changes between two points of one
    /// body. `whole` names both in messages, and `reason` says what does not change.
    pub(super) fn point_pair(
        &mut self,
        arguments: &Arguments,
        [first, second]: [&str; 2],
        whole: &str,
        reason: &str,
    ) -> Option<(PointId, PointId)> {
        let from = self.point_argument(arguments, first);
        let to = self.point_argument(arguments, second);
        let (from, to) = (from?, to?);
        let frame = self.point_frame(from);
        let message = if from == to {
            format!("{whole} are the same point")
        } else if frame == self.point_frame(to) {
            let frame = frame?;
            format!("{whole} are fixed in `{frame}`: {reason}")
        } else {
            return Some((from, to));
        };
        self.refuse(arguments.get(second)?.extent, message)
    }
}
