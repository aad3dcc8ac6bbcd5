//! The content of a report: every result of a study, or the reason it is missing. From here on nothing depends on the
//! mechanism's type.

use eigentol::branches::Branches;
use eigentol::kernels::{PictureKernels, SummaryKernels};
use eigentol::summary::Summary;
use eigentol::tolerance::{Distribution, FirstOrder, OutputTolerances};
use eigentol::{
    Campbell, Description, Equilibrium, Error, Input, Modes, MonteCarlo, Output, Study, Text, Tolerances, Value,
};

use eigentol_figures::Style;

use crate::Report;
use crate::answer::answer;
use crate::forced::Forced;
use crate::part::Part;
use crate::pictures::{FEW_POSES, POSES, Pictures};

/// Operations that judging a spread may take where an answer is to be there at once.
const QUICK: f64 = 0.0;

/// All the content of a page.
pub(crate) struct Content {
    pub(crate) part: Part,
    pub(crate) title: String,
    pub(crate) declaration: Option<String>,
    pub(crate) description: Description,
    pub(crate) setup: Setup,
    /// For figures that state all their assumptions.
    pub(crate) style: Style,
    /// For figures below a sentence that states their assumptions.
    pub(crate) brief_style: Style,
    pub(crate) equilibrium: Result<Equilibrium, Error>,
    pub(crate) modes: Result<Modes, Error>,
    /// `None` where they are not part of the answer.
    pub(crate) pictures: Option<Result<Pictures, Error>>,
    pub(crate) outputs: Result<OutputTolerances, Error>,
    /// `None` if nothing has a tolerance, or where it is not part of the answer.
    pub(crate) spread: Option<Spreads>,
    /// `None` without excitations.
    pub(crate) forced: Option<Forced>,
    /// Pairs of outputs whose orbits are drawn.
    pub(crate) orbits: Vec<[Output; 2]>,
    /// `None` if no input is swept.
    pub(crate) along: Option<Along>,
}

/// The values and tolerances that were set.
pub(crate) struct Setup {
    pub(crate) inputs: Vec<f64>,
    pub(crate) design: Vec<f64>,
    pub(crate) tolerances: Tolerances,
    /// Indices of the inputs with tolerances, which follow those of the design variables.
    pub(crate) deviating: Vec<usize>,
    /// One for each tolerance.
    pub(crate) distributions: Vec<Distribution>,
}

/// The effect of tolerances.
pub(crate) struct Spreads {
    pub(crate) first: Result<FirstOrder, Error>,
    /// The judgement of the first order; `None` where it is not part of the answer.
    pub(crate) summary: Option<Result<Summary, Error>>,
    /// `None` without samples.
    pub(crate) monte_carlo: Option<Result<MonteCarlo, Error>>,
}

/// Results along an input.
pub(crate) struct Along {
    pub(crate) campbell: Result<Campbell, Error>,
    /// `None` where they are not part of the answer.
    pub(crate) branches: Option<Result<Branches, Error>>,
}

impl Content {
    /// Runs the analyses of the study that a part of its report needs.
    ///
    /// # Errors
    /// Errors of the caller only; any other error is kept and reported in its place.
    pub(crate) fn of<M: SummaryKernels + PictureKernels + Clone>(
        report: &Report<M>,
        part: Part,
    ) -> Result<Self, Error> {
        let study = &report.study;
        let setup = Setup::of(study)?;
        let equilibrium = answer(study.equilibrium())?;
        let modes = match study.whirls() {
            Ok(whirls) => study.modes().map(|modes| modes.with_whirls(whirls)),
            Err(error) => Err(error),
        };
        let modes = answer(modes)?;
        let outputs = match &modes {
            Ok(_) => answer(study.output_tolerances())?,
            Err(error) => Err(error.clone()),
        };
        let at_once = part == Part::AtPoint;
        let pictures = match (&modes, &equilibrium) {
            _ if part == Part::Along => None,
            (Ok(_), _) => {
                let poses = if at_once { FEW_POSES } else { POSES };
                Some(answer(Pictures::of(study, poses))?)
            }
            (Err(_), Ok(_)) => Some(answer(study.picture())?.map(Pictures::at_rest)),
            (Err(error), Err(_)) => Some(Err(error.clone())),
        };
        let varies = setup.tolerances.sigmas().iter().any(|sigma| *sigma > 0.0);
        let spread = match &modes {
            _ if !varies => None,
            Ok(_) => Some(Spreads {
                first: answer(study.first_order())?,
                summary: match part {
                    Part::AtPoint => None,
                    Part::Along => Some(answer(study.summary_within(QUICK))?),
                    Part::All => Some(answer(study.summary())?),
                },
                monte_carlo: if part == Part::All { Some(answer(study.monte_carlo())?) } else { None },
            }),
            Err(error) => Some(Spreads {
                first: Err(error.clone()),
                summary: Some(Err(error.clone())),
                monte_carlo: Some(Err(error.clone())),
            }),
        };
        let description = study.description().clone();
        let swept = match &report.along {
            Some((input, values)) if !at_once => Some((*input, values_si(study, *input, values)?)),
            _ => None,
        };
        let swept = swept.as_ref().map(|(input, values)| (*input, &values[..]));
        let forced =
            if description.excitations.is_empty() { None } else { Some(Forced::of(study, swept, varies && !at_once)?) };
        let along = swept.map(|along| Along::of(study, along, &report.orders, part));
        Ok(Self {
            part,
            title: (report.title.clone()).unwrap_or_else(|| description.name.to_string()),
            declaration: report.declaration.clone(),
            description,
            setup,
            style: report.style.clone().design_of(study),
            brief_style: report.style.clone(),
            equilibrium,
            pictures,
            modes,
            outputs,
            spread,
            forced,
            orbits: report.orbits.clone(),
            along: along.transpose()?,
        })
    }
}

impl Setup {
    fn of<M: SummaryKernels>(study: &Study<M>) -> Result<Self, Error> {
        let inputs = study.input_values().to_vec();
        let design = study.design_values().to_vec();
        let tolerances = study.tolerances()?;
        let deviating = study.deviating_inputs();
        let deviating: Vec<usize> = deviating.iter().map(|input| input.index()).collect();
        let moved = deviating.iter().filter_map(|&input| inputs.get(input));
        let nominal: Vec<f64> = design.iter().chain(moved).copied().collect();
        Ok(Self { distributions: tolerances.distributions(&nominal)?, inputs, design, tolerances, deviating })
    }
}

impl Along {
    fn of<M: SummaryKernels>(
        study: &Study<M>,
        (input, values): (Input<M>, &[f64]),
        orders: &[f64],
        part: Part,
    ) -> Result<Self, Error> {
        let campbell = answer(study.campbell(input, values, orders))?;
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Ok(Self {
            campbell,
            // Without a range there are no branches: sweeping one value or none is not an error.
            branches: (part == Part::All).then(|| study.branches(input, low, high)),
        })
    }
}

/// Values of an input, SI.
fn values_si<M: SummaryKernels>(study: &Study<M>, input: Input<M>, values: &[Value]) -> Result<Vec<f64>, Error> {
    let si = |value: &Value| Ok(study.continuation(input, *value, *value)?.low);
    let values = values.iter().map(si).collect::<Result<Vec<f64>, Error>>()?;
    if let Some(value) = values.iter().copied().find(|value| !value.is_finite()) {
        let info = study.description().inputs.get(input.index());
        return Err(Error::NotFinite {
            kind: "input",
            name: info.map_or(Text::Static("?"), |info| info.name.clone()),
            value,
        });
    }
    Ok(values)
}
