//! Four mechanisms with closed forms: steady motion, reactions, eigenvalues, and the derivatives of all these.

use eigentol::{Kernels, Mechanism, Study};
use eigentol_tests::wheels::{CirclingTrailer, PushedCart, RollingDisk, TowedCaster};

use super::common::{at, check_design, check_modes, close, close_real_slopes, design_names, input_names, truth};

/// Where to find a quantity of the reference: an unknown or an output, by name.
enum Place {
    Unknown(&'static str),
    Output(&'static str),
}

/// A quantity of the steady motion and its derivatives by all inputs, then all design variables.
fn found(study: &Study<impl Kernels>, place: &Place) -> (f64, Vec<f64>) {
    match place {
        Place::Unknown(name) => {
            let k = study.find_coordinate(name).expect("declared").index();
            let state = study.equilibrium().expect("a steady motion");
            let shift = study.equilibrium_shift().expect("its derivatives");
            let slopes = [&shift.by_input[k][..], &shift.by_design[k][..]].concat();
            (state.coordinates[k], slopes)
        }
        Place::Output(name) => {
            let k = study.find_output(name).expect("declared").index();
            let outputs = study.outputs().expect("outputs");
            let by_input = outputs.by_input[k].as_ref().expect("derivatives");
            let by_design = outputs.by_design[k].as_ref().expect("derivatives");
            (outputs.values[k], [&by_input[..], &by_design[..]].concat())
        }
    }
}

/// Checks all points of a mechanism: the state quantities in the order of the reference, and the modes.
fn check<M: Mechanism>(study: &Study<M>, name: &str, state: &[(&str, Place)]) {
    let reference = truth(name);
    check_design::<M>(&reference.get("design"));
    let names = [input_names::<M>(), design_names::<M>()].concat();
    for point in reference.get("points").list() {
        let study = at(study, &point);
        let values = [study.input_values(), study.design_values()].concat();
        for (field, place) in state {
            let what = format!("{name} at {:?}: {field}", study.input_values());
            let (value, slopes) = found(&study, place);
            let quantity = point.get("state").get(field);
            close(value, quantity.get("value").number(), 1e-3, &what);
            let parts = ["by_input", "by_design"].map(|part| quantity.get(part));
            let by = |name: &&str| {
                let found = parts.iter().find_map(|part| part.find(name));
                found.unwrap_or_else(|| panic!("no {name}")).number()
            };
            let expected: Vec<f64> = names.iter().map(by).collect();
            close_real_slopes(&slopes, &expected, &values, &names, &what);
        }
        check_modes(&study, &point);
    }
}

#[test]
fn a_caster_that_shimmies() {
    let study = Study::<TowedCaster>::new(TowedCaster);
    check(&study, "caster", &[("spin", Place::Unknown("spin"))]);
}

#[test]
fn a_trailer_on_a_circle() {
    let study = Study::<CirclingTrailer>::new(CirclingTrailer);
    let state = [("angle", Place::Unknown("swing")), ("side_force", Place::Output("side_force"))];
    check(&study, "trailer", &state);
}

#[test]
fn a_disk_that_rolls_straight_and_in_circles() {
    let study = Study::<RollingDisk>::new(RollingDisk);
    let state = [
        ("height", Place::Unknown("height")),
        ("lean", Place::Unknown("lean")),
        ("forward", Place::Unknown("forward")),
        ("yaw", Place::Unknown("yaw")),
        ("normal", Place::Output("weight")),
        ("centripetal", Place::Output("centripetal")),
    ];
    check(&study, "disk", &state);
}

#[test]
fn a_cart_that_finds_its_speed() {
    let study = Study::<PushedCart>::new(PushedCart);
    let state = [("speed", Place::Output("pace")), ("angle", Place::Unknown("swing"))];
    check(&study, "cart", &state);
}
