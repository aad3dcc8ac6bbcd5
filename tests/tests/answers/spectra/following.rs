//! Modes keep their identity along a sweep: through a crossing, and through a veering however coarse the sweep.

use eigentol::{Error, Study, mechanism};

mechanism! {
    /// Two sliders on springs of their own, coupled by a weak one; the first spring is tuned by an input.
    pub(crate) mechanism TunedPair {
        input tuning: N/m;
        design mass = 1 kg +/- 1%;
        design stiffness = 100 N/m +/- 1%;
        design coupling = 0 N/m;
        body first: point(mass: mass);
        body second: point(mass: mass);
        joint a: prismatic(x) from ground to first;
        joint b: prismatic(x) from ground to second;
        force own_a: spring(on: a, stiffness: tuning);
        force own_b: spring(on: b, stiffness: stiffness);
        force between: potential(energy: 0.5 * coupling * (a - b)^2);
    }
}

type Pair = Study<TunedPair>;

fn pair(coupling: f64) -> Pair {
    Study::new(TunedPair).design(TunedPair::coupling, coupling)
}

/// Frequencies of the mode with a given label along a sweep, and the share of the first slider in its motion.
fn branch(study: &Pair, values: &[f64], label: usize) -> Vec<(f64, f64)> {
    let swept = study.sweep(TunedPair::tuning, values).expect("a sweep");
    swept
        .points
        .iter()
        .map(|point| {
            let modes = point.modes.as_ref().expect("modes");
            let mode = modes.modes.iter().find(|mode| mode.label == label);
            let mode = mode.expect("followed");
            let (a, b) = (mode.shape[0].norm_sqr(), mode.shape[1].norm_sqr());
            (mode.frequency().expect("it oscillates"), a / (a + b))
        })
        .collect()
}

#[test]
fn uncoupled_modes_cross() {
    let values: Vec<f64> = (0..=10).map(|step| 50.0 + 10.0 * f64::from(step)).collect();
    let study = pair(0.0);
    for (k, (omega, share)) in values.iter().zip(branch(&study, &values, 0)) {
        assert!((omega - k.sqrt()).abs() < 1e-12 && share > 1.0 - 1e-12, "{k}");
    }
    for (omega, share) in branch(&study, &values, 1) {
        assert!((omega - 10.0).abs() < 1e-12 && share < 1e-12);
    }
}

/// Coupled, the two never meet: the lower one changes from the first slider to the second. A sweep of four points gives
/// the same result as one of a thousand: across the middle each shape resembles the other mode's more (0.69) than its
/// own (0.31), and modes that are not recognised are followed in smaller steps.
#[test]
fn coupled_modes_veer() {
    let study = pair(2.0);
    let fine: Vec<f64> = (0..=1000).map(|step| 50.0 + 0.1 * f64::from(step)).collect();
    let coarse = [50.0, 94.0, 106.0, 150.0];
    for (label, first_share) in [(0, true), (1, false)] {
        let fine = branch(&study, &fine, label);
        let coarse = branch(&study, &coarse, label);
        assert!((fine[0].0 - coarse[0].0).abs() < 1e-12);
        assert!((fine[1000].0 - coarse[3].0).abs() < 1e-12);
        assert_eq!(fine[0].1 > 0.9, first_share);
        assert_eq!(fine[1000].1 > 0.9, !first_share);
        assert!(fine.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }
    // At the closest approach each is half of both; single-mode derivatives exist, and mix the two.
    let near = study.clone().input(TunedPair::tuning, 100.0);
    let slopes = near.sensitivities().expect("derivatives");
    for (mode, omega) in slopes.modes.iter().zip([100.0_f64, 104.0]) {
        assert!(!mode.clustered);
        let by_tuning = mode.frequency().expect("it oscillates").by_input[0];
        assert!((by_tuning - 0.25 / omega.sqrt()).abs() < 1e-12);
    }
}

/// Exactly tuned and uncoupled there is no single-mode derivative.
#[test]
fn a_double_frequency_has_no_derivative_of_its_own() {
    let study = pair(0.0).input(TunedPair::tuning, 100.0);
    let slopes = study.sensitivities().expect("derivatives");
    assert!(slopes.modes.iter().all(|mode| mode.clustered));
    assert!(matches!(study.mode_curvature(1), Err(Error::ClusteredMode { mode: 1 })));
    assert!(matches!(study.shape_sensitivity(0), Err(Error::ClusteredMode { mode: 0 })));
    assert!(!study.first_order().expect("a spread").trusted());
}
