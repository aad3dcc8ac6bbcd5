//! A whole file: its sections in order, and the text of the declaration.

use std::fmt::Write as _;

use super::element::Element;
use super::model::{Placed, Translation};
use super::{constraints, tendons};
use crate::Import;
use crate::assemble::GROUND;
use crate::error::{ImportError, Mistake, Reason};
use crate::geometry::Pose;
use crate::names::type_name;
use crate::note::Note;
use crate::options::{Options, Resistance};
use crate::write::{printable, springs, vector as vector_text};

type Result<T> = std::result::Result<T, ImportError>;

/// Sections of a file that a mechanism has.
const SECTIONS: [&str; 7] = ["compiler", "option", "default", "worldbody", "equality", "tendon", "size"];

/// The mistakes of one step.
fn of(step: Result<()>) -> Vec<Mistake> {
    step.err().map(|error| error.mistakes).unwrap_or_default()
}

impl Translation<'_> {
    pub(super) fn import(mut self, root: &Element, options: &Options) -> Result<Import> {
        let mut mistakes = Vec::new();
        let ground = Placed { name: GROUND.to_owned(), pose: Pose::default() };
        self.bodies.insert("world".to_owned(), ground.clone());
        if let Some(total) = self.total {
            let sum = root.named("worldbody").map(|world| self.masses(world)).sum::<Result<f64>>();
            match sum {
                Ok(sum) if sum > 0.0 => self.share = total / sum,
                Ok(_) => {}
                Err(error) => mistakes.extend(error.mistakes),
            }
        }
        // Results are identified by coordinate, so joints get first choice of their names.
        for world in root.named("worldbody") {
            self.name_joints(world, &mut mistakes);
        }
        for world in root.named("worldbody") {
            self.inside(world, &ground, &mut mistakes);
        }
        for section in root.named("equality").flat_map(|own| &own.children) {
            mistakes.extend(of(constraints::equality(&mut self, section)));
        }
        for section in root.named("tendon").flat_map(|own| &own.children) {
            mistakes.extend(of(tendons::tendon(&mut self, section)));
        }
        if mistakes.is_empty() && self.moves == [false; 2] {
            mistakes.extend(root.mistake(Reason::NothingMoves("no body has a joint")).mistakes);
        }
        if !mistakes.is_empty() {
            mistakes.sort_by_key(|mistake| (mistake.line, mistake.column));
            return Err(ImportError { mistakes });
        }
        for section in root.children.iter().filter(|own| !SECTIONS.contains(&&*own.tag)) {
            self.notes.push(Note::Ignored { element: section.tag.clone(), of: "the robot", names: Vec::new() });
        }
        for (element, names) in std::mem::take(&mut self.ignored) {
            self.notes.push(Note::Ignored { element, of: "joints", names });
        }
        let model = root.get("model").unwrap_or("model");
        let name = options.name.clone().unwrap_or_else(|| type_name(model));
        let mut text = format!("/// The model `{}`, from a MuJoCo file.\npub mechanism {name} {{\n", printable(model));
        if options.resistance == Resistance::KernelsOnly {
            text.push_str("    kernels only;\n");
        }
        if self.gravity != [0.0; 3] {
            let _ = writeln!(text, "    gravity {} m/s^2;", vector_text(&self.gravity));
        }
        for (name, line) in self.lines.iter().flatten() {
            let original = self.names.renamed.get(name);
            let comment = original.map(|original| format!(" // `{}`", printable(original)));
            let _ = writeln!(text, "    {line};{}", comment.unwrap_or_default());
        }
        for line in springs(options.resistance, |is_angle| self.moves[usize::from(is_angle)]) {
            let _ = writeln!(text, "    {line};");
        }
        text.push_str("}\n");
        Ok(Import { declaration: text, names: self.names.renamed, notes: self.notes })
    }
}
