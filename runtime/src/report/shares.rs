//! Shares of design variables in a variance, as columns of a table.

use crate::Description;

/// Of more design variables only the greatest shares are named.
const SEPARATE: usize = 8;
/// So many at most, and no more than make up this part of the variance.
const NAMED: usize = 4;
const MOST: f64 = 0.9;

/// Headings: one column for each variable, or one for the greatest shares.
pub(super) fn head(description: &Description) -> Vec<String> {
    let design = &description.design;
    if design.len() > SEPARATE {
        return vec!["variance mostly from".to_owned()];
    }
    let name = |info: &crate::DesignInfo| format!("share of {}", info.name);
    design.iter().map(name).collect()
}

/// The cells below [`head`]; `None` where there are no shares.
pub(super) fn cells(description: &Description, shares: Option<&[f64]>) -> Vec<String> {
    let design = &description.design;
    let Some(shares) = shares else {
        return vec!["-".to_owned(); head(description).len()];
    };
    if design.len() <= SEPARATE {
        let percent = |share: &f64| format!("{:.1} %", 100.0 * share);
        return shares.iter().map(percent).collect();
    }
    let mut order: Vec<usize> = (0..design.len()).collect();
    order.sort_by(|&a, &b| shares[b].total_cmp(&shares[a]));
    let mut sum = 0.0;
    let mut named = Vec::new();
    for k in order.into_iter().take(NAMED) {
        if sum >= MOST || shares[k] <= 0.0 {
            break;
        }
        sum += shares[k];
        named.push(format!("{} {:.1} %", design[k].name, 100.0 * shares[k]));
    }
    vec![if named.is_empty() {
        "-".to_owned()
    } else {
        named.join(", ")
    }]
}
