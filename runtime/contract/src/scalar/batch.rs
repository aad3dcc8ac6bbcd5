//! One number for each of several states.

/// Number of states in a batch.
pub const WIDTH: usize = 8;

/// One number for each of [`WIDTH`] states, aligned for the widest vector.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Batch(pub [f64; WIDTH]);

impl Batch {
    /// The same number for every state.
    #[must_use]
    pub fn all(value: f64) -> Self {
        Self([value; WIDTH])
    }

    /// `value(k)` for state `k`.
    pub fn from_fn(value: impl FnMut(usize) -> f64) -> Self {
        Self(core::array::from_fn(value))
    }
}

impl Default for Batch {
    fn default() -> Self {
        Self::all(0.0)
    }
}
