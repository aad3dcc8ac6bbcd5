//! A rotor in an oil film against the closed form of its limit speed.

use eigentol::modes::Sense;
use eigentol::{Error, Study};
use eigentol_interpreter::Interpreted;
use eigentol_oracle::model::{Curve, Unit};
use eigentol_tests::corpus::film_rotor::FilmRotor;

use super::common::{design, event};

const RPM: f64 = std::f64::consts::TAU / 60.0;
const BEGIN: f64 = 2000.0 * RPM;
const END: f64 = 12000.0 * RPM;

/// A curve of the declaration, evaluated by the oracle's own splines.
fn curve<const K: usize>(arguments: [f64; K], values: [f64; K]) -> impl Fn(f64) -> f64 {
    let points = arguments.into_iter().zip(values);
    let curve =
        Curve { name: String::new(), points: points.map(|(x, y)| [x, y]).collect(), units: [Unit::Of([0; 3]); 2] };
    move |x| curve.at(x)
}

/// The difference between the film's stiffness and the stiffness at which the rotor is at the stability limit: zero at
/// the limit speed.
///
/// `det(K - m w^2 + i w C) = 0` for real `w`: its imaginary part gives `m w^2 = k`, its real part `w^2`.
fn excess([mass, film, temperature]: [f64; 3], speed: f64) -> f64 {
    let rpm = speed / RPM;
    let six = [2e3, 4e3, 6e3, 8e3, 10e3, 12e3];
    let kxx = film * curve(six, [12.15e6, 12.39e6, 12.44e6, 12.46e6, 12.47e6, 12.48e6])(rpm);
    let kxy = film * curve([2e3, 5e3, 12e3], [20.4e6, 51.4e6, 123.3e6])(rpm);
    let kyx = film * curve([2e3, 4e3, 8e3, 12e3], [-26.91e6, -44.58e6, -84.02e6, -124.6e6])(rpm);
    let kyy = film * (7.5e6 - 1.2e6 * (rpm - 2e3) / 10e3);
    let viscosity = curve([20.0, 40.0, 60.0, 90.0], [1.8, 1.2, 0.8, 0.5])(temperature);
    let six = [2e3, 3e3, 4e3, 6e3, 9e3, 12e3];
    let cross = curve(six, [-58.2e3, -39.3e3, -29.6e3, -19.8e3, -13.2e3, -9.9e3])(rpm);
    let [cxx, cyy, cxy] = [208e3, 240e3, cross].map(|c| viscosity * c);
    let k = (kxx * cyy + kyy * cxx - cxy * (kxy + kyx)) / (cxx + cyy);
    let square = ((kxx - k) * (kyy - k) - kxy * kyx) / (cxx * cyy - cxy * cxy);
    k - mass * square
}

fn limit(design: [f64; 3]) -> f64 {
    let (mut stable, mut unstable) = (BEGIN, END);
    for _ in 0..100 {
        let middle = 0.5 * (stable + unstable);
        match excess(design, middle) > 0.0 {
            true => stable = middle,
            false => unstable = middle,
        }
    }
    0.5 * (stable + unstable)
}

#[test]
fn the_limit_speed_of_an_oil_film() {
    let study = Study::new(FilmRotor).input(FilmRotor::speed, 6000.0 * RPM);
    let nominal = design(&study);
    let expected = limit(nominal);
    assert!(expected > 7000.0 * RPM && expected < 9500.0 * RPM, "{expected}");
    // The excess is smooth, so finite differences give its derivatives.
    let by = |k: usize| {
        let step = 1e-5 * nominal[k];
        let (mut up, mut down) = (nominal, nominal);
        up[k] += step;
        down[k] -= step;
        (excess(up, expected) - excess(down, expected)) / (2.0 * step)
    };
    let step = 1e-5 * expected;
    let by_speed = (excess(nominal, expected + step) - excess(nominal, expected - step)) / (2.0 * step);
    let slopes = [0, 1, 2].map(|k| -by(k) / by_speed);
    let tolerances = study.tolerances().expect("declared");
    let found = study.flutter_onset_tolerances(FilmRotor::speed, BEGIN, END).expect("a search");
    let [only] = &found[..] else { panic!("{found:?}") };
    event(only, expected, &slopes, &nominal, tolerances.half_widths());
}

/// The growing mode is forward whirl at about half the speed.
#[test]
fn oil_whirl_goes_forward_at_half_the_speed() {
    let nominal = design(&Study::new(FilmRotor));
    let speed = 1.02 * limit(nominal);
    let study = Study::new(FilmRotor).input(FilmRotor::speed, speed);
    let (modes, whirls) = (study.modes().expect("modes"), study.whirls().expect("whirls"));
    let growing = modes.modes.iter().zip(whirls.iter()).filter(|(mode, _)| mode.s.re > 0.0);
    let growing: Vec<_> = growing.collect();
    let [(mode, whirl)] = growing[..] else { panic!("{modes:?}") };
    assert_eq!(whirl.expect("it circles").sense(), Some(Sense::Forward));
    let share = mode.s.im.abs() / speed;
    assert!((0.45..0.52).contains(&share), "{share}");
}

/// Curves are undefined beyond their ends: evaluating there is an error that names the curve and the end. The
/// ends themselves are valid.
#[test]
fn a_curve_ends() {
    let at = |speed: f64| Study::new(FilmRotor).input(FilmRotor::speed, speed).equilibrium();
    for speed in [BEGIN, END] {
        assert!(at(speed).is_ok());
    }
    for (speed, words) in [(0.999 * BEGIN, "begins at"), (1.001 * END, "ends at")] {
        let Err(error @ Error::Unphysical { .. }) = at(speed) else { panic!("{speed}") };
        let text = error.to_string();
        assert!(text.contains(words) && text.contains("cxy"), "{text}");
    }
    let warm = Study::new(FilmRotor).input(FilmRotor::speed, 6000.0 * RPM).design(FilmRotor::temperature, 95.0);
    let text = warm.modes().expect_err("too warm").to_string();
    assert!(text.contains("viscosity"), "{text}");
}

/// Equal values are not enough: a tolerance moves each variable independently.
#[test]
fn only_a_symmetric_matrix_has_a_symmetric_stiffness() {
    let is_symmetric = |xy: &str, yx: &str| {
        let text = format!(
            "mechanism Plate {{
                input speed: rpm;
                design k = 1 N/m;
                design l = 1 N/m;
                curve c: [0, 1000, 2000] rpm -> [1, 2, 2] N/m;
                body slide: massless;
                body plate: box(mass: 1 kg, size: [1, 1, 1] m);
                joint x: prismatic(x) from ground to slide;
                joint y: prismatic(y) from slide to plate;
                point seat: ground;
                point center: plate;
                force mount: bushing(from: seat, to: center, stiffness: [[9 N/m, {xy}, 0], [{yx}, 8 N/m, 0], [0, 0, 0]]);
            }}"
        );
        let mechanism = Interpreted::from_text(&text).expect("a mechanism");
        mechanism.description().symmetric_stiffness
    };
    for (xy, yx, expected) in [
        ("0", "0", true),
        ("k", "k", true),
        ("2 * k", "k + k", true),
        ("c(speed)", "c(speed)", true),
        ("k", "l", false),
        ("k", "-k", false),
        ("0", "k", false),
        ("c(speed)", "c(speed / 2)", false),
    ] {
        assert_eq!(is_symmetric(xy, yx), expected, "{xy}, {yx}");
    }
}
