//! The check of physical requirements.

use std::fmt::Write;

use crate::mechanics::Requirement;
use crate::program::Kernel;

use super::body::Body;
use super::signature::signature;

/// `fn violation`: the first requirement whose value is not positive.
pub(super) fn method(kernel: &Kernel, requirements: &[Requirement]) -> String {
    let body = Body::new(kernel);
    let mut text = signature(kernel, "::core::option::Option<::eigentol::Violation<T>>", " + ::core::cmp::PartialOrd");
    let _ = writeln!(text, "{{\n{}", body.statements());
    for (requirement, &value) in requirements.iter().zip(&kernel.results[0].values) {
        let _ = writeln!(
            text,
            "{{
                let value_ = {};
                if !(value_ > T::constant(0.0)) {{
                    return ::core::option::Option::Some(::eigentol::Violation {{
                        quantity: ::eigentol::Shared::Static({:?}), requirement: ::eigentol::Shared::Static({:?}), value: value_,
                    }});
                }}
            }}",
            body.text(value).text,
            requirement.quantity,
            requirement.requirement,
        );
    }
    let _ = writeln!(text, "::core::option::Option::None\n}}");
    text
}
