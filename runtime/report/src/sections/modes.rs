//! How the mechanism vibrates.

use eigentol_figures::{mode_shapes, participation};
use eigentol_tables::tables;

use super::refused;
use crate::charts::chart;
use crate::Error;
use crate::content::Content;
use crate::html::Html;
use crate::tables::table;

pub(super) fn section(html: &mut Html, content: &Content) -> Result<(), Error> {
    let modes = match &content.modes {
        Ok(modes) => modes,
        Err(error) => {
            refused(html, "there are no modes", error);
            return Ok(());
        }
    };
    if modes.damping_ignored {
        html.paragraph("Damping and gyroscopic forces are not zero here and are ignored: undamped modes.");
    }
    let columns = [
        "mode",
        "frequency",
        "damping ratio",
        "Re s",
        "motion",
    ];
    for own in tables(modes) {
        table(html, "Natural modes", &own, &columns)?;
    }
    chart(html, &mode_shapes(modes, &content.brief_style))?;
    if let Ok(state) = &content.equilibrium {
        chart(html, &participation(modes, state, &content.brief_style))?;
    }
    Ok(())
}
