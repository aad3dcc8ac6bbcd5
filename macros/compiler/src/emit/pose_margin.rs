//! The distance from singular poses.

use std::fmt::Write;

use crate::mechanics::Pose;
use crate::program::Kernel;

use super::body::Body;
use super::contract::signature;

/// `fn pose_margin`: the joint whose three axes span the smallest volume.
pub(super) fn method(kernel: &Kernel, poses: &[Pose]) -> String {
    let body = Body::new(kernel);
    let mut text = signature(
        kernel,
        "::core::option::Option<::eigentol::PoseMargin<T>>",
        " + ::core::cmp::PartialOrd",
    );
    let _ = writeln!(text, "{{\n{}", body.statements());
    let _ = writeln!(
        text,
        "let mut least: ::core::option::Option<::eigentol::PoseMargin<T>> = ::core::option::Option::None;"
    );
    for (pose, &volume) in poses.iter().zip(&kernel.results[0].values) {
        let _ = writeln!(
            text,
            "{{
                let volume = {};
                let margin = if volume < T::constant(0.0) {{ -volume }} else {{ volume }};
                let smaller = match least {{
                    ::core::option::Option::Some(known) => margin < known.margin,
                    ::core::option::Option::None => true,
                }};
                if smaller {{
                    least = ::core::option::Option::Some(::eigentol::PoseMargin {{ joint: {:?}, margin }});
                }}
            }}",
            body.text(volume).text,
            pose.joint,
        );
    }
    let _ = writeln!(text, "least\n}}");
    text
}
