//! Cross-sections: by shape and material, or by numbers; from the root to the tip dimensions change linearly.

use std::f64::consts::PI;

use proc_macro2::Ident;

use super::super::arguments::{Arguments, Signature};
use super::super::resolver::Resolver;
use super::materials::Properties;
use crate::base::dimension::Dimension;
use crate::model::expression::{Expr, Function};
use crate::model::mechanism::Section;
use crate::model::rules::physical::Demand;
use crate::model::simplify::{add, call, divide, multiply, power_integer, subtract};
use crate::syntax::ast::{NamedCall, ValueKind};

/// Kinds of section.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Rectangle,
    Circle,
    Tube,
    Numbers,
}

/// How many numbers describe a section.
const NUMBERS: usize = 9;
const BENDING: Dimension = Dimension::new(3, 1, -2);
const INERTIA: Dimension = Dimension::new(1, 1, 0);

static KINDS: [Signature<Kind>; 4] = [
    Signature::new(
        "rectangle",
        &["width", "height"],
        "rectangle(width: 40 mm, height: 6 mm)",
        Kind::Rectangle,
    ),
    Signature::new("circle", &["radius"], "circle(radius: 5 mm)", Kind::Circle),
    Signature::new(
        "tube",
        &["outer", "inner"],
        "tube(outer: 20 mm, inner: 17 mm)",
        Kind::Tube,
    ),
    Signature::new(
        "section",
        &["mass"],
        "section(mass: 0.5 kg/m, EIy: 40 N*m^2, EIz: 300 N*m^2, GJ: 15 N*m^2)",
        Kind::Numbers,
    )
    .optional(&[
        "EIy",
        "EIz",
        "GJ",
        "inertia_y",
        "inertia_z",
        "EA",
        "GAy",
        "GAz",
    ]),
];

const SYNONYMS: [(&str, &str); 7] = [
    ("box", "rectangle"),
    ("square", "rectangle"),
    ("round", "circle"),
    ("rod", "circle"),
    ("disk", "circle"),
    ("pipe", "tube"),
    ("numbers", "section"),
];

/// What a section is computed from, at the root and at the tip.
#[derive(Clone, Debug)]
pub(super) struct Table {
    kind: Kind,
    /// The dimensions at the root and at the tip.
    ends: [Vec<Expr>; 2],
    material: Properties,
    /// Whether a rectangle is wider than high at the nominal design.
    is_flat: bool,
}

impl Resolver<'_> {
    /// The section of a beam, from its arguments.
    pub(super) fn table(
        &mut self,
        name: &Ident,
        word: &Ident,
        given: &Arguments<'_>,
    ) -> Option<Table> {
        let material = self.material_of(name, given);
        let by_numbers = [
            "mass_per_length",
            "stiffness_y",
            "stiffness_z",
            "torsion_stiffness",
            "inertia_y",
            "inertia_z",
            "axial_stiffness",
            "shear_stiffness_y",
            "shear_stiffness_z",
        ];
        let numbers = by_numbers
            .iter()
            .find_map(|name| Some((name, given.get(name)?)));
        match (given.get("section"), numbers) {
            (Some(_), Some((name, value))) => {
                let message = format!("a beam takes `section` or `{name}`, not both");
                let help = format!("leave out `{name}`, or give all numbers without a `section`");
                self.diagnostics
                    .error_with_help(value.extent, message, help);
                None
            }
            (Some(value), None) => {
                let ValueKind::Sections(calls) = &value.kind else {
                    let message = "`section` is a shape";
                    let help = "write `section: rectangle(width: 40 mm, height: 6 mm)`";
                    self.diagnostics
                        .error_with_help(value.extent, message, help);
                    return None;
                };
                self.shaped(name, word, calls, material?)
            }
            (None, Some(_)) => {
                let ends = self.numbers(given, by_numbers)?;
                if matches!(ends[0], Expr::Number(0.0)) {
                    let message = "`beam` needs `mass_per_length`";
                    let help = "write `mass_per_length: 0.5 kg/m`";
                    self.diagnostics.error_with_help(word, message, help);
                    return None;
                }
                Some(Table {
                    kind: Kind::Numbers,
                    ends: [ends.clone(), ends],
                    material: Properties::default(),
                    is_flat: false,
                })
            }
            (None, None) => {
                let message = "`beam` needs a `section`, or `mass_per_length` and stiffnesses";
                let help =
                    "write `section: rectangle(width: 40 mm, height: 6 mm), material: steel`";
                self.diagnostics.error_with_help(word, message, help);
                None
            }
        }
    }

    /// Mass, stiffness about y, about z and against twist, the two inertias, stiffness against stretch and against shear
    /// along y and z; zero if not given.
    fn numbers(&mut self, given: &Arguments<'_>, names: [&str; NUMBERS]) -> Option<Vec<Expr>> {
        let dimensions = [
            Dimension::LINE_DENSITY,
            BENDING,
            BENDING,
            BENDING,
            INERTIA,
            INERTIA,
            Dimension::FORCE,
            Dimension::FORCE,
            Dimension::FORCE,
        ];
        let all: Vec<Option<Expr>> = names
            .into_iter()
            .zip(dimensions)
            .map(|(name, dimension)| match given.get(name) {
                Some(value) => self.scalar_of(value, dimension, &format!("`{name}`")),
                None => Some(Expr::Number(0.0)),
            })
            .collect();
        all.into_iter().collect()
    }

    fn shaped(
        &mut self,
        name: &Ident,
        word: &Ident,
        calls: &[NamedCall],
        material: Properties,
    ) -> Option<Table> {
        let [root, .., tip] = &match calls {
            [only] => [only, only],
            [root, tip] => [root, tip],
            [.., last] => {
                let message = "a section changes from one shape to one other";
                let help = "put beams in series for more";
                self.diagnostics.error_with_help(&last.word, message, help);
                return None;
            }
            [] => return None,
        };
        if root.word != tip.word {
            let message = format!("a `{}` cannot become a `{}`", root.word, tip.word);
            let help = "give both ends the same shape: its dimensions change along the beam";
            self.diagnostics.error_with_help(&tip.word, message, help);
            return None;
        }
        let signature = self.signature(root, "section", &KINDS, &SYNONYMS)?;
        let kind = signature.read;
        let mut ends = Vec::new();
        for end in calls {
            let arguments = self.arguments(end, signature);
            ends.push(self.dimensions(name, kind, &arguments));
        }
        let ends: Vec<Vec<Expr>> = ends.into_iter().collect::<Option<_>>()?;
        if kind != Kind::Numbers {
            let missing = match (&material.density, &material.modulus) {
                (None, _) => Some("`density`"),
                (_, None) => Some("`modulus`"),
                _ => None,
            };
            if let Some(missing) = missing {
                let message = format!("`beam` needs a `material`, or {missing}");
                let help = "write `material: steel` and declare `material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;`";
                self.diagnostics.error_with_help(word, message, help);
                return None;
            }
        }
        let first = ends.first()?.clone();
        let last = ends.last()?.clone();
        let is_flat = kind == Kind::Rectangle && self.nominal_above(&first[0], &first[1]);
        Some(Table {
            kind,
            ends: [first, last],
            material,
            is_flat,
        })
    }

    fn dimensions(&mut self, name: &Ident, kind: Kind, given: &Arguments<'_>) -> Option<Vec<Expr>> {
        let names: &[&str] = match kind {
            Kind::Rectangle => &["width", "height"],
            Kind::Circle => &["radius"],
            Kind::Tube => &["outer", "inner"],
            Kind::Numbers => {
                let order = [
                    "mass",
                    "EIy",
                    "EIz",
                    "GJ",
                    "inertia_y",
                    "inertia_z",
                    "EA",
                    "GAy",
                    "GAz",
                ];
                return self.numbers(given, order);
            }
        };
        let mut lengths = Vec::new();
        for argument in names {
            let value = given.get(argument)?;
            let length = self.scalar_of(value, Dimension::LENGTH, &format!("`{argument}`"));
            if let Some(length) = &length {
                self.require_of_beam(name, argument, length, Dimension::LENGTH, value);
            }
            lengths.push((length, value));
        }
        if let (Kind::Tube, [(Some(outer), _), (Some(inner), at)]) = (kind, &lengths[..]) {
            self.requirements
                .push(crate::model::rules::physical::Requirement {
                    what: format!("the inner radius of `{name}`"),
                    values: vec![inner.clone(), outer.clone()],
                    demand: Demand::BelowOuter,
                    extent: at.extent,
                });
        }
        lengths.into_iter().map(|(length, _)| length).collect()
    }

    /// Whether one value is above another at the nominal design.
    fn nominal_above(&self, a: &Expr, b: &Expr) -> bool {
        let design: Vec<f64> = self
            .design
            .iter()
            .map(|own| own.as_ref().map_or(f64::NAN, |own| own.value))
            .collect();
        let inputs = vec![1.0; self.inputs.len()];
        let values = crate::model::evaluate::Values::new(&self.constants, &inputs, &design);
        values.of(a) > values.of(b)
    }
}

impl Table {
    /// Whether the section is given by mass and stiffness.
    pub(super) fn is_by_numbers(&self) -> bool {
        self.kind == Kind::Numbers
    }

    /// Whether a mass or a stiffness is given: of a shape, all are but for those that need the shear modulus.
    pub(super) fn gives(&self, what: &str, value: &Expr) -> bool {
        let needs_shear_modulus = what.starts_with("torsional") || what.starts_with("shear");
        match self.kind {
            Kind::Numbers => *value != Expr::Number(0.0),
            _ => self.material.shear_modulus.is_some() || !needs_shear_modulus,
        }
    }

    /// How to give a stiffness that is not given.
    pub(super) fn help_with(&self, stiffness: &str) -> String {
        if !self.is_by_numbers() {
            return "give the `shear_modulus` or the `poisson` ratio of the material".to_owned();
        }
        let [argument, short] = match stiffness {
            "torsional stiffness" => ["torsion_stiffness", "GJ"],
            "bending stiffness about y" => ["stiffness_y", "EIy"],
            "bending stiffness about z" => ["stiffness_z", "EIz"],
            "axial stiffness" => ["axial_stiffness", "EA"],
            "shear stiffness along y" => ["shear_stiffness_y", "GAy"],
            "shear stiffness along z" => ["shear_stiffness_z", "GAz"],
            _ => ["mass_per_length", "mass"],
        };
        format!("give `{argument}`, or `{short}` within `section(...)`")
    }

    /// Whether the stiffness against twist is known.
    pub(super) fn knows_torsion(&self) -> bool {
        match self.kind {
            Kind::Numbers => self.ends[0][3] != Expr::Number(0.0),
            _ => self.material.shear_modulus.is_some(),
        }
    }

    /// The section at a fraction of the length.
    pub(super) fn section(&self, place: f64, twist: &Expr) -> Section {
        let [root, tip] = &self.ends;
        let at: Vec<Expr> = root
            .iter()
            .zip(tip)
            .map(|(root, tip)| match root == tip {
                true => root.clone(),
                false => add(
                    multiply(Expr::Number(1.0 - place), root.clone()),
                    multiply(Expr::Number(place), tip.clone()),
                ),
            })
            .collect();
        let twist = multiply(Expr::Number(place), twist.clone());
        if let [
            mass,
            about_y,
            about_z,
            torsion,
            inertia_y,
            inertia_z,
            against_strain @ ..,
        ] = &at[..]
            && let [axial, shear_y, shear_z] = against_strain
        {
            return Section {
                mass: mass.clone(),
                inertia: [inertia_y.clone(), inertia_z.clone()],
                stiffness: [torsion.clone(), about_y.clone(), about_z.clone()],
                against_strain: [axial.clone(), shear_y.clone(), shear_z.clone()],
                twist,
                size: [Expr::Number(0.0), Expr::Number(0.0)],
            };
        }
        let (area, [second_y, second_z], torsion) = self.moments(&at);
        let of = |modulus: &Option<Expr>, moment: Expr| match modulus {
            Some(modulus) => multiply(modulus.clone(), moment),
            None => Expr::Number(0.0),
        };
        let Properties {
            density,
            modulus,
            shear_modulus,
        } = &self.material;
        let shear = match (self.shear_coefficient(&at), shear_modulus) {
            (Some(coefficient), Some(shear_modulus)) => {
                multiply(coefficient, multiply(shear_modulus.clone(), area.clone()))
            }
            _ => Expr::Number(0.0),
        };
        Section {
            against_strain: [of(modulus, area.clone()), shear.clone(), shear],
            mass: of(density, area),
            inertia: [of(density, second_y.clone()), of(density, second_z.clone())],
            stiffness: [
                of(shear_modulus, torsion),
                of(modulus, second_y),
                of(modulus, second_z),
            ],
            twist,
            size: self.size(&at),
        }
    }

    /// Whether the section is a circle or a tube.
    pub(super) fn is_round(&self) -> bool {
        matches!(self.kind, Kind::Circle | Kind::Tube)
    }

    /// Extent along the second and along the third axis.
    fn size(&self, dimensions: &[Expr]) -> [Expr; 2] {
        match dimensions {
            [width, height] if self.kind == Kind::Rectangle => [width.clone(), height.clone()],
            [outer, ..] => {
                let diameter = multiply(Expr::Number(2.0), outer.clone());
                [diameter.clone(), diameter]
            }
            [] => [Expr::Number(0.0), Expr::Number(0.0)],
        }
    }

    /// The share of the area that carries shear: of a rectangle and of a circle or tube by Cowper (1966).
    fn shear_coefficient(&self, dimensions: &[Expr]) -> Option<Expr> {
        let Properties {
            modulus,
            shear_modulus,
            ..
        } = &self.material;
        let twice = multiply(Expr::Number(2.0), shear_modulus.clone()?);
        let poisson = subtract(divide(modulus.clone()?, twice), Expr::Number(1.0));
        let line = |constant: f64, slope: f64| {
            let rising = multiply(Expr::Number(slope), poisson.clone());
            add(Expr::Number(constant), rising)
        };
        if self.kind == Kind::Rectangle {
            return Some(divide(line(10.0, 10.0), line(12.0, 11.0)));
        }
        let hollow = match dimensions {
            [outer, inner] => power_integer(divide(inner.clone(), outer.clone()), 2),
            _ => Expr::Number(0.0),
        };
        let square = power_integer(add(Expr::Number(1.0), hollow.clone()), 2);
        let above = multiply(line(6.0, 6.0), square.clone());
        let below = add(
            multiply(line(7.0, 6.0), square),
            multiply(line(20.0, 12.0), hollow),
        );
        Some(divide(above, below))
    }

    /// Area, second moments about the second and the third axis, and the constant of torsion.
    fn moments(&self, dimensions: &[Expr]) -> (Expr, [Expr; 2], Expr) {
        let scaled = |factor: f64, a: Expr| multiply(Expr::Number(factor), a);
        match (self.kind, dimensions) {
            (Kind::Rectangle, [width, height]) => {
                let second = |across: &Expr, along: &Expr| {
                    scaled(
                        1.0 / 12.0,
                        multiply(across.clone(), power_integer(along.clone(), 3)),
                    )
                };
                let torsion = match self.is_flat {
                    true => torsion_of_rectangle(width, height),
                    false => torsion_of_rectangle(height, width),
                };
                (
                    multiply(width.clone(), height.clone()),
                    [second(width, height), second(height, width)],
                    torsion,
                )
            }
            (_, [outer, rest @ ..]) => {
                let power = |n: i32| {
                    let outer = power_integer(outer.clone(), n);
                    match rest.first() {
                        Some(inner) => subtract(outer, power_integer(inner.clone(), n)),
                        None => outer,
                    }
                };
                let second = scaled(PI / 4.0, power(4));
                let polar = scaled(PI / 2.0, power(4));
                (scaled(PI, power(2)), [second.clone(), second], polar)
            }
            _ => {
                let zero = Expr::Number(0.0);
                (zero.clone(), [zero.clone(), zero.clone()], zero)
            }
        }
    }
}

/// Saint-Venant's constant of a rectangle `a` long and `b` thick:
/// `a b^3 (1/3 - 64/pi^5 (b/a) sum tanh(n pi a / 2 b) / n^5)` over odd `n` (Timoshenko and Goodier 1951), with the
/// sum of `1/n^5` in closed form, so that three terms leave less than 1e-12 for `a >= b`.
fn torsion_of_rectangle(long: &Expr, thick: &Expr) -> Expr {
    const SUM: f64 = 1.004_523_762_795_139_6;
    let ratio = divide(long.clone(), thick.clone());
    let mut sum = Expr::Number(SUM);
    for n in [1.0_f64, 3.0, 5.0] {
        let growing = call(Function::Exp, multiply(Expr::Number(n * PI), ratio.clone()));
        let missing = divide(
            Expr::Number(2.0 / n.powi(5)),
            add(growing, Expr::Number(1.0)),
        );
        sum = subtract(sum, missing);
    }
    let factor = Expr::Number(64.0 / PI.powi(5));
    let loss = multiply(factor, divide(sum, ratio));
    let cube = multiply(long.clone(), power_integer(thick.clone(), 3));
    multiply(cube, subtract(Expr::Number(1.0 / 3.0), loss))
}
