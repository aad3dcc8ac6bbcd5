//! Jeffcott's rotor with internal damping, and a tilting disk.

use eigentol::modes::Sense;
use eigentol::sweep::Event;
use eigentol::{Behaviour, Complex, Stability, Study};
use eigentol_tests::machines::{JeffcottRotor, OverhungRotor};

use super::common::{close, design, event, near};

type Rotor = Study<JeffcottRotor>;

fn rotor() -> Rotor {
    Study::new(JeffcottRotor)
}

/// Both roots of `m s^2 + (c_e + c_i) s + k - i W c_i = 0` for `z = x + i y`: the forward one (positive imaginary part)
/// and the backward one.
fn roots([m, k, external, internal]: [f64; 4], speed: f64) -> (Complex, Complex) {
    let b = Complex::from(external + internal);
    let root = (b * b - 4.0 * m * Complex::new(k, -speed * internal)).sqrt();
    let (one, other) = ((root - b) / (2.0 * m), (-root - b) / (2.0 * m));
    if one.im > 0.0 { (one, other) } else { (other, one) }
}

fn onset([m, k, external, internal]: [f64; 4]) -> f64 {
    (k / m).sqrt() * (1.0 + external / internal)
}

#[test]
fn whirl_forward_and_backward() {
    let design = design(&rotor());
    for share in [0.1, 0.7, 0.99, 1.01, 2.0] {
        let speed = share * onset(design);
        let study = rotor().input(JeffcottRotor::speed, speed);
        let found = study.modes().expect("modes");
        let whirls = study.whirls().expect("whirls");
        let (forward, backward) = roots(design, speed);
        assert_eq!(found.modes.len(), 2);
        for (mode, whirl) in found.modes.iter().zip(whirls.iter()) {
            let whirl = whirl.expect("it circles");
            match whirl.sense() {
                Some(Sense::Forward) => near(mode.s, forward),
                Some(Sense::Backward) => near(mode.s, backward.conj()),
                Some(Sense::Planar) | None => panic!("{whirl:?}"),
            }
            close(whirl.ratio.expect("it circles").abs(), 1.0);
        }
        let growing = found.modes.iter().filter(|mode| mode.s.re > 0.0).count();
        assert_eq!(growing, usize::from(share > 1.0));
        let expected = match growing {
            0 => Stability::Stable,
            growing => Stability::Flutter { growing },
        };
        assert_eq!(study.equilibrium().expect("one").stability, expected);
    }
}

/// Internal damping excites forward whirl beyond `sqrt(k / m) (1 + c_e / c_i)`.
#[test]
fn onset_of_instability_by_internal_damping() {
    let study = rotor();
    let design = design(&study);
    let [m, k, external, internal] = design;
    let expected = onset(design);
    let slopes = [
        -0.5 * expected / m,
        0.5 * expected / k,
        (k / m).sqrt() / internal,
        -(k / m).sqrt() * external / (internal * internal),
    ];
    let tolerances = study.tolerances().expect("declared");
    let found = study.flutter_onset_tolerances(JeffcottRotor::speed, 1.0, 2.0 * expected).expect("a search");
    let [only] = &found[..] else { panic!("{found:?}") };
    event(only, expected, &slopes, &design, tolerances.half_widths());
    // Slightly above the onset, samples lie on both sides; their shares follow from the standard deviation of the
    // onset.
    let sigma = only.sigma().expect("a spread");
    let run = study.clone().input(JeffcottRotor::speed, expected + sigma).samples(4000).monte_carlo().expect("samples");
    let share = run.counts.flutter as f64 / 4000.0;
    assert_eq!(run.counts.flutter + run.counts.stable, 4000);
    assert!((share - 0.8413).abs() < 0.03, "{share}");
}

/// The forward frequency meets the speed: with damping, not exactly at `sqrt(k / m)`.
#[test]
fn synchronous_critical_speed() {
    let study = rotor();
    let design = design(&study);
    let excess = |speed: f64| roots(design, speed).0.im - speed;
    let (mut low, mut high) = (70.0, 90.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        match excess(middle) > 0.0 {
            true => low = middle,
            false => high = middle,
        }
    }
    let found = study.crossing_tolerances(JeffcottRotor::speed, 40.0, 120.0, 1.0).expect("a search");
    // The forward whirl frequency crosses from below at its damped value; the backward frequency crosses as well.
    assert_eq!(found.len(), 2);
    let forward = found.iter().min_by(|a, b| (a.value - low).abs().total_cmp(&(b.value - low).abs())).expect("two");
    close(forward.value, low);
}

type Disk = Study<OverhungRotor>;

fn disk() -> Disk {
    Study::new(OverhungRotor)
}

#[test]
fn conical_whirl_and_its_critical_speeds() {
    let study = disk();
    let [it, ip, k] = design(&study);
    for speed in [1.0, 50.0, 120.0, 400.0] {
        let at = study.clone().input(OverhungRotor::speed, speed);
        let found = at.modes().expect("modes");
        let half = 0.5 * speed * ip / it;
        let root = (half * half + k / it).sqrt();
        for (mode, (omega, sense)) in
            found.modes.iter().zip([(root - half, Sense::Backward), (root + half, Sense::Forward)])
        {
            near(mode.s, Complex::new(0.0, omega));
            assert_eq!(mode.behaviour, Behaviour::Oscillating(mode.s.im));
            let whirls = at.whirls().expect("whirls");
            let whirl = whirls[usize::from(sense == Sense::Forward)];
            assert_eq!(whirl.expect("it circles").sense(), Some(sense));
        }
    }
    let tolerances = study.tolerances().expect("declared");
    let found = study.crossing_tolerances(OverhungRotor::speed, 10.0, 300.0, 1.0).expect("a search");
    let [backward, forward] = &found[..] else { panic!("{found:?}") };
    // W^2 (It + Ip) = k backward, W^2 (It - Ip) = k forward.
    for (crossing, sign) in [(backward, 1.0), (forward, -1.0)] {
        let inertia = it + sign * ip;
        let speed = (k / inertia).sqrt();
        let slopes = [-0.5 * speed / inertia, -0.5 * sign * speed / inertia, 0.5 * speed / k];
        event(crossing, speed, &slopes, study.design_values(), tolerances.half_widths());
        assert!(matches!(crossing.event, Event::Crossing { .. }));
    }
}

/// The same disk in a Campbell diagram, with second order and four engine orders.
#[test]
fn the_campbell_diagram_of_the_disk() {
    let study = disk();
    let [it, ip, k] = design(&study);
    let values: Vec<f64> = (0..=40).map(|step| 10.0 * f64::from(step)).collect();
    let diagram = study.campbell(OverhungRotor::speed, &values, &[1.0, 2.0]).expect("a diagram");
    assert_eq!(diagram.labels(), [0, 1]);
    assert!(diagram.flutter_onsets.is_empty());
    for label in diagram.labels() {
        let branch: Vec<_> = diagram.branch(label).collect();
        assert_eq!(branch.len(), values.len());
        // The whirl sense is constant along the whole branch, from the first speed on.
        let senses: Vec<Sense> = branch.iter().filter_map(|(_, mode)| mode.whirl?.sense()).collect();
        assert_eq!(senses.len(), values.len() - 1);
        assert!(senses.iter().all(|sense| sense == &senses[0]));
        let sign = if senses[0] == Sense::Forward { 1.0 } else { -1.0 };
        for (speed, mode) in &branch[1..] {
            let half = 0.5 * speed * ip / it;
            let root = (half * half + k / it).sqrt();
            let spread = mode.frequency.as_ref().expect("it oscillates");
            close(spread.mean, root + sign * half);
            let by_k = 0.5 / (it * root);
            let by_ip = sign * 0.5 * speed / it + 0.5 * half * speed / (it * root);
            let by_it = -(half * half + 0.5 * k / it) / (it * root) - sign * half / it;
            let widths = study.tolerances().expect("declared");
            close(spread.sigma, widths.sigma(&[by_it, by_ip, by_k]));
        }
    }
    // Orders 1 and 2: W_n^2 (n^2 It +- n Ip) = k; the forward frequency meets n W only if n It > Ip.
    let expected = [
        (k / (it + ip)).sqrt(),
        (k / (it - ip)).sqrt(),
        (k / (4.0 * it + 2.0 * ip)).sqrt(),
        (k / (4.0 * it - 2.0 * ip)).sqrt(),
    ];
    // In isotropic bearings an unbalance does not excite backward whirl.
    let [backward] = &diagram.not_excited[..] else { panic!("{:?}", diagram.not_excited) };
    assert!((backward.value - expected[0]).abs() < 1e-9 * expected[0]);
    let said = "1 crossing is left out, of modes that no unbalance excites";
    assert!(diagram.to_string().contains(said));
    let diagram = diagram.with_all_crossings();
    assert_eq!(diagram.crossings.len(), 4);
    for speed in expected {
        let off = |value: f64| (value - speed).abs();
        let least = diagram.crossings.iter().map(|one| off(one.value));
        assert!(least.fold(f64::INFINITY, f64::min) < 1e-9 * speed);
    }
    let text = diagram.to_string();
    for part in ["Campbell", "forward", "backward", "crosses 2x speed"] {
        assert!(text.contains(part), "{part}: {text}");
    }
}
