//! Functions that are not purely numerical kernels.

use std::fmt::Write;

use eigentol_compiler::Compilation;

use super::Names;

/// Nominal values, requirements and singular poses.
pub(super) fn functions(compilation: &Compilation, names: &Names) -> String {
    let mut text = nominal(compilation, names) + &violation(compilation, names);
    if !compilation.functions.poses.is_empty() {
        text += &pose_margin(compilation, names);
    }
    text
}

fn nominal(compilation: &Compilation, names: &Names) -> String {
    let design = &compilation.mechanism.design;
    let values: Vec<String> = design.iter().map(|d| format!("{:?}", d.nominal)).collect();
    let (prefix, count) = (&names.prefix, values.len());
    format!(
        "/// Nominal values of the design variables, SI.\n///\n/// Writes `b[{count}]`.
#[unsafe(no_mangle)]
pub unsafe extern \"C\" fn {prefix}_nominal(b: *mut f64) -> i32 {{
    let null = first_null(&[(1, b.cast_const(), {count})]);
    if null == 0 {{
        // SAFETY: it is not null, and the caller vouches for the length.
        unsafe {{ write(&[{}], b) }}
    }}
    null
}}

",
        values.join(", ")
    )
}

fn violation(compilation: &Compilation, names: &Names) -> String {
    let Names { rust, prefix, .. } = names;
    let mechanism = &compilation.mechanism;
    let (inputs, design) = (mechanism.inputs.len(), mechanism.design.len());
    let mut cases = String::new();
    for requirement in &compilation.functions.requirements {
        let (quantity, wanted) = (&requirement.quantity, requirement.requirement);
        let words = format!("{quantity} has to be {wanted}");
        let _ = writeln!(cases, "        ({quantity:?}, {wanted:?}) => c{words:?}.as_ptr(),");
    }
    format!(
        "/// The first physical requirement that inputs and design variables break, as text that lives for ever, null where there
/// is none: `mass of bar has to be positive`. Ask this before anything else; NaN breaks every requirement.
///
/// Reads `u[{inputs}]`, `b[{design}]`.
/// Writes `violation[1]`.
#[unsafe(no_mangle)]
pub unsafe extern \"C\" fn {prefix}_violation(u: *const f64, b: *const f64, violation: *mut *const ::core::ffi::c_char) -> i32 {{
    let null = first_null(&[(1, u, {inputs}), (2, b, {design}), (3, violation.cast::<f64>().cast_const(), 1)]);
    if null != 0 {{
        return null;
    }}
    // SAFETY: nothing is null, and the caller vouches for the lengths.
    let (u, b) = unsafe {{ (read(u), read(b)) }};
    let found = ::eigentol::Mechanism::violation(&super::{rust}, &u, &b);
    let text = found.as_ref().map_or(::core::ptr::null(), |found| match (&*found.quantity, &*found.requirement) {{
{cases}        _ => c\"a requirement is not met\".as_ptr(),
    }});
    // SAFETY: as above.
    unsafe {{ violation.write(text) }}
    0
}}

"
    )
}

fn pose_margin(compilation: &Compilation, names: &Names) -> String {
    let Names { rust, prefix, .. } = names;
    let n = compilation.functions.unknowns.len();
    let mechanism = &compilation.mechanism;
    let (inputs, design) = (mechanism.inputs.len(), mechanism.design.len());
    format!(
        "/// How far the nearest joint of three turns is from the pose in which its coordinates fail: one when its axes are
/// perpendicular, zero in that pose.
///
/// Reads `q[{n}]`, `u[{inputs}]`, `b[{design}]`.
/// Writes `margin[1]`.
#[unsafe(no_mangle)]
pub unsafe extern \"C\" fn {prefix}_pose_margin(q: *const f64, u: *const f64, b: *const f64, margin: *mut f64) -> i32 {{
    let null = first_null(&[(1, q, {n}), (2, u, {inputs}), (3, b, {design}), (4, margin.cast_const(), 1)]);
    if null != 0 {{
        return null;
    }}
    // SAFETY: nothing is null, and the caller vouches for the lengths.
    unsafe {{
        let nearest = ::eigentol::Mechanism::pose_margin(&super::{rust}, &read(q), &read(u), &read(b));
        write(&[nearest.map_or(1.0, |nearest| nearest.margin)], margin);
    }}
    0
}}

"
    )
}
