//! Figures of one operating point.

use std::f64::consts::TAU;

use eigentol::Study;
use eigentol_figures::{Histogram, Style, mode_shapes, participation, shares};

use crate::machines::{Bars, Pendulum, Rotor, bars, pendulum, save};

/// Numbers of a line, in order.
fn numbers(line: &str) -> Vec<f64> {
    let words = line.split([' ', ',', ';', ':', '%']);
    words.filter_map(|word| word.parse().ok()).collect()
}

/// Whether the numbers, printed to five digits, match.
fn same(told: &[f64], expected: &[f64]) -> bool {
    let near = |(told, value): (&f64, &f64)| (told / value - 1.0).abs() < 1e-4;
    told.len() == expected.len() && told.iter().zip(expected).all(near)
}

#[test]
fn shares_are_those_of_first_order_with_the_greatest_on_top() {
    let study = bars().input(Bars::omega, 5.0);
    let found = study.first_order().unwrap();
    let figure = shares(&found, 0, &Style::of(&study).name_mode(0, "swing")).unwrap();
    let panel = &figure.panels[0];
    let own = found.modes[0].variance_shares();
    for (name, bar) in panel.y.categories.iter().zip(&panel.bars[0].bars) {
        let place = found.description.design.iter().position(|info| *info.name == **name);
        assert_eq!(bar[1] - bar[0], 100.0 * own[place.unwrap()].abs());
    }
    let lengths: Vec<f64> = panel.bars[0].bars.iter().map(|bar| bar[1] - bar[0]).collect();
    assert!(lengths.is_sorted(), "{lengths:?}");
    assert!(figure.title.contains("swing"));
    for (label, bar) in panel.labels.iter().zip(&panel.bars[0].bars) {
        let told: f64 = label.text.parse().unwrap_or(0.0);
        assert!((told - bar[1]).abs() <= 0.05 + 1e-9 && label.at[0] == bar[1], "{label:?} {bar:?}");
    }
    let spread = found.modes[0].frequency().unwrap();
    let line = figure.caption.iter().find(|x| x.starts_with("frequency "));
    let told = numbers(line.unwrap());
    assert!(same(&told, &[spread.mean, spread.sigma]), "{told:?} {spread:?}");
    save(&figure, "shares");
}

#[test]
fn a_histogram_has_area_one_and_so_has_its_density() {
    let study = pendulum().input(Pendulum::omega, 4.5).samples(4000).seed(3);
    let (sampled, first) = (study.monte_carlo().unwrap(), study.first_order().unwrap());
    let figure = Histogram::new(&sampled, 0).first_order(&first).figure(&Style::of(&study).hertz()).unwrap();
    let panel = &figure.panels[0];
    let area: f64 = panel.bars[0].bars.iter().map(|bar| (bar[1] - bar[0]) * bar[3]).sum();
    assert!((area - 1.0).abs() < 1e-12, "{area}");
    assert_eq!(panel.curves.len(), 1);
    for curve in &panel.curves {
        let [points] = &curve.pieces[..] else { panic!("{}", curve.label) };
        let area = |pair: &[[f64; 2]]| 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0]);
        let area: f64 = points.windows(2).map(area).sum();
        assert!((area - 1.0).abs() < 2e-3, "{} {area}", curve.label);
    }
    // In Hz: the first-order peak, and the bars about the sample mean.
    let scale = 1.0 / TAU;
    let own = first.modes[0].frequency().unwrap();
    let (mean, sigma) = (scale * own.mean, scale * own.sigma);
    let density = |z: f64| (-0.5 * z * z).exp() / (sigma * TAU.sqrt());
    for at in &panel.curves[0].pieces[0] {
        assert!((at[1] - density((at[0] - mean) / sigma)).abs() < 1e-9 * density(0.0), "{at:?}");
    }
    let statistics = sampled.modes[0].as_ref().unwrap();
    let shares = panel.bars[0].bars.iter().map(|bar| {
        let share = (bar[1] - bar[0]) * bar[3];
        (share, 0.5 * (bar[0] + bar[1]))
    });
    let middle: f64 = shares.map(|(share, at)| share * at).sum();
    assert!((middle - scale * statistics.mean).abs() < 0.05 * sigma, "{middle}");
    let start = "Monte Carlo, 4000 samples, seed 3: ";
    let told = figure.caption.iter().find_map(|x| x.strip_prefix(start));
    let told = numbers(told.unwrap_or_else(|| panic!("{:?}", figure.caption)));
    let expected = [statistics.mean, statistics.sigma.unwrap()].map(|x| scale * x);
    assert!(same(&told, &expected), "{told:?} {expected:?}");
    save(&figure, "histogram");
}

#[test]
fn mode_shapes_are_relative_to_the_largest_component() {
    let study = bars().input(Bars::omega, 5.0);
    let state = study.equilibrium().unwrap();
    let modes = study.modes().unwrap();
    let figure = mode_shapes(&modes, &Style::default().name_modes(["together", "apart"])).unwrap();
    let [panel] = &figure.panels[..] else { panic!("undamped shapes have no phase") };
    for (bars, mode) in panel.bars.iter().zip(&modes.modes) {
        let largest = mode.shape.iter().map(|component| component.re).max_by(|a, b| a.abs().total_cmp(&b.abs()));
        for (bar, component) in bars.bars.iter().zip(mode.shape.iter()) {
            let expected = component.re / largest.unwrap();
            assert!((bar[2] + bar[3] - expected).abs() < 1e-12);
        }
    }
    assert!(panel.bars[0].label.starts_with("together, "));
    save(&figure, "mode_shapes");

    let figure = participation(&modes, &state, &Style::of(&study)).unwrap();
    // Twice the kinetic energy is the shape times M times the shape, coordinate by coordinate.
    let mass = &state.linear.mass;
    for (bars, mode) in figure.panels[0].bars.iter().zip(&modes.modes) {
        let shape: Vec<f64> = mode.shape.iter().map(|component| component.re).collect();
        let energy = [0, 1].map(|i| shape[i] * (mass[i][0] * shape[0] + mass[i][1] * shape[1]));
        let whole: f64 = energy.iter().sum();
        for (bar, own) in bars.bars.iter().zip(energy) {
            assert!((bar[2] + bar[3] - 100.0 * own / whole).abs() < 1e-9, "{bar:?}");
        }
    }
    save(&figure, "participation");
}

#[test]
fn complex_shapes_have_magnitude_and_phase() {
    let study = Study::new(Rotor).input(Rotor::speed, 300.0);
    let modes = study.modes().unwrap();
    let figure = mode_shapes(&modes, &Style::of(&study).hertz()).unwrap();
    let [magnitudes, phases] = &figure.panels[..] else { panic!("two panels") };
    for (r, mode) in modes.modes.iter().enumerate() {
        let largest = mode.shape.iter().max_by(|a, b| a.norm().total_cmp(&b.norm())).unwrap();
        for (k, component) in mode.shape.iter().enumerate() {
            let relative = component / largest;
            let bar = magnitudes.bars[r].bars[k];
            assert!((bar[3] - relative.norm()).abs() < 1e-12);
            let at = 0.5 * (bar[0] + bar[1]);
            let phase = phases.markers[r].points.iter().find(|point| (point[0] - at).abs() < 1e-9);
            if let Some(phase) = phase {
                let turns = (phase[1] - relative.arg().to_degrees()) / 360.0;
                assert!((turns - turns.round()).abs() < 1e-9, "{phase:?} {relative}");
            } else {
                assert!(relative.norm() < 1e-3);
            }
        }
    }
    assert!(phases.markers.iter().flat_map(|own| &own.points).all(|at| at[1].abs() <= 180.0));
    save(&figure, "complex_shapes");
}
