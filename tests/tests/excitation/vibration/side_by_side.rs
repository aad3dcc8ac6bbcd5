//! Designs solved side by side give the vibrations of designs solved one by one.

use eigentol::propagation::Samples;
use eigentol::response::{Response, Vibration};
use eigentol::sweep::SweepPoint;
use eigentol::tolerance::Sampling;
use eigentol::{Excitation, Output, Quantity, Study};
use eigentol_interpreter::Interpreted;

use super::exceedance::ROTOR;

/// Hangs out under the spin, so that the equilibrium moves with the design; undamped.
const PENDULUM: &str = "mechanism Pendulum {
    input w: rad/s;
    gravity [0, 0, -9.81 m/s^2];
    design l = 0.4 m +/- 2 %;
    design m = 1.5 kg +/- 2 %;
    design pull = 0.3 N +/- 20 %;
    body shaft: massless;
    body bar: rod(mass: m, length: l, along: -z);
    joint drive: revolute(z) from ground to shaft, driven at w;
    joint hinge: revolute(y) from shaft to bar at [0.1 m, 0, 0];
    force shaking: harmonic(on: hinge, moment: pull * 1 m, frequency: 9 rad/s);
    output swing = hinge;
}";

fn how(samples: &Samples) -> &str {
    let mut facts = samples.fingerprint().facts();
    facts.find(|fact| fact.0 == "solved").expect("a fact").1
}

#[test]
fn vibrations_of_designs_in_vectors_are_those_of_designs_one_by_one() {
    for (text, speed) in [(ROTOR, 380.0), (ROTOR, 398.0), (PENDULUM, 6.0)] {
        let machine = Interpreted::from_text(text).expect("a declaration");
        let study = Study::new(machine);
        let input = study.find_input("w").expect("an input");
        let study = study.input(input, speed);
        let shake = Vibration::new::<Interpreted>(Output::new(0), Excitation::new(0));
        let wanted = [
            Response::Vibration(shake),
            Response::Mode { mode: 0, quantity: Quantity::Frequency },
            Response::Vibration(shake.measure(eigentol::forced::Measure::Velocity)),
        ];
        let sampling = Sampling::default().samples(1500);
        let together = study.sample_responses(&wanted, &sampling).expect("sampled");
        let alone = study.vectors(None).sample_responses(&wanted, &sampling);
        let alone = alone.expect("sampled");
        assert_eq!((how(&together), how(&alone)), ("side by side", "one by one"));
        let (together, alone) = (together.propagation(), alone.propagation());
        let (together, alone) = (together.expect("complete"), alone.expect("complete"));
        for (a, b) in together.spreads.iter().zip(&alone.spreads) {
            let (a, b) = (a.as_ref().expect("a spread"), b.as_ref().expect("a spread"));
            let scale = b.mean.value;
            let (sigma, other) = (a.sigma.expect("a sigma"), b.sigma.expect("a sigma"));
            for (a, b) in [(a.mean, b.mean), (sigma, other)] {
                assert!((a.value - b.value).abs() < 1e-9 * scale, "{speed}: {a:?} {b:?}");
            }
            assert!(sigma.value > 1e-4 * scale);
        }
    }
}

/// A point on springs and dampers that turn with the shaft, and on others that stand still.
const INNER_DAMPING: &str = "mechanism Inner {
    input w: rad/s;
    design inner = 0.3 N*s/m;
    design outer = 0.2 N*s/m;
    body shaft: massless;
    body disk: point(mass: 1 kg);
    body middle: massless;
    joint drive: revolute(z) from ground to shaft, driven at w;
    joint x: prismatic(x) from shaft to middle;
    joint y: prismatic(y) from middle to disk;
    force stiff_x: spring(on: x, stiffness: 100 N/m);
    force stiff_y: spring(on: y, stiffness: 100 N/m);
    force inner_x: damper(on: x, damping: inner);
    force inner_y: damper(on: y, damping: inner);
    point seat: ground;
    point at: disk;
    force outside: bushing(from: seat, to: at, damping: [outer, outer, 0]);
    force shaking: harmonic(on: x, force: 1 N, frequency: 3 rad/s);
    output place = x;
}";

/// Beyond `10 (1 + outer / inner)` rad/s inner damping drives the shaft. Without modes the signs of the eigenvalues decide.
#[test]
fn points_without_modes_are_as_stable_as_those_with_modes() {
    let machine = Interpreted::from_text(INNER_DAMPING).expect("a declaration");
    let study = Study::new(machine);
    let speed = study.find_input("w").expect("an input");
    let speeds: Vec<f64> = (0..60).map(|k| 0.5 * f64::from(k)).collect();
    let shake = Vibration::new::<Interpreted>(Output::new(0), Excitation::new(0));
    let alone = study.bode(speed, &speeds).expect("a sweep");
    let with_modes = study.samples(10).bode_bands(speed, &speeds, &[shake], 0).expect("a sweep with bands");
    let limit = 10.0 * (1.0 + 0.2 / 0.3);
    for (a, b) in alone.points.iter().zip(&with_modes.points) {
        assert!(a.vibration.is_ok(), "{}: {:?}", a.value, a.vibration);
        assert_eq!((a.stable, b.stable), (a.value < limit, a.value < limit), "{}", a.value);
    }
}

/// More points than are shared out at a time, for any number of threads.
#[test]
fn a_sweep_has_the_same_bits_for_any_number_of_threads() {
    let machine = Interpreted::from_text(ROTOR).expect("a declaration");
    let study = Study::new(machine);
    let speed = study.find_input("w").expect("an input");
    let speeds: Vec<f64> = (0..600).map(|k| 100.0 + f64::from(k)).collect();
    let swept = |threads| {
        let study = study.clone().input(speed, 100.0).threads(threads);
        study.bode(speed, &speeds).expect("a sweep")
    };
    let alone = swept(1);
    assert_eq!(alone.points.len(), 600);
    let places = alone.points.iter().map(|point| point.value);
    assert!(places.eq(speeds.iter().copied()));
    assert!(alone == swept(3));
}

/// The frequency of an excitation changes no state, only the vibration; a drive that pulls the pendulum outwards does.
#[test]
fn along_the_frequency_of_an_excitation_the_state_stays() {
    let text = PENDULUM.replace("input w: rad/s;", "input w: rad/s; input f: rad/s;").replace("9 rad/s", "f");
    let machine = Interpreted::from_text(&text).expect("a declaration");
    let study = Study::new(machine);
    let [w, f] = ["w", "f"].map(|name| study.find_input(name).expect("an input"));
    let values: Vec<f64> = (1..=24).map(|k| 0.5 * f64::from(k)).collect();
    let study = study.input(w, 6.0).input(f, values[0]);
    let sweep = study.sweep(f, &values).expect("swept");
    let state = |point: &SweepPoint| point.equilibrium.clone().expect("solved");
    let modes = |point: &SweepPoint| point.modes.clone().expect("solved").modes;
    let (first, first_modes) = (state(&sweep.points[0]), modes(&sweep.points[0]));
    let vibrations = study.bode(f, &values).expect("excited").points;
    for ((point, vibration), &value) in sweep.points.iter().zip(&vibrations).zip(&values) {
        assert_eq!(state(point).inputs[f.index()], value);
        assert!(state(point).coordinates == first.coordinates && modes(point) == first_modes, "{value}");
        let alone = study.clone().input(f, value).forced_response().expect("it vibrates");
        let together = &vibration.vibration.as_ref().expect("it vibrates").response;
        let [one, other] = [together, &alone].map(|x| x.harmonics[0].outputs[0].expect("an amplitude"));
        assert!((one - other).norm() < 1e-12 * other.norm(), "{value}: {one} {other}");
    }
    let driven = study.sweep(w, &values).expect("swept");
    let angle = |k: usize| state(&driven.points[k]).coordinates[0];
    assert!((1..values.len()).all(|k| angle(k) != angle(k - 1)));
    // with its hinge on the axis it hangs straight, and only its frequency changes: omega^2 = 3 g / (2 l) - w^2
    let straight = text.replace("at [0.1 m, 0, 0]", "at [0, 0, 0]");
    let study = Study::new(Interpreted::from_text(&straight).expect("a declaration")).input(f, 1.0);
    let slow = &values[..12];
    for (point, w) in study.input(w, slow[0]).sweep(w, slow).expect("swept").points.iter().zip(slow) {
        let (lambda, exact) = (modes(point)[0].lambda, 1.5 * 9.81 / 0.4 - w * w);
        assert!((lambda - exact).abs() < 1e-9 * exact, "{w}: {lambda} {exact}");
    }
}
