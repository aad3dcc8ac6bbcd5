//! Mechanisms written by hand, independent of the compiler.
#![allow(dead_code, unreachable_pub, reason = "each test uses some of it")]

pub mod branching;
pub mod chain;
pub mod derived;
pub mod dual;
pub mod models;
pub mod pendulum;

use eigentol::{CoordinateInfo, DesignInfo, InputInfo, Role, Unit, Violation};

pub const RAD: Unit = Unit {
    symbol: "rad",
    scale: 1.0,
};
pub const METRE: Unit = Unit {
    symbol: "m",
    scale: 1.0,
};
pub const KILOGRAM: Unit = Unit {
    symbol: "kg",
    scale: 1.0,
};
pub const SPEED: Unit = Unit {
    symbol: "rad/s",
    scale: 1.0,
};
pub const STIFFNESS: Unit = Unit {
    symbol: "N/m",
    scale: 1.0,
};
pub const NUMBER: Unit = Unit {
    symbol: "",
    scale: 1.0,
};

/// Standard gravity as the paper has it, m/s^2.
pub const GRAVITY: f64 = 9.81;

pub const fn coordinate(name: &'static str, unit: Unit) -> CoordinateInfo {
    CoordinateInfo {
        name,
        unit,
        role: Role::Position,
    }
}

pub const fn input(name: &'static str, unit: Unit) -> InputInfo {
    InputInfo { name, unit }
}

pub const fn design(name: &'static str, unit: Unit, nominal: f64, tolerance: f64) -> DesignInfo {
    DesignInfo {
        name,
        unit,
        nominal,
        tolerance,
    }
}

/// The first of `values` that is not positive.
pub fn positive<T: eigentol::Real + PartialOrd>(
    values: &[(T, &'static str)],
) -> Option<Violation<T>> {
    values
        .iter()
        .find(|(value, _)| {
            !matches!(
                value.partial_cmp(&T::constant(0.0)),
                Some(std::cmp::Ordering::Greater)
            )
        })
        .map(|&(value, quantity)| Violation {
            quantity,
            requirement: "positive",
            value,
        })
}

#[track_caller]
pub fn close(actual: f64, expected: f64, relative: f64) {
    let scale = expected.abs().max(1e-12);
    assert!(
        (actual - expected).abs() <= relative * scale,
        "{actual:e} is not {expected:e} to {relative:e}"
    );
}
