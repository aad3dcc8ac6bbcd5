//! Figures along an input.

use std::f64::consts::{PI, TAU};

use eigentol::Study;
use eigentol::branches::BranchPoint;
use eigentol::sweep::Event;
use eigentol_figures::figure::{Colour, Panel, Point, Shape, Stroke};
use eigentol_figures::{
    Figure, Spreads, Style, branches, campbell, damping_ratios, eigenvalues, equilibria, frequencies, root_locus,
};

use crate::machines::{Bars, Door, Pendulum, Rotor, bars, pendulum, rotor_diagram, save, values};

/// All points of those curves of a panel whose label has this prefix.
fn points<'a>(panel: &'a Panel, label: &str) -> Vec<&'a Point> {
    let curves = panel.curves.iter().filter(|curve| curve.label.starts_with(label));
    curves.flat_map(|curve| curve.pieces.iter().flatten()).collect()
}

#[test]
fn a_campbell_diagram_has_the_frequencies_bands_and_events_of_its_result() {
    let result = rotor_diagram(61);
    // Two modes are equal at rest: which of them is the first is rounding.
    let Event::Crossing { mode: rocking, .. } = result.not_excited[0].event else { panic!("a crossing") };
    let style = Style::default().name_mode(rocking, "rocking").mark(3000.0, "running speed");
    let figure = campbell(&result, &style).unwrap();
    let panel = &figure.panels[0];
    assert_eq!((&*panel.x.unit, &*panel.y.unit), ("rpm", "Hz"));
    for point in &result.points {
        for mode in point.modes.as_ref().unwrap() {
            let Some(own) = mode.behaviour.frequency() else {
                continue;
            };
            let expected = [point.value * 30.0 / PI, own / TAU];
            let name = if mode.label == rocking { "rocking".to_owned() } else { format!("mode {}", mode.label + 1) };
            let near = |at: &&&Point| (at[0] - expected[0]).abs() < 1e-6 && (at[1] - expected[1]).abs() < 1e-9;
            assert!(points(panel, &name).iter().any(|at| near(&at)), "{name} {expected:?}");
        }
    }
    let bars: Vec<_> = panel.error_bars.iter().flat_map(|error_bar| &error_bar.bars).collect();
    let shown = result.crossings.iter().filter(|crossing| crossing.value.is_finite());
    assert!(!bars.is_empty());
    for event in shown {
        let at = event.value * 30.0 / PI;
        let bar = bars.iter().find(|bar| (bar.at[0] - at).abs() < 1e-9);
        if let Some(bar) = bar {
            let half = 3.0 * event.sigma().unwrap() * 30.0 / PI;
            assert!((bar.high[0] - at - half).abs() < 1e-9);
        }
    }
    assert!(figure.caption.iter().any(|line| line.contains("rocking, backward meets 2 x at")), "{:?}", figure.caption);
    // No unbalance excites it in isotropic bearings.
    let all = campbell(&result.clone().with_all_crossings(), &style).unwrap();
    for (figure, part) in [(&figure, "1 crossing is left out"), (&all, "rocking, backward meets 1 x at")] {
        assert!(figure.caption.iter().any(|line| line.contains(part)));
    }
    assert!(figure.caption.iter().any(|line| line.contains("radius = 250 mm")));
    save(&figure, "campbell");
}

#[test]
fn thin_bands_are_widened_on_request_and_the_caption_says_how_much() {
    let result = rotor_diagram(31);
    let figure = campbell(&result, &Style::default().widened()).unwrap();
    let panel = &figure.panels[0];
    let line = figure.caption.iter().find(|line| line.starts_with("Shaded: 3 standard"));
    let line = line.expect("the caption explains the bands");
    let times: f64 = line.split_whitespace().filter_map(|word| word.parse().ok()).nth(1).unwrap_or(1.0);
    let length = panel.y.range[1] - panel.y.range[0];
    let mut halves = Vec::new();
    for band in &panel.bands {
        halves.extend(band.edges.iter().map(|[_, low, high]| 0.5 * (high - low)));
    }
    halves.sort_by(f64::total_cmp);
    assert!(halves[halves.len() / 2] > 0.01 * length, "the typical band can be seen");
    let mode = &result.points[10].modes.as_ref().unwrap()[0];
    let half = times * mode.frequency.as_ref().unwrap().band / TAU;
    assert!(halves.iter().any(|own| (own - half).abs() < 1e-9 * half), "{times}");
}

#[test]
fn a_part_of_a_diagram_shows_what_lies_in_it_at_true_width() {
    let result = rotor_diagram(31);
    let style = Style::default().lowest(15.0).highest(30.0);
    let figure = campbell(&result, &style).unwrap();
    let panel = &figure.panels[0];
    assert_eq!(panel.y.range, [15.0, 30.0]);
    let inside = |point: &Point| (15.0..=30.0).contains(&point[1]);
    let modes = panel.curves.iter().filter(|curve| curve.label.starts_with("mode"));
    for curve in modes {
        assert!(curve.pieces.iter().flatten().any(inside), "{}", curve.label);
    }
    let mode = &result.points[10].modes.as_ref().unwrap()[2];
    let half = mode.frequency.as_ref().unwrap().band / TAU;
    let edges = panel.bands.iter().flat_map(|band| &band.edges);
    let mut halves = edges.map(|[_, low, high]| 0.5 * (high - low));
    assert!(halves.any(|own| (own / half - 1.0).abs() < 1e-9));
    assert!(!figure.caption.iter().any(|line| line.contains("times as wide")));
    // Modes are also named at the ends of their curves.
    let names: Vec<&str> = panel.labels.iter().map(|label| &*label.text).collect();
    assert!(names.contains(&"mode 3") && names.contains(&"mode 4"), "{names:?}");
}

#[test]
fn damping_ratios_cross_zero_at_the_limit_of_stability() {
    let result = rotor_diagram(61);
    let figure = damping_ratios(&result, &Style::default().mark(3000.0, "running speed")).unwrap();
    let panel = &figure.panels[0];
    assert!(panel.y.range[0] <= 0.0 && panel.y.range[1] > 0.0);
    let onsets: Vec<f64> = result.flutter_onsets.iter().map(|flutter_onset| flutter_onset.value * 30.0 / PI).collect();
    let limits = panel.error_bars.iter().find(|error_bar| error_bar.label == "limit of stability");
    let values: Vec<f64> = limits.iter().flat_map(|limit| &limit.bars).map(|bar| bar.at[0]).collect();
    assert!(!onsets.is_empty() && onsets.len() == values.len());
    for (onset, found) in onsets.iter().zip(&values) {
        assert!((onset - found).abs() <= 1e-15 * onset.abs());
    }
    save(&figure, "damping");
}

#[test]
fn modes_that_coalesce_are_drawn_without_a_gap() {
    // I = 1 kg m^2, k = m g l / 2: s = (-c +- sqrt(c^2 - 4 I k)) / (2 I).
    let (inertia, stiffness) = (1.0, 0.5 * 3.0 * 9.81);
    let turn = 2.0 * f64::sqrt(inertia * stiffness);
    let study = Study::new(Door);
    let result = study.campbell(Door::oil, &values(0.0, 12.0, 25), &[] as &[f64]).unwrap();
    let figure = eigenvalues(&result, &Style::default()).unwrap();
    let curves = figure.panels[0].curves.iter().filter(|curve| curve.label.starts_with("mode"));
    let mut reached = 0;
    for curve in curves {
        let all = curve.pieces.iter().flatten();
        let near = all.map(|at| (at[0] - turn).abs()).fold(f64::INFINITY, f64::min);
        assert!(near < 0.01, "{} ends {near} before the turn", curve.label);
        reached += 1;
        for at in curve.pieces.iter().flatten() {
            let square = at[0] * at[0] / 4.0 - stiffness;
            let middle = -0.5 * at[0];
            // (s - middle)^2 is interpolated linearly between two sweep values: the error is h^2 / 8 times its
            // curvature.
            let own = match curve.label.ends_with("imaginary part") {
                true => -at[1] * at[1],
                false => (at[1] - middle).powi(2),
            };
            let real_part = curve.label.ends_with("real part");
            let expected = if real_part { 0.0 } else { square };
            assert!((own - expected).abs() < 0.016, "{} {at:?}", curve.label);
        }
    }
    assert_eq!(reached, 4, "real and imaginary part, and two real eigenvalues");
    save(&figure, "eigenvalues");
    let figure = root_locus(&result, &Style::default()).unwrap();
    save(&figure, "root_locus");
    let meets = |curve: &&eigentol_figures::figure::Curve| {
        curve.pieces.iter().flatten().any(|at| (at[0] + turn / 2.0).abs() < 0.01 && at[1] == 0.0)
    };
    assert_eq!(figure.panels[0].curves.iter().filter(meets).count(), 3);
    save(&frequencies(&result, &Style::default()).unwrap(), "frequencies_damped");
}

#[test]
fn the_frequency_of_the_pendulum_touches_zero_at_its_critical_speed() {
    let critical = f64::sqrt(1.5 * 9.81);
    let sweep = pendulum().sweep(Pendulum::omega, &values(0.0, 8.0, 33)).unwrap();
    let figure = frequencies(&sweep, &Style::default().name_modes(["swing"])).unwrap();
    let own = points(&figure.panels[0], "swing");
    let lowest = own.iter().min_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
    assert!((lowest[0] - critical).abs() < 1e-8 && lowest[1] == 0.0, "{lowest:?}");
    assert_eq!(figure.panels.len(), 1, "nothing is damped");
    save(&figure, "frequencies");

    let figure = equilibria(&sweep, &Style::default()).unwrap();
    for at in points(&figure.panels[0], "theta") {
        let exact = match at[0] < critical {
            true => 0.0,
            false => (critical / at[0]).powi(2).acos(),
        };
        let solved = sweep.points.iter().any(|point| point.value == at[0]);
        let near = if solved { 1e-6 } else { 5e-3 };
        assert!((at[1].abs() - exact).abs() < near, "{at:?} {exact}");
    }
    let [before, after] = &figure.panels[0].curves[0].pieces[..] else {
        panic!("cut at the critical speed");
    };
    assert_eq!(before.last(), after.first(), "no jump, so no gap");
    save(&figure, "equilibrium");
}

/// Numbers of a line, in order.
fn numbers(line: &str) -> Vec<f64> {
    let words = line.split([' ', ',', ';', '%', '(', ')']);
    words.filter_map(|word| word.parse().ok()).collect()
}

/// Every event that fits into the diagram is at its place, and its caption line has its value and sigma.
#[test]
fn events_stand_where_they_happen_and_are_told_with_their_numbers() {
    let result = rotor_diagram(61);
    let rpm = 30.0 / PI;
    let figure = campbell(&result, &Style::default()).unwrap();
    let panel = &figure.panels[0];
    let bars: Vec<_> = panel.error_bars.iter().flat_map(|error_bar| &error_bar.bars).collect();
    let all = result.crossings.iter().chain(&result.critical).chain(&result.flutter_onsets);
    let mut shown = 0;
    for (k, event) in all.enumerate() {
        let height = match event.event {
            Event::Crossing { s, .. } => s.im / TAU,
            _ => 0.0,
        };
        if height > panel.y.range[1] {
            continue;
        }
        shown += 1;
        let at = [event.value * rpm, height];
        let near = |point: &Point| (point[0] - at[0]).abs() < 1e-9 * at[0] && (point[1] - at[1]).abs() < 1e-9;
        let bar = bars.iter().find(|bar| near(&bar.at)).expect("a bar");
        let half = 3.0 * event.sigma().unwrap() * rpm;
        assert!((bar.at[0] - bar.low[0] - half).abs() < 1e-9 && (bar.high[0] - bar.at[0] - half).abs() < 1e-9);
        let number = panel.labels.iter().find(|label| near(&label.at)).expect("a number");
        assert_eq!(number.text, (k + 1).to_string());
        let line = figure.caption.iter().find(|line| line.starts_with(&format!("({}) ", k + 1)));
        let told = numbers(&line.unwrap().replace("rpm", ""));
        let [.., value, sigma] = told[..] else { panic!("{told:?}") };
        assert!((value / at[0] - 1.0).abs() < 1e-4 && (sigma * 3.0 / half - 1.0).abs() < 1e-4, "{line:?} {at:?}");
    }
    assert!(shown >= 4 && bars.len() == shown, "{shown} of {}", bars.len());
}

/// Bands surround the frequencies, and the damping ratios in percent.
#[test]
fn bands_lie_about_their_modes() {
    let result = rotor_diagram(31);
    let style = Style::default();
    let frequencies = campbell(&result, &style).unwrap();
    let ratios = damping_ratios(&result, &style).unwrap();
    let mut seen = 0;
    for point in &result.points {
        for mode in point.modes.as_ref().unwrap().iter().filter(|mode| !mode.clustered) {
            let own = [(&frequencies, &mode.frequency, 1.0 / TAU), (&ratios, &mode.damping_ratio, 100.0)];
            for (figure, spread, scale) in own {
                let spread = spread.as_ref().unwrap();
                let expected =
                    [point.value * 30.0 / PI, scale * (spread.mean - spread.band), scale * (spread.mean + spread.band)];
                let same =
                    |edge: &[f64; 3]| edge.iter().zip(expected).all(|(a, b)| (a - b).abs() <= 1e-9 * b.abs().max(1.0));
                let bands = figure.panels[0].bands.iter();
                let mut edges =
                    bands.filter(|band| band.colour == Colour::Series(mode.label)).flat_map(|band| &band.edges);
                assert!(edges.any(same), "{expected:?}");
                let middle = [expected[0], 0.5 * (expected[1] + expected[2])];
                let name = format!("mode {}", mode.label + 1);
                let near = |at: &&Point| at.iter().zip(middle).all(|(a, b)| (a - b).abs() < 1e-6);
                assert!(points(&figure.panels[0], &name).iter().any(near), "{name} {middle:?}");
                seen += 1;
            }
        }
    }
    assert!(seen > 200, "{seen}");
}

/// The path of every eigenvalue starts at a ring and ends at a disc.
#[test]
fn a_root_locus_goes_from_rings_to_discs() {
    let result = rotor_diagram(21);
    let figure = root_locus(&result, &Style::default()).unwrap();
    for (shape, label, point) in
        [(Shape::Ring, "speed = 0 rpm", result.points.first()), (Shape::Disc, "speed = 6000 rpm", result.points.last())]
    {
        let marker = figure.panels[0].markers.iter().find(|marker| marker.shape == shape).unwrap();
        assert_eq!(marker.label, label);
        for mode in point.unwrap().modes.as_ref().unwrap() {
            assert!(marker.points.contains(&[mode.s.re, mode.s.im]), "{shape:?} {:?}", mode.s);
        }
    }
}

/// Every coordinate has its own panel with its own values.
#[test]
fn branches_show_each_coordinate_in_its_panel() {
    let found = bars().branches(Bars::omega, 0.0, 7.0).unwrap();
    let figure = branches(&found, &Style::of(&bars())).unwrap();
    let names: Vec<&str> = figure.panels.iter().map(|panel| &*panel.y.name).collect();
    assert_eq!(names, ["theta1", "theta2"]);
    for (k, panel) in figure.panels.iter().enumerate() {
        let shown: Vec<&Point> = points(panel, "branch");
        for point in found.branches.iter().flat_map(|branch| &branch.points) {
            let at = [point.value, point.equilibrium.coordinates[k]];
            assert!(shown.contains(&&at), "{at:?}");
        }
    }
    let pendulum = pendulum().branches(Pendulum::omega, 0.0, 8.0).unwrap();
    let figure = branches(&pendulum, &Style::of(&crate::machines::pendulum())).unwrap();
    let design = "l = 1 m +/- 0.03 m";
    assert!(figure.caption.iter().any(|line| line.contains(design)), "{:?}", figure.caption);
}

#[test]
fn frequencies_are_those_of_the_sweep() {
    let result = rotor_diagram(21);
    let figure = frequencies(&result, &Style::default()).unwrap();
    let [upper, lower] = &figure.panels[..] else { panic!("two panels") };
    for point in &result.points {
        for mode in point.modes.as_ref().unwrap() {
            let name = format!("mode {}", mode.label + 1);
            let at = point.value * 30.0 / PI;
            let ratio = -mode.s.re / mode.s.norm();
            for (panel, value) in [(upper, mode.s.im / TAU), (lower, 100.0 * ratio)] {
                let near = |point: &&Point| (point[0] - at).abs() < 1e-6 && (point[1] - value).abs() < 1e-9;
                assert!(points(panel, &name).iter().any(near), "{name} {at} {value}");
            }
        }
    }
}

/// No piece of a branch ends in the open: where stability changes without a special point, as at the onset of flutter,
/// the stable and the unstable segments meet.
#[test]
fn stretches_of_a_branch_meet_where_flutter_begins() {
    let (low, high) = (0.0, 6000.0 * PI / 30.0);
    let found = Study::new(Rotor).branches(Rotor::speed, low, high).unwrap();
    let [branch] = &found.branches[..] else { panic!("{} branches", found.branches.len()) };
    let holds = |point: &BranchPoint| point.equilibrium.stability.holds();
    let mut pairs = branch.points.windows(2);
    let onset = pairs.find(|pair| holds(&pair[0]) != holds(&pair[1]));
    let [before, after] = onset.expect("flutter begins") else { unreachable!() };
    let onset = 0.5 * (before.value + after.value) * 30.0 / PI;
    let figure = branches(&found, &Style::default()).unwrap();
    for panel in &figure.panels {
        let pieces = panel.curves.iter().flat_map(|curve| &curve.pieces);
        let ends: Vec<&Point> = pieces.flat_map(|piece| [&piece[0], &piece[piece.len() - 1]]).collect();
        for end in &ends {
            let here = ends.iter().filter(|x| x == &end).count();
            let outer = panel.x.range.contains(&end[0]);
            assert_eq!(here, if outer { 1 } else { 2 }, "{end:?} of {ends:?}");
        }
        let solid = panel.curves.iter().find(|curve| curve.stroke == Stroke::Solid);
        let last = solid.and_then(|solid| solid.pieces.last()?.last());
        assert!((last.unwrap()[0] - onset).abs() < 1e-9, "{last:?} {onset}");
    }
    let said = |figure: &Figure| figure.caption.iter().any(|line| line.contains("drawn half way"));
    assert!(said(&figure), "{:?}", figure.caption);
    let whole = Study::new(Rotor).branches(Rotor::speed, low, 0.2 * high).unwrap();
    assert!(!said(&branches(&whole, &Style::default()).unwrap()));
    save(&figure, "branches_to_flutter");
}

#[test]
fn markers_of_a_root_locus_stand_clear_of_the_frame() {
    let figure = root_locus(&rotor_diagram(21), &Style::default()).unwrap();
    let panel = &figure.panels[0];
    let [low, high] = panel.x.range;
    // Markers are 8 pixels wide, the panel is 840.
    let room = 8.0 / 840.0 * (high - low);
    let points: Vec<&Point> = panel.markers.iter().flat_map(|marker| &marker.points).collect();
    assert!(points.len() >= 8);
    for at in points {
        assert!((low + room..=high - room).contains(&at[0]), "{at:?} of {low} to {high}");
    }
    save(&figure, "root_locus_rotor");
}

#[test]
fn branches_have_stable_and_unstable_parts_and_their_pitchfork() {
    let found = pendulum().branches(Pendulum::omega, 0.0, 8.0).unwrap();
    let figure = branches(&found, &Style::of(&pendulum())).unwrap();
    let panel = &figure.panels[0];
    let unstable: Vec<_> = panel.curves.iter().filter(|curve| curve.stroke == Stroke::Dotted).collect();
    assert!(unstable.iter().all(|own| own.label.ends_with(", unstable")) && !unstable.is_empty());
    let critical = f64::sqrt(1.5 * 9.81);
    let forks = panel.markers.iter().find(|marker| marker.label == "branch point").unwrap();
    assert!(forks.points.iter().any(|at| (at[0] - critical).abs() < 1e-9));
    assert!(
        figure.caption.iter().any(|line| line.contains("pitchfork, supercritical at 3.836")),
        "{:?}",
        figure.caption
    );
    save(&figure, "branches");
}

#[test]
fn spreads_are_those_of_their_results_and_means_are_differences() {
    let speeds = [3.0, 4.2, 5.0, 6.0, 7.0];
    let dense = values(2.0, 7.5, 60);
    let study = bars().samples(300).seed(11);
    let level = |percent: f64| {
        let own = [Bars::l1, Bars::l2, Bars::m1, Bars::m2];
        own.into_iter().fold(study.clone(), |study, variable| study.relative_tolerance(variable, percent / 100.0))
    };
    let derived: Vec<_> = [3.0, 6.0, 12.0]
        .into_iter()
        .map(|percent| {
            let study = level(percent);
            let first: Vec<_> = dense.iter().chain(&speeds).copied().collect::<Vec<f64>>();
            let mut first = first;
            first.sort_by(f64::total_cmp);
            let first = study.first_order_sweep(Bars::omega, &first).unwrap();
            let first: Vec<_> = first.into_iter().flatten().collect();
            let sampled = speeds.map(|speed| study.clone().input(Bars::omega, speed).monte_carlo().unwrap());
            (percent, first, sampled)
        })
        .collect();
    let mut spreads = Spreads::new(Bars::omega.any(), 0);
    for (percent, first, sampled) in &derived {
        spreads = spreads.under(format!("{percent} %"), first, sampled);
    }
    let figure = spreads.figure(&Style::of(&study)).unwrap();
    let [sigmas, means] = &figure.panels[..] else { panic!("two panels") };
    assert_eq!(sigmas.error_bars.len(), 3);
    for (k, (_, first, sampled)) in derived.iter().enumerate() {
        for (own, speed) in sampled.iter().zip(speeds) {
            let statistics = own.modes[0].as_ref().unwrap();
            let bar = sigmas.error_bars[k].bars.iter().find(|bar| bar.at[0] == speed).unwrap();
            assert_eq!(bar.at[1], statistics.sigma.unwrap());
            let nominal = first.iter().find(|x| x.inputs[0] == speed).unwrap();
            let curve = points(sigmas, &format!("first order, {} %", [3, 6, 12][k]));
            let expected = [speed, nominal.modes[0].frequency().unwrap().sigma];
            assert!(curve.contains(&&expected), "{expected:?}");
            let nominal = nominal.modes[0].behaviour.frequency().unwrap();
            let bar = means.error_bars[k].bars.iter().find(|bar| bar.at[0] == speed).unwrap();
            assert_eq!(bar.at[1], statistics.mean - nominal);
        }
    }
    // Three tolerances do not hide each other: somewhere their means differ by more than a hundredth of the axis.
    let length = means.y.range[1] - means.y.range[0];
    let heights = means.error_bars.iter().map(|error_bar| error_bar.bars[1].at[1]);
    let heights: Vec<f64> = heights.collect();
    assert!((heights[2] - heights[0]).abs() > 0.01 * length);
    assert!(figure.caption.iter().any(|line| line.contains("300 samples, seed 11")));
    save(&figure, "spreads");
}
