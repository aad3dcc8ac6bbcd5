//! Comparisons with `truth/rolling.json`.

use eigentol::{Complex, Description, Input, Mechanism, Study};
use eigentol_oracle::truth::Truth;

/// Relative error allowed.
pub(crate) const TIGHT: f64 = 1e-9;

/// Derivatives below this share of the largest relative one are judged as if they were that large.
const SMALL: f64 = 1e-2;

pub(crate) fn truth(mechanism: &str) -> Truth {
    Truth::load("rolling").get(mechanism)
}

pub(crate) fn complex(value: &Truth) -> Complex {
    let parts = value.numbers();
    Complex::new(parts[0], parts[1])
}

#[track_caller]
pub(crate) fn close(value: f64, expected: f64, scale: f64, what: &str) {
    assert!((value - expected).abs() <= TIGHT * expected.abs().max(scale), "{what}: {value}, not {expected}");
}

/// Compares derivatives by variables of the given names and values; each relative to itself, or to a hundredth of the
/// derivative that is largest for a relative change of its variable.
#[track_caller]
pub(crate) fn close_slopes(complexes: &[Complex], expected: &[Complex], values: &[f64], names: &[&str], what: &str) {
    assert_eq!(complexes.len(), expected.len(), "{what}");
    let sizes = values.iter().map(|value| match value.abs() {
        0.0 => 1.0,
        size => size,
    });
    let sizes: Vec<f64> = sizes.collect();
    let greatest = expected.iter().zip(&sizes).fold(0.0_f64, |most, (slope, size)| most.max(slope.norm() * size));
    for (((found, expected), size), name) in complexes.iter().zip(expected).zip(&sizes).zip(names) {
        let scale = expected.norm().max(SMALL * greatest / size);
        assert!((found - expected).norm() <= TIGHT * scale, "{what} by {name}: {found}, not {expected}");
    }
}

/// The same for real derivatives.
#[track_caller]
pub(crate) fn close_real_slopes(found: &[f64], expected: &[f64], values: &[f64], names: &[&str], what: &str) {
    let real = |numbers: &[f64]| -> Vec<Complex> { numbers.iter().map(|&x| x.into()).collect() };
    close_slopes(&real(found), &real(expected), values, names, what);
}

/// The description of a mechanism.
pub(crate) fn description<M: Mechanism>() -> &'static Description {
    const { &M::DESCRIPTION }
}

/// Names of the design variables.
pub(crate) fn design_names<M: Mechanism>() -> Vec<&'static str> {
    let all = description::<M>().design.iter();
    all.map(|info| &*info.name).collect()
}

/// Names of the inputs.
pub(crate) fn input_names<M: Mechanism>() -> Vec<&'static str> {
    let all = description::<M>().inputs.iter();
    all.map(|info| &*info.name).collect()
}

/// The study at the inputs of a point.
pub(crate) fn at<M: Mechanism>(study: &Study<M>, point: &Truth) -> Study<M> {
    let inputs = point.get("inputs");
    let mut study = study.clone();
    for (k, name) in input_names::<M>().into_iter().enumerate() {
        study = study.input(Input::new(k), inputs.get(name).number());
    }
    study
}

/// Checks that the declared nominal values match the reference.
pub(crate) fn check_design<M: Mechanism>(design: &Truth) {
    let declared = &description::<M>().design;
    assert_eq!(design.fields().len(), declared.len());
    for info in declared.iter() {
        let value = design.get(&info.name).number();
        close(info.nominal, value, 0.0, &info.name);
    }
}

/// Checks all eigenvalues at a point of the reference, and all their derivatives.
pub(crate) fn check_modes<M: Mechanism>(study: &Study<M>, point: &Truth) {
    let what = format!("{} at {:?}", description::<M>().name, study.input_values());
    let found = study.modes().unwrap_or_else(|error| panic!("{what}: {error}"));
    let slopes = study.sensitivities().unwrap_or_else(|error| panic!("{what}: {error}"));
    let expected = point.get("modes").list();
    assert_eq!(found.modes.len(), expected.len(), "{what}: {found:?}");
    let names = design_names::<M>();
    let inputs = input_names::<M>();
    let mut left: Vec<usize> = (0..expected.len()).collect();
    for mode in &expected {
        let s = complex(&mode.get("s"));
        let off = |&k: &usize| (found.modes[k].s - s).norm();
        left.sort_by(|a, b| off(a).total_cmp(&off(b)));
        let nearest = left.remove(0);
        assert!(off(&nearest) <= TIGHT * s.norm(), "{what}: {}, not {s}", found.modes[nearest].s);
        let own = slopes.modes[nearest].s().expect("an eigenvalue with derivatives");
        let what = format!("{what}, {s}");
        for (found, names, values, field) in [
            (&own.by_input[..], &inputs, study.input_values(), "by_input"),
            (&own.by_design[..], &names, study.design_values(), "by_design"),
        ] {
            let by = mode.get(field);
            let by: Vec<Complex> = names.iter().map(|name| complex(&by.get(name))).collect();
            close_slopes(found, &by, values, names, &what);
        }
    }
}
