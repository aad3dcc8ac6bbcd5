//! Cross-sections: by shape and material, or by numbers; from the root to the tip dimensions change linearly.

use proc_macro2::Ident;

use super::super::arguments::{Arguments, Signature};
use super::super::resolver::Resolver;
use super::matrix::Stiffness;
use super::table::{Kind, Properties, Table};
use crate::base::dimension::Dimension;
use crate::model::expression::Expr;
use crate::model::rules::physical::Demand;
use crate::syntax::ast::{NamedCall, ValueKind};

/// Dimensions or numbers, and what couples strains.
type Numbers = (Vec<Expr>, Vec<(usize, usize, Expr)>);

/// How many numbers describe a section.
const NUMBERS: usize = 11;
const BENDING: Dimension = Dimension::new(3, 1, -2);
const INERTIA: Dimension = Dimension::new(1, 1, 0);

static KINDS: [Signature<Kind>; 4] = [
    Signature::new("rectangle", &["width", "height"], "rectangle(width: 40 mm, height: 6 mm)", Kind::Rectangle),
    Signature::new("circle", &["radius"], "circle(radius: 5 mm)", Kind::Circle),
    Signature::new("tube", &["outer", "inner"], "tube(outer: 20 mm, inner: 17 mm)", Kind::Tube),
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
        "center_y",
        "center_z",
        "stiffness",
        "width",
        "height",
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

impl Resolver<'_> {
    /// The section of a beam, from its arguments.
    pub(super) fn table(&mut self, name: &Ident, word: &Ident, given: &Arguments<'_>) -> Option<Table> {
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
            "width",
            "height",
        ];
        let mut numbers = by_numbers.iter().chain(&["stiffness"]);
        let numbers = numbers.find_map(|name| Some((name, given.get(name)?)));
        match (given.get("section"), numbers) {
            (Some(_), Some((name, value))) => {
                let message = format!("a beam takes `section` or `{name}`, not both");
                let help = format!("leave out `{name}`, or give all numbers without a `section`");
                self.refuse_with_help(value.extent, message, help)
            }
            (Some(value), None) => {
                let ValueKind::Sections(calls) = &value.kind else {
                    let message = "`section` is a shape";
                    let help = "write `section: rectangle(width: 40 mm, height: 6 mm)`";
                    return self.refuse_with_help(value.extent, message, help);
                };
                let center = self.center(given)?;
                self.shaped(name, word, calls, (material?, center))
            }
            (None, Some(_)) => {
                let center = self.center(given)?;
                let (ends, coupling) = self.numbers(name, given, by_numbers)?;
                if matches!(ends[0], Expr::Number(0.0)) {
                    let message = "`beam` needs `mass_per_length`";
                    let help = "write `mass_per_length: 0.5 kg/m`";
                    return self.refuse_with_help(word, message, help);
                }
                Some(Table {
                    kind: Kind::Numbers,
                    ends: [ends.clone(), ends],
                    material: Properties::default(),
                    centers: [center.clone(), center],
                    coupling: [coupling.clone(), coupling],
                    is_flat: false,
                    is_matrix: given.get("stiffness").is_some(),
                })
            }
            (None, None) => {
                let message = "`beam` needs a `section`, or `mass_per_length` and stiffnesses";
                let help = "write `section: rectangle(width: 40 mm, height: 6 mm), material: steel`";
                self.refuse_with_help(word, message, help)
            }
        }
    }

    /// Mass, stiffness about y, about z and against twist, the two inertias, stiffness against stretch and against shear
    /// along y and z, width and height; zero if not given. And what couples them, if the stiffness is a matrix.
    fn numbers(&mut self, name: &Ident, given: &Arguments<'_>, names: [&str; NUMBERS]) -> Option<Numbers> {
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
            Dimension::LENGTH,
            Dimension::LENGTH,
        ];
        let all: Vec<Option<Expr>> = names
            .into_iter()
            .zip(dimensions)
            .map(|(argument, dimension)| {
                let Some(value) = given.get(argument) else {
                    return Some(Expr::Number(0.0));
                };
                let expr = self.scalar_of(value, dimension, &format!("`{argument}`"))?;
                if dimension == Dimension::LENGTH {
                    self.require_of_beam(name, argument, &expr, dimension, value);
                }
                Some(expr)
            })
            .collect();
        let mut all: Vec<Expr> = all.into_iter().collect::<Option<_>>()?;
        let sizes = ["width", "height"].map(|size| Some((size, given.get(size)?)));
        if let [Some((size, value)), None] | [None, Some((size, value))] = sizes {
            let message = format!("`{size}` alone is not the size of a section");
            let help = "give `width` and `height`, which pictures show, or neither";
            return self.refuse_with_help(value.extent, message, help);
        }
        let Some(value) = given.get("stiffness") else {
            return Some((all, Vec::new()));
        };
        let again = [1, 2, 3, 6, 7, 8].iter().find(|k| given.get(names[**k]).is_some());
        if let Some(again) = again {
            let message = format!("`stiffness` and `{}` say the same", names[*again]);
            let help = "give the matrix, or its diagonal by names";
            return self.refuse_with_help(value.extent, message, help);
        }
        let Stiffness { diagonal, coupling } = self.stiffness_matrix(name, value)?;
        let [twist, about_y, about_z, strains @ ..] = diagonal;
        (all[1], all[2], all[3]) = (about_y, about_z, twist);
        all[6..9].clone_from_slice(&strains);
        Some((all, coupling))
    }

    /// The centre of mass off the axis.
    fn center(&mut self, given: &Arguments<'_>) -> Option<[Expr; 2]> {
        let [y, z] = ["center_y", "center_z"].map(|name| match given.get(name) {
            Some(value) => self.scalar_of(value, Dimension::LENGTH, &format!("`{name}`")),
            None => Some(Expr::Number(0.0)),
        });
        Some([y?, z?])
    }

    /// The centre of mass given for the whole beam, which its sections must not give again.
    fn only_center(&mut self, given: &Arguments<'_>, whole: &[Expr; 2]) -> Option<[Expr; 2]> {
        let again = ["center_y", "center_z"].into_iter();
        let Some(value) = again.filter_map(|name| given.get(name)).next() else {
            return Some(whole.clone());
        };
        let message = "the centre of mass is given for the section and for the whole beam";
        let help = "give it once: within `section(...)` it may change along the beam";
        self.refuse_with_help(value.extent, message, help)
    }

    fn shaped(
        &mut self,
        name: &Ident,
        word: &Ident,
        calls: &[NamedCall],
        (material, center): (Properties, [Expr; 2]),
    ) -> Option<Table> {
        let [root, .., tip] = &match calls {
            [only] => [only, only],
            [root, tip] => [root, tip],
            [.., last] => {
                let message = "a section changes from one shape to one other";
                let help = "put beams in series for more";
                return self.refuse_with_help(&last.word, message, help);
            }
            [] => return None,
        };
        if root.word != tip.word {
            let message = format!("a `{}` cannot become a `{}`", root.word, tip.word);
            let help = "give both ends the same shape: its dimensions change along the beam";
            return self.refuse_with_help(&tip.word, message, help);
        }
        let signature = self.signature(root, "section", &KINDS, &SYNONYMS)?;
        let kind = signature.read;
        let (mut all, mut centers) = (Vec::new(), Vec::new());
        let mut is_matrix = false;
        for (index, end) in calls.iter().enumerate() {
            let arguments = self.arguments(end, signature);
            is_matrix |= arguments.get("stiffness").is_some();
            all.push(self.dimensions(name, kind, &arguments, index > 0));
            centers.push(match &center {
                [Expr::Number(0.0), Expr::Number(0.0)] => self.center(&arguments),
                whole => self.only_center(&arguments, whole),
            });
        }
        let centers: Vec<[Expr; 2]> = centers.into_iter().collect::<Option<_>>()?;
        let all: Vec<Numbers> = all.into_iter().collect::<Option<_>>()?;
        let (ends, coupling): (Vec<_>, Vec<_>) = all.into_iter().unzip();
        if kind != Kind::Numbers {
            let missing = match (&material.density, &material.modulus) {
                (None, _) => Some("`density`"),
                (_, None) => Some("`modulus`"),
                _ => None,
            };
            if let Some(missing) = missing {
                let message = format!("`beam` needs a `material`, or {missing}");
                let help = "write `material: steel` and declare `material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;`";
                return self.refuse_with_help(word, message, help);
            }
        }
        let first = ends.first()?.clone();
        let last = ends.last()?.clone();
        let is_flat = kind == Kind::Rectangle && self.nominal_above(&first[0], &first[1]);
        Some(Table {
            kind,
            ends: [first, last],
            material,
            coupling: both_ends(coupling.first()?, coupling.last()?),
            centers: [centers.first()?.clone(), centers.last()?.clone()],
            is_flat,
            is_matrix,
        })
    }

    /// The dimensions of one end. Those of a tip may be zero: of a wedge the height, of a cone the radius.
    fn dimensions(&mut self, name: &Ident, kind: Kind, given: &Arguments<'_>, is_tip: bool) -> Option<Numbers> {
        let names: &[&str] = match kind {
            Kind::Rectangle => &["width", "height"],
            Kind::Circle => &["radius"],
            Kind::Tube => &["outer", "inner"],
            Kind::Numbers => {
                let order =
                    ["mass", "EIy", "EIz", "GJ", "inertia_y", "inertia_z", "EA", "GAy", "GAz", "width", "height"];
                return self.numbers(name, given, order);
            }
        };
        let mut lengths = Vec::new();
        for argument in names {
            let value = given.get(argument)?;
            let length = self.scalar_of(value, Dimension::LENGTH, &format!("`{argument}`"));
            match &length {
                Some(Expr::Number(0.0)) if is_tip => {}
                Some(length) => self.require_of_beam(name, argument, length, Dimension::LENGTH, value),
                None => {}
            }
            lengths.push((length, value));
        }
        if let (Kind::Tube, [(Some(outer), _), (Some(inner), at)]) = (kind, &lengths[..]) {
            self.requirements.push(crate::model::rules::physical::Requirement {
                what: format!("the inner radius of `{name}`"),
                values: vec![inner.clone(), outer.clone()],
                demand: Demand::BelowOuter,
                extent: at.extent,
            });
        }
        Some((lengths.into_iter().map(|(length, _)| length).collect::<Option<_>>()?, Vec::new()))
    }

    /// Whether one value is above another at the nominal design.
    fn nominal_above(&self, a: &Expr, b: &Expr) -> bool {
        self.nominal_of(a) > self.nominal_of(b)
    }

    /// A value at the nominal design, with all inputs one.
    pub(in crate::model::resolve) fn nominal_of(&self, value: &Expr) -> f64 {
        let design: Vec<f64> = self.design.iter().map(|value| value.as_ref().map_or(f64::NAN, |x| x.value)).collect();
        let inputs = vec![1.0; self.inputs.len()];
        crate::model::evaluate::Values::needed(&self.constants, &inputs, &design).of(value)
    }
}

/// The same entries at both ends: where only one couples its strains, zero at the other.
fn both_ends(root: &[(usize, usize, Expr)], tip: &[(usize, usize, Expr)]) -> [Vec<(usize, usize, Expr)>; 2] {
    let completed = |entries: &[(usize, usize, Expr)], other: &[(usize, usize, Expr)]| {
        let mut all = entries.to_vec();
        for (i, j, _) in other {
            if !entries.iter().any(|(a, b, _)| (a, b) == (i, j)) {
                all.push((*i, *j, Expr::Number(0.0)));
            }
        }
        all.sort_by_key(|(i, j, _)| (*i, *j));
        all
    };
    [completed(root, tip), completed(tip, root)]
}
