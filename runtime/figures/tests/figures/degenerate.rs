//! Results with gaps, with a single point, and without content.

use eigentol_figures::{
    Error, Histogram, Style, branches, campbell, damping_ratios, eigenvalues, equilibria, frequencies, mode_shapes,
    root_locus, shares,
};

use crate::machines::{Pendulum, pendulum, rotor_diagram, save, values};

#[test]
fn one_value_is_drawn_as_points() {
    let result = rotor_diagram(1);
    let style = Style::default();
    let drawn = [
        campbell(&result, &style),
        damping_ratios(&result, &style),
        eigenvalues(&result, &style),
        root_locus(&result, &style),
        frequencies(&result, &style),
        equilibria(&result, &style),
    ];
    for (k, figure) in drawn.into_iter().enumerate() {
        let figure = figure.unwrap();
        assert!(figure.panels.iter().any(|panel| !panel.markers.is_empty()), "{k}");
        save(&figure, &format!("one_point_{k}"));
    }
}

#[test]
fn a_point_that_fails_leaves_a_gap() {
    let mut speeds = values(4.5, 7.0, 11);
    speeds[5] = f64::NAN;
    let sweep = pendulum().sweep(Pendulum::omega, &speeds).unwrap();
    let figure = frequencies(&sweep, &Style::default()).unwrap();
    assert_eq!(figure.panels[0].curves[0].pieces.len(), 2);
    save(&figure, "gap");
    save(&equilibria(&sweep, &Style::default()).unwrap(), "gap_of_equilibrium");
}

#[test]
fn nothing_to_draw_is_an_error() {
    let style = Style::default();
    let nothing = |found: Result<_, Error>| {
        let error = found.map(|_: eigentol_figures::Figure| ()).unwrap_err();
        assert!(matches!(error, Error::Nothing(_)), "{error}");
    };
    let sweep = pendulum().sweep(Pendulum::omega, &[f64::NAN]).unwrap();
    nothing(frequencies(&sweep, &style));
    nothing(equilibria(&sweep, &style));
    nothing(root_locus(&sweep, &style));
    let none: [f64; 0] = [];
    let empty = pendulum().campbell(Pendulum::omega, &none, &none).unwrap();
    nothing(campbell(&empty, &style));
    nothing(damping_ratios(&empty, &style));
    nothing(eigenvalues(&empty, &style));

    let study = pendulum().input(Pendulum::omega, 5.0);
    let mut modes = study.modes().unwrap();
    modes.modes.clear();
    nothing(mode_shapes(&modes, &style));
    let still = study.clone().relative_tolerance(Pendulum::l, 0.0);
    nothing(shares(&still.first_order().unwrap(), 0, &style));
    let sampled = still.samples(10).monte_carlo().unwrap();
    nothing(Histogram::new(&sampled, 0).figure(&style));
    let mut found = study.branches(Pendulum::omega, 0.0, 5.0).unwrap();
    found.branches.clear();
    nothing(branches(&found, &style));
}

#[test]
fn a_mode_that_does_not_exist_is_an_error() {
    let study = pendulum().input(Pendulum::omega, 5.0).samples(10);
    let error = shares(&study.first_order().unwrap(), 7, &Style::default()).unwrap_err();
    assert_eq!(error.to_string(), "there is no mode 8: the result has 1");
    let sampled = study.monte_carlo().unwrap();
    let error = Histogram::new(&sampled, 1).figure(&Style::default()).unwrap_err();
    assert!(matches!(error, Error::UnknownMode { mode: 1, modes: 1 }));
}
