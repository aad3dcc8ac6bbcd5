//! Tolerances, for the runtime and in words for the documentation.

use proc_macro2::TokenStream;
use quote::quote;

use crate::model::mechanism::{Law, Tolerance};

/// A `ToleranceInfo`.
pub(super) fn info(tolerance: &Tolerance) -> TokenStream {
    let Tolerance { lower, upper, relative, law } = tolerance;
    if !tolerance.varies() {
        return quote!(::eigentol::ToleranceInfo::NONE);
    }
    if tolerance.is_symmetric() && !relative && *law == Law::Normal {
        return quote!(::eigentol::ToleranceInfo::half_width(#upper));
    }
    let law = match law {
        Law::Normal => quote!(Normal),
        Law::TruncatedNormal => quote!(TruncatedNormal),
        Law::Uniform => quote!(Uniform),
        Law::Triangular => quote!(Triangular),
        Law::Lognormal => quote!(Lognormal),
        Law::Weibull => quote!(Weibull),
        Law::Beta { alpha, beta } => quote!(Beta { alpha: #alpha, beta: #beta }),
        Law::OneOf(values) => {
            let values = values.iter().map(|(fraction, weight)| quote!((#fraction, #weight)));
            quote!(OneOf(::eigentol::List::Static(&[#(#values),*])))
        }
    };
    quote! {
        ::eigentol::ToleranceInfo { lower: #lower, upper: #upper, relative: #relative, law: ::eigentol::Law::#law }
    }
}

/// Drops the last digits, which unit conversions and percentages have spoiled.
fn rounded(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

/// The text after the value: ", tolerance 0.1 mm either way, uniform"; empty if the value does not vary.
pub(super) fn doc(tolerance: &Tolerance, unit: &str, scale: f64) -> String {
    if !tolerance.varies() {
        return String::new();
    }
    let (unit, scale) = if tolerance.relative { ("%", 0.01) } else { (unit, scale) };
    let [lower, upper] = [tolerance.lower, tolerance.upper].map(|limit| rounded(limit / scale));
    let mut text = if tolerance.is_symmetric() {
        format!(", tolerance {upper} {unit} either way")
    } else {
        format!(", tolerance {upper:+} {lower:+} {unit}")
    };
    if tolerance.law != Law::Normal {
        text += &format!(", {}", tolerance.law);
    }
    text
}
