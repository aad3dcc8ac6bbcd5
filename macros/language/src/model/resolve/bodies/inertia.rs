//! The inertia of a rigid body of any shape.

use super::super::matrices::is_matrix;
use super::super::typed::{Typed, ValueContext};
use super::quantities::Quantities;
use crate::base::dimension::Dimension;
use crate::model::expression::{Expr, Vector};
use crate::model::rules::composite::GivenInertia;
use crate::model::simplify::{add, componentwise, multiply, power_integer, subtract};
use crate::syntax::ast::{Value, ValueKind};

impl Quantities<'_, '_, '_> {
    /// Three moments, or the six entries of the tensor. `about` is optional, as in `place`.
    pub(super) fn inertia(
        &mut self,
        mass: Option<&Expr>,
        center: Option<&Vector>,
        about: Option<&Option<Vector>>,
    ) -> Option<[Expr; 6]> {
        let value = self.arguments.get("inertia")?;
        let tensor = self.tensor(value)?;
        let central = match about {
            None => Some(tensor.clone()),
            Some(about) => match (mass, center, about) {
                (Some(mass), Some(center), Some(about)) => {
                    let arm = componentwise(center.clone(), about.clone(), subtract);
                    Some(about_center(tensor.clone(), mass, &arm))
                }
                // The mistake in its argument has been reported.
                _ => None,
            },
        };
        if let Some(central) = central {
            let what = format!("the inertia of `{}`", self.body);
            self.resolver.require_finite(&central, &what, value.extent);
            self.resolver.given_inertias.push(GivenInertia {
                body: self.body.clone(),
                tensor: tensor.clone(),
                central,
                extent: value.extent,
            });
        }
        Some(tensor)
    }

    fn tensor(&mut self, value: &Value) -> Option<[Expr; 6]> {
        let ValueKind::Vector(entries, unit) = &value.bare().kind else {
            return self.moments(value);
        };
        if is_matrix(entries) {
            self.resolver.diagnostics.error_with_help(
                value.extent,
                "an inertia is a list of 3 or 6 entries, not a matrix",
                "write `[Jxx, Jyy, Jzz, Jxy, Jyz, Jxz] kg*m^2`, every entry with the sign it has in the matrix",
            );
            return None;
        }
        if entries.len() != 3 && entries.len() != 6 {
            return self.wrong_inertia(value);
        }
        let scale = match unit {
            Some(unit) => self.resolver.unit(unit).map(Some),
            None => Some(None),
        };
        let scalars: Vec<_> =
            entries.iter().map(|entry| (entry, self.resolver.scalar(entry, ValueContext::Parameter))).collect();
        let scale = scale?;
        let mut tensor = Vec::new();
        for (entry, scalar) in scalars {
            let resolved = scalar.and_then(|(expr, quantity)| match scale {
                // The unit after the bracket applies to every entry.
                Some((dimension, scale)) => {
                    let product = quantity.dimension().times(dimension);
                    let quantity = self.resolver.in_range(product, value.extent)?;
                    self.resolver.expect(quantity, Dimension::INERTIA, "`inertia`", value)?;
                    Some(multiply(Expr::Number(scale), expr))
                }
                None => {
                    self.resolver.expect(quantity, Dimension::INERTIA, "an entry of `inertia`", entry)?;
                    Some(expr)
                }
            });
            match resolved {
                Some(expr) => tensor.push(expr),
                // One wrong unit after the bracket is one mistake.
                None if scale.is_some() => return None,
                None => {}
            }
        }
        if tensor.len() != entries.len() {
            return None;
        }
        tensor.resize(6, Expr::Number(0.0));
        tensor.try_into().ok()
    }

    /// The moments of inertia about the axes, by an expression.
    fn moments(&mut self, value: &Value) -> Option<[Expr; 6]> {
        let Typed::Vector([x, y, z], quantity) = self.resolver.value(value, ValueContext::Parameter)? else {
            return self.wrong_inertia(value);
        };
        self.resolver.expect(quantity, Dimension::INERTIA, "`inertia`", value)?;
        let none = Expr::Number(0.0);
        Some([x, y, z, none.clone(), none.clone(), none])
    }

    fn wrong_inertia(&mut self, value: &Value) -> Option<[Expr; 6]> {
        self.resolver.diagnostics.error_with_help(
            value.extent,
            "an inertia has 3 or 6 entries",
            "write `[Jxx, Jyy, Jzz] kg*m^2` or `[Jxx, Jyy, Jzz, Jxy, Jyz, Jxz] kg*m^2`",
        );
        None
    }
}

/// `J - m (d^2 I - d d^T)`, with `d` from the point of reference to the centre of mass (Steiner).
fn about_center(inertia: [Expr; 6], mass: &Expr, arm: &Vector) -> [Expr; 6] {
    let [x, y, z] = arm.clone();
    let [xx, yy, zz] = arm.clone().map(|component| power_integer(component, 2));
    let off = |a: &Expr, b: &Expr| multiply(Expr::Number(-1.0), multiply(a.clone(), b.clone()));
    let shifts = [add(yy.clone(), zz.clone()), add(zz, xx.clone()), add(xx, yy), off(&x, &y), off(&y, &z), off(&x, &z)];
    let mut shifts = shifts.into_iter();
    inertia.map(|entry| match shifts.next() {
        Some(shift) => subtract(entry, multiply(mass.clone(), shift)),
        None => entry,
    })
}
