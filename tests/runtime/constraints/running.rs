//! Speeds and velocity constraints.

use eigentol::equilibrium::assemble;
use eigentol::{
    Coordinate, CoordinateInfo, DampingKind, Description, Policy, Real, Role, Shared, Unit, equilibrium::equilibrium,
};

use crate::common::derived::{Derived, Model};
use crate::common::{NUMBER, SPEED, coordinate, description, design, input, sizes};

/// Two geared rotors with drag, the first driven by a torque; beside them a mass on a spring, loaded by the second
/// speed: `J1 v1' + c1 v1 - T + mu = 0`, `J2 v2' + c2 v2 + r mu = 0`, `v1 + r v2 = 0`, `m x'' + k x - p v2^2 = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Gears;

const VALUES: [f64; 8] = [0.1, 0.4, 0.02, 0.3, 2.5, 1.7, 60.0, 0.2];

impl Model for Gears {
    sizes!(4, 1, 8, 0);

    const DESCRIPTION: Description = description!(
        "Gears",
        &[
            coordinate("x", crate::common::METRE),
            speed("v1"),
            speed("v2"),
            CoordinateInfo {
                name: Shared::Static("mesh"),
                unit: Unit { symbol: Shared::Static("N*m"), scale: 1.0 },
                role: Role::VelocityReaction,
            },
        ],
        &[input("torque", NUMBER)],
        &[
            design("j1", NUMBER, VALUES[0], 0.0),
            design("j2", NUMBER, VALUES[1], 0.0),
            design("c1", NUMBER, VALUES[2], 0.0),
            design("c2", NUMBER, VALUES[3], 0.0),
            design("r", NUMBER, VALUES[4], 0.0),
            design("m", NUMBER, VALUES[5], 0.0),
            design("k", NUMBER, VALUES[6], 0.0),
            design("p", NUMBER, VALUES[7], 0.0),
        ],
        false,
        DampingKind::General
    );

    fn inertia<T: Real>(&self, a: &[T; 4], v: &[T; 4], _: &[T; 4], _: &[T; 1], b: &[T; 8]) -> [T; 4] {
        [b[5] * a[0], b[0] * v[1], b[1] * v[2], T::constant(0.0)]
    }

    fn applied<T: Real>(&self, _: &[T; 4], q: &[T; 4], u: &[T; 1], b: &[T; 8]) -> [T; 4] {
        let [x, v1, v2, mu] = *q;
        [b[7] * v2 * v2 - b[6] * x, u[0] - b[2] * v1 - mu, -(b[3] * v2) - b[4] * mu, -(v1 + b[4] * v2)]
    }
}

const fn speed(name: &'static str) -> CoordinateInfo {
    CoordinateInfo { name: Shared::Static(name), unit: SPEED, role: Role::Speed }
}

#[test]
fn geared_rotors_run_at_one_speed() {
    let torque = 3.0;
    let [_, _, c1, c2, r, _, k, p] = VALUES;
    // Power: T v1 = c1 v1^2 + c2 v2^2.
    let v1 = torque / (c1 + c2 / (r * r));
    let v2 = -v1 / r;
    let mu = torque - c1 * v1;
    let expected = [p * v2 * v2 / k, v1, v2, mu];
    for start in [[0.0; 4], [1.0, -50.0, 3.0, 7e5]] {
        for policy in [Policy::Stable, Policy::Nearest] {
            let state = equilibrium(&Derived(Gears), &[torque], &VALUES, &start, policy).expect("an equilibrium");
            for (have, want) in state.coordinates.iter().zip(expected) {
                crate::common::close(*have, want, 1e-12);
            }
            assert_eq!((state.constraints.freedom, state.constraints.redundant), (1, 0));
            let text = state.to_string();
            assert!(text.contains("speed") && text.contains("mesh [N*m]"), "{text}");
        }
    }
}

#[test]
fn speeds_are_assembled_too() {
    let start = [0.3, 8.0, 0.0, 0.0];
    let held = [Coordinate::new(1)];
    let found = assemble(&Derived(Gears), &[3.0], &VALUES, &start, &held).expect("it runs");
    crate::common::close(found.coordinates[2], -8.0 / VALUES[4], 1e-14);
    assert_eq!(found.coordinates[..2], [0.3, 8.0]);
}
