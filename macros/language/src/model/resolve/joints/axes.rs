//! The arguments of a joint in parentheses: an axis for each coordinate, and the lead of a screw.

use std::f64::consts::TAU;

use super::super::resolver::Resolver;
use super::super::typed::ValueContext;
use super::kinds::{Condition, Elementary, Kind};
use crate::base::dimension::Dimension;
use crate::base::ids::JointId;
use crate::base::nearest::nearest;
use crate::base::span::Extent;
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::{JointStep, StepMotion};
use crate::model::rules::physical::Demand;
use crate::model::simplify;
use crate::syntax::ast::{Joint, JointArgument, Value};

/// Sine or cosine of an angle below which axes count as parallel or perpendicular.
const NEARLY: f64 = 1e-9;

impl Resolver<'_> {
    /// The elementary motions of a joint.
    pub(super) fn steps(&mut self, joint: &Joint, id: JointId, kind: &'static Kind) -> Option<Vec<JointStep>> {
        let Sorted { axes, leads, stray } = Sorted::new(joint, kind);
        let known = self.stray(joint, kind, &stray);
        let lead = match known {
            Some(()) => self.lead(joint, kind, &leads),
            // A misspelt `lead` is not also missing.
            None => None,
        };
        let named = self.names(joint, kind, &axes);
        let counted = self.count(joint, kind, axes.len());
        let directions: Vec<Option<Vector>> =
            axes.iter().map(|axis| self.direction(&axis.value, ValueContext::Parameter)).collect();
        let directions: Vec<Vector> = directions.into_iter().collect::<Option<_>>()?;
        named.and(counted)?;
        self.conditions(kind, &axes, &directions)?;
        let lead = lead?;
        known?;
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
            return self.refuse_with_help(
                &joint.kind,
                "`screw` needs `lead`, the travel per turn",
                format!("write `{}`", kind.example),
            );
        };
        if let Some(second) = more.first() {
            return self.refuse(second.value.extent, "`lead` is given twice");
        }
        let lead = self.scalar_of(&first.value, Dimension::LENGTH, "`lead`")?;
        self.require(format!("the lead of `{}`", joint.name), [lead.clone()], Demand::Lead, first.value.extent);
        Some(simplify::divide(lead, Expr::Number(TAU)))
    }

    /// Reports named arguments that have no meaning.
    fn stray(&mut self, joint: &Joint, kind: &Kind, stray: &[&JointArgument]) -> Option<()> {
        for name in stray.iter().filter_map(|argument| argument.name.as_ref()) {
            let word = kind.word;
            let message = format!("`{word}` has no argument `{name}`");
            let near = nearest(&name.to_string(), kind.is_screw().then_some("lead"));
            let help = match near {
                Some(near) => format!("did you mean `{near}`?"),
                None if name == "lead" => "a joint that travels along its axis as it turns is `screw`".to_string(),
                None => format!("write `{}`; the coordinate has the name of the joint, `{}`", kind.example, joint.name),
            };
            self.diagnostics.error_with_help(name, message, help);
        }
        stray.is_empty().then_some(())
    }

    /// Requires a name for each of several coordinates; a single one has the name of the joint.
    fn names(&mut self, joint: &Joint, kind: &Kind, axes: &[&JointArgument]) -> Option<()> {
        let word = kind.word;
        let help = format!("write `{}`", kind.example);
        for axis in axes {
            let (extent, message) = match (&axis.name, kind.motions.len()) {
                (Some(name), 1) => (
                    name.into(),
                    format!("the only coordinate of `{word}` has the name of the joint, `{}`", joint.name),
                ),
                (None, 2..) => (axis.value.extent, format!("each coordinate of `{word}` needs a name")),
                _ => continue,
            };
            return self.refuse_with_help(extent, message, help);
        }
        Some(())
    }

    fn count(&mut self, joint: &Joint, kind: &Kind, given: usize) -> Option<()> {
        let needed = kind.motions.len();
        if given == needed {
            return Some(());
        }
        let (word, example) = (kind.word, kind.example);
        let (message, help) = match needed {
            0 => {
                let first = joint.arguments.iter().flatten().next()?;
                let extent = first.name.as_ref().map_or(first.value.extent, Extent::from);
                let message = format!("`{word}` takes no argument");
                return self.refuse(extent, message);
            }
            1 if kind.is_screw() => (format!("`{word}` needs one axis"), format!("write `{example}`")),
            1 => (format!("`{word}` needs one axis"), format!("write `{word}(z)` or `{word}([1, 0, 1])`")),
            several => (format!("`{word}` needs {several} axes, not {given}"), format!("write `{example}`")),
        };
        self.refuse_with_help(&joint.kind, message, help)
    }

    /// Checks the conditions that the kind of joint places on its axes.
    fn conditions(&mut self, kind: &Kind, axes: &[&JointArgument], directions: &[Vector]) -> Option<()> {
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
                        let help =
                            "for other axes use a `prismatic` and a `revolute` joint with a massless body between them";
                        let value = &axes.get(second)?.value;
                        self.diagnostics.error_with_help(value.extent, message, help);
                        right = None;
                    }
                }
                Condition::Perpendicular(first, second) => {
                    let cosine = angle_between(directions.get(first)?, directions.get(second)?).1;
                    if cosine.is_some_and(|cosine| cosine > NEARLY) {
                        let message =
                            format!("the last axis of `{}` must be perpendicular to the first two", kind.word);
                        return self.refuse(axes.get(second)?.value.extent, message);
                    }
                }
            }
        }
        right
    }

    /// Requires axes to be independent; axes that may depend on design variables are compared at their nominal values.
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
        for &index in places {
            let axis = axes.get(index)?;
            names.push(format!("`{}`", axis.name.as_ref()?));
            values.extend(directions.get(index)?.iter().cloned());
            last = Some(&axis.value);
        }
        let (end, start) = names.split_last()?;
        self.require(format!("the axes of {} and {end}", start.join(", ")), values, demand, last?.extent);
        Some(())
    }
}

/// The arguments of a joint, sorted by meaning.
struct Sorted<'a> {
    axes: Vec<&'a JointArgument>,
    leads: Vec<&'a JointArgument>,
    /// Named arguments that are neither, next to the axis of a joint that has only one.
    stray: Vec<&'a JointArgument>,
}

impl<'a> Sorted<'a> {
    fn new(joint: &'a Joint, kind: &Kind) -> Self {
        let arguments = joint.arguments.as_deref().unwrap_or_default();
        let is_lead =
            |argument: &&JointArgument| kind.is_screw() && argument.name.as_ref().is_some_and(|name| name == "lead");
        let has_axis = arguments.iter().any(|argument| argument.name.is_none());
        let is_stray = |argument: &&JointArgument| kind.has_one_coordinate() && has_axis && argument.name.is_some();
        let (leads, others): (Vec<_>, Vec<_>) = arguments.iter().partition(is_lead);
        let (stray, axes) = others.into_iter().partition(is_stray);
        Self { axes, leads, stray }
    }
}

/// Magnitudes of sine and cosine of the angle between constant unit vectors; `None` if they are not constant.
fn angle_between(a: &Vector, b: &Vector) -> (Option<f64>, Option<f64>) {
    let constant = |value: Expr| match value {
        Expr::Number(number) => Some(number.abs()),
        _ => None,
    };
    let sine = simplify::norm(&simplify::cross(a, b));
    (constant(sine), constant(simplify::dot(a, b)))
}
