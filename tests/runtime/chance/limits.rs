//! Other machines and other limits: growth, damping, stability, two variables, loops, against closed forms and plain
//! samples.

use eigentol::requirement::{EstimatedBy, Requirement};
use eigentol::response::Response;
use eigentol::{Mechanism, Quantity, Study, mechanism};

use super::oracle::{normal_between, upper};

mechanism! {
    mechanism Block {
        design k = 100.0 N/m;
        design c = 0.2 N*s/m;
        body block: point(mass: 1 kg);
        joint x: prismatic(x) from ground to block;
        force hold: spring(on: x, stiffness: k);
        force damp: damper(on: x, damping: c);
    }
}

mechanism! {
    mechanism TwoBars {
        input omega: rad/s;
        design l1 = 1.0 m;
        design l2 = 1.0 m;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: 3.0 kg, length: l1, along: -z);
        body bar2: rod(mass: 3.0 kg, length: l2, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
    }
}

mechanism! {
    /// A point mass on equal springs of a turntable: its two modes whirl.
    mechanism Turntable {
        input speed: rad/s;
        design kx = 1e4 N/m;
        design ky = 1e4 N/m;
        design m = 2.0 kg;
        body plate: massless;
        body slide: massless;
        body disc: point(mass: m);
        joint spin: revolute(z) from ground to plate, driven at speed;
        joint x: prismatic(x) from plate to slide;
        joint y: prismatic(y) from slide to disc;
        force bearing_x: spring(on: x, stiffness: kx);
        force bearing_y: spring(on: y, stiffness: ky);
    }
}

mechanism! {
    mechanism Mass {
        design k = 100.0 N/m;
        design m = 2.0 kg;
        body block: point(mass: m);
        joint x: prismatic(x) from ground to block;
        force hold: spring(on: x, stiffness: k);
    }
}

fn mode(mode: usize, quantity: Quantity) -> Response {
    Response::Mode { mode, quantity }
}

fn block() -> Study<Block> {
    Study::new(Block).sigma_level(1.0).tolerance(Block::c, 0.1)
}

/// `Re s = -c / 2`: growth and instability by the damping alone, which is normal.
#[test]
fn growth_has_a_value_on_both_sides_of_stability() {
    let exact = upper(2.0);
    let growth = mode(0, Quantity::Growth);
    for wanted in [
        Requirement::at_most(growth, 0.0),
        Requirement::at_least(mode(0, Quantity::DampingRatio), 0.0),
        Requirement::Stable,
    ] {
        let answer = block().probability(&[wanted]).unwrap();
        let own = &answer.each[0];
        assert!((own.value / exact - 1.0).abs() < 1e-5, "{answer}");
        let described = wanted != Requirement::Stable;
        assert_eq!(own.by == EstimatedBy::DesignPoint, described, "{answer}");
    }
    let found = block().reliability(&[Requirement::at_most(growth, 0.0)]).unwrap();
    assert!(found.verified(), "{found}");
}

/// Designs beyond critical damping have no frequency and tell nothing about a limit on it.
#[test]
fn what_has_no_frequency_is_told_apart() {
    // c = 20 is critical; the frequency sqrt(100 - c^2 / 4) is below 3 from c = 19.08 on.
    let study = Study::new(Block).design(Block::c, 19.0).sigma_level(1.0).tolerance(Block::c, 1.0);
    let wanted = [Requirement::at_least(mode(0, Quantity::Frequency), 3.0)];
    let limit = 2.0 * f64::sqrt(91.0);
    let answer = study.probability(&wanted).unwrap();
    let own = &answer.each[0];
    let exact = normal_between(limit - 19.0, 1.0);
    assert!((own.value / exact - 1.0).abs() < 1e-5, "{answer}");
    assert!((own.untold / upper(1.0) - 1.0).abs() < 1e-5, "{answer}");
    // The design point takes them for failures.
    let found = study.reliability(&wanted).unwrap();
    assert!(!found.verified(), "{found}");
}

/// Whatever is trusted agrees with many plain samples of the whole machine, two lengths varying, near the critical speed
/// and beyond it.
#[test]
fn two_bars_as_many_samples_find_them() {
    for (speed, tolerance) in [(2.6, 0.06), (2.75, 0.12)] {
        let study = Study::new(TwoBars)
            .input(TwoBars::omega, speed)
            .start(TwoBars::theta1, 1.0)
            .start(TwoBars::theta2, 1.2)
            .tolerance(TwoBars::l1, tolerance)
            .tolerance(TwoBars::l2, tolerance);
        let lowest = mode(0, Quantity::Frequency);
        let wanted =
            [Requirement::at_least(lowest, 0.4), Requirement::Outside { response: lowest, low: 0.6, high: 0.8 }];
        agrees(&study, &wanted);
    }
}

/// Equal bearings: at rest the two modes are equal, in rotation they whirl, and gyroscopic forces keep them apart.
#[test]
fn a_rotor_on_equal_bearings_as_many_samples_find_it() {
    for speed in [0.0, 20.0, 60.0] {
        let study = Study::new(Turntable)
            .input(Turntable::speed, speed)
            .tolerance(Turntable::kx, 1500.0)
            .tolerance(Turntable::ky, 1500.0)
            .tolerance(Turntable::m, 0.1);
        let frequencies = study.modes().unwrap().frequencies();
        let low = 0.96 * frequencies[0].unwrap();
        let wanted = [Requirement::at_least(mode(0, Quantity::Frequency), low)];
        agrees(&study, &wanted);
    }
}

/// Compares with 4000 plain samples of another seed.
fn agrees<M: Mechanism>(study: &Study<M>, wanted: &[Requirement]) {
    let run = study.clone().samples(4000).seed(99).chances(wanted).unwrap();
    let answer = study.probability(wanted).unwrap();
    let found = study.reliability(wanted).unwrap();
    let all = answer.each.iter().zip(&run.each);
    for (k, (own, tally)) in all.chain([(&answer.any, &run.all)]).enumerate() {
        let sampled = tally.clopper_pearson(0.9999).unwrap();
        assert!(own.interval.lower <= sampled.upper && sampled.lower <= own.interval.upper, "{k}\n{answer}{run}");
        assert!(own.interval.upper - own.interval.lower < 0.3 * own.value + 0.01, "{answer}");
    }
    for limit in found.limits.iter().filter(|limit| limit.verified()) {
        let sampled = run.each[limit.requirement].clopper_pearson(0.9999).unwrap();
        let claimed = limit.probability().unwrap();
        assert!(0.9 * claimed <= sampled.upper && sampled.lower <= 1.1 * claimed, "{found}{run}");
    }
}

/// A design without stiffness fails at both ends of a band and counts once.
#[test]
fn what_is_lost_fails_a_band_once() {
    let (k, by_k) = (100.0, 30.0);
    let study = Study::new(Mass).sigma_level(1.0).tolerance(Mass::k, by_k).tolerance(Mass::m, 1e-3);
    let middle = f64::sqrt(k / 2.0);
    let (low, high) = (0.3 * middle, 1.5 * middle);
    let exact = upper((k - 0.09 * k) / by_k) + upper((2.25 * k - k) / by_k);
    let wanted = Requirement::Within { response: mode(0, Quantity::Frequency), low, high };
    let answer = study.probability(&[wanted]).unwrap();
    let own = &answer.each[0];
    assert!((own.interval.lower..=1.01 * own.interval.upper).contains(&exact), "{exact}: {answer}");
    assert!((own.value / exact - 1.0).abs() < 0.2, "{exact}: {answer}");
}

/// `w < a` where `k < a^2 m`: a difference of normal numbers. Of a band both ends count, however rare.
#[test]
fn a_band_fails_at_either_end() {
    let (k, m, [by_k, by_m]) = (100.0, 2.0, [2.0, 0.02]);
    let study = Study::new(Mass).sigma_level(1.0).tolerance(Mass::k, by_k).tolerance(Mass::m, by_m);
    let middle = f64::sqrt(k / m);
    for (below, above) in [(0.005, 0.01), (0.02, 0.02), (0.03, 0.05), (0.06, 0.06), (0.07, 0.3)] {
        let [low, high] = [middle * (1.0 - below), middle * (1.0 + above)];
        let end = |w: f64| upper((k - w * w * m).abs() / by_k.hypot(w * w * by_m));
        let exact = end(low) + end(high);
        let wanted = Requirement::Within { response: mode(0, Quantity::Frequency), low, high };
        let answer = study.probability(&[wanted]).unwrap();
        let own = &answer.each[0];
        assert!((own.value / exact - 1.0).abs() < 0.08, "{exact}: {answer}");
        assert!((own.interval.lower..=own.interval.upper).contains(&exact), "{exact}: {answer}");
        assert!(own.interval.upper - own.interval.lower < 0.3 * exact, "{exact}: {answer}");
    }
}
