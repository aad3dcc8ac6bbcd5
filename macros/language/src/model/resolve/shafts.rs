//! Shafts: a table of sections, each with its length, its diameters and its material.

mod at_rest;
pub(super) mod declared;
mod file;
mod outline;
pub(super) mod stations;

use proc_macro2::Ident;

use self::declared::{Declared, Row, Section};
use super::arguments::Arguments;
use super::beams::declared::Flexible;
use super::beams::table::{Kind, Properties, Table};
use super::bodies::{self, SHAFT};
use super::expected::Expected;
use super::placements::zero;
use super::resolver::Resolver;
use crate::base::dimension::Dimension;
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::{self, Line};
use crate::model::rules::physical::{Demand, Requirement};
use crate::model::simplify::{add, divide, multiply};
use crate::syntax::ast::{self, Term, Value, ValueKind};

/// Elements of a whole shaft at least: waves longer than an eighth of it have errors below `1e-8`.
const ELEMENTS: usize = 24;
/// Pairs of uniform sections that replace a tapered one, for each e-fold of a diameter, or for the fourth root of the e-folds in a
/// section as long as the shaft: along a wave, errors are as large as the taper and fall with the fourth power of the pairs. They
/// leave some `1e-8` in the lowest frequencies. Where an end is no number, the taper may grow, and derivatives by that end are
/// none the smaller for a slight one: by the waves, it then counts as an e-fold.
const STEPS: f64 = 64.0;
/// Fewest and most of them.
const FEWEST: usize = 4;
const MOST_STEPS: usize = 64;
/// Parts of a shaft at whose ends torque couples the two planes: what that does to the lowest frequencies is wrong by three
/// thousandths of itself at most, sixteen times as much with half as many.
const TWISTED: usize = 8;
/// Most elements of a whole shaft.
const MOST: usize = 4096;

/// A material, and the share of the area that carries shear if it is given.
type Whole = (Properties, Option<Expr>);

/// An entry of the table.
struct Cell {
    value: Value,
    /// Where it is if that is in a file: `rotor.csv, line 3, column 2: `.
    place: String,
}

impl Resolver<'_> {
    /// A shaft stands alone: no other shape can be added to it.
    pub(super) fn shaft(&mut self, body: &ast::Body, shaft: &Term) -> Option<()> {
        static SIGNATURE: bodies::Row = SHAFT;
        let word = &shaft.shape.word;
        if body.terms.len() > 1 || shaft.hole {
            let message = "`shaft` stands alone: it cannot be part of a sum";
            let help = "weld another body to a station of it by a `fixed` joint";
            self.diagnostics.error_with_help(word, message, help);
            self.stations.declare(&body.name, Flexible::Shaft(None), []);
            return None;
        }
        let arguments = self.arguments(&shaft.shape, &SIGNATURE);
        let declared = self.shaft_of(body, shaft, &arguments);
        let is_right = declared.is_some();
        let used = declared.as_ref().map_or(vec![1], |declared| self.places_of(declared));
        self.stations.declare(&body.name, Flexible::Shaft(declared.map(Box::new)), used);
        is_right.then_some(())
    }

    /// The stations that a shaft has in any case: its last, and where torque acts those nearest to equal parts.
    fn places_of(&self, declared: &Declared) -> Vec<usize> {
        let last = declared.last();
        if declared.torque == Expr::Number(0.0) {
            return vec![last];
        }
        let lengths = declared.rows.iter().map(|row| self.nominal_of(&row.length));
        let ends: Vec<f64> =
            lengths.scan(0.0, |end, length| Some(*end + length).inspect(|next| *end = *next)).collect();
        let nearest = |part: usize| {
            let wanted = ends[last - 1] * part as f64 / TWISTED as f64;
            let away = |place: &usize| (ends[*place - 1] - wanted).abs();
            (1..=last).min_by(|a, b| away(a).total_cmp(&away(b)))
        };
        let mut places: Vec<usize> = (1..=TWISTED).filter_map(nearest).collect();
        places.dedup();
        places
    }

    fn shaft_of(&mut self, body: &ast::Body, shaft: &Term, given: &Arguments<'_>) -> Option<Declared> {
        let name = &body.name;
        let before = self.requirements.len();
        let speed = match &body.spinning {
            Some(value) => self.scalar_of(value, Dimension::RATE, "the speed of spinning"),
            None => Some(Expr::Number(0.0)),
        };
        let axes = self.axes_of_beam(given);
        let lag = self.number_or_none(given, "lag", Dimension::TIME, false);
        let elements = match given.get("elements") {
            Some(value) => self.whole(value, "elements", 1..=MOST),
            None => Some(ELEMENTS),
        };
        let bends = match given.get("shear") {
            None => Some(Line::Timoshenko),
            Some(value) if matches!(&value.kind, ValueKind::Number(0.0, None)) => Some(Line::Slender),
            Some(value) => {
                let message = "`shear` is left out, or `0` for a shaft that does not shear";
                self.diagnostics.error(value.extent, message);
                None
            }
        };
        let lines = match given.get("lines") {
            Some(value) => self.lines(value),
            None => Some([true, false, false]),
        };
        let turned = "a shaft is not turned: `along` and `up` say how it lies";
        let origin = self.origin_of(shaft, "the place of a shaft's root", turned);
        let drag = self.number_or_none(given, "drag", Dimension::new(-1, 1, -1), false);
        let tension = self.number_or_none(given, "tension", Dimension::FORCE, true);
        let torque = self.number_or_none(given, "torque", Dimension::MOMENT, true);
        let material = self.material_of(name, given);
        let coefficient = match given.get("shear_coefficient") {
            Some(value) => self.scalar_of(value, Expected::ratio(), "`shear_coefficient`").map(|number| {
                self.require_of_beam(name, "shear coefficient", &number, Dimension::NONE, value);
                Some(number)
            }),
            None => Some(None),
        };
        const NUMBERS: [&str; 7] = [
            "length",
            "mass_per_length",
            "inertia",
            "stiffness",
            "shear_stiffness",
            "torsion_stiffness",
            "axial_stiffness",
        ];
        let number = NUMBERS.into_iter().find_map(|number| Some((number, given.get(number)?)));
        let sections = match (given.get("sections"), number) {
            (Some(_), Some((number, value))) => {
                let message = format!("a shaft takes `sections` or `{number}`, not both");
                let help = "numbers are those of a shaft of one section";
                self.diagnostics.error_with_help(value.extent, message, help);
                None
            }
            (Some(value), None) => {
                material.zip(coefficient).and_then(|whole| self.sections_of_shaft(name, value, &whole))
            }
            (None, _) => self.section_by_numbers(name, &shaft.shape.word, given, bends, lines),
        };
        let (bends, [bending, twists, stretches]) = (bends?, lines?);
        let (axes, sections) = (axes?, sections?);
        let positive = positive(&self.requirements[before..]);
        Some(Declared {
            origin: origin?,
            axes,
            speed: speed?,
            lag: lag?,
            drag: drag?,
            tension: tension?,
            torque: torque?,
            rows: sections,
            bending: bending.then_some(bends),
            twists,
            stretches,
            elements: elements?,
            positive,
        })
    }

    /// A number of the whole shaft, zero where it is not given; of some none is below zero.
    fn number_or_none(
        &mut self,
        given: &Arguments<'_>,
        word: &str,
        dimension: Dimension,
        below_zero: bool,
    ) -> Option<Expr> {
        let Some(value) = given.get(word) else { return Some(Expr::Number(0.0)) };
        let number = self.scalar_of(value, dimension, &format!("`{word}`"))?;
        if !below_zero && self.nominal_of(&number) < 0.0 {
            self.diagnostics.error(value.extent, format!("`{word}` resists motion: it is not below zero"));
            return None;
        }
        Some(number)
    }

    /// Where a body with stations is, which its placement moves and does not turn.
    pub(super) fn origin_of(&mut self, term: &Term, what: &str, turned: &str) -> Option<Vector> {
        match &term.placement {
            Some(placement) if !placement.rotations.is_empty() => {
                self.diagnostics.error(placement.keyword, turned);
                None
            }
            Some(placement) => match &placement.offset {
                Some(offset) => self.position(offset, what),
                None => Some(zero()),
            },
            None => Some(zero()),
        }
    }

    /// Whether a shaft bends, twists and stretches.
    fn lines(&mut self, value: &Value) -> Option<[bool; 3]> {
        const LINES: [&str; 3] = ["bending", "torsion", "stretch"];
        let mut lines = [false; 3];
        let names: &[Value] = match &value.kind {
            ValueKind::Vector(names, None) => names,
            _ => std::slice::from_ref(value),
        };
        for named in names {
            let known = match &named.kind {
                ValueKind::Name(name) => LINES.iter().position(|line| name == line),
                _ => None,
            };
            let Some(known) = known else {
                let message = "`lines` are `bending`, `torsion` and `stretch`, each where the shaft does it";
                let help = "write `lines: [bending, torsion]`; without it a shaft bends only";
                self.diagnostics.error_with_help(named.extent, message, help);
                return None;
            };
            lines[known] = true;
        }
        if names.is_empty() {
            let message = "a shaft without `lines` does nothing: `bending`, `torsion` or `stretch`, or several";
            self.diagnostics.error(value.extent, message);
        }
        lines.contains(&true).then_some(lines)
    }

    /// The only section of a shaft that is given by numbers.
    fn section_by_numbers(
        &mut self,
        name: &Ident,
        word: &Ident,
        given: &Arguments<'_>,
        bends: Option<Line>,
        lines: Option<[bool; 3]>,
    ) -> Option<Vec<Row>> {
        let [bending, twists, stretches] = lines?;
        let shears = bending && bends == Some(Line::Timoshenko);
        let force = Dimension::FORCE;
        let moment = Dimension::new(3, 1, -2);
        let asked = [
            ("length", Dimension::LENGTH, true),
            ("mass_per_length", Dimension::LINE_DENSITY, bending || stretches),
            ("inertia", Dimension::new(1, 1, 0), twists),
            ("stiffness", moment, bending),
            ("shear_stiffness", force, shears),
            ("torsion_stiffness", moment, twists),
            ("axial_stiffness", force, stretches),
        ];
        let mut numbers = Vec::new();
        for (argument, dimension, needed) in asked {
            numbers.push(match given.get(argument) {
                Some(value) => self.scalar_of(value, dimension, &format!("`{argument}`")).inspect(|number| {
                    self.require_of_beam(name, &argument.replace('_', " "), number, dimension, value);
                }),
                None if needed => {
                    let message =
                        format!("`shaft` needs `sections`, or `{argument}` and other numbers of its only one");
                    let help = "write `sections: [[120 mm, 40 mm], [80 mm, 60 mm, 20 mm]], material: steel`";
                    self.diagnostics.error_with_help(word, message, help);
                    return None;
                }
                None => Some(Expr::Number(0.0)),
            });
        }
        let numbers: Vec<Expr> = numbers.into_iter().collect::<Option<_>>()?;
        let [length, mass, rotary, bending, shear, twist, stretch] = <[Expr; 7]>::try_from(numbers).ok()?;
        let polar = multiply(Expr::Number(2.0), rotary.clone());
        let outer = [Expr::Number(0.0), Expr::Number(0.0)];
        let sections = vec![Section { length: length.clone(), mass, rotary, polar, bending, shear, twist, stretch }];
        Some(vec![Row { length, outer, sections }])
    }

    fn sections_of_shaft(&mut self, name: &Ident, value: &Value, whole: &Whole) -> Option<Vec<Row>> {
        let rows: Option<Vec<Vec<Cell>>> = match &value.kind {
            ValueKind::File(file) => Some(self.sections_in_file(value, file)?),
            ValueKind::Vector(rows, None) if !rows.is_empty() => rows.iter().map(row_of).collect(),
            _ => None,
        };
        let Some(rows) = rows else {
            let message = "`sections` is a table: a row of length, outer and inner diameter for each section";
            let help = "write `sections: [[120 mm, 40 mm], [80 mm, 60 mm, 20 mm]]`, or `sections: \"rotor.csv\"`";
            self.diagnostics.error_with_help(value.extent, message, help);
            return None;
        };
        let sections = rows.iter().enumerate().map(|(index, row)| {
            let number = index + 1;
            let (first, layers) = row.split_first()?;
            let length = self.size_of_section(name, number, "length", first);
            let layers = self.layers(name, number, layers, first, whole);
            Some((length?, layers?))
        });
        // Every row is read, so that each mistake is reported.
        let sections: Vec<Option<(Expr, Vec<Layer>)>> = sections.collect();
        let sections = sections.into_iter().collect::<Option<Vec<_>>>()?;
        let whole: f64 = sections.iter().map(|(length, _)| self.nominal_of(length)).sum();
        let row = |(length, layers): &(Expr, Vec<Layer>)| {
            let folds = layers.iter().map(|layer| layer.folds(|size| self.nominal_of(size))).fold(0.0, f64::max);
            let along_waves = if layers.iter().any(Layer::may_change) { folds.max(1.0) } else { folds };
            let by_waves = along_waves.powf(0.25) * self.nominal_of(length) / whole;
            row_of_layers(length, layers, ((STEPS * folds.max(by_waves)) as usize).clamp(FEWEST, MOST_STEPS))
        };
        Some(sections.iter().map(row).collect())
    }

    /// Layers from the inside out, each an outer and perhaps an inner diameter and perhaps a material.
    fn layers(
        &mut self,
        name: &Ident,
        number: usize,
        entries: &[Cell],
        at: &Cell,
        whole: &Whole,
    ) -> Option<Vec<Layer>> {
        let mut layers = Vec::new();
        let mut sizes: Vec<&Cell> = Vec::new();
        let mut rest = entries.iter().peekable();
        while let Some(entry) = rest.next() {
            let material = self.material_named_by(&entry.value);
            if let (None, ValueKind::Name(named)) = (&material, &entry.value.kind)
                && self.scope.find_or_unclear(&named.to_string()).is_none()
            {
                self.in_cell(entry, |this, _| this.unknown_material(named));
                return None;
            }
            if material.is_none() {
                sizes.push(entry);
                if rest.peek().is_some() {
                    continue;
                }
            }
            let (outer, inner) = match sizes[..] {
                [outer] => (outer, None),
                [outer, inner] => (outer, Some(inner)),
                _ => {
                    let message = format!(
                        "{}a layer of section {number} has an outer diameter and perhaps an inner one",
                        entry.place
                    );
                    let help =
                        "name the material before the next layer: `[80 mm, 40 mm, 20 mm, steel, 44 mm, 40 mm, bronze]`";
                    self.diagnostics.error_with_help(entry.value.extent, message, help);
                    return None;
                }
            };
            sizes.clear();
            let material = material.unwrap_or_else(|| Some(whole.0.clone()))?;
            if let Some(missing) = missing(&material) {
                let message = format!("{}section {number} of `{name}` has no {missing}", entry.place);
                let help = "write `material: steel` and declare `material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;`";
                self.diagnostics.error_with_help(entry.value.extent, message, help);
                return None;
            }
            let layer = self.layer(name, number, (outer, inner), (material, whole.1.clone()))?;
            if let Some(before) = layers.last() {
                self.around(name, number, [before, &layer], outer)?;
            }
            layers.push(layer);
        }
        if layers.is_empty() {
            let message = format!("{}section {number} of `{name}` has a length and no diameter", at.place);
            self.diagnostics.error(at.value.extent, message);
            return None;
        }
        Some(layers)
    }

    /// A layer begins where the one before it ends, or outside.
    fn around(&mut self, name: &Ident, number: usize, layers: [&Layer; 2], at: &Cell) -> Option<()> {
        let radius =
            |layer: &Layer, end: usize, k: usize| layer.table.ends[end].get(k).map_or(0.0, |x| self.nominal_of(x));
        for end in 0..2 {
            let [outer, inner] = [radius(layers[0], end, 0), radius(layers[1], end, 1)].map(|radius| 2.0 * radius);
            if inner < outer * (1.0 - 1e-9) {
                let message = format!(
                    "{}this layer of section {number} of `{name}` begins at a diameter of {inner} m, within the layer before, which ends at {outer} m",
                    at.place
                );
                let help = "a layer around another has an inner diameter: `[80 mm, 40 mm, 20 mm, steel, 44 mm, 40 mm, bronze]`";
                self.diagnostics.error_with_help(at.value.extent, message, help);
                return None;
            }
        }
        Some(())
    }

    /// What a name among the entries of a row means if it is a material, with an inner `None` if that is wrong.
    fn material_named_by(&self, entry: &Value) -> Option<Option<Properties>> {
        let ValueKind::Name(name) = &entry.kind else { return None };
        let name = name.to_string();
        self.materials.iter().find(|(own, _)| *own == name).map(|(_, material)| material.clone())
    }

    fn layer(
        &mut self,
        name: &Ident,
        number: usize,
        (outer, inner): (&Cell, Option<&Cell>),
        (material, coefficient): Whole,
    ) -> Option<Layer> {
        let diameters = self.both_ends(name, number, "outer diameter", outer);
        let bores = match inner {
            Some(cell) if matches!(&cell.value.kind, ValueKind::Number(0.0, _)) => None,
            Some(cell) => Some((self.both_ends(name, number, "inner diameter", cell)?, cell)),
            None => None,
        };
        let diameters = diameters?;
        let radius = |diameter: &Expr| multiply(Expr::Number(0.5), diameter.clone());
        let (kind, ends) = match bores {
            None => (Kind::Circle, diameters.each_ref().map(|diameter| vec![radius(diameter)])),
            Some((bores, cell)) => {
                for (bore, diameter) in bores.iter().zip(&diameters) {
                    self.requirements.push(Requirement {
                        what: format!("{}the inner diameter of section {number} of `{name}`", cell.place),
                        values: vec![bore.clone(), diameter.clone()],
                        demand: Demand::BelowOuter,
                        extent: cell.value.extent,
                    });
                }
                (Kind::Tube, [0, 1].map(|end| vec![radius(&diameters[end]), radius(&bores[end])]))
            }
        };
        let none = || [Expr::Number(0.0), Expr::Number(0.0)];
        let table = Table {
            kind,
            ends,
            material,
            centers: [none(), none()],
            coupling: [Vec::new(), Vec::new()],
            is_flat: false,
            is_matrix: false,
        };
        Some(Layer { outer: diameters, table, coefficient })
    }

    /// A size at the beginning and at the end of a section: `taper(60 mm, 40 mm)`, or one for both.
    fn both_ends(&mut self, name: &Ident, number: usize, what: &str, cell: &Cell) -> Option<[Expr; 2]> {
        match &cell.value.kind {
            ValueKind::Call(word, ends) if word == "taper" => {
                let [first, last] = &ends[..] else {
                    let message =
                        format!("{}`taper` has a size at the beginning of the section and one at its end", cell.place);
                    self.diagnostics.error_with_help(cell.value.extent, message, "write `taper(60 mm, 40 mm)`");
                    return None;
                };
                let [first, last] = [first, last].map(|end| {
                    let end = Cell { value: end.clone(), place: cell.place.clone() };
                    self.size_of_section(name, number, what, &end)
                });
                Some([first?, last?])
            }
            _ => {
                let size = self.size_of_section(name, number, what, cell)?;
                Some([size.clone(), size])
            }
        }
    }

    fn size_of_section(&mut self, name: &Ident, number: usize, what: &str, cell: &Cell) -> Option<Expr> {
        let what = format!("the {what} of section {number} of `{name}`");
        let size = self.in_cell(cell, |this, value| this.scalar_of(value, Dimension::LENGTH, &what))?;
        self.requirements.push(Requirement {
            what: cell.place.clone() + &what,
            values: vec![size.clone()],
            demand: Demand::Positive(Dimension::LENGTH),
            extent: cell.value.extent,
        });
        Some(size)
    }

    /// Reads a cell so that what is wrong with it is said with its place.
    fn in_cell<T>(&mut self, cell: &Cell, read: impl FnOnce(&mut Self, &Value) -> T) -> T {
        let before = self.diagnostics.len();
        let read = read(self, &cell.value);
        self.diagnostics.prefix_from(before, &cell.place);
        read
    }
}

/// A layer of a section, whose sizes change linearly along it.
struct Layer {
    /// At the beginning and at the end.
    outer: [Expr; 2],
    table: Table,
    coefficient: Option<Expr>,
}

impl Layer {
    fn is_tapered(&self) -> bool {
        let [first, last] = &self.table.ends;
        first != last
    }

    /// Whether an end of what is tapered follows variables.
    fn may_change(&self) -> bool {
        self.is_tapered() && self.table.ends.iter().flatten().any(|size| !matches!(size, Expr::Number(_)))
    }

    /// The greatest change of a size or of the wall along it, as a logarithm.
    fn folds(&self, nominal: impl Fn(&Expr) -> f64) -> f64 {
        let ends = self.table.ends.each_ref().map(|end| {
            let mut sizes: Vec<f64> = end.iter().map(&nominal).collect();
            // The wall too.
            if let [outer, inner] = sizes[..] {
                sizes.push(outer - inner);
            }
            sizes
        });
        let each = ends[0].iter().zip(&ends[1]).map(|(a, b)| (b / a).ln().abs());
        each.fold(0.0, f64::max)
    }

    fn section(&self, fraction: f64) -> mechanism::Section {
        let none = [Expr::Number(0.0), Expr::Number(0.0)];
        let mut section = self.table.section(fraction, (&Expr::Number(0.0), &none));
        let material = &self.table.material;
        if let (Some(coefficient), Some(modulus), Some(shear)) =
            (&self.coefficient, &material.modulus, &material.shear_modulus)
        {
            let area = divide(section.against_strain[0].clone(), modulus.clone());
            let shear = multiply(coefficient.clone(), multiply(shear.clone(), area));
            section.against_strain[1..].fill(shear);
        }
        section
    }
}

fn row_of_layers(length: &Expr, layers: &[Layer], steps: usize) -> Row {
    let outer = layers.last().map(|layer| layer.outer.clone());
    Row {
        length: length.clone(),
        outer: outer.unwrap_or([Expr::Number(0.0), Expr::Number(0.0)]),
        sections: sections_of_layers(length, layers, steps),
    }
}

/// What a row of the table stands for: one section, or if it is tapered so many pairs.
fn sections_of_layers(length: &Expr, layers: &[Layer], steps: usize) -> Vec<Section> {
    let at = |fraction: f64, length: Expr| {
        let sections: Vec<mechanism::Section> = layers.iter().map(|layer| layer.section(fraction)).collect();
        let sum = |of: fn(&mechanism::Section) -> &Expr| {
            sections.iter().fold(Expr::Number(0.0), |sum, layer| add(sum, of(layer).clone()))
        };
        let rotary = sum(|layer| &layer.inertia[0]);
        Section {
            length,
            mass: sum(|layer| &layer.mass),
            polar: multiply(Expr::Number(2.0), rotary.clone()),
            rotary,
            bending: sum(|layer| &layer.stiffness[1]),
            shear: sum(|layer| &layer.against_strain[1]),
            twist: sum(|layer| &layer.stiffness[0]),
            stretch: sum(|layer| &layer.against_strain[0]),
        }
    };
    if !layers.iter().any(Layer::is_tapered) {
        return vec![at(0.0, length.clone())];
    }
    let step = 1.0 / steps as f64;
    let half = multiply(Expr::Number(0.5 * step), length.clone());
    let aside = 3_f64.sqrt() / 6.0;
    let pairs = (0..steps).flat_map(|k| {
        let gauss = [0.5 - aside, 0.5 + aside].map(|place| at((k as f64 + place) * step, half.clone()));
        let near = 0.5 + 2.0 * aside;
        [[near, 1.0 - near], [1.0 - near, near]].map(|weights| Section::mean(&gauss, weights))
    });
    pairs.collect()
}

fn row_of(row: &Value) -> Option<Vec<Cell>> {
    let ValueKind::Vector(entries, None) = &row.kind else { return None };
    let cells = entries.iter().map(|value| Cell { value: value.clone(), place: String::new() });
    (!entries.is_empty()).then(|| cells.collect())
}

fn missing(material: &Properties) -> Option<&'static str> {
    let all = [
        (&material.density, "density"),
        (&material.modulus, "modulus"),
        (&material.shear_modulus, "shear modulus: give `poisson` or `shear_modulus`"),
    ];
    all.into_iter().find_map(|(given, what)| given.is_none().then_some(what))
}

/// What was required of sizes, to be required at run time.
fn positive(asked: &[Requirement]) -> Vec<(String, Expr)> {
    let plain = |requirement: &Requirement| requirement.what.trim_start_matches("the ").replace('`', "");
    let each = asked.iter().filter_map(|requirement| match (&requirement.demand, &requirement.values[..]) {
        (Demand::Positive(_), [value]) => Some((plain(requirement), value.clone())),
        (Demand::BelowOuter, [inner, outer]) => {
            let wall = crate::model::simplify::subtract(outer.clone(), inner.clone());
            Some((plain(requirement).replace("inner diameter", "wall"), wall))
        }
        _ => None,
    });
    each.collect()
}
