//! Position constraints against minimal coordinates.

use eigentol::clusters::modal_couplings;
use eigentol::sensitivity::sensitivities;
use eigentol::shapes::shape_sensitivity;
use eigentol::{Error, Family};

use crate::constrained_modes::compare::{State, all_near, same_mechanism, same_modes};
use crate::constrained_modes::holonomic::{
    Bar, BarByAngle, Chain, ChainByAngles, CrankByAngle, SliderCrank, Spherical, SphericalByPlane,
};

const CRITICAL: f64 = 3.836_013_555_764_453;

#[test]
fn a_bar_by_its_tip_is_the_bar_by_its_angle() {
    for omega in [0.0, 2.0, 3.5, 4.2, 7.0] {
        let state = State::new(Bar::<1>, &[omega], &[0.8, 0.7, 0.0]);
        let other = State::new(BarByAngle, &[omega], &[0.9]);
        assert_eq!(state.modes.family, Family::Undamped);
        assert_eq!(state.modes.modes.len(), 1);
        let theta = other.at.coordinates[0];
        all_near(&state.at.coordinates[..2], &[theta.sin(), theta.cos()], 1e-12);
        let g = 9.81;
        let lambda = if omega < CRITICAL { 1.5 * g - omega * omega } else { omega * omega - (1.5 * g / omega).powi(2) };
        all_near(&[state.modes.modes[0].lambda], &[lambda], 1e-12);
        same_mechanism(&state, &other);
    }
}

#[test]
fn a_slider_crank_on_a_turntable_is_its_crank() {
    for omega in [0.0, 5.0, 9.0] {
        let other = State::new(CrankByAngle, &[omega], &[0.9]);
        let theta = other.at.coordinates[0];
        let x = 0.2 * theta.cos() + (0.25 - (0.2 * theta.sin()).powi(2)).sqrt();
        let state = State::new(SliderCrank, &[omega], &[theta + 0.05, x - 0.02, 0.0]);
        all_near(&state.at.coordinates[..2], &[theta, x], 1e-12);
        same_mechanism(&state, &other);
    }
}

#[test]
fn a_chain_of_two_rods_is_two_angles() {
    for omega in [0.0, 1.5, 3.0] {
        let other = State::new(ChainByAngles, &[omega], &[0.3, 0.4]);
        let (a, b) = (other.at.coordinates[0], other.at.coordinates[1]);
        let (x, z) = (0.8 * a.sin(), 0.8 * a.cos());
        let tip = [x + 0.5 * b.sin(), z + 0.5 * b.cos()];
        let start = [x + 0.03, z - 0.02, tip[0], tip[1] + 0.04, 0.0, 0.0];
        let state = State::new(Chain, &[omega], &start);
        all_near(&state.at.coordinates[..4], &[x, z, tip[0], tip[1]], 1e-11);
        same_mechanism(&state, &other);
        for r in 0..2 {
            // Both are normalised by the same kinetic energy: shapes differ at most in sign.
            let minimal = other.modes.modes[r].shape.map(|value| value.re);
            let re = state.modes.modes[r].shape.map(|value| value.re);
            let places = [
                0.8 * a.cos() * minimal[0],
                -0.8 * a.sin() * minimal[0],
                0.8 * a.cos() * minimal[0] + 0.5 * b.cos() * minimal[1],
                -0.8 * a.sin() * minimal[0] - 0.5 * b.sin() * minimal[1],
            ];
            let sign = (re[0] * places[0]).signum();
            all_near(&re[..4], &places.map(|value| sign * value), 1e-11);
        }
    }
}

#[test]
fn a_spherical_pendulum_on_a_turntable_is_its_shadow() {
    for omega in [0.0, 0.8, 2.0] {
        let other = State::new(SphericalByPlane, &[omega], &[0.1, 0.1]);
        let (x, y) = (other.at.coordinates[0], other.at.coordinates[1]);
        let z = (1.44 - x * x - y * y).sqrt();
        let state = State::new(Spherical, &[omega], &[x - 0.02, y + 0.01, z, 0.0]);
        assert_eq!(state.modes.family, Family::General);
        all_near(&state.at.coordinates[..3], &[x, y, z], 1e-11);
        same_mechanism(&state, &other);
    }
}

/// Derivatives of left and right shapes, reactions included, against solving again.
#[test]
fn shapes_move_with_the_design() {
    let start = [0.1, 0.1, 1.1, 0.0];
    let here = State::new(Spherical, &[0.8], &start);
    for r in 0..here.modes.modes.len() {
        let found = shape_sensitivity(&*here.mechanism, &here.at, &here.modes, r).unwrap();
        for j in 0..6 {
            let at = |step: f64| {
                let mut b = here.at.design.clone();
                b[j] += step;
                State::with(Spherical, &[0.8], &b, &start).modes.modes[r].clone()
            };
            let h = 1e-3 * here.at.design[j];
            let (up, down, up2, down2) = (at(h), at(-h), at(2.0 * h), at(-2.0 * h));
            for left in [false, true] {
                let part = |mode: &eigentol::Mode, i: usize| {
                    if left { mode.left()[i] } else { mode.shape[i] }
                };
                let slope = |i: usize| {
                    let one = part(&up, i) - part(&down, i);
                    let two = part(&up2, i) - part(&down2, i);
                    (8.0 * one - two) / (12.0 * h)
                };
                let own = if left { &found.left_by_design[j] } else { &found.right_by_design[j] };
                for rows in [0..3, 3..4] {
                    let values: Vec<f64> = rows.clone().flat_map(|i| [own[i].re, own[i].im]).collect();
                    let other: Vec<f64> = rows.flat_map(|i| [slope(i).re, slope(i).im]).collect();
                    all_near(&values, &other, 1e-7);
                }
            }
        }
    }
}

/// Equal stiffness in all directions: two equal frequencies form one cluster, whose mean has derivatives.
#[test]
fn equal_frequencies_are_a_cluster() {
    let b = [0.7, 1.2, 6.0, 6.0, 0.0, 0.0];
    let state = State::with(Spherical, &[0.0], &b, &[0.1, 0.1, 1.1, 0.0]);
    let other = State::with(SphericalByPlane, &[0.0], &b, &[0.1, 0.1]);
    same_modes(&state.modes, &other.modes, 1e-12);
    let found = sensitivities(&*state.mechanism, &state.at, &state.modes).unwrap();
    assert!(found.modes.iter().all(|mode| mode.clustered));
    assert!(shape_sensitivity(&*state.mechanism, &state.at, &state.modes, 0).is_err());
    let mean = |couplings: eigentol::clusters::ModalCouplings| {
        let all = couplings.mean_by_design();
        all.iter().flat_map(|x| [x.re, x.im]).collect::<Vec<_>>()
    };
    let a = modal_couplings(&*state.mechanism, &state.at, &state.modes, &[0, 1]).unwrap();
    let b = modal_couplings(&*other.mechanism, &other.at, &other.modes, &[0, 1]).unwrap();
    all_near(&mean(a), &mean(b), 1e-11);
}

#[test]
fn a_length_stated_twice_or_thrice_changes_nothing() {
    for omega in [2.0, 4.2] {
        let once = State::new(Bar::<1>, &[omega], &[0.8, 0.7, 0.0]);
        let twice = State::new(Bar::<2>, &[omega], &[0.8, 0.7, 0.0, 0.0]);
        let thrice = State::new(Bar::<3>, &[omega], &[0.8, 0.7, 0.0, 0.0, 0.0]);
        assert_eq!(thrice.at.constraints.redundant, 2);
        same_modes(&twice.modes, &once.modes, 1e-12);
        same_mechanism(&twice, &once);
        same_mechanism(&thrice, &once);
    }
}

/// Two lengths that agree only at the nominal design.
mod contradictory {
    use eigentol::{DampingKind, Description, Real};

    use crate::common::derived::Model;
    use crate::common::{METRE, SPEED, coordinate, description, design, input, sizes};
    use crate::constrained_modes::{FORCE, reaction};

    #[derive(Clone, Copy, Debug)]
    pub(crate) struct Twice;

    impl Model for Twice {
        sizes!(4, 1, 2, 0);

        const DESCRIPTION: Description = description!(
            "Twice",
            &[coordinate("x", METRE), coordinate("z", METRE), reaction("rod", FORCE), reaction("wire", FORCE),],
            &[input("omega", SPEED)],
            &[design("rod_length", METRE, 1.0, 0.01), design("wire_length", METRE, 1.0, 0.01)],
            true,
            DampingKind::Zero
        );

        fn inertia<T: Real>(&self, a: &[T; 4], _: &[T; 4], q: &[T; 4], u: &[T; 1], b: &[T; 2]) -> [T; 4] {
            let size = (q[0] * q[0] + q[1] * q[1]).sqrt();
            let pull = (q[2] + q[3]) / size;
            [a[0] - u[0] * u[0] * q[0] + pull * q[0], a[1] - T::constant(9.81) + pull * q[1], size - b[0], size - b[1]]
        }

        fn applied<T: Real>(&self, _: &[T; 4], _: &[T; 4], _: &[T; 1], _: &[T; 2]) -> [T; 4] {
            [T::constant(0.0); 4]
        }
    }
}

#[test]
fn constraints_that_agree_at_one_design_have_modes_but_no_derivatives() {
    let state = State::new(contradictory::Twice, &[4.2], &[0.8, 0.7, 0.0, 0.0]);
    assert_eq!(state.modes.modes.len(), 1);
    let error = sensitivities(&*state.mechanism, &state.at, &state.modes).unwrap_err();
    let Error::ClosesHereOnly { constraint, variable } = error else { panic!("{error}") };
    assert!(["rod", "wire"].contains(&&*constraint), "{constraint}");
    assert_eq!(variable, "rod_length");
    assert!(shape_sensitivity(&*state.mechanism, &state.at, &state.modes, 0).is_err());
}

/// The bar's tip held in both directions.
pub(crate) mod held {
    use eigentol::{DampingKind, Description, Real};

    use crate::common::derived::Model;
    use crate::common::{METRE, SPEED, coordinate, description, design, input, sizes};
    use crate::constrained_modes::{FORCE, reaction};

    #[derive(Clone, Copy, Debug)]
    pub(crate) struct Held;

    impl Model for Held {
        sizes!(4, 1, 1, 0);

        const DESCRIPTION: Description = description!(
            "Held",
            &[coordinate("x", METRE), coordinate("z", METRE), reaction("length", FORCE), reaction("wall", FORCE),],
            &[input("omega", SPEED)],
            &[design("L", METRE, 1.0, 0.01)],
            true,
            DampingKind::Zero
        );

        fn inertia<T: Real>(&self, a: &[T; 4], _: &[T; 4], q: &[T; 4], u: &[T; 1], b: &[T; 1]) -> [T; 4] {
            let size = (q[0] * q[0] + q[1] * q[1]).sqrt();
            [
                a[0] - u[0] * u[0] * q[0] + q[2] * q[0] / size + q[3],
                a[1] - T::constant(9.81) + q[2] * q[1] / size,
                size - b[0],
                q[0] - T::constant(0.6),
            ]
        }

        fn applied<T: Real>(&self, _: &[T; 4], _: &[T; 4], _: &[T; 1], _: &[T; 1]) -> [T; 4] {
            [T::constant(0.0); 4]
        }
    }
}

#[test]
fn without_freedom_there_are_no_modes() {
    let state = State::new(held::Held, &[1.0], &[0.5, 0.7, 0.0, 0.0]);
    assert!(state.modes.modes.is_empty());
    assert!(state.modes.stable());
    let none = sensitivities(&*state.mechanism, &state.at, &state.modes).unwrap();
    assert!(none.modes.is_empty());
    assert!(!state.modes.to_string().is_empty());
    let general = eigentol::modes::modes_of(&state.at.linear, Family::General, &state.at.description);
    assert!(general.unwrap().modes.is_empty());
}
