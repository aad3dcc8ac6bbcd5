//! The shapes, built from their arguments.

use std::f64::consts::PI;

use super::super::arguments::Signature;
use super::super::placements::zero;
use super::quantities::Quantities;
use crate::base::dimension::Dimension;
use crate::model::expression::Expr;
use crate::model::mechanism::Shape;
use crate::model::simplify::{multiply, power_integer, subtract};

/// A function that makes a shape from its arguments. It reads every argument before reporting a missing one.
type Reader = fn(&mut Quantities<'_, '_, '_>) -> Option<Shape>;

pub(in crate::model::resolve) type Row = Signature<Reader>;

const MASS: &[&str] = &["mass", "density"];
const CENTER: &[&str] = &["center"];

pub(in crate::model::resolve) const SHAPES: &[Row] = &[
    Row::new("massless", &[], "massless", |_| None),
    Row::new("point", &["mass"], "point(mass: 1 kg)", |shape| shape.point())
        .optional(CENTER)
        .refusing(&[("density", "a point has no volume: give its `mass`")]),
    Row::new("rod", &["length", "along"], "rod(mass: 1 kg, length: 1 m, along: -z)", |shape| shape.rod())
        .exactly_one(MASS)
        .optional(CENTER)
        .refusing(&[("radius", "a rod is thin; a thick one is a `cylinder`")]),
    Row::new("disk", &["radius", "axis"], "disk(mass: 1 kg, radius: 0.1 m, axis: z)", |shape| shape.disk())
        .exactly_one(MASS)
        .optional(CENTER)
        .refusing(&[
            ("length", "a disk is thin; a thick one is a `cylinder`"),
            ("thickness", "a disk is thin; a thick one is a `cylinder`"),
            ("inner", "a disk with a bore is a `disk` minus a `disk`, or a `tube`"),
        ]),
    Row::new(
        "cylinder",
        &["radius", "length", "axis"],
        "cylinder(mass: 1 kg, radius: 0.1 m, length: 1 m, axis: z)",
        |shape| shape.cylinder(),
    )
    .exactly_one(MASS)
    .optional(CENTER)
    .refusing(&[("inner", "a hollow cylinder is a `tube`")]),
    Row::new(
        "tube",
        &["inner", "outer", "length", "axis"],
        "tube(mass: 1 kg, inner: 8 cm, outer: 10 cm, length: 1 m, axis: z)",
        |shape| shape.tube(),
    )
    .exactly_one(MASS)
    .optional(CENTER),
    Row::new("box", &["size"], "box(mass: 1 kg, size: [1 m, 2 m, 3 m])", |shape| shape.cuboid())
        .exactly_one(MASS)
        .optional(CENTER),
    Row::new("sphere", &["radius"], "sphere(mass: 1 kg, radius: 0.1 m)", |shape| shape.sphere())
        .exactly_one(MASS)
        .optional(CENTER),
    Row::new("rigid", &["mass", "inertia"], "rigid(mass: 1 kg, inertia: [1, 1, 1] kg*m^2)", |shape| shape.rigid())
        .optional(&["center", "about"])
        .refusing(&[("density", "the volume of a `rigid` body is not known: give its `mass`")]),
    BEAM,
    SHAFT,
    SUPERELEMENT,
];

/// What a beam takes. It is no shape that others can be added to, so nothing reads it as one.
pub(in crate::model::resolve) const BEAM: Row = Row::new(
    "beam",
    &["length", "along", "up"],
    "beam(length: 1 m, along: x, up: z, section: rectangle(width: 40 mm, height: 6 mm), material: steel)",
    |_| None,
)
.optional(&[
    "section",
    "material",
    "density",
    "modulus",
    "shear_modulus",
    "poisson",
    "mass_per_length",
    "stiffness_y",
    "stiffness_z",
    "torsion_stiffness",
    "inertia_y",
    "inertia_z",
    "axial_stiffness",
    "shear_stiffness_y",
    "shear_stiffness_z",
    "stiffness",
    "width",
    "height",
    "center_y",
    "center_z",
    "bending",
    "bending_y",
    "bending_z",
    "torsion",
    "shear",
    "stretch",
    "twist",
    "prebend_y",
    "prebend_z",
    "lag",
    "points",
])
.refusing(&[
    ("mass", "give a `section` with a density, or `mass_per_length`"),
    ("axis", "the beam runs `along` its axis; `up` is the direction of the height of its section"),
]);

/// What a superelement takes; nothing reads it as a shape either.
pub(in crate::model::resolve) const SUPERELEMENT: Row = Row::new(
    "superelement",
    &["mass", "stiffness", "stations"],
    "superelement(mass: \"casing_mass.mtx\", stiffness: \"casing_stiffness.mtx\", stations: [[0, 0, 0], [0.4 m, 0, 0]])",
    |_| None,
)
.optional(&["damping", "gyroscopic", "held", "on"])
.refusing(&[("file", "`eigentol import` makes matrices and a declaration of a file of another program")]);

/// What a shaft takes; nothing reads it as a shape either.
pub(in crate::model::resolve) const SHAFT: Row = Row::new(
    "shaft",
    &["along", "up"],
    "shaft(along: x, up: z, sections: [[120 mm, 40 mm], [80 mm, 60 mm, 20 mm]], material: steel)",
    |_| None,
)
.optional(&[
    "sections",
    "material",
    "density",
    "modulus",
    "shear_modulus",
    "poisson",
    "shear_coefficient",
    "length",
    "mass_per_length",
    "inertia",
    "stiffness",
    "shear_stiffness",
    "torsion_stiffness",
    "axial_stiffness",
    "lines",
    "shear",
    "lag",
    "drag",
    "tension",
    "torque",
    "elements",
])
.refusing(&[
    ("mass", "a rigid shaft is a `cylinder`; a flexible one has a `material`"),
    ("radius", "a rigid shaft is a `cylinder`; a flexible one has `sections`"),
    ("axis", "the shaft runs `along` its axis; `up` is one of the two directions in which it bends"),
]);

/// Names of the shapes in other tools.
pub(super) const SYNONYMS: [(&str, &str); 21] = [
    ("none", "massless"),
    ("weightless", "massless"),
    ("empty", "massless"),
    ("mass", "point"),
    ("point_mass", "point"),
    ("particle", "point"),
    ("bar", "rod"),
    ("link", "rod"),
    ("stick", "rod"),
    ("disc", "disk"),
    ("wheel", "disk"),
    ("pipe", "tube"),
    ("ring", "tube"),
    ("hollow_cylinder", "tube"),
    ("cuboid", "box"),
    ("block", "box"),
    ("brick", "box"),
    ("plate", "box"),
    ("ball", "sphere"),
    ("inertia", "rigid"),
    ("inertial", "rigid"),
];

impl Quantities<'_, '_, '_> {
    fn point(&mut self) -> Option<Shape> {
        let (mass, center) = (self.mass(), self.center(|| Some(zero())));
        Some(Shape::Point { mass: mass?, center: center? })
    }

    fn rod(&mut self) -> Option<Shape> {
        let (length, along) = (self.length("length"), self.direction("along"));
        let density = Dimension::LINE_DENSITY;
        let mass = self.mass_or_density(density, || length.clone());
        let center = self.center(|| {
            let half = multiply(Expr::Number(0.5), length.clone()?);
            Some(along.clone()?.map(|component| multiply(half.clone(), component)))
        });
        Some(Shape::Rod { mass: mass?, length: length?, along: along?, center: center? })
    }

    fn disk(&mut self) -> Option<Shape> {
        let (radius, axis) = (self.length("radius"), self.direction("axis"));
        let density = Dimension::AREA_DENSITY;
        let mass = self.mass_or_density(density, || Some(circle(radius.clone()?)));
        let center = self.center(|| Some(zero()));
        Some(Shape::Disk { mass: mass?, radius: radius?, axis: axis?, center: center? })
    }

    fn cylinder(&mut self) -> Option<Shape> {
        let (radius, length) = (self.length("radius"), self.length("length"));
        let axis = self.direction("axis");
        let mass =
            self.mass_or_density(Dimension::DENSITY, || Some(multiply(circle(radius.clone()?), length.clone()?)));
        let center = self.center(|| Some(zero()));
        Some(Shape::Cylinder { mass: mass?, radius: radius?, length: length?, axis: axis?, center: center? })
    }

    fn tube(&mut self) -> Option<Shape> {
        let (inner, outer) = (self.length("inner"), self.length("outer"));
        let (length, axis) = (self.length("length"), self.direction("axis"));
        self.inner_below_outer(inner.as_ref(), outer.as_ref());
        let mass = self.mass_or_density(Dimension::DENSITY, || {
            let section = subtract(circle(outer.clone()?), circle(inner.clone()?));
            Some(multiply(section, length.clone()?))
        });
        let center = self.center(|| Some(zero()));
        Some(Shape::Tube { mass: mass?, inner: inner?, outer: outer?, length: length?, axis: axis?, center: center? })
    }

    fn cuboid(&mut self) -> Option<Shape> {
        let size = self.size();
        let mass = self.mass_or_density(Dimension::DENSITY, || {
            let [x, y, z] = size.clone()?;
            Some(multiply(multiply(x, y), z))
        });
        let center = self.center(|| Some(zero()));
        Some(Shape::Cuboid { mass: mass?, size: size?, center: center? })
    }

    fn sphere(&mut self) -> Option<Shape> {
        let radius = self.length("radius");
        let mass = self.mass_or_density(Dimension::DENSITY, || {
            let cube = power_integer(radius.clone()?, 3);
            Some(multiply(Expr::Number(4.0 / 3.0 * PI), cube))
        });
        let center = self.center(|| Some(zero()));
        Some(Shape::Sphere { mass: mass?, radius: radius?, center: center? })
    }

    fn rigid(&mut self) -> Option<Shape> {
        let (mass, center) = (self.mass(), self.center(|| Some(zero())));
        let about = self.place("about");
        let inertia = self.inertia(mass.as_ref(), center.as_ref(), about.as_ref());
        Some(Shape::Rigid {
            mass: mass?,
            center: center?,
            inertia: inertia?,
            about: match about {
                Some(about) => Some(about?),
                None => None,
            },
        })
    }
}

/// The area of a circle.
fn circle(radius: Expr) -> Expr {
    multiply(Expr::Number(PI), power_integer(radius, 2))
}
