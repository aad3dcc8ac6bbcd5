//! The rotor compared with hand-written equations, `det(s^2 M + s (C - i W G) + K - i W D) = 0` in displacements and
//! slopes of the shaft, solved again for every design derivative; and with the closed forms of Jeffcott's rotor.

use std::f64::consts::PI;

use eigentol::{Complex, Mechanism, Study};
use eigentol_examples::RotorQuestion;
use eigentol_examples::rotor::margin::margin;
use eigentol_examples::rotor::{HZ, RPM, Risk};
use eigentol_figures::Style;

use super::jeffcott_rotor::JeffcottRotor;
use super::{columns, run};

/// Nominal design, in the order of the declaration.
const DESIGN: [f64; 10] = [
    206e9, 0.030, 0.260, 0.320, 80e-6, 0.250, 0.030, 150e3, 250e3, 80.0,
];

const HALF_WIDTHS: [f64; 10] = [
    4.12e9, 1e-4, 1e-3, 1e-3, 24e-6, 2e-4, 2e-4, 30e3, 50e3, 24.0,
];

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

fn near(name: &str, found: f64, expected: f64, tolerance: f64) {
    let error = (found - expected).abs() / expected.abs();
    assert!(error <= tolerance, "{name}: {found:e} is not {expected:e}");
}

#[test]
fn every_mode_solves_the_equations_written_by_hand() {
    let (_, path) = run(
        super::ROTOR,
        "rotor_modes",
        &["--speeds", "25", "--samples", "2"],
    );
    let columns = columns(&path.join("sweep.csv"));
    for row in 0..25 {
        let speed = columns["speed"][row].unwrap();
        for mode in 1..=4 {
            let value = |name: &str| columns[&format!("{name}_{mode}")][row];
            let frequency = value("frequency").unwrap();
            let growth = value("growth").unwrap();
            let solved = solve([growth, frequency], |[growth, frequency]| {
                determinant(DESIGN, speed, Complex::new(growth, frequency))
            });
            // Gravity tilts the disk by 3e-4; the hand-written equations neglect its square.
            let size = frequency.hypot(growth);
            let error = (solved[1] - frequency).hypot(solved[0] - growth) / size;
            assert!(error < 3e-7, "mode {mode} at {speed}: {error:e}");
            near(
                "damping",
                value("damping_ratio").unwrap(),
                -growth / size,
                1e-12,
            );
            // Frequencies rise with forward whirl and fall with backward whirl.
            if row > 0 {
                let before = columns[&format!("frequency_{mode}")][row - 1].unwrap();
                let whirl = value("whirl").unwrap();
                assert_eq!(whirl > 0.0, mode % 2 == 0, "mode {mode} at {speed}");
                assert!(mode < 3 || (frequency > before) == (whirl > 0.0));
            } else {
                assert!(value("whirl").is_none());
            }
        }
    }
}

#[test]
fn every_event_and_its_derivatives_are_those_of_the_equations_written_by_hand() {
    let (printed, path) = run(
        super::ROTOR,
        "rotor_events",
        &["--speeds", "3", "--samples", "2"],
    );
    let table = fs_table(&path.join("events.csv"));
    let names = JeffcottRotor::DESCRIPTION.design;
    let expected = [
        ("order", "1.0", "1"),
        ("order", "1.0", "2"),
        ("order", "1.0", "3"),
        ("order", "2.0", "1"),
        ("order", "2.0", "2"),
        ("order", "2.0", "3"),
        ("onset", "", "2"),
    ];
    let kinds: Vec<_> = table
        .iter()
        .map(|row| (&*row["event"], &*row["order"], &*row["mode"]))
        .collect();
    assert_eq!(kinds, expected);
    for row in &table {
        let number = |name: &str| row[name].parse::<f64>().unwrap();
        let (speed, frequency) = (number("speed"), number("frequency"));
        assert!(
            printed.contains(&format!("{:.1}", speed / RPM)),
            "{printed}"
        );
        assert!(
            printed.contains(&format!("{:.2}", frequency / HZ)),
            "{printed}"
        );
        // The unknowns are the speed and the quantity the event leaves free: the growth or the frequency.
        let order = row["order"].parse::<f64>().ok();
        let open = order.map_or(frequency, |_| number("growth"));
        let solved = |design: [f64; 10]| {
            solve([open, speed], |[open, speed]| {
                let s = match order {
                    Some(order) => Complex::new(open, order * speed),
                    None => Complex::new(0.0, open),
                };
                determinant(design, speed, s)
            })[1]
        };
        near("speed", speed, solved(DESIGN), 3e-7);
        let mut variance = 0.0;
        for (j, info) in names.iter().enumerate() {
            let step = 1e-4 * DESIGN[j];
            let moved = |sign: f64| {
                let mut design = DESIGN;
                design[j] += sign * step;
                solved(design)
            };
            let slope = (moved(1.0) - moved(-1.0)) / (2.0 * step);
            let found = number(&format!("by_{}", info.name));
            // Error relative to the effect of a relative change on the speed itself.
            let error = (found - slope).abs() * DESIGN[j] / speed;
            assert!(
                error < 1e-6,
                "{} at {speed}: {found:e} is not {slope:e}",
                info.name
            );
            variance += (slope * HALF_WIDTHS[j] / 3.0).powi(2);
        }
        near("sigma", number("sigma"), variance.sqrt(), 1e-5);
    }
}

/// Reads a CSV file by rows.
fn fs_table(path: &std::path::Path) -> Vec<std::collections::BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    reader.deserialize().map(Result::unwrap).collect()
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
    let found = study
        .flutter_onset_tolerances(Plain::speed, low, high)
        .unwrap();
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
        [
            Complex::from(rotor.mass),
            Complex::from(external + internal),
            stiffness - i * speed * internal,
        ],
        [
            Complex::from(rotor.across),
            lag * turning - i * speed * rotor.along,
            turning * (1.0 - i * speed * lag),
        ],
    ] {
        let root = (c * c - 4.0 * m * k).sqrt();
        for s in [(-c + root) / (2.0 * m), (-c - root) / (2.0 * m)] {
            expected.push(Complex::new(s.re, s.im.abs()));
        }
    }
    expected.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    let mut modes: Vec<Complex> = study
        .clone()
        .input(Plain::speed, speed)
        .modes()
        .unwrap()
        .modes
        .iter()
        .map(|mode| mode.s)
        .collect();
    modes.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    assert_eq!(modes.len(), 4);
    for (found, expected) in modes.iter().zip(&expected) {
        let error = (found - expected).norm() / expected.norm();
        assert!(error < 1e-9, "{found} is not {expected}");
    }
}

#[test]
fn monte_carlo_confirms_the_risks_whatever_the_threads() {
    let question = RotorQuestion {
        speed: JeffcottRotor::speed.any(),
        range: (0.0, 6000.0 * RPM),
        running: 3000.0 * RPM,
        orders: vec![1.0],
        margin: 0.1,
    };
    let assess = |threads: usize| {
        let study = Study::new(JeffcottRotor).seed(4).threads(threads);
        Risk::assess(&study, &question, 20_000).unwrap()
    };
    let risk = assess(1);
    assert_eq!(risk, assess(3));
    for (name, chance) in [
        ("mode 3 in band", risk.modes[2].in_band),
        ("unstable", risk.unstable),
    ] {
        let (share, error) = chance.sampled();
        let expected = chance.second_order.unwrap();
        assert!(chance.hits > 100, "{name}: {} hits", chance.hits);
        assert!(
            (share - expected).abs() < 4.0 * error,
            "{name}: {share} is not {expected}"
        );
        assert!((chance.first_order.unwrap() / expected - 1.0).abs() < 0.05);
    }
    for mode in &risk.modes {
        let frequency = mode.frequency.as_ref().unwrap();
        let sigma = mode.sampled_frequency.sigma().unwrap();
        near(
            "sigma",
            sigma,
            frequency.moments.sigma,
            4.0 / 40_000_f64.sqrt(),
        );
        let shift = mode.sampled_frequency.mean().unwrap() - frequency.moments.mean;
        assert!(shift.abs() < 4.0 * sigma / 20_000_f64.sqrt());
    }
    let out = [0, 1, 3].map(|mode| risk.modes[mode].in_band.hits);
    assert_eq!(out, [0, 0, 0]);

    // In the figure each mode has one bar for the samples, and the one mode that can enter the band shows its
    // probability.
    let study = Study::new(JeffcottRotor);
    let close = question.campbell(&study, (2400.0 * RPM, 3600.0 * RPM), 5);
    let figure = margin(&question, &close.unwrap(), &risk, Style::default()).unwrap();
    let panel = &figure.panels[0];
    let sampled = panel
        .error_bars
        .iter()
        .find(|own| own.label.starts_with("Monte Carlo"));
    let bars = &sampled.unwrap().bars;
    assert_eq!(bars.len(), 4);
    for (bar, mode) in bars.iter().zip(&risk.modes) {
        let own = &mode.sampled_frequency;
        let (mean, sigma) = (own.mean().unwrap() / HZ, own.sigma().unwrap() / HZ);
        near("mean", bar.at[1], mean, 1e-12);
        near("three sigma", bar.high[1] - bar.low[1], 6.0 * sigma, 1e-9);
    }
    let words: Vec<&str> = panel.labels.iter().map(|own| &*own.text).collect();
    let chances: Vec<_> = words
        .iter()
        .filter(|own| own.ends_with("% in the band"))
        .collect();
    let percent = 100.0 * risk.modes[2].in_band.second_order.unwrap();
    assert_eq!(chances, [&&*format!("{percent:.3} % in the band")]);
}

#[test]
fn figures_are_drawn_however_few_the_speeds() {
    for speeds in ["1", "2", "40"] {
        let (_, path) = run(
            super::ROTOR,
            "rotor_figures",
            &["--speeds", speeds, "--samples", "2"],
        );
        let rows = columns(&path.join("sweep.csv"))["speed"].len();
        assert_eq!(rows.to_string(), speeds);
        for figure in ["campbell", "damping", "margin"] {
            let text = std::fs::read_to_string(path.join(format!("{figure}.svg"))).unwrap();
            assert!(text.starts_with("<svg") && text.trim_end().ends_with("</svg>"));
            assert!(!text.contains("NaN") && !text.contains("inf"), "{figure}");
        }
    }
}
