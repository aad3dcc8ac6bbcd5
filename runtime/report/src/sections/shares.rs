//! Contributions of the variables to the spread of each mode.

use eigentol::FirstOrder;
use eigentol_figures::{Style, shares};
use eigentol_tables::{Answer as _, Table};

use super::verdicts::NOTHING_VARIES;
use super::{beyond, foremost, refused};
use crate::Error;
use crate::charts::charts;
use crate::content::Content;
use crate::html::Html;
use crate::tables::table;
use crate::words::capital;

pub(super) fn section(html: &mut Html, content: &Content) -> Result<(), Error> {
    let first = match &content.spread {
        None => {
            html.leaf("p", &[("class", "refused")], NOTHING_VARIES);
            return Ok(());
        }
        Some(spread) => match &spread.first {
            Ok(first) => first,
            Err(error) => {
                refused(html, "contributions are not known", error);
                return Ok(());
            }
        },
    };
    html.paragraph("Shares of the variables in the variance of each frequency, at first order.");
    let count = first.modes.len();
    let of = |mode: usize| {
        let style = content.brief_style.clone();
        let name = style.mode(mode);
        shares(first, mode, &style.title(capital(&name)))
    };
    charts(html, foremost(content, count).into_iter().map(of))?;
    beyond(html, count, "contributions of");
    table(html, "Shares in the variance of each frequency", &by_variable(first, &content.brief_style), &[])?;
    for listing in first.tables() {
        let columns = ["mode", "frequency", "sigma of frequency", "band of frequency", "cluster"];
        table(html, "First order, mode by mode", &listing, &columns)?;
    }
    Ok(())
}

/// A row for each variable, a column for each mode; members of a cluster are left out, since they have no spread of
/// their own.
fn by_variable(first: &FirstOrder, style: &Style) -> Table {
    let design = first.description.design.iter();
    let mut table = Table::new("shares");
    table.texts("variable", design.clone().map(|info| Some(info.name.to_string())));
    for (r, mode) in first.modes.iter().enumerate() {
        let shares = mode.variance_shares();
        let share = |k: usize| shares.get(k).filter(|_| !mode.clustered).map(|share| 100.0 * share);
        table.numbers(&style.mode(r), "%", (0..design.len()).map(share));
    }
    table
}
