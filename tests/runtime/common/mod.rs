//! Hand-written mechanisms, independent of the compiler.
#![allow(dead_code, unreachable_pub, unused_imports, reason = "each test uses some of it")]

/// The numbers of unknowns, inputs, design variables, outputs and excitations of a mechanism.
macro_rules! sizes {
    ($n:literal, $u:literal, $p:literal, $o:literal) => {
        sizes!($n, $u, $p, $o, 0);
    };
    ($n:literal, $u:literal, $p:literal, $o:literal, $e:literal) => {
        type Coordinates<T: Copy> = [T; $n];
        type Inputs<T: Copy> = [T; $u];
        type Design<T: Copy> = [T; $p];
        type Outputs<T: Copy> = [T; $o];
        type Excitations<T: Copy> = [T; $e];
    };
}
pub(crate) use sizes;

/// A description in SI that has nothing of the kinds it does not name: name, coordinates, inputs, design variables, symmetry of the
/// stiffness, damping, and outputs if there are any.
macro_rules! description {
    ($name:expr, $coordinates:expr, $inputs:expr, $design:expr, $symmetric:expr, $damping:expr $(,)?) => {
        description!($name, $coordinates, $inputs, $design, $symmetric, $damping, &[])
    };
    ($name:expr, $coordinates:expr, $inputs:expr, $design:expr, $symmetric:expr, $damping:expr, $outputs:expr $(,)?) => {
        eigentol::Description {
            name: eigentol::Shared::Static($name),
            coordinates: eigentol::Shared::Static($coordinates),
            inputs: eigentol::Shared::Static($inputs),
            design: eigentol::Shared::Static($design),
            excitations: eigentol::Shared::Static(&[]),
            outputs: eigentol::Shared::Static($outputs),
            symmetric_stiffness: $symmetric,
            free_directions: 0,
            held: eigentol::Shared::Static(&[]),
            length: 1.0,
            frequency: eigentol::Unit::si("rad/s"),
            resolved_modes: None,
            correlations: eigentol::Shared::Static(&[]),
            rings: eigentol::Shared::Static(&[]),
            spans: eigentol::Shared::Static(&[]),
            harmonics: eigentol::Shared::Static(&[]),
            damping: $damping,
            kernels: eigentol::Shared::Static(&[]),
        }
    };
}
pub(crate) use description;

pub mod branching;
pub mod chain;
pub mod derived;
pub mod dual;
pub mod models;
pub mod pendulum;
pub mod priced;

use eigentol::response::Response;
use eigentol::{CoordinateInfo, DesignInfo, InputInfo, Quantity, Role, Shared, ToleranceInfo, Unit, Violation};

pub const RAD: Unit = Unit { symbol: Shared::Static("rad"), scale: 1.0 };
pub const METRE: Unit = Unit { symbol: Shared::Static("m"), scale: 1.0 };
pub const KILOGRAM: Unit = Unit { symbol: Shared::Static("kg"), scale: 1.0 };
pub const SPEED: Unit = Unit { symbol: Shared::Static("rad/s"), scale: 1.0 };
pub const STIFFNESS: Unit = Unit { symbol: Shared::Static("N/m"), scale: 1.0 };
pub const NUMBER: Unit = Unit { symbol: Shared::Static(""), scale: 1.0 };

/// Standard gravity as given in the paper, m/s^2.
pub const GRAVITY: f64 = 9.81;

/// The frequency of the first mode.
pub const FREQUENCY: Response = Response::Mode { mode: 0, quantity: Quantity::Frequency };

pub const fn coordinate(name: &'static str, unit: Unit) -> CoordinateInfo {
    CoordinateInfo { name: Shared::Static(name), unit, role: Role::Position }
}

pub const fn input(name: &'static str, unit: Unit) -> InputInfo {
    InputInfo { name: Shared::Static(name), unit, tolerance: ToleranceInfo::NONE }
}

pub const fn design(name: &'static str, unit: Unit, nominal: f64, tolerance: f64) -> DesignInfo {
    DesignInfo { name: Shared::Static(name), unit, nominal, tolerance: ToleranceInfo::half_width(tolerance) }
}

/// The first of `values` that is not positive.
pub fn positive<T: eigentol::Real + PartialOrd>(values: &[(T, &'static str)]) -> Option<Violation<T>> {
    values
        .iter()
        .find(|(value, _)| !matches!(value.partial_cmp(&T::constant(0.0)), Some(std::cmp::Ordering::Greater)))
        .map(|&(value, quantity)| Violation { quantity: quantity.into(), requirement: "positive".into(), value })
}

#[track_caller]
pub fn close(actual: f64, expected: f64, relative: f64) {
    let scale = expected.abs().max(1e-12);
    assert!((actual - expected).abs() <= relative * scale, "{actual:e} is not {expected:e} to {relative:e}");
}
