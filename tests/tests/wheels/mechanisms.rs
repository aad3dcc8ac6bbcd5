//! Four mechanisms with closed forms: steady motion, reactions, eigenvalues, and the derivatives of all of them.

use eigentol::{Mechanism, Study};
use eigentol_tests::wheels::{CirclingTrailer, PushedCart, RollingDisk, TowedCaster};

use super::common::{at, check_design, check_modes, close, close_real_slopes, design_names, truth};

/// Where a quantity of the reference is found: an unknown or an output, by name.
enum Place {
    Unknown(&'static str),
    Output(&'static str),
}

/// A quantity of the steady motion and its derivatives, all inputs, then all design variables.
fn found<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    study: &Study<M, N, U, P, O>,
    place: &Place,
) -> (f64, Vec<f64>)
where
    M: Mechanism<N, U, P, O>,
{
    let index = |names: Vec<&str>, name: &str| {
        let place = names.iter().position(|own| *own == name);
        place.unwrap_or_else(|| panic!("no {name} in {names:?}"))
    };
    match place {
        Place::Unknown(name) => {
            let all = M::DESCRIPTION.coordinates.iter().map(|info| info.name);
            let k = index(all.collect(), name);
            let state = study.equilibrium().expect("a steady motion");
            let shift = study.equilibrium_shift().expect("its derivatives");
            let slopes = [&shift.by_input[k][..], &shift.by_design[k][..]].concat();
            (state.coordinates[k], slopes)
        }
        Place::Output(name) => {
            let all = M::DESCRIPTION.outputs.iter().map(|info| info.name);
            let k = index(all.collect(), name);
            let outputs = study.outputs().expect("outputs");
            let by_input = outputs.by_input[k].expect("derivatives");
            let by_design = outputs.by_design[k].expect("derivatives");
            (outputs.values[k], [&by_input[..], &by_design[..]].concat())
        }
    }
}

/// All points of a mechanism: the quantities of its state in the order of the reference, its modes.
fn check<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    study: &Study<M, N, U, P, O>,
    name: &str,
    state: &[(&str, Place)],
) where
    M: Mechanism<N, U, P, O>,
{
    let reference = truth(name);
    check_design::<M, N, U, P, O>(&reference.get("design"));
    let inputs = M::DESCRIPTION.inputs.iter().map(|info| info.name);
    let names: Vec<&str> = inputs.chain(design_names::<M, N, U, P, O>()).collect();
    for point in reference.get("points").list() {
        let study = at(study, &point);
        let values = [&study.input_values()[..], &study.design_values()[..]].concat();
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
    let study = Study::<TowedCaster, 5, 1, 13, 0>::new(TowedCaster);
    check(&study, "caster", &[("spin", Place::Unknown("spin"))]);
}

#[test]
fn a_trailer_on_a_circle() {
    let study = Study::<CirclingTrailer, 7, 2, 9, 1>::new(CirclingTrailer);
    let state = [
        ("angle", Place::Unknown("swing")),
        ("side_force", Place::Output("side_force")),
    ];
    check(&study, "trailer", &state);
}

#[test]
fn a_disk_that_rolls_straight_and_in_circles() {
    let study = Study::<RollingDisk, 8, 2, 6, 2>::new(RollingDisk);
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
    let study = Study::<PushedCart, 4, 1, 9, 1>::new(PushedCart);
    let state = [
        ("speed", Place::Output("pace")),
        ("angle", Place::Unknown("swing")),
    ];
    check(&study, "cart", &state);
}
