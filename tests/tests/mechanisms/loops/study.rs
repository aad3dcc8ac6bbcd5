//! The complete workflow through the public interface: assembly and equilibrium from rough values, modes, total
//! derivatives by both methods, second derivatives, outputs including reactions, and first-order standard deviations.

use eigentol::equilibrium::Stability;
use eigentol::second_order::SecondDerivatives;
use eigentol::sensitivity::{EquilibriumShift, Slopes, equilibrium_shift, sensitivities, sensitivities_explicit};
use eigentol::{Complex, Coordinate, Equilibrium, Input, Kernels, Mechanism, Mode, Modes, Role, Study};
use eigentol_oracle::truth::Truth;
use eigentol_tests::loops::{
    FiveBar, FourBar, GearedCoasting, GearedMotor, GearedRotors, Governor, PorterGovernor, SliderCrank,
};

use super::common::{Case, Point, assert_close, assert_near, complex};

/// A study of a point that starts from angles rounded to a tenth of a radian and displacements rounded to a centimetre,
/// so that no loop is closed; speeds start from zero.
pub(super) fn study<M: Mechanism>(machine: M, case: &Case, point: &Point) -> Study<M> {
    let mut study = Study::new(machine).input(Input::new(0), point.input).threads(1);
    let description = Kernels::description(study.mechanism());
    for (i, unknown) in description.coordinates.iter().enumerate() {
        if unknown.role == Role::Position {
            let value = point.truth.get("coordinates").get(&unknown.name).number();
            let step = match &*unknown.unit.symbol {
                "rad" => 0.1,
                _ => 0.01,
            };
            let value = (value / step).round() * step;
            let decides = case.independent.iter().any(|name| unknown.name == **name);
            study = match decides {
                true => study.start(Coordinate::new(i), value),
                false => study.guess(Coordinate::new(i), value),
            };
        }
    }
    study
}

/// By design variables, then by the input.
fn joined<T: Copy>(slopes: &Slopes<T>) -> Vec<T> {
    [&slopes.by_design[..], &slopes.by_input].concat()
}

fn check(machine: impl Mechanism, name: &'static str) {
    let case = Case::new(name);
    let declared = Kernels::description(&machine);
    for (info, truth) in declared.design.iter().zip(case.truth.get("design").list()) {
        assert_eq!(*info.name, *truth.get("name").text());
        let tolerance = truth.get("tolerance").number();
        assert!((info.tolerance.upper - tolerance).abs() < 1e-15 + 1e-14 * tolerance);
    }
    for point in case.points() {
        let study = study(machine.clone(), &case, &point);
        let at = study.equilibrium().unwrap_or_else(|error| panic!("{}: {error}", point.what));
        check_equilibrium(&machine, &case, &point, &at);
        check_outputs(&study, &case, &point);
        check_modes(&study, &case, &point, &at);
    }
}

fn check_equilibrium(machine: &dyn Kernels, case: &Case, point: &Point, at: &Equilibrium) {
    assert_eq!(at.stability, Stability::Stable, "{}", point.what);
    let shift: EquilibriumShift = equilibrium_shift(machine, at).expect("a shift");
    for (i, unknown) in at.description.coordinates.iter().enumerate() {
        if !matches!(unknown.role, Role::Position | Role::Speed) {
            continue;
        }
        let what = format!("{}: {}", point.what, unknown.name);
        let expected = point.truth.get("coordinates").get(&unknown.name).number();
        assert_close(at.coordinates[i], expected, 1e-3, &what);
        let slopes = point.truth.get("coordinates_by").get(&unknown.name);
        let found = [&shift.by_design[i][..], &shift.by_input[i]].concat();
        for (j, variable) in case.variables.iter().enumerate() {
            let what = format!("{what} by {variable}");
            let expected = slopes.get(variable).number();
            assert_close(found[j], expected, point.scale(1.0, &[j]), &what);
        }
    }
}

fn check_outputs(study: &Study<impl Mechanism>, case: &Case, point: &Point) {
    let found = study.outputs().expect("outputs");
    let spread = study.output_tolerances().expect("spreads of outputs");
    let truth = |field: &str, name: &str| point.truth.get(field).get(name);
    for (k, output) in found.description.outputs.iter().enumerate() {
        let what = format!("{}: {}", point.what, output.name);
        let expected = truth("outputs", &output.name).number();
        assert_close(found.values[k], expected, 1e-2, &what);
        let size = expected.abs().max(1e-2);
        let by_design = found.by_design[k].as_ref().expect("derivatives");
        let by_input = found.by_input[k].as_ref().expect("derivatives");
        let slopes = [&by_design[..], &by_input[..]].concat();
        for (j, variable) in case.variables.iter().enumerate() {
            let what = format!("{what} by {variable}");
            let expected = truth("outputs_by", &output.name).get(variable).number();
            assert_close(slopes[j], expected, point.scale(size, &[j]), &what);
        }
        let sigma = truth("outputs_sigma", &output.name).number();
        let found = spread.spreads[k].as_ref().expect("a spread").sigma;
        assert_close(found, sigma, 1e-4 * size, &what);
    }
}

/// The mode of an eigenvalue that is well separated from the others.
fn place_of(modes: &Modes, s: Complex, what: &str) -> usize {
    let apart = |mode: &Mode| (mode.s - s).norm();
    let near = |&place: &usize| apart(&modes.modes[place]) < 1e-6 * s.norm();
    let places: Vec<usize> = (0..modes.modes.len()).filter(near).collect();
    let &[place] = &places[..] else {
        panic!("{what}: {s} is found {} times", places.len());
    };
    place
}

fn check_modes(study: &Study<impl Mechanism>, case: &Case, point: &Point, at: &Equilibrium) {
    let machine = study.mechanism();
    let modes = study.modes().expect("modes");
    let truths = point.modes();
    assert_eq!(modes.modes.len(), truths.len(), "{}", point.what);
    let adjoint = sensitivities(machine, at, &modes).expect("derivatives");
    let explicit = sensitivities_explicit(machine, at, &modes).expect("derivatives");
    let spread = study.first_order().expect("a spread");
    for truth in &truths {
        let s = complex(&truth.get("s"));
        let what = format!("{}: {s}", point.what);
        let r = place_of(&modes, s, &what);
        assert_near(modes.modes[r].s, s, 0.0, &what);
        for (way, found) in [("adjoint", &adjoint), ("explicit", &explicit)] {
            let found = joined(&found.modes[r].s().expect("derivatives"));
            for (j, variable) in case.variables.iter().enumerate() {
                let what = format!("{what} by {variable}, {way}");
                let expected = complex(&truth.get("s_by").get(variable));
                assert_near(found[j], expected, point.scale(s.norm(), &[j]), &what);
            }
        }
        let curvature = study.mode_curvature(r).expect("second derivatives");
        assert!(curvature.asymmetry < 1e-9, "{what}: {}", curvature.asymmetry);
        let second = curvature.eigenvalue.as_ref().expect("second derivatives");
        check_second(case, point, second, truth, s, &what);

        let mode = &spread.modes[r];
        let sigma = truth.get("sigma_frequency").number();
        let frequency = mode.frequency().map_or(0.0, |x| x.sigma);
        assert_close(frequency, sigma, 1e-4 * s.norm(), &format!("{what}, sigma"));
        let sigma = truth.get("sigma_growth").number();
        let growth = mode.growth().map_or(0.0, |x| x.sigma);
        assert_close(growth, sigma, 1e-4 * s.norm(), &format!("{what}, growth"));
    }
}

fn check_second(
    case: &Case,
    point: &Point,
    second_derivatives: &SecondDerivatives<Complex>,
    truth: &Truth,
    s: Complex,
    what: &str,
) {
    for (i, row) in truth.get("s_second").list().iter().enumerate() {
        for (j, expected) in row.list().iter().enumerate() {
            let found = match (i < case.design.len(), j < case.design.len()) {
                (true, _) => second_derivatives.by_design[i][j],
                (false, true) => second_derivatives.by_input_and_design[0][j],
                (false, false) => second_derivatives.by_input[0][0],
            };
            let [one, other] = [i, j].map(|k| &case.variables[k]);
            let what = format!("{what} by {one} and {other}");
            let scale = point.scale(s.norm(), &[i, j]);
            assert_near(found, complex(expected), scale, &what);
        }
    }
}

#[test]
fn governor() {
    check(Governor, "governor");
}

#[test]
fn porter_governor() {
    check(PorterGovernor, "porter_governor");
}

#[test]
fn slider_crank() {
    check(SliderCrank, "slider_crank");
}

#[test]
fn five_bar() {
    check(FiveBar, "five_bar");
}

#[test]
fn four_bar_in_both_modes() {
    check(FourBar, "four_bar_open");
    check(FourBar, "four_bar_crossed");
}

#[test]
fn geared_rotors() {
    check(GearedRotors, "geared_rotors");
}

#[test]
fn geared_coasting() {
    check(GearedCoasting, "geared_coasting");
}

#[test]
fn geared_motor() {
    check(GearedMotor, "geared_motor");
}
