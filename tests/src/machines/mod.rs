//! Machines whose eigenvalues have closed forms: whirl, nutation, gyroscopic splitting, follower forces, rigid-body
//! modes.
//!
//! They are declared and stored like those of the corpus, but are not part of it: they would add nothing to the
//! snapshots or to the agreement checks of all kernels.

use crate::corpus::machines;

machines! {
    jeffcott_rotor: JeffcottRotor,
    overhung_rotor: OverhungRotor,
    sleeping_top: SleepingTop,
    sliding_pair: SlidingPair,
    spherical_pendulum: SphericalPendulum,
    ziegler_column: ZieglerColumn,
}
