//! One judge in words: what distances say and what samples say do not contradict each other, each doubt stands on its
//! own mode, and nothing is advised that has nothing to say.

use eigentol::judge::Doubt;
use eigentol::requirement::Requirement;
use eigentol::response::Response;
use eigentol::{Error, Quantity, Study, mechanism};

use super::oracle::speed;

mechanism! {
    /// A spinning bar beside a stiff pendulum that has nothing to do with it.
    mechanism Pair {
        input omega: rad/s;
        design l = 1.0 m;
        design k = 300.0 N*m/rad;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: 3 kg, length: l, along: -z);
        body other: rod(mass: 3 kg, length: 1 m, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
        joint phi: revolute(y) from ground to other;
        force hold: spring(on: phi, stiffness: k);
    }
}

mechanism! {
    mechanism Overdamped {
        design c = 50.0 N*s/m;
        body block: point(mass: 1 kg);
        joint x: prismatic(x) from ground to block;
        force hold: spring(on: x, stiffness: 100 N/m);
        force damp: damper(on: x, damping: c);
    }
}

fn pair(ratio: f64, tolerance: f64) -> Study<Pair> {
    Study::new(Pair)
        .input(Pair::omega, speed(ratio))
        .start(Pair::theta, 1.0)
        .tolerance(Pair::l, tolerance)
        .tolerance(Pair::k, 3.0)
}

#[test]
fn doubts_stand_on_the_mode_they_belong_to() {
    let study = pair(1.03, 0.12);
    let first = study.first_order().unwrap();
    let [Doubt::NearCritical { distance }] = first.doubts(0)[..] else { panic!("{first}") };
    assert!((distance - 1.57).abs() < 0.01, "{distance}");
    assert!(first.modes[1].distance_to_critical > 100.0);
    let [Doubt::BranchNear { mode: 0, distance: other }] = first.doubts(1)[..] else { panic!("{first}") };
    assert_eq!(other, distance);
    let text = first.to_string();
    assert!(text.contains("mode 2: the critical state of mode 1 is 1.57 standard deviations away"), "{text}");
    let second = study.second_order().unwrap();
    assert_eq!(second.doubts, [first.doubts(0), first.doubts(1)]);
    assert!(second.to_string().contains("`summary` compares sigma with samples"));
    // Far from it there are none.
    let far = pair(0.5, 0.03);
    assert!(far.first_order().unwrap().trusted());
    assert!(far.second_order().unwrap().doubts.iter().all(Vec::is_empty));
}

/// Where samples find first order right, distances have not called it wrong.
#[test]
fn first_order_and_summary_do_not_contradict_each_other() {
    let mut trusted = 0;
    for ratio in [0.9, 0.97, 1.03, 1.1] {
        for tolerance in [0.03, 0.12, 0.2] {
            let study = pair(ratio, tolerance);
            let (first, summary) = (study.first_order().unwrap(), study.summary().unwrap());
            for (mode, trust) in summary.trust.iter().enumerate() {
                let certain = first.doubts(mode).iter().any(Doubt::certain);
                assert!(!(trust.trusted() && certain), "{first}{summary}");
                trusted += usize::from(trust.trusted());
            }
            let text = first.to_string();
            let never = summary.trusted() && text.contains("Not to be trusted");
            assert!(!never, "{first}{summary}");
            assert!(!text.contains("Monte Carlo"), "{text}");
        }
    }
    assert!(trusted > 10, "{trusted}");
}

#[test]
fn monte_carlo_is_not_advised_where_it_has_nothing_to_say() {
    // c = 20 would be critical damping.
    let study = Study::new(Overdamped).tolerance(Overdamped::c, 20.0).samples(500);
    let run = study.monte_carlo().unwrap().to_string();
    assert!(run.contains("no oscillation in any stable sample"), "{run}");
    let texts = [
        study.first_order().unwrap().to_string(),
        study.second_order().unwrap().to_string(),
        study.summary().unwrap().to_string(),
    ];
    for text in &texts {
        assert!(!text.contains("Monte Carlo"), "{text}");
        assert!(!text.contains("`summary` compares"), "{text}");
    }
    assert!(texts[0].contains("no oscillation, so there is no frequency to spread"));
}

#[test]
fn without_a_tolerance_nothing_is_called_a_spread() {
    let study = Study::new(Overdamped).design(Overdamped::c, 1.0).samples(300);
    let words = "No tolerance is declared";
    for text in [
        study.first_order().unwrap().to_string(),
        study.second_order().unwrap().to_string(),
        study.summary().unwrap().to_string(),
        study.monte_carlo().unwrap().to_string(),
    ] {
        assert!(text.contains(words), "{text}");
    }
    let frequency = Response::Mode { mode: 0, quantity: Quantity::Frequency };
    let wanted = [Requirement::at_least(frequency, 5.0)];
    assert!(study.chances(&wanted).unwrap().to_string().contains(words));
    let propagation = study.propagate(&[frequency]).unwrap();
    assert_eq!(propagation.reason, "no tolerance is declared");
    let Err(Error::Setting { setting, reason }) = study.probability(&wanted) else { panic!("it has an answer") };
    assert_eq!(setting, "tolerances");
    assert!(reason.contains("no tolerance is declared"), "{reason}");
    // A tolerance that moves nothing is another matter.
    let still = Study::new(Pair)
        .input(Pair::omega, 2.0)
        .start(Pair::theta, 0.1)
        .tolerance(Pair::l, 0.0)
        .tolerance(Pair::k, 1e-3);
    assert!(!still.first_order().unwrap().to_string().contains(words));
}
