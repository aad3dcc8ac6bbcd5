//! Results along an input: branches of equilibria, frequencies, damping, critical values.

use eigentol::tolerance::Spread;
use eigentol_figures::{branches, campbell, damping_ratios, root_locus};
use eigentol_tables::{Answer as _, Table};

use super::refused;
use crate::Error;
use crate::charts::chart;
use crate::content::{Along, Content};
use crate::html::Html;
use crate::tables::table;

pub(super) fn section(html: &mut Html, content: &Content) -> Result<(), Error> {
    let Some(along) = &content.along else {
        let text = if content.description.inputs.is_empty() {
            "The mechanism has no input."
        } else {
            "No sweep was asked for."
        };
        html.leaf("p", &[("class", "refused")], text);
        return Ok(());
    };
    states(html, content, along)?;
    modes(html, content, along)
}

fn states(html: &mut Html, content: &Content, along: &Along) -> Result<(), Error> {
    let all_branches = match &along.branches {
        None => return Ok(()),
        Some(Ok(branches)) => branches,
        Some(Err(error)) => {
            refused(html, "branches of equilibria were not followed", error);
            return Ok(());
        }
    };
    chart(html, &branches(all_branches, &content.style.clone().title("Branches of equilibria")))?;
    if all_branches.truncated {
        html.paragraph("There are more branches than were followed.");
    }
    for listing in all_branches.tables() {
        if listing.name == "special points" {
            table(html, "Folds and branch points", &listing, &[])?;
        }
    }
    Ok(())
}

fn modes(html: &mut Html, content: &Content, along: &Along) -> Result<(), Error> {
    let diagram = match &along.campbell {
        Ok(campbell) => campbell,
        Err(error) => {
            refused(html, "frequencies along the input are not known", error);
            return Ok(());
        }
    };
    let failed = diagram.points.iter().filter(|point| point.modes.is_err()).count();
    if failed > 0 {
        let text = format!("At {failed} of {} values there are no modes: the table says why.", diagram.points.len());
        html.leaf("p", &[("class", "refused")], &text);
    }
    chart(html, &campbell(diagram, &content.style.clone().title("Campbell diagram")))?;
    let damped = diagram.points.iter().flat_map(|point| point.modes.iter().flatten());
    let is_damped = |spread: &Spread| spread.mean != 0.0;
    let mut damped = damped.filter_map(|mode| mode.damping_ratio.as_ref());
    if damped.any(is_damped) {
        chart(html, &damping_ratios(diagram, &content.style.clone().title("Damping ratios")))?;
        chart(html, &root_locus(diagram, &content.style.clone().title("Root locus")))?;
    }
    for listing in diagram.tables() {
        let caption = match &*listing.name {
            "crossings" => "Where a frequency is a multiple of the input",
            "critical states" => "Where the equilibrium loses its stiffness",
            "flutter onsets" => "Where an oscillation begins or ceases to grow",
            "unresolved" => "Where events may lie that are not resolved",
            _ => "All modes along the input",
        };
        table(html, caption, &listing, &on_a_page(&listing))?;
    }
    Ok(())
}

/// The columns that fit on a page; the rest is available by copying.
fn on_a_page(table: &Table) -> Vec<&str> {
    let left_out = ["sigma level", "Re s", "Im s", "whirl ratio"];
    table
        .columns
        .iter()
        .map(|column| &*column.name)
        .filter(|name| !name.starts_with("variance share of ") && !left_out.contains(name))
        .collect()
}
