//! Worst case: the corners of the box of limits at which responses are smallest and largest, found with exact
//! gradients.

use std::collections::BTreeMap;

use super::limits::limits;
use crate::algebra::Vector;
use crate::response::{Realisation, Response, Responses, Workspace};
use crate::tolerance::{Outcome, Tolerances};
use crate::{Description, Error, Shared};

/// Maximum number of variables for which all corners are checked if a response is not monotonic.
const ALL_CORNERS: usize = 10;
/// A slope counts as zero if its variable changes the response by less than this fraction of the change due to the most
/// important variable.
const NO_SIGN: f64 = 1e-9;

/// Values with a smaller relative difference are equal.
const ROUNDING: f64 = 1e-13;

/// The smallest or largest value of a response among all evaluated designs.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Extreme {
    /// The value, SI.
    pub value: f64,
    /// The design, SI.
    pub design: Vector,
    /// Whether the gradient there points out of the box or along its limits: no design nearby is worse.
    pub confirmed: bool,
}

/// A corner where a response has no value.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MissingCorner {
    /// The design, SI.
    pub design: Vector,
    /// The outcome of the design.
    pub outcome: Outcome,
}

/// The worst case of one response.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ResponseLimits {
    /// Value at the nominal design, SI.
    pub nominal: Option<f64>,
    /// The minimum; `None` if no evaluated design has the response, or if the search for it ended at a corner that does
    /// not.
    pub least: Option<Extreme>,
    /// The maximum; `None` like the minimum.
    pub greatest: Option<Extreme>,
    /// The design variables whose slope changes sign between evaluated designs: the response is not monotonic, and may
    /// be worse inside the box than at its corners.
    pub turning: Vec<usize>,
    /// The evaluated corners without a value.
    pub missing: Vec<MissingCorner>,
}

impl ResponseLimits {
    /// Whether the limits are reliable: the gradient kept its signs at all evaluated designs, both extremes are
    /// confirmed, and no corner lacks a value.
    #[must_use]
    pub fn is_monotonic(&self) -> bool {
        let confirmed = |end: &Option<Extreme>| end.as_ref().is_some_and(|end| end.confirmed);
        self.turning.is_empty() && self.missing.is_empty() && confirmed(&self.least) && confirmed(&self.greatest)
    }
}

/// The worst case of several responses.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WorstCase {
    /// The responses requested.
    pub wanted: Vec<Response>,
    /// One per response.
    pub responses: Vec<ResponseLimits>,
    /// Smallest and largest value of each design variable, SI.
    pub limits: Vec<(f64, f64)>,
    /// Number of designs evaluated.
    pub evaluations: usize,
    /// The inputs of the operating point, SI.
    pub inputs: Vector,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

/// Smallest and largest value of each response over the box of limits.
///
/// Distributions bounded on both sides use their hard limits; the others extend as many standard normal deviations as
/// half-widths represent ([`Tolerances::sigma_level`]). A box ignores correlation.
///
/// From the nominal design the search goes to the corner that the gradient points to, and continues until the gradient
/// there agrees with the corner. A variable with zero slope at the nominal design is checked at both its ends, because
/// the response may be stationary in it, as in an eccentricity. If the gradient changes sign on the way, the response
/// is not monotonic; then all corners are checked, for up to ten variables.
///
/// ```
#[doc = include_str!("example.txt")]
/// use eigentol::propagation::worst_case;
///
/// let worst = worst_case(&responses, &tolerances)?;
/// let frequency = &worst.responses[0];
/// assert!(frequency.is_monotonic());
/// let longest = frequency.greatest.as_ref().expect("it swings");
/// assert_eq!(longest.design[Pendulum::l.index()], 1.03);
/// assert_eq!(worst.evaluations, 3);
/// # Ok::<(), eigentol::Error>(())
/// ```
///
/// # Errors
/// [`Error::WrongLength`] for tolerances of another mechanism. Corners without a value are reported, not errors.
pub fn worst_case(responses: &Responses<'_>, tolerances: &Tolerances) -> Result<WorstCase, Error> {
    let at = responses.nominal();
    tolerances.check_count(at.design.len())?;
    let mut search = Search {
        responses,
        room: responses.workspace(),
        nominal: &at.design,
        limits: limits(&at.design, tolerances),
        seen: BTreeMap::new(),
    };
    let count = responses.wanted().len();
    let mut ends = Vec::new();
    for response in 0..count {
        ends.push([search.climb(response, -1)?, search.climb(response, 1)?]);
        search.look_where_still(response)?;
    }
    if (0..count).any(|response| !search.turning(response).is_empty()) {
        search.all_corners()?;
    }
    Ok(WorstCase {
        wanted: responses.wanted().to_vec(),
        responses: (ends.iter().enumerate()).map(|(response, ends)| search.found(response, ends)).collect(),
        evaluations: search.seen.len(),
        limits: search.limits,
        inputs: at.inputs.clone(),
        description: at.description.clone(),
    })
}

/// The side of each design variable: smallest value (-1), nominal (0) or largest (1).
type Corner = Vec<i8>;

struct Search<'a> {
    responses: &'a Responses<'a>,
    room: Workspace,
    nominal: &'a [f64],
    limits: Vec<(f64, f64)>,
    seen: BTreeMap<Corner, Realisation>,
}

impl Search<'_> {
    fn design(&self, corner: &[i8]) -> Vector {
        let values = self.nominal.iter().zip(&self.limits);
        corner
            .iter()
            .zip(values)
            .map(|(side, (nominal, (low, high)))| match side {
                -1 => *low,
                1 => *high,
                _ => *nominal,
            })
            .collect()
    }

    fn look(&mut self, corner: &[i8]) -> Result<(), Error> {
        if !self.seen.contains_key(corner) {
            let design = self.design(corner);
            let realisation = self.responses.with_gradients(&mut self.room, &design)?;
            self.seen.insert(corner.to_vec(), realisation);
        }
        Ok(())
    }

    /// Follows the signs of the gradient up (1) or down (-1) until they agree with the corner or the corner is known,
    /// and returns the corner at which that ends.
    fn climb(&mut self, response: usize, way: i8) -> Result<Corner, Error> {
        let mut corner = vec![0; self.limits.len()];
        let mut met = Vec::new();
        while !met.contains(&corner) {
            self.look(&corner)?;
            let Some(signs) = self.signs(&corner, response) else {
                break;
            };
            let next = signs.iter().map(|sign| way * sign).collect();
            met.push(core::mem::replace(&mut corner, next));
        }
        Ok(corner)
    }

    /// Checks the ends of variables with zero slope at the nominal design: either they do not matter, or the response
    /// is stationary in them.
    fn look_where_still(&mut self, response: usize) -> Result<(), Error> {
        let nominal = vec![0; self.limits.len()];
        let Some(signs) = self.signs(&nominal, response) else {
            return Ok(());
        };
        for (j, sign) in signs.into_iter().enumerate() {
            let (low, high) = self.limits[j];
            if sign == 0 && low < high {
                for side in [-1, 1] {
                    let mut corner = nominal.clone();
                    corner[j] = side;
                    self.look(&corner)?;
                }
            }
        }
        Ok(())
    }

    /// Checks all corners of the box if they are few.
    fn all_corners(&mut self) -> Result<(), Error> {
        let wide = self.limits.iter().enumerate();
        let varying: Vec<usize> = wide.filter(|(_, (low, high))| low < high).map(|(j, _)| j).collect();
        if varying.len() > ALL_CORNERS {
            return Ok(());
        }
        for number in 0..1_usize << varying.len() {
            let mut corner = vec![0; self.limits.len()];
            for (bit, &j) in varying.iter().enumerate() {
                corner[j] = if number >> bit & 1 == 1 { 1 } else { -1 };
            }
            self.look(&corner)?;
        }
        Ok(())
    }

    /// The signs of the slopes of a response at an evaluated corner; 0 if a slope is nothing but rounding.
    fn signs(&self, corner: &[i8], response: usize) -> Option<Corner> {
        let slopes = self.seen.get(corner)?.gradients.get(response)?.as_ref()?;
        let widths = self.limits.iter().map(|(low, high)| high - low);
        let changes: Vec<f64> = slopes.iter().zip(widths).map(|(s, w)| s * w).collect();
        let most = changes.iter().fold(0.0_f64, |most, change| most.max(change.abs()));
        let sign = |change: &f64| if change.abs() > NO_SIGN * most { change.signum() as i8 } else { 0 };
        Some(changes.iter().map(sign).collect())
    }

    fn turning(&self, response: usize) -> Vec<usize> {
        let all: Vec<Corner> = (self.seen.keys()).filter_map(|corner| self.signs(corner, response)).collect();
        let has = |j: usize, sign: i8| all.iter().any(|signs| signs[j] == sign);
        (0..self.limits.len()).filter(|&j| has(j, 1) && has(j, -1)).collect()
    }

    /// The result, given the corners at which the searches for least and greatest ended. What lies between the
    /// evaluated designs and a corner without a value is unknown.
    fn found(&self, response: usize, ends: &[Corner; 2]) -> ResponseLimits {
        let value = |realisation: &Realisation| realisation.values[response];
        let missing = self.seen.iter().filter(|(_, realisation)| value(realisation).is_none());
        let known = |corner: &Corner| self.seen.get(corner).and_then(value).is_some();
        let elsewhere = missing.clone().any(|(corner, _)| !ends.contains(corner));
        let extreme = |way: i8, end: &Corner| {
            let known = known(end) && !elsewhere;
            known.then(|| self.extreme(response, way)).flatten()
        };
        ResponseLimits {
            nominal: self.seen.get(&vec![0; self.limits.len()]).and_then(value),
            least: extreme(-1, &ends[0]),
            greatest: extreme(1, &ends[1]),
            turning: self.turning(response),
            missing: missing
                .map(|(corner, realisation)| MissingCorner {
                    design: self.design(corner),
                    outcome: realisation.outcome,
                })
                .collect(),
        }
    }

    fn extreme(&self, response: usize, way: i8) -> Option<Extreme> {
        let all = self.seen.iter();
        let all = all.filter_map(|(corner, realisation)| Some((corner, realisation.values[response]?)));
        let all: Vec<(&Corner, f64)> = all.collect();
        let worst = |most: f64, (_, value): &(_, f64)| most.max(f64::from(way) * value);
        let most = all.iter().fold(f64::NEG_INFINITY, worst);
        let equal = all.into_iter().filter(|(_, value)| most - f64::from(way) * value <= ROUNDING * most.abs());
        // Variables that do not matter stay nominal.
        let moved = |corner: &Corner| corner.iter().filter(|side| **side != 0).count();
        let (corner, value) = equal.min_by_key(|(corner, _)| moved(corner))?;
        let signs = self.signs(corner, response);
        let outwards =
            |signs: &Corner| corner.iter().zip(signs).clone().all(|(side, sign)| *sign == 0 || *side == way * sign);
        Some(Extreme { value, design: self.design(corner), confirmed: signs.as_ref().is_some_and(outwards) })
    }
}
