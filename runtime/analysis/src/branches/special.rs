//! Points of a branch at which `Khat` is singular.

use super::curve::{ContinuationFailure, Curve};
use super::curve_point::symmetric_to_rounding;
use super::local_scaling::{CurvePosition, Frame};
use crate::algebra::{Matrix, Values, Vector, dot, form, largest, times};
use crate::constraints::Structure;
use crate::equilibrium::{Equilibrium, Stability, judge_critical};
use crate::error::NotFound;
use crate::kernels::Linear;
use crate::modes::{free_pairs, inertia};
use crate::{Complex, DampingKind, Input};

/// The kind of a point at which `Khat` is singular.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum SpecialKind {
    /// A limit point: the branch turns back; `w^T dg/du` is not zero.
    Fold,
    /// Crossed by a branch on which the input is stationary, whose two arms leave to the same side of the input.
    Pitchfork {
        /// Whether the arms lie where the critical mode of the branch they leave has lost its stiffness (supercritical,
        /// a soft loss), or where it still has it (subcritical, a hard loss). `None` if the input is constant along the
        /// arms to second order.
        supercritical: Option<bool>,
    },
    /// Crossed by another branch that continues to both sides of the input.
    Transcritical,
    /// Several modes lose their stiffness at once, or branches touch: located, but not resolved into branches.
    Degenerate,
}

eigentol_solve::worded! {
    SpecialKind {
        Self::Fold => "fold",
        Self::Pitchfork { supercritical: Some(true) } => "supercritical pitchfork",
        Self::Pitchfork { supercritical: Some(false) } => "subcritical pitchfork",
        Self::Pitchfork { supercritical: None } => "pitchfork",
        Self::Transcritical => "transcritical",
        Self::Degenerate => "degenerate",
    }
}

/// A point of a branch at which `Khat` is singular.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SpecialPoint {
    /// The kind of point.
    pub kind: SpecialKind,
    /// The varied input.
    pub input: Input,
    /// Its value at the point, SI.
    pub value: f64,
    /// The equilibrium at the point; its critical mode counts as neutral.
    pub equilibrium: Equilibrium,
    /// Critical vector: `Khat v = 0`, `v^T Mhat v = 1`, largest component positive; one of several if degenerate. With
    /// speeds of coasting coordinates, `Mhat` includes their inertia, which otherwise is part of `Chat`.
    pub v: Vector,
    /// Left critical vector: `Khat^T w = 0`, `w^T Mhat v = 1` with the same `Mhat`; equal to `v` for a symmetric `Khat`.
    /// Where a load accelerates free motions that this one joins, the product is zero, and `w^T Mhat w = 1`.
    pub w: Vector,
}

/// A crossing of branches, with the data needed to enter the other one.
#[derive(Clone, Debug)]
pub(crate) struct Junction {
    pub(crate) special: SpecialPoint,
    /// Frame at the junction, with the units of a regular point nearby.
    pub(crate) frame: Frame,
    /// Local unit direction, along the walk, of the branch on which the junction was found.
    pub(crate) incoming: CurvePosition,
    /// Local unit direction of the other branch.
    pub(crate) other: CurvePosition,
}

/// A special point on a walk.
pub(crate) struct Located {
    pub(crate) special: SpecialPoint,
    /// Tangent of the walk, SI units.
    pub(crate) direction: CurvePosition,
    pub(crate) junction: Option<Junction>,
    /// Whether the walk came along an arm of a pitchfork, which ends here.
    pub(crate) ends_arm: bool,
}

impl Curve<'_> {
    /// The special point at a place with critical vectors `v` and `w` of any length; `zero` modes are critical; `also`
    /// as for [`Self::equilibrium`].
    pub(crate) fn special(
        &self,
        kind: SpecialKind,
        curve_position: &CurvePosition,
        (v, w): (&[f64], &[f64]),
        zero: usize,
        also: Option<f64>,
    ) -> Result<SpecialPoint, ContinuationFailure> {
        let (least, most) = self.settings.bounds();
        let curve_position = &CurvePosition { q: curve_position.q.clone(), p: curve_position.p.clamp(least, most) };
        let mut equilibrium = self.equilibrium(curve_position, &self.system(curve_position)?, 0, also)?.state;
        let (v, w) = normalised(&equilibrium.linear, self.structure, v, w)
            .ok_or(ContinuationFailure::Missed(NotFound::DependentVectors))?;
        equilibrium.free = self.place_at(curve_position);
        make_critical(&mut equilibrium, zero);
        Ok(SpecialPoint { kind, input: self.settings.input, value: curve_position.p, equilibrium, v, w })
    }

    /// Like [`Self::special`], for a point that is not resolved further. The critical vector is the softest mode if
    /// the stiffness has modes of its own, otherwise that of `shapes`.
    pub(crate) fn degenerate(
        &self,
        curve_position: &CurvePosition,
        frame: &Frame,
        shapes: (&[f64], &[f64]),
        zero: usize,
    ) -> Result<SpecialPoint, ContinuationFailure> {
        let linear = self.linear(curve_position)?;
        let softest = symmetric_to_rounding(&linear, &self.description)
            .then(|| free_pairs(&linear, &self.description).ok())
            .flatten()
            .and_then(|pairs| {
                let shapes = pairs.lambda.iter().zip(pairs.shapes.iter());
                let shapes = shapes.skip(self.description.free_directions);
                let (_, least) = shapes.min_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
                Some(Vector::from(least))
            });
        let shapes = softest.as_deref().map_or(shapes, |v| (v, v));
        let residual = largest(&frame.weights(&self.system(curve_position)?.residual));
        self.special(SpecialKind::Degenerate, curve_position, shapes, zero, Some(residual))
    }
}

/// The inertia of motions along a critical vector: displacements, or speeds.
pub(crate) fn critical_inertia(linear: &Linear, structure: Structure, v: &[f64]) -> Matrix {
    let shape: Vec<_> = v.iter().copied().map(Complex::from).collect();
    inertia(linear, structure, 1.0, core::iter::once(&*shape))
}

/// Share of its terms below which `w^T M v` is zero: the critical vector is one of a chain of free motions.
const CHAINED: f64 = 1e-12;

/// Scales the vectors so that `v^T M v = 1`, with the largest component of a motion positive, and `w^T M v = 1`, or
/// `w^T M w = 1` where the former is zero.
fn normalised(linear: &Linear, structure: Structure, v: &[f64], w: &[f64]) -> Option<(Vector, Vector)> {
    let motion = &v[..structure.motions()];
    let most = largest(motion);
    let lead = motion.iter().copied().find(|value| value.abs() >= most * (1.0 - 1e-9))?;
    let mass = critical_inertia(linear, structure, v);
    let length = form(v, &mass, v).sqrt() * lead.signum();
    let v = v.map(|value| value / length);
    let size = form(w, &mass, w).sqrt();
    let both = dot(w, &times(&mass, &v));
    let chained = both.abs() <= CHAINED * size;
    let both = if chained { size } else { both };
    let w = w.map(|value| value / both);
    v.iter().chain(&w).all(|value| value.is_finite()).then_some((v, w))
}

/// Makes `zero` modes of an equilibrium critical, whatever sign rounding gives them.
pub(crate) fn make_critical(at: &mut Equilibrium, zero: usize) {
    let (judged, description) = (at.stability, &at.description);
    if !symmetric_to_rounding(&at.linear, description) {
        if let Some(verdict) = judge_critical(&at.linear, description, zero) {
            (at.stability, at.rounding) = (verdict.stability, verdict.rounding);
        }
        return;
    }
    if matches!(judged, Stability::Flutter { .. }) {
        return;
    }
    let Ok(pairs) = free_pairs(&at.linear, description) else {
        return;
    };
    let mut lambda = pairs.lambda;
    lambda.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let (critical, others) = lambda.split_at(zero.min(lambda.len()));
    at.rounding = critical.iter().fold(at.rounding, |most, value| most.max(value.abs()));
    let negative = others.iter().filter(|&&value| value < 0.0).count();
    let damped = description.damping != DampingKind::Zero;
    at.stability = match negative {
        0 => Stability::Neutral { zero },
        _ if negative % 2 == 0 && damped => judged,
        _ => Stability::Divergent { negative },
    };
}
