//! Locates events between two neighbouring points of a branch.

use super::curve::{ContinuationFailure, Curve};
use super::curve_point::{CurvePoint, Signs};
use super::local_scaling::CurvePosition;
use super::special::{Located, SpecialKind};
use crate::equilibrium::{Bracket, refine};
use crate::error::NotFound;
use crate::modes::free_pairs;

/// Local distance below which events are not separated.
const NARROW: f64 = 1e-7;
/// Maximum number of points inserted between two stations to separate events.
const MOST_POINTS: usize = 120;

/// The signs that change between two stations.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Changes {
    falling: bool,
    crossed: bool,
    /// Change in the number of negative eigenvalues, if known.
    negative: Option<usize>,
}

impl Changes {
    fn between(a: &Signs, b: &Signs) -> Self {
        Self {
            falling: a.falling != b.falling,
            crossed: a.crossed != b.crossed,
            negative: a.negative.zip(b.negative).map(|(a, b)| a.abs_diff(b)),
        }
    }

    fn none(self) -> bool {
        !self.falling && !self.crossed && self.negative.is_none_or(|count| count == 0)
    }

    fn is(self, falling: bool, crossed: bool, negative: usize) -> bool {
        self.falling == falling && self.crossed == crossed && self.negative.is_none_or(|count| count == negative)
    }
}

impl Curve<'_> {
    /// Appends the special points between two stations, in order along the branch.
    pub(crate) fn locate(
        &self,
        a: &CurvePoint,
        b: &CurvePoint,
        specials: &mut Vec<Located>,
    ) -> Result<(), ContinuationFailure> {
        self.divide(a, b, specials, &mut 0)
    }

    fn divide(
        &self,
        a: &CurvePoint,
        b: &CurvePoint,
        specials: &mut Vec<Located>,
        points: &mut usize,
    ) -> Result<(), ContinuationFailure> {
        let changes = Changes::between(&a.signs, &b.signs);
        if changes.none() {
            return Ok(());
        }
        if let Some(located) = self.simple(a, b, changes)? {
            specials.push(located);
            return Ok(());
        }
        let width = a.frame.local(&b.place).norm();
        if width <= NARROW {
            specials.push(self.unresolved(a, b, changes)?);
            return Ok(());
        }
        *points += 1;
        if *points > MOST_POINTS {
            return Err(ContinuationFailure::Missed(NotFound::TooManyEvents));
        }
        let middle = self.middle(a, b)?;
        self.divide(a, &middle, specials, points)?;
        self.divide(&middle, b, specials, points)
    }

    /// The single event that explains the changes, if one does.
    fn simple(&self, a: &CurvePoint, b: &CurvePoint, changes: Changes) -> Result<Option<Located>, ContinuationFailure> {
        if changes.crossed {
            let junction = match self.branch_point(a, b) {
                Ok(junction) => junction,
                // Branches that nearly meet do not cross: the step has jumped from one to the other.
                Err(trouble @ ContinuationFailure::Refused(_)) => return Err(trouble),
                Err(_) => return Ok(None),
            };
            let pitchfork = matches!(junction.special.kind, SpecialKind::Pitchfork { .. });
            let ends_arm = pitchfork && junction.incoming.p.abs() < junction.other.p.abs();
            let explained = changes.is(false, true, 1) && !ends_arm;
            let explained_arm = changes.is(true, true, 0) && ends_arm;
            return Ok((explained || explained_arm).then(|| Located {
                special: junction.special.clone(),
                direction: junction.frame.stretched(&junction.incoming),
                junction: Some(junction),
                ends_arm,
            }));
        }
        if changes.is(true, false, 1) {
            return Ok(self.fold(a, b).ok().map(|(special, direction)| Located {
                special,
                direction,
                junction: None,
                ends_arm: false,
            }));
        }
        Ok(None)
    }

    /// A station between two others.
    fn middle(&self, a: &CurvePoint, b: &CurvePoint) -> Result<CurvePoint, ContinuationFailure> {
        let mut trouble = ContinuationFailure::Missed(NotFound::NothingBetween);
        for fraction in [0.5, 0.41, 0.62] {
            match self.between(a, b, fraction) {
                Ok(station) => return Ok(station),
                Err(reason) => trouble = reason,
            }
        }
        Err(trouble)
    }

    fn between(&self, a: &CurvePoint, b: &CurvePoint, fraction: f64) -> Result<CurvePoint, ContinuationFailure> {
        let end = a.frame.local(&b.place);
        let normal = end.unit().ok_or(ContinuationFailure::Missed(NotFound::Coincide))?;
        self.across(a, &end.scaled(fraction), &normal, 0.5 * end.norm())
    }

    /// The station on the plane through `from` with normal `normal` (both local to `a`), no farther than `reach` from it.
    pub(crate) fn across(
        &self,
        a: &CurvePoint,
        from: &CurvePosition,
        normal: &CurvePosition,
        reach: f64,
    ) -> Result<CurvePoint, ContinuationFailure> {
        let corrected = self.correct(&a.frame, from, normal, reach)?;
        self.arrive(&corrected, &a.frame.stretched(normal), Some(a))
    }

    /// Several events in one place, located where the mean of the eigenvalues that change sign is zero.
    fn unresolved(&self, a: &CurvePoint, b: &CurvePoint, changes: Changes) -> Result<Located, ContinuationFailure> {
        let end = a.frame.local(&b.place);
        let normal = end.unit().ok_or(ContinuationFailure::Missed(NotFound::Coincide))?;
        let first = a.signs.negative.zip(b.signs.negative).map_or(0, |(a, b)| a.min(b));
        let zero = changes.negative.unwrap_or(0).max(1);
        let mean = |station: &crate::Equilibrium| {
            let sum: f64 =
                free_pairs(&station.linear, &self.description).ok()?.lambda.iter().skip(first).take(zero).sum();
            Some(sum)
        };
        let mut fraction = 0.5;
        if let (Some(at_low), Some(at_high), Some(2..)) = (mean(&a.equilibrium), mean(&b.equilibrium), changes.negative)
            && at_low * at_high < 0.0
        {
            let bracket = Bracket { low: 0.0, high: 1.0, at_low, at_high };
            fraction = refine(bracket, |trial| {
                let from = end.scaled(trial);
                let at = self.correct(&a.frame, &from, &normal, 0.5 * end.norm()).ok()?;
                let state = self.equilibrium(&at.place, &at.system, 0, None).ok()?.state;
                let mean = mean(&state)?;
                Some((mean, None))
            });
        }
        let from = end.scaled(fraction);
        let position = match self.correct(&a.frame, &from, &normal, 0.5 * end.norm()) {
            Ok(corrected) => corrected.place,
            Err(_) => a.frame.place(&from),
        };
        let shapes = (&*normal.q, &*normal.q);
        let special = self.degenerate(&position, &a.frame, shapes, zero)?;
        Ok(Located { special, direction: a.frame.stretched(&normal), junction: None, ends_arm: false })
    }
}
