//! The vibration modes of the mechanism.

use eigentol::picture::Scene;
use eigentol_figures::{deflections, mode_shapes, participation};
use eigentol_tables::Answer as _;

use super::refused;
use crate::Error;
use crate::charts::chart;
use crate::content::Content;
use crate::html::Html;
use crate::part::Part;
use crate::pictures::{AMPLITUDE, Pictures};
use crate::scene::View;
use crate::tables::table;
use crate::words::digits;

pub(super) fn section(html: &mut Html, content: &Content) -> Result<(), Error> {
    match &content.pictures {
        None => {}
        Some(Ok(pictures)) => view(html, content, pictures)?,
        Some(Err(error)) => refused(html, "there is no picture", error),
    }
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
    let columns = ["mode", "frequency", "damping ratio", "Re s", "kind", "whirl", "motion"];
    for listing in modes.tables() {
        table(html, "Natural modes", &listing, &columns)?;
    }
    if content.description.coordinates.len() < 2 {
        // With one component, every shape is the same.
        return Ok(());
    }
    let style = content.brief_style.clone();
    if !stand_with_the_answer(content) {
        shapes(html, content)?;
    }
    if let Ok(state) = &content.equilibrium {
        chart(html, &participation(modes, state, &style.title("What moves in each mode")))?;
    }
    Ok(())
}

/// Whether the shapes are on the page with the answer: where no diagram along an input is, and nothing in motion beside them.
pub(super) fn stand_with_the_answer(content: &Content) -> bool {
    content.along.is_none() && content.part == Part::All
}

/// Deflection curves of beams, or shapes by coordinate; nothing where there is one component.
///
/// # Errors
/// [`Error::Data`].
pub(super) fn shapes(html: &mut Html, content: &Content) -> Result<(), Error> {
    let (Ok(modes), 2..) = (&content.modes, content.description.coordinates.len()) else {
        return Ok(());
    };
    let style = content.brief_style.clone().title("Mode shapes");
    match &content.pictures {
        Some(Ok(pictures)) if !pictures.scene.beams.is_empty() => {
            let foremost = modes.foremost(super::MODES);
            let moving = pictures.modes.iter().filter_map(|picture| picture.clone().ok());
            let moving: Vec<_> = moving.filter(|picture| foremost.contains(&picture.mode)).collect();
            chart(html, &deflections(&pictures.scene, modes, &moving, &style))
        }
        _ => chart(html, &mode_shapes(modes, &style)),
    }
}

/// The view in 3-D with its controls.
///
/// # Errors
/// [`Error::Data`].
pub(crate) fn player(html: &mut Html, view: &View<'_>) -> Result<(), Error> {
    let json = serde_json::to_string(view)?;
    html.element("div", &[("class", "mechanism")], |html| {
        html.leaf("div", &[("class", "drawing")], "");
        html.data("scene", &json);
    });
    html.paragraph(&format!(
        "Shapes are scaled so that the largest displacement is {:.0} % of the size of the mechanism. Grey: the equilibrium.",
        100.0 * AMPLITUDE
    ));
    Ok(())
}

/// The 3-D view of the mechanism.
fn view(html: &mut Html, content: &Content, pictures: &Pictures) -> Result<(), Error> {
    let modes = content.modes.as_ref().ok();
    player(html, &View::new(pictures, &content.description, modes, &content.brief_style))?;
    html.paragraph(&upwards(&pictures.scene));
    for (mode, picture) in pictures.modes.iter().enumerate() {
        if let Err(error) = picture {
            refused(html, &format!("{} is not shown in motion", content.brief_style.mode(mode)), error);
        }
    }
    let count = modes.map_or(0, |modes| modes.modes.len());
    if count > pictures.modes.len() {
        let shown = pictures.modes.len();
        html.paragraph(&format!("The first {shown} of {count} modes are shown in motion."));
    }
    Ok(())
}

/// States which way is up in the picture, and why.
fn upwards(scene: &Scene) -> String {
    let up = scene.up().map(|values| digits(values, 3)).join(", ");
    match scene.gravity {
        Some(_) => format!("Up is against gravity: [{up}] in the common frame."),
        None => format!(
            "No gravity is declared. Up is [{up}] in the common frame, the axis of the first driven joint on the ground, or z."
        ),
    }
}
