//! Values in declared units, as input and in reports: every report begins with its operating point.

use crate::common::FREQUENCY;
use eigentol::requirement::Requirement;
use eigentol::{Error, InDeclaredUnit, Input, Study, mechanism};

mechanism! {
    /// A bar on a shaft driven in rpm, pushed by a constant moment.
    mechanism Governor {
        input  speed: rpm;
        input  push: N*m;
        design l = 200 mm +/- 1 mm;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: 2 kg, length: l, along: -z);
        joint spin:  revolute(z) from ground to shaft, driven at speed;
        joint theta: revolute(y) from shaft to bar;
        force hand: generalized(on: theta, value: push);
        output angle = theta;
    }
}

const RPM: f64 = core::f64::consts::TAU / 60.0;

fn study() -> Study<Governor> {
    Study::new(Governor).input(Governor::speed, InDeclaredUnit(60.0)).input(Governor::push, 0.25).samples(50)
}

#[test]
fn declared_units_and_si_meet() {
    let study = study()
        .design(Governor::l, InDeclaredUnit(250.0))
        .tolerance(Governor::l, InDeclaredUnit(0.5))
        .start(Governor::theta, InDeclaredUnit(0.1));
    assert_eq!(study.input_values(), [60.0 * RPM, 0.25]);
    assert_eq!(study.design_values(), [0.25]);
    assert_eq!(study.start_values(), [0.1]);
    assert_eq!(study.tolerances().unwrap().half_widths(), [0.5e-3]);

    let rpm = [30.0, 60.0].map(InDeclaredUnit);
    let sweep = study.sweep(Governor::speed, &rpm).unwrap();
    assert_eq!(sweep, study.sweep(Governor::speed, &[30.0 * RPM, 60.0 * RPM]).unwrap());
    let settings = study.continuation(Governor::speed, 0.0, InDeclaredUnit(90.0));
    assert_eq!(settings.unwrap().high, 90.0 * RPM);
    let unit = &study.description().inputs[Governor::speed.index()].unit;
    assert!((unit.from_si(unit.to_si(3000.0)) - 3000.0).abs() < 1e-12);
}

#[test]
fn wrong_values_and_handles_are_refused() {
    let infinite = study().input(Governor::speed, InDeclaredUnit(f64::INFINITY));
    assert!(matches!(
        infinite.equilibrium(),
        Err(Error::NotFinite { name, .. }) if name == "speed"
    ));
    let unknown = Input::new(7);
    let refused = [
        study().sweep(unknown, &[InDeclaredUnit(1.0)]).err(),
        study().continuation(unknown, 0.0, 1.0).err(),
        study().crossings(unknown, 0.0, 1.0, 1.0).err(),
        study().input(unknown, InDeclaredUnit(1.0)).equilibrium().err(),
    ];
    for error in refused {
        assert!(matches!(error, Some(Error::UnknownHandle { index: 7, .. })), "{error:?}");
    }
    let error = study().find_output("height").unwrap_err();
    assert_eq!(error.to_string(), "`Governor` has no output `height`: it has `angle`");
}

#[test]
fn reports_name_the_operating_point() {
    let asked = study();
    let reports = [
        study().assembly().unwrap().to_string(),
        asked.equilibrium().unwrap().to_string(),
        asked.modes().unwrap().to_string(),
        asked.sensitivities().unwrap().to_string(),
        asked.equilibrium_shift().unwrap().to_string(),
        asked.outputs().unwrap().to_string(),
        asked.output_tolerances().unwrap().to_string(),
        asked.first_order().unwrap().to_string(),
        asked.second_order().unwrap().to_string(),
        asked.summary().unwrap().to_string(),
        asked.monte_carlo().unwrap().to_string(),
        asked.reliability(&[Requirement::away(FREQUENCY, Governor::speed.any(), 0.1)]).unwrap().to_string(),
    ];
    for report in reports {
        let title = "Governor at speed = 60 rpm, push = 0.25 N*m: ";
        assert!(report.starts_with(title), "{report}");
    }
}

#[test]
fn reports_along_an_input_name_the_others() {
    let study = study();
    let speed = Governor::speed;
    let values = [30.0, 60.0].map(InDeclaredUnit);
    let high = InDeclaredUnit(90.0);
    let branches = study.branches(speed, 0.0, high).unwrap();
    let crossings = study.crossing_tolerances(speed, 1.0, high, 1.5).unwrap();
    let reports = [
        study.sweep(speed, &values).unwrap().to_string(),
        study.campbell(speed, &values, &[1.0]).unwrap().to_string(),
        branches.to_string(),
        branches.branches[0].to_string(),
        crossings[0].to_string(),
    ];
    for report in reports {
        let title = "Governor at push = 0.25 N*m: ";
        assert!(report.starts_with(title), "{report}");
    }
    let free = study.input(Governor::push, 0.0);
    let critical = free.critical_state(speed, 0.0, high).unwrap().to_string();
    assert!(critical.starts_with("Governor at push = 0 N*m: critical at speed = "));
    let spread = free.critical_tolerance(speed, 0.0, high).unwrap();
    assert!(spread.to_string().starts_with("Governor at push = 0 N*m: critical at speed"));
}
