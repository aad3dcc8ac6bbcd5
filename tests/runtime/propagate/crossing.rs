//! Resonances and onsets of flutter as responses, against closed forms.

use eigentol::propagation::{sampled, second_order};
use eigentol::requirement::Requirement;
use eigentol::second_order::crossing_curvature;
use eigentol::sweep::{Condition, Line, Range};
use eigentol::tolerance::{Points, Sampling};
use eigentol::{Input, Law, Mechanism};

use super::*;
use crate::common::close;

/// `omega = 0.8 Omega` of the bar: `Omega^2 = 1.5 g / (0.6 l)`.
fn resonance() -> Response {
    Response::Crossing {
        mode: 0,
        condition: Condition::Line(Line::from(0.8)),
        range: Range::new(Bar::omega.any(), 4.0, 8.0).steps(20),
    }
}

fn speed(length: f64) -> f64 {
    (1.5 * GRAVITY / (0.6 * length)).sqrt()
}

#[test]
fn a_resonance_and_its_derivatives() {
    ask(&bar(), vec![resonance()], |responses| {
        let mut room = responses.workspace();
        for length in [0.8, 1.0, 1.3] {
            let found = responses.with_gradients(&mut room, &[3.0, length]).unwrap();
            close(found.values[0].unwrap(), speed(length), 1e-12);
            let gradient = found.gradients[0].as_ref().unwrap();
            assert!(gradient[0].abs() < 1e-12);
            close(gradient[1], -0.5 * speed(length) / length, 1e-11);
        }
        // The resonance lies beyond the range.
        let found = responses.with_gradients(&mut room, &[3.0, 2.0]).unwrap();
        assert_eq!((&found.values[0], &found.gradients[0]), (&None, &None));
    });
    let names = Bar::DESCRIPTION;
    assert_eq!(resonance().name(&names), "omega where frequency 1 crosses 0.8x omega");
    assert_eq!(&*resonance().unit(&names).symbol, "rad/s");
}

#[test]
fn a_resonance_spreads() {
    let length = Distribution::uniform(0.9, 1.1).unwrap();
    let tolerances = varied(length.clone());
    ask(&bar(), vec![resonance()], |responses| {
        let sampling = Sampling::default().points(Points::Sobol).samples(1 << 11);
        let samples = sampled(responses, &tolerances, &sampling).unwrap();
        let found = samples.propagation().unwrap();
        let model = second_order(&Bar, responses, &tolerances).unwrap();
        let number = 20_000;
        let at = |k: u32| length.quantile((f64::from(k) + 0.5) / f64::from(number));
        let moments = |f: &dyn Fn(f64) -> f64| {
            let mean = (0..number).map(|k| f(at(k))).sum::<f64>() / f64::from(number);
            let square = (0..number).map(|k| (f(at(k)) - mean).powi(2)).sum::<f64>();
            (mean, (square / f64::from(number)).sqrt())
        };
        let own = spread(&found, 0);
        let (mean, sigma) = moments(&speed);
        close(own.mean.value, mean, 1e-6);
        close(own.sigma.unwrap().value, sigma, 1e-4);
        for quantile in &own.quantiles {
            let truth = speed(length.quantile(1.0 - quantile.probability));
            assert!((quantile.value - truth).abs() < 2e-3 * sigma + 4.0 * quantile.error.unwrap());
        }
        let u = speed(1.0);
        let parabola = |l: f64| u * (1.0 - 0.5 * (l - 1.0) + 0.375 * (l - 1.0).powi(2));
        let (mean, sigma) = moments(&parabola);
        close(spread(&model, 0).mean.value, mean, 1e-7);
        close(spread(&model, 0).sigma.unwrap().value, sigma, 1e-6);
    });
}

/// The resonance stays above 4.8 rad/s as long as the length stays below `1.5 g / (0.6 4.8^2)`: the design point is
/// exact.
#[test]
fn a_resonance_can_be_required() {
    let limit = 1.5 * GRAVITY / (0.6 * 4.8 * 4.8);
    let study = bar().tolerance(Bar::l, 0.06).law(Bar::l, Law::Normal);
    let wanted = [Requirement::at_least(resonance(), 4.8)];
    let found = study.reliability(&wanted).unwrap();
    let points = found.limits[0].design_points.as_ref().unwrap();
    close(points[0].normal.beta, (limit - 1.0) / 0.02, 1e-6);
    let text = found.to_string();
    let says = "omega where frequency 1 crosses 0.8x omega at least 4.8 rad/s";
    assert!(text.contains(says), "{text}");
}

mechanism! {
    /// A disk on an elastic shaft, damping at rest and in the shaft: `m z'' + (e + i) z' + (k - i W i) z = 0`, and the
    /// forward whirl grows beyond `W = sqrt(k / m) (1 + e / i)`.
    mechanism Whirl {
        input speed: rad/s;
        design m = 2 kg;
        design k = 800 N/m;
        design e = 3 N*s/m;
        design i = 5 N*s/m;
        body line: massless;
        body across: massless;
        body center: massless;
        body wheel: disk(mass: m, radius: 0.1 m, axis: z);
        joint line_spin: revolute(z) from ground to line, driven at speed;
        joint x: prismatic(x) from ground to across;
        joint y: prismatic(y) from across to center;
        joint spin: revolute(z) from center to wheel, driven at speed;
        point undeformed: line;
        point deformed: center;
        force bend_x: spring(on: x, stiffness: k);
        force bend_y: spring(on: y, stiffness: k);
        force oil_x: damper(on: x, damping: e);
        force oil_y: damper(on: y, damping: e);
        force hysteresis: bushing(from: undeformed, to: deformed, damping: [i, i, 0]);
    }
}

#[test]
fn an_onset_of_flutter() {
    let study = Study::new(Whirl).input(Whirl::speed, 10.0);
    let [m, k, e, i]: [f64; 4] = [2.0, 800.0, 3.0, 5.0];
    let (root, ratio) = ((k / m).sqrt(), 1.0 + e / i);
    let onset = root * ratio;
    let first = [-0.5 * onset / m, 0.5 * onset / k, root / i, -root * e / (i * i)];
    // In order: `m` and `k` act through the square root, `e` and `i` through the ratio.
    let second = |a: usize, b: usize| match (a.min(b), a.max(b)) {
        (0, 0) => 0.75 * onset / (m * m),
        (0, 1) => -0.25 * onset / (m * k),
        (1, 1) => -0.25 * onset / (k * k),
        (2, 2) => 0.0,
        (2, 3) => -root / (i * i),
        (3, 3) => 2.0 * root * e / (i * i * i),
        (one, other) => first[one] * first[other] / onset,
    };
    let found = study.flutter_onsets(Whirl::speed, 5.0, 60.0).unwrap();
    close(found[0].value, onset, 1e-10);
    let curvature = crossing_curvature(&Whirl, &found[0]).unwrap();
    for a in 0..4 {
        close(curvature.first[a], first[a], 1e-8);
        for b in 0..4 {
            let (own, truth) = (curvature.second[a][b], second(a, b));
            let size = first[a].abs() * first[b].abs() / onset;
            assert!((own - truth).abs() < 1e-7 * size, "{a}, {b}: {own} {truth}");
        }
    }
    let response = Response::Crossing {
        mode: found[0].mode,
        condition: Condition::FlutterOnset,
        range: Range::new(Whirl::speed.any(), 5.0, 60.0).steps(40),
    };
    let (at, modes) = (&study.equilibrium().unwrap(), &study.modes().unwrap());
    let responses = Responses::new(&Whirl, at, modes, vec![response]).unwrap();
    let stiffer = [m, 1.1 * k, e, i];
    let value = responses.at(&mut responses.workspace(), &stiffer).unwrap().values[0];
    close(value.unwrap(), onset * 1.1_f64.sqrt(), 1e-10);
    assert_eq!(
        response.name(&Whirl::DESCRIPTION),
        format!("speed at the onset of flutter of mode {}", found[0].mode + 1)
    );
}

#[test]
fn a_mode_or_an_input_that_is_not_there() {
    let of = |mode: usize, input: Input| Response::Crossing {
        mode,
        condition: Condition::FlutterOnset,
        range: Range::new(input, 1.0, 2.0),
    };
    let study = bar();
    let (at, modes) = (&study.equilibrium().unwrap(), &study.modes().unwrap());
    let refused = |response| Responses::new(&Bar, at, modes, vec![response]).err();
    let error = refused(of(1, Bar::omega.any()));
    assert_eq!(error, Some(Error::NoSuchMode { mode: 1, count: 1 }));
    let error = refused(of(0, Input::new(3)));
    assert!(matches!(error, Some(Error::UnknownHandle { .. })));
}
