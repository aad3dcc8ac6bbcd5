//! What was studied: variables with units and tolerances, bodies and joints, the text that declares them.

use eigentol::{DampingKind, Role, Unit};
use eigentol_tables::Table;

use super::parts;
use crate::Error;
use crate::content::{Content, Setup};
use crate::html::Html;
use crate::tables::table;

pub(super) fn section(html: &mut Html, content: &Content) -> Result<(), Error> {
    let d = &content.description;
    let count = |role: Role| d.coordinates.iter().filter(|own| own.role == role).count();
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
        table(html, &caption, &variables(content), &[])?;
    }
    if !content.setup.tolerances.is_normal() {
        html.paragraph("Not all of the variables are normally distributed.");
    }
    if content.setup.tolerances.correlation().is_some() {
        html.paragraph("Some of the variables are correlated.");
    }
    if let Ok(pictures) = &content.pictures {
        for (caption, own) in parts::tables(&pictures.scene) {
            table(html, caption, &own, &[])?;
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

/// A row for each variable, in its own unit.
fn variables(content: &Content) -> Table {
    let (d, setup) = (&content.description, &content.setup);
    let inputs = d.inputs.iter().zip(&setup.inputs).enumerate();
    let inputs = inputs.map(|(k, (info, &value))| Variable {
        name: &info.name,
        kind: "input",
        unit: &info.unit,
        value,
        place: setup.place_of_input(k),
    });
    let design = d.design.iter().zip(&setup.design).enumerate();
    let design = design.map(|(k, (info, &value))| Variable {
        name: &info.name,
        kind: "design variable",
        unit: &info.unit,
        value,
        place: Some(k),
    });
    let all: Vec<Variable<'_>> = inputs.chain(design).collect();
    let of = |values: &[f64]| -> Vec<Option<f64>> {
        let one = |own: &Variable<'_>| Some(own.unit.from_si(*values.get(own.place?)?));
        all.iter()
            .map(|own| one(own).filter(|value| *value != 0.0))
            .collect()
    };
    let mut table = Table::new("variables");
    table.texts("name", all.iter().map(|own| Some(own.name.to_owned())));
    table.texts("kind", all.iter().map(|own| Some(own.kind.to_owned())));
    table.numbers(
        "value",
        "",
        all.iter().map(|own| own.unit.from_si(own.value)),
    );
    table.numbers("half-width", "", of(setup.tolerances.half_widths()));
    table.numbers("sigma", "", of(setup.tolerances.sigmas()));
    table.numbers("mean less value", "", of(setup.tolerances.shifts()));
    table.texts(
        "unit",
        all.iter().map(|own| Some(own.unit.symbol.to_string())),
    );
    table
}

struct Variable<'a> {
    name: &'a str,
    kind: &'static str,
    unit: &'a Unit,
    value: f64,
    /// Among the tolerances.
    place: Option<usize>,
}

impl Setup {
    /// The tolerances of inputs that have one follow those of the design variables.
    fn place_of_input(&self, input: usize) -> Option<usize> {
        let place = self.deviating.iter().position(|own| *own == input)?;
        Some(self.design.len() + place)
    }
}
