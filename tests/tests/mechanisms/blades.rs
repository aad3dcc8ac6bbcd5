//! Rotors of equal blades on supports that are not symmetric: reference values of Hammond's rotor and of a turbine with
//! gravity across its axis, and exponents by integration over a turn.

mod compiled;
mod disc;
mod floquet;
mod hammond;
mod turbine;

use eigentol::{Complex, Study};
use eigentol_interpreter::Interpreted;
use serde_json::Value;

use crate::free_machines::common::{number, numbers, study};

fn complex(pair: &Value) -> Complex {
    let pair = numbers(pair);
    Complex::new(pair[0], pair[1])
}

fn list(value: &Value) -> Vec<Complex> {
    value.as_array().expect("a list").iter().map(complex).collect()
}

/// A study at a speed, rad/s.
fn at(text: &str, speed: f64) -> Study<Interpreted> {
    let study = study(text);
    let omega = study.description().inputs.iter().position(|input| &*input.name == "omega").expect("omega");
    study.input(eigentol::Input::new(omega), speed)
}

/// Eigenvalues are those of the list, in some order; the positions of these.
#[track_caller]
fn same_exponents(study: &Study<Interpreted>, expected: &[Complex], tolerance: f64) -> Vec<usize> {
    let modes = study.modes().expect("modes");
    assert_eq!(modes.modes.len(), expected.len(), "{modes}");
    let mut free: Vec<usize> = (0..expected.len()).collect();
    expected
        .iter()
        .map(|s| {
            let distance = |k: &usize| (modes.modes[*k].s - s).norm();
            let nearest = free.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("a mode");
            assert!(
                distance(&nearest) <= tolerance * s.norm(),
                "{s} is {:.1e} from {}",
                distance(&nearest),
                modes.modes[nearest].s
            );
            free.retain(|k| *k != nearest);
            nearest
        })
        .collect()
}

fn design(study: &Study<Interpreted>, name: &str) -> usize {
    let mut names = study.description().design.iter();
    names.position(|variable| &*variable.name == name).unwrap_or_else(|| panic!("{name}"))
}

/// The derivatives of each mode by a design variable, or by the speed.
fn derivatives(study: &Study<Interpreted>, name: &str) -> Vec<Option<Complex>> {
    let slopes = study.sensitivities().expect("derivatives");
    let of = |mode: &eigentol::sensitivity::ModeSensitivity| {
        let s = mode.s().filter(|_| !mode.clustered)?;
        Some(if name == "omega" { s.by_input[0] } else { s.by_design[design(study, name)] })
    };
    slopes.modes.iter().map(of).collect()
}

/// `design NAME = VALUE UNIT;` for each parameter.
fn declared(parameters: &Value, units: &[(&str, &str)]) -> String {
    let line = |(name, unit): &(&str, &str)| format!("design {name} = {:?} {unit};\n", number(&parameters[*name]));
    units.iter().map(line).collect()
}

#[track_caller]
fn close(found: Complex, expected: Complex, tolerance: f64, scale: f64, what: &str) {
    assert!(
        (found - expected).norm() <= tolerance * scale.max(expected.norm()),
        "{what}: {found} instead of {expected}"
    );
}
