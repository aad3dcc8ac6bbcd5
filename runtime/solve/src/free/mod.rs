//! Directions in which nothing resists a steady motion: where the mechanism stands along them is not determined, and
//! does not matter.
//!
//! There `Khat Z = 0` and `W^T Khat = 0`, with as many columns each. An equation `Khat x = f` has solutions if
//! `W^T f = 0`, and they differ by multiples of `Z`. Adding `B H^T` to `Khat`, with columns `B` that are not orthogonal
//! to `W` and rows `H^T` that are not orthogonal to `Z`, selects the one with `H^T x = 0`: multiplied by `W^T` from the
//! left, the equation says so. Whatever does not depend on the place comes out the same for any `B` and `H`.
//!
//! # Free directions
//!
//! A motion along which the equations stay as they are (`Khat Z = 0`, `W^T Khat = 0` at every equilibrium) is a mode of
//! frequency zero, in any coordinates. The compiler finds these motions and counts them (`mechanics/checks/freedom`):
//! by evaluation, it proves that the Lie derivative of the equations along a few candidate fields vanishes. The runtime
//! holds the place by a border, `K + B H^T`, which is no restriction: whatever does not depend on the place comes out
//! the same for any `B` and `H`. Only what is not determined is refused: a load along a free direction, and derivatives
//! of outputs that depend on the place (`sensitivity/free_directions.rs`). Stiffness that only happens to vanish at one
//! state is no free direction: the compiler does not count it, and the state is critical.

mod declared;
mod directions;
mod null_space;

#[doc(hidden)]
pub use declared::declared;
#[doc(hidden)]
pub use directions::fix_place;
pub use directions::{FreeDirections, Held};
pub(crate) use null_space::NullSpace;
