/// The position of the first argument that is null though something is to be read or written there, 0 if there is none.
fn first_null(arguments: &[(i32, *const f64, usize)]) -> i32 {
    for (position, pointer, length) in arguments {
        if *length > 0 && pointer.is_null() {
            return *position;
        }
    }
    0
}

/// A copy of `N` numbers.
///
/// # Safety
/// They are there, unless `N` is zero.
unsafe fn read<const N: usize>(from: *const f64) -> [f64; N] {
    if N == 0 {
        return [0.0; N];
    }
    // SAFETY: the caller's promise.
    unsafe { from.cast::<[f64; N]>().read() }
}

/// Copies numbers to `to`.
///
/// # Safety
/// There is room for them, unless there are none.
unsafe fn write(numbers: &[f64], to: *mut f64) {
    if !numbers.is_empty() {
        // SAFETY: the caller's promise; `numbers` are ours.
        unsafe { ::core::ptr::copy_nonoverlapping(numbers.as_ptr(), to, numbers.len()) }
    }
}
