//! Directions in which nothing resists a steady motion: where the mechanism stands along them is not determined, and
//! does not matter.
//!
//! There `Khat Z = 0` and `W^T Khat = 0`, with as many columns each. An equation `Khat x = f` has solutions if
//! `W^T f = 0`, and they differ by multiples of `Z`. Adding `B H^T` to `Khat`, with columns `B` that are not orthogonal
//! to `W` and rows `H^T` that are not orthogonal to `Z`, selects the one with `H^T x = 0`: multiplied by `W^T` from the
//! left, the equation says so. Whatever does not depend on the place comes out the same for any `B` and `H`.

mod declared;
mod directions;
mod null_space;

#[doc(hidden)]
pub use declared::declared;
#[doc(hidden)]
pub use directions::fix_place;
pub use directions::{FreeDirections, Held};
pub(crate) use null_space::NullSpace;
