//! Rotors against exact solutions: closed forms and transfer matrices in seventy digits (`tests/truth/flexible`).
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use eigentol_shafts::{Assembly, Complex, Form, Line, Matrix, Mode, Number, Others, Place, Section, Span};
use serde_json::Value;

fn truth(name: &str) -> Value {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/truth/flexible");
    serde_json::from_str(&fs::read_to_string(folder.join(format!("{name}.json"))).unwrap()).unwrap()
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

const NONE: Section =
    Section { length: 0.0, stiffness: 0.0, shear: 0.0, mass: 0.0, rotary: 0.0, lag: 0.0, tension: 0.0, drag: 0.0 };

fn close(found: f64, expected: f64, scale: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance * scale, "{what}: {found} against {expected}");
}

/// `left^T T'(s) right`.
fn normaliser(assembly: &Assembly, mode: &Mode) -> Complex {
    let slope = &assembly.pencils(&[mode.s])[0].slope;
    let products = mode
        .left
        .iter()
        .zip(slope.iter())
        .flat_map(|(a, row)| row.iter().zip(&mode.right).map(move |(m, b)| a * m * b));
    products.sum()
}

/// Simply supported: only the slopes of the ends are free.
fn supported(section: Section, line: Line, speed: f64, elements: usize, degree: usize) -> Assembly {
    let end = |k: usize| -> [Place; 4] { [None, Some((2 * k, 1.0)), None, Some((2 * k + 1, 1.0))] };
    let span = Span { line, speed, sections: vec![(section, elements)], ends: [end(0), end(1)] };
    let zero = Matrix::zeros(4, 4);
    Assembly::new(vec![span], [zero.clone(), zero.clone(), zero], degree).unwrap()
}

fn modes(of: &Assembly, count: usize) -> Vec<Mode> {
    of.modes(count).unwrap().into_iter().map(|(mode, _)| mode).collect()
}

#[test]
fn a_spinning_shaft() {
    let truth = truth("F7_spinning_shaft");
    let own = &truth["parameters"];
    let section = Section {
        length: number(own, "L"),
        stiffness: number(own, "EI"),
        shear: number(own, "kGA"),
        mass: number(own, "rhoA"),
        rotary: number(own, "rhoI"),
        ..NONE
    };
    let by = [
        ("L", Number::Length),
        ("EI", Number::Stiffness),
        ("kGA", Number::Shear),
        ("rhoA", Number::Mass),
        ("rhoI", Number::Rotary),
    ];
    for case in truth["cases"].as_array().unwrap() {
        let speed = number(case, "Omega");
        let assembly = supported(section, Line::Timoshenko, speed, 6, 10);
        for (k, omega) in numbers(&case["omega"]).into_iter().enumerate() {
            let mode = assembly.mode_at(Complex::new(0.0, omega * (1.0 + 1e-5))).unwrap();
            close(mode.s.im, omega, omega.abs(), 1e-10, "omega");
            close(mode.s.re, 0.0, omega.abs(), 1e-10, "decay");
            let slopes = assembly.slopes(&mode).swap_remove(0);
            for (name, which) in by {
                let exact = numbers(&case["derivatives"][name]["first"])[k];
                close(slopes.sections[0][which as usize].im, exact, exact.abs(), 1e-8, name);
            }
            if speed != 0.0 {
                let exact = numbers(&case["derivatives"]["Omega"]["first"])[k];
                close(slopes.speed.im, exact, exact.abs(), 1e-8, "Omega");
            }
        }
    }
}

#[test]
fn internal_damping() {
    let truth = truth("F8_internal_damping");
    let own = &truth["parameters"];
    let section = Section {
        length: number(own, "L"),
        stiffness: number(own, "EI"),
        mass: number(own, "rhoA"),
        rotary: number(own, "rhoI"),
        drag: number(own, "c"),
        lag: number(own, "eta"),
        ..NONE
    };
    let assembly = supported(section, Line::Slender, number(own, "Omega"), 3, 9);
    let exact = numbers(&truth["eigenvalues_re_im_twice"]);
    let by = [
        ("L", Number::Length),
        ("EI", Number::Stiffness),
        ("rhoA", Number::Mass),
        ("rhoI", Number::Rotary),
        ("c", Number::Drag),
        ("eta", Number::Lag),
    ];
    for k in [0, 2] {
        let s = Complex::new(exact[k], exact[k + 1]);
        let mode = assembly.mode_at(s * Complex::new(1.0, 1e-5)).unwrap();
        assert!((mode.s - s).norm() < 1e-10 * s.norm(), "{} {s}", mode.s);
        let slopes = assembly.slopes(&mode).swap_remove(0);
        let compare = |found: Complex, name: &str| {
            let first = numbers(&truth["derivatives"][name]["first"]);
            let expected = Complex::new(first[k], first[k + 1]);
            assert!((found - expected).norm() < 1e-8 * expected.norm(), "{name} {found} {expected}");
        };
        for (name, which) in by {
            compare(slopes.sections[0][which as usize], name);
        }
        compare(slopes.speed, "Omega");
    }
}

/// Nelson and McVaugh's rotor: its stations, and which unknowns they have.
struct Rotor {
    assembly: Assembly,
    stations: Vec<usize>,
}

impl Rotor {
    /// The unknowns at a station: along `y`, its slope, along `z`, its slope.
    fn base(&self, station: u64) -> usize {
        4 * self.stations.iter().position(|x| *x == station as usize).unwrap()
    }

    fn new(
        rotor: &Value,
        [stiffness, damping]: [[f64; 4]; 2],
        speed: f64,
        scale: f64,
        slender: bool,
        degree: usize,
    ) -> Self {
        let sections: Vec<Section> = rotor["sections"]
            .as_array()
            .unwrap()
            .iter()
            .map(|own| {
                let [od, id] = ["od", "id"].map(|key| number(own, key));
                let (area, second) = (PI / 4.0 * (od * od - id * id), PI / 64.0 * (od.powi(4) - id.powi(4)));
                Section {
                    length: number(own, "L"),
                    stiffness: scale * number(own, "E") * second,
                    shear: number(own, "kappa") * number(own, "G") * area,
                    mass: number(own, "rho") * area,
                    rotary: number(own, "rho") * second,
                    ..NONE
                }
            })
            .collect();
        let stations = vec![0, 4, 10, 14, 15, 18];
        let n = 4 * stations.len();
        let [mut mass, mut damped, mut stiff] = [(); 3].map(|()| Matrix::zeros(n, n));
        let base = |station: usize| 4 * stations.iter().position(|x| *x == station).unwrap();
        for disc in rotor["discs"].as_array().unwrap() {
            let b = base(disc["station"].as_u64().unwrap() as usize);
            for (k, key) in [(0, "m"), (1, "Id"), (2, "m"), (3, "Id")] {
                mass[b + k][b + k] += number(disc, key);
            }
            damped[b + 1][b + 3] += speed * number(disc, "Ip");
            damped[b + 3][b + 1] -= speed * number(disc, "Ip");
        }
        for station in [10, 14] {
            let b = base(station);
            for (k, (i, j)) in [(0, 0), (0, 2), (2, 0), (2, 2)].into_iter().enumerate() {
                stiff[b + i][b + j] += stiffness[k];
                damped[b + i][b + j] += damping[k];
            }
        }
        let line = if slender { Line::Slender } else { Line::Timoshenko };
        let spans = stations.windows(2).enumerate().map(|(k, ends)| Span {
            line,
            speed,
            sections: sections[ends[0]..ends[1]].iter().map(|own| (*own, 1)).collect(),
            ends: [k, k + 1].map(|station| [0, 1, 2, 3].map(|j| Some((4 * station + j, 1.0)))),
        });
        let assembly = Assembly::new(spans.collect(), [mass, damped, stiff], degree).unwrap();
        Self { assembly, stations }
    }
}

const ISOTROPIC: [f64; 4] = [4.378e7, 0.0, 0.0, 4.378e7];
const ORTHOTROPIC: [f64; 4] = [3.503e7, -8.756e6, -8.756e6, 3.503e7];

#[test]
fn a_rotor_of_eighteen_sections() {
    let truth = truth("F9_nelson_mcvaugh");
    for case in truth["modes"].as_array().unwrap() {
        let bearings = if case["bearings"] == "isotropic" { ISOTROPIC } else { ORTHOTROPIC };
        let slender = case["theory"] == "rayleigh";
        let rotor = Rotor::new(
            &truth["rotor"],
            [bearings, [0.0; 4]],
            number(case, "Omega"),
            1.0,
            slender,
            if slender { 7 } else { 5 },
        );
        let exact = case["eigenvalues"].as_array().unwrap();
        let modes = modes(&rotor.assembly, exact.len());
        for (mode, exact) in modes.iter().zip(exact) {
            let exact = numbers(exact);
            let s = Complex::new(exact[0], exact[1]);
            assert!((mode.s - s).norm() < 1e-8 * s.norm(), "{} {s}", mode.s);
        }
        // No other is between the lowest and what is above the highest.
        let [low, high] = [0.5 * modes[0].s.im, 1.001 * modes[modes.len() - 1].s.im];
        let within = rotor.assembly.count_within(Complex::new(-300.0, low), Complex::new(300.0, high));
        assert_eq!(within, Some(modes.len()));
    }
}

/// Stiff supports leave rounding in what tells a third equal mode from combinations of two.
#[test]
fn a_round_shaft_at_rest_has_each_mode_twice() {
    for (stiff, pieces) in [(1e9, 8), (1e11, 16), (1e12, 16), (1e14, 16)] {
        let (length, stiffness, mass) = (1.0 / f64::from(pieces), 1e4, 10.0);
        let section =
            Section { length, stiffness, shear: 0.0, mass, rotary: 6.25e-3, lag: 0.0, tension: 0.0, drag: 0.0 };
        let end = |base: usize| -> [Place; 4] { [0, 1, 2, 3].map(|k| Some((base + k, 1.0))) };
        let sections = (0..pieces).map(|_| (section, 2)).collect();
        let span = Span { line: Line::Slender, speed: 0.0, sections, ends: [end(0), end(4)] };
        let zero = Matrix::zeros(8, 8);
        let held = Matrix::from_fn(8, 8, |i, j| if i == j { stiff } else { 0.0 });
        let found = modes(&Assembly::new(vec![span], [zero.clone(), zero, held], 4).unwrap(), 12);
        for (pair, beta) in found.chunks(2).zip([4.730041, 7.853205, 10.995608, 14.137165]) {
            let expected: f64 = beta * beta * f64::sqrt(stiffness / mass);
            pair.iter().for_each(|mode| close(mode.s.im, expected, expected, 0.1, "clamped, without rotary inertia"));
        }
    }
}

/// A shaft without shear on soft springs, with a groove of a millimetre and less between two stations: it is stiff, but the slow
/// motions on the springs are no less modes for it.
#[test]
fn a_short_section_hides_no_slow_modes() {
    let (density, modulus, diameter): (f64, f64, f64) = (7850.0, 210e9, 0.06);
    let area = std::f64::consts::FRAC_PI_4 * diameter.powi(2);
    let second = area * diameter.powi(2) / 16.0;
    let section = |length: f64| Section {
        length,
        stiffness: modulus * second,
        shear: 0.0,
        mass: density * area,
        rotary: density * second,
        lag: 0.0,
        tension: 0.0,
        drag: 0.0,
    };
    for groove in [10e-3, 1e-3, 0.3e-3] {
        let span = |first: usize, length: f64, elements: usize| Span {
            line: Line::Slender,
            speed: 0.0,
            sections: vec![(section(length), elements)],
            ends: [first, first + 1].map(|station| [0, 1, 2, 3].map(|k| Some((4 * station + k, 1.0)))),
        };
        let spans = vec![span(0, 0.3, 12), span(1, groove, 1), span(2, 0.3, 12)];
        let [mass, damping, mut stiffness] = [(); 3].map(|()| Matrix::zeros(16, 16));
        for (unknown, spring) in [(0, 1e4), (2, 1e4), (12, 1e4), (14, 1e4)] {
            stiffness[unknown][unknown] = spring;
        }
        let found = modes(&Assembly::new(spans, [mass, damping, stiffness], 4).unwrap(), 4);
        // Up and down, and tilting, of a rigid shaft.
        let (length, weight) = (0.6 + groove, density * area * (0.6 + groove));
        let turns = weight * length.powi(2) / 12.0 + density * second * length;
        let [bounces, tilts] = [(2e4 / weight).sqrt(), (5e3 * length.powi(2) / turns).sqrt()];
        for (mode, expected) in found.iter().zip([bounces, bounces, tilts, tilts]) {
            close(mode.s.im, expected, expected, 2e-3, "a slow mode");
        }
    }
}

/// At rest each eigenvalue of a round rotor is two, and any combinations are modes.
#[test]
fn lists_of_modes_are_joined() {
    let truth = truth("F10_nelson_unbalance");
    for (speed, turned) in [(0.0, 0.6), (200.0, 0.0)] {
        let rotor = Rotor::new(&truth["rotor"], [ISOTROPIC, [0.0; 4]], speed, 1.0, false, 5);
        let assembly = &rotor.assembly;
        let all = modes(assembly, 8);
        let (cos, sin) = (f64::cos(turned), f64::sin(turned));
        let combined =
            |x: &[Complex], y: &[Complex], [a, b]: [f64; 2]| x.iter().zip(y).map(|(x, y)| a * x + b * y).collect();
        let others: Vec<Mode> = (all.chunks(2))
            .flat_map(|pair| {
                [[cos, sin], [-sin, cos]].map(|by| Mode {
                    s: if by[0] > 0.0 { pair[0].s } else { pair[1].s },
                    right: combined(&pair[0].right, &pair[1].right, by),
                    left: combined(&pair[0].left, &pair[1].left, by),
                })
            })
            .collect();
        // Nothing is new, one of each two, and all of half of them.
        let one_of_each: Vec<Mode> = all.iter().step_by(2).cloned().collect();
        for own in [&all[..], &one_of_each, &all[..4]] {
            let joined = assembly.continued(own, Others::Continuing(&others)).unwrap();
            let mut found: Vec<f64> = joined.iter().map(|((mode, _), _)| mode.s.im).collect();
            found.sort_by(f64::total_cmp);
            assert_eq!(found.len(), all.len(), "{speed}: {found:?}");
            for (found, mode) in found.iter().zip(&all) {
                close(*found, mode.s.im, mode.s.im, 1e-9, "joined");
            }
        }
    }
}

#[test]
fn unbalance_response() {
    let truth = truth("F10_nelson_unbalance");
    for case in truth["cases"].as_array().unwrap() {
        let bearings = if case["bearings"] == "isotropic" { ISOTROPIC } else { ORTHOTROPIC };
        let speed = number(case, "Omega");
        let damping = [1752.0, 0.0, 0.0, 1752.0];
        let rotor = Rotor::new(&truth["rotor"], [bearings, damping], speed, 1.0, false, 5);
        let assembly = &rotor.assembly;
        let s = Complex::new(0.0, speed);
        let at = assembly.at(s).unwrap();
        let mut loads = vec![Complex::new(0.0, 0.0); assembly.stations()];
        for (station, amount, angle) in [(4, 6.35e-6, 0.0), (15, 2e-6, 1.2)] {
            let force = Complex::from_polar(amount * speed * speed, angle);
            let base = rotor.base(station);
            loads[base] = force;
            loads[base + 2] = force * Complex::new(0.0, -1.0);
        }
        let right = at.response(&loads);
        let shown = case["stations"].as_array().unwrap().iter().map(|x| rotor.base(x.as_u64().unwrap()));
        let shown: Vec<usize> = shown.flat_map(|base| [base, base + 2]).collect();
        let exact = |values: &Value, k: usize| {
            let own = numbers(&values[k]);
            Complex::new(own[0], own[1])
        };
        let size = (0..shown.len()).map(|k| exact(&case["XY"], k).norm()).fold(0.0, f64::max);
        for (k, &unknown) in shown.iter().enumerate() {
            let expected = exact(&case["XY"], k);
            assert!((right.stations[unknown] - expected).norm() < 1e-8 * size, "{speed} {unknown}");

            // dX = -left^T dP right
            let mut seen = vec![Complex::new(0.0, 0.0); assembly.stations()];
            seen[unknown] = Complex::new(1.0, 0.0);
            let left = at.adjoint(&seen);
            let product = |i: usize, j: usize| left.stations[i] * right.stations[j];
            let (disc, ends) = (rotor.base(4), [10, 14].map(|station| rotor.base(station)));
            let form = Form { left: &left.stations, s, right: &right.stations };
            let gradient = assembly.gradients(&[form]).swap_remove(0);
            let section =
                |span: usize, section: usize, number: Number| -gradient[span].sections[section][number as usize];
            // Section 10, counted from 1, is the last of the second span, 25.4 mm in diameter.
            let own = assembly.spans()[1].sections[5].0;
            let od_10 = [Number::Stiffness, Number::Shear, Number::Mass, Number::Rotary].map(|number| {
                let power = if [Number::Stiffness, Number::Rotary].contains(&number) { 4.0 } else { 2.0 };
                section(1, 5, number) * power * own.number(number) / 0.0254
            });
            let modulus = assembly
                .spans()
                .iter()
                .enumerate()
                .flat_map(|(span, of)| (0..of.sections.len()).map(move |k| (span, k)));
            let modulus = modulus
                .map(|(span, k)| section(span, k, Number::Stiffness) * assembly.spans()[span].sections[k].0.stiffness);
            let found = [
                ("disc_mass", -s * s * (product(disc, disc) + product(disc + 2, disc + 2))),
                ("disc_Ip", -s * speed * (product(disc + 1, disc + 3) - product(disc + 3, disc + 1))),
                ("bearing_kxx", -ends.iter().map(|&b| product(b, b)).sum::<Complex>()),
                ("bearing_cyy", -s * ends.iter().map(|&b| product(b + 2, b + 2)).sum::<Complex>()),
                ("od_10", od_10.iter().sum()),
                ("modulus", modulus.sum::<Complex>() / number(&truth["rotor"]["sections"][0], "E")),
            ];
            for (name, found) in found {
                let all = &case["derivatives"][name]["first"];
                let size = (0..shown.len()).map(|k| exact(all, k).norm()).fold(0.0, f64::max);
                let expected = exact(all, k);
                assert!((found - expected).norm() < 1e-8 * size, "{speed} {unknown} {name} {found} {expected}");
            }
        }
    }
}

/// Three shafts, five inertias and a gear: the wheel of the third shaft turns `ratio` times as fast as that of the second.
#[test]
fn a_torsional_train() {
    let truth = truth("F15_torsional_train");
    let own = &truth["parameters"];
    let ratio = number(own, "ratio");
    let spans = (1..4).map(|k| {
        let section = Section {
            length: number(own, &format!("L{k}")),
            stiffness: number(own, &format!("GJ{k}")),
            mass: number(own, &format!("rhoJ{k}")),
            ..NONE
        };
        // The gear is the third unknown; the second wheel turns with it.
        let ends: [Place; 2] =
            if k == 3 { [Some((2, ratio)), Some((3, 1.0))] } else { [Some((k - 1, 1.0)), Some((k, 1.0))] };
        Span {
            line: Line::Bar,
            speed: 0.0,
            sections: vec![(section, 2)],
            ends: ends.map(|end| [end, None, None, None]),
        }
    });
    let inertia = |k: usize| number(own, &format!("J{k}"));
    let all = [inertia(1), inertia(2), inertia(3) + ratio * ratio * inertia(4), inertia(5)];
    let mass = Matrix::from_fn(4, 4, |i, j| if i == j { all[i] } else { 0.0 });
    let zero = Matrix::zeros(4, 4);
    let assembly = Assembly::new(spans.collect(), [mass, zero.clone(), zero], 8).unwrap();
    let exact = numbers(&truth["frequencies"]);
    let modes = modes(&assembly, 3);
    assert_eq!(modes.len(), 3);
    for (k, (mode, exact)) in modes.iter().zip(exact).enumerate() {
        close(mode.s.im, exact, exact, 1e-10, "frequency");
        let below = normaliser(&assembly, mode);
        let slopes = assembly.slopes(mode);
        let at = |span: usize, number: Number| slopes[span].sections[0][number as usize].im;
        let of_inertia = |place: usize| (-mode.s * mode.s * mode.left[place] * mode.right[place] / below).im;
        let found = [
            ("L1", at(0, Number::Length)),
            ("GJ2", at(1, Number::Stiffness)),
            ("rhoJ3", at(2, Number::Mass)),
            ("J2", of_inertia(1)),
            ("J5", of_inertia(3)),
        ];
        for (name, found) in found {
            let exact = numbers(&truth["derivatives"][name]["first"])[k];
            close(found, exact, exact.abs(), 1e-8, name);
        }
    }
}

/// Numbers between 0 and 1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / (1_u64 << 31) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

/// A shaft of random steps on random bearings with a random disk; `split` is the number of elements of a section.
fn random(seed: u64, line: Line, split: usize, degree: usize) -> Assembly {
    let (spans, matrices) = random_parts(seed, line, split);
    Assembly::new(spans, matrices, degree).unwrap()
}

fn random_parts(seed: u64, line: Line, split: usize) -> (Vec<Span>, [Matrix; 3]) {
    let mut random = Random(seed);
    let speed = random.between(0.0, 900.0);
    let mut spans: Vec<Span> = (0..3)
        .map(|k| Span {
            line,
            speed,
            sections: (0..2 + seed as usize % 3)
                .map(|_| {
                    let diameter: f64 = random.between(0.03, 0.08);
                    let (area, second) = (PI / 4.0 * diameter.powi(2), PI / 64.0 * diameter.powi(4));
                    let section = Section {
                        length: random.between(0.05, 0.2),
                        stiffness: 210e9 * second,
                        shear: 0.9 * 81e9 * area,
                        mass: 7850.0 * area,
                        rotary: 7850.0 * second,
                        lag: random.between(0.0, 1e-5),
                        tension: random.between(-2e4, 2e4),
                        drag: random.between(0.0, 50.0),
                    };
                    (section, split)
                })
                .collect(),
            ends: [k, k + 1].map(|station| [0, 1, 2, 3].map(|j| Some((4 * station + j, 1.0)))),
        })
        .collect();
    spans[0].ends[0][1] = None;
    let [mut mass, mut damping, mut stiffness] = [(); 3].map(|()| Matrix::zeros(16, 16));
    for k in 0..4 {
        mass[4 + k][4 + k] = if k % 2 == 0 { 12.0 } else { 0.04 };
    }
    (damping[5][7], damping[7][5]) = (0.07 * speed, -0.07 * speed);
    for station in [0, 8, 12] {
        for (i, j) in [(0, 0), (0, 2), (2, 0), (2, 2)] {
            let cross = if i == j { 1.0 } else { 0.2 };
            stiffness[station + i][station + j] = cross * random.between(1e7, 4e7);
            damping[station + i][station + j] = cross * random.between(0.0, 4e3);
        }
    }
    stiffness[1][1] = 1.0;
    stiffness[3][3] = 1.0;
    (spans, [mass, damping, stiffness])
}

#[test]
fn random_shafts_do_not_depend_on_the_elements() {
    for (seed, line) in (1..25).flat_map(|seed| [(seed, Line::Timoshenko), (seed, Line::Slender)]) {
        let coarse = modes(&random(seed, line, 2, 6), 5);
        let fine = modes(&random(seed, line, 8, if line == Line::Slender { 6 } else { 4 }), 5);
        for (coarse, fine) in coarse.iter().zip(&fine) {
            assert!((coarse.s - fine.s).norm() < 2e-8 * fine.s.norm(), "{seed} {line:?} {} {}", coarse.s, fine.s);
        }
    }
}

#[test]
fn forms_do_not_depend_on_what_stands_beside_them() {
    for line in [Line::Timoshenko, Line::Slender] {
        let assembly = random(3, line, 2, 5);
        let modes = modes(&assembly, 5);
        let pair = |(a, b): (&Mode, &Mode)| (a.left.clone(), b.s, b.right.clone());
        let all: Vec<_> = modes.iter().zip(modes.iter().rev()).map(pair).collect();
        let forms: Vec<Form<'_>> = all.iter().map(|(left, s, right)| Form { left, s: *s, right }).collect();
        let (gradients, inertia) = (assembly.gradients(&forms), assembly.inertia(&forms));
        for (k, form) in forms.iter().enumerate() {
            assert_eq!(assembly.gradients(&[*form])[0], gradients[k], "{line:?}");
            assert_eq!(assembly.inertia(&[*form])[0], inertia[k], "{line:?}");
        }
    }
}

#[test]
fn random_slopes_are_those_of_differences() {
    for (seed, line) in (1..9).flat_map(|seed| [(seed, Line::Timoshenko), (seed, Line::Slender)]) {
        let assembly = random(seed, line, 1, 5);
        let (_, matrices) = random_parts(seed, line, 1);
        let mode = modes(&assembly, 3).swap_remove(2);
        let slopes = assembly.slopes(&mode);
        let moved = |change: &dyn Fn(&mut Vec<Span>)| {
            let mut spans = assembly.spans().to_vec();
            change(&mut spans);
            Assembly::new(spans, matrices.clone(), 5).unwrap().refined(std::slice::from_ref(&mode))[0]
                .clone()
                .unwrap()
                .0
                .s
        };
        for (span, own) in slopes.iter().enumerate() {
            for (section, own) in own.sections.iter().enumerate() {
                for number in Number::ALL {
                    let value = assembly.spans()[span].sections[section].0.number(number);
                    let step = 3e-3 * value.abs();
                    let at =
                        |step: f64| moved(&|spans| *spans[span].sections[section].0.number_mut(number) = value + step);
                    let difference =
                        (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step);
                    let found = own[number as usize];
                    let size = mode.s.norm() / value.abs();
                    assert!(
                        (found - difference).norm() < 1e-9 * size,
                        "{seed} {line:?} {number:?} {found} {difference}"
                    );
                }
            }
            let step = 0.05;
            let at = |step: f64| moved(&|spans| spans[span].speed += step);
            let difference = (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step);
            assert!((own.speed - difference).norm() < 1e-9 * mode.s.norm(), "{seed} {} {difference}", own.speed);
        }
    }
}

#[test]
fn what_is_wrong_is_said() {
    let section = Section { length: 1.0, stiffness: 1.0, shear: 1.0, mass: 1.0, ..NONE };
    let ends = [[Some((0, 1.0)), None, None, None], [None; 4]];
    let span = Span { line: Line::Timoshenko, speed: 0.0, sections: vec![(section, 1)], ends };
    let one = || [(); 3].map(|()| Matrix::zeros(1, 1));
    let said = |span: Span, degree: usize| Assembly::new(vec![span], one(), degree).unwrap_err().to_string();
    assert!(said(span.clone(), 40).contains("degree 1 to 12, not 40"));
    let mut own = span.clone();
    own.ends[1][2] = Some((7, 1.0));
    assert!(said(own, 4).contains("beyond the 1 of the stations"));
    let mut own = span.clone();
    own.sections[0].0.shear = 0.0;
    assert!(said(own, 4).contains("Shear of section 0 of span 0 is 0"));
    let mut own = span.clone();
    own.sections[0].0.lag = f64::NAN;
    assert!(said(own, 4).contains("Lag of section 0 of span 0 is NaN"));
    let mut own = span.clone();
    own.sections[0].1 = 0;
    assert!(said(own, 4).contains("divided into no element"));
    let held = Span { ends: [[None; 4]; 2], ..span.clone() };
    let none = [(); 3].map(|()| Matrix::zeros(0, 0));
    assert!(Assembly::new(vec![held], none, 4).unwrap_err().to_string().contains("one unknown at least"));
    let wide = [Matrix::zeros(1, 1), Matrix::zeros(2, 2), Matrix::zeros(1, 1)];
    assert!(Assembly::new(vec![span], wide, 4).unwrap_err().to_string().contains("the same size"));
}

/// A free shaft that bends and stretches, with a spring aslant at its end that joins both: frequencies of free ends are those of
/// held ones, next to which the spans resist without bound.
#[test]
fn lines_that_hardly_meet_hide_no_modes() {
    let (length, radius) = (1.0, 0.025_f64);
    let area = PI * radius * radius;
    let (modulus, density) = (205e9, 7850.0);
    let inertia = area * radius * radius / 4.0;
    let bends = Section {
        length,
        stiffness: modulus * inertia,
        shear: 0.88 * modulus / 2.6 * area,
        mass: density * area,
        rotary: density * inertia,
        ..NONE
    };
    let stretches = Section { length, stiffness: modulus * area, mass: density * area, ..NONE };
    let end = |k: usize| -> [Place; 4] { [2, 3, 4, 5].map(|own| Some((own + 4 * k, 1.0))) };
    let bar = |k: usize| -> [Place; 4] { [Some((k, 1.0)), None, None, None] };
    let spans = vec![
        Span { line: Line::Bar, speed: 0.0, sections: vec![(stretches, 24)], ends: [bar(0), bar(1)] },
        Span { line: Line::Timoshenko, speed: 100.0, sections: vec![(bends, 24)], ends: [end(0), end(1)] },
    ];
    for power in -4..9 {
        for draw in 0..4 {
            let k = 10_f64.powf(f64::from(power) + 0.25 * f64::from(draw));
            let slant = [0.6, 0.64, 0.48];
            let place = |i: usize| [Some(0), None, Some(1), None, Some(2)].get(i).copied().flatten();
            let stiffness = Matrix::from_fn(10, 10, |i, j| match (place(i), place(j)) {
                (Some(a), Some(b)) => k * slant[a] * slant[b],
                _ => 0.0,
            });
            let zero = Matrix::zeros(10, 10);
            let assembly = Assembly::new(spans.clone(), [zero.clone(), zero, stiffness], 4).unwrap();
            let found = modes(&assembly, if power < 7 { 12 } else { 16 });
            let (low, high) = (800.0, 17_000.0);
            let count = assembly.count_within(Complex::new(-60.0, low), Complex::new(60.0, high)).unwrap();
            let within: Vec<_> = found.iter().map(|mode| mode.s).filter(|s| s.im > low && s.im < high).collect();
            assert_eq!(count, within.len(), "{k:e}: {within:?}");
            assert!(within.iter().all(|s| s.re.abs() < 1e-6), "{k:e}: {within:?}");
        }
    }
}

/// Bars on which nothing acts, of several lengths side by side and in rows of equal and of unequal parts: frequencies of free ends,
/// and their derivatives by the length, to six digits next to poles of all spans.
#[test]
fn free_bars() {
    let speed = 5000.0_f64;
    for lengths in [vec![1.0], vec![0.5, 0.5], vec![0.25, 0.75], vec![0.2, 0.3, 0.5], vec![0.31, 0.69]] {
        for tails in [[1.0, 1.0, 1.0], [1.0, 0.93, 1.07], [1.0, 1.0 + 1e-9, 2.0]] {
            let mut spans = Vec::new();
            let mut unknown = 0;
            for tail in tails {
                for length in &lengths {
                    let section = Section { length: tail * length, stiffness: speed * speed * 3.0, mass: 3.0, ..NONE };
                    let elements = (24.0 * length).ceil() as usize;
                    let end = |k: usize| -> [Place; 4] { [Some((k, 1.0)), None, None, None] };
                    let ends = [end(unknown), end(unknown + 1)];
                    spans.push(Span { line: Line::Bar, speed: 0.0, sections: vec![(section, elements)], ends });
                    unknown += 1;
                }
                unknown += 1;
            }
            let zero = Matrix::zeros(unknown, unknown);
            let assembly = Assembly::new(spans, [zero.clone(), zero.clone(), zero], 4).unwrap();
            let found = modes(&assembly, 9);
            let mut exact: Vec<f64> =
                tails.iter().flat_map(|tail| (1..12).map(move |k| PI * f64::from(k) * speed / tail)).collect();
            exact.sort_by(f64::total_cmp);
            assert_eq!(found.len(), 9, "{lengths:?} {tails:?}");
            for (mode, exact) in found.iter().zip(exact) {
                let what = format!("{lengths:?} {tails:?}");
                close(mode.s.im, exact, exact, 1e-8, &what);
                close(mode.s.re, 0.0, exact, 1e-8, &what);
                // Of all lengths together.
                let slopes = assembly.slopes(mode);
                let scaled = slopes
                    .iter()
                    .zip(assembly.spans())
                    .map(|(own, span)| own.sections[0][Number::Length as usize] * span.sections[0].0.length);
                close(scaled.sum::<Complex>().im, -exact, exact, 1e-5, &what);
            }
        }
    }
}

/// Quarter waves of overhanging ends are a half wave between the heavy disks that they hang over, which hardly move: steps
/// from elsewhere creep past the pole there, and end at no mode.
#[test]
fn ends_that_hang_over_heavy_disks() {
    for (inertias, length) in [([0.079, 0.0095], 0.2), ([0.5, 0.5], 0.3), ([0.02, 3.0], 0.1), ([10.0, 0.2], 0.25)] {
        let polar = PI * 0.088_f64.powi(4) / 32.0;
        let section = Section { length, stiffness: 205e9 / 2.6 * polar, mass: 7850.0 * polar, ..NONE };
        let end = |k: usize| -> [Place; 4] { [Some((k, 1.0)), None, None, None] };
        let span = |k: usize, rows: usize| Span {
            line: Line::Bar,
            speed: 0.0,
            sections: vec![(section, 7); rows],
            ends: [end(k), end(k + 1)],
        };
        let mut mass = Matrix::zeros(4, 4);
        (mass[1][1], mass[2][2]) = (inertias[0], inertias[1]);
        let zero = Matrix::zeros(4, 4);
        let spans = vec![span(0, 1), span(1, 2), span(2, 1)];
        let assembly = Assembly::new(spans, [mass, zero.clone(), zero], 4).unwrap();
        let found = modes(&assembly, 12);
        let greatest = found.iter().map(|mode| mode.s.im).fold(0.0, f64::max);
        let (low, high) = (Complex::new(-500.0, 500.0), Complex::new(500.0, greatest * (1.0 - 1e-5)));
        let count = assembly.count_within(low, high).unwrap();
        let within: Vec<f64> = found.iter().map(|mode| mode.s.im).filter(|s| (low.im..high.im).contains(s)).collect();
        assert_eq!(count, within.len(), "{inertias:?}: {within:?}");
    }
}
