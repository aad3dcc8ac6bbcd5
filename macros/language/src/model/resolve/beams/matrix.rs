//! The stiffness of a section as a matrix, as VABS and BECAS write it.

use proc_macro2::Ident;

use super::super::resolver::Resolver;
use super::super::typed::ValueContext;
use crate::base::dimension::Dimension;
use crate::model::evaluate::Dependence;
use crate::model::expression::Expr;
use crate::model::rules::physical::Demand;
use crate::model::simplify::{divide, multiply, subtract};
use crate::syntax::ast::{Value, ValueKind};

/// Where the rows of a matrix are in the order of [`Section::coupling`](crate::model::mechanism::Section): stretch, shear
/// along y and z, twist, bending about y and z.
const ORDER: [usize; 6] = [3, 4, 5, 0, 1, 2];

/// The strains, in the order of the rows.
const STRAINS: [&str; 6] = ["stretch", "shear along y", "shear along z", "twist", "bending about y", "bending about z"];

/// Share of the geometric mean of two entries of the diagonal by which the two entries beside it may differ.
const ROUNDING: f64 = 1e-9;

/// Stiffness against twist, bending about y and z, stretch, and shear along y and z; and what couples two of these.
pub(super) struct Stiffness {
    pub(super) diagonal: [Expr; 6],
    pub(super) coupling: Vec<(usize, usize, Expr)>,
}

impl Resolver<'_> {
    /// Six rows of six entries, each with its unit or a plain number in units of the SI.
    pub(super) fn stiffness_matrix(&mut self, name: &Ident, value: &Value) -> Option<Stiffness> {
        let rows: Vec<&[Value]> =
            rows_of(value).filter(|rows| rows.len() == 6 && rows.iter().all(|row| row.len() == 6)).or_else(|| {
                let message = "`stiffness` is a matrix of six rows with six entries";
                let help =
                    "write `[[EA, ..], ..]`, in the order stretch, shear along y and z, twist, bending about y and z";
                self.refuse_with_help(value.extent, message, help)
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
        let numbers: Vec<f64> = entries.iter().map(|entry| self.nominal_of(entry)).collect();
        for (i, row) in rows.iter().enumerate() {
            for (j, entry) in row.iter().enumerate().take(i) {
                let (here, there) = (numbers[6 * i + j], numbers[6 * j + i]);
                let size = (numbers[7 * i] * numbers[7 * j]).abs().sqrt();
                if at(i, j) != at(j, i) && (here - there).abs() > ROUNDING * size {
                    let message = format!("`stiffness` is not symmetric: {here} here, {there} in row {}", j + 1);
                    return self.refuse(entry.extent, message);
                }
            }
        }
        let on_inputs = Dependence::on_inputs(&self.constants);
        for (k, pivot) in pivots(&entries) {
            let extent = rows[k][k].extent;
            let number = self.nominal_of(&pivot);
            if !on_inputs.of(&pivot) && (number.is_nan() || number <= 0.0) {
                let message = "`stiffness` is not positive definite: some strain would take no work";
                let help = "leave out strains that nothing resists by rows of zeros";
                return self.refuse_with_help(extent, message, help);
            }
            self.require(
                format!("the stiffness of `{name}` against {} with the strains of earlier rows free", STRAINS[k]),
                [pivot],
                Demand::Positive(Dimension::new(if k < 3 { 1 } else { 3 }, 1, -2)),
                extent,
            );
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
    rows.iter()
        .map(|row| match &row.bare().kind {
            ValueKind::Vector(entries, None) => Some(entries.as_slice()),
            _ => None,
        })
        .collect()
}

/// Rows whose strain something resists, with what must be positive for the matrix to be positive definite: the pivots of
/// Gauss's elimination, each the stiffness against one strain where those of earlier rows are free.
fn pivots(entries: &[Expr]) -> Vec<(usize, Expr)> {
    let mut rest = entries.to_vec();
    let mut list = Vec::new();
    for k in 0..6 {
        let given = &entries[6 * k..6 * k + 6];
        if given.iter().all(|x| *x == Expr::Number(0.0)) {
            continue;
        }
        let row = rest[6 * k..6 * k + 6].to_vec();
        let pivot = row[k].clone();
        for i in k + 1..6 {
            let share = divide(row[i].clone(), pivot.clone());
            for j in k + 1..6 {
                let less = multiply(share.clone(), row[j].clone());
                rest[6 * i + j] = subtract(rest[6 * i + j].clone(), less);
            }
        }
        list.push((k, pivot));
    }
    list
}
