//! Assembly from values that close no loop: the held coordinates decide, the start values of the others choose the mode.

use eigentol::equilibrium::{Assembly, AssemblyMode, assemble};
use eigentol::{Coordinate, Error, Mechanism};
use eigentol_tests::loops::{FiveBar, FourBar};

use super::common::{Case, Point, assert_close};
use super::study::study;

fn place<M, const N: usize, const P: usize, const O: usize>(name: &str) -> Coordinate
where
    M: Mechanism<N, 1, P, O>,
{
    let list = M::DESCRIPTION.coordinates;
    let found = list.iter().position(|unknown| unknown.name == name);
    Coordinate(found.unwrap_or_else(|| panic!("there is a coordinate {name}")))
}

/// Assembled with the named coordinates at the file's values and the others near them.
fn assembled<M, const N: usize, const P: usize, const O: usize>(
    machine: M,
    case: &Case,
    point: &Point,
    held: &[&str],
) -> Result<Assembly<N>, Error>
where
    M: Mechanism<N, 1, P, O> + Copy,
{
    let mut start = *study(machine, case, point).start_values();
    let held: Vec<Coordinate> = held.iter().map(|name| place::<M, N, P, O>(name)).collect();
    for one in &held {
        let name = M::DESCRIPTION.coordinates[one.0].name;
        start[one.0] = point.truth.get("coordinates").get(name).number();
    }
    let design: [f64; P] = std::array::from_fn(|j| case.design[j]);
    assemble(&machine, &[point.input], &design, &start, &held)
}

fn check<M, const N: usize, const P: usize, const O: usize>(
    machine: M,
    name: &'static str,
) -> AssemblyMode
where
    M: Mechanism<N, 1, P, O> + Copy,
{
    let case = Case::new(name);
    let held: Vec<&str> = case.independent.iter().map(String::as_str).collect();
    let mut modes = Vec::new();
    for point in case.points() {
        let found = assembled(machine, &case, &point, &held)
            .unwrap_or_else(|error| panic!("{}: {error}", point.what));
        for (i, unknown) in M::DESCRIPTION.coordinates.iter().enumerate() {
            if let Some(expected) = point.truth.get("coordinates").find(unknown.name) {
                let what = format!("{}: {}", point.what, unknown.name);
                assert_close(found.coordinates[i], expected.number(), 1e-3, &what);
            }
        }
        assert_eq!(found.constraints.redundant, 0, "{}", point.what);
        assert_eq!(found.constraints.freedom, held.len(), "{}", point.what);
        modes.push(found.mode.expect("no dead centre"));
    }
    assert!(
        modes.iter().all(|mode| *mode == modes[0]),
        "{name}: {modes:?}"
    );
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

/// Bars that do not reach: which equation stays open is said, and by how much.
#[test]
fn bars_that_do_not_reach_are_told() {
    let case = Case::new("four_bar_open").with("spacing", 0.9);
    let point = case.points().remove(1);
    let refused = assembled(FourBar, &case, &point, &["crank_angle"]);
    let Err(error) = refused else {
        panic!("bars of 0.63 m do not reach 0.9 m");
    };
    assert!(matches!(error, Error::NotAssembled { .. }), "{error}");
    assert!(error.to_string().contains("close"), "{error}");
}

/// Both sides of one loop held at values that do not fit each other.
#[test]
fn too_much_held_is_told() {
    let case = Case::new("four_bar_open").with("rocker", 0.23);
    let point = case.points().remove(1);
    let refused = assembled(FourBar, &case, &point, &["crank_angle", "rocker_angle"]);
    assert!(
        matches!(refused, Err(Error::NotAssembled { .. })),
        "{refused:?}"
    );
}
