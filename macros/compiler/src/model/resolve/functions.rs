//! Functions: elementary ones, those of vectors, and those of positions that only outputs may use.

use proc_macro2::Ident;

use super::Resolver;
use super::typed::{Place, Quantity, Typed};
use crate::base::dimension::Dimension;
use crate::base::nearest::nearest;
use crate::model::expression::{Expr, Function, Vector};
use crate::model::simplify;
use crate::syntax::ast::{Value, ValueKind};

/// Every function with its arguments.
const SIGNATURES: [(&str, &[&str]); 16] = [
    ("sqrt", &["x"]),
    ("sin", &["angle"]),
    ("cos", &["angle"]),
    ("tan", &["angle"]),
    ("asin", &["x"]),
    ("acos", &["x"]),
    ("atan", &["x"]),
    ("atan2", &["y", "x"]),
    ("exp", &["x"]),
    ("ln", &["x"]),
    ("norm", &["vector"]),
    ("dot", &["a", "b"]),
    ("cross", &["a", "b"]),
    ("position", &["point"]),
    ("distance", &["point", "point"]),
    ("distance_from_axis", &["point", "direction"]),
];

const OF_POSITIONS: [&str; 3] = ["position", "distance", "distance_from_axis"];

impl Resolver<'_> {
    pub(super) fn call(
        &mut self,
        function: &Ident,
        arguments: &[Value],
        place: Place,
    ) -> Option<Typed> {
        let name = function.to_string();
        let known = SIGNATURES.iter().find(|(known, _)| *known == name);
        let Some((_, parameters)) = known else {
            let help = nearest(&name, SIGNATURES.iter().map(|(known, _)| *known))
                .map(|near| format!("did you mean `{near}`?"));
            self.report(function, format!("unknown function `{name}`"), help);
            return None;
        };
        if arguments.len() != parameters.len() {
            let message = format!(
                "`{name}` takes {}, not {}",
                count(parameters.len()),
                arguments.len()
            );
            let help = format!("write `{name}({})`", parameters.join(", "));
            self.diagnostics.error_with_help(function, message, help);
            return None;
        }
        if OF_POSITIONS.contains(&name.as_str()) && place != Place::Output {
            self.diagnostics.error(
                function,
                format!("`{name}` depends on the motion; only an output may use it"),
            );
            return None;
        }
        let result = match (name.as_str(), arguments) {
            ("norm", [a]) => {
                let (a, quantity) = self.vector(a, place)?;
                Typed::Scalar(simplify::norm(&a), quantity)
            }
            ("dot" | "cross", [a, b]) => {
                let (a, b) = (self.vector(a, place), self.vector(b, place));
                let ((a, of_a), (b, of_b)) = (a?, b?);
                let product = of_a.dimension().times(of_b.dimension());
                let quantity = self.in_range(product, function.into())?;
                if name == "dot" {
                    Typed::Scalar(simplify::dot(&a, &b), quantity)
                } else {
                    Typed::Vector(simplify::cross(&a, &b), quantity)
                }
            }
            ("atan2", [y, x]) => {
                let (above, right) = (self.scalar(y, place), self.scalar(x, place));
                let ((above, of_y), (right, of_x)) = (above?, right?);
                let Some(_) = of_y.unify(of_x) else {
                    let message = format!(
                        "the arguments of `atan2` have one dimension: the first is {}, this is {}",
                        of_y.dimension().describe(),
                        of_x.dimension().describe()
                    );
                    let help = self.swallowed(x, of_x.dimension(), of_y.dimension());
                    self.report(x.extent, message, help);
                    return None;
                };
                Typed::Scalar(simplify::atan2(above, right), Quantity::Of(Dimension::NONE))
            }
            ("position", [point]) => {
                Typed::Vector(self.position_of(point)?, Quantity::Of(Dimension::LENGTH))
            }
            ("distance", [from, to]) => {
                let (from, to) = (self.position_of(from), self.position_of(to));
                let apart = simplify::componentwise(to?, from?, simplify::subtract);
                Typed::Scalar(simplify::norm(&apart), Quantity::Of(Dimension::LENGTH))
            }
            ("distance_from_axis", [point, axis]) => {
                let (point, axis) = (self.position_of(point), self.direction(axis, place));
                let arm = simplify::cross(&axis?, &point?);
                Typed::Scalar(simplify::norm(&arm), Quantity::Of(Dimension::LENGTH))
            }
            (_, [argument]) => self.elementary(&name, argument, place)?,
            // The number of arguments has been checked.
            _ => return None,
        };
        self.finite(result, function.into())
    }

    fn elementary(&mut self, name: &str, argument: &Value, place: Place) -> Option<Typed> {
        let (expr, quantity) = self.scalar(argument, place)?;
        if name == "sqrt" {
            let half = self.in_range(quantity.dimension().power(1, 2), argument.extent)?;
            return Some(Typed::Scalar(simplify::call(Function::Sqrt, expr), half));
        }
        let what = format!("the argument of `{name}`");
        self.expect(quantity, Dimension::NONE, &what, argument)?;
        let function = match name {
            "sin" => Function::Sin,
            "cos" => Function::Cos,
            "tan" => Function::Tan,
            "asin" => Function::Asin,
            "acos" => Function::Acos,
            "exp" => Function::Exp,
            "ln" => Function::Ln,
            // atan(x) = atan2(x, 1).
            _ => {
                let angle = simplify::atan2(expr, Expr::Number(1.0));
                return Some(Typed::Scalar(angle, Quantity::Of(Dimension::NONE)));
            }
        };
        let result = simplify::call(function, expr);
        Some(Typed::Scalar(result, Quantity::Of(Dimension::NONE)))
    }

    fn position_of(&mut self, point: &Value) -> Option<Vector> {
        let ValueKind::Name(name) = &point.bare().kind else {
            self.diagnostics
                .error(point.extent, "the name of a point is expected here");
            return None;
        };
        let point = self.point_named(name)?;
        Some([0, 1, 2].map(|axis| Expr::Position(point, axis)))
    }
}

fn count(parameters: usize) -> String {
    match parameters {
        1 => "1 argument".to_string(),
        more => format!("{more} arguments"),
    }
}
