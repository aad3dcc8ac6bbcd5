//! Cross-sections computed from dimensions and a material, or from numbers.

use std::f64::consts::PI;

use crate::model::expression::{Expr, Function};
use crate::model::mechanism::Section;
use crate::model::simplify::{add, call, divide, multiply, power_integer, subtract};

/// Density, Young's modulus and shear modulus, as far as they are given.
#[derive(Clone, Debug, Default)]
pub(in crate::model::resolve) struct Properties {
    pub(in crate::model::resolve) density: Option<Expr>,
    pub(in crate::model::resolve) modulus: Option<Expr>,
    pub(in crate::model::resolve) shear_modulus: Option<Expr>,
}

/// Kinds of section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::model::resolve) enum Kind {
    Rectangle,
    Circle,
    Tube,
    Numbers,
}

/// What a section is computed from, at the root and at the tip.
#[derive(Clone, Debug)]
pub(in crate::model::resolve) struct Table {
    pub(in crate::model::resolve) kind: Kind,
    /// The dimensions at the root and at the tip.
    pub(in crate::model::resolve) ends: [Vec<Expr>; 2],
    pub(in crate::model::resolve) material: Properties,
    /// The centre of mass off the axis, at the root and at the tip.
    pub(in crate::model::resolve) centers: [[Expr; 2]; 2],
    /// Stiffness that couples strains, at the root and at the tip; see [`Section::coupling`].
    pub(in crate::model::resolve) coupling: [Vec<(usize, usize, Expr)>; 2],
    /// Whether a rectangle is wider than high at the nominal design.
    pub(in crate::model::resolve) is_flat: bool,
    /// Whether the stiffness is given as a matrix.
    pub(in crate::model::resolve) is_matrix: bool,
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
        if self.is_matrix && stiffness != "mass per length" {
            return "it is on the diagonal of `stiffness`".to_owned();
        }
        format!("give `{argument}`, or `{short}` within `section(...)`")
    }

    /// Whether the stiffness against twist is known.
    pub(super) fn knows_torsion(&self) -> bool {
        match self.kind {
            Kind::Numbers => self.ends[0][3] != Expr::Number(0.0),
            _ => self.material.shear_modulus.is_some(),
        }
    }

    /// Whether the sections have inertia about the axis of the beam.
    pub(super) fn resists_turning(&self) -> bool {
        if self.is_off_axis() {
            return true;
        }
        match self.kind {
            Kind::Numbers => self.ends[0][4..6].iter().any(|x| *x != Expr::Number(0.0)),
            _ => true,
        }
    }

    /// Whether strains are coupled.
    pub(super) fn is_coupled(&self) -> bool {
        self.coupling.iter().any(|end| !end.is_empty())
    }

    /// Whether mass is off the axis.
    pub(super) fn is_off_axis(&self) -> bool {
        self.centers.as_flattened().iter().any(|center| *center != Expr::Number(0.0))
    }

    /// The section at a fraction of the length.
    pub(in crate::model::resolve) fn section(&self, fraction: f64, turned: (&Expr, &[Expr; 2])) -> Section {
        let [root, tip] = &self.ends;
        let at: Vec<Expr> = root.iter().zip(tip).map(|(root, tip)| between(root, tip, fraction)).collect();
        let center = [0, 1].map(|k| between(&self.centers[0][k], &self.centers[1][k], fraction));
        let pairs = self.coupling[0].iter().zip(&self.coupling[1]);
        let coupling = pairs
            .map(|((i, j, root), (.., tip))| (*i, *j, between(root, tip, fraction)))
            .filter(|(.., x)| *x != Expr::Number(0.0))
            .collect();
        let share = |whole: &Expr| multiply(Expr::Number(fraction), whole.clone());
        let (twist, prebend) = (share(turned.0), turned.1.each_ref().map(share));
        if let [mass, about_y, about_z, torsion, inertia_y, inertia_z, axial, shear_y, shear_z, width, height] = &at[..]
        {
            return Section {
                mass: mass.clone(),
                inertia: [inertia_y.clone(), inertia_z.clone()],
                center,
                stiffness: [torsion.clone(), about_y.clone(), about_z.clone()],
                against_strain: [axial.clone(), shear_y.clone(), shear_z.clone()],
                coupling,
                twist,
                prebend,
                size: [width.clone(), height.clone()],
            };
        }
        let (area, [second_y, second_z], torsion) = self.moments(&at);
        let of = |modulus: &Option<Expr>, moment: Expr| match modulus {
            Some(modulus) => multiply(modulus.clone(), moment),
            None => Expr::Number(0.0),
        };
        let Properties { density, modulus, shear_modulus } = &self.material;
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
            center,
            stiffness: [of(shear_modulus, torsion), of(modulus, second_y), of(modulus, second_z)],
            coupling,
            twist,
            prebend,
            size: self.size(&at),
        }
    }

    /// Whether nothing is left of a shape at the tip, which then carries no load: under one, the deflection of a wedge
    /// grows like the logarithm of what is left of its height, that of a cone without bound.
    pub(super) fn is_sharp(&self) -> bool {
        let outer = match self.kind {
            Kind::Numbers => 0,
            Kind::Circle | Kind::Tube => 1,
            Kind::Rectangle => 2,
        };
        self.ends[1].iter().take(outer).any(|size| *size == Expr::Number(0.0))
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
        let Properties { modulus, shear_modulus, .. } = &self.material;
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
        let below = add(multiply(line(7.0, 6.0), square), multiply(line(20.0, 12.0), hollow));
        Some(divide(above, below))
    }

    /// Area, second moments about the second and the third axis, and the constant of torsion.
    fn moments(&self, dimensions: &[Expr]) -> (Expr, [Expr; 2], Expr) {
        let scaled = |factor: f64, a: Expr| multiply(Expr::Number(factor), a);
        match (self.kind, dimensions) {
            (Kind::Rectangle, [width, height]) => {
                let second = |across: &Expr, along: &Expr| {
                    scaled(1.0 / 12.0, multiply(across.clone(), power_integer(along.clone(), 3)))
                };
                let torsion = if self.is_flat {
                    torsion_of_rectangle(width, height)
                } else {
                    torsion_of_rectangle(height, width)
                };
                (multiply(width.clone(), height.clone()), [second(width, height), second(height, width)], torsion)
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

/// What changes linearly from the root to the tip.
fn between(root: &Expr, tip: &Expr, fraction: f64) -> Expr {
    if root == tip {
        root.clone()
    } else {
        add(multiply(Expr::Number(1.0 - fraction), root.clone()), multiply(Expr::Number(fraction), tip.clone()))
    }
}

/// Saint-Venant's constant of a rectangle `long` by `thick`, with these called `a` and `b`:
/// `a b^3 (1/3 - 64/pi^5 (b/a) sum tanh(n pi a / 2 b) / n^5)` over odd `n` (Timoshenko and Goodier 1951), with the
/// sum of `1/n^5` in closed form, so that three terms leave less than 1e-12 for `a >= b`.
fn torsion_of_rectangle(long: &Expr, thick: &Expr) -> Expr {
    const SUM: f64 = 1.004_523_762_795_139_6;
    if *thick == Expr::Number(0.0) {
        return Expr::Number(0.0);
    }
    let ratio = divide(long.clone(), thick.clone());
    let mut sum = Expr::Number(SUM);
    for n in [1.0_f64, 3.0, 5.0] {
        // Of a thin strip it vanishes, with its derivatives; the growing exponential would overflow.
        let decay = call(Function::Exp, multiply(Expr::Number(-n * PI), ratio.clone()));
        let share = divide(decay.clone(), add(decay, Expr::Number(1.0)));
        sum = subtract(sum, multiply(Expr::Number(2.0 / n.powi(5)), share));
    }
    let factor = Expr::Number(64.0 / PI.powi(5));
    let loss = multiply(factor, divide(sum, ratio));
    let cube = multiply(long.clone(), power_integer(thick.clone(), 3));
    multiply(cube, subtract(Expr::Number(1.0 / 3.0), loss))
}
