//! Beams: a section, a material, and the number of coordinates for each way to turn.

pub(super) mod declared;
mod materials;
mod matrix;
mod sections;
mod stations;
pub(super) mod table;

use std::f64::consts::TAU;

use proc_macro2::Ident;

use self::declared::{Declared, Flexible};
use self::table::Table;
use super::arguments::Arguments;
use super::bodies::{BEAM, Row};
use super::expected::Expected;
use super::resolver::Resolver;
use super::typed::ValueContext;
use crate::base::dimension::Dimension;
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::Section;
use crate::model::rules::physical::{Demand, Requirement};
use crate::model::simplify;
use crate::syntax::ast::{self, Term, Value, ValueKind};

/// Most coordinates of one component: beyond, polynomials gain nothing over two beams in series.
const MOST: usize = 16;

impl Resolver<'_> {
    /// A beam stands alone: no other shape can be added to it.
    pub(super) fn beam(&mut self, body: &ast::Body, beam: &Term) -> Option<()> {
        let word = &beam.shape.word;
        if body.terms.len() > 1 || beam.hole {
            let message = "`beam` stands alone: it cannot be part of a sum";
            let help = "weld another body to its root or its tip by a `fixed` joint";
            return self.refuse_with_help(word, message, help);
        }
        if let Some(placement) = &beam.placement {
            let message = "a beam starts at the origin of its frame";
            let help = "place the joint instead";
            return self.refuse_with_help(placement.keyword, message, help);
        }
        static SIGNATURE: Row = BEAM;
        let arguments = self.arguments(&beam.shape, &SIGNATURE);
        let declared = self.beam_of(body, word, &arguments);
        let is_right = declared.is_some();
        self.stations.declare(&body.name, Flexible::Beam(declared.map(Box::new)), [1]);
        is_right.then_some(())
    }

    fn beam_of(&mut self, body: &ast::Body, word: &Ident, given: &Arguments<'_>) -> Option<Declared> {
        let name = &body.name;
        let before = self.requirements.len();
        let spin = match &body.spinning {
            Some(value) => self.scalar_of(value, Dimension::RATE, "the speed of spinning"),
            None => Some(Expr::Number(0.0)),
        };
        let length = given.get("length").and_then(|value| {
            let length = self.scalar_of(value, Dimension::LENGTH, "`length`")?;
            self.require_of_beam(name, "length", &length, Dimension::LENGTH, value);
            Some(length)
        });
        let axes = self.axes_of_beam(given);
        let table = self.table(name, word, given);
        let twist = match given.get("twist") {
            Some(value) => self.scalar_of(value, Expected::angle(), "`twist`"),
            None => Some(Expr::Number(0.0)),
        };
        let prebend = ["prebend_y", "prebend_z"].map(|name| match given.get(name) {
            Some(value) => self.scalar_of(value, Expected::angle(), &format!("`{name}`")),
            None => Some(Expr::Number(0.0)),
        });
        let lag = match given.get("lag") {
            Some(value) => self.scalar_of(value, Dimension::TIME, "`lag`"),
            None => Some(Expr::Number(0.0)),
        };
        let counts = self.counts(word, given, table.as_ref());
        let strains = self.strains_of_beam(given, counts);
        let points = self.points_of_beam(given, counts, strains);
        let (length, axes, table, twist) = (length?, axes?, table?, twist?);
        let mut declared = Declared {
            length,
            axes,
            counts: counts?,
            strains: strains?.0,
            static_shear: strains?.1,
            points: points?,
            table,
            twist,
            prebend: {
                let [y, z] = prebend;
                [y?, z?]
            },
            spin: spin?,
            lag: lag?,
            positive: Vec::new(),
        }
        .refined(self.more);
        if let Some(value) = &body.spinning {
            self.require_round(value, &declared)?;
        }
        self.require_unsheared(given, &declared)?;
        self.require_sections(name, word, given, &declared)?;
        declared.positive = positive(name, &self.requirements[before..], &declared.table);
        if declared.is_curved() == [true; 2] {
            self.require_less_than_a_turn((name, word), &mut declared)?;
        }
        Some(declared)
    }

    /// Along the beam, the axis of bending about which the height stands, and up.
    pub(super) fn axes_of_beam(&mut self, given: &Arguments<'_>) -> Option<[Vector; 3]> {
        let mut direction = |name: &str| {
            let value = given.get(name)?;
            Some((self.direction(value, ValueContext::Parameter)?, value))
        };
        let (along, up) = (direction("along"), direction("up"));
        let ((along, _), (up, at)) = (along?, up?);
        if let Expr::Number(cosine) = simplify::dot(&along, &up)
            && cosine.abs() > 1e-9
        {
            let message = "`up` must be perpendicular to `along`";
            let help = "it is the direction of the height of the section";
            return self.refuse_with_help(at.extent, message, help);
        }
        let across = simplify::cross(&up, &along);
        Some([along, across, up])
    }

    /// The number of coordinates of twist, of bending about the second axis and about the third.
    fn counts(&mut self, word: &Ident, given: &Arguments<'_>, table: Option<&Table>) -> Option<[usize; 3]> {
        let mut count = |name: &str| match given.get(name) {
            Some(value) => self.whole(value, name, 0..=MOST).map(Some),
            None => Some(None),
        };
        let [torsion, bending, y, z] = ["torsion", "bending", "bending_y", "bending_z"].map(&mut count);
        let (torsion, bending, y, z) = (torsion?, bending?, y?, z?);
        let both = bending.or((y.is_none() && z.is_none()).then_some(5)).unwrap_or(0);
        let (y, z) = (y.unwrap_or(both), z.unwrap_or(both));
        let twists = table.is_some_and(Table::knows_torsion);
        let resists = table.is_some_and(Table::resists_turning);
        let default = if twists && resists && y > 0 && z > 0 { 2 } else { 0 };
        let torsion = torsion.unwrap_or(default);
        let none = |value: &Value| matches!(value.kind, ValueKind::Number(0.0, None));
        let stretches = given.get("stretch").is_some_and(|value| !none(value));
        if torsion + y + z == 0 && !stretches {
            let message = "this beam has no coordinates: it is rigid";
            let help = "give `bending: 5`, `bending_y`, `bending_z` or `torsion`, or use a `rod`";
            return self.refuse_with_help(word, message, help);
        }
        Some([torsion, y, z])
    }

    /// The numbers of coordinates of stretch and of shear along the second and the third axis, and whether shear is
    /// static.
    fn strains_of_beam(&mut self, given: &Arguments<'_>, counts: Option<[usize; 3]>) -> Option<([usize; 3], bool)> {
        let stretch = match given.get("stretch") {
            Some(value) => self.whole(value, "stretch", 0..=MOST),
            None => Some(0),
        };
        let [_, about_y, about_z] = counts?;
        let Some(value) = given.get("shear") else {
            return Some(([stretch?, 0, 0], false));
        };
        if matches!(&value.kind, ValueKind::Name(word) if word == "static") {
            return Some(([stretch?, 0, 0], true));
        }
        let is_number = matches!(value.kind, ValueKind::Number(..));
        if !is_number {
            let message = "`shear` is `static` or a number of coordinates";
            return self.refuse(value.extent, message);
        }
        let shear = self.whole(value, "shear", 0..=MOST)?;
        let along = |bends: usize| if bends > 0 { shear } else { 0 };
        Some(([stretch?, along(about_z), along(about_y)], false))
    }

    fn points_of_beam(
        &mut self,
        given: &Arguments<'_>,
        counts: Option<[usize; 3]>,
        strains: Option<([usize; 3], bool)>,
    ) -> Option<usize> {
        let most = counts?.into_iter().chain(strains?.0).max()?;
        match given.get("points") {
            Some(value) => self.whole(value, "points", most..=2 * MOST),
            None => Some(most + 2),
        }
    }

    /// A whole number that is written as one.
    pub(super) fn whole(&mut self, value: &Value, name: &str, range: std::ops::RangeInclusive<usize>) -> Option<usize> {
        if let ValueKind::Number(number, None) = value.kind
            && number.fract() == 0.0
            && range.contains(&(number as usize))
            && number >= 0.0
        {
            return Some(number as usize);
        }
        let message = format!("`{name}` is a whole number from {} to {}", range.start(), range.end());
        self.refuse(value.extent, message)
    }

    /// A beam that turns about its own axis is steady only if it is the same in all directions.
    fn require_round(&mut self, at: &Value, declared: &Declared) -> Option<()> {
        // Dimensions change linearly: what is round at both ends is so between them.
        let is_round = [0.0, 1.0].iter().all(|fraction| {
            let section = declared.section(*fraction);
            let [_, about_y, about_z] = &section.stiffness;
            let [_, shear_y, shear_z] = &section.against_strain;
            let [inertia_y, inertia_z] = &section.inertia;
            !declared.table.is_coupled() && about_y == about_z && shear_y == shear_z && inertia_y == inertia_z
        });
        let [_, y, z] = declared.counts;
        let round = "use a `circle` or a `tube`, or the same numbers for both planes";
        let straight =
            "the material turns about the bent axis, along which it must be the same all round: leave it out";
        let (problem, help) = if y != z {
            (
                "bends in one plane more than in the other",
                "give both planes the same number of coordinates: `bending: 4`",
            )
        } else if !is_round {
            ("is not round", round)
        } else if declared.twist != Expr::Number(0.0) {
            ("is twisted", straight)
        } else if declared.table.is_off_axis() {
            (
                "has mass off its axis",
                "put an `unbalance` on a disk that a joint `driven at` the same speed turns on it",
            )
        } else if declared.is_curved().contains(&true) {
            ("is curved before it is loaded", straight)
        } else {
            return Some(());
        };
        let message = format!("a beam that spins and {problem} has no steady motion");
        self.refuse_with_help(at.extent, message, help)
    }

    /// Shear that follows from the moments is derived for straight beams of sections that couple no strains and that
    /// all resist it.
    fn require_unsheared(&mut self, given: &Arguments<'_>, declared: &Declared) -> Option<()> {
        let message = if !declared.static_shear {
            return Some(());
        } else if declared.is_curved().contains(&true) {
            "`shear: static` takes a beam that is straight before it is loaded"
        } else if declared.table.is_coupled() {
            "`shear: static` takes a section whose strains are not coupled"
        } else if declared.table.is_sharp() {
            "`shear: static` takes a beam with a section at its tip"
        } else {
            return Some(());
        };
        let help = "give shear coordinates of its own: `shear: 4`";
        self.refuse_with_help(given.get("shear")?.extent, message, help)
    }

    pub(super) fn require_of_beam(&mut self, name: &Ident, what: &str, value: &Expr, dimension: Dimension, at: &Value) {
        self.require(format!("the {what} of `{name}`"), [value.clone()], Demand::Positive(dimension), at.extent);
    }

    /// The series of a curved axis hold up to a full turn.
    fn require_less_than_a_turn(&mut self, (name, word): (&Ident, &Ident), declared: &mut Declared) -> Option<()> {
        let [y, z] = declared.prebend.clone();
        let square = |expr: Expr| simplify::power_integer(expr, 2);
        let turned = simplify::add(square(y), square(z));
        let rest = simplify::subtract(Expr::Number(TAU * TAU), turned);
        if matches!(rest, Expr::Number(rest) if rest <= 0.0) {
            let message = "the axis of this beam turns by a full turn or more";
            let help = "put two beams in series, each with its part of the turn";
            return self.refuse_with_help(word, message, help);
        }
        let quantity = format!("rest of a full turn beside the prebend of {name}, squared");
        declared.positive.push((quantity, rest));
        Some(())
    }

    /// Mass and stiffness must be given, and if they are numbers positive all along the beam, also within the
    /// tolerances. Those of a shape are positive if its dimensions and moduli are.
    fn require_sections(
        &mut self,
        name: &Ident,
        word: &Ident,
        given: &Arguments<'_>,
        declared: &Declared,
    ) -> Option<()> {
        // Dimensions change linearly: what is positive at both ends is so between them.
        let ends = [0.0, 1.0].map(|fraction| declared.section(fraction));
        let counts = declared.counts;
        let [curved_y, curved_z] = declared.is_curved();
        let mut used = counts;
        let is_twisted = declared.twist != Expr::Number(0.0);
        // what turns a section in one way strains it in another, where its axes have turned
        let mixed = [(curved_z, 0, 1), (curved_y, 0, 2), (is_twisted || (curved_y && curved_z), 1, 2)];
        for (_, a, b) in mixed.iter().filter(|(is_mixed, ..)| *is_mixed) {
            let sum = used[*a] + used[*b];
            (used[*a], used[*b]) = (sum, sum);
        }
        let [torsion, about_y, about_z] = used;
        let shears = |strains: usize, bends: usize| if declared.static_shear { bends } else { strains };
        let [_, bends_y, bends_z] = counts;
        let bending = Dimension::new(3, 1, -2);
        let force = Dimension::FORCE;
        let [stretch, shear_y, shear_z] = declared.strains;
        let (mut shear_y, mut shear_z) = (shears(shear_y, bends_z), shears(shear_z, bends_y));
        if is_twisted {
            let sum = shear_y + shear_z;
            (shear_y, shear_z) = (sum, sum);
        }
        type Of = fn(&Section) -> &Expr;
        type Asked = &'static [&'static str];
        let demands: [(&str, Dimension, usize, Asked, Of); 7] = [
            ("mass per length", Dimension::LINE_DENSITY, 1, &[], |x| &x.mass),
            ("torsional stiffness", bending, torsion, &["torsion"], |x| &x.stiffness[0]),
            ("bending stiffness about y", bending, about_y, &["bending_y", "bending"], |x| &x.stiffness[1]),
            ("bending stiffness about z", bending, about_z, &["bending_z", "bending"], |x| &x.stiffness[2]),
            ("axial stiffness", force, stretch, &["stretch"], |item| &item.against_strain[0]),
            ("shear stiffness along y", force, shear_y, &["shear"], |x| &x.against_strain[1]),
            ("shear stiffness along z", force, shear_z, &["shear"], |x| &x.against_strain[2]),
        ];
        let mut is_complete = true;
        for (what, dimension, used, asked, of) in demands {
            if used == 0 {
                continue;
            }
            let extent = asked.iter().find_map(|name| given.get(name)).map_or(word.into(), |value| value.extent);
            let values = ends.each_ref().map(|end| of(end).clone());
            if !declared.table.gives(what, &values[0]) {
                let message = format!("the {what} of `{name}` is not given, or zero");
                let help = declared.table.help_with(what);
                self.diagnostics.error_with_help(extent, message, help);
                is_complete = false;
            } else if declared.table.is_by_numbers() {
                self.require(format!("the {what} of `{name}`"), values, Demand::Positive(dimension), word);
            }
        }
        is_complete.then_some(())
    }
}

/// What must be positive in any design: what has been asked of a beam, and its material.
fn positive(name: &Ident, asked: &[Requirement], table: &Table) -> Vec<(String, Expr)> {
    let mut list = Vec::new();
    for requirement in asked {
        let what = requirement.what.trim_start_matches("the ").replace('`', "");
        match (&requirement.demand, &requirement.values[..]) {
            (Demand::Positive(_), values) => {
                list.extend(values.iter().map(|value| (what.clone(), value.clone())));
            }
            (Demand::BelowOuter, [inner, outer]) => {
                let wall = simplify::subtract(outer.clone(), inner.clone());
                list.push((format!("thickness of the wall of {name}"), wall));
            }
            _ => {}
        }
    }
    let material = &table.material;
    let of_material = [
        ("density", &material.density),
        ("Young's modulus", &material.modulus),
        ("shear modulus", &material.shear_modulus),
    ];
    for (what, value) in of_material {
        let value = value.iter().cloned();
        list.extend(value.map(|value| (format!("{what} of {name}"), value)));
    }
    list
}
