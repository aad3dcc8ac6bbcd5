//! Settings, reports, and meaningless values.

use super::*;

#[test]
fn limits_are_kept_and_told() {
    let few = range(0.0, 6.0).max_points(5);
    let short = branch(&Pendulum, &[0.0], &BAR, &[0.3], &few).unwrap();
    assert_eq!(short.ends, [BranchEnd::Low, BranchEnd::PointLimit]);
    assert_eq!(short.points.len(), 6);
    let few = range(0.0, 6.0).max_branches(2);
    let some = branches(&Pendulum, &[0.0], &BAR, &[0.3], &few, None).unwrap();
    assert!(some.truncated);
    assert_eq!(some.branches.len(), 2);
}

#[test]
fn points_take_no_more_corrections_than_are_allowed() {
    for (most, needed) in [(2, 2), (3, 3), (8, 4)] {
        let settings = range(0.0, 6.0).max_corrections(most);
        let found = branches(&Pendulum, &[0.0], &BAR, &[0.3], &settings, None).unwrap();
        assert_eq!(found.branches.len(), 3);
        // The arms of the pitchfork: where they begin, nothing is corrected.
        for arm in &found.branches[1..] {
            assert_sound(&Pendulum, arm, &settings);
            let corrected = arm.points[1..].iter();
            let taken = corrected.map(|point| point.equilibrium.iterations).max();
            assert_eq!(taken, Some(needed), "at most {most}");
        }
    }
}

#[test]
fn one_branch_tells_what_crosses_it() {
    let hanging = branch(&Pendulum, &[0.0], &BAR, &[0.3], &range(0.0, 6.0)).unwrap();
    assert_sound(&Pendulum, &hanging, &range(0.0, 6.0));
    assert_eq!(hanging.special.len(), 1);
    assert_eq!(hanging.stable().len(), 1);
}

#[test]
fn reports_name_what_they_show() {
    let study = Study::new(Pendulum).start(eigentol::Coordinate::new(0), 0.3);
    let found = study.branches(Input::new(0), 0.0, 6.0).unwrap();
    let text = found.to_string();
    for part in [
        "Pendulum: 3 branches",
        "from omega [rad/s]",
        "theta [rad]",
        "supercritical pitchfork",
        "3.83601",
        "branches 2, 3: branch point to high end of the range",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    let one = found.branches[1].to_string();
    assert!(one.contains("begins: branch point; ends: high end of the range"));
    assert!(found.special()[0].to_string().contains("critical mode v"));
}

#[test]
fn nasty_settings_are_refused_and_nasty_values_end_in_answers() {
    let ask =
        |settings: Continuation, start: f64, b: [f64; 2]| branches(&Pendulum, &[0.0], &b, &[start], &settings, None);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for settings in [
            range(bad, 1.0),
            range(0.0, bad),
            range(0.0, 1.0).max_step(bad),
            range(0.0, 1.0).min_step(bad),
            range(0.0, 1.0).size(bad),
        ] {
            let refused = ask(settings, 0.1, BAR);
            assert!(matches!(refused, Err(Error::Setting { .. })), "{refused:?}");
        }
        assert!(matches!(ask(range(0.0, 1.0), bad, BAR), Err(Error::NotFinite { .. })));
        assert!(matches!(ask(range(0.0, 1.0), 0.1, [3.0, bad]), Err(Error::NotFinite { .. })));
    }
    for settings in [
        range(1.0, 1.0),
        range(-1e308, 1e308),
        range(0.0, 1.0).max_points(0),
        range(0.0, 1.0).max_branches(0),
        range(0.0, 1.0).escape(0.5),
    ] {
        assert!(matches!(ask(settings, 0.1, BAR), Err(Error::Setting { .. })));
    }
    let foreign = Continuation::new(Input::new(1), 0.0, 1.0);
    assert!(matches!(ask(foreign, 0.1, BAR), Err(Error::UnknownHandle { index: 1, .. })));
    assert!(matches!(ask(range(0.0, 1.0), 0.1, [3.0, -1.0]), Err(Error::Unphysical { .. })));
    nasty_values_end_in_answers(&[0.0, 3.836_013_555_763_326_5, -1e9, 1e300]);
}

#[test]
#[ignore = "half a minute"]
fn all_nasty_values_end_in_answers() {
    nasty_values_end_in_answers(&[0.0, -1.0, 3.836_013_555_763_326_5, 6.0, -1e9, 1e160, 1e300]);
}

fn nasty_values_end_in_answers(wild: &[f64]) {
    for (&low, &high) in wild.iter().flat_map(|low| wild.iter().map(move |high| (low, high))) {
        for start in [0.1, -1e7, 1e200] {
            let along = range(low, high);
            let found = branches(&Pendulum, &[0.0], &BAR, &[start], &along, None);
            assert_numbers(found, low, high);
            for (b, u) in [([1.0, 1e-3], low), ([1e-200, 1e200], high)] {
                let imperfect = Derived(Imperfect);
                let found = branches(&imperfect, &[u], &b, &[start], &along, None);
                assert_numbers(found, low, high);
            }
        }
    }
}

fn assert_numbers(branches: Result<Branches, Error>, low: f64, high: f64) {
    for branch in branches.iter().flat_map(|found| &found.branches) {
        for point in &branch.points {
            let (least, most) = (low.min(high), low.max(high));
            assert!((least..=most).contains(&point.value), "{least:e} {:e} {most:e}", point.value);
            let q = point.equilibrium.coordinates[0];
            let numbers = [q, point.tangent[0], point.input_tangent];
            assert!(numbers.iter().all(|value| value.is_finite()));
        }
    }
}
