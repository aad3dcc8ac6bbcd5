//! The questions of a page, and their answers.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use eigentol::{Input, Quantity, Study, judge};
use eigentol_compiler::syntax::ast::Ast;
use eigentol_figures::Style;
use eigentol_interpreter::{Interpreted, declaration, orders, range, rewritten};
use eigentol_report::{Part, Report, Section};
use serde::{Deserialize, Serialize};

use crate::controls::{in_unit, usual_sweep, values};
use crate::given::Given;
use crate::machine::{Machine, Subject};

/// Modes with derivatives beside the controls.
const MODES: usize = 6;
/// Values along an input, unless the page says how many.
const POINTS: usize = 41;
/// Most values along an input.
const MOST_POINTS: usize = 2000;
/// Seconds that samples may take, unless the page says how many.
const PATIENCE: f64 = 5.0;

/// What a page asks.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Question {
    ask: Ask,
    #[serde(default)]
    given: Given,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Ask {
    /// Sections of the operating point, with derivatives.
    AtPoint,
    /// Sections along an input.
    Along,
    /// All sections.
    All,
    /// A report as a file.
    Report,
    /// A study file.
    Study,
    /// The declaration with the values and tolerances of the page.
    Declaration,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Answer {
    Sections {
        sections: Vec<Section>,
        slopes: Option<Slopes>,
        /// The values of the controls by name, each in its unit.
        values: BTreeMap<String, f64>,
    },
    File {
        name: String,
        text: String,
        note: Option<String>,
    },
}

/// Derivatives of frequencies by what can be changed.
#[derive(Debug, Serialize)]
pub(crate) struct Slopes {
    /// Of the frequencies.
    unit: String,
    modes: Vec<Mode>,
    /// By name, of each of these modes, per unit of the control; `None` where there is no derivative.
    by: BTreeMap<String, Vec<Option<f64>>>,
    /// By name, the share in the variance of each of these modes.
    shares: BTreeMap<String, Vec<f64>>,
}

#[derive(Debug, Serialize)]
struct Mode {
    name: String,
    frequency: f64,
    /// Half the width of the band; `None` where nothing spreads it.
    band: Option<f64>,
}

/// Shows how far work is, and ends it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Watch {
    pub(crate) steps: Arc<AtomicUsize>,
    pub(crate) stop: Arc<AtomicBool>,
}

impl Question {
    /// Answers, or says why not.
    pub(crate) fn answer(&self, machine: &Machine, subject: &Subject, watch: &Watch) -> Result<Answer, String> {
        let given = &self.given;
        let text = |error: &dyn ToString| error.to_string();
        let ast = declaration(&machine.text).map_err(|error| text(&error))?;
        let study = given.apply(machine.study.clone(), &ast).map_err(|error| text(&error))?;
        let part = match self.ask {
            Ask::Study => {
                let own = given.study_file(&subject.settings).map_err(|error| text(&error))?;
                let name = format!("{}.toml", study.description().name);
                return Ok(Answer::File { name, text: own, note: None });
            }
            Ask::Declaration => return Ok(declared(machine, &ast, subject, given)),
            Ask::AtPoint => Part::AtPoint,
            Ask::Along => Part::Along,
            Ask::All | Ask::Report => Part::All,
        };
        let steps = watch.steps.clone();
        let study = study.stop(watch.stop.clone()).progress(move |more| {
            steps.fetch_add(more, Ordering::Relaxed);
        });
        let study = match part {
            Part::All => study.clone().samples(samples(&study, given.samples)?),
            _ => study,
        };
        let mut report = Report::new(&study).declaration(&machine.text);
        if part != Part::AtPoint {
            report = along(report, &study, given)?;
        }
        if self.ask == Ask::Report {
            let name = format!("{}.html", study.description().name);
            return Ok(Answer::File { name, text: report.html().map_err(|error| text(&error))?, note: None });
        }
        let sections = report.sections(part).map_err(|error| text(&error))?;
        let slopes = if part == Part::Along { None } else { slopes(&study) };
        let values = values(&study).map(|(_, name, unit, value)| (name.to_owned(), in_unit(unit, value)));
        Ok(Answer::Sections { sections, slopes, values: values.collect() })
    }
}

fn samples(study: &Study<Interpreted>, given: Option<usize>) -> Result<usize, String> {
    match given {
        Some(0) => Err("0 samples have no result: take at least 1".to_owned()),
        Some(count) => Ok(count),
        None => Ok(study.modes().map_or(1000, |modes| judge::affordable(&modes, PATIENCE))),
    }
}

/// The report along the range that the page gives or the usual one, if there is any.
fn along(
    report: Report<Interpreted>,
    study: &Study<Interpreted>,
    given: &Given,
) -> Result<Report<Interpreted>, String> {
    let Some(text) = given.sweep.clone().or_else(|| usual_sweep(study)) else {
        return Ok(report);
    };
    let along = range(study, &text).map_err(|error| error.to_string())?;
    let count = given.points.unwrap_or(POINTS);
    if !(2..=MOST_POINTS).contains(&count) {
        return Err(format!("{count} values along an input: write a number from 2 to {MOST_POINTS}"));
    }
    let step = (along.high - along.low) / (count - 1) as f64;
    let values: Vec<f64> = (0..count - 1).map(|k| along.low + k as f64 * step).chain([along.high]).collect();
    let lines = match &given.orders {
        Some(own) => orders(study, &along, own).map_err(|error| error.to_string())?,
        None => orders(study, &along, &[1.0]).unwrap_or_default(),
    };
    Ok(report.sweep(Input::new(along.input.index()), &values).orders(&lines))
}

/// The declaration of the page.
fn declared(machine: &Machine, ast: &Ast, subject: &Subject, given: &Given) -> Answer {
    let d = machine.study.description();
    let began = |key: &str| -> BTreeMap<String, String> {
        let table = subject.settings.get(key).and_then(toml::Value::as_table);
        let each = table.into_iter().flatten();
        each.filter_map(|(name, value)| Some((name.clone(), value.as_str()?.to_owned()))).collect()
    };
    let over = |key: &str, own: &BTreeMap<String, String>| {
        let mut all = began(key);
        all.extend(own.clone());
        all
    };
    let (values, tolerances) = (over("set", &given.set), over("tolerance", &given.tolerance));
    let (text, unsaid) = rewritten(&machine.text, ast, d, &values, &tolerances);
    let note = (!unsaid.is_empty()).then(|| {
        format!("not in the text, where others share their line: {}. A study file has them.", unsaid.join(", "))
    });
    Answer::File { name: subject.name.clone(), text, note }
}

/// Derivatives of the first modes that oscillate; `None` where there are no modes.
fn slopes(study: &Study<Interpreted>) -> Option<Slopes> {
    let (modes, sensitivities) = (study.modes().ok()?, study.sensitivities().ok()?);
    let first = study.first_order().ok();
    let d = study.description();
    let style = Style::default();
    let (scale, unit) = style.frequency(d);
    let oscillates = |mode: &usize| modes.modes[*mode].frequency().is_some();
    let shown: Vec<usize> = modes.foremost(MODES).into_iter().filter(oscillates).collect();
    let spread = |mode: usize| first.as_ref()?.modes.get(mode).filter(|own| !own.clustered)?.frequency();
    let of_mode = |&mode: &usize| {
        let band = spread(mode).map(|spread| scale * spread.band).filter(|band| *band > 0.0);
        let frequency = scale * modes.modes[mode].frequency().unwrap_or_default();
        Mode { name: style.mode(mode), frequency, band }
    };
    let rates: Vec<Option<Vec<f64>>> = shown
        .iter()
        .map(|&mode| {
            let own = sensitivities.modes.get(mode).filter(|own| !own.clustered)?;
            Some(own.of(Quantity::Frequency)?.iter().collect())
        })
        .collect();
    let parameters = d.inputs.iter().map(|info| (&info.name, &info.unit));
    let parameters: Vec<_> = parameters.chain(d.design.iter().map(|info| (&info.name, &info.unit))).collect();
    let by = parameters.iter().enumerate().map(|(k, (name, own))| {
        let each = rates.iter().map(|rates| Some(scale * own.scale * rates.as_ref()?.get(k)?));
        (name.to_string(), each.collect())
    });
    let deviating: Vec<usize> = study.deviating_inputs().iter().map(|input| input.index()).collect();
    let places = d.design.iter().map(|info| &info.name).chain(deviating.iter().map(|&k| &d.inputs[k].name));
    let shares = places.enumerate().map(|(k, name)| {
        let each = shown.iter().map(|&mode| {
            let shares = spread(mode).map(|spread| spread.variance_shares);
            shares.and_then(|shares| shares.get(k).copied()).unwrap_or_default()
        });
        (name.to_string(), each.collect())
    });
    Some(Slopes { unit, modes: shown.iter().map(of_mode).collect(), by: by.collect(), shares: shares.collect() })
}
