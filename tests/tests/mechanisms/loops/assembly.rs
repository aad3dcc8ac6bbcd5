//! Assembly from values at which no loop is closed: the held coordinates decide, and the start values of the others
//! choose the assembly mode.

use eigentol::equilibrium::{Assembly, AssemblyMode, assemble};
use eigentol::{Coordinate, Error, Mechanism, Study};
use eigentol_tests::loops::{FiveBar, FourBar};

use super::common::{Case, Point, assert_close};
use super::study::study;

/// Assembled with the named coordinates held at the file's values and the others starting near them.
fn assembled(study: &Study<impl Mechanism>, case: &Case, point: &Point, held: &[&str]) -> Result<Assembly, Error> {
    let mut start = study.start_values().to_vec();
    let place = |name: &&str| study.find_coordinate(name).expect("declared").any();
    let places: Vec<Coordinate> = held.iter().map(place).collect();
    for (name, place) in held.iter().zip(&places) {
        start[place.index()] = point.truth.get("coordinates").get(name).number();
    }
    assemble(study.mechanism(), &[point.input], &case.design, &start, &places)
}

fn check(machine: impl Mechanism, name: &'static str) -> AssemblyMode {
    let case = Case::new(name);
    let held: Vec<&str> = case.independent.iter().map(String::as_str).collect();
    let mut modes = Vec::new();
    for point in case.points() {
        let study = study(machine.clone(), &case, &point);
        let found = assembled(&study, &case, &point, &held).unwrap_or_else(|error| panic!("{}: {error}", point.what));
        for (i, unknown) in study.description().coordinates.iter().enumerate() {
            if let Some(expected) = point.truth.get("coordinates").find(&unknown.name) {
                let what = format!("{}: {}", point.what, unknown.name);
                assert_close(found.coordinates[i], expected.number(), 1e-3, &what);
            }
        }
        assert_eq!(found.constraints.redundant, 0, "{}", point.what);
        assert_eq!(found.constraints.freedom, held.len(), "{}", point.what);
        modes.push(found.mode.expect("no dead centre"));
    }
    assert!(modes.iter().all(|mode| *mode == modes[0]), "{name}: {modes:?}");
    modes[0]
}

#[test]
fn the_two_modes_of_the_four_bar() {
    let open = check(FourBar, "four_bar_open");
    let crossed = check(FourBar, "four_bar_crossed");
    assert_ne!(open, crossed);
}

#[test]
fn the_five_bar_holds_both_cranks() {
    check(FiveBar, "five_bar");
}

/// If the bars do not reach, the error names the equation that stays open and its gap.
#[test]
fn bars_that_do_not_reach_are_told() {
    let case = Case::new("four_bar_open").with("spacing", 0.9);
    let point = case.points().remove(1);
    let refused = assembled(&study(FourBar, &case, &point), &case, &point, &["crank_angle"]);
    let Err(error) = refused else {
        panic!("bars of 0.63 m do not reach 0.9 m");
    };
    assert!(matches!(error, Error::NotAssembled { .. }), "{error}");
    assert!(error.to_string().contains("close"), "{error}");
}

/// Both sides of one loop are held at incompatible values.
#[test]
fn too_much_held_is_told() {
    let case = Case::new("four_bar_open").with("rocker", 0.23);
    let point = case.points().remove(1);
    let refused = assembled(&study(FourBar, &case, &point), &case, &point, &["crank_angle", "rocker_angle"]);
    assert!(matches!(refused, Err(Error::NotAssembled { .. })), "{refused:?}");
}
