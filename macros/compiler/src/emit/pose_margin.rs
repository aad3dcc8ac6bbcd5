//! The distance from singular poses.

use std::fmt::Write;

use crate::mechanics::Pose;
use crate::program::Kernel;

use super::body::Body;
use super::signature::signature;

/// `fn pose_margin`: the joint or beam with the smallest margin beyond the least.
pub(super) fn method(kernel: &Kernel, poses: &[Pose]) -> String {
    let body = Body::new(kernel);
    let mut text = signature(kernel, "::core::option::Option<::eigentol::PoseMargin<T>>", " + ::core::cmp::PartialOrd");
    if poses.is_empty() {
        text += "{ ::core::option::Option::None }\n";
        return text;
    }
    let _ = writeln!(text, "{{\n{}", body.statements());
    let _ = writeln!(
        text,
        "let mut least_: ::core::option::Option<::eigentol::PoseMargin<T>> = ::core::option::Option::None;"
    );
    for (pose, &margin) in poses.iter().zip(&kernel.results[0].values) {
        let _ = writeln!(
            text,
            "{{
                let (signed_, allowed_) = ({}, T::constant({:?}));
                let margin_ = if signed_ < T::constant(0.0) {{ -signed_ }} else {{ signed_ }};
                let smaller_ = match &least_ {{
                    ::core::option::Option::Some(known_) => margin_ - allowed_ < known_.margin - known_.least,
                    ::core::option::Option::None => true,
                }};
                if smaller_ {{
                    least_ = ::core::option::Option::Some(::eigentol::PoseMargin {{ joint: ::eigentol::Shared::Static({:?}), margin: margin_, least: allowed_ }});
                }}
            }}",
            body.text(margin).text,
            pose.least,
            pose.joint,
        );
    }
    let _ = writeln!(text, "least_\n}}");
    text
}
