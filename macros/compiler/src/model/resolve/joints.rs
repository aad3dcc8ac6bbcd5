//! Joints: kinds, coordinates, drives and the placements of their frames.

use proc_macro2::Ident;

use super::expected::Expected;
use super::typed::Place;
use super::{JointCoordinate, Resolver};
use crate::base::dimension::Dimension;
use crate::base::ids::{CoordinateId, JointId};
use crate::base::nearest::nearest;
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::{
    Coordinate, CoordinateQuantity, Frame, Joint, JointKind, Motion, Placement,
};
use crate::syntax::ast::{self, Ast, ItemKind, JointClause};

const KINDS: [&str; 3] = ["fixed", "revolute", "prismatic"];

/// Placements on the `from` and the `to` side.
type Sides = [Option<Placement>; 2];

fn declared(ast: &Ast) -> impl Iterator<Item = &ast::Joint> {
    ast.items.iter().filter_map(|item| match &item.kind {
        ItemKind::Joint(joint) => Some(joint),
        _ => None,
    })
}

impl Resolver<'_> {
    /// Enters the coordinate of every joint, so that all that follows can refer to it.
    pub(super) fn coordinates(&mut self) {
        let mut count = 0;
        for joint in declared(self.ast) {
            let quantity = match joint.kind.to_string().as_str() {
                "revolute" => Some(CoordinateQuantity::Angle),
                "prismatic" => Some(CoordinateQuantity::Displacement),
                _ => None,
            };
            let entry = match quantity {
                Some(quantity) => {
                    count += 1;
                    JointCoordinate::One(CoordinateId::new(count - 1), quantity)
                }
                None if joint.kind == "fixed" => JointCoordinate::None,
                None => JointCoordinate::Unknown,
            };
            self.joint_coordinates.push(entry);
        }
    }

    pub(super) fn joints(&mut self) -> Vec<Joint> {
        let mut joints = Vec::new();
        for (index, joint) in declared(self.ast).enumerate() {
            joints.extend(self.joint(joint, JointId::new(index)));
        }
        joints
    }

    fn joint(&mut self, joint: &ast::Joint, id: JointId) -> Option<Joint> {
        let coordinate = self.joint_coordinates[id.index()];
        let kind = self.joint_kind(joint, coordinate);
        let (from, to) = (self.frame(&joint.from), self.frame(&joint.to));
        let apart = self.distinct(joint, from, to);
        let sides = self.placements(joint);
        let motion = self.motion(joint, coordinate);
        let (kind, [from_placement, to_placement]) = (kind?, sides?);
        let (from, to) = (from?, to?);
        apart?;
        if let JointCoordinate::One(_, quantity) = coordinate {
            self.declared_coordinates.push(Coordinate {
                name: joint.name.clone(),
                joint: id,
                quantity,
                motion: motion?,
            });
        }
        let unplaced = || Placement {
            offset: [0.0; 3].map(Expr::Number),
            rotations: Vec::new(),
        };
        Some(Joint {
            name: joint.name.clone(),
            kind,
            from,
            to,
            from_placement: from_placement.unwrap_or_else(unplaced),
            to_placement: to_placement.unwrap_or_else(unplaced),
        })
    }

    fn joint_kind(&mut self, joint: &ast::Joint, coordinate: JointCoordinate) -> Option<JointKind> {
        let kind = &joint.kind;
        let arguments = joint.arguments.as_deref().unwrap_or_default();
        match coordinate {
            JointCoordinate::Unknown => {
                let help = match nearest(&kind.to_string(), KINDS) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("known are {}", KINDS.join(", ")),
                };
                let message = format!("unknown joint `{kind}`");
                self.diagnostics.error_with_help(kind, message, help);
                None
            }
            JointCoordinate::None => {
                if let Some(argument) = arguments.first() {
                    let message = "`fixed` takes no argument";
                    self.diagnostics.error(argument.extent, message);
                    return None;
                }
                Some(JointKind::Fixed)
            }
            JointCoordinate::One(coordinate, quantity) => {
                let [axis] = arguments else {
                    self.diagnostics.error_with_help(
                        kind,
                        format!("`{kind}` needs one axis"),
                        format!("write `{kind}(z)` or `{kind}([1, 0, 1])`"),
                    );
                    return None;
                };
                let axis = self.direction(axis, Place::Parameter)?;
                Some(match quantity {
                    CoordinateQuantity::Angle => JointKind::Revolute { axis, coordinate },
                    CoordinateQuantity::Displacement => JointKind::Prismatic { axis, coordinate },
                })
            }
        }
    }

    /// A joint between a body and itself constrains nothing.
    fn distinct(
        &mut self,
        joint: &ast::Joint,
        from: Option<Frame>,
        to: Option<Frame>,
    ) -> Option<()> {
        if from.is_some() && from == to {
            let message = format!("this joint connects `{}` with itself", joint.to);
            self.diagnostics.error(&joint.to, message);
            return None;
        }
        Some(())
    }

    /// The placement on either side; at most one each.
    fn placements(&mut self, joint: &ast::Joint) -> Option<Sides> {
        let mut sides: Sides = [None, None];
        let mut seen = [false; 2];
        let mut all_right = true;
        for clause in &joint.clauses {
            let JointClause::Placement(placement) = clause else {
                continue;
            };
            let resolved = self.placement(placement);
            all_right &= resolved.is_some();
            let Some(side) = self.side(joint, placement.on.as_ref()) else {
                all_right = false;
                continue;
            };
            if seen[side] {
                let frame = if side == 0 { &joint.from } else { &joint.to };
                self.diagnostics.error_with_help(
                    placement.keyword,
                    format!("the joint frame is placed on `{frame}` twice"),
                    format!("say which body each placement is on: `on {}`", joint.to),
                );
                all_right = false;
            }
            seen[side] = true;
            sides[side] = resolved;
        }
        all_right.then_some(sides)
    }

    /// 0 for the `from` side, 1 for the `to` side.
    fn side(&mut self, joint: &ast::Joint, on: Option<&Ident>) -> Option<usize> {
        let Some(on) = on else {
            return Some(0);
        };
        if *on == joint.from {
            return Some(0);
        }
        if *on == joint.to {
            return Some(1);
        }
        let message = format!(
            "`{on}` is no side of this joint; it connects `{}` and `{}`",
            joint.from, joint.to
        );
        self.diagnostics.error(on, message);
        None
    }

    fn placement(&mut self, placement: &ast::Placement) -> Option<Placement> {
        let offset = match &placement.offset {
            Some(offset) => self.position(offset, "a joint's place"),
            None => Some([0.0; 3].map(Expr::Number)),
        };
        let rotations: Vec<Option<(Vector, Expr)>> = placement
            .rotations
            .iter()
            .map(|(axis, angle)| {
                let direction = self.direction(axis, Place::Parameter);
                let turn = self.scalar_of(angle, Expected::angle(), "this");
                if let Some(turn) = &turn {
                    self.require_finite(turn, "this angle", angle.extent);
                }
                direction.zip(turn)
            })
            .collect();
        Some(Placement {
            offset: offset?,
            rotations: rotations.into_iter().collect::<Option<_>>()?,
        })
    }

    /// Free, or driven at the one declared speed.
    fn motion(&mut self, joint: &ast::Joint, coordinate: JointCoordinate) -> Option<Motion> {
        let mut motion = Some(Motion::Free);
        let mut driven = false;
        for clause in &joint.clauses {
            let JointClause::Drive { keyword, speed } = clause else {
                continue;
            };
            if driven {
                self.diagnostics
                    .error(*keyword, "this joint is driven twice");
                continue;
            }
            driven = true;
            let dimension = match coordinate {
                JointCoordinate::None => {
                    let message = "a fixed joint cannot be driven";
                    self.diagnostics.error(*keyword, message);
                    None
                }
                JointCoordinate::Unknown => None,
                JointCoordinate::One(_, CoordinateQuantity::Angle) => Some(Dimension::RATE),
                JointCoordinate::One(_, CoordinateQuantity::Displacement) => Some(Dimension::SPEED),
            };
            motion = dimension.and_then(|dimension| {
                let expr = self.scalar_of(speed, dimension, "the speed of this drive")?;
                self.require_finite(&expr, "the speed of this drive", speed.extent);
                Some(Motion::Driven(expr))
            });
        }
        motion
    }
}
