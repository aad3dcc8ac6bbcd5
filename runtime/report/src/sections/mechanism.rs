//! The mechanism: variables with units and tolerances, bodies and joints, and its declaration.

use eigentol::{DampingKind, Role};

use super::{laws, parts, variables};
use crate::Error;
use crate::content::Content;
use crate::html::Html;
use crate::tables::table;

pub(super) fn section(html: &mut Html, content: &Content) -> Result<(), Error> {
    let d = &content.description;
    let count = |role: Role| d.coordinates.iter().filter(|coordinate| coordinate.role == role).count();
    let reactions = count(Role::PositionReaction) + count(Role::VelocityReaction);
    let parts = [
        counted(count(Role::Position), "coordinate"),
        counted(count(Role::Speed), "speed"),
        counted(reactions, "constraint"),
        counted(d.inputs.len(), "input"),
        counted(d.design.len(), "design variable"),
        counted(d.outputs.len(), "output"),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    let damping = match d.damping {
        DampingKind::Zero => "Nothing damps it, and it has no gyroscopic forces.",
        DampingKind::Gyroscopic => "Gyroscopic forces couple its motions; nothing damps it.",
        DampingKind::General => "Damping or forces that follow the motion act on it.",
    };
    html.paragraph(&format!("{} has {}. {damping}", d.name, parts.join(", ")));
    if !d.inputs.is_empty() || !d.design.is_empty() {
        let level = content.setup.tolerances.sigma_level();
        let caption = format!("Variables; a half-width holds {level} standard deviations");
        let all = variables::variables(content);
        table(html, &caption, &variables::table(&all), &[])?;
        laws::drawings(html, &all, level);
    }
    if content.setup.tolerances.correlation().is_some() {
        html.paragraph("Some of the variables are correlated.");
    }
    if let Some(Ok(pictures)) = &content.pictures {
        for (caption, listing) in parts::tables(&pictures.scene, d) {
            table(html, caption, &listing, &[])?;
        }
    }
    if let Some(text) = &content.declaration {
        html.element("details", &[], |html| {
            html.leaf("summary", &[], "Declaration");
            html.element("pre", &[], |html| html.leaf("code", &[], text));
        });
    }
    Ok(())
}

fn counted(count: usize, what: &str) -> Option<String> {
    match count {
        0 => None,
        1 => Some(format!("1 {what}")),
        _ => Some(format!("{count} {what}s")),
    }
}
