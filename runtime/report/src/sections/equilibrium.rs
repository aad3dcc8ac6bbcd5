//! The equilibrium and the outputs there.

use eigentol::{Equilibrium, Role};
use eigentol_tables::{Answer as _, Table};

use super::refused;
use crate::Error;
use crate::content::Content;
use crate::html::Html;
use crate::tables::table;
use crate::words::sentence;

pub(super) fn section(html: &mut Html, content: &Content) -> Result<(), Error> {
    let state = match &content.equilibrium {
        Ok(state) => state,
        Err(error) => {
            refused(html, "there is no equilibrium", error);
            return Ok(());
        }
    };
    let class = if state.stability.holds() { "good" } else { "bad" };
    let stability = if state.constraints.singular {
        "not decided in a singular configuration".to_owned()
    } else {
        state.stability.to_string()
    };
    let text = sentence(&format!("the equilibrium is {stability}"));
    html.leaf("p", &[("class", class)], &text);
    table(html, "Unknowns at the equilibrium", &unknowns(state), &[])?;
    let d = &content.description;
    match &content.outputs {
        _ if d.outputs.is_empty() => {}
        Ok(outputs) => {
            let caption = format!("Outputs; a band holds {} standard deviations", outputs.sigma_level);
            let columns = ["output", "unit", "mean", "sigma", "band"];
            for listing in outputs.tables() {
                table(html, &caption, &listing, &columns)?;
            }
        }
        Err(error) => refused(html, "outputs have no spread", error),
    }
    Ok(())
}

/// A row for each unknown.
fn unknowns(state: &Equilibrium) -> Table {
    let infos = state.description.coordinates.iter();
    let mut table = Table::new("equilibrium");
    table.texts("unknown", infos.clone().map(|info| Some(info.name.to_string())));
    let kind = |role| match role {
        Role::Position => "coordinate",
        Role::Speed => "speed",
        Role::PositionReaction | Role::VelocityReaction => "reaction",
    };
    table.texts("kind", infos.clone().map(|info| Some(kind(info.role).to_owned())));
    let values = infos.clone().zip(&state.coordinates);
    table.numbers("value", "", values.map(|(info, &value)| info.unit.from_si(value)));
    table.texts("unit", infos.map(|info| Some(info.unit.symbol.to_string())));
    table
}
