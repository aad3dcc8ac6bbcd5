//! Peaks along an input: against a closed form, against fine grids, and how they end.

use eigentol::equilibrium::equilibrium;
use eigentol::forced::{Measure, response};
use eigentol::peaks::{HalfPower, Moving, Peaks, peaks};
use eigentol::response::Vibration;
use eigentol::sweep::Range;
use eigentol::{Any, Error, Excitation, Input, Output, Policy, Tolerances, Watch};
use eigentol_interpreter::Interpreted;

use super::models::{Jeffcott, Shaken};
use super::truth::{near, numbers, truth};
use crate::common::derived::Derived;

fn vibration(o: usize) -> Vibration {
    Vibration::new(Output::<Any>::new(o), Excitation::<Any>::new(0))
}

fn one(found: Result<Vec<Peaks>, Error>) -> Peaks {
    found.unwrap().remove(0)
}

const DESIGN: [f64; 4] = [12.0, 1.9e6, 310.0, 4e-5];

fn jeffcott(low: f64, high: f64, steps: usize, tolerances: Option<&Tolerances>) -> Peaks {
    let range = Range::new(Input::new(0), low, high).steps(steps);
    let from = (&[0.0][..], &DESIGN[..]);
    let (policy, model) = (Policy::Stable, Derived(Jeffcott));
    one(peaks(&model, from, &[0.0; 2], policy, (range, &[vibration(0)]), tolerances, Watch::default()))
}

#[test]
fn jeffcott_rotor() {
    let truth = truth("jeffcott");
    let values = numbers(&truth["peak"]["values"]);
    let sigma = [0.1, 1e4, 3.0, 1e-6];
    let tolerances = Tolerances::new(sigma, 1.0, None).unwrap();
    for (low, high, steps) in [(0.0, 1000.0, 1), (200.0, 900.0, 7), (900.0, 3.0, 50)] {
        let found = jeffcott(low, high, steps, Some(&tolerances));
        let [peak] = &found.peaks[..] else { panic!("one peak") };
        assert!(found.gaps.is_empty() && found.states < 120, "{}", found.states);
        let mut sides = [0, 1].map(|k| peak.half_power[k].place().unwrap());
        if low > high {
            sides.reverse();
        }
        let factor = peak.amplification.as_ref().unwrap();
        let all: [&Moving; 5] = [&peak.place, &peak.height, sides[0], sides[1], factor];
        for (i, own) in all.into_iter().enumerate() {
            near(own.value, values[i], 1e-12, 0.0);
            let spread = own.spread.as_ref().unwrap();
            let mut variance = 0.0;
            for (k, name) in ["m", "k", "c", "e"].into_iter().enumerate() {
                let expected = numbers(&truth["peak"]["derivatives"][name]["first"])[i];
                near(own.by_design[k], expected, 1e-10, values[i] / DESIGN[k]);
                variance += (expected * sigma[k]).powi(2);
            }
            near(spread.sigma, variance.sqrt(), 1e-9, 0.0);
        }
        assert!((peak.frequency.value - peak.place.value).abs() < 1e-12);
    }
}

#[test]
fn half_power_points_need_room() {
    let found = jeffcott(395.0, 500.0, 10, None);
    let [before, after] = &found.peaks[0].half_power;
    assert_eq!(*before, HalfPower::EndOfRange);
    assert!(after.place().is_some() && found.peaks[0].amplification.is_none());
    assert!(found.to_string().contains("the range ends before it"), "{found}");
    assert!(jeffcott(400.0, 900.0, 10, None).peaks.is_empty());
}

#[test]
fn an_undamped_mode_has_no_highest_amplitude() {
    let range = Range::new(Input::new(0), 100.0, 900.0);
    let design = [12.0, 1.9e6, 0.0, 4e-5];
    let from = (&[0.0][..], &design[..]);
    let model = Derived(Jeffcott);
    let found = one(peaks(&model, from, &[0.0; 2], Policy::Stable, (range, &[vibration(0)]), None, Watch::default()));
    let [gap] = &found.gaps[..] else { panic!("{found}") };
    assert!(found.peaks.is_empty());
    assert!(matches!(gap.reason, Error::Resonance { mode: Some(_), .. }), "{found}");
    let critical = (design[1] / design[0]).sqrt();
    assert!(gap.from <= critical && critical <= gap.to, "{critical} {gap:?}");
    assert!(gap.to - gap.from < 1e-3, "{gap:?}");
}

/// Seven masses in a row between walls, with a force on the first; one spring and one mass differ, so that two pairs of
/// frequencies are close. Outputs: the first and the last position.
fn row() -> Interpreted {
    let mut text = String::from(
        "mechanism Row { input w: rad/s;
         design damping = 0.02 N*s/m; design link = 3 N/m; design mass = 1.1 kg;
         point p0: ground; point p8: ground at [8 m, 0, 0];
         force push: harmonic(at: p1, force: [1, 0, 0] N, frequency: w);
         output first = x1; output last = x7;",
    );
    for k in 1..8 {
        let mass = if k == 7 { "mass" } else { "1 kg" };
        text += &format!(
            "body m{k}: point(mass: {mass}); point p{k}: m{k};
             joint x{k}: prismatic(x) from ground to m{k} at [{k} m, 0, 0];"
        );
    }
    for k in 0..8 {
        let stiffness = if k == 4 { "link" } else { "100 N/m" };
        text += &format!(
            "force s{k}: spring_damper(from: p{k}, to: p{}, stiffness: {stiffness}, damping: damping, length: 1 m);",
            k + 1
        );
    }
    Interpreted::from_text(&(text + "}")).unwrap()
}

#[test]
fn the_poles_decide_how_many_peaks_there_are() {
    let model = row();
    for (damping, grid) in [(1e-5, 0), (0.02, 8_000), (1.0, 1_000), (8.0, 500)] {
        let design = [damping, 3.0, 1.1];
        for (o, measure) in [(0, Measure::Displacement), (1, Measure::Velocity)] {
            let find = |steps: usize| {
                let range = Range::new(Input::new(0), 0.5, 30.0).steps(steps);
                let from = (&[1.0][..], &design[..]);
                let wanted = vibration(o).measure(measure);
                one(peaks(&model, from, &[0.0; 7], Policy::Stable, (range, &[wanted]), None, Watch::default()))
            };
            let found = find(1);
            for steps in [2, 13] {
                let other = find(steps);
                assert_eq!(found.peaks.len(), other.peaks.len());
                for (one, other) in found.peaks.iter().zip(&other.peaks) {
                    let (a, b) = (one.place.value, other.place.value);
                    assert!((a - b).abs() < 1e-13 * a, "{a} {b}");
                }
            }
            let at = equilibrium(&model, &[1.0], &design, &[0.0; 7], Policy::Stable).unwrap();
            let height = |w: f64| {
                let mut at = at.clone();
                at.inputs[0] = w;
                let found = response(&model, &at).unwrap();
                let y = found.harmonics[0].amplitude(Output::new(o), measure);
                y.unwrap().norm()
            };
            match grid {
                // Every mode has its peak, however narrow.
                0 => assert_eq!(found.peaks.len(), 7),
                _ => {
                    let place = |k: usize| 0.5 + 29.5 * k as f64 / grid as f64;
                    let heights: Vec<f64> = (0..=grid).map(|k| height(place(k))).collect();
                    let tops = (1..grid).filter(|&k| heights[k] > heights[k - 1] && heights[k] >= heights[k + 1]);
                    let tops: Vec<f64> = tops.map(place).collect();
                    assert_eq!(found.peaks.len(), tops.len(), "{damping} {o}");
                    for (peak, top) in found.peaks.iter().zip(tops) {
                        assert!((peak.place.value - top).abs() < 30.0 / grid as f64);
                    }
                }
            }
            for peak in &found.peaks {
                let top = peak.height.value;
                assert!((height(peak.place.value) / top - 1.0).abs() < 1e-9);
                for side in &peak.half_power {
                    if let Some(place) = side.place() {
                        let ratio = height(place.value) / top * 2.0_f64.sqrt();
                        assert!((ratio - 1.0).abs() < 1e-9, "{ratio}");
                    }
                }
            }
        }
    }
}

/// The equilibrium and the natural frequency follow the speed; the frequency of the excitation does not.
#[test]
fn peaks_follow_the_design() {
    let model = Derived(Shaken);
    let find = |design: &[f64]| {
        let range = Range::new(Input::new(0), 6.0, 12.0);
        let from = (&[8.0, 6.5][..], design);
        one(peaks(&model, from, &[1.0], Policy::Stable, (range, &[vibration(1)]), None, Watch::default()))
    };
    let design = [1.3, 0.45, 0.02, 9.81, 0.002];
    let found = find(&design);
    let [peak] = &found.peaks[..] else { panic!("one peak") };
    assert!(peak.amplification.is_none() && peak.frequency.value == 6.5);
    for k in 0..5 {
        let step = 1e-4 * design[k];
        let moved = |steps: f64| {
            let mut design = design;
            design[k] += steps * step;
            let found = find(&design);
            let peak = &found.peaks[0];
            let [a, b] = [0, 1].map(|k| peak.half_power[k].place().unwrap().value);
            [peak.place.value, peak.height.value, a, b]
        };
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(moved);
        let sides = [0, 1].map(|k| peak.half_power[k].place().unwrap());
        for (i, own) in [&peak.place, &peak.height, sides[0], sides[1]].into_iter().enumerate() {
            let expected = (a[i] - d[i] + 8.0 * (c[i] - b[i])) / (12.0 * step);
            let size = expected.abs() + own.value / design[k];
            assert!((own.by_design[k] - expected).abs() < 1e-7 * size, "{i} {k}");
        }
    }
}

/// A mass on a floor that is shaken with the same acceleration at every frequency: its place sees the floor directly, as
/// `a / w^2 (k + i c w) / (k - w^2 + i c w)`.
#[test]
fn a_peak_of_what_the_floor_moves_directly() {
    let text = "mechanism Shaken { input w: rad/s;
        body floor: massless; body m: point(mass: 1 kg);
        joint base: prismatic(x) from ground to floor, shaken(acceleration: 1 m/s^2, frequency: w);
        joint slide: prismatic(x) from floor to m;
        force s: spring(on: slide, stiffness: 100 N/m); force d: damper(on: slide, damping: 2 N*s/m);
        point p: m; output place = position(p).x; }";
    let model = Interpreted::from_text(text).unwrap();
    let range = Range::new(Input::new(0), 3.0, 30.0).steps(1);
    let found =
        one(peaks(&model, (&[3.0], &[]), &[0.0], Policy::Stable, (range, &[vibration(0)]), None, Watch::default()));
    let square = |w: f64| {
        let v = w * w;
        (1e4 + 4.0 * v) / ((100.0 - v).powi(2) + 4.0 * v) / (v * v)
    };
    let slope = |w: f64| square(w + 1e-5) - square(w - 1e-5);
    let (mut low, mut high) = (9.0, 11.0);
    for _ in 0..60 {
        let middle: f64 = 0.5 * (low + high);
        if slope(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    assert_eq!(found.peaks.len(), 1);
    let peak = &found.peaks[0];
    let place = peak.place.value;
    assert!((place - low).abs() < 1e-6, "{place} {low}");
    assert!((peak.height.value / square(place).sqrt() - 1.0).abs() < 1e-12);
}

/// One spring is 1e5 times as stiff as the other, both at an angle to the coordinates: the sharper the peak, the more of its
/// derivatives is rounding, which does not count as known. `height = force / (c w)` and `amplification = w m / c`.
#[test]
fn what_rounding_decides_is_not_known() {
    let text = "mechanism Inclined { input w: rad/s; design m = 2 kg; design k = 1e4 N/m; design c = 1 N*s/m;
        body slide: massless; body p: point(mass: m);
        joint x: prismatic(x) from ground to slide; joint y: prismatic(y) from slide to p;
        point seat: ground rotated(z, 0.5 rad); point foot: p rotated(z, 0.5 rad);
        force springs: bushing(from: seat, to: foot, stiffness: [k, 1e9 N/m, 0], damping: [c, 0, 0]);
        force push: harmonic(at: foot, force: [cos(0.5), sin(0.5), 0] N, frequency: w);
        output place = position(foot).x; }";
    let model = Interpreted::from_text(text).unwrap();
    let mut known = 0;
    for decade in 0..12 {
        let design = [2.0, 1e4, 10_f64.powi(-decade)];
        let range = Range::new(Input::new(0), 40.0, 90.0).steps(1);
        let from = (&[50.0][..], &design[..]);
        let wanted = (range, &[vibration(0)][..]);
        let found = one(peaks(&model, from, &[0.0; 2], Policy::Stable, wanted, None, Watch::default()));
        let [peak] = &found.peaks[..] else {
            // Where the damping is rounding, so is whether the peak is infinite.
            let [gap] = &found.gaps[..] else { panic!("1e-{decade}: neither a peak nor a gap") };
            assert!(decade > 7 && gap.from < 70.711 && gap.to > 70.710, "{gap:?}");
            continue;
        };
        let Some(amplification) = &peak.amplification else { continue };
        // Relative changes by m, k and c.
        for (number, expected) in [(&peak.height, [0.5, -0.5, -1.0]), (amplification, [0.5, 0.5, -1.0])] {
            if number.by_design.is_empty() {
                assert!(amplification.value > 1e3 && number.spread.is_none());
                continue;
            }
            known += 1;
            for (k, expected) in expected.into_iter().enumerate() {
                let slope = number.by_design[k] * design[k] / number.value;
                assert!(
                    (slope - expected).abs() < 0.1 + 1.0 / amplification.value,
                    "1e-{decade}, {k}: {slope} {expected}"
                );
            }
        }
    }
    assert!(known >= 6, "{known}");
}
