//! Machines whose eigenvalues have closed forms: whirl, nutation, gyroscopic splitting, follower forces, rigid-body
//! modes.
//!
//! They are declared and stored like those of the corpus, but are not part of it: they would add nothing to the
//! snapshots or to the agreement checks of all kernels.

use crate::corpus::Visitor;

pub mod jeffcott_rotor;
pub mod overhung_rotor;
pub mod sleeping_top;
pub mod sliding_pair;
pub mod spherical_pendulum;
pub mod ziegler_column;

pub use jeffcott_rotor::JeffcottRotor;
pub use overhung_rotor::OverhungRotor;
pub use sleeping_top::SleepingTop;
pub use sliding_pair::SlidingPair;
pub use spherical_pendulum::SphericalPendulum;
pub use ziegler_column::ZieglerColumn;

/// Passes every machine to a visitor.
pub fn visit(visitor: &mut impl Visitor) {
    visitor.visit("jeffcott_rotor", jeffcott_rotor::DECLARATION, JeffcottRotor);
    visitor.visit("overhung_rotor", overhung_rotor::DECLARATION, OverhungRotor);
    visitor.visit("sleeping_top", sleeping_top::DECLARATION, SleepingTop);
    visitor.visit("sliding_pair", sliding_pair::DECLARATION, SlidingPair);
    visitor.visit(
        "spherical_pendulum",
        spherical_pendulum::DECLARATION,
        SphericalPendulum,
    );
    visitor.visit("ziegler_column", ziegler_column::DECLARATION, ZieglerColumn);
}
