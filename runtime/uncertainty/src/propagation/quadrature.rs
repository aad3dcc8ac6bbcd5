//! Quadrature in standard normal space: few designs for smooth responses to few variables.

use eigentol_statistics::quadrature::{CompensatedSum, SparseGrid, TensorGrid};

use super::model::{DesignRoom, Designs, Model, TOGETHER};
use super::result::{Estimated, Method, Propagation, ResponseSpread};
use super::space::Space;
use crate::algebra::{Matrix, Vector};
use crate::judge::doubts_of_models;
use crate::response::Responses;
use crate::tolerance::{Counts, Outcome, Tolerances, pool};
use crate::{Equilibrium, Error};

/// Maximum number of dimensions for a full tensor product of nodes.
const TENSOR: usize = 3;
/// Number of designs solved before their sums are accumulated.
const ROUND: usize = 4096;

/// A point in standard normal space, and its weights in the fine and the coarse grid.
type Node = (Vec<f64>, [f64; 2]);

/// Mean, standard deviation, skewness and covariance by Gauss-Hermite quadrature.
///
/// Up to three variables it uses the tensor product of rules with `level + 1` nodes, beyond that Smolyak's sparse grid
/// of this level. It is exact for responses whose square is a polynomial of total degree `2 level + 1` in the standard
/// normal numbers behind the variables. Errors are the differences from the next lower level, which usually
/// overestimate.
///
/// ```
#[doc = include_str!("example.txt")]
/// use eigentol::propagation::quadrature;
///
/// let all = quadrature(&responses, &tolerances, 4, 1)?;
/// let sigma = all.spreads[0].as_ref().and_then(|spread| spread.sigma).expect("a smooth response");
/// assert!((sigma.value - 0.0214).abs() < 2e-4 && sigma.error < Some(1e-7));
/// assert_eq!(all.evaluations, 9);
/// # Ok::<(), eigentol::Error>(())
/// ```
///
/// # Errors
/// [`Error::WrongLength`] for tolerances of another mechanism; [`Error::Setting`] for a level of zero, one that is too
/// low for its weights to give a variance, or discrete variables; [`Error::NoResponse`] if a response has no value at
/// some node; [`Error::Threads`].
pub fn quadrature(
    responses: &Responses<'_>,
    tolerances: &Tolerances,
    level: usize,
    threads: usize,
) -> Result<Propagation, Error> {
    let at = responses.nominal();
    let space = Space::new(at, tolerances)?;
    let grid = Grid::new(space.dimensions(), level)?;
    refuse_discrete(tolerances)?;
    let nominal = responses.at(&mut responses.workspace(), &at.design)?.values;
    let mut sums = Sums::new(&nominal, &space);
    let mut tally = NodeOutcomes { counts: Counts::default(), missing: vec![0; nominal.len()] };
    let designs = Designs::new(responses, &space);
    grid.rounds(&mut |nodes| {
        let solve = |room: &mut DesignRoom, piece: usize| {
            let batch = &nodes[piece * TOGETHER..nodes.len().min((piece + 1) * TOGETHER)];
            let points = batch.iter().map(|(z, _)| space.standard(z.iter().copied()));
            let points: Vec<Vector> = points.collect();
            let mut each = Vec::with_capacity(batch.len());
            designs.evaluate(room, &points, &mut |_, evaluated| {
                each.push((evaluated.outcome, evaluated.values.to_vec(), Vector::from(evaluated.design)));
                Ok(())
            })?;
            Ok::<Vec<(Outcome, Vec<Option<f64>>, Vector)>, Error>(each)
        };
        let room = || designs.room();
        let size = (at.coordinates.len(), at.design.len());
        let solved = pool::run(threads, size, nodes.len().div_ceil(TOGETHER), room, solve)?;
        let solved = solved.into_iter().collect::<Result<Vec<_>, _>>()?;
        for ((_, weights), (outcome, values, design)) in nodes.iter().zip(solved.iter().flatten()) {
            tally.add(*outcome, values);
            sums.add(*weights, values, design);
        }
        Ok(())
    })?;
    tally.refuse_missing()?;
    let propagation = sums.propagation(grid.method(), responses, at, tally.counts, &nominal)?;
    Ok(propagation.doubted(doubts_of_models(responses, tolerances)))
}

/// Number of designs that [`quadrature`] evaluates; `None` if there is no such grid.
pub(super) fn cost(dimensions: usize, level: usize) -> Option<u64> {
    Grid::new(dimensions, level).ok()?.points()
}

/// Rejects discrete variables, with respect to which responses have no derivative.
pub(super) fn refuse_discrete(tolerances: &Tolerances) -> Result<(), Error> {
    let joint = tolerances.joint();
    let variables = joint.map_or(&[][..], |(joint, _)| joint.variables());
    if variables.iter().all(|variable| variable.is_continuous()) {
        return Ok(());
    }
    Err(Error::Setting { setting: "quadrature", reason: "a variable takes discrete values: sample instead".to_owned() })
}

/// The nodes of two successive levels.
enum Grid {
    Tensor(TensorGrid, TensorGrid, usize),
    Sparse(SparseGrid, usize),
}

impl Grid {
    fn new(dimensions: usize, level: usize) -> Result<Self, Error> {
        if level == 0 {
            return Err(Error::Setting {
                setting: "level",
                reason: "at level 0 there is one node, and no spread".to_owned(),
            });
        }
        let d = dimensions.max(1);
        Ok(if d <= TENSOR {
            let of = |nodes: usize| TensorGrid::new(&vec![nodes; d]);
            Self::Tensor(of(level.saturating_add(1))?, of(level)?, level + 1)
        } else {
            Self::Sparse(SparseGrid::new(d, level)?, level)
        })
    }

    fn points(&self) -> Option<u64> {
        match self {
            Self::Tensor(fine, coarse, _) => fine.points().checked_add(coarse.points()),
            Self::Sparse(grid, _) => Some(grid.points()),
        }
    }

    fn method(&self) -> Method {
        match *self {
            Self::Tensor(_, _, nodes) => Method::Tensor { nodes },
            Self::Sparse(_, level) => Method::Sparse { level },
        }
    }

    /// Passes all nodes to `take`, in rounds.
    fn rounds(&self, take: &mut dyn FnMut(&[Node]) -> Result<(), Error>) -> Result<(), Error> {
        let mut round: Vec<Node> = Vec::new();
        let mut add = |node: Node| {
            round.push(node);
            if round.len() < ROUND {
                return Ok(());
            }
            let outcome = take(&round);
            round.clear();
            outcome
        };
        match self {
            Self::Tensor(fine, coarse, _) => {
                let mut walk = fine.from(0);
                while let Some(node) = walk.next_point() {
                    add((node.point.to_vec(), [node.weight, 0.0]))?;
                }
                let mut walk = coarse.from(0);
                while let Some(node) = walk.next_point() {
                    add((node.point.to_vec(), [0.0, node.weight]))?;
                }
            }
            Self::Sparse(grid, _) => {
                let mut walk = grid.walk();
                while let Some(node) = walk.next_point() {
                    add((node.point.to_vec(), [node.weight, node.coarse_weight]))?;
                }
            }
        }
        take(&round)
    }
}

/// Outcomes of the nodes, and the number of nodes without a value for each response.
struct NodeOutcomes {
    counts: Counts,
    missing: Vec<usize>,
}

impl NodeOutcomes {
    fn add(&mut self, outcome: Outcome, values: &[Option<f64>]) {
        self.counts.add(outcome, 1);
        for (missing, value) in self.missing.iter_mut().zip(values) {
            *missing += usize::from(value.is_none());
        }
    }

    fn refuse_missing(&self) -> Result<(), Error> {
        match self.missing.iter().position(|missing| *missing > 0) {
            None => Ok(()),
            Some(response) => Err(Error::NoResponse {
                response,
                missing: self.missing[response],
                needed: self.counts.total(),
                method: "quadrature",
            }),
        }
    }
}

/// Weighted sums of deviations from a centre, their products and cubes, on both grids: for the responses, then for all
/// design variables.
struct Sums {
    centres: Vec<f64>,
    first: Vec<[CompensatedSum; 2]>,
    /// By response, then by the other quantity.
    products: Vec<Vec<[CompensatedSum; 2]>>,
    cubes: Vec<[CompensatedSum; 2]>,
}

impl Sums {
    fn new(nominal: &[Option<f64>], space: &Space<'_>) -> Self {
        let shifts = space.nominal.iter().zip(space.tolerances.shifts());
        let means = shifts.map(|(value, shift)| value + shift);
        let values = nominal.iter().map(|value| value.unwrap_or(0.0));
        let centres: Vec<f64> = values.chain(means).collect();
        let zeros = |number: usize| vec![[CompensatedSum::default(); 2]; number];
        Self {
            first: zeros(centres.len()),
            products: vec![zeros(centres.len()); nominal.len()],
            cubes: zeros(nominal.len()),
            centres,
        }
    }

    fn add(&mut self, weights: [f64; 2], values: &[Option<f64>], design: &[f64]) {
        let values = values.iter().map(|value| value.unwrap_or(0.0));
        let all = values.chain(design.iter().copied()).zip(&self.centres);
        let all: Vec<f64> = all.map(|(value, centre)| value - centre).collect();
        for (grid, weight) in weights.into_iter().enumerate() {
            for (sum, x) in self.first.iter_mut().zip(&all) {
                sum[grid].add(weight * x);
            }
            for ((row, cube), x) in self.products.iter_mut().zip(&mut self.cubes).zip(&all) {
                cube[grid].add(weight * x * x * x);
                for (sum, y) in row.iter_mut().zip(&all) {
                    sum[grid].add(weight * x * y);
                }
            }
        }
    }

    fn covariance(&self, i: usize, j: usize, grid: usize) -> f64 {
        let mean = |k: usize| self.first[k][grid].value();
        self.products[i][j][grid].value() - mean(i) * mean(j)
    }

    /// Mean, standard deviation and skewness of a response; `None` if the variance is negative.
    fn moments(&self, i: usize, grid: usize) -> Option<[f64; 3]> {
        let [mean, cube] = [&self.first, &self.cubes].map(|sums| sums[i][grid].value());
        let square = self.products[i][i][grid].value();
        let rounding = 1e-13 * (square.abs() + mean * mean);
        let variance = self.covariance(i, i, grid);
        if variance < -rounding {
            return None;
        }
        let sigma = if variance > rounding { variance.sqrt() } else { 0.0 };
        let third = cube - 3.0 * mean * square + 2.0 * mean * mean * mean;
        let skewness = if sigma > 0.0 { third / sigma.powi(3) } else { 0.0 };
        Some([self.centres[i] + mean, sigma, skewness])
    }

    fn spread(&self, i: usize, nominal: Option<f64>) -> Result<ResponseSpread, Error> {
        let fine = self.moments(i, 0).ok_or_else(|| Error::Setting {
            setting: "level",
            reason: format!(
                "the weights of this grid give response {} a negative variance: take a higher level, or sample",
                i + 1
            ),
        })?;
        let coarse = self.moments(i, 1);
        let estimated = |k: usize| {
            let error = coarse.map(|coarse| (fine[k] - coarse[k]).abs());
            Estimated::new(fine[k], error)
        };
        Ok(ResponseSpread {
            nominal,
            mean: estimated(0),
            sigma: Some(estimated(1)),
            skewness: (fine[1] > 0.0).then(|| estimated(2)),
            quantiles: Vec::new(),
            share: 1.0,
        })
    }

    fn propagation(
        &self,
        method: Method,
        responses: &Responses<'_>,
        at: &Equilibrium,
        counts: Counts,
        nominal: &[Option<f64>],
    ) -> Result<Propagation, Error> {
        let m = nominal.len();
        let spreads = nominal.iter().enumerate();
        let spreads = spreads.map(|(i, nominal)| Ok(Some(self.spread(i, *nominal)?)));
        Ok(Propagation {
            method,
            reason: String::new(),
            wanted: responses.wanted().to_vec(),
            doubts: Vec::new(),
            spreads: spreads.collect::<Result<_, Error>>()?,
            covariance: Matrix::from_fn(m, m, |i, j| Some(self.covariance(i, j, 0))),
            with_design: Matrix::from_fn(m, at.design.len(), |i, j| Some(self.covariance(i, m + j, 0))),
            evaluations: counts.total() as u64,
            counts,
            inputs: at.inputs.clone(),
            description: at.description.clone(),
        })
    }
}
