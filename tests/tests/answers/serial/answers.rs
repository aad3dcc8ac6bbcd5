//! Every result of every machine, written as JSON and read back.

use std::fmt::Debug;

use eigentol::allocation::{Choices, Cost, HalfWidth};
use eigentol::clusters::ClusterTolerance;
use eigentol::forced::Measure;
use eigentol::requirement::Requirement;
use eigentol::response::{Response, Vibration};
use eigentol::second_order::EventCurvature;
use eigentol::sweep::{CriticalState, Crossing, EventTolerance};
use eigentol::{Coordinate, Error, Excitation, Input, Output, Quantity, Study};
use eigentol_interpreter::Interpreted;
use eigentol_tables::{Answer, json};
use eigentol_tests::corpus::declarations;
use eigentol_tests::machines;
use eigentol_tests::rederived::{Operation, operating_points};
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::schema::refused;

/// For more unknowns than this, only cheap results are requested.
const SMALL: usize = 3;

#[derive(Default)]
struct Answers {
    answered: usize,
    refused: usize,
    peaks: usize,
}

impl Answers {
    /// Writes and reads back in a human-readable and in a binary format.
    fn plain<T: Serialize + DeserializeOwned + PartialEq + Debug>(&mut self, name: &str, answer: &T) {
        let text = serde_json::to_string(answer).unwrap_or_else(|error| panic!("{name}: {error}"));
        let from_text: T = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{name}: {error}\n{text}"));
        let bytes = postcard::to_stdvec(answer).unwrap_or_else(|error| panic!("{name}: {error}\n{text}"));
        let from_bytes: T = postcard::from_bytes(&bytes).unwrap_or_else(|error| panic!("{name}: {error}\n{text}"));
        for back in [from_text, from_bytes] {
            // Debug output distinguishes infinite numbers, and zeros by their sign.
            assert_eq!(format!("{back:?}"), format!("{answer:?}"), "{name}");
            assert_eq!(back, *answer, "{name}");
        }
        self.answered += 1;
    }

    /// Writes and reads back in a document, including errors.
    fn both<A: Answer + Serialize + DeserializeOwned + PartialEq + Debug>(
        &mut self,
        name: &str,
        answer: Result<A, Error>,
    ) {
        self.plain(name, &answer);
        let Ok(answer) = answer else {
            self.refused += 1;
            return;
        };
        let text = json::to_string(&answer).unwrap_or_else(|error| panic!("{name}: {error}"));
        let back: A = json::read(text.as_bytes()).unwrap_or_else(|error| panic!("{name}: {error}\n{text}"));
        assert_eq!(back, answer, "{name}");
        let document = serde_json::from_str(&text).expect("JSON");
        let refused = refused(&document);
        assert!(refused.is_empty(), "{name}, {}: {refused:?}", A::KIND);
        let tables = json::read_tables(text.as_bytes()).expect("tables");
        assert_eq!(tables, answer.tables(), "{name}");
    }

    fn ask(&mut self, name: &str, machine: Interpreted, operation: &Operation) {
        let mut study = Study::new(machine).policy(operation.policy).samples(20).steps(4).threads(1).keep_samples(true);
        for (k, &value) in operation.inputs.iter().enumerate() {
            study = study.input(Input::new(k), value);
        }
        for (k, &value) in operation.start.iter().enumerate() {
            study = study.guess(Coordinate::new(k), value);
        }
        let state = study.equilibrium().expect("an equilibrium with modes");
        self.both(name, Ok(state.clone()));
        self.both(name, study.modes());
        self.both(name, study.assembly());
        self.both(name, study.equilibrium_shift());
        self.both(name, study.outputs());
        self.both(name, study.output_tolerances());
        self.both(name, study.sensitivities());
        self.both(name, study.first_order());
        self.both(name, study.second_order());
        self.both::<Vec<ClusterTolerance>>(name, study.clusters());
        self.both(name, study.monte_carlo());
        self.both(name, study.whirls());
        self.plain(name, &study.picture().expect("a picture"));
        let swing = study.mode_pictures(0, 4, 0.1);
        self.plain(name, &swing.expect("a mode"));
        self.both(name, study.shape_sensitivity(0));
        self.both(name, study.mode_curvature(0));
        if !state.description.outputs.is_empty() {
            self.both(name, study.output_curvature(Output::new(0)));
        }
        let (u, b) = (vec![1.0; operation.inputs.len()], vec![1.0; study.design_values().len()]);
        self.both(name, study.directional_derivatives(0, (&u, &b)));
        if !state.description.excitations.is_empty() {
            self.ask_of_vibration(name, &study);
        }
        if state.coordinates.len() <= SMALL {
            self.ask_of_chance(name, &study);
            if let Some(&value) = operation.inputs.first() {
                self.ask_along(name, &study, value);
            }
        }
    }

    fn ask_of_vibration(&mut self, name: &str, study: &Study<Interpreted>) {
        let all = Vibration::all(study.description());
        let response = study.forced_response();
        if let Ok(Some(harmonic)) = response.as_ref().map(|response| response.harmonics.first()) {
            let [x, y] = [all[0].output, all[1].output];
            let orbit = harmonic.orbit(x, y).expect("outputs");
            self.plain(name, &orbit);
            self.plain(name, &orbit.turning());
            self.plain(name, &harmonic.unknown_phases(x, Measure::Velocity));
        }
        self.both(name, response);
        self.both(name, study.forced_sensitivities());
        self.both(name, study.share_sensitivities());
        self.both(name, study.forced_curvature());
        self.both(name, study.vibration_spread(&all));
        let pictures = study.vibration_pictures(Excitation::new(0), 4, 0.1);
        self.plain(name, &pictures);
        for (input, &value) in study.input_values().iter().enumerate() {
            let input = Input::new(input);
            self.both(name, study.bode(input, &[0.0, value]));
            self.both(name, study.bode_bands(input, &[value], &all[..2], 8));
            for vibration in &all {
                let found = study.peaks(*vibration, input, 0.2 * value, 1.4 * value);
                self.both(name, found.clone());
                let Ok(found) = found else { continue };
                self.peaks += found.peaks.len();
                self.both(name, Ok(vec![found.clone()]));
                self.both(name, Ok(found.separation([0.9 * value, value])));
            }
        }
    }

    fn ask_of_chance(&mut self, name: &str, study: &Study<Interpreted>) {
        let mode = Response::Mode { mode: 0, quantity: Quantity::Frequency };
        let mut responses = vec![mode];
        if !study.description().outputs.is_empty() {
            responses.push(Response::Output(Output::new(0)));
        }
        self.both(name, study.summary());
        self.both(name, study.propagate(&responses));
        self.both(name, study.worst_case(&responses));
        self.both(name, study.influence(&responses));
        let frequency = study.modes().expect("modes").frequencies()[0].unwrap_or(1.0);
        let wanted = [Requirement::at_least(mode, 0.99 * frequency), Requirement::Stable];
        self.plain(name, &wanted.to_vec());
        self.both(name, study.chances(&wanted));
        self.both(name, study.reliability(&wanted));
        if name == "rotating_pendulum" {
            let widths = HalfWidth { variable: 0, limits: (1e-6, 1e-1), cost: Cost::reciprocal(0.0, 1.0, 1.0) };
            let choices = Choices { half_widths: vec![widths], nominals: Vec::new(), failure: vec![0.1, 0.1] };
            self.both(name, study.allocation(&wanted, &choices));
        }
    }

    fn ask_along(&mut self, name: &str, study: &Study<Interpreted>, value: f64) {
        let input = Input::new(0);
        let values = [value, 1.01 * value, 1.02 * value];
        let (low, high) = (0.5 * value, 1.5 * value);
        self.both(name, study.sweep(input, &values));
        self.both(name, study.campbell(input, &values, &[1.0]));
        self.both(name, study.branches(input, low, high));
        self.both::<CriticalState>(name, study.critical_state(input, low, high));
        self.both::<EventTolerance>(name, study.critical_tolerance(input, low, high));
        self.both::<EventCurvature>(name, study.critical_curvature(input, low, high));
        self.both::<Vec<Crossing>>(name, study.crossings(input, low, high, 1.0));
        self.both::<Vec<EventTolerance>>(name, study.crossing_tolerances(input, low, high, 1.0));
        self.both::<Vec<Crossing>>(name, study.flutter_onsets(input, low, high));
        self.plain(name, &study.continuation(input, low, high));
    }
}

/// The answers of every so many-th machine.
fn answers(step: usize) -> Answers {
    let mut answers = Answers::default();
    for (name, declaration) in declarations().into_iter().chain(machines::declarations()).step_by(step) {
        let machine = Interpreted::from_text(declaration).expect("a declaration");
        let operation = operating_points(name).into_iter().next();
        answers.ask(name, machine, &operation.expect("a point"));
    }
    answers
}

#[test]
fn answers_come_back() {
    let Answers { answered, refused, peaks } = answers(2);
    assert!(answered > 200 && refused > 5 && peaks > 2, "{answered} {refused} {peaks}");
}

#[test]
#[ignore = "ten seconds"]
fn answers_of_every_machine_come_back() {
    let Answers { answered, refused, peaks } = answers(1);
    assert!(answered > 400 && refused > 10 && peaks > 4, "{answered} {refused} {peaks}");
}
