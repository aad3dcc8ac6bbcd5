//! Bands of amplitudes against designs solved anew, at and beside resonances.

use eigentol::Study;
use eigentol::propagation::vibrations;
use eigentol::response::{Response, Responses, Vibration};
use eigentol::tolerance::{Points, Sampling};
use eigentol_interpreter::Interpreted;

/// Shows the greatest errors of sigma and of the 99 % quantile of every output along an input.
fn greatest_errors(text: &str, input: &str, values: &[f64]) -> (f64, f64) {
    let machine = Interpreted::from_text(&format!("mechanism Machine {{ {text} }}")).expect("a declaration");
    let mut worst = (0.0_f64, 0.0_f64);
    for &value in values {
        let study = Study::new(machine.clone());
        let input = study.find_input(input).expect("an input");
        let study = study.input(input, value);
        let outputs = study.description().outputs.len();
        let wanted: Vec<Response> = (0..outputs)
            .map(|o| {
                let of = (eigentol::Output::new(o), eigentol::Excitation::new(0));
                Response::Vibration(Vibration::new::<eigentol::Any>(of.0, of.1))
            })
            .collect();
        let (state, modes) = (study.equilibrium().expect("stands"), study.modes().expect("vibrates"));
        let responses = Responses::new(&machine, &state, &modes, wanted).expect("vibrations");
        let tolerances = study.tolerances().expect("tolerances");
        let sampling = Sampling::default().points(Points::Sobol).samples(2048).randomisations(4);
        let (_, checks) = vibrations(&machine, &responses, &tolerances, &sampling, 2048).expect("solved");
        for check in checks.into_iter().flatten() {
            println!("{value} {check:?}");
            worst = (worst.0.max(check.sigma.abs()), worst.1.max(check.upper.abs()));
        }
    }
    worst
}

#[test]
fn bands_of_a_rotor_with_two_equal_modes() {
    let rotor = "
        input omega: rad/s;
        design m = 12 kg +/- 1 %;
        design k = 1.9e6 N/m +/- 3 %;
        design c = 100 N*s/m +/- 10 %;
        design e = 0.04 mm +/- 50 %;
        design alpha = 0 deg +/- 180 deg uniform;
        body carriage: massless;
        body shuttle: massless;
        body disk: rigid(mass: m, inertia: [0.1, 0.1, 0.2] kg*m^2);
        joint x: prismatic(x) from ground to carriage;
        joint y: prismatic(y) from carriage to shuttle;
        joint spin: revolute(z) from shuttle to disk, driven at omega;
        force kx: spring(on: x, stiffness: k);
        force ky: spring(on: y, stiffness: k);
        force cx: damper(on: x, damping: c);
        force cy: damper(on: y, damping: c);
        unbalance u: on disk, eccentricity: e, angle: alpha;
        output wx = x;
        output fx = reaction_force(spin).x;
    ";
    let (sigma, upper) = greatest_errors(rotor, "omega", &[200.0, 380.0, 397.0, 398.0, 400.0, 450.0]);
    assert!(sigma < 0.01 && upper < 0.01, "{sigma} {upper}");
}

/// The equilibrium moves with the design, and so does what the arm feels.
#[test]
fn bands_of_a_shaken_pendulum_on_a_turntable() {
    let turntable = "
        input speed: rad/s;
        input f: rad/s;
        design m = 1.3 kg +/- 2 %;
        design l = 0.45 m +/- 2 %;
        design c = 0.02 N*m*s/rad +/- 10 %;
        design a = 2 mm +/- 5 %;
        gravity 9.81 m/s^2 along -z;
        body lift: massless;
        body table: massless;
        body rod: rod(mass: m, length: l, along: -z);
        joint heave: prismatic(z) from ground to lift, shaken(amplitude: a, frequency: f);
        joint spin: revolute(z) from lift to table, driven at 8 rad/s;
        joint theta: revolute(y) from table to rod;
        force damp: damper(on: theta, damping: c);
        point tip: rod at [0, 0, -l];
        output height = position(tip).z;
        output angle = theta;
    ";
    let (sigma, upper) = greatest_errors(turntable, "f", &[3.0, 6.0, 6.5, 6.877, 7.2, 12.0]);
    assert!(sigma < 0.01 && upper < 0.01, "{sigma} {upper}");
}

/// Ten masses on springs in a row: more unknowns than vectors border the dynamic stiffness.
fn long_chain() -> String {
    let mut text = String::from(
        "
        input f: rad/s;
        design m = 1 kg +/- 3 %;
        design k = 1000 N/m +/- 3 %;
        design c = 0.4 N*s/m +/- 10 %;
        design stray = 800 N/m +/- 10 %;
    ",
    );
    for i in 0..10 {
        let before = if i == 0 { "ground".to_owned() } else { format!("b{}", i - 1) };
        text += &format!(
            "body b{i}: rigid(mass: m, inertia: [1, 1, 1] kg*m^2);
             joint x{i}: prismatic(x) from {before} to b{i};
             force k{i}: spring(on: x{i}, stiffness: {});
             force c{i}: damper(on: x{i}, damping: c);",
            if i == 4 { "stray" } else { "k" }
        );
    }
    text
}

#[test]
fn bands_of_a_long_chain() {
    let text = long_chain()
        + "point end: b9; force shake: harmonic(at: end, force: [1, 0, 0] N, frequency: f);
           output first = x0; output last = position(end).x; output root = reaction_force(x0).x;";
    let (sigma, upper) = greatest_errors(&text, "f", &[3.0, 4.6, 4.8, 13.0, 14.0, 30.0, 52.0]);
    assert!(sigma < 0.01 && upper < 0.01, "{sigma} {upper}");
}

/// Its end is held, so that a constraint stands among the unknowns.
#[test]
fn bands_of_a_long_chain_in_a_loop() {
    let text = long_chain()
        + "point end: b9; point wall: ground; point middle: b4;
           constraint hold: coincident(from: end, to: wall, along: x);
           force shake: harmonic(at: middle, force: [1, 0, 0] N, frequency: f);
           output first = x0; output centre = position(middle).x; output root = reaction_force(x0).x;";
    let (sigma, upper) = greatest_errors(&text, "f", &[4.0, 9.6, 9.8, 19.4, 28.0, 29.0, 52.0]);
    assert!(sigma < 0.01 && upper < 0.01, "{sigma} {upper}");
}
