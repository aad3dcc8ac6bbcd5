//! Superelements: matrices of mass, stiffness, damping and gyroscopic forces, six rows for each station and the others for
//! internal coordinates.

mod checks;
pub(super) mod declared;
mod laws;
mod spun;

use std::rc::Rc;

use self::declared::{Declared, Share, Square};
use super::arguments::Arguments;
use super::beams::declared::Flexible;
use super::bodies::{Row, SUPERELEMENT};
use super::resolver::Resolver;
use super::typed::ValueContext;
use crate::base::dimension::Dimension;
use crate::base::quoted::{DATA, ending};
use crate::matrix_market;
use crate::model::expression::{Expr, Vector};
use crate::model::simplify::add;
use crate::syntax::ast::{self, Term, Value, ValueKind};

/// Most rows: each two of them are a term in the equations.
const MOST_ROWS: usize = 256;

/// What a stiffness that grows with the square of a speed is multiplied by.
const SQUARE: Dimension = Dimension::new(0, 0, -2);

/// What a matrix of a superelement does.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Mass,
    Stiffness,
    Damping,
    Gyroscopic,
}

impl Role {
    const ALL: [(&'static str, Self); 4] = [
        ("mass", Self::Mass),
        ("stiffness", Self::Stiffness),
        ("damping", Self::Damping),
        ("gyroscopic", Self::Gyroscopic),
    ];

    /// Whether a factor may have this dimension, and what it may be. Damping may have parts in proportion to stiffness and mass
    /// (Rayleigh); what spins, parts that grow with its speed.
    fn takes(self, factor: Dimension) -> (bool, &'static str) {
        let (more, words): (&[Dimension], _) = match self {
            Self::Mass => (&[], "of mass is multiplied by a plain number"),
            Self::Stiffness => {
                (&[SQUARE], "of stiffness is multiplied by a plain number, one at 1 rad/s by the square of a speed")
            }
            Self::Damping => (
                &[Dimension::TIME, Dimension::RATE],
                "is damping by a plain number, or one of stiffness by a time, or one of mass by 1/s",
            ),
            Self::Gyroscopic => (&[Dimension::RATE], "is one of gyroscopic forces at 1 rad/s, multiplied by the speed"),
        };
        let is_right = factor == Dimension::NONE && self != Self::Gyroscopic || more.contains(&factor);
        (is_right, words)
    }

    /// What an entry across the diagonal is to be multiplied by to be the same.
    fn across(self) -> f64 {
        if self == Self::Gyroscopic { -1.0 } else { 1.0 }
    }
}

impl Resolver<'_> {
    /// A superelement stands alone, as a shaft does.
    pub(super) fn superelement(&mut self, body: &ast::Body, term: &Term) -> Option<()> {
        static SIGNATURE: Row = SUPERELEMENT;
        let word = &term.shape.word;
        if body.terms.len() > 1 || term.hole {
            let message = "`superelement` stands alone: it cannot be part of a sum";
            let help = "weld another body to a station of it by a `fixed` joint";
            self.diagnostics.error_with_help(word, message, help);
            self.stations.declare(&body.name, Flexible::Superelement(None), []);
            return None;
        }
        if let Some(speed) = &body.spinning {
            let message = "the spinning of a superelement is in its matrices";
            let help = "write `gyroscopic: [[\"wheel_gyroscopic.mtx\", omega]]` for a round part in axes that do not turn, \
                        `on: hub` for a part in axes that turn with a driven body";
            self.diagnostics.error_with_help(speed.extent, message, help);
        }
        let arguments = self.arguments(&term.shape, &SIGNATURE);
        let declared = self.superelement_of(body, term, &arguments);
        let is_right = declared.is_some();
        let last = declared.as_ref().map_or(0, |own| own.stations.len() - 1);
        self.stations.declare(&body.name, Flexible::Superelement(declared.map(Box::new)), 1..=last);
        is_right.then_some(())
    }

    fn superelement_of(&mut self, body: &ast::Body, term: &Term, given: &Arguments<'_>) -> Option<Declared> {
        let turned = "a superelement is not turned: its directions are those of its matrices";
        let origin = self.origin_of(term, "the place of a superelement", turned);
        let held = match given.get("held") {
            None => Some(false),
            Some(value) if matches!(&value.kind, ValueKind::Name(name) if name == "inside") => Some(true),
            Some(value) => {
                let message =
                    "`held` is left out, or `inside` for a part that is fixed to the ground within its matrices";
                self.diagnostics.error(value.extent, message);
                None
            }
        };
        let base = match given.get("on") {
            None => Some(None),
            Some(value) => match &value.kind {
                ValueKind::Name(name) => self.frame(name).map(|frame| Some((frame, value.extent))),
                _ => {
                    let message = "a superelement stands `on` a body: write its name, or leave it out for the ground";
                    self.diagnostics.error(value.extent, message);
                    None
                }
            },
        };
        let stations = given.get("stations").and_then(|value| self.places_of_stations(value));
        let shares = Role::ALL
            .map(|(name, role)| given.get(name).map_or_else(|| Some(Vec::new()), |value| self.shares(value, role)));
        let [mass, stiffness, damping, gyroscopic] = shares;
        let shares = [mass?, stiffness?, damping?, gyroscopic?];
        let at = |name| given.get(name).map_or((&term.shape.word).into(), |value: &Value| value.extent);
        let (origin, stations, held) = (origin?, stations?, held?);
        let stations: Vec<Vector> =
            stations.iter().map(|place| [0, 1, 2].map(|k| add(origin[k].clone(), place[k].clone()))).collect();
        if shares[0].is_empty() || shares[1].is_empty() {
            return None;
        }
        let declared = Declared::new(base?, stations, shares);
        let is_possible = self.check_superelement(&body.name, &declared, &at, held);
        is_possible.then_some(declared)
    }

    fn places_of_stations(&mut self, value: &Value) -> Option<Vec<Vector>> {
        match &value.kind {
            ValueKind::Vector(rows, None) if !rows.is_empty() => {
                let places: Vec<Option<Vector>> =
                    rows.iter().map(|place| self.position(place, "the place of a station")).collect();
                places.into_iter().collect()
            }
            _ => {
                let message = "`stations` is a list of places, one for each six rows of the matrices";
                let help = "write `stations: [[0, 0, 0], [0.4 m, 0, 0]]`";
                self.diagnostics.error_with_help(value.extent, message, help);
                None
            }
        }
    }

    /// A matrix, one with a factor, or a sum of such.
    fn shares(&mut self, value: &Value, role: Role) -> Option<Vec<Share>> {
        let is_pair = |parts: &[Value]| {
            matches!(parts, [file, factor] if is_file(file)
                && !is_file(factor) && !matches!(factor.kind, ValueKind::Vector(..)))
        };
        match &value.kind {
            ValueKind::File(name) => {
                let matrix = self.matrix_in_file(value, name, role)?;
                Some(vec![Share { factor: Expr::Number(1.0), matrix, grows: false }])
            }
            ValueKind::Vector(parts, None) if is_pair(parts) => {
                let factor = self.factor_of_matrix(&parts[1], role);
                let [share] = <[Share; 1]>::try_from(self.shares(&parts[0], role)?).ok()?;
                let (factor, grows) = factor?;
                Some(vec![Share { factor, grows, ..share }])
            }
            ValueKind::Vector(parts, None) if !parts.is_empty() => {
                let each: Vec<Option<Vec<Share>>> = parts.iter().map(|part| self.shares(part, role)).collect();
                let each: Vec<Vec<Share>> = each.into_iter().collect::<Option<_>>()?;
                let all: Vec<Share> = each.into_iter().flatten().collect();
                if let Some(other) = all.iter().find(|share| share.matrix.order != all[0].matrix.order) {
                    let message = format!(
                        "one of these matrices has {} rows, another {}",
                        all[0].matrix.order, other.matrix.order
                    );
                    self.diagnostics.error(value.extent, message);
                    return None;
                }
                Some(all)
            }
            _ => {
                let message = "a matrix of a superelement is in a Matrix Market file, or a sum of such with factors";
                let help = "write `stiffness: \"casing_stiffness.mtx\"` or `stiffness: [[\"thin.mtx\", 1 - t], [\"thick.mtx\", t]]`; `eigentol import` reads other formats";
                self.diagnostics.error_with_help(value.extent, message, help);
                None
            }
        }
    }

    /// A factor, and whether it is the square of a speed.
    fn factor_of_matrix(&mut self, value: &Value, role: Role) -> Option<(Expr, bool)> {
        let (factor, quantity) = self.scalar(value, ValueContext::Parameter)?;
        let (is_right, words) = role.takes(quantity.dimension());
        if !is_right {
            let message = format!("a matrix {words}, this is {}", quantity.dimension().describe());
            self.diagnostics.error(value.extent, message);
        }
        is_right.then_some((factor, quantity.dimension() == SQUARE))
    }

    fn matrix_in_file(&mut self, at: &Value, name: &str, role: Role) -> Option<Rc<Square>> {
        let text = self.text_of_file(at, name)?;
        match matrix_market::read(&text) {
            Ok(matrix) if matrix.rows > MOST_ROWS => {
                let message = format!("`{name}` has {} rows, a superelement at most {MOST_ROWS}", matrix.rows);
                let help = "reduce it to its stations and some modes between them (Craig and Bampton)";
                self.diagnostics.error_with_help(at.extent, message, help);
                None
            }
            Ok(matrix) => {
                let square = Square::of(&matrix, role.across());
                if let Some((row, column)) = square.unsymmetric() {
                    let message = format!(
                        "the matrix in `{name}` is not {}: {:e} in row {}, column {} and {:e} across",
                        if role == Role::Gyroscopic { "skew-symmetric" } else { "symmetric" },
                        square.entry(row, column),
                        row + 1,
                        column + 1,
                        square.entry(column, row)
                    );
                    let help = "mass, stiffness and damping are symmetric, gyroscopic forces change their sign across";
                    self.diagnostics.error_with_help(at.extent, message, help);
                    return None;
                }
                Some(Rc::new(square))
            }
            Err(mistake) => {
                let message = format!("{name}, line {}, column {}: {}", mistake.line, mistake.column, mistake.message);
                self.diagnostics.error(at.extent, message);
                None
            }
        }
    }

    /// The text of a table or a matrix.
    pub(super) fn text_of_file(&mut self, at: &Value, name: &str) -> Option<String> {
        let found = self.ast.files.iter().find(|(known, _)| known == name).map(|(_, text)| text.clone());
        if found.is_none() {
            if ending(name).is_some_and(|own| DATA.contains(&&*own)) {
                let message = format!("`{name}` has not been read: this declaration came without its files");
                self.diagnostics.error(at.extent, message);
            } else {
                let message = format!("`{name}` is no table, `.csv`, and no matrix, `.mtx`");
                let help = "`eigentol import` makes a declaration of files of other programs";
                self.diagnostics.error_with_help(at.extent, message, help);
            }
        }
        found
    }
}

fn is_file(value: &Value) -> bool {
    matches!(value.kind, ValueKind::File(_))
}
