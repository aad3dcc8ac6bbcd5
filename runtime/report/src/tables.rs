//! Tables of a page: shown with six digits, copied with all digits and all columns.

use eigentol_tables::{Column, Table, Values};

use crate::Error;
use crate::html::Html;
use crate::words::{is_rounding, number};

/// Maximum number of rows shown; the others are available only by copying.
const ROWS: usize = 24;

/// Writes a table with the named columns, or with all non-empty ones if none are named. Columns and rows left out are
/// mentioned and included in the copy.
///
/// # Errors
/// [`Error::Data`].
pub(crate) fn table(html: &mut Html, caption: &str, table: &Table, names: &[&str]) -> Result<(), Error> {
    let filled = |column: &&Column| !is_empty(&column.values);
    let named = |column: &&Column| names.is_empty() || names.contains(&&*column.name);
    let columns: Vec<&Column> = (table.columns.iter().filter(named)).filter(filled).collect();
    let mixed = table.column("unit").is_some();
    let size = |column: &&Column| if mixed { 0.0 } else { largest(&column.values) };
    let largest: Vec<f64> = columns.iter().map(size).collect();
    let json = serde_json::to_string(table)?;
    let rows = table.rows();
    let hidden = (table.columns.iter()).filter(filled).count() - columns.len();
    html.element("div", &[("class", "table")], |html| {
        html.element("div", &[("class", "scroll")], |html| {
            html.element("table", &[], |html| {
                html.leaf("caption", &[], caption);
                head(html, &columns);
                html.element("tbody", &[], |html| {
                    for row in 0..rows.min(ROWS) {
                        html.element("tr", &[], |html| {
                            for (column, largest) in columns.iter().zip(&largest) {
                                cell(html, &column.values, row, *largest);
                            }
                        });
                    }
                });
            });
        });
        html.element("p", &[("class", "copy")], |html| {
            html.element("button", &[("type", "button"), ("data-copy", "")], |html| {
                html.text("Copy for a spreadsheet");
            });
            html.text(&left_out(rows, hidden));
            html.open("span", &[("role", "status")]);
            html.constant("</span>");
        });
        html.data("table", &json);
    });
    Ok(())
}

/// Describes what the copy contains beyond the page.
fn left_out(rows: usize, columns: usize) -> String {
    let rows = rows.saturating_sub(ROWS);
    let count = |count: usize, what: &str| match count {
        0 => None,
        1 => Some(format!("1 more {what}")),
        _ => Some(format!("{count} more {what}s")),
    };
    let more: Vec<String> = [count(rows, "row"), count(columns, "column")].into_iter().flatten().collect();
    if more.is_empty() { " with all digits".to_owned() } else { format!(" with all digits, {}", more.join(" and ")) }
}

fn head(html: &mut Html, columns: &[&Column]) {
    html.element("thead", &[], |html| {
        html.element("tr", &[], |html| {
            for column in columns {
                let class = class_of(&column.values);
                html.leaf("th", &[("scope", "col"), ("class", class)], &column.heading());
            }
        });
    });
}

/// Writes a cell; a number within rounding error relative to `largest` is shown as zero.
fn cell(html: &mut Html, values: &Values, row: usize, largest: f64) {
    let text = match values {
        Values::Numbers(all) => {
            all[row].map(|item| if is_rounding(item, largest) { number(0.0) } else { number(item) })
        }
        Values::Whole(all) => all[row].map(|x| x.to_string()),
        Values::Texts(all) => all[row].clone(),
        Values::Flags(all) => all[row].map(|x| if x { "yes" } else { "no" }.to_owned()),
    };
    let text = text.unwrap_or_else(|| "\u{2013}".to_owned());
    html.leaf("td", &[("class", class_of(values))], &text);
}

fn class_of(values: &Values) -> &'static str {
    match values {
        Values::Numbers(_) | Values::Whole(_) => "number",
        Values::Texts(_) | Values::Flags(_) => "words",
    }
}

fn largest(values: &Values) -> f64 {
    match values {
        Values::Numbers(all) => (all.iter().flatten()).fold(0.0, |most, x| x.abs().max(most)),
        _ => 0.0,
    }
}

fn is_empty(values: &Values) -> bool {
    match values {
        Values::Numbers(all) => all.iter().all(Option::is_none),
        Values::Whole(all) => all.iter().all(Option::is_none),
        Values::Texts(all) => all.iter().flatten().all(String::is_empty),
        Values::Flags(all) => all.iter().all(Option::is_none),
    }
}
