//! Inputs and design variables: units as the user gives them, nominal values and tolerances in SI.

use super::expected::Expected;
use super::nominal::Nominal;
use super::resolver::Resolver;
use super::typed::{Quantity, ValueContext};
use crate::base::dimension::Dimension;
use crate::model::expression::Expr;
use crate::model::mechanism::{DesignVariable, Input, Tolerance, Unit};
use crate::model::rules::physical::DesignPoint;
use crate::syntax::ast::{self, ItemKind, Value, ValueKind};
use crate::syntax::print;

impl Resolver<'_> {
    pub(super) fn inputs(&mut self) -> Vec<Input> {
        let mut inputs = Vec::new();
        for item in &self.ast.items {
            let ItemKind::Input(input) = &item.kind else {
                continue;
            };
            let (dimension, unit) = self.declared_unit(&input.unit);
            let expected = dimension.map(|dimension| Expected::in_unit(dimension, &unit.symbol));
            let tolerance = self.input_tolerance(input.tolerance.as_ref(), expected);
            self.inputs.push(dimension);
            inputs.push(Input {
                name: input.name.clone(),
                docs: item.docs.clone(),
                unit,
                tolerance: tolerance.unwrap_or(Tolerance::NONE),
                is_used: false,
            });
        }
        inputs
    }

    /// The dimension of a unit that a declaration gives, if it is known, and the unit.
    pub(super) fn declared_unit(&mut self, unit: &ast::Unit) -> (Option<Dimension>, Unit) {
        let resolved = self.unit(unit);
        let symbol = match &unit.factors[..] {
            [] => String::new(),
            _ => print::unit(unit),
        };
        let scale = resolved.map_or(1.0, |(_, scale)| scale);
        (resolved.map(|(dimension, _)| dimension), Unit { symbol, scale })
    }

    pub(super) fn design_variables(&mut self) -> Vec<DesignVariable> {
        let mut variables = Vec::new();
        for item in &self.ast.items {
            let ItemKind::Design(design) = &item.kind else {
                continue;
            };
            let nominal = self.nominal(design);
            self.design.push(nominal.clone());
            if let Some(nominal) = nominal {
                variables.push(DesignVariable {
                    name: design.name.clone(),
                    docs: item.docs.clone(),
                    unit: self.display_unit(&design.nominal, nominal.dimension),
                    nominal: nominal.value,
                    tolerance: nominal.tolerance,
                    is_used: false,
                });
            }
        }
        variables
    }

    /// Nominal value and tolerance of every design variable; NaN if it is wrong.
    pub(super) fn design_points(&self) -> Vec<DesignPoint> {
        let named = self.ast.all::<ast::Design>().map(|design| design.name.to_string());
        let points = self.design.iter().zip(named).map(|(nominal, name)| match nominal {
            Some(nominal) => DesignPoint {
                name,
                nominal: nominal.value,
                limits: [nominal.tolerance.lower, nominal.tolerance.upper],
                extent: nominal.tolerance_extent,
            },
            None => DesignPoint { name, nominal: f64::NAN, limits: [0.0; 2], extent: None },
        });
        points.collect()
    }

    fn nominal(&mut self, design: &ast::Design) -> Option<Nominal> {
        let nominal = self.plain_number(&design.nominal);
        let nominal = nominal.map(|(value, quantity)| (value, quantity.dimension()));
        let expected = nominal.map(|(value, dimension)| {
            let unit = self.display_unit(&design.nominal, dimension);
            (value, Expected::in_unit(dimension, &unit.symbol))
        });
        let tolerance = self.design_tolerance(design.tolerance.as_ref(), expected);
        let (value, dimension) = nominal?;
        self.note_length(value, dimension);
        Some(Nominal {
            dimension,
            value,
            tolerance: tolerance?,
            tolerance_extent: design.tolerance.as_ref().map(|tolerance| tolerance.extent),
        })
    }

    /// A value made of numbers only.
    pub(super) fn plain_number(&mut self, value: &Value) -> Option<(f64, Quantity)> {
        let (expr, quantity) = self.scalar(value, ValueContext::Nominal)?;
        match expr {
            Expr::Number(number) => Some((number, quantity)),
            // No name except `pi` is allowed, and numbers are combined immediately.
            _ => None,
        }
    }

    /// The unit of a number as written; the SI unit of a computed value.
    pub(super) fn display_unit(&mut self, value: &Value, dimension: Dimension) -> Unit {
        let mut number = value.bare();
        while let ValueKind::Negate(operand) = &number.kind {
            number = operand.bare();
        }
        match &number.kind {
            ValueKind::Number(_, Some(unit)) => {
                Unit { symbol: print::unit(unit), scale: self.unit(unit).map_or(1.0, |(_, scale)| scale) }
            }
            _ => Unit::si(dimension),
        }
    }
}
