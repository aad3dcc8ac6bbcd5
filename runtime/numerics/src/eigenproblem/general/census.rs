//! What was done, counted for tests.

/// Operation counts since the last call of `take`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Census {
    /// Pencils solved as conservative ones, and by the general method.
    pub(crate) conservative: usize,
    pub(crate) general: usize,
    /// QR steps.
    pub(crate) steps: usize,
    /// Triangular factors of `Q(s)`, and those of them that the second method took.
    pub(crate) factors: usize,
    pub(crate) second: usize,
}

#[cfg(test)]
std::thread_local! {
    static COUNTS: std::cell::Cell<Census> = const { std::cell::Cell::new(Census {
        conservative: 0,
        general: 0,
        steps: 0,
        factors: 0,
        second: 0,
    }) };
}

/// Counts something; does nothing outside of tests.
#[inline(always)]
pub(super) fn note(change: impl FnOnce(&mut Census)) {
    #[cfg(test)]
    {
        let mut counts = COUNTS.get();
        change(&mut counts);
        COUNTS.set(counts);
    }
    #[cfg(not(test))]
    let _ = change;
}

/// The counts of this thread, which start again.
#[cfg(test)]
pub(super) fn take() -> Census {
    COUNTS.take()
}
