//! Modes, and everything derived from them, with constraints and speeds: every mechanism against its version in minimal
//! coordinates or against a closed form.

mod branches;
mod compare;
mod holonomic;
mod minimal;
mod nonholonomic;
mod random;
mod rolling;
mod tolerance;

use eigentol::{CoordinateInfo, Role, Shared, Unit};

pub(crate) const FORCE: Unit = Unit { symbol: Shared::Static("N"), scale: 1.0 };

pub(crate) const fn reaction(name: &'static str, unit: Unit) -> CoordinateInfo {
    CoordinateInfo { name: Shared::Static(name), unit, role: Role::PositionReaction }
}
