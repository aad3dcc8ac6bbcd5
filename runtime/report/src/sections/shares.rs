//! Which variables the spread of each mode comes from.

use eigentol_figures::shares;
use eigentol_tables::{Table, tables};

use super::verdicts::NOTHING_VARIES;
use super::{MODES, beyond, refused};
use crate::Error;
use crate::charts::charts;
use crate::content::Content;
use crate::html::Html;
use crate::tables::table;

pub(super) fn section(html: &mut Html, content: &Content) -> Result<(), Error> {
    let first = match &content.spread {
        None => {
            html.leaf("p", &[("class", "refused")], NOTHING_VARIES);
            return Ok(());
        }
        Some(spread) => match &spread.summary {
            Ok(summary) => &summary.first,
            Err(error) => {
                refused(html, "contributions are not known", error);
                return Ok(());
            }
        },
    };
    html.paragraph("Shares of the variables in the variance of each frequency, at first order.");
    let count = first.modes.len();
    charts(html, (0..count.min(MODES)).map(|mode| shares(first, mode, &content.brief_style)))?;
    beyond(html, count, "contributions of");
    for own in tables(first) {
        let names = shown(&own);
        let names: Vec<&str> = names.iter().map(|own| &**own).collect();
        table(html, "First order, mode by mode", &own, &names)?;
    }
    Ok(())
}

/// Shares of variables, and what they are shares of.
fn shown(table: &Table) -> Vec<String> {
    let names = table.columns.iter().map(|own| own.name.clone());
    let wanted = |name: &String| {
        matches!(&**name, "mode" | "frequency" | "sigma of frequency" | "cluster")
            || name.starts_with("variance share of ")
    };
    names.filter(wanted).collect()
}
