//! Files and reference numbers stored in the repository: no Python needed.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::reference::{Robot, TOLERANCE, options, texts};

pub(crate) fn truth(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("truth").join(path)
}

pub(crate) fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn panda() -> (Robot, Value) {
    let robot = Robot::new(&read(&truth("urdf/panda.urdf")), &options(false), &[]);
    let numbers = read(&truth("robots/Panda.json"));
    (robot.expect("a robot"), serde_json::from_str(&numbers).expect("JSON"))
}

/// Two fingers, one of which follows the other.
#[test]
fn panda_is_that_of_pinocchio() {
    let (robot, truth) = panda();
    let states = truth["states"].as_array().expect("states");
    robot.assert_right("Panda", &texts(&truth["coordinates"]), states, &[]);
    assert_eq!(robot.subject.unknowns.len(), 10);
    assert_eq!(robot.import.names.len(), 0, "{:?}", robot.import.names);
}

/// The numbers written by `reference.py`, for fixed and floating bases, with positions of links.
#[test]
fn robots_are_those_of_pinocchio() {
    let list: Value = serde_json::from_str(&read(&truth("urdf/reference.json"))).expect("JSON");
    let robots = list.as_array().expect("a list");
    assert_eq!(robots.len(), 4);
    for one in robots {
        let file = one["file"].as_str().expect("a file");
        let floating = one["floating"].as_bool().expect("a base");
        let text = read(&truth("urdf").join(file));
        let robot = Robot::new(&text, &options(floating), &[]).expect("a robot");
        let points = texts(&one["points"]);
        let points: Vec<String> = points.iter().map(|point| robot.declared(point)).collect();
        let robot = Robot::new(&text, &options(floating), &points).expect("a robot");
        let states = one["states"].as_array().expect("states");
        robot.assert_right(file, &texts(&one["coordinates"]), states, &points);
    }
}

/// A comparison that cannot fail proves nothing: a mass that is off by one part in 10^8 is detected.
#[test]
fn a_small_fault_is_found() {
    let text = read(&truth("urdf/panda.urdf"));
    let wrong = text.replace("1.225946", "1.22594602");
    assert_ne!(text, wrong);
    let robot = Robot::new(&wrong, &options(false), &[]).expect("a robot");
    let (_, truth) = panda();
    let states = truth["states"].as_array().expect("states");
    let errors = robot.errors(&texts(&truth["coordinates"]), states, &[]);
    let wrong = errors.iter().filter(|(_, error)| *error > TOLERANCE);
    assert!(wrong.count() >= 6, "{errors:?}");
}
