//! Mechanisms with closed loops and couplings, whose solutions in minimal coordinates are stored in `truth/loops.json`.
//!
//! Their loops are closed in every way that the language offers: cut joints, chosen by the declaration or by the
//! compiler; coincident points; distances; couplings and equations of coordinates, both at rest and running.

use crate::corpus::Visitor;

pub mod five_bar;
pub mod four_bar;
pub mod geared_coasting;
pub mod geared_motor;
pub mod geared_rotors;
pub mod governor;
pub mod porter_governor;
pub mod slider_crank;

pub use five_bar::FiveBar;
pub use four_bar::FourBar;
pub use geared_coasting::GearedCoasting;
pub use geared_motor::GearedMotor;
pub use geared_rotors::GearedRotors;
pub use governor::Governor;
pub use porter_governor::PorterGovernor;
pub use slider_crank::SliderCrank;

/// Passes every mechanism to a visitor.
pub fn visit(visitor: &mut impl Visitor) {
    visitor.visit("five_bar", five_bar::DECLARATION, FiveBar);
    visitor.visit("four_bar", four_bar::DECLARATION, FourBar);
    visitor.visit(
        "geared_coasting",
        geared_coasting::DECLARATION,
        GearedCoasting,
    );
    visitor.visit("geared_motor", geared_motor::DECLARATION, GearedMotor);
    visitor.visit("geared_rotors", geared_rotors::DECLARATION, GearedRotors);
    visitor.visit("governor", governor::DECLARATION, Governor);
    visitor.visit(
        "porter_governor",
        porter_governor::DECLARATION,
        PorterGovernor,
    );
    visitor.visit("slider_crank", slider_crank::DECLARATION, SliderCrank);
}
