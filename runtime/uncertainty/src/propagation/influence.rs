//! Attributes the scatter of responses to the variables.

use eigentol_statistics::sensitivity::{Bootstrap, Estimate, Estimator, SaltelliDesign, Sample, sobol_indices};
use eigentol_statistics::sequence::Sequence;

use super::gather::normals;
use super::limits::limits;
use super::model::{DesignRoom, Designs, Model, TOGETHER};
use super::space::Space;
use crate::algebra::Vector;
use crate::response::{Response, Responses};
use crate::tolerance::{Counts, Outcome, Sampling, Tolerances, pool};
use crate::{Description, Error, Shared};

/// The dependence of a response on one variable.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct VariableInfluence {
    /// Position of the design variable.
    pub variable: usize,
    /// First-order Sobol' index: the fraction of the variance that vanishes if this variable is known, with its 95 %
    /// interval. `None` if variables depend on each other or if the response does not vary.
    ///
    /// The interval is that of random points. The points are balanced, so that the index is much better than that:
    /// often by a factor of 5 to 10.
    pub first: Option<Estimate>,
    /// Total Sobol' index: the fraction of the variance that remains if all other variables are known.
    pub total: Option<Estimate>,
    /// Pearson correlation of the response with the variable, between -1 and 1; `None` if the response does not vary.
    pub correlation: Option<f64>,
    /// Spearman rank correlation of the response with the variable.
    pub rank_correlation: Option<f64>,
    /// Standardised regression coefficient: standard deviations of the response per standard deviation of the variable
    /// in the best linear fit. `None` also if variables are linear functions of each other.
    pub regression: Option<f64>,
    /// The response with the variable at its lower limit and all others nominal, SI; `None` if it has no value there.
    pub at_low: Option<f64>,
    /// The response with the variable at its upper limit and all others nominal, SI.
    pub at_high: Option<f64>,
}

/// The dependence of a response on all variables.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ResponseInfluence {
    /// Value at the nominal design, SI.
    pub nominal: Option<f64>,
    /// One per varying design variable.
    pub variables: Vec<VariableInfluence>,
    /// Fraction of the variance that the linear fit explains, between 0 and 1.
    pub determination: Option<f64>,
    /// Number of evaluations without a value, which are excluded.
    pub missing: usize,
}

/// The dependence of several responses on the variables.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Influence {
    /// The responses requested.
    pub wanted: Vec<Response>,
    /// One per response.
    pub responses: Vec<ResponseInfluence>,
    /// Limits of each design variable, SI: the same as for [`worst_case`](super::worst_case).
    pub limits: Vec<(f64, f64)>,
    /// Outcomes of the evaluated designs, excluding those at limits.
    pub counts: Counts,
    /// The inputs of the operating point, SI.
    pub inputs: Vector,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

/// Attributes the scatter of responses to the variables by Sobol' indices of independent variables, correlation and
/// regression, and the responses at the limits of each variable by itself (the bars of a tornado diagram). At most
/// `sampling.samples` designs are sampled, at scrambled Sobol' points.
///
/// If variables depend on each other, no share of the variance belongs to a single variable, and there are no Sobol'
/// indices.
///
/// ```
#[doc = include_str!("example.txt")]
/// use eigentol::propagation::influence;
/// use eigentol::tolerance::Sampling;
///
/// let all = influence(&responses, &tolerances, &Sampling::default())?;
/// let length = &all.responses[0].variables[0];
/// assert_eq!(length.variable, Pendulum::l.index());
/// assert!(length.total.is_some_and(|total| (total.value - 1.0).abs() < 0.01));
/// assert!(length.at_low < length.at_high);
/// # Ok::<(), eigentol::Error>(())
/// ```
///
/// # Errors
/// [`Error::WrongLength`] for tolerances of another mechanism; [`Error::Setting`] for too few samples for 16 rows,
/// where a row has two designs more than there are independent variables, or one if variables depend on each other;
/// [`Error::Threads`].
pub fn influence(
    responses: &Responses<'_>,
    tolerances: &Tolerances,
    sampling: &Sampling<'_>,
) -> Result<Influence, Error> {
    let at = responses.nominal();
    let space = Space::new(at, tolerances)?;
    let limits = limits(&at.design, tolerances);
    let variables = space.variables();
    let table = table(responses, &space, sampling)?;
    let mut room = responses.workspace();
    let nominal = responses.at(&mut room, &at.design)?.values;
    let mut ends = Vec::new();
    for &variable in &variables {
        let mut at_limit = |value: f64| {
            let mut design = at.design.clone();
            design[variable] = value;
            Ok::<_, Error>(responses.at(&mut room, &design)?.values)
        };
        let (low, high) = limits[variable];
        ends.push([at_limit(low)?, at_limit(high)?]);
    }
    let influences = nominal.iter().enumerate().map(|(i, nominal)| {
        let mut influence = table.response(i, &variables);
        influence.nominal = *nominal;
        for (variable, [low, high]) in influence.variables.iter_mut().zip(&ends) {
            (variable.at_low, variable.at_high) = (low[i], high[i]);
        }
        influence
    });
    Ok(Influence {
        wanted: responses.wanted().to_vec(),
        responses: influences.collect(),
        limits,
        counts: table.counts,
        inputs: at.inputs.clone(),
        description: at.description.clone(),
    })
}

/// Designs and their responses, as rows of a Saltelli design if variables are independent.
struct Table {
    /// Evaluations per row: 1, or the number of variables plus two.
    blocks: usize,
    /// The varying variables of each evaluation.
    designs: Vec<Vec<f64>>,
    values: Vec<Vec<Option<f64>>>,
    counts: Counts,
}

fn table(responses: &Responses<'_>, space: &Space<'_>, sampling: &Sampling<'_>) -> Result<Table, Error> {
    let variables = space.variables();
    let d = space.dimensions();
    let mut table = Table { blocks: 1, designs: Vec::new(), values: Vec::new(), counts: Counts::default() };
    if d == 0 {
        return Ok(table);
    }
    table.blocks = if independent(space) { d + 2 } else { 1 };
    let rows = sampling.samples / table.blocks;
    if rows < 16 {
        return Err(Error::setting(
            "samples",
            format!("{} are less than 16 rows of {} designs each", sampling.samples, table.blocks),
        ));
    }
    let rows = 1 << rows.ilog2();
    let points = Points::new(table.blocks, d, rows, sampling)?;
    let at = responses.nominal();
    let number = rows * table.blocks;
    let designs = Designs::new(responses, space);
    let work = |room: &mut DesignRoom, piece: usize| {
        let range = piece * TOGETHER..number.min((piece + 1) * TOGETHER);
        let mut batch = Vec::with_capacity(range.len());
        points.each(range, &mut |probabilities| {
            batch.push(space.standard(normals(probabilities)));
        });
        let mut evaluated = Vec::with_capacity(batch.len());
        designs.evaluate(room, &batch, &mut |_, one| {
            let design: Vec<f64> = variables.iter().map(|&i| one.design[i]).collect();
            evaluated.push((one.outcome, one.values.to_vec(), design));
            Ok(())
        })?;
        Ok::<Vec<(Outcome, Vec<Option<f64>>, Vec<f64>)>, Error>(evaluated)
    };
    let room = || designs.room();
    let size = (at.coordinates.len(), at.design.len());
    for piece in pool::run(sampling.threads, size, number.div_ceil(TOGETHER), room, work)? {
        for (outcome, values, design) in piece? {
            table.counts.add(outcome, 1);
            table.values.push(values);
            table.designs.push(design);
        }
    }
    Ok(table)
}

/// Whether the variables are independent of each other.
fn independent(space: &Space<'_>) -> bool {
    space.tolerances.correlation().is_none_or(|matrix| {
        matrix.iter().enumerate().all(|(i, row)| row.iter().enumerate().all(|(j, value)| i == j || *value == 0.0))
    })
}

/// The points to evaluate.
enum Points {
    Rows(SaltelliDesign),
    Plain(Sequence),
}

impl Points {
    fn new(blocks: usize, dimensions: usize, rows: usize, sampling: &Sampling<'_>) -> Result<Self, Error> {
        let of = |dimensions| Sequence::sobol(dimensions, sampling.seed, sampling.stream);
        Ok(if blocks == 1 {
            Self::Plain(of(dimensions)?)
        } else {
            Self::Rows(SaltelliDesign::new(of(2 * dimensions)?, rows as u64)?)
        })
    }

    fn each(&self, range: core::ops::Range<usize>, take: &mut dyn FnMut(&[f64])) {
        let first = range.start as u64;
        match self {
            Self::Rows(design) => {
                let mut walk = design.from(first);
                for _ in range {
                    walk.next_point().map(&mut *take);
                }
            }
            Self::Plain(sequence) => {
                let mut walk = sequence.from(first);
                for _ in range {
                    walk.next_point().map(&mut *take);
                }
            }
        }
    }
}

impl Table {
    fn response(&self, i: usize, variables: &[usize]) -> ResponseInfluence {
        let values: Vec<Option<f64>> = self.values.iter().map(|values| values[i]).collect();
        let indices =
            (self.blocks > 1).then(|| sobol_indices(variables.len(), &values, Estimator::Jansen, Bootstrap::default()));
        let indices = indices.and_then(Result::ok);
        // The first two evaluations of a row are independent of each other; the others recombine their variables.
        let is_independent = |k: &usize| self.blocks == 1 || k % self.blocks < 2;
        let independent: Vec<usize> = (0..values.len()).filter(is_independent).collect();
        let designs: Vec<Vec<f64>> = independent.iter().map(|&k| self.designs[k].clone()).collect();
        let results: Vec<Option<f64>> = independent.iter().map(|&k| values[k]).collect();
        let sample = Sample::new(&designs, &results).ok();
        let sample = sample.as_ref();
        let (pearson, spearman) = (sample.map(Sample::pearson), sample.map(Sample::spearman));
        let regression = sample.and_then(|sample| sample.regression().ok());
        let number = |list: &Option<Vec<f64>>, k: usize| Some(*list.as_ref()?.get(k)?);
        let each = variables.iter().enumerate().map(|(k, &variable)| VariableInfluence {
            variable,
            first: indices.as_ref().and_then(|all| all.first.get(k).copied()),
            total: indices.as_ref().and_then(|all| all.total.get(k).copied()),
            correlation: number(&pearson, k),
            rank_correlation: number(&spearman, k),
            regression: regression.as_ref().and_then(|all| all.coefficients.get(k).copied()),
            at_low: None,
            at_high: None,
        });
        ResponseInfluence {
            nominal: None,
            variables: each.collect(),
            determination: regression.as_ref().map(|all| all.determination),
            missing: values.iter().filter(|value| value.is_none()).count(),
        }
    }
}
