//! Inputs and design variables: units as the user gives them, nominal values and tolerances in SI.

use super::nominal::Nominal;
use super::resolver::Resolver;
use super::typed::Place;
use crate::base::dimension::Dimension;
use crate::base::span::Extent;
use crate::model::expression::Expr;
use crate::model::mechanism::{DesignVariable, Input, Unit};
use crate::model::rules::physical::DesignPoint;
use crate::syntax::ast::{self, ItemKind, ToleranceKind, Value, ValueKind};
use crate::syntax::print;

impl Resolver<'_> {
    pub(super) fn inputs(&mut self) -> Vec<Input> {
        let mut inputs = Vec::new();
        for item in &self.ast.items {
            let ItemKind::Input(input) = &item.kind else {
                continue;
            };
            let resolved = self.unit(&input.unit);
            self.inputs.push(resolved.map(|(dimension, _)| dimension));
            inputs.push(Input {
                name: input.name.clone(),
                docs: item.docs.clone(),
                unit: Unit {
                    symbol: print::unit(&input.unit),
                    scale: resolved.map_or(1.0, |(_, scale)| scale),
                },
            });
        }
        inputs
    }

    pub(super) fn design_variables(&mut self) -> Vec<DesignVariable> {
        let mut variables = Vec::new();
        for item in &self.ast.items {
            let ItemKind::Design(design) = &item.kind else {
                continue;
            };
            let nominal = self.nominal(design);
            self.design.push(nominal);
            self.used_design.push(false);
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

    /// Every design variable's nominal value and tolerance; NaN where it is wrong.
    pub(super) fn design_points(&self) -> Vec<DesignPoint> {
        let named = self.ast.items.iter().filter_map(|item| match &item.kind {
            ItemKind::Design(design) => Some(design.name.to_string()),
            _ => None,
        });
        let points = self
            .design
            .iter()
            .zip(named)
            .map(|(nominal, name)| match nominal {
                Some(nominal) => DesignPoint {
                    name,
                    nominal: nominal.value,
                    tolerance: nominal.tolerance,
                    extent: nominal.tolerance_extent,
                },
                None => DesignPoint {
                    name,
                    nominal: f64::NAN,
                    tolerance: 0.0,
                    extent: None,
                },
            });
        points.collect()
    }

    fn nominal(&mut self, design: &ast::Design) -> Option<Nominal> {
        let nominal = self.plain_number(&design.nominal);
        let tolerance = match &design.tolerance {
            None => Some(0.0),
            Some(tolerance) => match &tolerance.kind {
                ToleranceKind::Relative(percent) => {
                    self.relative(*percent, nominal.map(|(value, _)| value), tolerance.extent)
                }
                ToleranceKind::Absolute(width) => {
                    self.absolute(width, nominal.map(|(_, dimension)| dimension))
                }
            },
        };
        let (value, dimension) = nominal?;
        Some(Nominal {
            dimension,
            value,
            tolerance: tolerance?,
            tolerance_extent: design.tolerance.as_ref().map(|tolerance| tolerance.extent),
        })
    }

    /// A value made of numbers only.
    fn plain_number(&mut self, value: &Value) -> Option<(f64, Dimension)> {
        let (expr, quantity) = self.scalar(value, Place::Nominal)?;
        match expr {
            Expr::Number(number) => Some((number, quantity.dimension())),
            // No name but `pi` is allowed, and numbers are combined at once.
            _ => None,
        }
    }

    fn relative(&mut self, percent: f64, nominal: Option<f64>, extent: Extent) -> Option<f64> {
        self.not_negative(percent, extent)?;
        let nominal = nominal?;
        if nominal == 0.0 {
            self.diagnostics.error_with_help(
                extent,
                "a percentage of a nominal value of zero is zero",
                "give an absolute tolerance, such as `+/- 1 mm`",
            );
            return None;
        }
        Some(nominal.abs() * (percent / 100.0))
    }

    fn absolute(&mut self, width: &Value, nominal: Option<Dimension>) -> Option<f64> {
        let (expr, quantity) = self.scalar(width, Place::Nominal)?;
        let nominal = nominal?;
        self.expect(quantity, nominal, "this tolerance", width)?;
        let Expr::Number(tolerance) = expr else {
            return None;
        };
        self.not_negative(tolerance, width.extent)?;
        Some(tolerance)
    }

    /// A half-width has no sign.
    fn not_negative(&mut self, tolerance: f64, extent: Extent) -> Option<()> {
        if tolerance < 0.0 {
            let message = "a tolerance is a half-width and cannot be negative";
            self.diagnostics.error(extent, message);
            return None;
        }
        Some(())
    }

    /// The unit of the number as written, SI for a computed one.
    fn display_unit(&mut self, value: &Value, dimension: Dimension) -> Unit {
        let mut number = value.bare();
        while let ValueKind::Negate(operand) = &number.kind {
            number = operand.bare();
        }
        match &number.kind {
            ValueKind::Number(_, Some(unit)) => Unit {
                symbol: print::unit(unit),
                scale: self.unit(unit).map_or(1.0, |(_, scale)| scale),
            },
            _ => Unit {
                symbol: dimension.si_symbol(),
                scale: 1.0,
            },
        }
    }
}
