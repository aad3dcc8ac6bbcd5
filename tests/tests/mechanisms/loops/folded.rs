//! Loops that fold flat, where a whole row of the constraints vanishes: singular configurations in which no two rows
//! have come close to each other.
//!
//! The crank of the slider-crank is as long as its rod: with the crank upright, the rod lies on it, and the slider may
//! rest while both turn, or move. Of the parallelogram, all bars lie in one line.

use eigentol::{Error, Stability, Study, mechanism};

mechanism! {
    /// A slider-crank that folds.
    mechanism Folding {
        design rest = 90 deg;
        body crank: rod(mass: 0.6 kg, length: 100 mm, along: x);
        body rod: rod(mass: 0.8 kg, length: 100 mm, along: x);
        body piston: point(mass: 0.9 kg);
        joint crank_angle: revolute(-y) from ground to crank;
        joint bend: revolute(-y) from crank to rod at [100 mm, 0, 0];
        joint slide: prismatic(x) from ground to piston;
        joint wrist: revolute(-y) from rod to piston at [100 mm, 0, 0], cut;
        force spring: spring(on: crank_angle, stiffness: 25 N*m/rad, rest: rest);
    }
}

mechanism! {
    /// A parallelogram whose bars all lie in one line.
    mechanism Flat {
        design rest = 0 deg;
        body left: rod(mass: 1 kg, length: 0.2 m, along: x);
        body coupler: rod(mass: 1 kg, length: 0.5 m, along: x);
        body right: rod(mass: 1 kg, length: 0.2 m, along: x);
        joint al: revolute(z) from ground to left;
        joint be: revolute(z) from left to coupler at [0.2 m, 0, 0];
        joint ga: revolute(z) from ground to right at [0.5 m, 0, 0];
        joint pin: revolute(z) from coupler to right at [0.5 m, 0, 0], at [0.2 m, 0, 0] on right, cut;
        force spring: spring(on: al, stiffness: 10 N*m/rad, rest: rest);
    }
}

/// The folded crank with the rod beside it turns as one: the slider stays where it is, or moves as if the crank were half
/// of it. The spring turns either to the pose where both meet.
fn folding(from: f64, rest: f64) -> Study<Folding> {
    Study::new(Folding).design(Folding::rest, rest).start(Folding::crank_angle, from).guess(Folding::bend, -2.0 * from)
}

#[test]
fn a_folded_crank_is_singular_wherever_the_search_starts() {
    let right = core::f64::consts::FRAC_PI_2;
    for degrees in [30.0, 60.0, 80.0, 89.0, 89.999, 90.0, 90.001, 100.0] {
        let study = folding(f64::to_radians(degrees), right);
        match study.equilibrium() {
            Ok(state) => {
                assert!(state.constraints.singular, "{degrees}: {state}");
                assert_eq!(state.stability, Stability::Undecided);
            }
            Err(error) => panic!("{degrees}: {error}"),
        }
        let modes = study.modes();
        assert!(matches!(modes, Err(Error::SingularConfiguration { .. })), "{degrees}");
    }
}

/// Lagrange: with the crank at `a`, `slide = 2 r cos a`, rod symmetric to it; the inertia is
/// `m_c r^2 / 3 + m_r r^2 / 3 + ...` at the pose itself.
#[test]
fn beside_the_fold_frequencies_are_known_or_refused() {
    let right = core::f64::consts::FRAC_PI_2;
    let (r, crank, rod, piston) = (0.1, 0.6, 0.8, 0.9);
    for off in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9] {
        let rest: f64 = right - off;
        let sine = rest.sin();
        // Kinetic energy by the crank's speed: the rod's middle is at (3/2 r cos a, 1/2 r sin a) and it turns backwards.
        let middle = (1.5 * sine).powi(2) + (0.5 * rest.cos()).powi(2);
        let inertia = r * r * (crank / 3.0 + rod * (middle + 1.0 / 12.0) + piston * (2.0 * sine).powi(2));
        let omega = (25.0 / inertia).sqrt();
        let study = folding(1.0, rest);
        let state = study.equilibrium().expect("an equilibrium");
        assert!(off < 1e-5 || !state.constraints.singular, "{off}");
        match study.modes() {
            Ok(modes) => {
                let found = modes.modes[0].frequency().expect("it oscillates");
                assert!((found / omega - 1.0).abs() < 2e-3, "{off}: {found} {omega}");
            }
            Err(Error::SingularConfiguration { .. }) => assert!(off < 1e-5, "{off}"),
            Err(error) => panic!("{off}: {error}"),
        }
    }
}

#[test]
fn a_flat_parallelogram_is_singular_wherever_the_search_starts() {
    for degrees in [0.0, 1e-6, 1e-3, 1.0, 5.0, 30.0] {
        let angle = f64::to_radians(degrees);
        let study = Study::new(Flat).start(Flat::al, angle).guess(Flat::be, -angle).guess(Flat::ga, angle);
        let state = study.equilibrium().unwrap_or_else(|error| panic!("{degrees}: {error}"));
        assert!(state.constraints.singular, "{degrees}: {state}");
        assert_eq!(state.stability, Stability::Undecided);
    }
}

#[test]
fn beside_the_flat_parallelogram_nothing_is_held_by_reactions_without_bound() {
    let inertia = 0.04 * (1.0 / 3.0 + 1.0 + 1.0 / 3.0);
    let omega = f64::sqrt(10.0 / inertia);
    for rest in [1e-1, 1e-2, 1e-3, 1.7e-4, 1e-5, 1e-6, 1e-7, 1e-9] {
        for start in [0.0, 1e-3, 0.1, 0.5] {
            let study = Study::new(Flat)
                .design(Flat::rest, rest)
                .start(Flat::al, start)
                .guess(Flat::be, -start)
                .guess(Flat::ga, start);
            let state = match study.equilibrium() {
                Ok(state) => state,
                Err(Error::NoEquilibrium { .. } | Error::UnboundedReactions { .. }) => continue,
                Err(error) => panic!("{rest} {start}: {error}"),
            };
            let held = state.coordinates[3].hypot(state.coordinates[4]);
            assert!(held < 100.0, "{rest} {start}: {state}");
            let [al, be, ga] = [0, 1, 2].map(|i| state.coordinates[i]);
            let parallel = (ga - al).abs() + (be + al).abs() < 1e-2 * rest;
            if parallel && !state.constraints.singular {
                let modes = study.modes().expect("modes");
                let found = modes.modes[0].frequency().expect("it oscillates");
                assert!((found / omega - 1.0).abs() < 2e-3, "{rest} {start}: {found}");
            }
        }
    }
}
