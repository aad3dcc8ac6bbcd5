//! How a shaft is seen.

use super::declared::{Declared, Row};
use crate::model::expression::Expr;
use crate::model::mechanism::{CrossSection, ShaftStation};
use crate::model::simplify::{add, divide, multiply};

/// Parts of a whole shaft at least, so that it is seen to bend.
const PARTS: usize = 16;

impl Declared {
    /// The cross-sections at the ends of all rows and, of long ones, between.
    pub(super) fn outline(&self, stations: &[ShaftStation], nominal: impl Fn(&Expr) -> f64) -> Vec<CrossSection> {
        let total = nominal(&length_of(&self.rows));
        let mut outline: Vec<CrossSection> = Vec::new();
        for (station, ends) in stations.windows(2).enumerate() {
            let rows = &self.rows[ends[0].place..ends[1].place];
            let length = length_of(rows);
            let mut before = Expr::Number(0.0);
            for row in rows {
                let after = add(before.clone(), row.length.clone());
                let parts = PARTS as f64 * nominal(&row.length) / total - 1e-9;
                let parts = (parts.ceil() as usize).clamp(1, PARTS);
                for part in 0..=parts {
                    let share = part as f64 / parts as f64;
                    let diameter = between(&row.outer, share);
                    let goes_on = outline.last().is_some_and(|last| last.diameter == diameter);
                    if part > 0 || !goes_on {
                        let place = between(&[before.clone(), after.clone()], share);
                        outline.push(CrossSection { station, fraction: divide(place, length.clone()), diameter });
                    }
                }
                before = after;
            }
        }
        outline
    }
}

fn length_of(rows: &[Row]) -> Expr {
    rows.iter().fold(Expr::Number(0.0), |sum, row| add(sum, row.length.clone()))
}

fn between([first, last]: &[Expr; 2], share: f64) -> Expr {
    let part = |share: f64, end: &Expr| multiply(Expr::Number(share), end.clone());
    add(part(1.0 - share, first), part(share, last))
}
