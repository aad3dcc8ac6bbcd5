//! Matrices by columns.

use crate::algebra::{ExprId, Graph};
use crate::census::taken;
use crate::mechanics::setup::{Context, Mirrored, mirrored};

/// A matrix: `columns[j][i]` is row `i` of column `j`.
pub(super) type Columns = Vec<Vec<ExprId>>;

/// A matrix with what stands on the side of its diagonal that takes more operations from the other side, if they are equal
/// or opposite: equations of outer coordinates are shorter when differentiated by inner ones than the other way round.
pub(super) fn folded(g: &mut Graph, context: &Context, columns: &Columns, outward: &[usize]) -> Columns {
    let relation = mirrored(g, context, columns);
    taken(|| format!("linearise: {relation:?} across the diagonal"));
    let mut entry = |i: usize, j: usize| {
        let (here, there) = (columns[j][i], columns[i][j]);
        let takes_more = outward[i] <= outward[j] && !g.is(here, 0.0) || g.is(there, 0.0);
        match relation {
            Mirrored::Equal if takes_more => there,
            Mirrored::Opposite if takes_more && i != j => g.neg(there),
            _ => here,
        }
    };
    let n = columns.len();
    (0..n).map(|j| (0..n).map(|i| entry(i, j)).collect()).collect()
}
