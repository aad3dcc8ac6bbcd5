//! The rotor compared with hand-written equations, `det(s^2 M + s (C - i W G) + K - i W D) = 0` in displacements and
//! slopes of the shaft, solved again for every design derivative; and with the closed forms of Jeffcott's rotor.

use std::f64::consts::PI;

use eigentol::modes::{Sense, Whirl};
use eigentol::requirement::Requirement;
use eigentol::sweep::{Condition, Event};
use eigentol::tolerance::{Outcome, Sample};
use eigentol::{Complex, Mechanism, Study};

use super::jeffcott_rotor::{self, JeffcottRotor};
use super::{near, printed, shows};

/// One turn per minute, rad/s.
const RPM: f64 = PI / 30.0;

/// Nominal design, in the order of the declaration.
const DESIGN: [f64; 10] = [206e9, 0.030, 0.260, 0.320, 80e-6, 0.250, 0.030, 150e3, 250e3, 80.0];

const HALF_WIDTHS: [f64; 10] = [4.12e9, 1e-4, 1e-3, 1e-3, 24e-6, 2e-4, 2e-4, 30e3, 50e3, 24.0];

/// Physical parameters of the design: mass, moments of inertia across and along the axis, stiffness of the shaft.
struct Rotor {
    mass: f64,
    across: f64,
    along: f64,
    shaft: [f64; 3],
}

impl Rotor {
    fn of([modulus, diameter, a, b, _, radius, width, ..]: [f64; 10]) -> Self {
        let bending = modulus * PI * diameter.powi(4) / 64.0;
        let mass = 7850.0 * PI * radius * radius * width;
        let span = a + b;
        Self {
            mass,
            across: mass * (radius * radius / 4.0 + width * width / 12.0),
            along: mass * radius * radius / 2.0,
            shaft: [
                3.0 * bending * span * (a * a - a * b + b * b) / (a * b).powi(3),
                3.0 * bending * span * (a - b) / (a * b).powi(2),
                3.0 * bending * span / (a * b),
            ],
        }
    }
}

/// The determinant of the equations of `(x, y, dx/dz, dy/dz)`, scaled to order one.
fn determinant(design: [f64; 10], speed: f64, s: Complex) -> Complex {
    let rotor = Rotor::of(design);
    let [lag, seal_x, seal_y, seal_damping] = [4, 7, 8, 9].map(|j| design[j]);
    let [k11, k12, k22] = rotor.shaft;
    let mut d = [[Complex::new(0.0, 0.0); 4]; 4];
    for (i, j, k) in [(0, 0, k11), (0, 2, k12), (2, 0, k12), (2, 2, k22)] {
        // Material damping acts on rates in the rotating frame: z' - i W z.
        d[i][j] += k * (1.0 + lag * s);
        d[i + 1][j + 1] += k * (1.0 + lag * s);
        d[i][j + 1] += k * lag * speed;
        d[i + 1][j] -= k * lag * speed;
    }
    for (i, seal) in [(0, seal_x), (1, seal_y)] {
        d[i][i] += rotor.mass * s * s + seal_damping * s + seal;
        d[i + 2][i + 2] += rotor.across * s * s;
    }
    d[2][3] += rotor.along * speed * s;
    d[3][2] -= rotor.along * speed * s;
    eliminate(d) / (k11 * k11 * k22 * k22)
}

fn eliminate(mut d: [[Complex; 4]; 4]) -> Complex {
    let mut product = Complex::new(1.0, 0.0);
    for k in 0..4 {
        let pivot = (k..4).max_by(|&i, &j| d[i][k].norm().total_cmp(&d[j][k].norm()));
        let pivot = pivot.unwrap();
        if pivot != k {
            d.swap(pivot, k);
            product = -product;
        }
        product *= d[k][k];
        let row = d[k];
        for other in &mut d[k + 1..] {
            let factor = other[k] / row[k];
            for (entry, above) in other.iter_mut().zip(row) {
                *entry -= factor * above;
            }
        }
    }
    product
}

/// Newton's method in two unknowns, with finite-difference slopes.
fn solve(start: [f64; 2], equation: impl Fn([f64; 2]) -> Complex) -> [f64; 2] {
    let mut at = start;
    for _ in 0..20 {
        let value = equation(at);
        let slope = |k: usize| {
            let step = 1e-5 * at[k].abs().max(1.0);
            let [mut low, mut high] = [at, at];
            low[k] -= step;
            high[k] += step;
            (equation(high) - equation(low)) / (2.0 * step)
        };
        let (a, b) = (slope(0), slope(1));
        let det = a.re * b.im - a.im * b.re;
        at[0] -= (value.re * b.im - value.im * b.re) / det;
        at[1] -= (a.re * value.im - a.im * value.re) / det;
    }
    at
}

#[test]
fn every_mode_solves_the_equations_written_by_hand() {
    let speeds: Vec<f64> = (0..25).map(|k| 250.0 * RPM * f64::from(k)).collect();
    let none: &[f64] = &[];
    let diagram = jeffcott_rotor::study().campbell(JeffcottRotor::speed, &speeds, none);
    let mut before = [0.0; 4];
    for point in diagram.unwrap().points {
        let speed = point.value;
        let modes = point.modes.unwrap();
        assert_eq!(modes.len(), 4);
        for mode in &modes {
            let number = mode.label + 1;
            let solved = solve([mode.s.re, mode.s.im], |[growth, frequency]| {
                determinant(DESIGN, speed, Complex::new(growth, frequency))
            });
            // Gravity tilts the disk by 3e-4; the hand-written equations neglect its square.
            let error = (Complex::new(solved[0], solved[1]) - mode.s).norm() / mode.s.norm();
            assert!(error < 3e-7, "mode {number} at {speed}: {error:e}");
            let damping = mode.damping_ratio.as_ref().unwrap().mean;
            near("damping", damping, -mode.s.re / mode.s.norm(), 1e-12);
            // Frequencies rise with forward whirl and fall with backward whirl.
            let forward = number % 2 == 0;
            let whirl = mode.whirl.and_then(Whirl::sense);
            if speed == 0.0 {
                assert!(matches!(whirl, None | Some(Sense::Planar)), "{whirl:?}");
            } else {
                let expected = if forward { Sense::Forward } else { Sense::Backward };
                assert_eq!(whirl, Some(expected), "mode {number} at {speed}");
                assert!(number < 3 || (mode.s.im > before[mode.label]) == forward);
            }
            before[mode.label] = mode.s.im;
        }
    }
}

#[test]
fn every_event_and_its_derivatives_are_those_of_the_equations_written_by_hand() {
    let text = printed(jeffcott_rotor::run);
    let speeds = [0.0, 3000.0 * RPM, 6000.0 * RPM];
    let study = jeffcott_rotor::study();
    let diagram = study.campbell(JeffcottRotor::speed, &speeds, &[1.0, 2.0]);
    let diagram = diagram.unwrap();
    assert_eq!((diagram.crossings.len(), diagram.flutter_onsets.len()), (6, 1));
    assert!(diagram.critical.is_empty());
    for event in diagram.crossings.iter().chain(&diagram.flutter_onsets) {
        let speed = event.value;
        shows(&text, &[&format!("{:.2}", speed / RPM)]);
        let Event::Crossing { condition, s, .. } = event.event else { panic!("{event}") };
        // The unknowns are the speed and the quantity the event leaves free: the growth or the frequency.
        let solved = |design: [f64; 10]| {
            let open = match condition {
                Condition::Line(_) => s.re,
                _ => s.im,
            };
            solve([open, speed], |[open, speed]| {
                let s = match condition {
                    Condition::Line(line) => Complex::new(open, line.ratio * speed),
                    _ => Complex::new(0.0, open),
                };
                determinant(design, speed, s)
            })[1]
        };
        near("speed", speed, solved(DESIGN), 3e-7);
        let spread = event.spread.as_ref().unwrap();
        let mut variance = 0.0;
        for (j, &found) in spread.by_design.iter().enumerate() {
            let step = 1e-4 * DESIGN[j];
            let moved = |sign: f64| {
                let mut design = DESIGN;
                design[j] += sign * step;
                solved(design)
            };
            let slope = (moved(1.0) - moved(-1.0)) / (2.0 * step);
            // Error relative to the effect of a relative change on the speed itself.
            let error = (found - slope).abs() * DESIGN[j] / speed;
            assert!(error < 1e-6, "{j} at {speed}: {found:e} is not {slope:e}");
            variance += (slope * HALF_WIDTHS[j] / 3.0).powi(2);
        }
        near("sigma", spread.sigma, variance.sqrt(), 1e-5);
    }
}

/// With the disk in the middle and an isotropic seal, displacement and tilt decouple, and both have closed forms.
#[test]
fn the_plain_rotor_has_the_closed_forms_of_jeffcott() {
    type Plain = JeffcottRotor;
    let (half, seal) = (0.29, 200e3);
    let study = Study::new(JeffcottRotor)
        .design(Plain::near, half)
        .design(Plain::far, half)
        .design(Plain::seal_x, seal)
        .design(Plain::seal_y, seal);
    let design: [f64; 10] = study.design_values().try_into().expect("ten variables");
    let [lag, external] = [design[4], design[9]];
    let rotor = Rotor::of(design);
    let bending = design[0] * PI * design[1].powi(4) / 64.0;
    let span = 2.0 * half;
    let shaft = 48.0 * bending / span.powi(3);
    near("shaft", rotor.shaft[0], shaft, 1e-14);

    // Onset of instability: sqrt(k / m) (1 + ce / ci).
    let (stiffness, internal) = (shaft + seal, lag * shaft);
    let natural = (stiffness / rotor.mass).sqrt();
    let onset = natural * (1.0 + external / internal);
    let (low, high) = (0.0, 6000.0 * RPM);
    let found = study.flutter_onset_tolerances(Plain::speed, low, high).unwrap();
    assert_eq!(found.len(), 1);
    near("onset", found[0].value, onset, 1e-9);
    let slopes = found[0].spread.as_ref().unwrap().by_design.clone();
    let ratio = external / internal;
    let by_shaft = natural / (2.0 * stiffness) * (1.0 + ratio) - natural * ratio / shaft;
    let by_seal = natural / (4.0 * stiffness) * (1.0 + ratio);
    let by_mass = -onset / (2.0 * rotor.mass);
    let expected = [
        by_shaft * shaft / design[0],
        by_shaft * 4.0 * shaft / design[1],
        by_shaft * -3.0 * shaft / span,
        by_shaft * -3.0 * shaft / span,
        -natural * ratio / lag,
        by_mass * 2.0 * rotor.mass / design[5],
        by_mass * rotor.mass / design[6],
        by_seal,
        by_seal,
        natural / internal,
    ];
    for (j, (&slope, &expected)) in slopes.iter().zip(&expected).enumerate() {
        near(&Plain::DESCRIPTION.design[j].name, slope, expected, 1e-7);
    }

    // `m s^2 + (ce + ci) s + k - i W ci` and `It s^2 + (ct - i W Ip) s + kt - i W ct`: forward roots with Im s > 0.
    let speed = 3000.0 * RPM;
    let i = Complex::new(0.0, 1.0);
    let turning = 12.0 * bending / span;
    let mut expected: Vec<Complex> = Vec::new();
    for [m, c, k] in [
        [Complex::from(rotor.mass), Complex::from(external + internal), stiffness - i * speed * internal],
        [Complex::from(rotor.across), lag * turning - i * speed * rotor.along, turning * (1.0 - i * speed * lag)],
    ] {
        let root = (c * c - 4.0 * m * k).sqrt();
        for s in [(-c + root) / (2.0 * m), (-c - root) / (2.0 * m)] {
            expected.push(Complex::new(s.re, s.im.abs()));
        }
    }
    expected.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    let mut modes: Vec<Complex> =
        study.clone().input(Plain::speed, speed).modes().unwrap().modes.iter().map(|mode| mode.s).collect();
    modes.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    assert_eq!(modes.len(), 4);
    for (mode, expected) in modes.iter().zip(&expected) {
        let error = (mode - expected).norm() / expected.norm();
        assert!(error < 1e-9, "{mode} is not {expected}");
    }
}

#[test]
fn monte_carlo_confirms_the_risks() {
    let study = jeffcott_rotor::study().seed(4).samples(20_000).keep_samples(true);
    let run = study.monte_carlo().unwrap();
    let samples = 20_000_f64;
    let confirmed = |hits: usize, expected: f64| {
        let share = hits as f64 / samples;
        let error = (share * (1.0 - share) / samples).sqrt();
        assert!(hits > 100 && (share - expected).abs() < 4.0 * error, "{share} {expected}");
    };

    let speed = 3000.0 * RPM;
    let all = run.all.as_ref().unwrap();
    for mode in 0..4 {
        let inside =
            |sample: &&Sample| sample.frequencies[mode].is_some_and(|frequency| (frequency / speed - 1.0).abs() <= 0.1);
        let hits = all.iter().filter(inside).count();
        if mode == jeffcott_rotor::TILTING {
            // What has no stable equilibrium fails as well.
            let fails = |sample: &&Sample| inside(sample) || sample.outcome != Outcome::Stable;
            let found = study.probability(&[jeffcott_rotor::resonance()]).unwrap();
            confirmed(all.iter().filter(fails).count(), found.each[0].value);
        } else {
            assert_eq!(hits, 0, "mode {mode}");
        }
    }
    let unstable = study.probability(&[Requirement::Stable]).unwrap();
    confirmed(run.samples - run.counts.stable, unstable.each[0].value);

    // Only some samples oscillate in every mode stably; mean and sigma of the frequencies count these.
    for (spread, sampled) in study.second_order().unwrap().modes.iter().zip(&run.modes) {
        let (spread, sampled) = (&spread.as_ref().unwrap().frequency, sampled.as_ref().unwrap());
        let sigma = sampled.sigma.unwrap();
        near("sigma", sigma, spread.moments.sigma, 4.0 / (2.0 * samples).sqrt());
        let shift = sampled.mean - spread.moments.mean;
        assert!(shift.abs() < 4.0 * sigma / samples.sqrt(), "{shift}");
    }
}
