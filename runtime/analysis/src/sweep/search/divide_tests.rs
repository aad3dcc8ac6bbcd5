//! Families of oscillators with known events.

use std::rc::Rc;

use super::super::count::{Kind, Wanted};
use super::super::spectrum::{Root, Spectrum};
use super::{Division, Interval, States, divide};
use crate::Complex;
use crate::sweep::condition::Line;

/// Value and slope.
type Jet = [f64; 2];

fn product(factors: &[(f64, f64)], amount: f64, u: f64) -> Jet {
    factors.iter().fold([amount, 0.0], |[v, d], (a, b)| {
        let (factor, rate) = ((u - a) * (u - b), 2.0 * u - a - b);
        [v * factor, d * factor + v * rate]
    })
}

/// The roots of `s^2 + c s + k`.
fn oscillator(c: Jet, k: Jet, roots: &mut Vec<Root>) {
    let inside = Complex::from(0.25 * c[0] * c[0] - k[0]).sqrt();
    let mut add = |value: Complex| {
        let slope = -(value * c[1] + k[1]) / (2.0 * value + c[0]);
        let error = 1e-14 * (1.0 + value.norm());
        roots.push(Root { value, slope, error, paired: value.im > 0.0, neutral: false, grows: value.re > error });
    };
    let middle = Complex::from(-0.5 * c[0]);
    if inside.im > 0.0 {
        add(middle + inside);
    } else {
        add(middle - inside);
        add(middle + inside);
    }
}

struct Family<F> {
    roots: F,
    count: usize,
    ends: [f64; 2],
    solved: Vec<Rc<Spectrum>>,
}

impl<F: Fn(f64) -> (Vec<Root>, Vec<Root>)> States for Family<F> {
    fn state(&mut self, t: f64) -> Option<Rc<Spectrum>> {
        if let Some(known) = self.solved.iter().find(|state| state.t == t) {
            return Some(known.clone());
        }
        self.count += 1;
        let [low, high] = self.ends;
        let u = low + (high - low) * t;
        let (mut roots, mut stiffness) = (self.roots)(u);
        for root in roots.iter_mut().chain(&mut stiffness) {
            root.slope *= high - low;
        }
        let finite = roots.iter().all(|root| root.slope.is_finite());
        let state = Rc::new(Spectrum { t, input: [u, high - low], roots, stiffness });
        self.solved.push(state.clone());
        self.solved.sort_by(|a, b| a.t.total_cmp(&b.t));
        (finite && self.count < 2000).then_some(state)
    }

    fn all(&self) -> Vec<Rc<Spectrum>> {
        self.solved.clone()
    }
}

/// Kind, whether more count behind it, and place.
type FoundEvent = (Kind, Option<bool>, f64);

/// The events from one value to another, in `steps` steps, and the number of states.
fn search(
    roots: impl Fn(f64) -> (Vec<Root>, Vec<Root>),
    wanted: &Wanted,
    [low, high]: [f64; 2],
    steps: usize,
) -> (Vec<FoundEvent>, Division, usize) {
    let (mut events, mut states) = (Vec::new(), 0);
    let mut all = Division::default();
    for step in 0..steps {
        let at = |k: usize| low + (high - low) * k as f64 / steps as f64;
        let ends = [at(step), at(step + 1)];
        let mut family = Family { roots: &roots, count: 0, ends, solved: Vec::new() };
        let interval = Interval {
            ends: [0.0, 1.0].map(|t| family.state(t).expect("a state")),
            outer: [step == 0, step + 1 == steps],
        };
        let findings = divide(&mut family, wanted, interval, 1e-9);
        for event in findings.events.iter().filter(|event| !event.turns(wanted)) {
            let at = ends[0] + (ends[1] - ends[0]) * event.t;
            events.push((event.kind, event.rises, at));
        }
        all.doubts.extend(findings.doubts);
        states += family.count - usize::from(step > 0);
    }
    events.sort_by(|a, b| a.2.total_cmp(&b.2));
    (events, all, states)
}

fn rises(event: &FoundEvent, expected: &Option<bool>) -> bool {
    event.1 == *expected
}

/// Without a doubt, the events are those expected, each so many times and as near.
fn agree<T: std::fmt::Debug>(
    (events, all): (&[FoundEvent], &Division),
    expected: &[(T, f64)],
    (number, error): (usize, f64),
    is: impl Fn(&FoundEvent, &T) -> bool,
    what: &str,
) {
    assert_eq!(all.doubts, [], "{what} {events:?}");
    let both = format!("{what}\n{events:?}\n{expected:?}");
    assert_eq!(events.len(), number * expected.len(), "{both}");
    for (kind, u) in expected {
        let near = |event: &&FoundEvent| is(event, kind) && (event.2 - u).abs() <= error;
        assert!(events.iter().filter(near).count() >= number, "{both}");
    }
}

fn general() -> Wanted {
    Wanted { lines: Vec::new(), growth: true, critical: true, undamped: false, symmetric: false, conservative: false }
}

struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

/// Oscillators whose damping and stiffness are products of quadratics.
#[test]
fn onsets_and_ends_of_random_oscillators() {
    let mut random = Random(7);
    let mut most = 0;
    for case in 0..400 {
        let machines: Vec<_> = (0..1 + case % 3)
            .map(|_| {
                let width = 10_f64.powf(random.between(-4.0, -0.5));
                let a = random.between(0.05, 0.9);
                let b = random.between(0.05, 0.9);
                (
                    vec![(a, a + width)],
                    10_f64.powf(random.between(-3.0, 0.5)),
                    if random.next() < 0.5 { vec![(b, b + 0.5 * width)] } else { vec![] },
                    10_f64.powf(random.between(0.0, 2.0)),
                )
            })
            .collect();
        let roots = |u: f64| {
            let mut roots = Vec::new();
            for (c, amount, k, stiff) in &machines {
                oscillator(product(c, *amount, u), product(k, *stiff, u), &mut roots);
            }
            (roots, Vec::new())
        };
        let mut expected = Vec::new();
        for (c, _, k, stiff) in &machines {
            for &(a, b) in k {
                expected.extend([a, b].map(|u| (Kind::Critical, u)));
            }
            for &(a, b) in c {
                for u in [a, b] {
                    if product(k, *stiff, u)[0] > 0.0 {
                        expected.push((Kind::Growth, u));
                    }
                }
            }
        }
        expected.retain(|event| event.1 <= 1.0);
        expected.sort_by(|a, b| a.1.total_cmp(&b.1));
        let mut last = 0;
        for steps in [16, 11] {
            let (events, all, states) = search(roots, &general(), [0.0, 1.0], steps);
            let is = |event: &FoundEvent, kind: &Kind| event.0 == *kind;
            let what = format!("{case} {steps} {machines:?}");
            agree((&events, &all), &expected, (1, 1e-9), is, &what);
            last = states;
        }
        most = most.max(last);
    }
    println!("{most} states at most");
}

/// Two modes without damping of their own whose frequencies pass each other, coupled by forces without a potential:
/// `lambda = mean +- sqrt(slope^2 (u - place)^2 - coupling)`; both lose `2 delta s`.
fn passing((mean, slope, centre): (f64, f64, f64), coupling: f64, delta: f64, u: f64, roots: &mut Vec<Root>) {
    let x = u - centre;
    let inside = slope * slope * x * x - coupling;
    let root = Complex::from(inside).sqrt();
    let rate = slope * slope * x / root;
    for sign in [1.0, -1.0] {
        let (lambda, change) = (mean + sign * root, sign * rate);
        let distance = (delta * delta - lambda).sqrt();
        let distance = if distance.im < 0.0 { -distance } else { distance };
        let value = distance - delta;
        let error = 1e-15 * mean.sqrt() * (2.0 + coupling.sqrt() / (root.norm() + 1e-8 * coupling.sqrt() + 1e-300));
        roots.push(Root {
            value,
            slope: -change / (2.0 * distance),
            error,
            paired: true,
            neutral: false,
            grows: value.re > error,
        });
    }
}

#[test]
fn bands_in_which_two_modes_merge() {
    let mut random = Random(11);
    let (mut most, mut sum) = (0, 0);
    for case in 0..600 {
        let pairs: Vec<_> = (0..1 + case % 3)
            .map(|k| {
                let mean = random.between(0.5, 1.5) + 10.0 * k as f64;
                let slope = random.between(0.1, 0.4);
                let width = 10_f64.powf(random.between(-5.0, -1.0));
                let centre = random.between(0.15, 0.85);
                // None, one that excludes growth, and one that does not.
                let delta = [0.0, 0.6, 0.3, 1e-7][case % 4] * width * slope / mean.sqrt();
                let coupling = if case % 5 == 4 { 0.0 } else { (width * slope).powi(2) };
                ((mean, slope, centre), coupling, delta)
            })
            .collect();
        let roots = |u: f64| {
            let mut roots = Vec::new();
            for &(line, coupling, delta) in &pairs {
                passing(line, coupling, delta, u, &mut roots);
            }
            (roots, Vec::new())
        };
        let mut expected = Vec::new();
        for &((mean, slope, centre), coupling, delta) in &pairs {
            let left = coupling - 4.0 * delta * delta * mean;
            if left > 0.0 {
                let half = left.sqrt() / slope;
                expected.extend([(Some(true), centre - half), (Some(false), centre + half)]);
            }
        }
        let mut last = 0;
        for steps in [16, 13] {
            let (events, all, states) = search(roots, &general(), [0.0, 1.0], steps);
            let what = format!("{case} {steps} {pairs:?}");
            agree((&events, &all), &expected, (1, 1e-8), rises, &what);
            last = states;
        }
        most = most.max(last);
        sum += last;
    }
    println!("{most} states at most, {} on average", sum / 600);
}

/// `lambda = L^2 + amount (u - a) (u - b)` for a line `L`, alone or twice; frequencies damped or not.
#[test]
fn every_crossing_of_a_line_also_of_equal_machines() {
    let mut random = Random(3);
    let mut most = 0;
    for case in 0..300 {
        let line = Line { ratio: random.between(-1.0, 2.0), offset: random.between(2.0, 3.0) };
        let width = match case % 3 {
            0 => 0.0,
            _ => 10_f64.powf(random.between(-5.0, -0.3)),
        };
        let a = random.between(0.05, 0.95);
        let amount = random.between(0.5, 2.0) * if case % 2 == 0 { 1.0 } else { -1.0 };
        let twice = case % 4 == 1;
        let undamped = case % 5 < 2;
        let roots = |u: f64| {
            let [square, rate] = product(&[(a, a + width)], amount, u);
            let level = line.ratio * u + line.offset;
            let lambda = [level * level + square, 2.0 * level * line.ratio + rate];
            let mut roots = Vec::new();
            for _ in 0..1 + usize::from(twice) {
                if undamped {
                    roots.push(Root {
                        value: lambda[0].into(),
                        slope: lambda[1].into(),
                        error: 1e-14 * lambda[0],
                        paired: false,
                        neutral: false,
                        grows: false,
                    });
                } else {
                    // s = -0.1 + i sqrt(lambda)
                    oscillator([0.2, 0.0], [lambda[0] + 0.01, lambda[1]], &mut roots);
                }
            }
            (roots, Vec::new())
        };
        let wanted = Wanted { lines: vec![line], undamped, symmetric: undamped, ..general() };
        let mut expected = match width {
            0.0 => vec![(None, a)],
            _ => {
                let passages = match amount > 0.0 {
                    true => [Some(false), Some(true)],
                    false => [Some(true), Some(false)],
                };
                vec![(passages[0], a), (passages[1], a + width)]
            }
        };
        expected.retain(|event| event.1 <= 1.0);
        for steps in [16, 7] {
            let (events, all, states) = search(roots, &wanted, [0.0, 1.0], steps);
            let number = if twice { 2 } else { 1 };
            let what = format!("{case} {steps}");
            agree((&events, &all), &expected, (number, 1e-6), rises, &what);
            most = most.max(states);
        }
    }
    println!("{most} states at most");
}

/// Two masses coupled by forces without a potential flutter between `2 -+ sqrt(1/4 - 10 c^2)`; a third one on its own
/// passes them anywhere. The list is that of every range and every number of steps.
#[test]
fn bands_beside_a_third_mode() {
    let mut most = 0;
    for case in 0..120 {
        let c = [0.0, 0.0001, 0.001, 0.02, 0.1, 0.158][case % 6];
        let slope = [0.0, 0.3, -0.3, 1.0, -1.0, 3.0, -3.0, 0.01, 20.0, -20.0][case % 10];
        let roots = |u: f64| {
            let mut roots = Vec::new();
            passing((10.0, 1.0, 2.0), 0.25, 0.5 * c, u, &mut roots);
            oscillator([c, 0.0], [10.0 + slope * (u - 2.0), slope], &mut roots);
            (roots, Vec::new())
        };
        let half = (0.25 - 10.0 * c * c).sqrt();
        let expected = [(Some(true), 2.0 - half), (Some(false), 2.0 + half)];
        let ends = [[0.01, 4.0], [1.21, 2.9], [0.3, 2.2], [1.81, 3.3], [1.9, 2.1]][case % 5];
        let inside = |event: &&(Option<bool>, f64)| event.1 > ends[0] && event.1 < ends[1];
        let expected: Vec<_> = expected.iter().filter(inside).copied().collect();
        for steps in [1, 2, 3, 5, 10, 11, 16] {
            let wanted = Wanted { critical: slope.abs() < 2.0, ..general() };
            let (events, all, states) = search(roots, &wanted, ends, steps);
            let of_growth = events.into_iter().filter(|event| event.0 == Kind::Growth);
            let events: Vec<_> = of_growth.collect();
            let what = format!("{c} {slope} {ends:?} {steps}");
            agree((&events, &all), &expected, (1, 1e-7), rises, &what);
            most = most.max(states);
        }
    }
    println!("{most} states at most");
}

/// Disks on shafts: `s^2 -+ i g u s + w^2 = 0` meets the line `r u` at `w / sqrt(r^2 -+ g r)`.
#[test]
fn critical_speeds_of_rotors() {
    let mut random = Random(5);
    for case in 0..100 {
        let disks: Vec<[f64; 2]> =
            (0..1 + case % 3).map(|_| [random.between(1.0, 6.0), random.between(0.0, 1.6)]).collect();
        let lines: Vec<Line> = [1.0, 2.0, 0.5].map(Line::from).to_vec();
        let roots = |u: f64| {
            let mut roots = Vec::new();
            for [w, g] in &disks {
                let (half, rate) = (0.5 * g * u, 0.5 * g);
                let root = (w * w + half * half).sqrt();
                for sign in [1.0, -1.0] {
                    roots.push(Root {
                        value: Complex::new(-0.01, root + sign * half),
                        slope: Complex::new(0.0, half * rate / root + sign * rate),
                        error: 1e-14 * root,
                        paired: true,
                        neutral: false,
                        grows: false,
                    });
                }
            }
            (roots, Vec::new())
        };
        let mut expected = Vec::new();
        for (k, line) in lines.iter().enumerate() {
            for [w, g] in &disks {
                for sign in [1.0, -1.0] {
                    let r = line.ratio;
                    let at = w / (r * r - sign * g * r).sqrt();
                    if at < 5.0 {
                        expected.push((Kind::Line(k), at));
                    }
                }
            }
        }
        expected.sort_by(|a, b| a.1.total_cmp(&b.1));
        let wanted = Wanted { lines, growth: false, critical: false, ..general() };
        for steps in [1, 4, 13] {
            let (events, all, _) = search(roots, &wanted, [0.0, 5.0], steps);
            let is = |event: &FoundEvent, kind: &Kind| event.0 == *kind;
            agree((&events, &all), &expected, (1, 1e-8), is, &format!("{disks:?}"));
        }
    }
}
