//! What the library answers: frequencies, damping ratios, outputs and amplitudes, with their exact derivatives by all inputs and
//! design variables. All is SI.

use eigentol::response::{Response, Vibration};
use eigentol::sensitivity::Slopes;
use eigentol::{Description, DesignVariable, Error, Input, Quantity, Study, Unit};

use crate::{INPUTS, MECHANISM};

/// Modes that are answered: the first ones that oscillate.
const MODES: usize = 2;

/// A number that goes in or out.
pub(crate) struct Variable {
    pub(crate) name: String,
    /// In which it is declared.
    pub(crate) unit: Unit,
    /// Where it begins, SI.
    pub(crate) start: f64,
    /// Whether it is an input: it may change while others run.
    pub(crate) is_input: bool,
}

/// Inputs, then design variables.
pub(crate) fn variables() -> Vec<Variable> {
    let study = Study::new(MECHANISM);
    let d = study.description();
    let variable = |name: &str, unit: &Unit, start, is_input| Variable {
        name: name.to_owned(),
        unit: unit.clone(),
        start,
        is_input,
    };
    let inputs = d.inputs.iter().zip(INPUTS).map(|(info, start)| variable(&info.name, &info.unit, start, true));
    let design = d.design.iter().map(|info| variable(&info.name, &info.unit, info.nominal, false));
    inputs.chain(design).collect()
}

/// Names and units of the answers.
pub(crate) fn names() -> Vec<(String, Unit)> {
    let study = Study::new(MECHANISM);
    let d = study.description();
    let of_mode = |k: usize| {
        [
            (format!("frequency_{}", k + 1), Unit { symbol: "rad/s".into(), scale: 1.0 }),
            (format!("damping_ratio_{}", k + 1), Unit { symbol: "".into(), scale: 1.0 }),
        ]
    };
    let outputs = d.outputs.iter().map(|info| (info.name.to_string(), info.unit.clone()));
    let vibrations = Vibration::all(d).into_iter().map(|vibration| {
        let response = Response::Vibration(vibration);
        (format!("amplitude of {}", response.name(d)), response.unit(d))
    });
    (0..MODES).flat_map(of_mode).chain(outputs).chain(vibrations).collect()
}

/// The values, and a row of derivatives for each.
#[derive(Clone)]
pub(crate) struct Answers {
    pub(crate) values: Vec<f64>,
    pub(crate) rows: Vec<Vec<f64>>,
}

fn study(x: &[f64]) -> Study<crate::Rotor> {
    let (inputs, design) = x.split_at(INPUTS.len());
    let mut study = Study::new(MECHANISM);
    for (k, &value) in inputs.iter().enumerate() {
        study = study.input(Input::new(k), value);
    }
    for (k, &value) in design.iter().enumerate() {
        study = study.design(DesignVariable::new(k), value);
    }
    study
}

/// The answers at these inputs and this design.
pub(crate) fn answers(x: &[f64]) -> Result<Answers, String> {
    if x.len() != variables().len() {
        return Err(format!("{} values are given", x.len()));
    }
    solved(&study(x))
        .map_err(|error| error.to_string())?
        .ok_or_else(|| "a mode, an amplitude or its derivative is missing".to_owned())
}

fn solved(study: &Study<crate::Rotor>) -> Result<Option<Answers>, Error> {
    let d: &Description = study.description();
    let (modes, slopes) = (study.modes()?, study.sensitivities()?);
    let (outputs, forced) = (study.outputs()?, study.forced_sensitivities()?);
    let mut all = Answers { values: Vec::new(), rows: Vec::new() };
    let mut shown: Vec<usize> = modes.foremost(modes.modes.len());
    shown.retain(|&mode| modes.modes[mode].frequency().is_some());
    for k in 0..MODES {
        let Some(&mode) = shown.get(k) else { return Ok(None) };
        for quantity in [Quantity::Frequency, Quantity::DampingRatio] {
            let value = match quantity {
                Quantity::Frequency => modes.modes[mode].frequency(),
                _ => modes.modes[mode].damping_ratio(),
            };
            let (Some(value), Some(slopes)) = (value, slopes.modes[mode].of(quantity)) else { return Ok(None) };
            all.push(value, &slopes);
        }
    }
    for (k, value) in outputs.values.iter().enumerate() {
        let (Some(by_input), Some(by_design)) = (&outputs.by_input[k], &outputs.by_design[k]) else { return Ok(None) };
        all.push(*value, &Slopes { by_input: by_input.clone(), by_design: by_design.clone() });
    }
    for vibration in Vibration::all(d) {
        let (Some(value), Some(slopes)) = (vibration.of(&forced.response), vibration.slopes(&forced)) else {
            return Ok(None);
        };
        all.push(value, &slopes);
    }
    Ok(Some(all))
}

impl Answers {
    fn push(&mut self, value: f64, slopes: &Slopes<f64>) {
        self.values.push(value);
        self.rows.push(slopes.by_input.iter().chain(slopes.by_design.iter()).copied().collect());
    }
}
