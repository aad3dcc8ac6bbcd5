//! Matrices: three rows in brackets.

use super::expected::Expected;
use super::resolver::Resolver;
use super::typed::{Quantity, Typed, ValueContext};
use crate::base::span::Extent;
use crate::model::expression::{Matrix, Vector};
use crate::model::simplify;
use crate::syntax::ast::{Unit, Value, ValueKind};

impl Resolver<'_> {
    pub(super) fn matrix_literal(
        &mut self,
        rows: &[Value],
        unit: Option<&Unit>,
        extent: Extent,
        value_context: ValueContext,
    ) -> Option<Typed> {
        let unit = self.optional_unit(unit);
        if rows.len() != 3 {
            let message = format!("a matrix has 3 rows, this one has {}", rows.len());
            return self.refuse_with_help(extent, message, "write `[[a, b, c], [d, e, f], [g, h, i]]`");
        }
        let resolved: Vec<_> = rows.iter().map(|row| self.row(row, value_context)).collect();
        let resolved: Vec<_> = resolved.into_iter().collect::<Option<_>>()?;
        let (vectors, quantities): (Vec<Vector>, Vec<_>) = resolved.into_iter().unzip();
        let common = self.common_quantity(&quantities, rows, "rows of a matrix")?;
        let mut vectors = vectors.into_iter();
        let matrix: Matrix = [vectors.next()?, vectors.next()?, vectors.next()?];
        self.in_unit(Typed::Matrix(matrix, common), unit?, extent)
    }

    fn row(&mut self, row: &Value, value_context: ValueContext) -> Option<(Vector, Quantity)> {
        if let ValueKind::Vector(entries, _) = &row.bare().kind
            && entries.len() != 3
        {
            let message = format!("a row of a matrix has 3 values, this one has {}", entries.len());
            return self.refuse(row.extent, message);
        }
        self.vector(row, value_context)
    }

    /// A matrix that must have the given dimension; a vector is taken as its diagonal. `what` names its role.
    pub(super) fn matrix_of(&mut self, value: &Value, expected: impl Into<Expected>, what: &str) -> Option<Matrix> {
        let (matrix, quantity) = match self.value(value, ValueContext::Parameter)? {
            Typed::Matrix(matrix, quantity) => (matrix, quantity),
            Typed::Vector(diagonal, quantity) => (simplify::diagonal(diagonal), quantity),
            Typed::Scalar(..) => {
                return self.refuse_with_help(
                    value.extent,
                    "a vector or a matrix is expected here, this is a number",
                    "a vector `[a, b, c] N/m` holds the values along the axes",
                );
            }
        };
        self.expect(quantity, expected, what, value)?;
        self.require_finite(matrix.as_flattened(), what, value.extent);
        Some(matrix)
    }
}

/// Whether brackets contain brackets.
pub(super) fn is_matrix(components: &[Value]) -> bool {
    components.iter().any(|row: &Value| matches!(row.bare().kind, ValueKind::Vector(..)))
}
