//! What stands in the parentheses of a joint: an axis for each coordinate, and the lead of a screw.

use std::f64::consts::TAU;

use super::super::Resolver;
use super::super::typed::Place;
use super::kinds::{Condition, Elementary, Kind};
use crate::base::dimension::Dimension;
use crate::base::ids::JointId;
use crate::base::nearest::nearest;
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::{JointStep, StepMotion};
use crate::model::rules::physical::{Demand, Requirement};
use crate::model::simplify;
use crate::syntax::ast::{Joint, JointArgument, Value};

/// Sine or cosine of an angle below which axes count as parallel or perpendicular.
const NEARLY: f64 = 1e-9;

impl Resolver<'_> {
    /// The elementary motions of a joint.
    pub(super) fn steps(
        &mut self,
        joint: &Joint,
        id: JointId,
        kind: &'static Kind,
    ) -> Option<Vec<JointStep>> {
        let arguments = joint.arguments.as_deref().unwrap_or_default();
        let is_lead = |argument: &&JointArgument| {
            kind.is_screw() && argument.name.as_ref().is_some_and(|name| name == "lead")
        };
        let (leads, axes): (Vec<_>, Vec<_>) = arguments.iter().partition(is_lead);
        let lead = self.lead(joint, kind, &leads);
        let named = self.names(joint, kind, &axes);
        let counted = self.count(joint, kind, axes.len());
        let directions: Vec<Option<Vector>> = axes
            .iter()
            .map(|axis| self.direction(&axis.value, Place::Parameter))
            .collect();
        let directions: Vec<Vector> = directions.into_iter().collect::<Option<_>>()?;
        named.and(counted)?;
        self.conditions(kind, &axes, &directions)?;
        let lead = lead?;
        let coordinates = self.coordinates_of(id);
        let steps = kind.motions.iter().zip(directions).zip(coordinates);
        let steps = steps.map(|((motion, axis), coordinate)| JointStep {
            motion: match motion {
                Elementary::Turn => StepMotion::Turn,
                Elementary::Slide => StepMotion::Slide,
                Elementary::Screw => StepMotion::Screw { lead: lead.clone() },
            },
            axis,
            coordinate,
        });
        Some(steps.collect())
    }

    /// Travel per radian; zero for a joint without a thread.
    fn lead(&mut self, joint: &Joint, kind: &Kind, leads: &[&JointArgument]) -> Option<Expr> {
        if !kind.is_screw() {
            return Some(Expr::Number(0.0));
        }
        let Some((first, more)) = leads.split_first() else {
            self.diagnostics.error_with_help(
                &joint.kind,
                "`screw` needs `lead`, the travel per turn",
                format!("write `{}`", kind.example),
            );
            return None;
        };
        if let Some(second) = more.first() {
            self.diagnostics
                .error(second.value.extent, "`lead` is given twice");
            return None;
        }
        let lead = self.scalar_of(&first.value, Dimension::LENGTH, "`lead`")?;
        self.requirements.push(Requirement {
            what: format!("the lead of `{}`", joint.name),
            values: vec![lead.clone()],
            demand: Demand::Lead,
            extent: first.value.extent,
        });
        Some(simplify::divide(lead, Expr::Number(TAU)))
    }

    /// Several coordinates each need a name; a single one has that of the joint.
    fn names(&mut self, joint: &Joint, kind: &Kind, axes: &[&JointArgument]) -> Option<()> {
        let several = kind.motions.len() > 1;
        let mut right = Some(());
        for axis in axes {
            let problem = match &axis.name {
                Some(name) if kind.motions.is_empty() => {
                    (name.into(), format!("`{}` takes no argument", kind.word))
                }
                Some(name) if kind.is_screw() && nearest(&name.to_string(), ["lead"]).is_some() => {
                    (
                        name.into(),
                        format!("`{}` has no argument `{name}`", kind.word),
                    )
                }
                Some(name) if !several => (
                    name.into(),
                    format!(
                        "the only coordinate of `{}` has the name of the joint, `{}`",
                        kind.word, joint.name
                    ),
                ),
                None if several => (
                    axis.value.extent,
                    format!("each coordinate of `{}` needs a name", kind.word),
                ),
                _ => continue,
            };
            let (extent, message) = problem;
            let help = format!("write `{}`", kind.example);
            self.diagnostics.error_with_help(extent, message, help);
            right = None;
            // One help is enough for axes without names.
            if axis.name.is_none() {
                break;
            }
        }
        right
    }

    fn count(&mut self, joint: &Joint, kind: &Kind, given: usize) -> Option<()> {
        let needed = kind.motions.len();
        if given == needed {
            return Some(());
        }
        let word = kind.word;
        let arguments = joint.arguments.as_deref().unwrap_or_default();
        if let (0, Some(first)) = (needed, arguments.first()) {
            if first.name.is_none() {
                let message = format!("`{word}` takes no argument");
                self.diagnostics.error(first.value.extent, message);
            }
            return None;
        }
        let (message, help) = match needed {
            1 => (
                format!("`{word}` needs one axis"),
                match kind.is_screw() {
                    true => format!("write `{}`", kind.example),
                    false => format!("write `{word}(z)` or `{word}([1, 0, 1])`"),
                },
            ),
            several => (
                format!("`{word}` needs {several} axes, not {given}"),
                format!("write `{}`", kind.example),
            ),
        };
        self.diagnostics.error_with_help(&joint.kind, message, help);
        None
    }

    /// What the kind demands of its axes.
    fn conditions(
        &mut self,
        kind: &Kind,
        axes: &[&JointArgument],
        directions: &[Vector],
    ) -> Option<()> {
        let mut right = Some(());
        for condition in kind.conditions {
            match *condition {
                Condition::Distinct(places) => {
                    self.independent(&places, axes, directions, Demand::Distinct)?;
                }
                Condition::Spanning(places) => {
                    self.independent(&places, axes, directions, Demand::Spanning)?;
                }
                Condition::Parallel(first, second) => {
                    let sine = angle_between(directions.get(first)?, directions.get(second)?).0;
                    if sine.is_some_and(|sine| sine > NEARLY) {
                        let message = format!("the two axes of `{}` must be parallel", kind.word);
                        let help = "for other axes use a `prismatic` and a `revolute` joint with a massless body between them";
                        let value = &axes.get(second)?.value;
                        self.diagnostics
                            .error_with_help(value.extent, message, help);
                        right = None;
                    }
                }
                Condition::Perpendicular(first, second) => {
                    let cosine = angle_between(directions.get(first)?, directions.get(second)?).1;
                    if cosine.is_some_and(|cosine| cosine > NEARLY) {
                        let message = format!(
                            "the last axis of `{}` must be perpendicular to the first two",
                            kind.word
                        );
                        self.diagnostics
                            .error(axes.get(second)?.value.extent, message);
                        return None;
                    }
                }
            }
        }
        right
    }

    /// Axes that may depend on design variables are compared at their values.
    fn independent(
        &mut self,
        places: &[usize],
        axes: &[&JointArgument],
        directions: &[Vector],
        demand: Demand,
    ) -> Option<()> {
        let mut names = Vec::new();
        let mut values = Vec::new();
        let mut last: Option<&Value> = None;
        for &place in places {
            let axis = axes.get(place)?;
            names.push(format!("`{}`", axis.name.as_ref()?));
            values.extend(directions.get(place)?.iter().cloned());
            last = Some(&axis.value);
        }
        let (end, start) = names.split_last()?;
        self.requirements.push(Requirement {
            what: format!("the axes of {} and {end}", start.join(", ")),
            values,
            demand,
            extent: last?.extent,
        });
        Some(())
    }
}

/// Magnitudes of sine and cosine of the angle between constant unit vectors; nothing when they are not constant.
fn angle_between(a: &Vector, b: &Vector) -> (Option<f64>, Option<f64>) {
    let constant = |value: Expr| match value {
        Expr::Number(number) => Some(number.abs()),
        _ => None,
    };
    let sine = simplify::norm(&simplify::cross(a, b));
    (constant(sine), constant(simplify::dot(a, b)))
}
