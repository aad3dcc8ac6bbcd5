//! Figures of one operating point.

use eigentol::Study;
use eigentol::second_order::Band;
use eigentol_figures::{Histogram, Style, margin, mode_shapes, participation, shares};

use crate::machines::{Bars, Pendulum, Rotor, bars, pendulum, save};

#[test]
fn shares_are_those_of_first_order_with_the_greatest_on_top() {
    let study = bars().input(Bars::omega, 5.0);
    let found = study.first_order().unwrap();
    let figure = shares(&found, 0, &Style::of(&study).name_mode(0, "swing")).unwrap();
    let panel = &figure.panels[0];
    let own = found.modes[0].variance_shares();
    for (name, bar) in panel.y.categories.iter().zip(&panel.bars[0].bars) {
        let place = found
            .description
            .design
            .iter()
            .position(|info| *info.name == **name);
        assert_eq!(bar[1] - bar[0], 100.0 * own[place.unwrap()].abs());
    }
    let lengths: Vec<f64> = panel.bars[0]
        .bars
        .iter()
        .map(|bar| bar[1] - bar[0])
        .collect();
    assert!(lengths.is_sorted(), "{lengths:?}");
    assert!(figure.title.contains("swing"));
    save(&figure, "shares");
}

#[test]
fn a_histogram_has_area_one_and_so_have_its_densities() {
    let study = pendulum().input(Pendulum::omega, 4.5).samples(4000).seed(3);
    let (sampled, first) = (study.monte_carlo().unwrap(), study.first_order().unwrap());
    let (second, tolerances) = (study.second_order().unwrap(), study.tolerances().unwrap());
    let figure = Histogram::new(&sampled, 0)
        .first_order(&first)
        .second_order(&second, &tolerances)
        .figure(&Style::of(&study).hertz())
        .unwrap();
    let panel = &figure.panels[0];
    let area: f64 = panel.bars[0]
        .bars
        .iter()
        .map(|bar| (bar[1] - bar[0]) * bar[3])
        .sum();
    assert!((area - 1.0).abs() < 1e-12, "{area}");
    assert_eq!(panel.curves.len(), 2);
    for curve in &panel.curves {
        let [points] = &curve.pieces[..] else {
            panic!("{}", curve.label)
        };
        let area = |pair: &[[f64; 2]]| 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0]);
        let area: f64 = points.windows(2).map(area).sum();
        assert!((area - 1.0).abs() < 2e-3, "{} {area}", curve.label);
    }
    save(&figure, "histogram");
}

#[test]
fn a_margin_shows_its_probability() {
    let study = pendulum().input(Pendulum::omega, 4.5);
    let found = study.margin(
        0,
        Band::Between {
            low: 2.9,
            high: 3.0,
        },
    );
    let found = found.unwrap();
    let figure = margin(&found, &Style::default()).unwrap();
    let panel = &figure.panels[0];
    let [low, _, _] = panel.bands[0].edges[0];
    assert!(low == 2.9 && panel.bands[0].edges[1][0] == 3.0);
    let label = &panel.labels[0].text;
    let percent: f64 = label.split_whitespace().nth(1).unwrap().parse().unwrap();
    assert!(
        (percent / (100.0 * found.margin.corrected.value) - 1.0).abs() < 1e-4,
        "{label}"
    );
    save(&figure, "margin");
}

#[test]
fn mode_shapes_are_relative_to_the_largest_component() {
    let study = bars().input(Bars::omega, 5.0);
    let solved = study.solve().unwrap();
    let figure = mode_shapes(
        &solved.modes,
        &Style::default().name_modes(["together", "apart"]),
    )
    .unwrap();
    let [panel] = &figure.panels[..] else {
        panic!("undamped shapes have no phase")
    };
    for (bars, mode) in panel.bars.iter().zip(&solved.modes.modes) {
        let largest = mode
            .shape
            .iter()
            .map(|own| own.re)
            .max_by(|a, b| a.abs().total_cmp(&b.abs()));
        for (bar, own) in bars.bars.iter().zip(mode.shape.iter()) {
            let expected = own.re / largest.unwrap();
            assert!((bar[2] + bar[3] - expected).abs() < 1e-12);
        }
    }
    assert!(panel.bars[0].label.starts_with("together, "));
    save(&figure, "mode_shapes");

    let figure = participation(&solved.modes, &solved.equilibrium, &Style::of(&study)).unwrap();
    for bars in &figure.panels[0].bars {
        let sum: f64 = bars.bars.iter().map(|bar| bar[2] + bar[3]).sum();
        assert!((sum - 100.0).abs() < 1e-9, "{sum}");
    }
    save(&figure, "participation");
}

#[test]
fn complex_shapes_have_magnitude_and_phase() {
    let study = Study::new(Rotor).input(Rotor::speed, 300.0);
    let modes = study.modes().unwrap();
    let figure = mode_shapes(&modes, &Style::of(&study).hertz()).unwrap();
    let [_, phases] = &figure.panels[..] else {
        panic!("two panels")
    };
    assert!(
        phases
            .markers
            .iter()
            .flat_map(|own| &own.points)
            .all(|at| at[1].abs() <= 180.0)
    );
    save(&figure, "complex_shapes");
}
