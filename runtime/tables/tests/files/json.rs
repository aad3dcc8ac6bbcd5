//! Documents as read by a program in another language, and refused documents.

use std::io;

use eigentol::requirement::Requirement;
use eigentol::response::Response;
use eigentol::{Equilibrium, FirstOrder, InDeclaredUnit, Modes, Quantity, Study, mechanism};
use eigentol_tables::{Answer, Error, Values, json};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::common::Disk;

mechanism! {
    mechanism Swing {
        input speed: rpm;
        design l = 1000 mm +/- 30 mm;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: 3 kg, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at speed;
        joint theta: revolute(y) from shaft to bar;
    }
}

fn modes() -> Modes {
    let study = Study::new(Swing).input(Swing::speed, InDeclaredUnit(60.0));
    study.start(Swing::theta, 1.0).modes().expect("modes")
}

fn text() -> String {
    json::to_string(&modes()).expect("text")
}

/// The document with a field set to another value.
fn with(field: &str, value: Value) -> String {
    let mut document: Value = serde_json::from_str(&text()).expect("JSON");
    document[field] = value;
    document.to_string()
}

#[test]
fn another_program_finds_its_way() {
    let document: Value = serde_json::from_str(&text()).expect("JSON");
    assert_eq!(document["format"], "eigentol");
    assert_eq!(document["version"], 1);
    assert_eq!(document["kind"], "modes");
    assert_eq!(document["mechanism"], "Swing");
    assert_eq!(document["inputs"]["speed"]["unit"], "rpm");
    let speed = document["inputs"]["speed"]["value"].as_f64().expect("a number");
    assert!((speed - 60.0).abs() < 1e-12);
    let columns = document["tables"][0]["columns"].as_array().expect("columns");
    let frequency = columns.iter().find(|column| column["name"] == "frequency").expect("a column");
    assert_eq!(frequency["unit"], "rad/s");
    assert_eq!(frequency["kind"], "numbers");
    assert_eq!(frequency["values"][0].as_f64(), modes().frequencies()[0]);
}

#[test]
fn a_result_comes_back_with_its_description() {
    let back: Modes = json::read(text().as_bytes()).expect("modes");
    assert_eq!(back, modes());
    assert_eq!(back.tables(), modes().tables());
}

/// A mode without a neighbour has an infinite distance to the next one.
#[test]
fn what_is_infinite_is_a_word_in_the_result_and_missing_in_the_tables() {
    let study = Study::new(Swing).input(Swing::speed, InDeclaredUnit(60.0));
    let first = study.start(Swing::theta, 1.0).first_order().expect("spreads");
    let text = json::to_string(&first).expect("text");
    assert!(text.contains(r#""distance_to_neighbour":"Infinity""#), "{text}");
    assert_eq!(json::read::<FirstOrder>(text.as_bytes()).expect("spreads"), first);
    let tables = json::read_tables(text.as_bytes()).expect("tables");
    let column = tables[0].column("distance to neighbour").expect("a column");
    assert_eq!(column.values, Values::Numbers(vec![None]));
}

#[test]
fn other_documents_are_refused() {
    let refused = |text: String| json::read::<Modes>(text.as_bytes()).expect_err("refused");
    let error = refused(with("version", 7.into()));
    assert_eq!(
        error.to_string(),
        "the document is of version 7, written by \"eigentol-tables 0.1.0\"; this program reads version 1: write it again with this \
         program, or read it with the one that wrote it"
    );
    assert!(matches!(refused(with("version", Value::Null)), Error::Version { .. }));
    assert!(matches!(refused(with("format", "other".into())), Error::Foreign));
    assert!(matches!(refused("[1, 2]".to_owned()), Error::Foreign));
    assert!(matches!(refused("no JSON".to_owned()), Error::Malformed { line: 1, .. }));
    assert!(matches!(refused(with("result", Value::Null)), Error::Content(_)));
    let error = json::read::<Equilibrium>(text().as_bytes()).expect_err("another kind");
    assert_eq!(error.to_string(), "the document holds `modes`, not `equilibrium`");
}

/// Each list of the result in turn loses its last entry or has it doubled: refused before anything is built from it.
fn lists_of_other_lengths_are_refused<A: Answer + Serialize + DeserializeOwned>(answer: &A) {
    let text = json::to_string(answer).expect("text");
    let whole: Value = serde_json::from_str(&text).expect("JSON");
    assert!(json::read::<A>(text.as_bytes()).is_ok(), "{}", A::KIND);
    let schema: Value = serde_json::from_str(json::SCHEMA).expect("JSON");
    let kinds = schema["properties"]["kind"]["enum"].as_array().expect("kinds");
    assert!(kinds.iter().any(|kind| kind == A::KIND), "{}", A::KIND);
    for change in [shorter, longer] {
        for list in 0.. {
            let mut damaged = whole.clone();
            let mut left = list;
            if !resize(&mut damaged["result"], &mut left, change) {
                assert!(list > 0);
                break;
            }
            if damaged == whole {
                continue;
            }
            let read = json::read::<A>(damaged.to_string().as_bytes());
            assert!(
                matches!(&read, Err(Error::Content(reason)) if reason.contains("lengths")),
                "{}: {damaged}",
                A::KIND
            );
        }
    }
}

fn shorter(all: &mut Vec<Value>) {
    all.pop();
}

fn longer(all: &mut Vec<Value>) {
    all.extend(all.last().cloned());
}

/// Changes the list that comes after `left` others; returns whether there was one.
fn resize(value: &mut Value, left: &mut usize, change: fn(&mut Vec<Value>)) -> bool {
    match value {
        Value::Array(all) if *left == 0 => {
            change(all);
            true
        }
        Value::Array(all) => {
            *left -= 1;
            all.iter_mut().any(|x| resize(x, left, change))
        }
        Value::Object(fields) => fields.values_mut().any(|field| resize(field, left, change)),
        _ => false,
    }
}

#[test]
fn damaged_results_do_no_harm() {
    let study = Study::new(Swing).input(Swing::speed, InDeclaredUnit(60.0));
    let study = study.start(Swing::theta, 1.0).samples(64).keep_samples(true);
    let state = study.equilibrium().expect("a state");
    let modes = study.modes().expect("a state");
    lists_of_other_lengths_are_refused(&state);
    lists_of_other_lengths_are_refused(&modes);
    lists_of_other_lengths_are_refused(&study.equilibrium_shift().expect("derivatives"));
    lists_of_other_lengths_are_refused(&study.outputs().expect("outputs"));
    lists_of_other_lengths_are_refused(&study.sensitivities().expect("derivatives"));
    lists_of_other_lengths_are_refused(&study.first_order().expect("spreads"));
    lists_of_other_lengths_are_refused(&study.second_order().expect("spreads"));
    lists_of_other_lengths_are_refused(&study.summary().expect("a summary"));
    let few = study.clone().samples(3);
    lists_of_other_lengths_are_refused(&few.monte_carlo().expect("samples"));
    let sweep = study.sweep(Swing::speed, &[6.0, 6.1, 6.2]).expect("a sweep");
    lists_of_other_lengths_are_refused(&sweep);
    let responses = [Response::Mode { mode: 0, quantity: Quantity::Frequency }];
    lists_of_other_lengths_are_refused(&study.propagate(&responses).expect("spreads"));
    lists_of_other_lengths_are_refused(&study.worst_case(&responses).expect("limits"));
    lists_of_other_lengths_are_refused(&study.influence(&responses).expect("shares"));
    let wanted = [Requirement::at_least(responses[0], 5.8)];
    lists_of_other_lengths_are_refused(&study.chances(&wanted).expect("chances"));
    lists_of_other_lengths_are_refused(&study.reliability(&wanted).expect("points"));
    lists_of_other_lengths_are_refused(&study.output_tolerances().expect("spreads"));
    lists_of_other_lengths_are_refused(&study.mode_curvature(0).expect("derivatives"));
    lists_of_other_lengths_are_refused(&study.shape_sensitivity(0).expect("derivatives"));
    lists_of_other_lengths_are_refused(&study.whirls().expect("a state"));
    let along = study.directional_derivatives(0, (&[1.0], &[1.0]));
    lists_of_other_lengths_are_refused(&along.expect("derivatives"));
    let speeds = [6.0, 6.1, 6.2];
    let diagram = study.campbell(Swing::speed, &speeds, &[1.0]);
    lists_of_other_lengths_are_refused(&diagram.expect("a diagram"));
    let branches = study.branches(Swing::speed, 3.0, 6.0).expect("branches");
    lists_of_other_lengths_are_refused(&branches.branches[0]);
    let critical = study.critical_tolerance(Swing::speed, 2.0, 6.0);
    lists_of_other_lengths_are_refused(&critical.expect("a critical speed"));
}

/// A document without them, or for a description that has changed.
#[test]
fn lengths_are_those_of_the_description_too() {
    let lost = serde_json::from_str::<Value>(&text()).expect("JSON");
    let mut damaged = lost.clone();
    damaged["description"]["design"] = Value::Array(Vec::new());
    let mut without = lost;
    let _ = without.as_object_mut().expect("fields").remove("lengths");
    for text in [damaged, without] {
        let error = json::read::<Modes>(text.to_string().as_bytes()).expect_err("refused");
        assert!(matches!(error, Error::Content(_)), "{error}");
    }
}

#[test]
fn a_document_that_is_cut_off_is_refused() {
    let text = text();
    let whole = text.trim_end().len();
    for end in 0..whole {
        let error = json::read::<Modes>(&text.as_bytes()[..end]).expect_err("cut off");
        assert!(error.to_string().contains("cut off"), "{end}: {error}");
    }
}

#[test]
fn a_full_disk_is_an_error() {
    let size = text().len();
    assert!(json::write(&modes(), Disk(size)).is_ok());
    for room in 0..size {
        let error = json::write(&modes(), Disk(room)).expect_err("no room");
        assert!(matches!(&error, Error::Write(own) if own.kind() == io::ErrorKind::StorageFull), "{error:?}");
    }
}
