//! Arrays whose length a mechanism knows and its users need not spell out.

/// A plain array `[T; N]`; no other type implements it.
pub trait Array<T>: Copy + AsRef<[T]> + AsMut<[T]> + sealed::Sealed {
    /// Number of entries.
    const LEN: usize;

    /// An array with `value(k)` at position `k`.
    fn from_fn(value: impl FnMut(usize) -> T) -> Self;

    /// An array with the same value everywhere.
    fn filled(value: T) -> Self;

    /// Views a slice of this length as an array.
    ///
    /// # Panics
    /// If the slice has another length.
    fn view(slice: &[T]) -> &Self;
}

impl<T: Copy, const N: usize> Array<T> for [T; N] {
    const LEN: usize = N;

    #[inline(always)]
    fn from_fn(value: impl FnMut(usize) -> T) -> Self {
        core::array::from_fn(value)
    }

    #[inline(always)]
    fn filled(value: T) -> Self {
        [value; N]
    }

    #[inline(always)]
    fn view(slice: &[T]) -> &Self {
        match slice.try_into() {
            Ok(array) => array,
            Err(_) => wrong_length(slice.len(), N),
        }
    }
}

#[cold]
fn wrong_length(found: usize, expected: usize) -> ! {
    panic!("{found} values where the mechanism has {expected}")
}

mod sealed {
    /// Prevents other types from implementing the trait.
    pub trait Sealed {}
    impl<T, const N: usize> Sealed for [T; N] {}
}
