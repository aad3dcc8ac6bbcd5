//! CasADi's `external`: the function `rotor` of a column `x`, the inputs and design variables, to a column `y`, the answers, and its
//! Jacobian `jac_rotor`. All is SI. Without an answer both return 1, at which a solver of CasADi goes back.

use std::ffi::{CStr, c_char, c_int};
use std::ptr;
use std::slice;

use crate::answers::{Answers, answers, names, variables};

/// CasADi's integer.
type Integer = i64;

#[unsafe(no_mangle)]
extern "C" fn rotor_n_in() -> Integer {
    1
}

#[unsafe(no_mangle)]
extern "C" fn rotor_n_out() -> Integer {
    1
}

fn name(names: &[&'static CStr], k: Integer) -> *const c_char {
    let found = usize::try_from(k).ok().and_then(|k| names.get(k));
    found.map_or(ptr::null(), |name| name.as_ptr())
}

#[unsafe(no_mangle)]
extern "C" fn rotor_name_in(k: Integer) -> *const c_char {
    name(&[c"x"], k)
}

#[unsafe(no_mangle)]
extern "C" fn rotor_name_out(k: Integer) -> *const c_char {
    name(&[c"y"], k)
}

/// A dense matrix: rows, columns, 1. It lives as long as the library.
fn dense(rows: usize, columns: usize) -> *const Integer {
    let pattern: &'static [Integer] = Box::leak(Box::new([rows as Integer, columns as Integer, 1]));
    pattern.as_ptr()
}

#[unsafe(no_mangle)]
extern "C" fn rotor_sparsity_in(k: Integer) -> *const Integer {
    if k == 0 { dense(variables().len(), 1) } else { ptr::null() }
}

#[unsafe(no_mangle)]
extern "C" fn rotor_sparsity_out(k: Integer) -> *const Integer {
    if k == 0 { dense(names().len(), 1) } else { ptr::null() }
}

#[unsafe(no_mangle)]
extern "C" fn jac_rotor_n_in() -> Integer {
    2
}

#[unsafe(no_mangle)]
extern "C" fn jac_rotor_n_out() -> Integer {
    1
}

#[unsafe(no_mangle)]
extern "C" fn jac_rotor_name_in(k: Integer) -> *const c_char {
    name(&[c"x", c"out_y"], k)
}

#[unsafe(no_mangle)]
extern "C" fn jac_rotor_name_out(k: Integer) -> *const c_char {
    name(&[c"jac_y_x"], k)
}

#[unsafe(no_mangle)]
extern "C" fn jac_rotor_sparsity_in(k: Integer) -> *const Integer {
    match k {
        0 => dense(variables().len(), 1),
        1 => dense(names().len(), 1),
        _ => ptr::null(),
    }
}

#[unsafe(no_mangle)]
extern "C" fn jac_rotor_sparsity_out(k: Integer) -> *const Integer {
    if k == 0 { dense(names().len(), variables().len()) } else { ptr::null() }
}

/// The answers at the first argument; a null pointer stands for zeros.
///
/// # Safety
/// As CasADi calls: `arg` has a pointer to as many numbers as there are variables, or null.
unsafe fn at(arg: *const *const f64) -> Option<Answers> {
    let count = variables().len();
    let first = unsafe { *arg };
    let zeros = vec![0.0; count];
    let x = if first.is_null() { &zeros[..] } else { unsafe { slice::from_raw_parts(first, count) } };
    answers(x).ok()
}

/// Writes numbers where somebody asks for them.
///
/// # Safety
/// As CasADi calls: `res` has a pointer to room for them, or null.
unsafe fn write(res: *mut *mut f64, numbers: impl Iterator<Item = f64>) {
    let first = unsafe { *res };
    if !first.is_null() {
        for (k, number) in numbers.enumerate() {
            unsafe { *first.add(k) = number };
        }
    }
}

/// # Safety
/// As CasADi calls.
#[unsafe(no_mangle)]
unsafe extern "C" fn rotor(
    arg: *const *const f64,
    res: *mut *mut f64,
    _: *mut Integer,
    _: *mut f64,
    _: c_int,
) -> c_int {
    let Some(found) = (unsafe { at(arg) }) else { return 1 };
    unsafe { write(res, found.values.into_iter()) };
    0
}

/// # Safety
/// As CasADi calls.
#[unsafe(no_mangle)]
unsafe extern "C" fn jac_rotor(
    arg: *const *const f64,
    res: *mut *mut f64,
    _: *mut Integer,
    _: *mut f64,
    _: c_int,
) -> c_int {
    let Some(found) = (unsafe { at(arg) }) else { return 1 };
    // Column by column.
    let columns = (0..variables().len()).flat_map(|k| found.rows.iter().map(move |row| row[k]));
    unsafe { write(res, columns) };
    0
}
