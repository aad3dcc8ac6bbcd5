//! Real eigenvalues: overdamped motions, rigid-body motions, loss of stability through zero.

use eigentol::{Behaviour, Family, Quantity, Study};
use eigentol_tests::corpus::sliders_on_plate::SlidersOnPlate;
use eigentol_tests::machines::SlidingPair;

use super::common::{close, design};

/// At rest the sliders are two oscillators; with a strong damper one of them creeps back at two rates.
#[test]
fn overdamped_motions_are_modes_of_their_own() {
    let study = Study::new(SlidersOnPlate).design(SlidersOnPlate::cx, 12.0).design(SlidersOnPlate::cy, 0.5);
    let design = study.design_values();
    let (m, kx, ky) = (design[0], design[1], design[2]);
    let found = study.modes().expect("modes");
    let slopes = study.sensitivities().expect("derivatives");
    assert_eq!(found.modes.len(), 3);
    let root = (12.0_f64.powi(2) - 4.0 * m * kx).sqrt();
    let mut creeping = 0;
    for (mode, own) in found.modes.iter().zip(&slopes.modes) {
        match mode.behaviour {
            Behaviour::Decaying(rate) => {
                let sign = if creeping == 0 { -1.0 } else { 1.0 };
                close(rate, (12.0 + sign * root) / (2.0 * m));
                // ds/dc = -s / (2 m s + c), ds/dk = -1 / (2 m s + c).
                let slope = 2.0 * m * mode.s.re + 12.0;
                let growth = own.of(Quantity::Growth).expect("a derivative");
                close(growth.by_design[SlidersOnPlate::cx.index()], -mode.s.re / slope);
                close(growth.by_design[SlidersOnPlate::kx.index()], -1.0 / slope);
                assert_eq!(own.of(Quantity::Frequency), None);
                assert_eq!(mode.frequency(), None);
                creeping += 1;
            }
            Behaviour::Damped(omega) => {
                close(omega, (ky / m - (0.25 / m).powi(2)).sqrt());
                close(mode.natural_frequency().expect("one"), (ky / m).sqrt());
            }
            other => panic!("{other:?}"),
        }
    }
    assert_eq!(creeping, 2);
    // For a non-oscillating mode the standard deviation is that of its decay rate.
    let spread = study.relative_tolerance(SlidersOnPlate::cx, 0.03);
    let spread = spread.first_order().expect("a spread");
    let creeping = &spread.modes[0];
    assert!(creeping.frequency().is_none() && creeping.growth().expect("a rate").sigma > 0.0);
}

/// Without an anchor the pair drifts: `s = 0` twice, with one shape, which is one mode in either family.
#[test]
fn rigid_motions_are_neutral() {
    let study: Study<SlidingPair> = Study::new(SlidingPair).design(SlidingPair::anchor, 0.0);
    let [m1, m2, _, coupling] = design(&study);
    let omega = (coupling * (m1 + m2) / (m1 * m2)).sqrt();
    let undamped = study.modes().expect("modes");
    assert_eq!(undamped.family, Family::Undamped);
    assert_eq!(undamped.modes[0].behaviour, Behaviour::Neutral);
    close(undamped.modes[1].frequency().expect("one"), omega);
    let general = study.family(Family::General).modes().expect("modes");
    let neutral = |behaviour| matches!(behaviour, Behaviour::Neutral);
    let zeros = general.modes.iter().filter(|mode| neutral(mode.behaviour));
    assert_eq!(zeros.count(), 1);
    let other = general.modes.iter().find(|mode| !neutral(mode.behaviour));
    close(other.expect("one").frequency().expect("one"), omega);
}
