//! Modes about unstable equilibria that the start names, against reference values (`U1`).

use eigentol::equilibrium::Note;
use eigentol::sensitivity::Quantity;
use eigentol::{Coordinate, Stability, Study};
use eigentol_interpreter::Interpreted;
use serde_json::Value;

use super::common::{close, designs, number, numbers, study, truth};

fn unstable(name: &str) -> Value {
    truth("U1_unstable")[name].clone()
}

/// Compares the growth rates of the modes that grow or decay without oscillation, the fastest growing first, with their
/// first and second derivatives by the design variables.
fn check(study: &Study<Interpreted>, truth: &Value, rates: usize) {
    let mut order: Vec<(f64, usize)> = Vec::new();
    let modes = study.modes().expect("modes").modes;
    for (r, mode) in modes.iter().enumerate() {
        if mode.s.im == 0.0 && mode.s.re != 0.0 {
            order.push((mode.s.re, r));
        }
    }
    order.sort_by(|a, b| b.0.total_cmp(&a.0));
    assert!(order.len() >= rates, "{modes:?}");
    let slopes = study.sensitivities().expect("derivatives");
    let info = study.description();
    for (k, (value, r)) in order.into_iter().take(rates).enumerate() {
        close(value, numbers(&truth["values"])[k], 1e-12, "growth");
        let first = slopes.modes[r].of(Quantity::Growth).expect("a growth");
        let second = study.mode_curvature(r).expect("second derivatives");
        let second = second.of(Quantity::Growth).expect("of a growth").by_design;
        for (i, a) in info.design.iter().enumerate() {
            let a = a.name.trim_end_matches('_');
            close(first.by_design[i], number(&truth["first"][a][k]), 1e-10, a);
            for (j, b) in info.design.iter().enumerate() {
                let pair = format!("{a} {}", b.name.trim_end_matches('_'));
                if let Some(values) = truth["hessian"].get(&pair) {
                    close(second[i][j], number(&values[k]), 1e-8, &pair);
                }
            }
        }
    }
}

const HALF_TURN: f64 = std::f64::consts::PI;

#[test]
fn an_inverted_rod() {
    let truth = unstable("inverted");
    let units = [("m", "kg"), ("l", "m"), ("c", "N*m*s/rad")];
    let text = format!(
        "mechanism Inverted {{
            {}
            gravity 9.81 m/s^2 along -z;
            body rod: rod(mass: m_, length: l_, along: -z);
            joint q: revolute(y) from ground to rod;
            force air: damper(on: q, damping: c_);
        }}",
        designs(&truth, &units)
    );
    let named = study(&text).start(Coordinate::new(0), HALF_TURN);
    let state = named.equilibrium().expect("upright");
    assert_eq!(state.stability, Stability::Divergent { negative: 1 });
    assert_eq!(state.notes, [Note::Stays]);
    check(&named, &truth, 2);
    // Nobody asks for the upright rod here.
    for elsewhere in [
        study(&text),
        study(&text).guess(Coordinate::new(0), HALF_TURN),
        study(&text).start(Coordinate::new(0), HALF_TURN - 0.01),
    ] {
        let state = elsewhere.equilibrium().expect("hanging");
        assert_eq!((state.stability, state.notes.len()), (Stability::Stable, 0));
    }
    let near = study(&text).start(Coordinate::new(0), HALF_TURN - 0.3).stay();
    let state = near.equilibrium().expect("upright");
    assert!(matches!(state.notes[..], [Note::Far { unknown: 0, distance }] if (distance - 0.3).abs() < 1e-9));
    check(&near, &truth, 2);
}

#[test]
fn a_pole_on_a_cart() {
    let truth = unstable("cartpole");
    let units = [("M", "kg"), ("m", "kg"), ("l", "m")];
    let text = format!(
        "mechanism CartPole {{
            {}
            gravity 9.81 m/s^2 along -z;
            body cart: point(mass: M_);
            body pole: rod(mass: m_, length: l_, along: -z);
            joint x: prismatic(x) from ground to cart;
            joint q: revolute(y) from cart to pole;
        }}",
        designs(&truth, &units)
    );
    let study = study(&text).start(Coordinate::new(0), 0.4).start(Coordinate::new(1), HALF_TURN);
    let state = study.equilibrium().expect("upright");
    assert_eq!(state.notes, [Note::Stays]);
    assert_eq!(state.coordinates[0], 0.4);
    check(&study, &truth, 1);
}

#[test]
fn a_middle_axis() {
    let truth = unstable("middle");
    let units = [("A", "kg*m^2"), ("B", "kg*m^2"), ("C", "kg*m^2"), ("omega", "rad/s")];
    let designs = designs(&truth, &units);
    let text = format!(
        "mechanism Middle {{
            {designs}
            body shaft: massless;
            body top: rigid(mass: 1 kg, inertia: [A_, C_, B_]);
            joint spin: revolute(z) from ground to shaft, driven at omega_;
            joint tilt: universal(a: x, b: y) from shaft to top;
        }}"
    );
    let named = study(&text).start(Coordinate::new(0), 0.0).start(Coordinate::new(1), 0.0);
    check(&named, &truth, 1);
}

#[test]
fn a_truss_between_its_folds() {
    let truth = unstable("truss");
    let units = [("b", "m"), ("h", "m"), ("k", "N/m"), ("m", "kg"), ("F", "N")];
    let text = format!(
        "mechanism Truss {{
            {}
            body apex: point(mass: m_);
            joint y: prismatic(z) from ground to apex;
            point left: ground at [-b_, 0, 0];
            point right: ground at [b_, 0, 0];
            point top: apex;
            force bar1: spring_damper(from: left, to: top, stiffness: k_, length: sqrt(b_^2 + h_^2));
            force bar2: spring_damper(from: right, to: top, stiffness: k_, length: sqrt(b_^2 + h_^2));
            force push: load(at: top, force: [0, 0, -F_]);
        }}",
        designs(&truth, &units)
    );
    let y = numbers(&truth["values"])[1];
    let near = study(&text).start(Coordinate::new(0), y + 1e-3).stay();
    check(&near, &truth, 1);
    let named = study(&text).start(Coordinate::new(0), y);
    check(&named, &truth, 1);
    let state = named.equilibrium().expect("between the folds");
    close(state.coordinates[0], y, 1e-12, "height");
    let shift = named.equilibrium_shift().expect("its shift");
    for (i, info) in named.description().design.iter().enumerate() {
        let name = info.name.trim_end_matches('_');
        let expected = number(&truth["first"][name][1]);
        close(shift.by_design[0][i], expected, 1e-10, name);
    }
}

/// Samples of an unstable equilibrium stay at it: their growth has the spread that its derivatives say.
#[test]
fn samples_stay_where_it_is_unstable() {
    let text = "mechanism Balancer {
        design l = 80 cm +/- 2%;
        design m = 300 g +/- 5%;
        gravity 9.81 m/s^2 along -z;
        body cart: point(mass: 1 kg);
        body pole: rod(mass: m, length: l, along: -z);
        joint x: prismatic(x) from ground to cart;
        joint q: revolute(y) from cart to pole;
        force rail: spring(on: x, stiffness: 30 N/m);
    }";
    let study = study(text).start(Coordinate::new(1), HALF_TURN).samples(4000).keep_samples(true);
    let state = study.equilibrium().expect("upright");
    assert_eq!(state.notes, [Note::Stays]);
    let spread = study.first_order().expect("a spread");
    let found = study.monte_carlo().expect("samples");
    assert_eq!((found.counts.divergent, found.counts.stable), (4000, 0));
    let rates: Vec<f64> = (found.all.iter().flatten()).map(|sample| sample.eigenvalues[0].expect("found").re).collect();
    let mean = rates.iter().sum::<f64>() / rates.len() as f64;
    let square = rates.iter().map(|rate| (rate - mean).powi(2)).sum::<f64>();
    let sigma = (square / (rates.len() - 1) as f64).sqrt();
    let growth = spread.modes[0].growth().expect("a growth");
    assert!((sigma / growth.sigma - 1.0).abs() < 0.04, "{sigma} {}", growth.sigma);
    let swing = spread.modes[1].frequency().expect("a frequency");
    let sampled = found.modes[1].as_ref().expect("statistics");
    assert_eq!(sampled.count, 4000);
    assert!((sampled.sigma.expect("a sigma") / swing.sigma - 1.0).abs() < 0.04);
    let summary = study.summary().expect("a summary");
    assert!(summary.trust[1].trusted(), "{summary}");
}
