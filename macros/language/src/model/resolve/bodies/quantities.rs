//! The arguments of a shape as quantities: each must have the right dimension and a value that is possible for a real
//! part.

use super::super::arguments::Arguments;
use super::super::resolver::Resolver;
use super::super::typed::ValueContext;
use crate::base::dimension::Dimension;
use crate::model::expression::{Expr, Vector};
use crate::model::rules::physical::Demand;
use crate::model::simplify;
use crate::syntax::ast::Value;

/// The arguments of one shape during resolution.
pub(in crate::model::resolve) struct Quantities<'a, 'b, 'c> {
    pub(super) resolver: &'a mut Resolver<'b>,
    pub(super) arguments: Arguments<'c>,
    pub(super) body: String,
}

impl<'a, 'b, 'c> Quantities<'a, 'b, 'c> {
    /// The arguments of a shape of a body.
    pub(super) fn new(resolver: &'a mut Resolver<'b>, arguments: Arguments<'c>, body: &str) -> Self {
        Self { resolver, arguments, body: body.to_string() }
    }

    pub(super) fn require(&mut self, what: &str, values: Vec<Expr>, demand: Demand, at: &Value) {
        self.resolver.require(format!("the {what} of `{}`", self.body), values, demand, at.extent);
    }

    fn positive(&mut self, name: &str, words: &str, dimension: Dimension) -> Option<Expr> {
        let value = self.arguments.get(name)?;
        let what = format!("`{name}`");
        let expr = self.resolver.scalar_of(value, dimension, &what)?;
        let demand = Demand::Positive(dimension);
        self.require(words, vec![expr.clone()], demand, value);
        Some(expr)
    }

    pub(super) fn mass(&mut self) -> Option<Expr> {
        self.positive("mass", "mass", Dimension::MASS)
    }

    /// The given mass, or a density times the length, area or volume that it refers to.
    pub(super) fn mass_or_density(
        &mut self,
        density: Dimension,
        extent: impl FnOnce() -> Option<Expr>,
    ) -> Option<Expr> {
        let mass = self.mass();
        if self.arguments.get("density").is_none() {
            return mass;
        }
        let density = self.positive("density", "density", density);
        Some(simplify::multiply(density?, extent()?))
    }

    pub(super) fn length(&mut self, name: &str) -> Option<Expr> {
        let words = match name {
            "inner" => "inner radius",
            "outer" => "outer radius",
            name => name,
        };
        self.positive(name, words, Dimension::LENGTH)
    }

    /// Requires the bore of a tube to leave a wall.
    pub(super) fn inner_below_outer(&mut self, inner: Option<&Expr>, outer: Option<&Expr>) {
        if let (Some(inner), Some(outer), Some(value)) = (inner, outer, self.arguments.get("inner")) {
            let radii = vec![inner.clone(), outer.clone()];
            self.require("inner radius", radii, Demand::BelowOuter, value);
        }
    }

    pub(super) fn direction(&mut self, name: &str) -> Option<Vector> {
        let value = self.arguments.get(name)?;
        self.resolver.direction(value, ValueContext::Parameter)
    }

    pub(super) fn size(&mut self) -> Option<Vector> {
        let value = self.arguments.get("size")?;
        let (size, quantity) = self.resolver.vector(value, ValueContext::Parameter)?;
        self.resolver.expect(quantity, Dimension::LENGTH, "`size`", value)?;
        let demand = Demand::Positive(Dimension::LENGTH);
        self.require("size", size.to_vec(), demand, value);
        Some(size)
    }

    /// A position: `None` if not given, with an inner `None` if wrong.
    pub(super) fn place(&mut self, name: &str) -> Option<Option<Vector>> {
        let value = self.arguments.get(name)?;
        Some(self.resolver.position(value, &format!("`{name}`")))
    }

    /// The given centre of mass, or the default.
    pub(super) fn center(&mut self, default: impl FnOnce() -> Option<Vector>) -> Option<Vector> {
        self.place("center").unwrap_or_else(default)
    }
}
