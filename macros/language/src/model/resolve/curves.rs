//! Curves through points: their points and their arguments.

use proc_macro2::Ident;

use super::functions::{count, is_function};
use super::lists::Listed;
use super::resolver::Resolver;
use super::typed::{Quantity, Typed, ValueContext};
use super::values::{DECIMAL_POINT, decimal_commas};
use crate::model::expression::{Expr, Function};
use crate::model::mechanism::{Curve, CurveArgument};
use crate::model::rules::physical::Demand;
use crate::model::simplify;
use crate::syntax::ast::{self, Value, ValueKind};
use eigentol_symbolic::base::spline::Spline;

impl Resolver<'_> {
    pub(super) fn curves(&mut self) {
        for declared in self.ast.all() {
            let curve = self.curve(declared);
            self.curves.push(curve);
        }
    }

    fn curve(&mut self, declared: &ast::Curve) -> Option<Curve> {
        let ast::Curve { name, arguments, values } = declared;
        let text = name.to_string();
        if is_function(&text) {
            let message = format!("`{text}` is a function already; a curve needs another name");
            self.diagnostics.error(name, message);
        }
        let (x, y) = (self.listed(arguments, ValueContext::Points), self.listed(values, ValueContext::Points));
        let (Listed { numbers: x, quantity: argument, unit }, Listed { numbers: y, quantity: value, .. }) = (x?, y?);
        if x.len() != y.len() {
            let message = format!("each argument has a value: there are {} arguments and {} values", x.len(), y.len());
            let commas = y.len() > x.len() && elements(values).is_some_and(decimal_commas);
            return self.refuse_with(values.extent, message, commas.then(|| DECIMAL_POINT.into()));
        }
        if x.len() < 2 {
            let message = "a curve goes through at least two points";
            return self.refuse(arguments.extent, message);
        }
        if let Some(k) = (1..x.len()).find(|&k| x[k] <= x[k - 1]) {
            let at = elements(arguments)?[k].extent;
            let message = "the arguments of a curve grow: this one is not greater than the one before";
            return self.refuse(at, message);
        }
        let spline = Spline::through(&text, &x, &y);
        if !spline.pieces().as_flattened().iter().all(|c| c.is_finite()) {
            let message = "this curve is outside the range of a 64-bit number";
            return self.refuse(values.extent, message);
        }
        Some(Curve { spline, argument: argument.dimension(), unit, value: value.dimension() })
    }

    /// The value of a curve. An argument that does not depend on the motion must lie between the first and the last
    /// point.
    pub(super) fn curve_at(
        &mut self,
        index: usize,
        name: &Ident,
        arguments: &[Value],
        value_context: ValueContext,
    ) -> Option<Typed> {
        let curve = self.curves.get(index)?.clone()?;
        let [given] = arguments else {
            let message = format!("`{name}` takes {}, not {}", count(1), arguments.len());
            let help = (arguments.len() > 1 && decimal_commas(arguments)).then(|| DECIMAL_POINT.into());
            return self.refuse_with(name, message, help);
        };
        let (argument, quantity) = self.scalar(given, value_context)?;
        let what = format!("the argument of `{name}`");
        self.expect(quantity, curve.argument, &what, given)?;
        if is_known_before_the_motion(&argument) {
            self.require(what, [argument.clone()], Demand::OnCurve(curve.clone()), given.extent);
            let asked = CurveArgument { curve: curve.clone(), argument: argument.clone() };
            if !self.curve_arguments.contains(&asked) {
                self.curve_arguments.push(asked);
            }
        }
        let value = match argument {
            Expr::Number(number) => Expr::Number(curve.spline.at(number, 0)),
            argument => simplify::call(Function::Spline(curve.spline, 0), argument),
        };
        Some(Typed::Scalar(value, Quantity::Of(curve.value)))
    }
}

/// The values of a list in brackets.
fn elements(list: &Value) -> Option<&[Value]> {
    match &list.bare().kind {
        ValueKind::Vector(elements, _) => Some(elements),
        _ => None,
    }
}

/// Whether the argument consists only of numbers, inputs, design variables and constants.
fn is_known_before_the_motion(argument: &Expr) -> bool {
    let is_known = |leaf: &Expr| matches!(leaf, Expr::Number(_) | Expr::Input(_) | Expr::Design(_) | Expr::Constant(_));
    argument.leaves().into_iter().all(is_known)
}
