//! The stiffness of a section as a matrix, as VABS and BECAS write it.

use super::super::resolver::Resolver;
use super::super::typed::ValueContext;
use crate::base::dimension::Dimension;
use crate::model::expression::Expr;
use crate::syntax::ast::{Value, ValueKind};

/// Where the rows of a matrix are in the order of [`Section::coupling`](crate::model::mechanism::Section): stretch, shear
/// along y and z, twist, bending about y and z.
const ORDER: [usize; 6] = [3, 4, 5, 0, 1, 2];

/// Share of the geometric mean of two entries of the diagonal by which the two entries beside it may differ.
const ROUNDING: f64 = 1e-9;

/// Stiffness against twist, bending about y and z, stretch, and shear along y and z; and what couples two of these.
pub(super) struct Stiffness {
    pub(super) diagonal: [Expr; 6],
    pub(super) coupling: Vec<(usize, usize, Expr)>,
}

impl Resolver<'_> {
    /// Six rows of six entries, each with its unit or a plain number in units of the SI.
    pub(super) fn stiffness_matrix(&mut self, value: &Value) -> Option<Stiffness> {
        let rows: Vec<&[Value]> = rows_of(value)
            .filter(|rows| rows.len() == 6 && rows.iter().all(|row| row.len() == 6))
            .or_else(|| {
                let message = "`stiffness` is a matrix of six rows with six entries";
                let help = "write `[[EA, ..], ..]`, in the order stretch, shear along y and z, twist, bending about y and z";
                self.diagnostics.error_with_help(value.extent, message, help);
                None
            })?;
        let mut entries = Vec::new();
        for (i, row) in rows.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                // N, N m and N m^2
                let lengths = (i / 3 + j / 3) as i16;
                entries.push(self.entry_of_stiffness(entry, Dimension::new(1 + lengths, 1, -2)));
            }
        }
        let entries: Vec<Expr> = entries.into_iter().collect::<Option<_>>()?;
        let at = |i: usize, j: usize| &entries[6 * i + j];
        let numbers: Vec<f64> = entries.iter().map(|own| self.nominal_of(own)).collect();
        for (i, row) in rows.iter().enumerate() {
            for (j, entry) in row.iter().enumerate().take(i) {
                let (here, there) = (numbers[6 * i + j], numbers[6 * j + i]);
                let size = (numbers[7 * i] * numbers[7 * j]).abs().sqrt();
                if at(i, j) != at(j, i) && (here - there).abs() > ROUNDING * size {
                    let message = format!(
                        "`stiffness` is not symmetric: {here} here, {there} in row {}",
                        j + 1
                    );
                    self.diagnostics.error(entry.extent, message);
                    return None;
                }
            }
        }
        if let Some(row) = first_not_positive(&numbers) {
            let message = "`stiffness` is not positive definite: some strain would take no work";
            let help = "leave out strains that nothing resists by rows of zeros";
            let extent = rows[row][row].extent;
            self.diagnostics.error_with_help(extent, message, help);
            return None;
        }
        let mut diagonal = [0; 6].map(|_| Expr::Number(0.0));
        let mut coupling = Vec::new();
        for (i, a) in ORDER.into_iter().enumerate() {
            diagonal[a] = at(i, i).clone();
            for (j, b) in ORDER.into_iter().enumerate().skip(i + 1) {
                if *at(i, j) != Expr::Number(0.0) {
                    coupling.push((a.min(b), a.max(b), at(i, j).clone()));
                }
            }
        }
        Some(Stiffness { diagonal, coupling })
    }

    fn entry_of_stiffness(&mut self, entry: &Value, dimension: Dimension) -> Option<Expr> {
        let (expr, quantity) = self.scalar(entry, ValueContext::Parameter)?;
        if !quantity.dimension().is_none() {
            self.expect(quantity, dimension, "this entry of `stiffness`", entry)?;
        }
        Some(expr)
    }
}

fn rows_of(value: &Value) -> Option<Vec<&[Value]>> {
    let ValueKind::Vector(rows, None) = &value.bare().kind else {
        return None;
    };
    let entries = rows.iter().map(|row| match &row.bare().kind {
        ValueKind::Vector(entries, None) => Some(entries.as_slice()),
        _ => None,
    });
    entries.collect()
}

/// The first row at which Cholesky's decomposition fails; rows of zeros are left out.
fn first_not_positive(numbers: &[f64]) -> Option<usize> {
    let mut lower = [[0.0; 6]; 6];
    for i in 0..6 {
        let row = &numbers[6 * i..6 * i + 6];
        if row.iter().all(|own| *own == 0.0) {
            continue;
        }
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
            let rest = row[j] - known;
            lower[i][j] = match i == j {
                true if rest > 0.0 => rest.sqrt(),
                true => return Some(i),
                false if lower[j][j] == 0.0 => 0.0,
                false => rest / lower[j][j],
            };
        }
    }
    None
}
