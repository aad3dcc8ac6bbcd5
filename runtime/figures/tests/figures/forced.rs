//! Figures of forced vibration.

use std::f64::consts::{FRAC_PI_2, TAU};

use eigentol::bode::Bode;
use eigentol::forced::{Extent, Measure};
use eigentol::response::Vibration;
use eigentol::{Complex, Study};
use eigentol_figures::figure::{Panel, Point};
use eigentol_figures::{Error, Style, bode, orbit, polar};

use crate::machines::{Unbalanced, save, values};

/// One revolution per minute, rad/s.
const RPM: f64 = TAU / 60.0;

fn study() -> Study<Unbalanced> {
    Study::new(Unbalanced).input(Unbalanced::speed, 1100.0 * RPM).samples(500)
}

fn right() -> Vibration {
    Vibration::new(Unbalanced::right, Unbalanced::residual)
}

fn swept(count: usize) -> Bode {
    let speeds: Vec<f64> = values(400.0, 1800.0, count).iter().map(|value| value * RPM).collect();
    let found = study().bode(Unbalanced::speed, &speeds);
    found.expect("it vibrates at every speed")
}

/// `m e w^2 / (k - m w^2 + i w c)` in mm; the unbalance starts along x.
fn expected(rpm: f64) -> Complex {
    let w = rpm * RPM;
    let stiffness = Complex::new(40e3 - 4.0 * w * w, 30.0 * w);
    Complex::new(20e-6 * w * w, 0.0) / stiffness
}

fn line(panel: &Panel) -> Vec<Point> {
    panel.curves[0].pieces.concat()
}

#[test]
fn a_bode_plot_has_amplitude_and_unwrapped_phase() {
    let figure = bode(&swept(141), right(), &[], &Style::default()).unwrap();
    let [upper, lower] = &figure.panels[..] else { panic!("two panels") };
    assert_eq!((&*upper.x.unit, &*upper.y.unit, &*lower.y.unit), ("rpm", "m", "deg"));
    assert_eq!(upper.y.range[0], 0.0);
    for (amplitude, phase) in line(upper).iter().zip(line(lower)) {
        let own = expected(amplitude[0]);
        assert!((amplitude[1] / own.norm() - 1.0).abs() < 1e-9, "{amplitude:?}");
        assert!((phase[1] - own.arg().to_degrees()).abs() < 1e-6, "{phase:?}");
    }
    assert_eq!(line(upper).len(), 141);
    assert!(figure.caption.iter().any(|own| own.contains("0 to peak")));
    save(&figure, "bode");
}

/// A semi-axis has no phase: one panel, and no polar plot.
#[test]
fn a_semi_axis_has_an_amplitude_only() {
    let axis = right().extent(Extent::Major(Unbalanced::up.any()));
    let figure = bode(&swept(141), axis, &[], &Style::default()).unwrap();
    let [upper] = &figure.panels[..] else { panic!("one panel") };
    let both = swept(141);
    for (amplitude, point) in line(upper).iter().zip(&both.points) {
        let harmonic = &point.vibration.as_ref().unwrap().response.harmonics[0];
        let [long, _] = harmonic.orbit(Unbalanced::right.any(), Unbalanced::up.any()).unwrap().semi_axes();
        assert!((amplitude[1] / long - 1.0).abs() < 1e-12, "{amplitude:?} {long}");
    }
    assert!(matches!(polar(&swept(3), axis, &[], &Style::default()), Err(Error::Nothing(_))));
    save(&figure, "bode_of_semi_axis");
}

/// The acceleration starts at half a turn and falls by another one: it passes from -180 to 180 deg.
#[test]
fn a_phase_does_not_jump_by_a_turn() {
    let result = swept(141);
    let figure = bode(&result, right().measure(Measure::Acceleration), &[], &Style::default());
    let figure = figure.unwrap();
    assert_eq!(figure.panels[0].y.unit, "m/s^2");
    let phases = line(&figure.panels[1]);
    let steps = phases.windows(2).map(|pair| (pair[1][1] - pair[0][1]).abs());
    assert!(steps.fold(0.0, f64::max) < 90.0);
    let travel = phases[140][1] - phases[0][1];
    let turned = (expected(1800.0) / expected(400.0)).arg().to_degrees();
    assert!((travel - turned).abs() < 1e-6, "{travel} {turned}");
    save(&figure, "bode_of_acceleration");
}

#[test]
fn bands_and_peaks_are_those_of_the_results() {
    let speeds: Vec<f64> = values(800.0, 1200.0, 21).iter().map(|value| value * RPM).collect();
    let result = study().bode_bands(Unbalanced::speed, &speeds, &[right()], 0).unwrap();
    let found = study().peaks(right(), Unbalanced::speed, 400.0 * RPM, 1800.0 * RPM).unwrap();
    let peaks = [found];
    let style = Style::of(&study()).mark(1100.0, "running speed");
    let figure = bode(&result, right(), &peaks, &style).unwrap();
    let upper = &figure.panels[0];
    let bands = result.points[10].bands.as_ref().unwrap();
    let quantiles = &bands.spread.spreads[0].as_ref().unwrap().quantiles;
    let edge = upper.bands[0].edges[10];
    assert_eq!(edge[1..], [quantiles[1].value, quantiles[5].value]);
    assert_eq!(upper.error_bars[0].bars.len(), 1);
    // The line goes through the peak.
    let top = upper.error_bars[0].bars[0].at;
    let through = |point: &Point| point[0] == top[0] && (point[1] / top[1] - 1.0).abs() < 1e-12;
    assert!(line(upper).iter().any(through));
    assert_eq!(line(upper).len(), 22);
    let bar = upper.error_bars[0].bars[0];
    let peak = &peaks[0].peaks[0];
    assert!((bar.at[0] * RPM / peak.place.value - 1.0).abs() < 1e-12);
    assert_eq!(bar.at[1], peak.height.value);
    let half = peak.place.spread.as_ref().unwrap().band / RPM;
    assert!((bar.high[0] - bar.at[0] - half).abs() < 1e-9);
    let sides = &upper.markers[0];
    assert_eq!((&*sides.label, sides.points.len()), ("half power", 2));
    assert!(figure.caption.iter().any(|peak| peak.starts_with("(1) peak of ")));
    assert!(figure.caption.iter().any(|peak| peak.contains("2.3 to 97.7 %")), "{:?}", figure.caption);
    save(&figure, "bode_bands");
    let figure = polar(&swept(281), right(), &peaks, &style).unwrap();
    assert!(figure.panels[0].equal_scales);
    assert!(figure.caption.iter().any(|peak| peak.starts_with("(1) peak of ")));
    save(&figure, "polar");
    // Those of another vibration do not belong here.
    let up = Vibration::new(Unbalanced::up, Unbalanced::residual);
    let other = bode(&result, up, &peaks, &style).unwrap();
    assert!(other.panels[0].error_bars.is_empty() && other.panels[0].bands.is_empty());
}

#[test]
fn a_polar_plot_is_the_path_of_the_complex_amplitude() {
    let figure = polar(&swept(141), right(), &[], &Style::default()).unwrap();
    let speeds = values(400.0, 1800.0, 141);
    for (point, rpm) in line(&figure.panels[0]).iter().zip(speeds) {
        let there = expected(rpm);
        assert!((point[0] - there.re).hypot(point[1] - there.im) < 1e-9 * there.norm());
    }
    let labels = &figure.panels[0].labels;
    assert!((4..=8).contains(&labels.len()), "{labels:?}");
}

#[test]
fn an_orbit_is_passed_in_its_sense() {
    let style = Style::default();
    let found = study().forced_response().unwrap();
    let figure = orbit(&found, [Unbalanced::right, Unbalanced::up], Unbalanced::residual, &style);
    let figure = figure.unwrap();
    let points = line(&figure.panels[0]);
    let [x, y] = [0, 1].map(|k| found.harmonics[0].outputs[k].expect("an amplitude"));
    assert!((points[0][0] - x.re).abs() < 1e-18 && (points[0][1] - y.re).abs() < 1e-18);
    // A quarter of a period later.
    let turn = Complex::from_polar(1.0, FRAC_PI_2);
    assert!((points[45][0] - (x * turn).re).abs() < 1e-15);
    let word = |figure: &eigentol_figures::Figure, word: &str| {
        assert!(figure.caption.iter().any(|own| own.contains(word)), "{:?}", figure.caption);
    };
    word(&figure, "passed backward, from up to right");
    save(&figure, "orbit");
    let slow = study().input(Unbalanced::speed, 400.0 * RPM).forced_response().unwrap();
    let figure = orbit(&slow, [Unbalanced::right, Unbalanced::up], Unbalanced::residual, &style);
    word(&figure.unwrap(), "passed forward, from right to up");
    let mixed = [Unbalanced::right, Unbalanced::turned];
    let error = orbit(&found, mixed, Unbalanced::residual, &style).unwrap_err();
    assert!(matches!(error, Error::Nothing(_)));
}

/// Eleven speeds are far too few for a resonance; with the points about its peak the path is the circle of the formula.
#[test]
fn a_polar_plot_has_points_where_the_path_bends() {
    let coarse = swept(11);
    let peaks = study().peaks(right(), Unbalanced::speed, 400.0 * RPM, 1800.0 * RPM).unwrap();
    let between = study().bode(Unbalanced::speed, &peaks.bends()).unwrap();
    let widest = |result: &Bode| {
        let figure = polar(result, right(), &[], &Style::default()).unwrap();
        let path = line(&figure.panels[0]);
        let size = path.iter().map(|at| at[0].hypot(at[1])).fold(0.0, f64::max);
        let chords = path.windows(2).map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]));
        chords.fold(0.0, f64::max) / size
    };
    assert!(widest(&coarse) > 0.5, "{}", widest(&coarse));
    let fine = coarse.with_between(between);
    assert!(widest(&fine) < 0.2, "{}", widest(&fine));
    let figure = bode(&fine, right(), &[], &Style::default()).unwrap();
    for at in line(&figure.panels[0]) {
        assert!((at[1] / expected(at[0]).norm() - 1.0).abs() < 1e-6, "{at:?}");
    }
    // The answer has the values that were asked for.
    assert_eq!(fine.points.len(), 11);
}

#[test]
fn amplitudes_that_differ_much_stand_on_a_logarithmic_axis() {
    let result = swept(141);
    let plain = bode(&result, right(), &[], &Style::default().logarithmic_beyond(f64::INFINITY)).unwrap();
    let figure = bode(&result, right(), &[], &Style::default().logarithmic_beyond(1.0)).unwrap();
    let [linear, logarithmic] = [&plain, &figure].map(|figure| &figure.panels[0]);
    assert!(!linear.y.logarithmic && logarithmic.y.logarithmic && logarithmic.y.range[0] > 0.0);
    assert_eq!(line(linear), line(logarithmic));
    let least = line(logarithmic).iter().map(|at| at[1]).fold(f64::INFINITY, f64::min);
    assert!((0.5..1.0).contains(&(logarithmic.y.range[0] / least)));
    save(&figure, "logarithmic");
}

#[test]
fn a_point_without_a_vibration_leaves_a_gap() {
    let speeds = [800.0, 850.0, f64::NAN, 900.0, 950.0].map(|x| x * RPM);
    let result = study().bode(Unbalanced::speed, &speeds).unwrap();
    for figure in [bode, polar].map(|draw| draw(&result, right(), &[], &Style::default()).unwrap()) {
        for panel in &figure.panels {
            assert_eq!(panel.curves[0].pieces.len(), 2);
        }
    }
    let none = study().bode(Unbalanced::speed, &[f64::NAN]).unwrap();
    for found in [bode, polar].map(|draw| draw(&none, right(), &[], &Style::default())) {
        assert!(matches!(found, Err(Error::Nothing(_))));
    }
}
